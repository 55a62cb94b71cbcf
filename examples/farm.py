#!/usr/bin/env python3
"""Shots on many machines: simulate, analyze and export each, on a dask.distributed cluster.

    python3 examples/farm.py shots.txt out                          on this machine
    python3 examples/farm.py shots.txt out --scheduler HOST:8786    on a cluster that shares this folder
    parallel python3 examples/farm.py shots.txt out --only {} ::: $(seq 16)
    sbatch --array=1-16 --wrap 'python3 examples/farm.py shots.txt out --only $SLURM_ARRAY_TASK_ID'

Each line of shots.txt is a shot: its name, its mesh and options of `wiggly simulate`, such as "nod creature.obj --shake up --damping 0.1".
A shot becomes out/NAME.glb, which is whole or not there. Shots that are there are not made again, so a farm that was stopped goes on.
"""

import argparse
import os
import shlex
import subprocess
import tempfile
from pathlib import Path


def make(line, folder):
    """Makes one shot, unless it is there, and returns its file."""
    name, mesh, *options = shlex.split(line)
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
            run = subprocess.run([os.environ.get("WIGGLY", "wiggly"), *command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, encoding="utf-8")
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
    os.makedirs(given.folder, exist_ok=True)
    lines = [line for line in Path(given.shots).read_text(encoding="utf-8").splitlines() if line.strip()]
    if given.only:
        return print(make(lines[given.only - 1], given.folder))
    from dask.distributed import Client, as_completed

    with Client(given.scheduler) as client:
        for future in as_completed(client.map(make, lines, folder=given.folder, pure=False)):
            print(future.exception() or future.result(), flush=True)


if __name__ == "__main__":
    main()
