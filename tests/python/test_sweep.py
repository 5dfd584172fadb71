"""Sweeps: the same rows on every executor, also after a kill; what fails is told in its row."""

import json
import os
import signal
import subprocess
import sys
import threading
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
import sweeping

import lockstep


@pytest.fixture(scope="module")
def rows():
    """Of the sweep without an executor."""
    return sweeping.everything(None)


def test_a_row_has_the_variant_its_values_and_its_trace(rows, small):
    assert [row.index for row in rows] == list(range(6))
    assert [row.variant for row in rows] == lockstep.variants(sweeping.GRID)
    assert rows[1].variant == {"/clock/servo_cycle": "1ms", "speed": 20.0, "go": True}
    for row in rows:
        project = lockstep.Project(small, changes=row.variant)
        project.run(sweeping.SECONDS)
        assert row.error is None and row.trace == project.trace
        assert row.values["v"] == project["Axis.Velocity"] == row.variant["speed"]
        assert row.values["peak"] == project.trace["Axis.Position"].max()
        assert np.array_equal(row.values["all"], project.trace["total"]) and row.values["all"].dtype == np.uint64
        assert row.values["flags"].dtype == bool and row.values["pair"] == [1, [2.5]]


@pytest.mark.parametrize("executor", [ProcessPoolExecutor, ThreadPoolExecutor])
@pytest.mark.parametrize("in_flight", [None, 1, 3])
def test_every_executor_gives_the_same_bits(executor, in_flight, rows):
    with executor(2) as pool:
        assert sweeping.everything(pool, in_flight=in_flight) == rows


def test_a_thousand_variants_are_a_thousand_rows(small):
    speeds = [float(speed) for speed in range(1, 1001)]
    with ProcessPoolExecutor(2) as pool:
        rows = lockstep.sweep(small, {"speed": speeds, "go": [True]}, pool, seconds=0.05, values=["speed", "Axis.Velocity"])
    assert [row.values["speed"] for row in rows] == speeds
    assert not any(row.error for row in rows)


class Counting(Executor):
    """Runs what it is given one after the other, in a thread, and counts how many wait."""

    def __init__(self):
        self.pool = ThreadPoolExecutor(1)
        self.lock = threading.Lock()
        self.waiting = self.highest = 0

    def submit(self, fn, /, *args, **kwargs) -> Future:
        with self.lock:
            self.waiting += 1
            self.highest = max(self.highest, self.waiting)
        future = self.pool.submit(fn, *args, **kwargs)
        future.add_done_callback(self.done)
        return future

    def done(self, _):
        with self.lock:
            self.waiting -= 1


def test_the_number_in_flight_is_bounded(small):
    executor = Counting()
    rows = lockstep.sweep(small, {"count": range(40)}, executor, seconds=0.01, values=["count"], in_flight=5)
    assert [row.values["count"] for row in rows] == list(range(40))
    assert executor.highest == 5
    for wrong in (0, -1):
        with pytest.raises(lockstep.OutOfRange, match="in_flight"):
            lockstep.sweep(small, {}, seconds=1.0, in_flight=wrong)


def test_a_variant_that_fails_tells_it_in_its_row(small):
    variants = [
        {"speed": 10.0},
        {"speed": 20.0},
        {"/clock/servo_cycle": "0ms"},
        {"/clock/nothing/more": 1},
        {"speeed": 1.0},
        {"count": 40000},
        {"count": "x"},
        {"speed": 30.0},
    ]
    with ProcessPoolExecutor(2) as pool:
        rows = lockstep.sweep(small, variants, pool, seconds=0.1, function=sweeping.fails_at_twenty)
    assert [row.error is None for row in rows] == [True] + [False] * 6 + [True]
    begins = [None, "ArithmeticError: twenty", "InvalidProject", "PathError", "PathError", "OutOfRange", "TypeError", None]
    for row, begin in zip(rows, begins):
        assert begin is None or (row.error.startswith(begin) and row.values == {} and row.trace is None), row
    for function in (sweeping.gives_what_nobody_keeps, sweeping.gives_no_mapping):
        (row,) = lockstep.sweep(small, [{}], seconds=0.1, function=function)
        assert row.error.startswith("TypeError")
    (row,) = lockstep.sweep(small, [{}], seconds=0.1, values=["speed +"])
    assert row.error.startswith("ExpressionError")


def test_a_sweep_of_nothing_is_empty(small):
    assert lockstep.sweep(small, [], seconds=1.0) == []
    assert lockstep.sweep(small, {"speed": []}, seconds=1.0) == []
    assert len(lockstep.sweep(small, {}, seconds=0.0)) == 1


@pytest.mark.parametrize(
    "wrong",
    [{"grid": {"speed": 3.0}}, {"grid": {"speed": "12"}}, {"grid": [{"speed": object()}]}, {"values": "speed"}, {"signals": "go"}],
)
def test_wrong_arguments_are_told_before_anything_runs(small, wrong):
    with pytest.raises(TypeError):
        lockstep.sweep(small, **{"grid": {"speed": [1.0]}, "seconds": 1.0, **wrong})


