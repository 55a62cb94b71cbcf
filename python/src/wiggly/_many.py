"""Many splines in arrays, over threads, without a loop in Python."""

from __future__ import annotations

import os
from ctypes import addressof, sizeof
from operator import index
from time import perf_counter
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._library import CDesc, CMany, CRows, Handle, Status, lib, numbers, report
from ._spline import Spline, nearest_samples

INPUTS = ("sample", "value", "slope", "stiffness", "phase", "still", "settles")
OUTPUTS = ("total", "y", "re", "im")


class Many(NamedTuple):
    """What `solve_many` returns."""

    total: NDArray[np.float64]
    """shape (count, n); (0, n) where you did not ask for it."""
    y: NDArray[np.float64]
    re: NDArray[np.float64]
    im: NDArray[np.float64]
    status: NDArray[np.intc]
    """One `Status` a spline, shape (count,)."""


def _rows(array: ArrayLike | None, shape: tuple[int, int]) -> tuple[CRows, NDArray[np.float64] | None]:
    """Broadcast by strides, not copied."""
    if array is None:
        return CRows(), None
    wide = np.broadcast_to(numbers(array), shape)
    if any(stride % 8 for stride in wide.strides):
        wide = np.ascontiguousarray(wide)
    return CRows(wide.ctypes.data, wide.strides[0] // 8, wide.strides[1] // 8), wide


def _threads(threads: int | None) -> int:
    if threads is None:
        return min(len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1, 256)
    if not 1 <= threads <= 256:
        raise ValueError(f"threads: expected 1 to 256, got {threads!r}")
    return index(threads)


def _solve(batch: Handle, desc: CDesc, many: CMany, status: NDArray[np.intc]) -> None:
    """In portions, between which Python hears Ctrl+C: from a moment's on ever larger ones, up to 0.05 to 0.1 seconds each."""
    done, portion = 0, max(100_000 // max(desc.samples, 1), 1)
    while True:
        many.count = min(portion, len(status) - done)
        began = perf_counter()
        worst = lib.wiggly_batch_solve_many(batch.at, addressof(desc), addressof(many))
        if worst >= Status.ARGUMENT and not (status[done : done + many.count] >= Status.ARGUMENT).any():  # of what they share
            report(worst)
        done += many.count
        if done == len(status):
            return
        portion *= 2 if perf_counter() - began < 0.05 else 1
        for name in (*INPUTS, *OUTPUTS):
            rows = getattr(many, name)
            rows.at = rows.at and rows.at + 8 * rows.by_spline * many.count
        many.status, many.knot = status[done:].ctypes.data, many.knot + status.itemsize * many.count


def solve_many(
    spline: Spline,
    times: ArrayLike,
    values: ArrayLike,
    n: int,
    fps: float = 24,
    *,
    slopes: ArrayLike | None = None,
    stiffnesses: ArrayLike | None = None,
    phases: ArrayLike | None = None,
    still: ArrayLike | None = None,
    settles: ArrayLike | None = None,
    parts: tuple[str, ...] = ("total",),
    threads: int | None = None,
    check: bool = True,
) -> Many:
    """Solves many splines that differ only in their knots: the same bits as one by one.

    Parameters
    ----------
    spline : Spline
        The parameters of all; its own knots are not read.
    times, values : array_like, broadcast to (count, k)
        Seconds, and values. A time that is NaN or masked is no knot, so that splines may have fewer than k.
    n, fps : int, float
        Samples of each, and samples per second.
    slopes, stiffnesses, phases, still, settles : array_like, broadcast to (count, k), optional
        As in `Knot`; NaN or masked: no slope, a free phase. `still`, `settles` above 0: a knot that is.
    parts : tuple of {"total", "y", "re", "im"}
        Which arrays to fill.
    threads : int, optional
        1 to 256; by default one for each processor that this process may use.
    check : bool
        Whether the first spline with an error raises it. If not, its rows are NaN and its status says why.

    Returns
    -------
    Many

    Examples
    --------
    >>> import numpy as np
    >>> values = np.random.default_rng(1).normal(size=(1000, 3))
    >>> many = solve_many(Spline(frequency=1.5, damping=0.1), [0, 1, 2], values, 97)
    >>> many.total.shape
    (1000, 97)
    >>> bool((many.total[:, 48] == values[:, 2]).all())
    True
    """
    given = [a for a in (times, values, slopes, stiffnesses, phases, still, settles) if a is not None]
    shape = np.broadcast_shapes((1, 1), *(np.shape(a) for a in given))
    if len(shape) != 2:
        raise ValueError(f"times, values: expected arrays that broadcast to (count, knots), got {shape}")
    count, k = shape
    desc, _knots = spline._describe(n, fps, np.zeros(len(spline.times)))
    many, keep = CMany(size=sizeof(CMany), count=count, knot_count=k), []
    inputs = (nearest_samples(numbers(times), fps), values, slopes, stiffnesses, phases, still, settles)
    for name, array in zip(INPUTS, inputs):
        rows, held = _rows(array, (count, k))
        setattr(many, name, rows)
        keep.append(held)
    out = {part: np.empty((count if part in parts else 0, n)) for part in OUTPUTS}
    if not set(parts) <= set(out):
        raise ValueError(f"parts: expected some of {', '.join(out)}, got {parts!r}")
    for part in parts:
        setattr(many, part, CRows(out[part].ctypes.data, n, 1))
    status, knot = np.zeros(count, np.intc), np.full(count, -1, np.intc)
    many.status, many.knot = status.ctypes.data, knot.ctypes.data
    room = k + (n if desc.has_low or desc.has_high else 0)
    batch = Handle(lib.wiggly_batch_create, lib.wiggly_batch_destroy, max(n, 1), room, _threads(threads))
    _solve(batch, desc, many, status)
    wrong = np.flatnonzero(status >= Status.ARGUMENT)
    if check and len(wrong):
        report(int(status[wrong[0]]), int(knot[wrong[0]]), int(wrong[0]))
    for part in parts:
        out[part][wrong] = np.nan
    return Many(**out, status=status)
