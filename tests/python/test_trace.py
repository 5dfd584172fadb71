"""Traces: the same bits as the command's, without a copy, and safe for as long as an array is there."""

import csv
import gc
import json
import pickle
import subprocess
import weakref

import numpy as np
import pytest
from conftest import ROOT

import lockstep

EXAMPLES = sorted(path.parent.name for path in (ROOT / "projects").glob("[0-9][0-9]_*/project.json"))


def test_there_are_examples():
    assert len(EXAMPLES) >= 11


@pytest.mark.parametrize("example", EXAMPLES)
def test_it_has_the_bits_of_the_command(example, program, tmp_path):
    file = ROOT / "projects" / example / "project.json"
    written = tmp_path / "trace.csv"
    subprocess.run(
        [program, "run", file, "--simulate", "--duration", "5s", "--trace", written], check=True, capture_output=True
    )
    there = lockstep.read_trace(written)
    with lockstep.Project(file) as project:
        project.run(5.0)
        trace = project.trace
    assert trace.names == there.names and trace.rows == there.rows > 100
    assert trace.time.tobytes() == there.time.tobytes()
    for name in trace:
        assert trace[name].astype(float).tobytes() == there[name].tobytes(), name


def test_names_of_signals_are_blind_to_case(knife):
    with lockstep.Project(knife) as project:
        project.step(10)
        trace = project.trace
    name = trace.names[0]
    assert trace[name.upper()] is trace[name.lower()] is trace[name]
    assert name.upper() in trace and 3 not in trace and "none" not in trace


def test_it_is_the_stored_trace_of_the_example(knife):
    stored = ROOT / "tests" / "data" / "scenario_02_rotary_knife.csv"
    with stored.open() as file:
        names, *rows = csv.reader(file)
    columns = np.array(rows, float).T
    project = lockstep.Project(knife)
    project.run(5.0)
    assert ["t", *project.trace.names] == names
    assert np.array_equal(project.trace.time[::20], columns[0])
    for name, column in zip(names[1:], columns[1:]):
        np.testing.assert_allclose(project.trace[name][::20].astype(float), column, atol=1e-6, rtol=1e-9, err_msg=name)


def test_runs_and_divisions_of_runs_have_the_same_bits(knife):
    whole, parts = lockstep.Project(knife), lockstep.Project(knife)
    whole.run(4.0)
    parts.step()
    parts.step(999)
    parts.run(1.0, until="FALSE")
    parts.trace["Knife.Position"]
    parts.run(2.0)
    assert parts.trace == whole.trace
    parts.step(2)
    assert parts.trace != whole.trace


def test_columns_have_types_units_and_times(small):
    project = lockstep.Project(small, signals=["go", "count", "total", "mask", "pause", "share", "Axis.Velocity", "mask.X1"])
    project["count"], project["mask"], project["pause"], project["share"] = -3, 2, 0.3, 0.1
    project.step(6)
    trace = project.trace
    assert trace.names == ("go", "count", "total", "mask", "pause", "share", "Axis.Velocity", "mask.X1")
    assert list(trace.time) == [0.0, 0.002, 0.004]  # of the interpolator cycle
    assert [str(trace[name].dtype) for name in trace] == [
        "bool", "int64", "uint64", "uint64", "float64", "float64", "float64", "bool",
    ]  # fmt: skip
    assert list(trace["count"]) == [-3] * 3 and list(trace["total"]) == [1, 3, 5]
    assert list(trace["mask.X1"]) == [True] * 3 and list(trace["go"]) == [False] * 3
    assert list(trace["pause"]) == [0.3] * 3 and list(trace["share"]) == [float(np.float32(0.1))] * 3
    assert trace.units["Axis.Velocity"] == "mm/s" and trace.units["go"] == ""
    assert trace.types["pause"] == "TIME"
    assert repr(trace) == "<lockstep.Trace: 3 rows of 8 signals, 0 s to 0.004 s>"
    assert trace._ipython_key_completions_() == list(trace) and len(trace) == 8
    with pytest.raises(KeyError, match="no signal 'Axis.Speed'"):
        trace["Axis.Speed"]


def test_a_signal_is_recorded_once_and_none_if_none_is_wanted(small):
    project = lockstep.Project(small, signals=["go", "count", "go"])
    assert project.trace.names == ("go", "count") and project.trace.rows == 0
    silent = lockstep.Project(small, signals=[])
    silent.step(10)
    assert (silent.trace.rows, len(silent.trace)) == (0, 0)
    assert repr(silent.trace) == "<lockstep.Trace: 0 rows of 0 signals>"
    for path in ("kind", "heights", "Axis", "nothing"):
        with pytest.raises(lockstep.PathError):
            lockstep.Project(small, signals=[path])


