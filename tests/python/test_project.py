"""Projects in virtual time: loading, stepping, reading, writing, and what goes wrong."""

import copy
import datetime
import gc
import json
import math
import pickle
import pydoc
import re
import signal
import subprocess
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import lockstep


def test_a_valid_project_has_no_problems(knife):
    assert [problem for problem in lockstep.check(knife) if problem.severity == "error"] == []
    assert lockstep.check(str(knife)) == lockstep.check(knife)


def test_all_problems_are_told_with_their_places(small):
    wrong = copy.deepcopy(small)
    wrong["tags"]["speed"]["type"] = "FLOAT"
    wrong["clock"]["servo_cycle"] = "0ms"
    problems = lockstep.check(wrong)
    assert {"/tags/speed/type", "/clock/servo_cycle"} <= {problem.place for problem in problems}
    with pytest.raises(lockstep.InvalidProject) as error:
        lockstep.Project(wrong)
    assert error.value.problems == problems
    wrong_only = [problem for problem in problems if problem.severity == "error"]
    assert all(str(problem) in str(error.value) for problem in wrong_only) and len(wrong_only) >= 2
    again = pickle.loads(pickle.dumps(error.value))
    assert again.problems == problems and str(again) == str(error.value)


def test_what_is_no_json_is_told_at_its_line(tmp_path):
    file = tmp_path / "broken.json"
    file.write_bytes(b'{ "lockstep": 1,\n  "name" \xff }')
    (problem, *_) = lockstep.check(file)
    assert problem.place.startswith("2:") and problem.file == str(file)
    for changes in (None, {"/name": "other"}):
        with pytest.raises(lockstep.InvalidProject, match=rf"{re.escape(str(file))}:\S*:"):
            lockstep.Project(file, changes=changes)
    with pytest.raises(FileNotFoundError):
        lockstep.check(tmp_path / "none.json")
    with pytest.raises(IsADirectoryError):
        lockstep.Project(tmp_path)
    for other in (None, 3, b"bytes"):
        with pytest.raises(TypeError, match="path of its file"):
            lockstep.check(other)


def test_problems_are_told_as_the_command_tells_them(small, program, tmp_path):
    wrong = copy.deepcopy(small)
    wrong["programs"][0]["calls"][2]["in"]["Velocity"] = "sped"
    wrong["include"] = ["more.json"]
    file = tmp_path / "wrong.json"
    file.write_text(json.dumps(wrong, indent=2))
    (tmp_path / "more.json").write_text('{\n  "tags": { "more": { "type": "FLOAT" } }\n}')
    problems = lockstep.check(file)
    told = subprocess.run([program, "check", file], capture_output=True, text=True)
    assert told.stderr.splitlines() == [str(problem) for problem in problems]
    (here,) = [problem for problem in problems if "'sped'" in problem.text]
    assert here.file == str(file) and here.owner == "call 'run'" and '"sped"' in file.read_text().splitlines()[here.line - 1]
    (there,) = [problem for problem in problems if "FLOAT" in problem.text]
    assert there.file == str(tmp_path / "more.json") and (there.line, there.column) == (2, 31)
    # Lines of a text that nobody has written say nothing.
    changed = lockstep.check(file, changes={"/name": "other"})
    assert [(problem.place, problem.line) for problem in changed if problem.file == str(file)] == [(here.place, 0)]
    with pytest.raises(lockstep.InvalidProject) as error:
        lockstep.Project(file)
    assert error.value.problems == problems and pickle.loads(pickle.dumps(error.value)).problems == problems


def test_a_text_that_is_no_json_is_a_problem_of_its_line(program, tmp_path):
    file = tmp_path / "broken.json"
    file.write_text('{\n  "lockstep": 1,\n  "name": broken\n}\n')
    (problem,) = lockstep.check(file)
    assert (problem.file, problem.line, problem.column > 10) == (str(file), 3, True)
    told = subprocess.run([program, "check", file], capture_output=True, text=True)
    assert told.stderr.splitlines() == [str(problem)]
    with pytest.raises(lockstep.InvalidProject) as error:
        lockstep.Project(file)
    assert error.value.problems == [problem] and pickle.loads(pickle.dumps(error.value)).problems == [problem]


