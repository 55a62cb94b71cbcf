#!/usr/bin/env python3
"""Prints what frames cost in a scene of a million knots: at rest, while the curves are zoomed, while it plays, while a knot is dragged.

    tools/million.py build/wiggly [OTHER_BUILD]... [--splines 1000] [--rounds 3]

Builds take turns: with other load on the machine only their ratio counts. The knots are those of one spline, or of as many as asked
for; the first bends a tail. Headless runs solve in the frame that they draw; a window leaves to a thread what takes too long.
"""
import argparse
import csv
import json
import math
import os
import re
import subprocess
import tempfile

from session_events import at, drag, events, key

KNOTS, GAP, PHASE = 1000000, 2, 90
PHASES = ("rest", "zoom", "play", "edit, all in sight", "edit, zoomed in")


def scene(splines):
    knots = KNOTS // splines
    value = lambda s, k: round(math.sin(0.7 * k + s) * math.cos(0.00037 * k * (s + 1)), 4)
    return {"wiggly": 1, "fps": 24, "frames": [0, GAP * knots], "splines": [
        {"name": f"s{s}", "frequency": 1, "damping": 0.1, "knots": [{"frame": GAP * k, "value": value(s, k)} for k in range(knots)]}
        for s in range(splines)], "rigs": [{"type": "tail", "name": "tail", "position": [0, 0, 0],
                                            "channels": [{"spline": "s0", "axis": "side", "gain": 3}]}]}


def make_events(splines):
    middle = KNOTS // splines // 2
    place = f"curve(s0,{GAP * middle},0)"
    move = lambda u: f"curve(s0,{GAP * middle},{0.8 * math.cos(9 * u):.4f})"
    notches = math.log(GAP * middle / 60) / 0.15 / (PHASE / 2)
    key(2, "Home")
    for n in range(PHASE // 2):
        at(PHASE + n, f"wheel 0 {notches:.3f} @{place} ctrl")
        at(PHASE + PHASE // 2 + n, f"wheel 0 {-notches:.3f} @{place} ctrl")
    key(2 * PHASE, "Home")
    key(2 * PHASE + 2, "Space")
    key(3 * PHASE - 2, "Space")
    drag(3 * PHASE, PHASE - 8, f"knot(s0,{middle})", move)
    at(4 * PHASE - 4, f"wheel 0 {notches * PHASE / 2:.3f} @{place} ctrl")
    drag(4 * PHASE, PHASE - 4, f"knot(s0,{middle})", move)


def write_replay(path, scene_hash):
    with open(path, "w") as file:
        print(f"wiggly-replay 1\nversion 0.1.0\nsize 1280 720\nscale 1\nscene {scene_hash}\ndt 1/60", file=file)
        print(f"frames {PHASE * len(PHASES)}", file=file)
        for frame, text in sorted(events, key=lambda e: e[0]):
            print(frame, text, file=file)


def live(build, folder, *more):
    scene_file, replay = os.path.join(folder, "million.json"), os.path.join(folder, "million.replay")
    return subprocess.run([build, "live", "--headless", "--replay", replay, scene_file, *more], capture_output=True, text=True)


def find_hash(build, folder):
    """The scene's, which a replay of another scene is refused with."""
    write_replay(os.path.join(folder, "million.replay"), "0" * 16)
    refusal = live(build, folder).stderr
    return [word for word in re.findall(r"\b[0-9a-f]{16}\b", refusal) if word != "0" * 16][0]


def measure(build, folder):
    """Frame times of each phase, without its first ten frames."""
    log = os.path.join(folder, "million.csv")
    run = live(build, folder, "--log", log)
    if run.returncode:
        raise SystemExit(run.stderr)
    with open(log) as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return [[float(row["frame_ms"]) for row in rows[p * PHASE + 10:(p + 1) * PHASE]] for p in range(len(PHASES))]


def percentile(times, part):
    return sorted(times)[min(len(times) - 1, int(part * len(times)))]


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("builds", nargs="+")
    options.add_argument("--splines", type=int, default=1)
    options.add_argument("--rounds", type=int, default=3)
    options = options.parse_args()
    with tempfile.TemporaryDirectory(dir=os.environ.get("TMPDIR")) as folder:
        with open(os.path.join(folder, "million.json"), "w") as file:
            json.dump(scene(options.splines), file)
        make_events(options.splines)
        write_replay(os.path.join(folder, "million.replay"), find_hash(options.builds[0], folder))
        times = {build: [[] for _ in PHASES] for build in options.builds}
        for _ in range(options.rounds):
            for build in options.builds:
                for phase, found in zip(times[build], measure(build, folder)):
                    phase += found
    for p, phase in enumerate(PHASES):
        for build in options.builds:
            found = times[build][p]
            print(f"{phase:20} {percentile(found, 0.5):8.1f} ms p50 {percentile(found, 0.99):8.1f} p99  {build}")


if __name__ == "__main__":
    main()
