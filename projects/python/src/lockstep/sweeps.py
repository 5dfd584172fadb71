"""Many variants of a project on an executor."""

from __future__ import annotations

import base64
import errno
import fcntl
import hashlib
import inspect
import itertools
import json
import os
import re
import stat
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from contextlib import contextmanager
from dataclasses import dataclass
from typing import IO, Any, NamedTuple, Union

import numpy as np

from . import _lockstep
from .errors import OutOfRange, SweepError
from .project import Project, paths_of, seconds_of
from .source import ProjectSource, Text, file_name, plain, text_of
from .trace import Trace

Grid = Union[Mapping[str, Iterable[Any]], Iterable[Mapping[str, Any]]]
"""Values for each key, all combinations of which are run; or the variants themselves."""

Measure = Callable[[Project], Mapping[str, Any]]
"""Called with a project that has run; gives values by name: numbers, texts, lists, NumPy arrays."""


@dataclass(frozen=True)
class Row:
    """What became of one variant."""

    index: int
    """Of the variant in the grid, from 0."""
    variant: dict[str, Any]
    """What was set: JSON pointers and paths."""
    values: dict[str, Any]
    """By expression or name; empty if the variant failed."""
    trace: Trace | None
    """None unless traces are kept, or if the variant failed."""
    error: str | None
    """Why the variant failed: kind and text of the exception; None: it did not."""

    def __eq__(self, other: object) -> bool:
        """Whether all of it is the same, bit for bit."""
        if not isinstance(other, Row):
            return NotImplemented
        return _line_of(self) == _line_of(other)

    __hash__ = None  # type: ignore[assignment]


class _Work(NamedTuple):
    """What all variants of a sweep have in common."""

    source: Text
    seconds: float
    values: tuple[tuple[str, str], ...]
    function: Measure | None
    signals: tuple[str, ...] | None
    traces: bool


def variants(grid: Grid) -> list[dict[str, Any]]:
    """The variants of a grid, in the order in which they are numbered: the last key changes fastest.

    >>> lockstep.variants({"speed": [100.0, 200.0], "/clock/servo_cycle": ["1ms", "2ms"]})[1]
    {'speed': 100.0, '/clock/servo_cycle': '2ms'}

    :raises TypeError: a value that JSON does not have
    """
    if isinstance(grid, Mapping):
        for key, choices in grid.items():
            if isinstance(choices, (str, bytes)) or not isinstance(choices, Iterable):
                raise TypeError(f"{key}: allowed is a list of values, not {choices!r}")
        combinations = itertools.product(*grid.values())
        return [plain(dict(zip(grid, combination))) for combination in combinations]
    return [plain(dict(variant)) for variant in grid]