@pytest.mark.parametrize("tuple_type", [lockstep.Event, lockstep.PathInfo, lockstep.Problem])
def test_help_tells_what_each_field_is(tuple_type):
    text = pydoc.plain(pydoc.render_doc(tuple_type))
    assert "Alias for field" not in text
    for name in tuple_type._fields:
        assert getattr(tuple_type, name).__doc__.rstrip().endswith((".", "it.", "``"))
    if tuple_type is lockstep.Event:
        assert "Of the tick, since the start of the run [s]." in text


def test_it_steps_by_ticks_and_by_seconds(small):
    with lockstep.Project(small) as project:
        project.step()
        assert (project.ticks, project.time, project.servo_cycle) == (1, 0.001, 0.001)
        project.step(4)
        project.run(0.0101)  # rounded up to a whole tick
        assert project.ticks == 16
        project.run(datetime.timedelta(milliseconds=4))
        project.step(0)
        project.run(0)
        assert project.time == 0.02


@pytest.mark.parametrize("n", [-1, 2**63, 2**70])
def test_a_number_of_ticks_has_a_range(small, n):
    with pytest.raises(lockstep.OutOfRange):
        lockstep.Project(small).step(n)


@pytest.mark.parametrize("seconds", [-1e-9, math.nan, math.inf, 1e10])
def test_a_duration_has_a_range(small, seconds):
    project = lockstep.Project(small)
    with pytest.raises(ValueError, match="seconds may not be"):
        project.run(seconds)
    assert project.ticks == 0


def test_it_runs_until_a_condition_holds(small):
    project = lockstep.Project(small, changes={"go": True})
    assert project.run(10.0, until="run.InVelocity AND total > 5")
    before = project.time
    assert 0 < before < 10.0
    assert project.run(10.0, until="run.InVelocity")
    assert project.time == before
    assert not project.run(0.01, until="count = 1")
    with pytest.raises(lockstep.ExpressionError, match="column 1"):
        project.run(1.0, until="runn.InVelocity")
    with pytest.raises(lockstep.ExpressionError):
        project.run(1.0, until="speed")


VALUES = [
    ("go", True, True),
    ("go", np.bool_(True), True),
    ("speed", 25, 25.0),
    ("speed", np.float32(2.5), 2.5),
    ("share", 0.1, float(np.float32(0.1))),
    ("count", -32768, -32768),
    ("count", np.int64(7), 7),
    ("long", -(2**63), -(2**63)),
    ("long", 2**63 - 1, 2**63 - 1),
    ("total", 2**64 - 1, 2**64 - 1),
    ("mask", 0xFFFF, 0xFFFF),
    ("mask.X3", True, True),
    ("pause", 0.25, 0.25),
    ("pause", datetime.timedelta(seconds=2), 2.0),
    ("kind", "stout", "stout"),
    ("kind", "grün", "grün"),
    ("heights", [1.0, 2.0, 3.0, 4.0], [1.0, 2.0, 3.0, 4.0]),
    ("heights[1..2]", np.array([8.0, 9.0]), [8.0, 9.0]),
    ("heights[3]", 4, 4.0),
    ("points[*].x", (1.0, 2.0), [1.0, 2.0]),
    ("Axis.Override.Velocity", 50.0, 50.0),
    ("AXIS.override.VELOCITY", 50.0, 50.0),
]


@pytest.mark.parametrize("path, value, read", VALUES)
def test_what_is_written_is_read_in_its_type(small, path, value, read):
    project = lockstep.Project(small)
    project[path] = value
    assert project[path] == read
    assert type(project[path]) is type(read)


@pytest.mark.parametrize("path", ["nothing", "Axis.Positon", "Axis", "run", "heights[9]", "points", "", "a b", "power.Axis"])
def test_an_unknown_path_is_told(small, path):
    project = lockstep.Project(small)
    with pytest.raises(lockstep.PathError) as error:
        project[path]
    assert isinstance(error.value, KeyError)
    text = str(error.value)
    assert text == error.value.args[0] and (path == "" or path.split(".")[-1].split("[")[0] in text)
    with pytest.raises(lockstep.PathError):
        project[path] = 1
    assert path not in project