@pytest.mark.parametrize("seconds", [-1.0, float("nan"), 1e10])
def test_the_duration_has_a_range(small, seconds):
    with pytest.raises(lockstep.OutOfRange):
        lockstep.sweep(small, {}, seconds=seconds)


def test_progress_is_told(small, tmp_path):
    told = []
    arguments = dict(seconds=0.01, values=["count"], results=tmp_path / "rows", progress=lambda *now: told.append(now))
    rows = lockstep.sweep(small, {"count": range(3)}, **arguments)
    assert told == [(1, 3, rows[0]), (2, 3, rows[1]), (3, 3, rows[2])]
    told.clear()
    assert lockstep.sweep(small, {"count": range(3)}, **arguments) == rows
    assert told == [(3, 3, None)]


def test_a_killed_sweep_goes_on_and_gives_the_same(rows, tmp_path):
    results = tmp_path / "rows.jsonl"
    killed = subprocess.run([sys.executable, Path(sweeping.__file__), "3", results], timeout=120)
    assert killed.returncode == -signal.SIGKILL
    assert len(results.read_bytes().split(b"\n")) == 5  # what it is of, three rows, an end
    begun = []
    with ProcessPoolExecutor(2) as pool:
        resumed = sweeping.everything(pool, results=results, progress=lambda done, total, row: begun.append(done))
    assert begun == [3, 4, 5, 6]
    assert resumed == rows
    assert sweeping.everything(None, results=results) == rows


def test_a_row_that_was_cut_short_is_run_again(rows, tmp_path):
    results = tmp_path / "rows.jsonl"
    sweeping.everything(None, results=results)
    whole = results.read_bytes()
    ends = [at for at, byte in enumerate(whole) if byte == 10]
    for cut in (5, ends[0], ends[0] + 1, ends[0] + 9, ends[2] - 1, ends[2], len(whole) - 1):
        results.write_bytes(whole[:cut])
        assert sweeping.everything(None, results=results) == rows, cut
        assert results.read_bytes() == whole


def test_results_of_another_sweep_are_refused_and_left_alone(small, tmp_path):
    results = tmp_path / "rows.jsonl"
    arguments = dict(seconds=0.01, values=["count"], results=results)
    lockstep.sweep(small, {"count": [1, 2]}, **arguments)
    before = results.read_bytes()
    others = [
        dict(arguments, grid={"count": [1, 3]}),
        dict(arguments, grid={"count": [1, 2]}, seconds=0.02),
        dict(arguments, grid={"count": [1, 2]}, values=["speed"]),
        dict(arguments, grid={"count": [1, 2]}, traces=True),
        dict(arguments, grid={"count": [1, 2]}, function=sweeping.measure),
    ]
    for other in others:
        with pytest.raises(lockstep.SweepError, match="another"):
            lockstep.sweep(small, **other)
    with pytest.raises(lockstep.SweepError, match="another"):
        lockstep.sweep(dict(small, name="other"), {"count": [1, 2]}, **arguments)
    assert results.read_bytes() == before
    for text in (b"a letter", b"a letter\n", b'{"lockstep": 1}\n', b"[]\n"):
        results.write_bytes(text)
        with pytest.raises(lockstep.SweepError, match="no file of a sweep"):
            lockstep.sweep(small, {"count": [1, 2]}, **arguments)
        assert results.read_bytes() == text
    results.write_bytes(before.split(b"\n")[0] + b"\nx\n")
    with pytest.raises(lockstep.SweepError, match="rows.jsonl:2"):
        lockstep.sweep(small, {"count": [1, 2]}, **arguments)


def test_two_sweeps_do_not_write_to_one_file(small, tmp_path):
    results = tmp_path / "rows.jsonl"
    refused = []

    def begin_another(done, total, row):
        with pytest.raises(lockstep.SweepError, match="another sweep writes"):
            lockstep.sweep(small, {"count": [1]}, seconds=0.01, results=results)
        refused.append(done)

    lockstep.sweep(small, {"count": [1]}, seconds=0.01, results=results, progress=begin_another)
    assert refused == [1]


def test_an_error_of_progress_ends_the_sweep(small):
    def fail(done, total, row):
        raise ZeroDivisionError

    with ThreadPoolExecutor(2) as pool, pytest.raises(ZeroDivisionError):
        lockstep.sweep(small, {"count": range(100)}, pool, seconds=0.01, progress=fail)


@pytest.mark.parametrize("device", ["/dev/full", "/dev/zero", "/dev/null", "pipe"])
def test_results_are_a_regular_file(small, tmp_path, device):
    name = tmp_path / "rows.jsonl"
    if device == "pipe":
        os.mkfifo(name)
    else:
        name.symlink_to(device)
    with pytest.raises(lockstep.SweepError, match="rows.jsonl: is no regular file"):
        lockstep.sweep(small, [{}], seconds=0.1, results=name)


