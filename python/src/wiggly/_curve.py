"""A solved spline."""

from __future__ import annotations

from ctypes import addressof, sizeof
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._library import CCurve, Status, lib, numbers


class Curve:
    """A solved spline: arrays of one number a sample, and the curve in between.

    Attributes
    ----------
    total : ndarray of float64, shape (n,)
        What you keyed and show, y + Re x. At a knot it is exactly the knot's value.
    y : ndarray of float64, shape (n,)
        The equilibrium, which x swings about.
    re, im : ndarray of float64, shape (n,)
        Re x and Im x; the latter is 0 except in complex mode.
    omega : ndarray of float64, shape (n,)
        The band's centre, rad/s.
    status : Status
        `Status.OK`, or how the curve differs from its description.

    Examples
    --------
    >>> from wiggly import Spline
    >>> curve = Spline([(0, 0), (1, 1)], frequency=2, damping=0.1).solve(73)
    >>> round(curve(1.0), 12)
    1.0
    >>> curve([0.5, 1.0, 1.5]).shape
    (3,)
    >>> curve.lagged([0, 0.4, 0.8]).shape
    (3, 73)
    """

    total: NDArray[np.float64]
    y: NDArray[np.float64]
    re: NDArray[np.float64]
    im: NDArray[np.float64]
    omega: NDArray[np.float64]

    def __init__(self, n: int, step: float) -> None:
        self._hold(np.zeros((6, n)), CCurve(sizeof(CCurve), samples=n, step=step, knot=-1))
        self.status = Status.OK

    def _hold(self, block: NDArray[np.float64], struct: CCurve) -> None:
        self._block, self._struct = block, struct
        self.total, self.y, self.re, self.im, self.omega, _ = block
        at = (block.ctypes.data + 8 * block.shape[1] * row for row in range(6))
        struct.total, struct.y, struct.re, struct.im, struct.omega, struct.slope = at
        self._at = addressof(struct)

    def __getstate__(self) -> tuple[NDArray[np.float64], bytes, Status]:
        return self._block, bytes(self._struct), self.status

    def __setstate__(self, state: tuple[NDArray[np.float64], bytes, Status]) -> None:
        self._hold(state[0], CCurve.from_buffer_copy(state[1]))
        self.status = state[2]

    def __len__(self) -> int:
        return int(self._struct.samples)

    def __repr__(self) -> str:
        return f"<wiggly.Curve of {len(self)} samples, {self.fps:g} a second>"

    @property
    def fps(self) -> float:
        """Samples per second."""
        return float(1 / self._struct.step)

    @property
    def times(self) -> NDArray[np.float64]:
        """Seconds of each sample, shape (n,)."""
        return np.asarray(np.arange(len(self)) * self._struct.step)

    @property
    def x(self) -> NDArray[np.complex128]:
        """The swing about the equilibrium, shape (n,)."""
        return self.re + 1j * self.im

    @property
    def error(self) -> float:
        """The estimated largest error, as a part of the total's range or size, whichever is larger."""
        return float(self._struct.error)

    def lagged(self, angles: ArrayLike) -> NDArray[np.float64]:
        """The totals of parts that lag, y + Re(e^(-j angle) x).

        Parameters
        ----------
        angles : array_like, shape (k,)
            Radians. 2 pi is one period.

        Returns
        -------
        ndarray of float64, shape (k, n)
            One row a part; of a single angle (n,).
        """
        angle = numbers(angles)[..., None]
        return np.asarray(self.y + np.cos(angle) * self.re + np.sin(angle) * self.im)

    def __call__(self, t: ArrayLike, lag: ArrayLike = 0) -> Any:
        """The total at a time, or that of a part that lags.

        Parameters
        ----------
        t : float or array_like
            Seconds. Beyond the ends the curve stands still; a loop goes round.
        lag : float or array_like
            Radians.

        Returns
        -------
        float, or ndarray of float64 of the shape that `t` and `lag` broadcast to; NaN where a time is.
        """
        return self._read(t, lag, False)

    def derivative(self, t: ArrayLike, lag: ArrayLike = 0) -> Any:
        """The same for the change per second.

        >>> from wiggly import Spline
        >>> curve = Spline([(0, 0, 0.5), (2, 1, 0.5)], mode="cubic").solve(49)
        >>> round(curve.derivative(1.0), 2)
        0.5
        """
        return self._read(t, lag, True)

    def _read(self, t: ArrayLike, lag: ArrayLike, moving: bool) -> Any:
        seconds, lag = numbers(t, "C"), numbers(lag)
        values = np.empty((*seconds.shape, 3))
        lib.wiggly_evaluate_many(self._at, seconds.ctypes.data, seconds.size, *(None, values.ctypes.data)[:: 1 if moving else -1])
        y, re, im = np.moveaxis(values, -1, 0)
        out = y + re if lag.ndim == 0 and not lag else y + np.cos(lag) * re + np.sin(lag) * im
        return out if np.ndim(out) else float(out)