def test_what_is_near_an_unknown_path_is_named(small):
    with pytest.raises(lockstep.PathError, match="did you mean"):
        lockstep.Project(small)["Axis.Positon"]


WRONG = [
    ("go", 1),
    ("go", "TRUE"),
    ("go", None),
    ("speed", "10"),
    ("speed", True),
    ("speed", None),
    ("speed", 1j),
    ("speed", [1.0]),
    ("count", 1.0),
    ("count", True),
    ("count", "1"),
    ("pause", "1s"),
    ("kind", 3),
    ("kind", b"ale"),
    ("heights", 1.0),
    ("heights", "1234"),
    ("heights", {1.0, 2.0, 3.0, 4.0}),
    ("heights", [1.0, 2.0, "3.0", 4.0]),
]


@pytest.mark.parametrize("path, value", WRONG)
def test_a_wrong_type_is_told(small, path, value):
    project = lockstep.Project(small)
    before = project[path]
    with pytest.raises(TypeError, match="allowed"):
        project[path] = value
    assert project[path] == before


OUTSIDE = [
    ("speed", math.nan),
    ("speed", math.inf),
    ("speed", 10**400),
    ("share", 1e300),
    ("count", 32768),
    ("count", -(10**30)),
    ("total", -1),
    ("total", 2**64),
    ("mask", 65536),
    ("pause", 1e10),
    ("pause", math.nan),
    ("kind", "a long text"),
    ("kind", "漢"),
    ("kind", "a\n"),
    ("Axis.Override.Velocity", 300.0),
]


@pytest.mark.parametrize("path, value", OUTSIDE)
def test_a_value_out_of_range_is_told(small, path, value):
    project = lockstep.Project(small)
    before = project[path]
    with pytest.raises(lockstep.OutOfRange, match="allowed") as error:
        project[path] = value
    assert isinstance(error.value, ValueError) and path in str(error.value)
    assert project[path] == before


def test_another_number_of_elements_is_told(small):
    with pytest.raises(ValueError, match="has 4 elements, not 3"):
        lockstep.Project(small)["heights"] = [1.0, 2.0, 3.0]


@pytest.mark.parametrize("path", ["Axis.Position", "Axis.StatusWord.X0", "run.Velocity", "Axis.VirtualAxis.Mode"])
def test_what_is_read_only_is_told(small, path):
    project = lockstep.Project(small)
    value = project[path]
    with pytest.raises(lockstep.ReadOnly, match="cannot be written") as error:
        project[path] = value
    assert isinstance(error.value, TypeError)
    assert project.info(path).read_only


def test_a_path_is_a_str(small):
    project = lockstep.Project(small)
    for path in (0, None, b"go", Path("go")):
        with pytest.raises(TypeError, match="a path is a str"):
            project[path]
    with pytest.raises(TypeError):
        lockstep.Project(small, signals="Axis.Position")


def test_every_path_that_is_listed_can_be_read(knife):
    project = lockstep.Project(knife)
    paths = project.paths()
    assert {"start", "gear.InSync", "Knife.ActualPosition"} <= set(paths) and len(paths) == len(set(paths))
    for path in paths:
        assert isinstance(project[path], (bool, int, float, str, list)), path
    assert list(project) == paths == project._ipython_key_completions_()
    assert project.info("Knife.Velocity") == ("LREAL", "°/s", project.info("Knife.Velocity").read_only)
    assert project.info("Conveyor.Velocity").unit == "mm/s" and project.info("run.Velocity").unit == "mm/s"


def test_units_are_those_of_the_project(small):
    metres = copy.deepcopy(small)
    metres["technology_objects"]["Axis"]["config"]["Units"] = {"LengthUnit": 1010}
    project = lockstep.Project(metres, signals=["Axis.Velocity", "run.Velocity", "speed"])
    assert [project.info(path).unit for path in ("Axis.Position", "run.Velocity", "speed")] == ["m", "m/s", ""]
    assert project.trace.units == {"Axis.Velocity": "m/s", "run.Velocity": "m/s", "speed": ""}


