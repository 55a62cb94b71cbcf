#!/usr/bin/env python3
"""Shots on many machines: simulate, analyze and export each, on a dask.distributed cluster.

    python3 examples/farm.py shots.txt out                          on this machine
    python3 examples/farm.py shots.txt out --scheduler HOST:8786    on a cluster that shares this folder
    parallel python3 examples/farm.py shots.txt out --only {} ::: $(seq 16)
    sbatch --array=1-16 --wrap 'python3 examples/farm.py shots.txt out --only $SLURM_ARRAY_TASK_ID'

A line of shots.txt is a shot: its name, its mesh and options of `wiggly simulate`, such as "nod creature.obj --shake up --damping 0.1".
It becomes out/NAME.glb, which is whole or not there. Shots that are there are not made again, so a farm that was stopped goes on.
"""
import argparse
import os
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

def make(shot, folder):
    """Makes one shot, unless it is there, and returns its file."""
    name, mesh, *options = shot
    done = Path(folder) / f"{name}.glb"
    if done.exists():
        return str(done)
    with tempfile.TemporaryDirectory(prefix=f".{name}-", dir=folder) as place:  # on the same disk, to be renamed
        motion, character, scene, made = (f"{place}/{file}" for file in ("motion.npy", "character.glb", "scene.json", "shot.glb"))
        for command in (
            ["simulate", mesh, *options, "-o", motion],
            ["analyze", motion, "-o", character, "--scene", scene],
            ["export", scene, "-o", made, "--quiet"],
        ):
            run = subprocess.run([os.environ.get("WIGGLY", "wiggly"), *command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, encoding="utf-8")
            if run.returncode:
                raise RuntimeError(f"{name}: {run.stderr.strip()}")
        os.replace(made, done)
    return str(done)


arguments = argparse.ArgumentParser(description="Simulates, analyses and exports a list of shots.")
arguments.add_argument("shots", type=Path, help="a file with a shot on each line: NAME MESH [OPTIONS OF wiggly simulate]")
arguments.add_argument("folder", help="where the characters go")
arguments.add_argument("--scheduler", help="address of a running cluster (default: one on this machine)")
arguments.add_argument("--only", type=int, help="make this one shot, counted from 1, without a cluster")
if __name__ == "__main__":
    sys.tracebacklimit = 0  # an error is a sentence
    given, failed = arguments.parse_args(), 0
    shots = [shlex.split(line) for line in given.shots.read_text(encoding="utf-8").splitlines() if line.strip()]
    if not shots or min(map(len, shots)) < 2 or len({shot[0] for shot in shots}) < len(shots):
        sys.exit(f"{given.shots}: expected a name and a mesh in every line, and no name twice")
    os.makedirs(given.folder, exist_ok=True)
    if given.only is not None:
        known = 0 < given.only <= len(shots)
        sys.exit(print(make(shots[given.only - 1], given.folder)) if known else f"--only: expected 1 to {len(shots)}, got {given.only}")
    from dask.distributed import Client, as_completed
    with Client(given.scheduler) as client:
        for future in as_completed(client.map(make, shots, folder=given.folder, pure=False)):
            failed += future.status == "error"
            print(future.exception() or future.result(), flush=True)
    sys.exit(failed > 0)