def test_arrays_look_into_the_memory_of_the_run(small):
    project = lockstep.Project(small)
    project.step(100)
    view = project._run.trace()
    first, second = project.trace, project.trace
    for index, name in enumerate(first):
        address = view.column_address(index)
        for array in (first[name], second[name], view.column(index)):
            assert array.__array_interface__["data"] == (address, True)  # that memory, and read-only
            assert not array.flags.owndata and array.strides == (8,)
        assert np.shares_memory(first[name], second[name])
    assert first.time.__array_interface__["data"] == (view.address, True)
    # What the run writes next is seen in memory that was asked for before: nothing lies between.
    project.step(2)
    longer = project.trace["total"]
    assert longer.__array_interface__["data"][0] == first["total"].__array_interface__["data"][0]
    assert len(longer) == len(first["total"]) + 1


def test_arrays_cannot_be_written(small):
    project = lockstep.Project(small)
    project.step(10)
    for array in (project.trace["total"], project.trace.time):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1
        with pytest.raises(ValueError):
            array.setflags(write=True)


def test_the_memory_lives_as_long_as_an_array(small):
    project = lockstep.Project(small)
    project.run(1.0)
    trace = project.trace
    part = trace["total"][10:20][::2]
    expected = [21, 25, 29, 33, 37]
    view = trace["total"].base
    owner = weakref.ref(view)
    project.close()
    del project, trace, view
    gc.collect()
    # Memory that had been given back would be written over by these.
    others = [np.full(4096, 255, np.uint8) for _ in range(200)]
    runs = [lockstep.Project(small) for _ in range(3)]
    for run in runs:
        run.run(1.0)
    assert owner() is not None and list(part) == expected
    del part
    gc.collect()
    assert owner() is None  # and not longer
    del others


def test_arrays_stay_as_they_are_when_the_trace_grows_out_of_its_memory(small):
    project = lockstep.Project(small)
    kept = []
    for _ in range(12):
        project.run(2.0)
        kept.append((project.trace, project.trace["total"].copy()))
    addresses = {trace["total"].__array_interface__["data"][0] for trace, _ in kept}
    assert 2 <= len(addresses) < 12  # it moved, and not each time
    for trace, copy in kept:
        assert np.array_equal(trace["total"], copy) and len(trace.time) == len(copy)
    assert np.array_equal(project.trace["total"], np.arange(1, 24001, 2))


def test_a_trace_is_pickled_and_compared(small):
    project = lockstep.Project(small)
    project.run(0.5)
    trace = project.trace
    again = pickle.loads(pickle.dumps(trace))
    assert again == trace and again.units == trace.units and again.types == trace.types
    assert trace != 3
    with pytest.raises(TypeError):
        hash(trace)
    with pytest.raises(ValueError, match="rows"):
        lockstep.Trace.from_arrays(trace.time, {"a": trace.time[1:]}, {"a": "LREAL"}, {"a": ""})


def test_files_of_the_command_are_read(knife, program, tmp_path):
    traces = {}
    for name in ("run.csv", "run.lcm"):
        file = tmp_path / name
        subprocess.run(
            [program, "run", knife, "--simulate", "--duration", "2s", "--trace", file], check=True, capture_output=True
        )
        traces[name] = lockstep.read_trace(file)
    project = lockstep.Project(knife)
    project.run(2.0)
    assert traces["run.lcm"].names == traces["run.csv"].names == project.trace.names
    assert traces["run.lcm"].units == project.trace.units
    for name in project.trace:
        assert traces["run.lcm"][name].astype(float).tobytes() == traces["run.csv"][name].tobytes()
    broken = tmp_path / "broken.csv"
    broken.write_text("t,a\n0,x\n")
    with pytest.raises(lockstep.TraceError, match="broken.csv:2"):
        lockstep.read_trace(broken)
    with pytest.raises(lockstep.TraceError, match="none.csv"):
        lockstep.read_trace(tmp_path / "none.csv")


@pytest.mark.parametrize(
    "content", [b"t,\xff\n0,1\n", b"t,a\n0,\xff\n", b"\xff,a\n0,1\n", b"t,a\n\xff\n", b"\xff\xfet\x00,\x00a\x00\n\x00"]
)
@pytest.mark.parametrize("ending", ["csv", "lcm"])
def test_what_is_no_text_is_told(tmp_path, content, ending):
    file = tmp_path / f"caf\udce9.{ending}"
    file.write_bytes(content)
    with pytest.raises(lockstep.TraceError, match=r"caf\\xe9"):
        lockstep.read_trace(file)


def test_a_name_of_a_signal_in_a_log_that_is_no_text_is_told(small, program, tmp_path):
    (tmp_path / "small.json").write_text(json.dumps(small))
    log = tmp_path / "run.lcm"
    subprocess.run([program, "run", tmp_path / "small.json", "--simulate", "--duration", "1s", "--trace", log], check=True, capture_output=True)
    assert lockstep.read_trace(log).rows > 0
    log.write_bytes(log.read_bytes().replace(b"Axis.Position", b"Axis.Posit\xffon"))
    with pytest.raises(lockstep.TraceError, match=r"run.lcm"):
        lockstep.read_trace(log)


@pytest.mark.parametrize("ending", ["csv", "lcm"])
def test_a_trace_is_a_regular_file(tmp_path, ending):
    file = tmp_path / f"zero.{ending}"
    file.symlink_to("/dev/zero")
    with pytest.raises(lockstep.TraceError, match="is no regular file"):
        lockstep.read_trace(file)