def test_expressions_are_evaluated_in_their_type(small):
    project = lockstep.Project(small, changes={"speed": -2.5, "total": 2**64 - 1})
    assert project.evaluate("ABS(speed) * 2.0") == 5.0
    assert project.evaluate("speed < 0.0 AND kind = 'ale'") is True
    assert project.evaluate("total") == 2**64 - 1
    assert project.evaluate("count + 1") == 1
    assert project.evaluate("pause") == 1.5
    for wrong in ("speed +", "nothing", "kind", ""):
        with pytest.raises(lockstep.ExpressionError, match="column"):
            project.evaluate(wrong)


def test_changes_are_keys_by_pointers_and_values_by_paths(small):
    project = lockstep.Project(small, changes={"/clock/servo_cycle": "500us", "/tags/speed/init": 3e2, "count": 5})
    assert (project.servo_cycle, project["speed"], project["count"]) == (0.0005, 300.0, 5)
    assert small["clock"]["servo_cycle"] == "1ms"
    for pointer in ("/tags/none/init", "/programs/3/name", "/programs/x/name", "/name/first"):
        with pytest.raises(lockstep.PathError, match=pointer):
            lockstep.Project(small, changes={pointer: 1})
    with pytest.raises(lockstep.InvalidProject, match="servo_cycle"):
        lockstep.Project(small, changes={"/clock/servo_cycle": 3})
    assert lockstep.check(small, changes={"/name": ""})[0].place == "/name"
    with pytest.raises(lockstep.PathError):
        lockstep.check(small, changes={"speed": 1.0})
    with pytest.raises(TypeError):
        lockstep.Project(small, changes={"/name": object()})


@pytest.mark.parametrize("number", [math.nan, math.inf, -math.inf, np.float64("nan")])
def test_a_number_that_is_not_finite_is_told_with_its_place(small, knife, number):
    content = copy.deepcopy(small)
    content["tags"]["speed"]["init"] = number
    content["tags"]["heights"]["init"] = [1.0, number]
    places = ["/tags/speed/init", "/tags/heights/init/1"]
    assert [problem.place for problem in lockstep.check(content)] == places
    with pytest.raises(lockstep.InvalidProject, match="/tags/speed/init: .*is no number of JSON; allowed: finite"):
        lockstep.Project(content)
    (problem,) = lockstep.check(knife, changes={"/tags/speed/init": number})
    assert (problem.place, problem.file) == ("/tags/speed/init", str(knife))
    with pytest.raises(lockstep.InvalidProject) as error:
        lockstep.Project(knife, changes={"/tags/speed/init": number})
    assert error.value.problems == [problem]
    (row,) = lockstep.sweep(small, [{"/tags/speed/init": number}], seconds=0.01)
    assert row.error.startswith("InvalidProject: ") and "/tags/speed/init" in row.error


def test_check_lists_what_makes_a_text_no_json_where_keys_are_changed_too(tmp_path):
    file = tmp_path / "broken.json"
    file.write_text('{\n  "name": broken\n}\n')
    (problem,) = lockstep.check(file, changes={"/name": "other"})
    assert (problem.file, problem.line) == (str(file), 2)


def test_an_expression_is_a_str(small):
    project = lockstep.Project(small)
    for wrong in (3, b"go", True, ["go"]):
        with pytest.raises(TypeError, match="an expression is a str such as"):
            project.run(1.0, until=wrong)
        with pytest.raises(TypeError, match="an expression is a str such as"):
            project.evaluate(wrong)
    with pytest.raises(TypeError, match="not NoneType"):
        project.evaluate(None)
    with pytest.raises(lockstep.ExpressionError, match="allowed are 4096") as error:
        project.evaluate("(" * 100_000)
    assert len(str(error.value)) < 200  # a message, not the whole text
    assert project.ticks == 0


def test_a_project_with_comments_can_be_changed(tmp_path, small):
    file = tmp_path / "commented.json"
    text = json.dumps(small, indent=1).replace('"clock"', '// a "clock" \n /* and\n more */ "clock"').replace('"An axis', '"http://axis')
    file.write_text(text)
    assert "//" in text and "/*" in text
    project = lockstep.Project(file, changes={"/tags/speed/init": 3.5})
    assert project["speed"] == 3.5
    file.write_text(text.replace('"tags": {', '"tags": ,{'))
    with pytest.raises(lockstep.InvalidProject, match=r"\b\d\d:\d+.*no JSON"):
        lockstep.Project(file, changes={"/tags/speed/init": 3.5})


