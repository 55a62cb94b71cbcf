"""Knots and parameters, and how they are solved."""

from __future__ import annotations

import copy
import weakref
from collections.abc import Iterable
from ctypes import addressof, byref, c_double, sizeof
from typing import Any, NamedTuple, NoReturn, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._curve import Curve
from ._library import (
    KNOT,
    MODES,
    PASSIVES,
    SOLVERS,
    STARTS,
    CDesc,
    CExplanation,
    CParam,
    Handle,
    Status,
    lib,
    numbers,
    report,  # fmt: skip
    shared_solver,
)

Limits = tuple[Optional[float], Optional[float]]


class Knot(NamedTuple):
    """What the curve goes through. A pair (time, value) is a knot, too."""

    time: float
    """Seconds."""
    value: float = 0
    """Of the total; ignored at a still knot."""
    slope: float | None = None
    """Value per second; None: free."""
    stiffness: float | None = None
    """1/s, the cost of missing the slope; None: 1000, which is firm."""
    phase: float | None = None
    """Im x, which makes the knot a pose that holds lagging parts, too; None: free."""
    still: bool = False
    """The motion comes to rest and begins again from rest."""
    settles: bool = False
    """The equilibrium comes to the value and stays: the curve overshoots and swings about it. Not in cubic mode."""


def read_knots(knots: Iterable[Any] | NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[Any]]:
    """Times in seconds, and the library's knots without their samples."""
    if isinstance(knots, np.ndarray) and knots.dtype != object:
        if knots.ndim != 2 or knots.shape[1] != 2:
            raise ValueError(f"knots: expected an array of shape (n, 2), got {knots.shape}")
        if isinstance(knots, np.ma.MaskedArray):
            knots = knots.data[~np.ma.getmaskarray(knots).any(axis=1)]
        native = np.zeros(len(knots), KNOT)
        native["value"] = knots[:, 1]
        return knots[:, 0].astype(float), native
    times, rows = [], []
    for knot in knots:
        parts: list[Any] = [None if part is np.ma.masked else part for part in knot]
        time, value, slope, stiffness, phase, still, settles = Knot(*parts)
        times.append(time)
        rows.append(
            (0, slope is not None, phase is not None, still, settles, value, slope or 0, stiffness or 0, phase or 0))
    return np.array(times, float), np.array(rows, KNOT)


def nearest_samples(times: NDArray[np.float64], fps: float) -> NDArray[np.float64]:
    """The sample nearest to each time; of two, the later one."""
    return np.asarray(np.floor(times * fps + 0.5))


def word(name: str, value: str, words: dict[str, int]) -> int:
    """The number of a word."""
    if value not in words:
        raise ValueError(f"{name}: expected {', '.join(words)}, got {value!r}")
    return words[value]


