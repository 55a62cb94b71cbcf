"""Splines that are solved together, because several of them move one point."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from ctypes import addressof, c_double
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._curve import Curve
from ._library import SOLVERS, CBound, CCurve, CDesc, CPin, CPull, Handle, Status, lib, numbers, report
from ._spline import Spline, nearest_samples, word


class Pin(NamedTuple):
    """A point and its place at one time."""

    time: float
    """Seconds; the nearest sample, as of a knot."""
    pulls: Mapping[int, ArrayLike]
    """How each spline moves the point, by Re(c x): index of the spline → c, complex, shape (3,)."""
    to: ArrayLike
    """The offset from where the point is with every x at 0, shape (3,)."""


class Bound(NamedTuple):
    """A side on which a point stays at one time: the sum of Re(c x) is at least `least`."""

    time: float
    c: ArrayLike
    """Complex, one number a spline."""
    least: float


class Together(NamedTuple):
    """Solved splines, and how well their pins and bounds are met."""

    curves: list[Curve]
    left: NDArray[np.float64]
    """The offset that remains of each pin, shape (pins, 3)."""
    push: NDArray[np.float64]
    """How hard each bound presses, shape (bounds,)."""
    missing: NDArray[np.float64]
    """What is missing at each bound, shape (bounds,); 0 and less: nothing."""
    status: Status


class Group:
    """Splines whose weighted energies are minimised together.

    Parameters
    ----------
    splines : sequence of Spline
    weights : array_like of shape (splines,), optional
        Above 0; they make the energies comparable. The mean of |c|² over what a spline moves serves; 1 by default.

    Examples
    --------
    >>> side, up = Spline([(0, 0.4)], frequency=1, damping=0.1), Spline(frequency=1.6, damping=0.1)
    >>> pin = Pin(1, {0: [1, 0, 0], 1: [0, 1, 0]}, to=[0.3, 0.2, 0])
    >>> held = Group([side, up]).solve(49, pins=[pin])
    >>> [round(float(curve.total[24]), 6) for curve in held.curves]
    [0.3, 0.2]
    """

    def __init__(self, splines: Sequence[Spline], weights: ArrayLike | None = None) -> None:
        self.splines = list(splines)
        self.weights = np.ones(len(self.splines)) if weights is None else np.asarray(weights, dtype=float)
        self._checked_weights(len(self.splines))

    def _checked_weights(self, count: int) -> NDArray[np.float64]:
        weights = numbers(self.weights, "C")
        if weights.shape != (count,):
            raise ValueError(f"weights: expected one a spline, {count}, got an array of shape {weights.shape}")
        return weights

    def solve(self, n: int, fps: float = 24, *, pins: Sequence[Pin] = (), bounds: Sequence[Bound] = (), solver: str = "chain") -> Together:
        """The curves of `n` samples through knots and pins, within the bounds."""
        described = [spline._describe(n, fps) for spline in self.splines]
        curves = [Curve(n, 1 / fps) for _ in described]
        count = len(curves)
        weights = self._checked_weights(count)
        descs = (CDesc * count)(*(desc for desc, _ in described))
        structs = (CCurve * count)(*(curve._struct for curve in curves))
        c_pins = (CPin * len(pins))(*(_pin(pin, fps) for pin in pins))
        c_bounds = (CBound * len(bounds))()
        pulls = [np.ascontiguousarray(bound.c, dtype=complex) for bound in bounds]
        for c_bound, bound, c in zip(c_bounds, bounds, pulls):
            if c.shape != (count,):
                raise ValueError(f"a bound's c: expected one number a spline, {count}, got {c.shape}")
            c_bound.sample, c_bound.c, c_bound.least = _sample(bound.time, fps), c.ctypes.data, bound.least
        room = max(map(len, (knots for _, knots in described)), default=0)
        group = Handle(
            lib.wiggly_group_create_bounded, lib.wiggly_group_destroy, max(n, 1), room, max(count, 1), len(pins), len(bounds))  # fmt: skip
        lib.wiggly_group_set_method(group.at, word("solver", solver, SOLVERS))
        code = lib.wiggly_group_solve_bounded(
            group.at, addressof(descs), weights.ctypes.data, addressof(structs), count,
            addressof(c_pins), len(pins), addressof(c_bounds), len(bounds))  # fmt: skip
        wrong = next((i for i, struct in enumerate(structs) if struct.knot >= 0), None) if code >= Status.ARGUMENT else None
        report(code, -1 if wrong is None else structs[wrong].knot, wrong)
        for curve, struct in zip(curves, structs):
            curve._hold(curve._block, CCurve.from_buffer_copy(struct))
            curve.status = Status(code)
        return Together(
            curves,
            np.array([list(pin.left) for pin in c_pins]).reshape(-1, 3),
            np.array([bound.push for bound in c_bounds]),
            np.array([bound.left for bound in c_bounds]),
            Status(code),
        )


def _sample(time: float, fps: float) -> int:
    sample = float(nearest_samples(np.asarray(time, dtype=float), fps))
    if not abs(sample) < 2**31:
        report(Status.PIN)
    return int(sample)


def _pin(pin: Pin, fps: float) -> CPin:
    pulls = (CPull * len(pin.pulls))()
    for pull, (spline, c) in zip(pulls, pin.pulls.items()):
        pull.spline = spline
        for axis, z in zip(pull.c, _three(c, complex)):
            axis[:] = z.real, z.imag
    return CPin(_sample(pin.time, fps), pulls, len(pulls), (c_double * 3)(*_three(pin.to, float)))


def _three(numbers: ArrayLike, kind: type) -> NDArray[Any]:
    array: NDArray[Any] = np.asarray(numbers, dtype=kind)
    if array.shape != (3,):
        raise ValueError(f"a pin: expected three numbers, for x, y and z, got {array.shape}")
    return array