def test_a_changed_project_is_otherwise_the_same(tmp_path, knife):
    text = knife.read_text().replace('"speed":   { "type": "LREAL", "init": 200.0', '"speed":   { "type": "LREAL", "init": 2e2')
    file = tmp_path / "knife.json"
    file.write_text(text.replace('"interpolator_ratio": 2 ', '"interpolator_ratio": 2e0 '))
    assert file.read_text().count("2e") == 2
    plain = lockstep.Project(file)
    changed = lockstep.Project(file, changes={"/description": "another"})
    for project in (plain, changed):
        project.run(3.0)
    assert plain.trace == changed.trace


def test_jobs_are_events_if_they_are_asked_for(small):
    project = lockstep.Project(small, jobs=True, changes={"go": True})
    project.run(1.0)
    started = [event for event in project.events if event.kind == "job started" and event.source == "run"]
    assert started and started[0].type == "MC_MoveVelocity" and 0 <= started[0].time < 1.0
    assert project.alarms == []
    assert started[0].object == "Axis"
    disabled = copy.deepcopy(small)
    disabled["programs"][0]["calls"][1]["in"]["Enable"] = False
    disabled["programs"][0]["calls"][2]["in"]["Execute"] = "go"
    wrong = lockstep.Project(disabled, jobs=True, changes={"go": True})
    wrong.run(1.0)
    (failed,) = [event for event in wrong.events if event.kind == "job failed"]
    assert failed.source == "run" and failed.number == wrong["run.ErrorID"] != 0 and failed.text and failed.remedy
    quiet = lockstep.Project(small, changes={"go": True})
    quiet.run(1.0)
    assert quiet.events == []


def test_alarms_are_pending_until_they_are_acknowledged(small):
    limited = copy.deepcopy(small)
    axis = limited["technology_objects"]["Axis"]
    axis["config"]["PositionLimits_SW"] = {"Active": True, "MaxPosition": 20.0}
    limited["tags"]["reset"] = {"type": "BOOL"}
    limited["programs"][0]["calls"] += [
        {"fb": "MC_Reset", "name": "reset_axis", "in": {"Axis": "Axis", "Execute": "reset"}},
        {"fb": "MC_Home", "name": "home", "in": {"Axis": "Axis", "Execute": "power.Status", "Mode": 0}},
    ]
    project = lockstep.Project(limited)
    project.run(0.1)
    project["go"] = True
    project.run(9.9)
    (alarm,) = project.alarms
    assert (alarm.kind, alarm.source, alarm.type) == ("alarm", "Axis", "TO_PositioningAxis")
    assert alarm.number == project["Axis.ErrorDetail.Number"] and alarm.text and alarm.reaction
    assert 0 < alarm.time < 10.0
    assert alarm.cause and alarm.remedy and alarm.details == (
        f"{alarm.value_name} {alarm.value:g} mm, {alarm.limit_name} 20 mm; {alarm.address}", f"cause: {alarm.cause}", f"remedy: {alarm.remedy}"
    )  # fmt: skip
    assert alarm.limit == 20.0 and alarm.unit == "mm" and alarm.value == pytest.approx(20.0, abs=1.0)
    assert alarm.tick == round(alarm.time / project.servo_cycle) and alarm.clock is None
    told = str(alarm).splitlines()
    assert told[0] == f"{alarm.time:.6f} s: Axis: alarm {alarm.number}: {alarm.text} ({alarm.reaction})"
    assert [line.strip() for line in told[1:]] == [f"tick {alarm.tick}", *alarm.details]
    assert "alarm 9: text (no reaction)" in str(alarm._replace(number=9, text="text", reaction=""))
    project["go"] = False
    project["reset"] = True
    project.run(0.1)
    acknowledged = project.events[-1]
    assert (acknowledged.cause, acknowledged.value, acknowledged.limit, acknowledged.details) == ("", None, None, ())
    assert project.alarms == []
    assert [event.kind for event in project.events] == ["alarm", "acknowledged"]


