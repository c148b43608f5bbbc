# SPDX-License-Identifier: GPL-2.0-or-later
"""The servo-controlled box: a sample between four walls that are pressed, driven or held.

Stresses and strains are positive in compression; strains are engineering strains from the lengths at
:meth:`Box.setReference`. Stresses are effective stresses of the dry (or drained) sample, wall force over wall area,
thickness 1 m. Modes (which wall does what) are named as in a geotechnical laboratory: see ``MODES``.

    box = Box(sample)
    box.confine(10e3, 10e3)                 # sigma_V, sigma_H [Pa]; within 0.5 % before it goes on
    box.setReference()
    box.mode("biaxial", stressH=10e3)
    box.strainTo(0.05)                      # rows are collected in box.rows

    box.mode("isotropic")
    box.stressTo([20e3, 50e3, 100e3])       # each within 0.5 %, grains at rest
"""

import math

import numpy as np

from capfrac.errors import CaseError, SampleError
from capfrac.lab.measures import countBonds, loadBearing, trueVoidRatio
from capfrac.lab.run import LabRun
from capfrac.scene import sediment
from capfrac.values import asFloat, isPositive, shown

#: What the walls do in each mode; the bottom stays in all of them.
MODES = {
    "uniaxial": "driven by strain: the top wall moves, side walls are fixed (oedometer)",
    "biaxial": "driven by strain: the top wall moves, side walls bear a constant stress",
    "meanStress": "driven by strain: the top wall moves, side walls keep the mean stress constant",
    "isotropic": "driven by stress: all walls bear the same stress",
    "k0": "driven by stress: the top wall bears it, side walls are fixed (no lateral strain)",
}

STRAIN_DRIVEN = ("uniaxial", "biaxial", "meanStress")

#: Inertial number I = strain rate * d * sqrt(rho / sigma) of a test [-]. Below 1e-3 granular matter counts as
#: quasi-static (GDR MiDi, Eur. Phys. J. E 14 (2004) 341).
INERTIAL_NUMBER = 5e-4

#: Wall stresses are this near their targets (relative) before a test goes on.
SERVO_TOLERANCE = 0.005

#: Columns of a test's table.
COLUMNS = (
    "strain [-]",
    "lateralStrain [-]",
    "stressV [Pa]",
    "stressH [Pa]",
    "voidRatio [-]",
    "trueVoidRatio [-]",
    "unbalanced [-]",
    "inertialNumber [-]",
    "servoError [-]",
    "brokenBonds",
    "iteration",
    "branch",
)


