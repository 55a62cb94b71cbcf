#!/usr/bin/env python3
"""Writes tests/replays/session.replay: twenty seconds of an animator's work on tests/replays/session.json, as targets.

Inserts, drags, nudges, retimes, deletes, grabs the tail, moves sliders, undoes and redoes, while it plays and while it does
not. Run again only when the editor's targets or the scene change:
    tools/make-session.py SCENE_HASH > tests/replays/session.replay
(the hash is in the message that a wrong one gives).
"""
import math
import sys

from session_events import at, click, drag, key, scroll_inspector, write


def curve(spline, from_to_frame, from_to_value, swing=0.0):
    (f0, f1), (v0, v1) = from_to_frame, from_to_value
    return lambda u: f"curve({spline},{f0 + (f1 - f0) * u:.3f},{v0 + (v1 - v0) * u + swing * math.sin(2 * math.pi * u):.4f})"


# While playing: drag the third knot up and slightly later, back and forth.
drag(40, 80, "knot(sway,2)", curve("sway", (56, 62), (0.4, 0.8), 0.4))
# Insert a knot by double-click and drag it across its neighbour.
at(140, "pointer @curve(sway,34,0.5)")
at(141, "press left @curve(sway,34,0.5)")
at(142, "release left @curve(sway,34,0.5)")
at(143, "double left @curve(sway,34,0.5)")
at(144, "release left @curve(sway,34,0.5)")
drag(150, 60, "knot(sway,2)", curve("sway", (34, 16), (0.5, -0.6), 0.2))
key(220, "Right", "alt", times=8)
key(246, "Up", "alt", times=10)
key(280, "Up", "alt", "shift", times=2)
# Retime finely with the value locked.
at(300, "pointer @knot(sway,4)")
at(301, "press left @knot(sway,4)")
key(303, "X")
for n in range(40):
    at(306 + n, f"pointer @curve(sway,{82 + 8 * math.sin(n / 12):.3f},0.3)")
at(348, "release left @curve(sway,82,0.3)")
# Slopes and stiffness on the selection.
key(352, "T")
key(356, "D", times=6)
key(376, "E", "shift", times=4)
drag(392, 30, "handle(sway,4,1)", lambda u: f"handle(sway,4,1)+0,{-1.5 if u < 0.5 else 1.5}")
# Sliders: each drag is one undo step.
drag(430, 40, "slider(frequency)", lambda u: f"slider(frequency,{1 + 1.2 * math.sin(math.pi * u):.4f})")
key(474, "F9")  # all sections
drag(480, 30, "slider(damping)", lambda u: f"slider(damping,{0.08 + 0.3 * u:.4f})")
scroll_inspector(512, -40)
click(513, "widget(section.advanced)")
drag(516, 30, "slider(bandwidth)", lambda u: f"slider(bandwidth,{0.08 + 0.2 * u:.4f})")
scroll_inspector(550, 40)
drag(552, 24, "slider(lag)", lambda u: f"slider(lag,{6.5 + 6 * u:.4f})")
# Hold keys for frequency, damping and lag.
for frame, letter in ((584, "F"), (604, "Z"), (624, "L")):
    at(frame, f"key {letter}")
    key(frame + 2, "Up", times=4)
    at(frame + 16, f"keyup {letter}")
# The comparison, one key.
key(650, "V")
key(680, "V")
key(700, "V")
# Pause, scrub, insert at the playhead, grab the tail by its tip.
key(704, "Space")
drag(710, 30, "ruler(40)", lambda u: f"ruler({40 + 26 * u:.3f})")
key(744, "I", "shift")
drag(750, 70, "tail(tail,0.95)", lambda u: f"stage({0.46 - 0.1 * math.sin(2 * math.pi * u):.4f},{0.36 - 0.12 * u:.4f})")
key(830, "Space")
# The other spline: drag while it plays, mode, delete.
key(836, "PageDown")
drag(842, 60, "knot(up,1)", curve("up", (44, 48), (-0.4, 0.5), 0.3))
key(910, "M", times=3, every=8)
click(936, "knot(up,2)")
key(942, "Delete")
key(950, "PageUp")
# Select all, nudge all, view.
key(956, "A", "ctrl")
key(960, "Right", "alt", times=3)
key(972, "Left", "alt", times=3)
key(984, "Escape")
at(988, "wheel 0 1 @curve(sway,60,0)")
at(992, "wheel 0 1 @curve(sway,60,0) ctrl")
at(996, "wheel 0 -2 @curve(sway,60,0) shift")
key(1000, "Home")
drag(1004, 40, "stage(0.15,0.2)", lambda u: f"stage({0.15 + 0.1 * math.sin(2 * math.pi * u):.4f},0.2)", button="right")
# Undo a series, redo most of it, drag once more.
key(1050, "Z", "ctrl", times=12)
key(1090, "Z", "ctrl", "shift", times=9)
drag(1124, 60, "knot(sway,0)", curve("sway", (8, 6), (1, 0.7), -0.3))

write(sys.stdout, "make-session.py")