def test_events_are_printed_as_the_console_tells_them(small, program, tmp_path):
    limited = copy.deepcopy(small)
    limited["technology_objects"]["Axis"]["config"]["PositionLimits_SW"] = {"Active": True, "MaxPosition": 20.0}
    limited["tags"]["go"]["init"] = True
    limited["programs"][0]["calls"] += [
        {"fb": "MC_Home", "name": "home", "in": {"Axis": "Axis", "Execute": "power.Status", "Mode": 0}},
        {"fb": "MC_MoveVelocity", "name": "wrong", "in": {"Axis": "Axis", "Execute": "run.Busy", "Velocity": "-1.0", "Direction": 7}},
        {"fb": "MC_Reset", "name": "reset", "in": {"Axis": "Axis", "Execute": "Axis.ErrorDetail.Number > 0"}},
    ]
    file = tmp_path / "limited.json"
    file.write_text(json.dumps(limited))
    with lockstep.Project(file, jobs=True) as project:
        project.run(10.0)
        events = [event for event in project.events if event.kind in ("alarm", "acknowledged", "job failed")]
    told = subprocess.run([program, "run", file, "--simulate", "--duration", "10s"], capture_output=True, text=True).stderr
    assert {event.kind for event in events} == {"alarm", "acknowledged", "job failed"}
    for event in events:
        assert f"lockstep: {event}\n" in told


def test_warnings_of_the_file_are_messages(small):
    warned = copy.deepcopy(small)
    warned["modbus"] = {"server": {"listen": "0.0.0.0:1502"}}
    project = lockstep.Project(warned)
    assert project.problems == [p for p in lockstep.check(warned) if p.severity == "warning"] != []
    assert project.messages == [str(problem) for problem in project.problems]


def test_a_closed_project_answers_with_an_error(small):
    project = lockstep.Project(small)
    project.step(100)
    trace = project.trace
    project.close()
    project.close()
    assert project.closed and project.name == "small" and "closed" in repr(project)
    for use in (
        lambda: project.step(),
        lambda: project.run(1.0),
        lambda: project["go"],
        lambda: project.__setitem__("go", True),
        lambda: "go" in project,
        lambda: project.trace,
        lambda: project.events,
        lambda: project.alarms,
        lambda: project.time,
        lambda: project.paths(),
        lambda: project.evaluate("go"),
    ):
        with pytest.raises(lockstep.ClosedError):
            use()
    assert trace.rows == 50


def test_a_context_closes_it_also_after_an_error(small):
    with pytest.raises(ZeroDivisionError):
        with lockstep.Project(small) as project:
            1 / 0
    assert project.closed


def test_another_thread_is_refused_while_it_runs_and_the_gil_is_free(small):
    project = lockstep.Project(small, signals=[])
    begun = threading.Event()
    stop = []

    def run():
        begun.set()
        try:
            for _ in range(1000):
                if stop:
                    return
                project.run(100.0)
        except lockstep.BusyError:
            stop.append("refused")

    thread = threading.Thread(target=run)
    thread.start()
    begun.wait()
    refused = 0
    end = time.monotonic() + 60
    while refused < 10 and time.monotonic() < end:
        for use in (lambda: project["speed"], lambda: project.step(), project.close, lambda: project.trace):
            try:
                use()
            except lockstep.BusyError:  # told only while ticks run: this thread runs beside them
                refused += 1
            except lockstep.ClosedError:
                refused = 10
        if not thread.is_alive():
            break
    stop.append("enough")
    thread.join()
    assert refused >= 10


def test_ctrl_c_ends_a_long_run(small, ctrl_c):
    project = lockstep.Project(small, signals=[])
    pressed = []

    def press():
        pressed.append(time.monotonic())
        signal.pthread_kill(threading.main_thread().ident, signal.SIGINT)

    timer = threading.Timer(0.2, press)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        project.run(1e8)
    assert time.monotonic() - pressed[0] < 5.0  # a twentieth of a second on a machine with nothing else to do
    timer.join()
    at = project.ticks
    assert 0 < at < 1e11
    project.step()
    assert project.ticks == at + 1


def test_projects_are_independent_of_each_other(small):
    projects = [lockstep.Project(small, changes={"go": True, "speed": float(10 + i)}) for i in range(4)]
    threads = [threading.Thread(target=project.run, args=(3.0,)) for project in projects]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [project["Axis.Velocity"] for project in projects] == [10.0, 11.0, 12.0, 13.0]


