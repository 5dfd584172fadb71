"""A project in virtual time."""

from __future__ import annotations

import datetime
import operator
from collections.abc import Iterable, Iterator, Mapping
from types import TracebackType
from typing import Any, NamedTuple

from . import _lockstep
from .errors import ExpressionError, InvalidProject, OutOfRange, PathError, Problem, problems_from
from .fields import with_field_docs
from .source import ProjectSource, Text, changed, text_of, unicode_of
from .trace import Trace


@with_field_docs
class Event(NamedTuple):
    """Something that has happened in a run."""

    time: float
    """Of the tick, since the start of the run [s]."""
    kind: str
    """``alarm``, ``acknowledged``; with ``jobs=True`` also ``job started`` and how it ended."""
    source: str
    """Name of the technology object, or of the instance of a block."""
    type: str
    """Such as ``TO_SynchronousAxis`` or ``MC_GearIn``."""
    number: int
    """Of the alarm; ErrorID of a job that has failed; else 0."""
    text: str
    """Meaning of the number."""
    reaction: str
    """What an alarm does to the axis; empty for other events."""
    cause: str
    """What has happened, in general; empty where it is not known, as for events that are no alarms."""
    remedy: str
    """What is to be done about an alarm, or a job that has failed; empty where nothing is known to help."""
    address: str
    """Which of several causes, limits, sensors, inputs or objects an alarm means: ``sensor 1``."""
    value_name: str
    """What was measured, such as ``following error``; empty: nothing."""
    value: float | None
    """What was measured, in :attr:`unit`; None: not known."""
    limit_name: str
    """What it was held against, such as ``permitted``; empty: nothing."""
    limit: float | None
    """What it was held against, in :attr:`unit`; None: not known."""
    unit: str
    """Of value and limit, such as ``mm``; empty: none."""
    object: str
    """Of a job: the axis, or other object, that carries it out."""
    tick: int
    """Number of the servo tick."""
    clock: float | None
    """Wall clock [s since 1970-01-01 UTC], as :func:`time.time` has it; None in virtual time."""
    details: tuple[str, ...]
    """What is known besides, a line each, as ``lockstep run`` tells it: values and address, cause, remedy."""

    def __str__(self) -> str:
        """The same in lines, as ``lockstep run`` tells it on the console behind ``lockstep:``. An alarm:
        ``8.013000 s: Shear: alarm 521: Following error … (reaction)``, below it its tick, and :attr:`clock` where there
        is one, and the details.
        """
        return "\n  ".join([f"{self.time:.6f} s: {self.source}{self._what()}", *self._below()])

    def _what(self) -> str:
        block = f" ({self.type} of {self.object})" if self.object else f" ({self.type})"
        if self.kind == "alarm":
            return f": alarm {self.number}: {self.text} ({self.reaction or 'no reaction'})"
        if self.kind == "acknowledged":
            return ": alarms acknowledged"
        if self.kind == "job failed":
            return f"{block}: failed, ErrorID 16#{self.number:04X}: {self.text}"
        if self.kind.startswith("job "):
            return f"{block}: {self.kind.removeprefix('job ')} {self.text}".rstrip()
        if self.kind == "printed":
            return f": {self.text}"
        if self.kind == "program error":
            return f": error {self.number}: {self.text}"
        return f": {self.kind}: {self.text}" if self.text else f": {self.kind}"

    def _below(self) -> list[str]:
        if self.kind != "alarm":
            return list(self.details) if self.kind == "job failed" and self.number != _BY_ALARM else []
        moment = f"tick {self.tick}"
        if self.clock is not None:
            moment += f", {datetime.datetime.fromtimestamp(self.clock, datetime.timezone.utc):%Y-%m-%d %H:%M:%S.%f} UTC"
        return [moment, *self.details]


_BY_ALARM = 0x8001
"""ErrorID of a job that an alarm has ended; what helps stands with the alarm."""


@with_field_docs
class PathInfo(NamedTuple):
    """What is at a path."""

    type: str
    """``LREAL``, ``STRING[20]``, ``ARRAY[1..4] OF LREAL``."""
    unit: str
    """As the project has it, such as ``mm/s``; empty where there is none."""
    read_only: str
    """Why it cannot be written; empty where it can."""


def check(project: ProjectSource, *, changes: Mapping[str, Any] | None = None) -> list[Problem]:
    """Looks whether a project is valid, without readying it for a run.

    :param project: its file, or its content as ``json.load`` gives it
    :param changes: other values at JSON pointers, such as ``{"/tags/speed/init": 250.0}``
    :return: all problems, those of severity ``error`` first; it is valid if there are none of these
    :raises OSError: the file cannot be read
    :raises PathError: a pointer of ``changes`` leads nowhere
    :raises OutOfRange: a value holds itself, or is nested far deeper than a file may be, or a text is no Unicode
    """
    try:
        source = changed(text_of(project), _pointers(changes or {}))
    except InvalidProject as error:  # before it is a text that the runtime could look at
        return error.problems
    errors, warnings = _lockstep.check(*source.for_runtime())
    return problems_from(errors, warnings)


