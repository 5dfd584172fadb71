"""A project in real time."""

from __future__ import annotations

import atexit
import datetime
import operator
import os
import weakref
from collections.abc import Iterable, Iterator
from types import TracebackType
from typing import Any, Union

from . import _lockstep
from .errors import OutOfRange
from .project import Event, path_of, paths_of, pending, seconds_of
from .source import file_name

Place = Union[str, bool, None]
"""Where something is: a text; None: as the project says; False: nowhere."""


_open: weakref.WeakSet[RealTime] = weakref.WeakSet()


@atexit.register
def _bring_to_rest() -> None:
    """Ends what runs when the interpreter ends: its axes come to rest, whoever has forgotten it."""
    for machine in list(_open):
        if not machine.closed:
            machine.stop()
            machine.wait(60.0)


class RealTime:
    """A project that runs in real time, with Modbus, traces over LCM, kept values and flight recorder as the project
    has them. It runs from its construction until :meth:`close`, its duration, or the overrun policy.

    >>> with lockstep.RealTime("machine.json", signals=["start", "Knife.Position"], modbus="127.0.0.1:0") as machine:
    ...     machine["start"] = True
    ...     machine.wait(5.0)
    ...     machine["Knife.Position"]

    Values cross between the cycle and Python through an image that neither waits for: what is read is of the last
    tick, what is written is taken at the start of the next one. So a Python program never disturbs the cycle beyond
    what the processors share; the memory of its process is locked as far as the system permits.

    A run that is still there when the interpreter ends is brought to rest. Threads: any. The run stays in its process:
    in a child of :func:`os.fork` the object counts as closed, and what is asked of it raises :class:`ClosedError`. Stimuli do
    not apply unless asked for.

    :param file: the project file
    :param signals: what can be read and written, by paths to single values; None: all tags that are one value, and
        the signals of the project's trace
    :param duration: ends after so long [s], greater than 0; None: on request only
    :param trace: a file for the trace, ``.csv`` or ``.lcm``, which :func:`lockstep.read_trace` reads
    :param modbus: ``"HOST:PORT"`` for the server, port 0: one that is free; None: as the project says; False: neither
        server nor clients
    :param lcm: a URL; None: as the project says; False: neither traces nor commands of panels
    :param retain: the file of kept values; None: as the project says; False: begins with the init values and keeps none
    :param stimuli: those of the project apply
    :param cpu: the processor of the cycle, from 0; None: any
    :raises InvalidProject: with all problems
    :raises OSError: the file cannot be read
    :raises RunError: it could not be started; the text says why
    :raises PathError: one of ``signals`` leads to no single value
    """

    __slots__ = ("_run", "__weakref__")

    def __init__(
        self,
        file: str | os.PathLike[str],
        *,
        signals: Iterable[str] | None = None,
        duration: float | datetime.timedelta | None = None,
        trace: str | os.PathLike[str] | None = None,
        modbus: Place = None,
        lcm: Place = None,
        retain: Union[Place, "os.PathLike[str]"] = None,
        stimuli: bool = False,
        cpu: int | None = None,
    ) -> None:
        options: dict[str, Any] = {"stimuli": bool(stimuli), "cpu": None, "duration": None}
        if cpu is not None:
            options["cpu"] = operator.index(cpu)
        if cpu is not None and not 0 <= cpu < 2**31:
            raise OutOfRange(f"cpu may not be {cpu}; allowed: from 0 on, None")
        if duration is not None:
            options["duration"] = seconds_of(duration)
            if not 0 < options["duration"] < 9e9:
                raise OutOfRange(f"duration may not be {options['duration']:g}; allowed: above 0 to 9e9 s")
        options["trace"] = b"" if trace is None else os.fsencode(file_name(trace))
        for name, place in (("modbus", modbus), ("lcm", lcm), ("retain", retain)):
            if place is True:
                raise TypeError(f"{name} is a text, None (as the project says) or False (none), not True")
            options[name] = b"" if place is None or place is False else os.fsencode(file_name(place))
            options[f"no_{name}"] = place is False
        name = file_name(file)
        with open(name, "rb"):
            pass  # what cannot be read is told as Python tells it
        self._run = _lockstep.start(os.fsencode(name), paths_of(signals), options)
        _open.add(self)

    def wait(self, seconds: float | datetime.timedelta) -> bool:
        """Waits for the end of the run, for so long at most [s].

        :return: whether it has ended
        :raises KeyboardInterrupt: Ctrl-C; the run goes on
        """
        return self._run.wait(seconds_of(seconds))

    def stop(self) -> None:
        """Asks the run to end: its axes are brought to rest. Returns at once."""
        self._run.stop()

    def close(self) -> None:
        """Stops, and waits until the axes are at rest and all that is around the cycle has ended.

        :raises BusyError: another thread is in :meth:`wait`
        """
        self._run.close()

    def __getitem__(self, path: str) -> Any:
        return self._run.read(path_of(path))

    def __setitem__(self, path: str, value: Any) -> None:
        self._run.write(path_of(path), value)

    def __contains__(self, path: object) -> bool:
        return path in self._run.paths()

    def __iter__(self) -> Iterator[str]:
        return iter(self._run.paths())

    def paths(self) -> list[str]:
        """What can be read here."""
        return self._run.paths()

    @property
    def events(self) -> list[Event]:
        """What has happened, oldest first; the last 10,000."""
        return [Event(*event) for event in self._run.events()]

    @property
    def alarms(self) -> list[Event]:
        """The alarms that are pending, oldest first."""
        return pending(self.events)

    @property
    def messages(self) -> list[str]:
        """What the run has told, oldest first: where its server listens, what the system gave, warnings."""
        return self._run.messages()

    @property
    def state(self) -> str:
        """``running``; ``ending``: the axes are at rest; ``ended``; ``closed``."""
        return self._run.state

    @property
    def status(self) -> dict[str, float]:
        """``time`` [s], ``ticks``, ``missed_ticks``, ``overruns``, ``worst_lateness`` [s], ``longest_tick`` [s]."""
        return self._run.status()

    @property
    def modbus_endpoints(self) -> list[str]:
        """Where the Modbus server listens, ``HOST:PORT``; empty: nowhere."""
        return self._run.modbus_endpoints()

    @property
    def name(self) -> str:
        """As the project file says."""
        return self._run.name

    @property
    def closed(self) -> bool:
        """Whether it has been closed."""
        return self._run.closed

    def __enter__(self) -> RealTime:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError("a RealTime is a run in progress and cannot be pickled")

    def __repr__(self) -> str:
        return f"<lockstep.RealTime {self.name!r}, {self.state}>"

    def _ipython_key_completions_(self) -> list[str]:
        return self.paths()
