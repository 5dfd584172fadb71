"""What tests of sweeps send to workers, which import it."""

import os
import signal
import sys
import threading
from concurrent.futures import ProcessPoolExecutor

from conftest import SMALL

import lockstep

GRID = {"/clock/servo_cycle": ["1ms", "500us"], "speed": [10.0, 20.0, 0.1], "go": [True]}
SECONDS = 2.0


def measure(project: lockstep.Project) -> dict:
    """Values of each kind that a row keeps."""
    trace = project.trace
    return {"peak": trace["Axis.Position"].max(), "all": trace["total"], "flags": trace["run.InVelocity"], "pair": (1, [2.5])}


def fails_at_twenty(project: lockstep.Project) -> dict:
    """Fails in some of the variants."""
    if project["speed"] == 20.0:
        raise ArithmeticError("twenty is too fast")
    return {"thread": threading.current_thread().name}


def gives_what_nobody_keeps(project: lockstep.Project) -> dict:
    return {"project": object()}


def writes_much(project: lockstep.Project) -> dict:
    return {"much": "x" * 1000}


def gives_no_mapping(project: lockstep.Project) -> int:
    return 3


def everything(executor, **more) -> list[lockstep.Row]:
    """The sweep that is compared between executors."""
    return lockstep.sweep(
        SMALL, GRID, executor, seconds=SECONDS, values={"v": "Axis.Velocity"}, function=measure, traces=True, **more
    )


def die_after(rows: int, results: str) -> None:
    """Sweeps in this process, which is killed once there are so many rows."""

    def progress(done: int, total: int, row: object) -> None:
        if done == rows:
            os.kill(os.getpid(), signal.SIGKILL)

    with ProcessPoolExecutor(1) as pool:
        everything(pool, results=results, progress=progress, in_flight=1)


if __name__ == "__main__":
    die_after(int(sys.argv[1]), sys.argv[2])
