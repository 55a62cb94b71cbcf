"""What all drivers share: waiting with a limit, and starting programs that end with this one."""
import os
import signal
import subprocess
import time

LIMIT = 60  # seconds


def until(what, condition, limit=LIMIT, step=0.02):
    """The first value of `condition` that is true. `what` is part of a sentence: "waited 60 s for …"."""
    end = time.monotonic() + limit
    while not (value := condition()):
        if time.monotonic() > end:
            raise TimeoutError(f'waited {limit} s for {what}')
        time.sleep(step)
    return value


def start(arguments, **options):
    """In a group of its own, whose processes stop() ends together."""
    quiet = {'stdin': subprocess.DEVNULL, 'stdout': subprocess.DEVNULL, 'stderr': subprocess.DEVNULL}
    return subprocess.Popen(arguments, start_new_session=True, **{**quiet, **options})


def stop(process, limit=10):
    """Gives it some seconds to end by itself."""
    try:
        process.wait(limit)
    except subprocess.TimeoutExpired:
        pass
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    process.wait()
