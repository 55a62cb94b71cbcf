"""The C library by ctypes: its structures, its functions, its statuses."""

from __future__ import annotations

import ctypes
import os
import sys
import threading
import warnings
from ctypes import POINTER, Structure, byref, c_bool, c_double, c_int, c_size_t, c_ssize_t, c_void_p
from ctypes.util import find_library
from enum import IntEnum
from pathlib import Path
from typing import Callable, Literal, NoReturn

import numpy as np
from numpy.typing import ArrayLike, NDArray


class Status(IntEnum):
    """How a solve ended. From `ARGUMENT` on it is an error, and nothing was solved."""

    OK = 0
    CALMED = 1
    LEVELLED = 2
    INEXACT = 3
    SINGULAR = 4
    ARGUMENT = 16
    SIZE = 17
    MEMORY = 18
    CAPACITY = 19
    NUMBER = 20
    LOOP = 21
    LIMITS = 22
    KNOT_NUMBER = 23
    KNOT_OUTSIDE = 24
    KNOT_TWICE = 25
    KNOT_STILL = 26
    KNOT_LIMIT = 27
    PIN = 28

    @property
    def sentence(self) -> str:
        """The library's sentence for people, without a full stop."""
        return str(lib.wiggly_status_text(self).decode())


class WigglyWarning(UserWarning):
    """A curve that was solved, but not as it was described; its `Curve.status` says how."""


class Error(ValueError):
    """Why nothing was solved.

    Attributes
    ----------
    status : Status or None
        None where the fault was found before the library was called.
    knot : int or None
        Index of the knot that the error is about.
    spline : int or None
        Index of the spline, of several.
    """

    def __init__(self, text: str, status: Status | None = None, knot: int | None = None, spline: int | None = None) -> None:
        super().__init__(text)
        self.status, self.knot, self.spline = status, knot, spline

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self.args[0], self.status, self.knot, self.spline)


def report(code: int, knot: int = -1, spline: int | None = None) -> None:
    """Raises an error, or warns, as a status asks for."""
    status = Status(code)
    text = status.sentence
    if knot >= 0:
        text = f"knot {knot}: {text}"
    if spline is not None:
        text = f"spline {spline}, {text}" if knot >= 0 else f"spline {spline}: {text}"
    if status >= Status.ARGUMENT:
        raise Error(text, status, knot if knot >= 0 else None, spline)
    if status:
        warn(text)


def warn(text: str) -> None:
    """Warns at the caller's line outside of this package."""
    level, frame = 1, sys._getframe()
    while frame.f_back and frame.f_globals.get("__package__") == __package__:
        level, frame = level + 1, frame.f_back
    warnings.warn(text, WigglyWarning, stacklevel=level)


def numbers(array: ArrayLike, order: Literal["C"] | None = None) -> NDArray[np.float64]:
    """As float64, not copied if they are; NaN where they are masked."""
    given = np.asanyarray(array, dtype=float, order=order)
    return given.filled(np.nan) if isinstance(given, np.ma.MaskedArray) else np.asarray(given)


# --- structures of wiggly.h and more.h -----------------------------------------------------------------------------------

KNOT = np.dtype(
    [("sample", "i4"), ("has_slope", "?"), ("has_phase", "?"), ("still", "?"), ("settles", "?"),
     ("value", "f8"), ("slope", "f8"), ("stiffness", "f8"), ("phase", "f8")], align=True)  # fmt: skip
MODES = {"complex": 0, "real": 1, "cubic": 2}
STARTS = {"free": 0, "rest": 1, "loop": 2}
PASSIVES = {"oscillator": 0, "filter": 1}
SOLVERS = {"chain": 0, "band": 1}


class CParam(Structure):
    _fields_ = [("value", c_double), ("track", c_void_p)]


class CDesc(Structure):
    _fields_ = [
        ("size", c_size_t), ("knots", c_void_p), ("knot_count", c_int), ("samples", c_int), ("step", c_double),
        ("mode", c_int), ("start", c_int), ("passive", c_int),
        ("frequency", CParam), ("damping", CParam), ("bandwidth", CParam), ("equilibrium", CParam),
        ("calm", c_double), ("wind_up", c_double), ("low", c_double), ("high", c_double), ("variation", c_double),
        ("has_calm", c_bool), ("has_low", c_bool), ("has_high", c_bool), ("variation_seed", c_int),
    ]  # fmt: skip


class CCurve(Structure):
    _fields_ = [
        ("size", c_size_t),
        ("total", c_void_p), ("y", c_void_p), ("re", c_void_p), ("im", c_void_p), ("omega", c_void_p), ("slope", c_void_p), ("floats", c_void_p),
        ("stride", c_size_t), ("samples", c_int), ("first", c_int), ("step", c_double), ("before", c_double * 2),
        ("mode", c_int), ("start", c_int), ("error", c_double), ("refinements", c_int), ("knot", c_int),
    ]  # fmt: skip