def sweep(
    project: ProjectSource,
    grid: Grid,
    executor: Executor | None = None,
    *,
    seconds: float,
    values: Mapping[str, str] | Sequence[str] = (),
    function: Measure | None = None,
    signals: Iterable[str] | None = None,
    traces: bool = False,
    results: str | os.PathLike[str] | None = None,
    progress: Callable[[int, int, Row | None], None] | None = None,
    in_flight: int | None = None,
) -> list[Row]:
    """Runs variants of a project for a time each, and gives a row of results for each, in the order of the grid.

    The results depend on neither the executor, nor the number of its workers, nor on whether the sweep was interrupted:
    each variant has the same bits everywhere. A variant that fails tells that in its row; the others go on.

    >>> with concurrent.futures.ProcessPoolExecutor() as pool:
    ...     rows = lockstep.sweep("machine.json", {"speed": [100.0, 200.0, 300.0]}, pool, seconds=5.0,
    ...                           values=["Knife.Position", "cuts"], results="sweep.jsonl")

    :param project: its file, or its content as ``json.load`` gives it; its text goes to the workers, files that it names
        have to be where they are here
    :param grid: keys as ``changes`` of :class:`Project` has them: JSON pointers and paths
    :param executor: any of ``concurrent.futures``: processes or threads (the GIL is released while ticks run), or
        ``distributed.Client(…).get_executor()`` for many machines; None: one after the other, here
    :param seconds: virtual time of each [s]
    :param values: expressions in Structured Text, whose values at the end are kept, by name or as they are
    :param function: called with the project at the end, on the worker; gives more values, by name. It has to be
        importable there (Dask sends it along)
    :param signals: of the trace, for ``function`` and ``traces``; None: what the project says
    :param traces: whether rows have the trace
    :param results: a file that each row is added to once it is there, a line of JSON each, of up to 1 GiB. A
        sweep whose file is there
        goes on where that one was stopped, also by a kill; it has to be the same sweep
    :param progress: called in this thread with the number of rows that are there, of all, and the row: first with those
        of ``results`` and None, then for each
    :param in_flight: variants that are handed to the executor at once, at most; None: 64, or four for each processor of
        this machine if that is more
    :raises SweepError: ``results`` is of another sweep, is no such file or no regular one, has a damaged row (the text
        names its line), or another sweep writes to it
    :raises OSError: ``results`` cannot be written, such as on a full disk; rows up to then are there
    :raises OutOfRange: ``seconds`` or ``in_flight``
    :raises BrokenExecutor: a worker has died; rows up to then are in ``results``
    """
    work = _Work(
        text_of(project),
        seconds_of(seconds),
        tuple(values.items()) if isinstance(values, Mapping) else tuple((text, text) for text in _texts(values)),
        function,
        None if signals is None else tuple(paths_of(signals) or ()),
        bool(traces),
    )
    if not 0.0 <= work.seconds <= 9e9:
        raise OutOfRange(f"seconds may not be {work.seconds:g}; allowed: 0 to 9e9")
    if in_flight is None:
        in_flight = max(64, 4 * (os.cpu_count() or 1))
    if in_flight < 1:
        raise OutOfRange(f"in_flight may not be {in_flight}; allowed: from 1 on")
    wanted = variants(grid)
    with _opened(results, work, wanted) as (file, rows):
        if rows and progress:
            progress(len(rows), len(wanted), None)
        tasks = ((work, index, variant) for index, variant in enumerate(wanted) if index not in rows)
        for line in _lines(tasks, executor, in_flight):
            if file:
                file.add(line)
            row = _row_of(line)
            rows[row.index] = row
            if progress:
                progress(len(rows), len(wanted), row)
    return [rows[index] for index in range(len(wanted))]


def _texts(values: Sequence[str]) -> Sequence[str]:
    if isinstance(values, str):
        raise TypeError(f"values are several expressions: [{values!r}], not {values!r}")
    return values


def _lines(tasks: Iterator[tuple[_Work, int, dict[str, Any]]], executor: Executor | None, in_flight: int) -> Iterator[str]:
    """The rows, as lines, as they come."""
    if executor is None:
        yield from (_run(*task) for task in tasks)
        return
    pending: set[Future[str]] = set()
    try:
        while True:
            for task in itertools.islice(tasks, in_flight - len(pending)):
                pending.add(executor.submit(_run, *task))
            if not pending:
                return
            done, pending = wait(pending, return_when=FIRST_COMPLETED)
            for future in done:
                yield future.result()
    finally:
        for future in pending:
            future.cancel()


def _run(work: _Work, index: int, variant: dict[str, Any]) -> str:
    """Runs one variant, on a worker."""
    try:
        values, trace = _measure(work, variant)
        return _line_of(Row(index, variant, values, trace, None))
    except Exception as error:  # whatever a variant fails of is told in its row
        return _line_of(Row(index, variant, {}, None, f"{type(error).__name__}: {error}"))


def _measure(work: _Work, variant: dict[str, Any]) -> tuple[dict[str, Any], Trace | None]:
    signals = work.signals if work.traces or work.function else ()
    with Project._of_text(work.source, signals=signals, changes=variant) as project:
        project.run(work.seconds)
        values: dict[str, Any] = {name: project.evaluate(text) for name, text in work.values}
        if work.function:
            more = work.function(project)
            if not isinstance(more, Mapping):
                raise TypeError(f"function has to give a mapping of names to values, not {type(more).__name__}")
            values.update(more)
        return values, project.trace if work.traces else None


# Rows as lines of JSON: numbers of Python keep their bits there, arrays are packed.


