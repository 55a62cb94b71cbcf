"""Collects the events of a session by frame and writes them as a replay: for make-session.py and make-full-session.py."""
import sys

FRAMES = 1200
events = []


def at(frame, text):
    events.append((frame, text))


def key(frame, name, *mods, times=1, every=3):
    for n in range(times):
        at(frame + n * every, " ".join(["key", name, *mods]))
        at(frame + n * every + 1, " ".join(["keyup", name, *mods]))


def drag(frame, length, start, path, *mods, button="left"):
    """Presses on `start`, follows path(u) for u in (0, 1] over `length` frames, releases."""
    at(frame, f"pointer @{start}")
    at(frame + 1, " ".join([f"press {button} @{start}", *mods]))
    for n in range(1, length + 1):
        at(frame + 1 + n, f"pointer @{path(n / length)}")
    at(frame + 2 + length, " ".join([f"release {button} @{path(1)}", *mods]))


def click(frame, target, *mods):
    at(frame, f"pointer @{target}")
    at(frame + 1, " ".join([f"press left @{target}", *mods]))
    at(frame + 2, " ".join([f"release left @{target}", *mods]))


def scroll_inspector(frame, notches):
    """Down where notches are negative; further than it goes is as far as it goes."""
    at(frame, f"wheel 0 {notches} @widget(look.stiff)+0,-60")


def write(file, maker):
    """Writes the replay of a scene whose hash is the program's argument."""
    print("wiggly-replay 1\nversion 0.1.0\nsize 1280 720\nscale 1", file=file)
    print(f"scene {sys.argv[1] if len(sys.argv) > 1 else '0000000000000000'}\ndt 1/60\nframes {FRAMES}", file=file)
    print(f"# Made by tools/{maker}", file=file)
    for frame, text in sorted(events, key=lambda e: e[0]):
        assert frame < FRAMES
        print(frame, text, file=file)