def test_a_project_tells_why_it_is_not_pickled(small):
    with pytest.raises(TypeError, match="run in progress"):
        pickle.dumps(lockstep.Project(small))


def test_repr_says_what_it_is(small, knife):
    project = lockstep.Project(small)
    project.run(0.25)
    assert repr(project) == "<lockstep.Project 'small', at 0.25 s>"
    assert (project.name, project.description, project.file) == ("small", "An axis, and a tag of each kind.", "")
    assert lockstep.Project(knife).file == str(knife)


def test_misuse_of_the_extension_module_does_not_crash():
    from lockstep import _lockstep

    for wrong in (b"", b"\x00" * 100, b"[" * 1000, b"{}", b"null"):
        with pytest.raises(lockstep.InvalidProject):
            _lockstep.load(wrong, "", "", False, None, False)
    # An object that has never been constructed.
    for kind in (_lockstep.SteppedProject, _lockstep.RealTimeProject, _lockstep.TraceView):
        for make in (kind, lambda: kind.__new__(kind), lambda: object.__new__(kind)):
            with pytest.raises(TypeError):
                make()
    raw = lockstep.Project.__new__(lockstep.Project)
    for use in (lambda: raw["go"], raw.step, raw.close, lambda: repr(raw)):
        with pytest.raises(AttributeError):
            use()


class Calling:
    """A number, of the sequence too, that calls something when it is asked for its value."""

    def __init__(self, call):
        self.call = call

    def number(self):
        self.call()
        return 1

    __index__ = __int__ = __len__ = number

    def __float__(self):
        return float(self.number())

    def __repr__(self):
        return f"the number {self.number()}"


class Elements:
    """A sequence that calls something when it is asked for its length, or for an element."""

    def __init__(self, length, element):
        self.length, self.element = length, element

    def __len__(self):
        self.length()
        return 4

    def __getitem__(self, index):
        self.element()
        return 1.0


def nothing():
    pass


WAYS = {
    "index": ("count", Calling),
    "float": ("speed", Calling),
    "time": ("pause", Calling),
    "element": ("heights", lambda call: [1.0, 2.0, Calling(call), 4.0]),
    "length": ("heights", lambda call: Elements(call, nothing)),
    "item": ("heights", lambda call: Elements(nothing, call)),
}


@pytest.mark.parametrize("way", WAYS)
def test_a_value_that_closes_the_project_is_not_written(small, way):
    path, make = WAYS[way]
    for _ in range(5):
        project = lockstep.Project(small)
        others = []

        def close():
            project.close()
            others.append(lockstep.Project(small))  # which takes the memory that has become free

        with pytest.raises(lockstep.ClosedError):
            project[path] = make(close)
        assert others and all(other["heights"] == [5.0, 7.5, 0.0, 0.0] and other["speed"] == 10.0 for other in others)


@pytest.mark.parametrize("way", WAYS)
def test_a_value_that_steps_the_project_is_written_behind_that(small, way):
    path, make = WAYS[way]
    project = lockstep.Project(small)
    project[path] = make(lambda: project.step(3))
    assert project.ticks >= 3 and project[path] != lockstep.Project(small)[path]


def test_a_text_that_does_not_fit_may_close_the_project_when_it_is_told(small):
    for path in ("kind", "go", "mask"):
        project = lockstep.Project(small)
        with pytest.raises(TypeError, match="the number 1"):
            project[path] = type("Told", (), {"__repr__": lambda self: (project.close(), "the number 1")[1]})()
        assert project.closed


def test_another_thread_that_closes_the_project_while_a_value_is_converted_is_told(small):
    project = lockstep.Project(small)

    def close():
        closing = threading.Thread(target=project.close)
        closing.start()
        closing.join()

    with pytest.raises(lockstep.ClosedError):
        project["count"] = Calling(close)