class Project:
    """A project in virtual time, stepped by its owner: no threads, no connections, no files.

    The same project, changes and calls give the same values, bit for bit, as ``lockstep run --simulate`` does. Its
    stimuli apply.

    >>> with lockstep.Project("projects/02_rotary_knife/project.json") as knife:
    ...     knife.run(5.0)
    ...     knife["speed"] = 250.0
    ...     knife.run(2.0)
    ...     knife["Knife.ActualPosition"], knife.trace["Knife.Velocity"].max()

    ``project[path]`` reads and writes tags, pins of block instances, variables of technology objects and bits of them:
    ``start``, ``gear.InSync``, ``Knife.StatusWord.X22``, ``heights[2]``, ``heights``. BOOL is bool, integers and bit
    strings are int, REAL and LREAL float, TIME float [s] (a ``timedelta`` can be written), STRING str; several elements
    of an array are a list.

    Threads: one at a time. A value that closes the project while it is converted, or lets another thread close or run it,
    is not written: :class:`ClosedError`, :class:`BusyError`. The GIL is released while ticks run; what another thread
    asks meanwhile raises
    :class:`BusyError`. Ctrl-C ends a long run within a fraction of a second; the project stays where it is then.
    Projects side by side in several threads or processes are independent of each other.

    :param project: its file, or its content as ``json.load`` gives it; names of files in it are relative to its
        folder, in the second case to the current one
    :param signals: what the trace records, by paths; None: what the project says
    :param changes: keys of the project by JSON pointer (``"/clock/servo_cycle": "2ms"``), which change what is
        loaded, and values by path (``"speed": 250.0``), which are written before the first tick
    :param jobs: jobs of blocks are events too
    :raises InvalidProject: with all problems
    :raises OSError: the file cannot be read
    :raises PathError, ReadOnly, OutOfRange, TypeError: for what is in ``signals`` or ``changes``
    """

    __slots__ = ("_run", "_file", "__weakref__")

    def __init__(
        self,
        project: ProjectSource,
        *,
        signals: Iterable[str] | None = None,
        changes: Mapping[str, Any] | None = None,
        jobs: bool = False,
    ) -> None:
        self._load(text_of(project), signals, changes, jobs)

    @classmethod
    def _of_text(
        cls, source: Text, signals: Iterable[str] | None = None, changes: Mapping[str, Any] | None = None
    ) -> Project:
        """Of a text that has been read already, such as on another machine."""
        project = cls.__new__(cls)
        project._load(source, signals, changes, jobs=False)
        return project

    def _load(
        self, source: Text, signals: Iterable[str] | None, changes: Mapping[str, Any] | None, jobs: bool
    ) -> None:
        pointers = _pointers(changes or {}, others=True)
        source = changed(source, pointers)
        self._file = source.file
        self._run = _lockstep.load(*source.for_runtime(), paths_of(signals), bool(jobs))
        for path, value in (changes or {}).items():
            if path not in pointers:
                self[path] = value

    # Time.

    def step(self, n: int = 1) -> None:
        """Runs ``n`` servo ticks, from 0 on.

        :raises OutOfRange: ``n`` is negative
        :raises MemoryError: the trace has no room; what ran up to then counts
        """
        ticks = operator.index(n)
        if not 0 <= ticks < 2**63:
            raise OutOfRange(f"n may not be {ticks}; allowed: from 0 on")
        self._run.step(ticks)

    def run(self, seconds: float | datetime.timedelta, *, until: str | None = None) -> bool:
        """Runs a duration of virtual time.

        :param seconds: [s], 0 or more, rounded up to whole servo ticks
        :param until: a condition in Structured Text, such as ``"gear.InSync AND speed > 100.0"``; it is looked at before
            the first tick and after each, and ends the run
        :return: whether the condition held; False without one
        :raises OutOfRange: ``seconds`` is negative or no number, or beyond what a run can last (9e9 s)
        :raises ExpressionError: ``until`` is no condition
        :raises KeyboardInterrupt: Ctrl-C; what ran up to then counts
        :raises MemoryError: as :meth:`step`
        """
        return self._run.run(seconds_of(seconds), None if until is None else _expression_of(until))

    @property
    def time(self) -> float:
        """Time of the next tick [s]."""
        return self._run.now

    @property
    def ticks(self) -> int:
        """Servo ticks that have been executed."""
        return self._run.ticks

    @property
    def servo_cycle(self) -> float:
        """Period of a servo tick [s]."""
        return self._run.servo_cycle

    # Values.

    def __getitem__(self, path: str) -> Any:
        return self._run.read(path_of(path))

    def __setitem__(self, path: str, value: Any) -> None:
        self._run.write(path_of(path), value)

    def __contains__(self, path: object) -> bool:
        if not isinstance(path, str):
            return False
        try:
            self._run.describe(path_of(path))
        except PathError:
            return False
        return True

    def __iter__(self) -> Iterator[str]:
        return iter(self.paths())

    def paths(self) -> list[str]:
        """Every path without an index: tags, pins of block instances, variables of technology objects."""
        return self._run.paths()

    def info(self, path: str) -> PathInfo:
        """Type, unit, and whether it can be written.

        :raises PathError: it leads to no value
        """
        return PathInfo(*self._run.describe(path_of(path)))

    def evaluate(self, expression: str) -> Any:
        """The value of an expression in Structured Text, as things stand: ``"ABS(Knife.Velocity) > speed"``.

        :raises ExpressionError: it is none, or names what is not there
        """
        return self._run.evaluate(_expression_of(expression))

    # What has happened.

    @property
    def trace(self) -> Trace:
        """The trace up to now, a row for each interpolator cycle; its arrays look into the memory of the run."""
        return Trace(self._run.trace())

    @property
    def events(self) -> list[Event]:
        """What has happened, oldest first: alarms and their acknowledgement, and jobs if they were asked for."""
        return [Event(*event) for event in self._run.events()]

    @property
    def alarms(self) -> list[Event]:
        """The alarms that are pending, oldest first: those of objects that have not been acknowledged since."""
        return pending(self.events)

    @property
    def messages(self) -> list[str]:
        """What the project file was warned of, a line each."""
        return [str(problem) for problem in self.problems]

    @property
    def problems(self) -> list[Problem]:
        """The same, by place and text; all of severity ``warning``, since the project is valid."""
        return problems_from([], self._run.warnings())

    # The project itself.

    @property
    def name(self) -> str:
        """As the project file says."""
        return self._run.name

    @property
    def description(self) -> str:
        """As the project file says; empty if it does not."""
        return self._run.description

    @property
    def file(self) -> str:
        """The project file; empty if there is none."""
        return self._file

    @property
    def closed(self) -> bool:
        """Whether it has been closed; only name, file, messages and traces taken before remain then."""
        return self._run.closed

    def close(self) -> None:
        """Gives the memory of the run back; arrays of its traces keep theirs. Closing again does nothing.

        :raises BusyError: another thread runs it
        """
        self._run.close()

    def __enter__(self) -> Project:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError(
            "a Project is a run in progress and cannot be pickled; send its file and changes, as lockstep.sweep does"
        )

    def __repr__(self) -> str:
        try:
            state = "closed" if self.closed else f"at {self.time:g} s"
        except RuntimeError:
            state = "running in another thread"
        return f"<lockstep.Project {self.name!r}, {state}>"

    def _ipython_key_completions_(self) -> list[str]:
        return self.paths()