def test_lines_of_results_have_a_limit(small, tmp_path, monkeypatch):
    from lockstep import sweeps

    results = tmp_path / "rows.jsonl"
    with results.open("wb") as file:
        file.truncate(1 << 40)  # of holes
    with pytest.raises(lockstep.SweepError, match="no file of a sweep"):
        lockstep.sweep(small, [{}], seconds=0.1, results=results)
    results.unlink()
    arguments = dict(seconds=0.1, values=["speed"], results=results)
    lockstep.sweep(small, [{}], **arguments)
    monkeypatch.setattr(sweeps, "_LONGEST_ROW", 50)
    before = results.read_bytes()
    with pytest.raises(lockstep.SweepError, match="rows.jsonl:2: the line is longer"):
        lockstep.sweep(small, [{}], **arguments)
    assert results.read_bytes() == before
    monkeypatch.setattr(sweeps, "_LONGEST_ROW", 150)
    results.unlink()
    with pytest.raises(lockstep.SweepError, match="rows.jsonl: a row of .* too long"):
        lockstep.sweep(small, [{"count": 1}], function=sweeping.writes_much, **arguments)


ROW = {"index": 0, "variant": {}, "values": {}, "trace": None, "error": None}
ARRAY = {"array": "AAAAAAAA8D8=", "type": "<f8", "shape": [1]}


@pytest.mark.parametrize(
    "damaged",
    [
        {"index": "1"}, {"index": True}, {"index": 1.0}, {"index": None}, {"variant": []}, {"values": []}, {"values": None},
        {"error": 3}, {"trace": 3}, {"trace": {}}, {"trace": []}, {"trace": {"time": ARRAY, "signals": 3}},
        {"trace": {"time": [0.0], "signals": []}}, {"trace": {"time": ARRAY, "signals": [["a", "LREAL", ""]]}},
        {"trace": {"time": ARRAY, "signals": [[[], "LREAL", "", ARRAY]]}}, {"values": {"a": dict(ARRAY, type="O")}},
        {"values": {"a": dict(ARRAY, type="(1,")}}, {"values": {"a": dict(ARRAY, type=3)}}, {"values": {"a": dict(ARRAY, shape=[2])}},
        {"values": {"a": dict(ARRAY, shape=["x"])}}, {"values": {"a": dict(ARRAY, array=3)}}, {"index": 7}, {"index": -1},
    ],
)  # fmt: skip
def test_damaged_rows_are_told_by_their_line(small, tmp_path, damaged):
    results = tmp_path / "rows.jsonl"
    arguments = dict(seconds=0.01, values=["count"], results=results)
    lockstep.sweep(small, [{}, {}], **arguments)
    first, second, *_ = results.read_bytes().split(b"\n")
    results.write_bytes(b"\n".join([first, second, json.dumps({**ROW, **damaged}).encode(), b""]))
    with pytest.raises(lockstep.SweepError, match="rows.jsonl:3: "):
        lockstep.sweep(small, [{}, {}], **arguments)


@pytest.mark.parametrize("line", [b"[" * 200_000, b'{"index":' * 200_000, b"3", b"null", b"[]", b"\xff", b"{}", b"1" * 10_000])
def test_lines_that_are_no_rows_are_told(small, tmp_path, line):
    results = tmp_path / "rows.jsonl"
    arguments = dict(seconds=0.01, values=["count"], results=results)
    lockstep.sweep(small, [{}], **arguments)
    first = results.read_bytes().split(b"\n")[0]
    results.write_bytes(b"\n".join([first, line, b""]))
    with pytest.raises(lockstep.SweepError, match="rows.jsonl:2: "):
        lockstep.sweep(small, [{}], **arguments)
    results.write_bytes(line + b"\n")
    with pytest.raises(lockstep.SweepError, match="no file of a sweep"):
        lockstep.sweep(small, [{}], **arguments)


def test_a_full_disk_names_the_file(tmp_path):
    results = tmp_path / "rows.jsonl"
    script = (
        "import resource, signal, sys; sys.path.insert(0, sys.argv[2]); from conftest import SMALL; import lockstep\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        "def sweep(): return lockstep.sweep(SMALL, {'count': range(100)}, seconds=0.01, values=['count'], results=sys.argv[1])\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (2000, resource.RLIM_INFINITY))\n"
        "try: sweep()\n"
        "except OSError as error: print(error.filename)\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))\n"
        "print(len(sweep()))\n"
    )
    ran = subprocess.run([sys.executable, "-c", script, results, Path(__file__).parent], capture_output=True, text=True, timeout=120)
    assert ran.stdout.split() == [str(results), "100"], ran.stderr
