"""Scene files of the app."""

from __future__ import annotations

import csv
import json
import os
import shutil
import subprocess
from ctypes import ArgumentError
from pathlib import Path
from typing import Any

import numpy as np

from ._curve import Curve
from ._library import Error, shared_solver, warn
from ._spline import Knot, Spline, from_spring, solve_into

PARAMETERS = ("frequency", "damping", "bandwidth", "equilibrium")
SWING = ("mode", "start", "frequency", "damping", "bandwidth", "spring", "friction")
PLAIN = (*PARAMETERS, "calm", "wind_up", "mode", "start", "passive", "limits")
FAULTS = (ArithmeticError, ArgumentError, AttributeError, LookupError, RecursionError, TypeError, ValueError)


def _program() -> str | None:
    tree = Path(__file__).resolve().parents[3] / "build" / "wiggly"
    return shutil.which(os.environ.get("WIGGLY") or shutil.which("wiggly") or str(tree))


def _wrong(path: Path, error: Exception) -> Error:
    """What is wrong with a scene: in the program's words, where it is there."""
    clear = isinstance(error, (Error, json.JSONDecodeError, UnicodeDecodeError))
    text = f"{path}: {error}" if clear else f"{path}: not a scene: {error!r}; `wiggly check` says more"
    program = _program()
    if program and path.exists():
        done = subprocess.run([program, "check", path], capture_output=True, encoding="utf-8")
        text = done.stdout.strip() if done.returncode else text
    return Error(text, getattr(error, "status", None), getattr(error, "knot", None))


class Scene:
    """A scene file: splines, and the rigs that they move.

    Attributes
    ----------
    path : Path
    data : dict
        The file's JSON.
    n, fps : int, float
        Samples of each curve, and samples per second. A curve's second 0 is the first frame.
    needs_rig : bool
        Whether its splines need what only the program has: pins, a floor, or the motion of a clip.

    Examples
    --------
    >>> scene = Scene.load("assets/scenes/figure5.json")
    >>> curves = scene.solve()
    >>> sorted(curves), len(curves["edited"])
    (['edited', 'equilibrium', 'free'], 193)
    """

    def __init__(self, path: str | os.PathLike[str], data: dict[str, Any]) -> None:
        self.path, self.data = Path(path), data
        try:
            self._substeps = data.get("substeps", 1)
            self._first, last = data["frames"]
            self.n = (last - self._first) * self._substeps + 1
            self.fps = data.get("fps", 24) * self._substeps
            self._splines = {spline["name"]: spline for spline in data.get("splines", [])}
            self._step = 1 / self.fps
            follows = (isinstance(s.get("equilibrium"), dict) and "model" in s["equilibrium"] for s in self._splines.values())
            self.needs_rig = any(rig.get("pins") or "floor" in rig for rig in data.get("rigs", [])) or any(follows)
        except FAULTS as error:
            raise _wrong(self.path, error) from None

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Scene:
        """Reads a file."""
        try:
            data = json.loads(Path(path).read_text(encoding="utf-8"))
        except FAULTS as error:
            raise _wrong(Path(path), error) from None
        return cls(path, data)

    def solve(self, solver: str = "chain") -> dict[str, Curve]:
        """All curves, by name: the same bits as `wiggly solve --solver chain`.

        Splines that need a rig are solved by the program `wiggly`: that of the environment variable WIGGLY, else on the path,
        else in the tree's build folder.
        """
        if self.needs_rig:
            return self._solve_by_program(solver)
        curves: dict[str, Curve] = {}
        try:
            for name in self._splines:
                self._solve_one(name, solver, curves)
        except FAULTS as error:
            raise _wrong(self.path, error) from None
        return {name: curves[name] for name in self._splines}

    def export(self, path: str | os.PathLike[str], *options: str) -> None:
        """Writes what `wiggly export` writes: .glb, .usda, .csv and others, by the ending of the file."""
        self._run("export", str(self.path), "-o", str(path), "--quiet", *options)

    def _solve_one(self, name: str, solver: str, curves: dict[str, Curve]) -> Curve:
        if name not in curves:
            source = self._splines[name]
            tracks = {
                key: self._solve_one(source[key]["spline"], solver, curves).total
                for key in PARAMETERS
                if isinstance(source.get(key), dict) and "spline" in source[key]
            }
            try:
                curves[name] = self._solve_spline(source, tracks, solver)
            except Error as error:
                raise Error(f"{name}: {error}", error.status, error.knot) from None
        return curves[name]

    def _solve_spline(self, source: dict[str, Any], tracks: dict[str, Any], solver: str) -> Curve:
        settings = {"frequency": 0, **{key: source[key] for key in PLAIN if key in source}, **tracks}
        if "spring" in source or "friction" in source:
            settings["frequency"], settings["damping"] = from_spring(source.get("spring", 0), source.get("friction", 0))
        if "variation" in source:
            settings["variation"], settings["seed"] = source["variation"]["amount"], source["variation"].get("seed", 0)
        knots = [
            Knot(k["frame"], 0, still=True) if k.get("still") else
            Knot(k["frame"], k["value"], k.get("slope"), k.get("stiffness"), k.get("im"), settles=k.get("settles", False)) for k in source.get("knots", [])
        ]  # fmt: skip
        spline, curve = Spline(knots, **settings), Curve(self.n, self._step)
        samples = np.floor((spline.times - self._first) * self._substeps + 0.5)
        desc, _knots = spline._describe(self.n, self.fps, samples)
        solve_into(shared_solver(self.n, spline._room(self.n)), desc, curve, solver)
        return curve

    def _run(self, *arguments: str) -> str:
        program = _program()
        if not program:
            raise Error(f"{self.path}: this needs the program wiggly: build it with make, and set WIGGLY to its path")
        done = subprocess.run([program, *arguments], capture_output=True, encoding="utf-8")
        if done.returncode:
            raise Error(done.stderr.strip().removeprefix("wiggly: "))
        for line in done.stderr.splitlines():
            if ": warning: " in line:
                warn(line)
        return done.stdout

    def _solve_by_program(self, solver: str) -> dict[str, Curve]:
        rows = list(csv.reader(self._run("solve", str(self.path), "--solver", solver).splitlines()))
        table = np.array(rows[1:], dtype=float).T[1:].reshape(-1, 3, self.n)
        solved = dict(zip(self._splines, table))
        curves = {}
        for name, source in self._splines.items():
            swing = {key: source[key] for key in SWING if key in source}
            tracks = {key: solved[value["spline"]][0] for key, value in swing.items() if isinstance(value, dict)}
            curve = curves[name] = self._solve_spline(swing, tracks, solver)  # at rest, for what a curve needs between samples
            curve.total[:], curve.re[:], curve.im[:] = solved[name]
            curve.y[:] = curve.total - curve.re
        return curves
