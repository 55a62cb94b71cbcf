#!/usr/bin/env python3
"""Shots on many machines: simulate, analyze and export each, on a dask.distributed cluster.

    python3 examples/farm.py shots.txt out                          on this machine
    python3 examples/farm.py shots.txt out --scheduler HOST:8786    on a cluster that shares this folder
    parallel python3 examples/farm.py shots.txt out --only {} ::: $(seq 16)
    sbatch --array=1-16 --wrap 'python3 examples/farm.py shots.txt out --only $SLURM_ARRAY_TASK_ID'

Each line of shots.txt is a shot: its name, its mesh and options of `wiggly simulate`, such as "nod creature.obj --shake up --damping 0.1".
Lines that begin with # are left out.
A shot becomes out/NAME.glb, which is whole or not there. Shots that are there are not made again, so a farm that was stopped goes on.
"""

import argparse
import os
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path


def read(path):
    """The shots of a list, each in words."""
    shots, names = [], set()
    for number, line in enumerate(Path(path).read_text(encoding="utf-8").splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        try:
            name, _mesh, *_options = shot = shlex.split(line)
        except ValueError:
            name = "/"
        if "/" in name or name in names:
            sys.exit(f"{path}:{number}: expected a name of its own, a mesh and options, got {line}")
        names.add(name)
        shots.append(shot)
    return shots


def make(shot, folder):
    """Makes one shot, unless it is there, and returns its file."""
    name, mesh, *options = shot
    done = Path(folder) / f"{name}.glb"
    if done.exists():
        return str(done)
    with tempfile.TemporaryDirectory(prefix=f".{name}-", dir=folder) as place:  # on the same disk, to be renamed
        motion, character, scene, shot = (f"{place}/{file}" for file in ("motion.npy", "character.glb", "scene.json", "shot.glb"))
        for command in (
            ["simulate", os.path.abspath(mesh), "-o", motion, *options],
            ["analyze", motion, "-o", character, "--scene", scene],
            ["export", scene, "-o", shot, "--quiet"],
        ):
            run = subprocess.run([os.environ.get("WIGGLY") or "wiggly", *command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, encoding="utf-8")
            if run.returncode:
                raise RuntimeError(f"{name}: {run.stderr.strip()}")
        os.replace(shot, done)
    return str(done)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("shots")
    arguments.add_argument("folder", type=os.path.abspath)
    arguments.add_argument("--scheduler", help="address of a running cluster (default: one on this machine)")
    arguments.add_argument("--only", type=int, help="make this one shot, counted from 1, without a cluster")
    given = arguments.parse_args()
    shots, failed = read(given.shots), 0
    os.makedirs(given.folder, exist_ok=True)
    if given.only is not None:
        if not 0 < given.only <= len(shots):
            sys.exit(f"--only: expected 1 to {len(shots)}, got {given.only}")
        return print(make(shots[given.only - 1], given.folder))
    try:
        from dask.distributed import Client, as_completed
    except ImportError:
        sys.exit("dask.distributed is not installed: pip install distributed, or make one shot with --only")
    with Client(given.scheduler) as client:
        for future in as_completed(client.map(make, shots, folder=given.folder, pure=False)):
            failed += future.exception() is not None
            print(future.exception() or future.result(), flush=True)
    if failed:
        sys.exit(f"{failed} of {len(shots)} shots failed")


if __name__ == "__main__":
    try:
        main()
    except (OSError, RuntimeError) as error:
        sys.exit(str(error))
