# SPDX-License-Identifier: GPL-2.0-or-later
"""Formulas of sweep files: arithmetic on named numbers, and nothing else.

``"0.5 * min(rigid, stress.horizontal)"``: numbers, names (with dots: keys of a case), ``+ - * / **``, brackets, and the
functions of ``FUNCTIONS``. A formula cannot call or reach anything else, so a sweep file from elsewhere is safe to run.
"""

import ast
import math
import operator

from capfrac.errors import CaseError
from capfrac.values import asFloat, shown

FUNCTIONS = {
    "min": min,
    "max": max,
    "sqrt": math.sqrt,
    "exp": math.exp,
    "log": math.log,
    "log10": math.log10,
    "round": round,
}
_BINARY = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}
_UNARY = {ast.UAdd: operator.pos, ast.USub: operator.neg}


class Formula:
    """A formula, parsed; ``names`` are those it needs. Raises :class:`CaseError` for what is not arithmetic."""

    def __init__(self, text, source="formula"):
        self.text, self.source = text, source
        if not isinstance(text, str) and asFloat(text) is None:
            raise CaseError(f"{source} = {shown(text)}, allowed: a formula (text) or a number")
        self.names = set()
        try:
            self._tree = ast.parse(str(text).strip(), mode="eval").body
            self._check(self._tree)
        except CaseError:
            raise
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            raise CaseError(
                f"{source} = '{str(text)[:200]}' is not a formula; allowed: numbers, names, + - * / **, "
                f"brackets, {', '.join(FUNCTIONS)}"
            ) from None

    def _check(self, node):
        """Refuse what is not arithmetic, and collect the names."""
        name = _nameOf(node)
        if name is not None:
            self.names.add(name)
        elif isinstance(node, ast.BinOp) and type(node.op) in _BINARY:
            self._check(node.left), self._check(node.right)
        elif isinstance(node, ast.UnaryOp) and type(node.op) in _UNARY:
            self._check(node.operand)
        elif (
            isinstance(node, ast.Call)
            and isinstance(node.func, ast.Name)
            and node.func.id in FUNCTIONS
            and node.args
            and not node.keywords
        ):
            for argument in node.args:
                self._check(argument)
        elif not (
            isinstance(node, ast.Constant) and isinstance(node.value, (int, float)) and not isinstance(node.value, bool)
        ):
            raise CaseError(
                f"{self.source} = '{self.text}': '{ast.unparse(node)}' is not allowed in a formula; allowed: numbers,"
                f" names, + - * / **, brackets, {', '.join(FUNCTIONS)}"
            )

    def value(self, values):
        """The number for ``values`` (name -> number). Raises :class:`CaseError` naming what is missing or where no
        finite number comes out.
        """
        missing = sorted(name for name in self.names if name not in values)
        if missing:
            raise CaseError(
                f"{self.source} = '{self.text}': '{missing[0]}' is not known; known: {', '.join(sorted(values))}"
            )
        for name in self.names:
            if asFloat(values[name]) is None:
                raise CaseError(f"{self.source} = '{self.text}': {name} = {shown(values[name])} is not a number")
        try:
            found = self._evaluate(self._tree, values)
        except (ArithmeticError, ValueError, TypeError) as problem:
            raise CaseError(f"{self.source} = '{self.text}' has no value: {problem}") from None
        if isinstance(found, complex) or not math.isfinite(found):
            raise CaseError(f"{self.source} = '{self.text}' gives {found}, allowed: finite numbers")
        return found

    def wholeValue(self, values):
        """The whole number for ``values`` but for round-off: 0.6 / 0.2 is 3. :class:`CaseError` for one between two."""
        found = self.value(values)
        whole = round(found)
        # The round-off of a short formula is some 1e-16 of the numbers in it, which may be larger than what comes out.
        if abs(found - whole) > min(1e-9 * max(1, abs(found)), 1e-3):
            raise CaseError(
                f"{self.source} = '{self.text}' gives {found!r}, allowed: a whole number; round(...) makes one of it"
            )
        return whole

    def _evaluate(self, node, values):
        name = _nameOf(node)
        if name is not None:
            return float(values[name])  # powers of whole numbers may have any number of digits
        if isinstance(node, ast.BinOp):
            return _BINARY[type(node.op)](self._evaluate(node.left, values), self._evaluate(node.right, values))
        if isinstance(node, ast.UnaryOp):
            return _UNARY[type(node.op)](self._evaluate(node.operand, values))
        if isinstance(node, ast.Call):
            return FUNCTIONS[node.func.id](*(self._evaluate(argument, values) for argument in node.args))
        return float(node.value)


def _nameOf(node):
    """``name`` or ``section.key``, or None."""
    if isinstance(node, ast.Name):
        return node.id
    if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
        return f"{node.value.id}.{node.attr}"
    return None