class Box:
    """The walls around the sample of the current scene. ``run`` keeps rows and reference over interruptions."""

    def __init__(self, sample, run=None, inertialNumber=INERTIAL_NUMBER):
        if not (isPositive(inertialNumber) and inertialNumber <= 1e-2):
            raise CaseError(
                f"inertialNumber = {shown(inertialNumber)}, allowed: 0 < I <= 0.01 (quasi-static: up to 1e-3)"
            )
        self.sample, self.run, self.inertialNumber = sample, run or LabRun("box", {}), inertialNumber

    @property
    def rows(self):
        """What was measured: lists by column (``COLUMNS``)."""
        return self.run.data.setdefault("rows", {name: [] for name in COLUMNS})

    def lengths(self):
        """Width and height [m]."""
        return sediment.boxSize()

    def solidArea(self):
        """Area of the grains, overlaps counted twice [m^2]."""
        return math.pi * sum(radius**2 for radius in self._radii())

    def _radii(self):
        return [body.shape.radius for body in sediment.grainBodies()]

    # --- preparing ---------------------------------------------------------------------------------

    def confine(self, stressV, stressH, progress=None):
        """Bring all walls to these stresses [Pa] and the grains to rest; see :func:`sediment.compress`."""
        sediment.compress(self.sample, stressV, stressH, tolerance=SERVO_TOLERANCE, progress=progress)
        sediment.relax(progress=progress)

    def setReference(self):
        """Strains count from here; rows begin anew."""
        loaded = loadBearing()
        if loaded < 3:
            raise SampleError(
                f"the sample bears no load: {loaded} of {len(self._radii())} grains have two contacts or more (a sample"
                " of rattlers only)"
            )
        width, height = self.lengths()
        self.run.data["reference"] = {"width": width, "height": height, "bonds": countBonds()}
        self.run.data.pop("rows", None)

    def mode(self, name, stressH=None, meanStress=None):
        """Say what the walls do: one of ``MODES``, with the stress that it keeps constant [Pa]."""
        if name not in MODES:
            raise CaseError(f"mode = {name!r}, allowed: {', '.join(MODES)}")
        for key, value in (
            ("stressH", stressH if name == "biaxial" else 1),
            ("meanStress", meanStress if name == "meanStress" else 1),
        ):
            if not isPositive(value):
                raise CaseError(f"{key} = {shown(value)} Pa with mode '{name}', allowed: > 0")
        servo = sediment.engine("servo")
        servo.dead = False
        servo.drivenWalls, servo.driveVelocity = ["top"] if name in STRAIN_DRIVEN else [], 0.0
        servo.fixedWalls = ["bottom", "left", "right"] if name in ("uniaxial", "k0") else ["bottom"]
        servo.meanStress = meanStress if name == "meanStress" else math.nan
        if name == "biaxial":
            servo.stressX = stressH
        self.run.data["mode"] = name
        self.run.data.pop("leastStress", None)

    # --- driving -----------------------------------------------------------------------------------

    def strainTo(self, target, spacing=0.001, branch="virgin", until=lambda row: False):
        """Drive the top wall until the vertical strain is ``target``, up or down; a row every ``spacing`` of strain.

        For the modes driven by strain. The top wall halts before each row until the walls that keep a stress are within
        ``SERVO_TOLERANCE`` of it.
        Ends earlier when ``until(row)`` is true. Raises :class:`CaseError` when the box has no room for the strain, and
        :class:`SampleError` when control of the walls is lost.
        """
        self._requireMode(STRAIN_DRIVEN)
        self._checkRoom(target)
        sign = 1 if target > self.strain() else -1
        while sign * (target - self.strain()) > 1e-9 and not (self._lastBranch() == branch and until(self._lastRow())):
            self._drive(sign, min(spacing, abs(target - self.strain())))
            rate = self._settleWalls()
            self.record(branch, rate)
            self.run.tick()
        sediment.engine("servo").driveVelocity = 0.0

    def _lastBranch(self):
        return self.rows["branch"][-1] if self.rows["branch"] else None

    def _lastRow(self):
        return {name: values[-1] for name, values in self.rows.items()}

    def stressTo(self, targets, unbalanced=1e-3, maxSteps=500_000, branch="virgin"):
        """Bring the box to each of the stresses ``targets`` [Pa], > 0; a row for each, with the grains at rest.

        For the modes driven by stress. Raises :class:`SampleError` when the walls do not come within
        ``SERVO_TOLERANCE``.
        """
        from yade import utils

        self._requireMode(("isotropic", "k0"))
        for target in targets:
            if not isPositive(target):
                raise CaseError(f"target stress = {shown(target)} Pa, allowed: > 0")
        targets = list(targets)
        while self.run.data.setdefault("nTargets", 0) < len(targets):
            servo = sediment.engine("servo")
            servo.stressX = servo.stressY = targets[self.run.data["nTargets"]]
            sediment.runUntil(
                lambda: servo.error < SERVO_TOLERANCE and utils.unbalancedForce() < unbalanced,
                maxSteps,
                200,
                lambda: (
                    f"the walls did not come to {servo.stressY:g} Pa within {maxSteps} steps: stresses"
                    f" {list(servo.stress)} Pa"
                ),
                None,
                "compressing",
            )
            self.record(branch)
            self.run.data["nTargets"] += 1
            self.run.tick()
        self.run.data["nTargets"] = 0

    def _requireMode(self, allowed):
        mode = self.run.data.get("mode")
        if mode not in allowed:
            raise CaseError(f"the box is in mode {mode!r}, allowed here: {', '.join(allowed)}; call mode() first")

    def _checkRoom(self, strain):
        """A box flatter than four large grains, or with half of its grains' area overlapping, is no sample any more."""
        width, height = self.lengths()
        reference = self.run.data["reference"]
        least = max(4 * 2 * max(self._radii()), 0.5 * self.solidArea() / width)
        most = 1 - least / reference["height"]
        if asFloat(strain) is None or strain > most:
            raise CaseError(
                f"strain = {shown(strain)}, allowed: up to {most:.3g} (a box of {reference['height']:.4g} "
                "m then holds no more than overlapping grains)"
            )
        if strain < -0.5:
            raise CaseError(f"strain = {strain}, allowed: >= -0.5")

    def strain(self):
        """Vertical strain now [-]."""
        return 1 - self.lengths()[1] / self.run.data["reference"]["height"]

    def _drive(self, sign, strain):
        """Drive by ``strain`` at the inertial number of the test."""
        from yade import O

        servo = sediment.engine("servo")
        height = self.run.data["reference"]["height"]
        mean = max(
            0.5 * (servo.stress[3] + servo.stress[0]),
            self.run.data.setdefault("leastStress", 0.5 * (servo.stress[3] + servo.stress[0])),
        )
        rate = self.inertialNumber / (2 * np.mean(self._radii())) * math.sqrt(mean / self.sample.density)
        steps = max(1, math.ceil(strain / (rate * O.dt)))
        servo.driveVelocity = sign * strain * height / (steps * O.dt)
        sediment.advance(steps)
        if not all(math.isfinite(s) for s in servo.stress):
            raise SampleError(
                f"control of the walls was lost at iteration {O.iter}: stresses {list(servo.stress)} Pa; try a smaller"
                " inertialNumber"
            )

    def _settleWalls(self, maxSteps=100_000):
        """Halt until the servo-controlled walls are at their stresses; returns the speed there was before [m/s]."""
        servo = sediment.engine("servo")
        speed, servo.driveVelocity = servo.driveVelocity, 0.0
        if self.run.data["mode"] != "uniaxial":
            sediment.runUntil(
                lambda: servo.error < SERVO_TOLERANCE,
                maxSteps,
                20,
                (
                    f"control of the walls was lost: not within {SERVO_TOLERANCE:.1%} of their stresses after"
                    f" {maxSteps} steps"
                ),
                None,
                "shearing",
            )
        return speed

    def record(self, branch, speed=0.0):
        """Measure and append a row; returns it as a dict by column. ``speed`` of the top wall until now [m/s]."""
        from yade import O, utils

        reference = self.run.data["reference"]
        width, height = self.lengths()
        stressH, stressV = sediment.wallStresses()
        rate = abs(speed) / reference["height"]
        mean = max(0.5 * (stressV + stressH), 1e-300)
        solid = self.solidArea()
        values = (
            1 - height / reference["height"],
            1 - width / reference["width"],
            stressV,
            stressH,
            width * height / solid - 1,
            trueVoidRatio(width * height),
            utils.unbalancedForce(),
            rate * 2 * np.mean(self._radii()) * math.sqrt(self.sample.density / mean),
            self._servoError(),
            reference["bonds"] - countBonds(),
            O.iter,
            branch,
        )
        for name, value in zip(COLUMNS, values):
            self.rows[name].append(float(value) if isinstance(value, np.floating) else value)
        self.run.report(f"{branch}: strain {values[0]:.2%}, sigma_V = {stressV:.4g} Pa, sigma_H = {stressH:.4g} Pa")
        return dict(zip(COLUMNS, values))

    def _servoError(self):
        servo = sediment.engine("servo")
        return servo.error if self.run.data["mode"] != "uniaxial" else 0.0

    def quasiStatic(self):
        """The largest unbalanced force, inertial number and servo error of the rows: a dict."""
        rows = self.rows
        return {
            name: float(np.max(rows[column])) if rows[column] else math.nan
            for name, column in (
                ("unbalanced", "unbalanced [-]"),
                ("inertialNumber", "inertialNumber [-]"),
                ("servoError", "servoError [-]"),
            )
        }
