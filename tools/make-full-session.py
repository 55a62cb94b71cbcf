#!/usr/bin/env python3
"""Writes tests/replays/full.json and full.replay: eight splines with 200 knots, a tail that walks, and twenty
seconds with every panel, overlay and kind of drag in use, for the frame budget.

Run again only when the editor's targets or the scene change:
    tools/make-full-session.py SCENE_HASH
(the hash is in the message that a wrong one gives).
"""
import json
import math

from session_events import at, click, drag, key, scroll_inspector, write

NAMES = ["sway", "up", "curl", "lift", "twist", "nod", "walk", "bob"]


def spline(n, name):
    middle, gain = {"walk": (0, 0.4), "bob": (0.4, 0.1)}.get(name, (0, 1))
    values = [round(middle + gain * math.sin(2.1 * k + n), 3) for k in range(25)]
    knots = [{"frame": 4 + 9 * k + n % 3, "value": value} for k, value in enumerate(values)]
    for k in range(2, 25, 5):
        knots[k]["slope"] = round(gain * math.cos(k + n), 3)
    return {"name": name, "frequency": 0.5 + 0.25 * n, "damping": 0.1, "bandwidth": 0.08,
            "equilibrium": middle, "knots": knots}


def tail():
    channels = [{"spline": name, "axis": ("side", "up")[n % 2], "gain": 3} for n, name in enumerate(NAMES[:6])]
    return {"type": "tail", "name": "tail", "position": [{"spline": "walk"}, {"spline": "bob"}, 0], "channels": channels}


def circle(start, radius):
    return lambda u: f"{start}{radius * math.sin(2 * math.pi * u):+.2f},{radius * math.sin(4 * math.pi * u):.2f}"


key(0, "F9")  # all sections
scroll_inspector(2, -40)
scroll_inspector(8, -40)
key(10, "Home")
key(14, "O")
key(18, "P")
key(22, "Space")
# While it plays: a knot, all knots, the camera, the view.
drag(30, 120, "stage(0.3,0.5)", lambda u: f"stage({0.3 + 0.3 * u:.3f},0.5)", button="right")
drag(170, 120, "knot(sway,12)", lambda u: f"curve(sway,112,{math.sin(9 * u):.4f})")
key(300, "A", "ctrl")
drag(304, 100, "knot(sway,9)", lambda u: f"curve(sway,{85 + 3 * math.sin(6 * u):.3f},{0.8 * math.cos(6 * u):.4f})")
key(410, "Z", "ctrl")
scroll_inspector(412, 40)
drag(414, 60, "slider(frequency)", lambda u: f"slider(frequency,{0.5 + 2 * u:.4f})")
scroll_inspector(477, -40)
click(477, "widget(section.advanced)")
drag(480, 60, "slider(bandwidth)", lambda u: f"slider(bandwidth,{0.08 + 0.2 * u:.4f})")
# Fit every curve to the active one's height, then another spline, and the wheel.
key(550, "N")
key(554, "PageDown")
for n in range(40):
    at(560 + 2 * n, f"wheel 0 {1 if n < 20 else -1} @stage(0.5,0.5)")
    at(561 + 2 * n, f"wheel 0 {1 if n < 20 else -1} @curve(up,100,0)")
key(650, "Home")
key(654, "N")
# Paused: scrubbing, the tail by its tip, a body that the tail follows.
key(660, "Space")
drag(664, 60, "ruler(20)", lambda u: f"ruler({20 + 180 * u:.3f})")
click(730, "ruler(60)")
drag(736, 120, "tail(tail,0.95)", lambda u: f"tail(tail,0.95){6 * math.sin(9 * u):+.2f},{4 * math.cos(9 * u):.2f}")
drag(870, 150, "body(tail)", lambda u: f"stage({0.4 + 0.15 * math.sin(9 * u):.4f},{0.6 + 0.05 * math.cos(9 * u):.4f})")
# Playing again, with panel sizes.
key(1030, "Space")
drag(1040, 60, "divider(stage)", circle("stage(0.5,1)", 40))
drag(1110, 60, "divider(inspector)", circle("divider(inspector)", 3))

scene = {"wiggly": 1, "fps": 24, "frames": [0, 240], "splines": [spline(n, name) for n, name in enumerate(NAMES)],
         "rigs": [tail()]}
with open("tests/replays/full.json", "w") as file:
    json.dump(scene, file)
with open("tests/replays/full.replay", "w") as file:
    write(file, "make-full-session.py")