class Spline:
    """Knots and how the curve between them swings.

    Parameters
    ----------
    knots : iterable of Knot or (time, value), or array_like of shape (k, 2)
        Times in seconds. A knot sits on the sample nearest to its time, floor(time * fps + 1/2); two on one sample are an error.
        A masked row of an array is no knot.
    frequency : float or array_like of shape (n,)
        Hz, undamped; 0: no swing. An array is a track, one number a sample. You may change the numbers of a NumPy array later.
    damping : float or array_like of shape (n,)
        Ratio: 0 swings on, 1 is critical, more (in real mode only) creeps.
    bandwidth : float or array_like of shape (n,)
        How far the frequency may shift between knots, as a fraction of it, 0 to 1; complex mode only.
    calm : float
        The cost of a swing at the start, 0 to 1; 0 is the paper's formula.
    wind_up : float
        How long before a knot the motion is pushed, in periods there; after the knot it swings freely. 0: the whole curve at once.
    equilibrium : float or array_like of shape (n,)
        What the curve swings about, a value.
    mode : {"complex", "real", "cubic"}
        Swings with a free phase; as a damped spring; or not at all, the classical cubic spline. That is natural at its first knot and
        flat at its last one (with "filter" natural, too), or has the knot's slope there; after a flat end it stands still.
    start : {"free", "rest", "loop"}
        Mid-swing; at rest on the first sample; or round, where the last sample is the first one again.
    passive : {"oscillator", "filter"}
        How it moves by itself: as a damped spring, or as the paper's filter.
    limits : (low, high), optional
        The total stays between them; None: no limit on that side.
    variation, seed : float, int
        Another motion through the same knots, which strays by `variation` times the farthest knot; the seed chooses it.

    Attributes
    ----------
    knots : list or ndarray
    parameters : dict
        What it was made of: `Spline(s.knots, **{**s.parameters, "damping": 0.2})` is the same with more damping.
    times : ndarray of float64, shape (k,)
        Seconds of the knots.

    Examples
    --------
    >>> import numpy as np
    >>> sway = Spline([(0, 0), (1, 1)], frequency=1.5, damping=0.1, start="rest")
    >>> curve = sway.solve(97, fps=24)
    >>> float(curve.total[24])
    1.0

    Without knots it follows through on something that moves:

    >>> walk = np.clip(np.arange(97) / 24, 0, 1)
    >>> tail = Spline(frequency=1.5, damping=0.1, equilibrium=walk).solve(97)
    >>> bool(tail.total.max() > 1)
    True
    """

    def __init__(
        self,
        knots: Iterable[Any] | NDArray[np.float64] = (),
        *,
        frequency: ArrayLike = 0,
        damping: ArrayLike = 0,
        bandwidth: ArrayLike = 0.1,
        calm: float = 1,
        wind_up: float = 0,
        equilibrium: ArrayLike = 0,
        mode: str = "complex",
        start: str = "free",
        passive: str = "oscillator",
        limits: Limits | None = None,
        variation: float = 0,
        seed: int = 0,
    ) -> None:
        self.knots = knots if isinstance(knots, np.ndarray) else list(knots)
        self.parameters: dict[str, Any] = dict(
            frequency=frequency, damping=damping, bandwidth=bandwidth, calm=calm, wind_up=wind_up, equilibrium=equilibrium, mode=mode, start=start,
            passive=passive, limits=limits, variation=variation, seed=seed)  # fmt: skip
        self.times, self._knots = read_knots(self.knots)
        self._tracks: list[NDArray[np.float64]] = []
        self._fixed: list[weakref.ref[NDArray[np.float64]]] = []
        self._followed: list[tuple[NDArray[np.float64], NDArray[Any]]] = []
        self._desc = desc = CDesc(sizeof(CDesc), calm=calm, wind_up=wind_up, has_calm=True)
        desc.mode, desc.start, desc.passive = word("mode", mode, MODES), word("start", start, STARTS), word("passive", passive, PASSIVES)
        if not 0 <= seed < 2**31:
            raise ValueError(f"seed: expected a whole number from 0 to 2**31 - 1, got {seed!r}")
        desc.variation, desc.variation_seed = variation, seed
        if limits is not None:
            low, high = limits
            desc.low, desc.has_low = low or 0, low is not None
            desc.high, desc.has_high = high or 0, high is not None
        desc.frequency, desc.damping = self._param(frequency), self._param(damping)
        desc.bandwidth, desc.equilibrium = self._param(bandwidth), self._param(equilibrium)

    def __getstate__(self) -> tuple[Any, ...]:
        own = vars(Spline())
        return self.knots, self.parameters, {name: value for name, value in vars(self).items() if name not in own}

    def __setstate__(self, state: tuple[Any, ...]) -> None:
        knots, parameters, others = state
        Spline.__init__(self, knots, **parameters)
        vars(self).update(others)

    def __repr__(self) -> str:
        return f"<wiggly.Spline through {len(self.times)} knots>"

    def _param(self, number: ArrayLike) -> CParam:
        if isinstance(number, (int, float)):
            return CParam(number)
        track = numbers(number, "C")
        if track.ndim == 0:
            return CParam(float(track))
        if isinstance(number, np.ndarray) and not np.may_share_memory(track, number):
            self._followed.append((track, number))
        self._tracks.append(track[:])  # a view: your array may get another shape or type, and the library still reads what is there
        self._fixed.append(weakref.ref(track))  # NumPy resizes no array that is referred to
        return CParam(0, track.ctypes.data)

    def _describe(self, n: int, fps: float, samples: NDArray[Any] | None = None) -> tuple[CDesc, NDArray[Any]]:
        """The library's description at a rate, and the knots that it points to."""
        for track in self._tracks:
            if track.shape != (n,):
                raise ValueError(f"a track: expected an array of shape ({n},), one number a sample, got {track.shape}")
        if not fps > 0:
            raise ValueError(f"fps: expected a number above 0, got {fps!r}")
        follow(self._followed)
        knots = self._knots.copy()
        if samples is None:
            samples = nearest_samples(self.times, fps)
        far = np.abs(samples)
        if not far.max(initial=0) < 2**31:  # NaN, or beyond the library's int
            report(Status.KNOT_OUTSIDE, int((~(far < 2**31)).argmax()))
        knots["sample"] = samples
        desc = CDesc.from_buffer_copy(self._desc)
        desc.knots, desc.knot_count, desc.samples, desc.step = knots.ctypes.data, len(knots), n, 1 / fps
        return desc, knots

    def _room(self, n: int) -> int:
        return len(self._knots) + (n if self._desc.has_low or self._desc.has_high else 0)

    def solve(self, n: int, fps: float = 24, *, solver: str = "chain") -> Curve:
        """The curve of `n` samples.

        Parameters
        ----------
        n : int
            Samples; the last is at (n - 1) / fps seconds.
        fps : float
            Samples per second.
        solver : {"chain", "band"}
            From knot to knot, fast; or the band of all samples, as in the paper. They differ only by rounding.

        Returns
        -------
        Curve

        Raises
        ------
        Error
            With the library's sentence and the knot's index.

        Warns
        -----
        WigglyWarning
            If the curve was solved, but not as it was described.
        """
        curve = Curve(n, 1 / fps if fps > 0 else 0)
        desc, _knots = self._describe(n, fps)
        solve_into(shared_solver(n, self._room(n)), desc, curve, solver)
        return curve

    def prepare(self, n: int, fps: float = 24) -> Solver:
        """A solver with its own memory, for solving again and again while knots move."""
        return Solver(self, n, fps)

    def poles(self, fps: float = 24, sample: int = 0) -> Poles:
        """The two poles of the filter at a sample (sections 4 and 5 of the paper).

        >>> Spline(frequency=1, damping=0.5, mode="real").poles().s.real.round(3).tolist()
        [-3.142, -3.142]
        """
        n = len(self._tracks[0]) if self._tracks else sample + 1
        if not 0 <= sample < n:
            raise ValueError(f"sample: expected 0 or more, and one that the tracks have, got {sample!r}")
        desc, _knots = self._describe(n, fps, np.zeros(len(self._knots)))
        desc.knot_count = 0
        poles = lib.wiggly_poles_at(addressof(desc), sample)
        return Poles(*(np.array(pair, dtype=float).view(complex)[:, 0] for pair in (poles.s, poles.z)))


