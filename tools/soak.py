#!/usr/bin/env python3
"""Works in the app without a display for as long as wanted, and prints how much memory it has in the course of it.

    tools/soak.py build/wiggly 60 [SCENE_OR_MODEL]...    for 60 minutes

A round drags, inserts, undoes and redoes, plays, opens the figures, dialogs and those files, changes sizes and themes, and exports;
then the next begins. Rounds are alike: what memory grows by from one to the next is not given back.
"""
import os
import re
import subprocess
import sys
import tempfile
import time

from session_events import at, events, key

wiggly, minutes, files = sys.argv[1], float(sys.argv[2]), [os.path.abspath(file) for file in sys.argv[3:]]
now = 0


def wait(frames):
    global now
    now += frames


def press(name, *mods, frames=4):
    key(now, name, *mods)
    wait(frames)


def text(string):
    for letter in string:
        at(now, f"text U+{ord(letter):04X}")
    wait(2)


def drag(x, y, dx, dy, frames=30, button="left"):
    at(now, f"pointer {x} {y}")
    at(now, f"press {button} {x} {y}")
    for n in range(1, frames + 1):
        at(now + n, f"pointer {x + dx * n / frames:.1f} {y + dy * n / frames:.1f}")
    at(now + frames + 1, f"release {button} {x + dx} {y + dy}")
    wait(frames + 4)


def edit():
    press("Space")
    for x in range(100, 900, 160):
        at(now, f"double left {x} 500")
        at(now + 1, f"release left {x} 500")
        wait(3)
        drag(x, 500, 30, 60)
    drag(500, 200, 120, -40)
    drag(300, 150, 80, 30, button="right")
    for _ in range(12):
        press("Z", "ctrl")
    for _ in range(12):
        press("Y", "ctrl")
    press("Space")


def show():
    for name in ("F1", "F10", "F10", "F5", "F3", "V"):
        press(name, frames=12)
        press("Escape" if name in ("F1", "F5") else name, frames=6)
    for size in ("960 600", "1280 720"):
        at(now, f"size {size}")
        wait(20)


def export(name):
    press("E", "ctrl")
    press("A", "ctrl")
    text(name)
    press("Return", frames=90)
    press("Escape")


def open_file(path):
    at(now, f"drop {path.replace('%', '%25').replace(' ', '%20')}")
    wait(4)
    press("D", frames=30)


def play_round():
    for figure in "1234567890":
        press(figure, "ctrl")
        press("D", frames=20)
        edit()
    show()
    for name in ("soak.glb", "soak.usda", "soak.csv", "soak.bvh"):
        export(name)
    for path in files:
        open_file(path)
        edit()
        export("soak.glb")


def header(scene, frames):
    return f"wiggly-replay 1\nversion 0.1.0\nsize 1280 720\nscale 1\nscene {scene}\ndt 1/60\nframes {frames}\n"


def run(folder, start):
    """Starts the app on a replay in that folder."""
    with open(os.path.join(folder, "soak.replay"), "w") as file:
        file.write(start)
    return subprocess.Popen([os.path.abspath(wiggly), "live", "--headless", "--replay", "soak.replay", "--log", "soak.csv"],
                            cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def status(app):
    with open(f"/proc/{app.pid}/status") as file:
        fields = dict(line.split(":\t", 1) for line in file)
    return {name: int(fields[name].split()[0]) for name in ("VmRSS", "RssAnon", "Threads")}


def watch(app):
    start, next_print = time.time(), 0
    print("minutes   resident   anonymous   threads  open files", flush=True)
    while app.poll() is None and time.time() - start < 60 * minutes:
        if time.time() - start >= next_print:
            seen = status(app)
            print(f"{next_print / 60:7.1f}  {seen['VmRSS'] / 1024:6.1f} MB   {seen['RssAnon'] / 1024:6.1f} MB  {seen['Threads']:8}"
                  f"  {len(os.listdir(f'/proc/{app.pid}/fd')):10}", flush=True)
            next_print += 60 if next_print >= 60 else 15
        time.sleep(0.5)


play_round()
lines = sorted(events, key=lambda event: event[0])
rounds = max(1, int(minutes * 60 * 300 / now))
with tempfile.TemporaryDirectory() as folder:
    os.environ.update({name: folder for name in ("XDG_CONFIG_HOME", "XDG_STATE_HOME", "XDG_CACHE_HOME", "HOME")})
    refused = run(folder, header("0" * 16, 1)).communicate()[1]
    scene = re.search(r"[0-9a-f]{16}", refused.replace("0" * 16, "")).group()
    body = (f"{n * now + frame} {line}\n" for n in range(rounds) for frame, line in lines)
    app = run(folder, header(scene, rounds * now) + "".join(body))
    watch(app)
    app.terminate()
    out, err = app.communicate()
    with open(os.path.join(folder, "soak.csv")) as log:
        drawn = sum(line[0].isdigit() for line in log)
    print(f"{drawn} frames, {drawn / now:.1f} rounds\n{err}", end="")
    exit(0 if app.returncode in (0, -15) else 1)
