"""Wiggly: bones that swing through their keyframes."""
from . import settings, solve, ui

parts = settings, ui, solve


def register():
    for part in parts:
        part.register()


def unregister():
    for part in reversed(parts):
        part.unregister()