def follow(tracks: list[tuple[NDArray[np.float64], NDArray[Any]]]) -> None:
    """Copies arrays that the library cannot read itself, for they are of another type or have gaps."""
    for track, array in tracks:
        if array.shape != track.shape:
            raise ValueError(f"a track: expected an array of shape {track.shape} as before, got {array.shape}")
        track[:] = numbers(array)


def solve_into(solver: int | None, desc: CDesc, curve: Curve, method: str = "chain") -> None:
    """Solves with a solver's address; warns or raises."""
    lib.wiggly_set_method(solver, word("solver", method, SOLVERS))
    code = lib.wiggly_solve(solver, addressof(desc), curve._at)
    if code:
        report(code, curve._struct.knot)
        curve.status = Status(code)


class Solver:
    """A prepared spline whose knots change in place: nothing is allocated in `solve`.

    A copy has memory of its own, and a pickled solver is prepared anew where it is read.

    Attributes
    ----------
    knots : structured ndarray, shape (k,)
        The library's own knots. Write to them: `knots["value"][1] = 0.7`; also "sample", "slope", "phase" and the flags
        "has_slope", "has_phase", "still", "settles". An array that you assign is copied into them; its shape must be theirs.
    curve : Curve
        What `solve` fills, read only. Its arrays are the same at every solve; copy what you keep.

    Examples
    --------
    >>> solver = Spline([(0, 0), (1, 1)], frequency=2).prepare(73)
    >>> value = solver.knots["value"]
    >>> value[1] = 0.7
    >>> float(solver.solve().total[24])
    0.7
    """

    def __init__(self, spline: Spline, n: int, fps: float = 24) -> None:
        self._prepare(spline, n, fps, Curve(n, 1 / fps if fps > 0 else 0))

    def _prepare(self, spline: Spline, n: int, fps: float, curve: Curve) -> None:
        self._made_of, self._curve = (spline, n, fps), curve
        self._desc, self._memory = spline._describe(n, fps)
        self._followed = spline._followed
        self._held = *spline._tracks, curve._struct, curve._block  # what the library reads and writes, whatever becomes of spline and curve
        self._knots = self._memory[:]  # a view cannot be resized
        self._handle = Handle(lib.wiggly_create, lib.wiggly_destroy, max(n, 1), spline._room(n))
        self._call = lib.wiggly_solve
        self._arguments = (self._handle.at, addressof(self._desc), curve._at)

    def __getstate__(self) -> tuple[Any, ...]:
        return *self._made_of, copy.deepcopy(self._curve), self._memory.copy()

    def __setstate__(self, state: tuple[Any, ...]) -> None:
        *made_of, knots = state
        self._prepare(*made_of)
        self.knots = knots

    @property
    def knots(self) -> NDArray[Any]:
        return self._knots

    @knots.setter
    def knots(self, knots: NDArray[Any]) -> None:
        given, own = np.asarray(knots), self._memory
        if given.dtype != own.dtype or given.shape != own.shape:
            raise ValueError(f"knots: expected an array of shape {own.shape} like the solver's own, got {given.dtype} of shape {given.shape}")
        own[:] = given

    @property
    def curve(self) -> Curve:
        return self._curve

    @curve.setter
    def curve(self, curve: Curve) -> NoReturn:
        raise AttributeError("curve: a solver fills the same curve each time; copy it, or the solver, to keep one")

    def solve(self) -> Curve:
        """Solves the knots as they are now into `curve`, and returns it."""
        follow(self._followed)
        code = self._call(*self._arguments)
        curve = self._curve
        if code or curve.status:
            report(code, curve._struct.knot)
            curve.status = Status(code)
        return curve


