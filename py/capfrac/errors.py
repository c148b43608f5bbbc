# SPDX-License-Identifier: GPL-2.0-or-later
"""What can go wrong, by kind. Every message names the culprit, its value and what is allowed."""


class CapfracError(Exception):
    """Any problem that capfrac reports."""

    def inWords(self, translate):
        """The same error with each of its texts as ``translate(text)`` has it."""
        return type(self)(*map(translate, map(str, self.args)))


class CaseError(CapfracError, ValueError):
    """A case file or arguments with unknown or impossible entries. Names each key, its value and what is allowed.

    ``problems`` holds a text for each thing that is wrong; ``source``, where given, names the file that they are in.
    """

    def __init__(self, *problems, source=""):
        super().__init__(*problems)
        self.problems, self.source = [str(problem) for problem in problems], source

    def inWords(self, translate):
        """The same error with each of its problems as ``translate(text)`` has it."""
        return CaseError(*map(translate, self.problems), source=self.source)

    def __str__(self):
        start = f"{self.source}: " if self.source else ""
        if len(self.problems) == 1:
            return start + self.problems[0]
        return f"{start}{len(self.problems)} problems\n" + "\n".join(f"  - {problem}" for problem in self.problems)


class SampleError(CapfracError):
    """A sample that cannot be made or brought to the requested state."""


class SceneError(CapfracError):
    """A YADE scene that is not in the state that a function needs. The scene has not been changed."""


class RunFolderError(CapfracError):
    """A run folder that cannot be used, as it is or at all."""