def _line_of(row: Row) -> str:
    trace = None if row.trace is None else {
        "time": _packed(row.trace.time),
        "signals": [[name, row.trace.types[name], row.trace.units[name], _packed(row.trace[name])] for name in row.trace],
    }
    values = {name: _packed(value) for name, value in row.values.items()}
    return json.dumps({"index": row.index, "variant": row.variant, "values": values, "trace": trace, "error": row.error})


def _row_of(line: str | bytes) -> Row:
    """The row of a line.

    :raises ValueError, KeyError, TypeError: it is none
    """
    data = _json_of(line)
    index, variant, values, error = data["index"], data["variant"], data["values"], data["error"]
    if isinstance(index, bool) or not isinstance(index, int):
        raise TypeError(f"index is {index!r}; allowed: a whole number")
    for name, value in (("variant", variant), ("values", values)):
        if not isinstance(value, dict):
            raise TypeError(f"{name} is of type {type(value).__name__}; allowed: an object")
    if not (error is None or isinstance(error, str)):
        raise TypeError(f"error is of type {type(error).__name__}; allowed: a text, null")
    trace = None
    if data["trace"] is not None:
        signals = data["trace"]["signals"]
        if not all(isinstance(text, str) for signal in signals for text in signal[:3]):
            raise TypeError("a signal has no name, type and unit")
        trace = Trace.from_arrays(
            _column(data["trace"]["time"]),
            {name: _column(column) for name, _, _, column in signals},
            {name: kind for name, kind, _, _ in signals},
            {name: unit for name, _, unit, _ in signals},
        )
    return Row(index, variant, {name: _unpacked(value) for name, value in values.items()}, trace, error)


def _json_of(line: str | bytes) -> dict[str, Any]:
    try:
        data = json.loads(line)
    except RecursionError:
        raise ValueError("it is nested too deeply") from None
    if not isinstance(data, dict):
        raise TypeError("it is no object")
    return data


def _column(value: Any) -> Any:
    array = _unpacked(value)
    if not isinstance(array, np.ndarray) or array.ndim != 1:
        raise TypeError("a column of the trace is no array of one dimension")
    return array


def _packed(value: Any) -> Any:
    if not isinstance(value, np.ndarray):
        return plain(value)
    if value.dtype.kind not in "biuf":
        raise TypeError(f"an array of {value.dtype} cannot be kept; allowed: of numbers and bool")
    little = np.ascontiguousarray(value).astype(value.dtype.newbyteorder("<"), copy=False)
    return {"array": base64.b64encode(little.tobytes()).decode(), "type": little.dtype.str, "shape": list(value.shape)}


def _unpacked(value: Any) -> Any:
    if not (isinstance(value, dict) and set(value) == {"array", "type", "shape"}):
        return value
    if not (isinstance(value["type"], str) and re.fullmatch(r"[<|][biuf][0-9]{1,2}", value["type"])):
        raise TypeError(f"{value['type']!r} is no type of an array")
    array = np.frombuffer(base64.b64decode(value["array"], validate=True), value["type"])
    return array.reshape(value["shape"])


# The file of results: a line that says of which sweep it is, then a row a line. A last line that was cut short when the
# sweep was killed has no end, and counts as not there.


@contextmanager
def _opened(
    path: str | os.PathLike[str] | None, work: _Work, wanted: list[dict[str, Any]]
) -> Iterator[tuple[_Results | None, dict[int, Row]]]:
    if path is None:
        yield None, {}
        return
    name = file_name(path)
    _require_regular(name)
    with open(path, "a+b") as file, _alone(path, file):
        _require_regular(name)  # what is there now, and stays open
        mark = _mark_of(work, wanted)
        file.seek(0)
        first = file.readline(_LONGEST_MARK + 1)
        is_begun = first.endswith(b"\n")
        # A file with something in it is only ever added to if it is of a sweep.
        if first and not (is_begun or mark.encode().startswith(first)):
            raise SweepError(f"{name}: is no file of a sweep")
        rows: dict[int, Row] = {}
        whole = 0
        if is_begun:
            _require_same(path, first[:-1], mark)
            rows, length = _rows_of(name, file, len(wanted))
            whole = len(first) + length
        file.truncate(whole)
        results = _Results(name, file.fileno())
        if not is_begun:
            results.add(mark)
        yield results, rows