class Poles(NamedTuple):
    """The two poles of a filter."""

    s: NDArray[np.complex128]
    """Continuous, 1/s, shape (2,)."""
    z: NDArray[np.complex128]
    """Discrete, exp(s / fps), shape (2,)."""


class Explanation(NamedTuple):
    """An oscillation that may explain knots."""

    frequency: float
    """Hz."""
    damping: float
    """Ratio."""
    cost: float
    """The lower the better; a difference of 1 is e times less likely."""


def explain(knots: Iterable[Any] | NDArray[np.float64], *, fps: float = 24, mode: str = "complex", equilibrium: float = 0) -> list[Explanation]:
    """The frequency and damping that explain knots best, and the runner-up.

    Returns
    -------
    list of Explanation
        At most two, the best first; none where there are fewer than four knots.

    Examples
    --------
    >>> import numpy as np
    >>> t = np.arange(8) / 6
    >>> best = explain(np.column_stack([t, np.exp(-0.3 * t) * np.cos(2 * np.pi * 1.5 * t)]))[0]
    >>> round(best.frequency, 2)
    1.5
    """
    spline = Spline(knots, mode=mode, equilibrium=equilibrium)
    last = int(nearest_samples(spline.times, fps).max()) if len(spline.times) else 0
    desc, _knots = spline._describe(max(last, 0) + 1, fps)
    best = (CExplanation * 2)()
    return [Explanation(e.frequency, e.damping, e.cost) for e in best[: lib.wiggly_explain(addressof(desc), addressof(best))]]


def from_spring(k: float, gamma: float) -> tuple[float, float]:
    """Frequency (Hz) and damping ratio of a spring k (1/s²) and a friction gamma (1/s).

    >>> frequency, damping = from_spring(39.5, 1.2)
    >>> round(frequency, 3), round(damping, 3)
    (1.0, 0.095)
    """
    frequency, damping = c_double(), c_double()
    lib.wiggly_from_spring(k, gamma, byref(frequency), byref(damping))
    return frequency.value, damping.value