class CRows(Structure):
    """wiggly_numbers and wiggly_rows."""

    _fields_ = [("at", c_void_p), ("by_spline", c_ssize_t), ("by_number", c_ssize_t)]


class CMany(Structure):
    _fields_ = [
        ("size", c_size_t), ("count", c_int), ("knot_count", c_int),
        ("sample", CRows), ("value", CRows), ("slope", CRows), ("stiffness", CRows), ("phase", CRows), ("still", CRows),
        ("settles", CRows),
        ("total", CRows), ("y", CRows), ("re", CRows), ("im", CRows), ("status", c_void_p), ("knot", c_void_p),
    ]  # fmt: skip


class CPull(Structure):
    _fields_ = [("spline", c_int), ("c", c_double * 2 * 3)]


class CPin(Structure):
    _fields_ = [("sample", c_int), ("pulls", POINTER(CPull)), ("pull_count", c_int), ("to", c_double * 3), ("left", c_double * 3)]


class CBound(Structure):
    _fields_ = [("sample", c_int), ("c", c_void_p), ("least", c_double), ("push", c_double), ("left", c_double)]


class CExplanation(Structure):
    _fields_ = [("frequency", c_double), ("damping", c_double), ("cost", c_double)]


class CPoles(Structure):
    _fields_ = [("s", c_double * 2 * 2), ("z", c_double * 2 * 2)]


# --- the library itself --------------------------------------------------------------------------------------------------


def _open() -> ctypes.CDLL:
    """From $WIGGLY_LIBRARY, else this package's folder (a wheel), else the build folder above it, else the system's."""
    here = Path(__file__).resolve().parent
    tree = here.parent.parent.parent / "build"
    newest = sorted(tree.glob("libwiggly.so.*"), key=os.path.getmtime)[-1:]
    beside = [*here.glob("libwiggly.*"), *here.glob("wiggly.dll"), *newest]
    path = os.environ.get("WIGGLY_LIBRARY") or next(map(str, beside), None) or find_library("wiggly")
    if not path:
        raise ImportError("libwiggly was not found: install a wheel, run `make library`, or set WIGGLY_LIBRARY to the file")
    return ctypes.CDLL(path)


lib = _open()


def _declare(name: str, result: type | None, *arguments: type) -> None:
    function = getattr(lib, name)
    function.restype, function.argtypes = result, arguments


_declare("wiggly_version", ctypes.c_char_p)
_declare("wiggly_status_text", ctypes.c_char_p, c_int)
_declare("wiggly_create", c_int, c_int, c_int, c_void_p)
_declare("wiggly_destroy", None, c_void_p)
_declare("wiggly_solve", c_int, c_void_p, c_void_p, c_void_p)
_declare("wiggly_set_method", None, c_void_p, c_int)
_declare("wiggly_evaluate_many", None, c_void_p, c_void_p, c_size_t, c_void_p, c_void_p)
_declare("wiggly_batch_create", c_int, c_int, c_int, c_int, c_void_p)
_declare("wiggly_batch_destroy", None, c_void_p)
_declare("wiggly_batch_solve_many", c_int, c_void_p, c_void_p, c_void_p)
_declare("wiggly_group_create_bounded", c_int, c_int, c_int, c_int, c_int, c_int, c_void_p)
_declare("wiggly_group_destroy", None, c_void_p)
_declare("wiggly_group_set_method", None, c_void_p, c_int)
_declare("wiggly_group_solve_bounded", c_int, c_void_p, c_void_p, c_void_p, c_void_p, c_int, c_void_p, c_int, c_void_p, c_int)
_declare("wiggly_explain", c_int, c_void_p, c_void_p)
_declare("wiggly_from_spring", None, c_double, c_double, c_void_p, c_void_p)
_declare("wiggly_poles_at", CPoles, c_void_p, c_int)


def version() -> str:
    """The version of the C library, "major.minor.patch"."""
    return str(lib.wiggly_version().decode())


class Handle:
    """What a `create` function of the library made, until nobody holds this object."""

    at: int | None = None
    """Its address."""

    def __init__(self, create: Callable[..., int], destroy: Callable[[int], None], *room: int) -> None:
        handle = c_void_p()
        self._destroy = destroy
        report(create(*room, byref(handle)))
        self.at = handle.value

    def __reduce__(self) -> NoReturn:
        raise TypeError("memory of the library cannot be copied or pickled")

    def __del__(self) -> None:
        if self.at:
            self._destroy(self.at)


class _Shared(threading.local):
    handle: Handle | None = None
    samples = knots = 0


_shared = _Shared()


def shared_solver(samples: int, knots: int) -> int | None:
    """The address of this thread's solver, with at least this room."""
    if _shared.handle is None or samples > _shared.samples or knots > _shared.knots:
        samples, knots = max(samples, 1, _shared.samples), max(knots, 16, _shared.knots)
        _shared.handle = Handle(lib.wiggly_create, lib.wiggly_destroy, samples, knots)
        _shared.samples, _shared.knots = samples, knots
    return _shared.handle.at
