"""Lockstep from Python: motion-control projects in virtual and in real time.

- :func:`check` lists what is wrong with a project file.
- :class:`Project` steps a project in virtual time: ``project.run(5.0)``, ``project["Knife.Position"]``,
  ``project.trace["Knife.Velocity"]``.
- :func:`sweep` runs many variants of a project on an executor, and resumes where it was stopped.
- :class:`RealTime` runs a project in real time.
- :func:`read_trace` reads what ``lockstep run --trace`` has written.

Times are in [s]; positions, velocities and so on in the units of their axes.
"""

from . import _lockstep
from .errors import (
    BusyError,
    ClosedError,
    ExpressionError,
    InvalidProject,
    LockstepError,
    OutOfRange,
    PathError,
    Problem,
    ReadOnly,
    RunError,
    SweepError,
    TraceError,
)
from .project import Event, PathInfo, Project, check
from .real_time import RealTime
from .sweeps import Row, sweep, variants
from .trace import Trace, read_trace

__version__: str = _lockstep.__version__

__all__ = [
    "BusyError",
    "ClosedError",
    "Event",
    "ExpressionError",
    "InvalidProject",
    "LockstepError",
    "OutOfRange",
    "PathError",
    "PathInfo",
    "Problem",
    "Project",
    "ReadOnly",
    "RealTime",
    "Row",
    "RunError",
    "SweepError",
    "Trace",
    "TraceError",
    "check",
    "read_trace",
    "sweep",
    "variants",
]


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
