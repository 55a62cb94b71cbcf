#!/usr/bin/env python3
"""Writes assets/demo/demo.replay: two minutes that `wiggly live --demo` plays, as targets, so that they hold in any window.

    tools/make-demo.py > assets/demo/demo.replay

Run it again after a change of what it shows; tests/app/test_app.c plays all of it. Nothing here depends on where a panel is.
"""
import math
import sys

import session_events
from session_events import at, key

SECOND = 60


def say(frame, text):
    """A caption, until the next one; escaped as a replay's texts are."""
    at(frame, "caption " + "".join(c if c.isalnum() or c in ",.:;'!-+" else "".join(f"%{b:02x}" for b in c.encode())
                                   for c in text))


def eased(u):
    return u * u * (3 - 2 * u)


def hold(frame, length, target, way, *mods):
    """Takes hold of a target and moves the pointer along way(u), in heights of the stage from where it was; releases."""
    at(frame, f"pointer @{target}")
    at(frame + 28, " ".join([f"press left @{target}", *mods]))
    before = (0, 0)
    for n in range(1, length + 1):
        now = way(n / length)
        at(frame + 28 + n, f"pointer @pointer({now[0] - before[0]:.5f},{now[1] - before[1]:.5f})")
        before = now
    at(frame + 30 + length, " ".join(["release left @pointer(0,0)", *mods]))


def to(frame, length, start, path):
    """The same along named places: path(u) is one."""
    at(frame, f"pointer @{start}")
    at(frame + 28, f"press left @{start}")
    for n in range(1, length + 1):
        at(frame + 28 + n, f"pointer @{path(eased(n / length))}")
    at(frame + 30 + length, f"release left @{path(1)}")


def to_and_fro(across, up, times):
    """Swings that begin and end softly where they began."""
    return lambda u: (across * math.sin(2 * math.pi * times * u) * math.sin(math.pi * u),
                      up * math.sin(math.pi * u) ** 2)


def pull(across, up):
    return lambda u: (across * eased(u), up * eased(u))


def example(t, words):
    """Opens one by its words."""
    key(t, "F3")
    for text in ("exa", words):
        for letter in text:
            t += 3
            at(t, f"text U+{ord(letter):04X}")
        t += 20
        key(t, "Enter")


def fox(t):
    say(t, "The curve hits every knot exactly and swings between them")
    t += 4 * SECOND
    say(t, "Drag the fox: its tail swings after it")
    hold(t + 40, 300, "body(tail)", to_and_fro(0.45, 0, 2.5))
    t += 9 * SECOND
    say(t, "Pull the tail: it is held where you let go")
    key(t + 20, "Space")
    hold(t + 40, 90, "tail(tail,0.95)", pull(-0.1, 0.35))
    hold(t + 190, 90, "tail(tail,0.95)", pull(0.3, -0.2))
    key(t + 330, "Space")
    return t + 8 * SECOND


def curves(t):
    say(t, "Drag a knot: the curve still hits every knot")
    to(t + 30, 150, "knot(sway,2)", round_and_round)
    t += 5 * SECOND
    say(t, "Double-click: a new knot, and the curve goes through it")
    at(t + 30, "pointer @ruler(100)")
    at(t + 60, "pointer @curve(sway,100,0.9)")
    at(t + 90, "double left @curve(sway,100,0.9)")
    at(t + 92, "release left @curve(sway,100,0.9)")
    t += 4 * SECOND
    say(t, "Feel: how fast it swings, and how soon it settles")
    to(t + 30, 100, "slider(frequency)", lambda u: f"slider(frequency,{1 + 1.4 * u:.4f})")
    to(t + 200, 100, "slider(damping)", lambda u: f"slider(damping,{0.08 + 0.3 * u:.4f})")
    t += 7 * SECOND
    say(t, "V: the same knots stiff, then cubic, then wiggly again")
    for n in range(3):
        key(t + 40 + 100 * n, "V")
    return t + 7 * SECOND


def round_and_round(u):
    """One and a half times round, from the fox's third knot to where the tail swings back."""
    turn = 3 * math.pi * u
    return f"curve(sway,{50 + 6 * math.cos(turn):.3f},{0.85 * math.cos(turn) + 0.7 * math.sin(turn):.4f})"


def record(t):
    say(t, "R while you drag the fox: its path becomes knots")
    key(t + 20, "Left", "shift")
    hold(t + 30, 240, "body(tail)", to_and_fro(0.5, 0, 2))
    key(t + 70, "R")
    t += 9 * SECOND
    say(t, "F10: light or dark colours")
    key(t + 30, "F10")
    return t + 4 * SECOND


def figures(t):
    say(t, "F3, Examples: figures of the paper to play with")
    example(t + 40, "figure 1")
    example(t + 180, "figure 6")
    to(t + 280, 120, "knot(sway,2)", lambda u: f"curve(sway,{54 + 22 * u:.3f},-0.9)")
    key(t + 500, "F10")
    return t + 9 * SECOND


def stage(t):
    say(t, "A soft bear: each part has its own lag")
    example(t + 20, "figure 7")
    t += 7 * SECOND
    say(t, "F5: the stage and the keys you press")
    key(t + 40, "F5")
    t += 4 * SECOND
    say(t, "Pins: drag a hand, and the rest swings")
    example(t + 20, "hands")
    hold(t + 90, 120, "pin(creature,0)", pull(-0.12, -0.15))
    hold(t + 290, 120, "pin(creature,0)", pull(0.12, 0.2))
    t += 10 * SECOND
    say(t, "Your own character: its tail and ears follow its walk")
    example(t + 20, "dog")
    hold(t + 120, 120, "chain(tail,0.9)", pull(0.12, 0.15))
    return t + 9 * SECOND


def end(t):
    key(t, "Escape")
    say(t, "Press a key or click to try it yourself")
    return t + 5 * SECOND


time = 0
for part in (fox, curves, record, figures, stage, end):
    time = part(time)
session_events.FRAMES = time
session_events.write(sys.stdout, "make-demo.py")