_LONGEST_MARK = 4096
"""Of the line that says of which sweep a file is [byte]; it has about 150."""
_LONGEST_ROW = 1 << 30
"""Of a line with a row [byte]."""


def _require_regular(name: str) -> None:
    """Refuses what has no end, such as a device: of a file of results all is read."""
    try:
        mode = os.stat(name).st_mode
    except FileNotFoundError:
        return
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), name)
    if not stat.S_ISREG(mode):
        raise SweepError(f"{name}: is no regular file; allowed: one, or a name that is not taken")


class _Results(NamedTuple):
    """Where rows are added."""

    name: str
    file: int

    def add(self, line: str) -> None:
        """Adds a line, whole on its way to the file when this returns.

        :raises OSError: such as of a full disk, with the name of the file; what is there of the line counts as not there
        """
        rest = memoryview(line.encode() + b"\n")
        if len(rest) > _LONGEST_ROW:
            raise SweepError(
                f"{self.name}: a row of {len(rest)} bytes is too long; allowed: {_LONGEST_ROW}, as of fewer signals"
            )
        try:
            while rest:
                rest = rest[os.write(self.file, rest) :]
        except OSError as error:
            raise OSError(error.errno, error.strerror, self.name) from None


_written: set[str] = set()
"""Files of the sweeps of this process."""


@contextmanager
def _alone(path: str | os.PathLike[str], file: IO[bytes]) -> Iterator[None]:
    """Keeps other sweeps from a file. The lock is one of a process: workers that it forked, and that outlive it for a
    moment when it is killed, do not have it; so sweeps of the same process are told by the list."""
    name = os.path.realpath(path)
    if name in _written:
        raise SweepError(f"{os.fspath(path)}: another sweep writes to it")
    _written.add(name)
    try:
        try:
            fcntl.lockf(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except (BlockingIOError, PermissionError):
            raise SweepError(f"{os.fspath(path)}: another sweep writes to it") from None
        yield
    finally:
        _written.discard(name)


def _rows_of(name: str, file: IO[bytes], count: int) -> tuple[dict[int, Row], int]:
    """The rows that are there from here on, and how long their lines are in all [byte]."""
    rows: dict[int, Row] = {}
    length = 0
    for number in itertools.count(2):
        line = file.readline(_LONGEST_ROW + 1)
        if len(line) > _LONGEST_ROW:
            raise SweepError(f"{name}:{number}: the line is longer than {_LONGEST_ROW} bytes")
        if not line.endswith(b"\n"):
            return rows, length
        length += len(line)
        try:
            row = _row_of(line)
        except (ValueError, KeyError, TypeError, RecursionError) as error:
            raise SweepError(f"{name}:{number}: is no row of a sweep: {error}") from None
        if not 0 <= row.index < count:
            raise SweepError(f"{name}:{number}: there is no variant {row.index}")
        rows[row.index] = row
    raise AssertionError


def _mark_of(work: _Work, wanted: list[dict[str, Any]]) -> str:
    """Says which sweep it is: whatever its results depend on."""
    function = None
    if work.function:
        function = [getattr(work.function, "__qualname__", repr(type(work.function))), _code_of(work.function)]
    parts = [_lockstep.__version__, work.source.text.decode("latin-1"), work.source.folder, work.seconds, work.values]
    parts += [function, work.signals, work.traces, wanted]
    digest = hashlib.sha256(json.dumps(parts).encode()).hexdigest()
    return json.dumps({"lockstep": "sweep", "variants": len(wanted), "of": digest})


def _code_of(function: Measure) -> str | None:
    try:
        return inspect.getsource(function)
    except (OSError, TypeError):
        return None  # such as typed in: the name has to do


def _require_same(path: str | os.PathLike[str], line: bytes, mark: str) -> None:
    if line == mark.encode():
        return
    try:
        is_sweep = _json_of(line).get("lockstep") == "sweep"
    except (ValueError, TypeError):
        is_sweep = False
    if not is_sweep:
        raise SweepError(f"{os.fspath(path)}: is no file of a sweep")
    raise SweepError(
        f"{os.fspath(path)}: is of a sweep with another project, grid, duration, values, function, signals or version; "
        "allowed: the same ones, or another file"
    )