def test_a_value_is_refused_if_another_thread_runs_the_project_once_it_is_converted(small, ctrl_c):
    project = lockstep.Project(small, signals=[])
    converting = threading.Event()
    told = []

    def until_it_runs():
        converting.set()
        end = time.monotonic() + 60.0
        while time.monotonic() < end:
            try:
                project.ticks
            except lockstep.BusyError:
                return
            time.sleep(0.001)

    def write():
        try:
            project["count"] = Calling(until_it_runs)
        except lockstep.BusyError as error:
            told.append(error)
        signal.pthread_kill(threading.main_thread().ident, signal.SIGINT)

    writing = threading.Thread(target=write)
    writing.start()
    converting.wait()
    with pytest.raises(KeyboardInterrupt):
        project.run(1e8)
    writing.join()
    assert told and project["count"] == 0


@pytest.mark.parametrize("wish", ["heights", "events"])
def test_what_the_collector_of_garbage_calls_may_close_the_project(small, wish):
    for threshold in range(1, 12):
        project = lockstep.Project(small, jobs=True)
        project["go"] = True
        project.run(0.1)
        whole = project[wish] if wish == "heights" else project.events
        ring = type("Ring", (), {"__del__": lambda self, project=project: project.close()})()
        ring.itself = ring
        before = gc.get_threshold()
        del ring
        gc.set_threshold(threshold)
        try:
            assert (project[wish] if wish == "heights" else project.events) == whole
        except lockstep.ClosedError:
            pass
        finally:
            gc.set_threshold(*before)
        project.close()


def test_a_duration_is_a_number(small):
    project = lockstep.Project(small)
    for wrong in ("1", b"1", None, [1.0]):
        with pytest.raises(TypeError):
            project.run(wrong)
    assert project.ticks == 0


def test_a_value_that_holds_itself_or_is_nested_deeply_is_refused(small):
    ring: dict = {}
    ring["again"] = ring
    deep: list = []
    for _ in range(100_000):
        deep = [deep]
    for wrong in (ring, deep):
        for use in (lambda: lockstep.check(small, changes={"/tags/go/init": wrong}), lambda: lockstep.Project({**small, "tags": wrong})):
            with pytest.raises(lockstep.OutOfRange, match="nested too deeply"):
                use()
        with pytest.raises(lockstep.OutOfRange, match="nested too deeply"):
            lockstep.sweep(small, [{"/tags/go/init": wrong}], seconds=1.0)
    deep = 1
    for _ in range(80):
        deep = [deep]
    assert "nested too deeply" in lockstep.check({**small, "tags": deep})[0].text  # with its place


def test_halves_of_surrogate_pairs_are_refused(small):
    half = "speed\ud800"
    project = lockstep.Project(small)
    for use in (lambda: project[half], lambda: project.info(half), lambda: lockstep.Project(small, signals=[half])):
        with pytest.raises(lockstep.PathError, match="half of a surrogate pair"):
            use()
    assert (half in project) is False
    for use in (lambda: project.evaluate(half), lambda: project.run(1.0, until=half)):
        with pytest.raises(lockstep.ExpressionError, match="half of a surrogate pair"):
            use()
    for use in (lambda: lockstep.check({**small, half: 1}), lambda: lockstep.check(small, changes={"/name": half})):
        with pytest.raises(lockstep.OutOfRange, match="half of a surrogate pair"):
            use()


def test_a_file_name_with_nul_is_refused_whole(small, tmp_path):
    name = str(tmp_path / "a.csv\0b.csv")
    (tmp_path / "a.csv").write_text("t,x\n0,1\n")
    with pytest.raises(lockstep.TraceError, match=r"a\.csv\\x00b\.csv"):
        lockstep.read_trace(name)
    for use in (
        lambda: lockstep.check(name),
        lambda: lockstep.RealTime(name),
        lambda: lockstep.RealTime(tmp_path / "a.csv", trace=name),
        lambda: lockstep.sweep(small, [{}], seconds=0.1, results=name),
    ):
        with pytest.raises(lockstep.OutOfRange, match=r"a\.csv\\x00b\.csv"):
            use()
    assert (tmp_path / "a.csv").read_text() == "t,x\n0,1\n"


def test_a_file_may_have_any_name_that_the_system_takes(small, tmp_path):
    name = tmp_path / "caf\udce9.json"
    name.write_text(json.dumps(dict(small, nothing=1)))
    problems = lockstep.check(name)
    assert any("caf\\xe9.json" in problem.file for problem in problems)
    name.write_text(json.dumps(small))
    with lockstep.Project(name) as project:
        assert project.name == "small"