def pending(events: Iterable[Event]) -> list[Event]:
    """The alarms among some events whose object has not been acknowledged since."""
    alarms: list[Event] = []
    for event in events:
        if event.kind == "alarm":
            alarms.append(event)
        elif event.kind == "acknowledged":
            alarms = [alarm for alarm in alarms if alarm.source != event.source]
    return alarms


def seconds_of(duration: float | datetime.timedelta) -> float:
    """A duration in seconds.

    :raises TypeError: it is no number, as a text is none
    """
    if isinstance(duration, datetime.timedelta):
        return duration.total_seconds()
    if isinstance(duration, (str, bytes, bytearray)):
        raise TypeError(f"a duration is a number [s] or a timedelta, not {duration!r}")
    return float(duration)


def path_of(path: str) -> str:
    """A path as such.

    :raises TypeError: it is no str
    :raises PathError: it is no text of Unicode
    """
    if not isinstance(path, str):
        raise TypeError(f"a path is a str such as 'Axis.Position', not {type(path).__name__}")
    return unicode_of(path, "the path", PathError)


def _expression_of(expression: str) -> str:
    """An expression as such.

    :raises TypeError: it is no str
    """
    if not isinstance(expression, str):
        raise TypeError(f"an expression is a str such as 'gear.InSync', not {type(expression).__name__}")
    return unicode_of(expression, "the expression", ExpressionError)


def paths_of(paths: Iterable[str] | None) -> list[str] | None:
    """Paths as a list; None stays None.

    :raises TypeError: one of them, or the whole, is no list of str
    """
    if isinstance(paths, str):
        raise TypeError(f"signals are several paths: [{paths!r}], not {paths!r}")
    return None if paths is None else [path_of(path) for path in paths]


def _pointers(changes: Mapping[str, Any], others: bool = False) -> dict[str, Any]:
    for key in changes:
        path_of(key)
        if not others and not key.startswith("/"):
            raise PathError(f"{key!r} is no JSON pointer, which begins with '/'")
    return {key: value for key, value in changes.items() if key.startswith("/")}
