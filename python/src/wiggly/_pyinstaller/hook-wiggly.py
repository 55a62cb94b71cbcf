"""PyInstaller sees no library that ctypes opens by a path."""

from wiggly._library import lib

binaries = [(lib._name, "wiggly")]
