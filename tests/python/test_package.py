"""The package as a Python developer looks at it: help, completion, stubs, the example."""

import ast
import inspect
import os
import pydoc
import re
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import ROOT

import lockstep
from lockstep import _lockstep

PACKAGE = Path(lockstep.__file__).parent


def test_all_that_is_public_has_a_docstring():
    for name in lockstep.__all__:
        thing = getattr(lockstep, name)
        assert inspect.getdoc(thing), name
        if not inspect.isclass(thing):
            continue
        for member, what in vars(thing).items():
            if not member.startswith("_") and (callable(what) or isinstance(what, (property, classmethod))):
                assert inspect.getdoc(what), f"{name}.{member}"


def test_help_and_completion_show_what_there_is():
    text = pydoc.render_doc(lockstep, renderer=pydoc.plaintext)
    for name in ("check", "Project", "sweep", "RealTime", "read_trace"):
        assert name in text
    assert set(dir(lockstep)) == {*lockstep.__all__, "__version__"}
    version = re.search(r"project\(lockstep VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())
    assert lockstep.__version__ == version.group(1)


def declared(node: ast.AST) -> dict[str, set[str]]:
    """Names on the floor of a stub, each with its members."""
    names = {}
    for item in node.body:
        if isinstance(item, ast.ClassDef):
            names[item.name] = set(declared(item))
        elif isinstance(item, ast.FunctionDef):
            names[item.name] = set()
        elif isinstance(item, ast.AnnAssign):
            names[item.target.id] = set()
    return names


def test_the_stub_declares_what_the_extension_module_has():
    stub = declared(ast.parse((PACKAGE / "_lockstep.pyi").read_text()))
    there = {name: thing for name, thing in vars(_lockstep).items() if not name.startswith("_") or name == "__version__"}
    assert set(stub) == set(there)
    for name, thing in there.items():
        if inspect.isclass(thing):
            assert stub[name] - {"__init__"} == {member for member in vars(thing) if not member.startswith("_")}
    assert (PACKAGE / "py.typed").exists()


def test_all_that_python_defines_is_annotated():
    """So that an editor and a checker of types know it: `py.typed` says that they may ask."""
    functions = 0
    for file in PACKAGE.glob("*.py"):
        for node in ast.walk(ast.parse(file.read_text())):
            if not isinstance(node, ast.FunctionDef):
                continue
            arguments = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs, node.args.vararg, node.args.kwarg]
            bare = [one.arg for one in arguments if one and one.annotation is None and one.arg not in ("self", "cls", "_")]
            assert not bare and node.returns is not None, f"{file.name}:{node.lineno}: {node.name} {bare}"
            functions += 1
    assert functions > 60


def test_errors_have_one_base_and_the_kin_that_python_gives_them():
    kin = {
        lockstep.InvalidProject: ValueError,
        lockstep.PathError: KeyError,
        lockstep.ReadOnly: TypeError,
        lockstep.OutOfRange: ValueError,
        lockstep.ExpressionError: ValueError,
        lockstep.BusyError: RuntimeError,
        lockstep.ClosedError: ValueError,
        lockstep.TraceError: ValueError,
        lockstep.RunError: RuntimeError,
        lockstep.SweepError: RuntimeError,
    }
    for error, base in kin.items():
        assert issubclass(error, lockstep.LockstepError) and issubclass(error, base)


def test_the_example_finds_the_cam_that_the_figures_of_the_laws_promise():
    environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}
    ran = subprocess.run(
        [sys.executable, ROOT / "projects" / "python" / "optimize_cam.py"], capture_output=True, text=True, env=environment
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    found, expected = map(float, re.search(r"up at ([0-9.]+)°.* up at ([0-9.]+)°", ran.stdout).groups())
    assert found == pytest.approx(expected, abs=0.5)


FORGOTTEN = {
    "a run in a daemon thread": """
project = lockstep.Project(knife, signals=[])
threading.Thread(target=lambda: project.run(1e7), daemon=True).start()
while True:
    try:
        project.time
    except lockstep.BusyError:
        break
""",
    "a wait in a daemon thread": """
machine = lockstep.RealTime(knife, modbus=False, lcm=False, retain=False)
threading.Thread(target=lambda: machine.wait(1e7), daemon=True).start()
""",
    "a run in real time": """
machine = lockstep.RealTime(knife, modbus=False, lcm=False, retain=False)
machine["start"] = True
""",
    "a run in real time that nobody collects": """
import builtins
builtins.kept = [lockstep.RealTime(knife, modbus=False, lcm=False, retain=False)]
builtins.kept.append(builtins.kept)
""",
}


@pytest.mark.parametrize("what", FORGOTTEN)
def test_an_interpreter_that_ends_meanwhile_ends_well(what, knife):
    script = f"import lockstep, threading\nknife = {str(knife)!r}\n" + FORGOTTEN[what]
    for _ in range(3):
        ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
        assert (ended.returncode, ended.stderr) == (0, "")


def test_a_trace_without_room_is_told_and_the_project_goes_on():
    script = """
import resource, lockstep
from conftest import SMALL
project = lockstep.Project(SMALL)
project.step()
with open("/proc/self/statm") as file:
    pages = int(file.read().split()[0])
limit = pages * resource.getpagesize() + (64 << 20)
resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
try:
    project.run(1e6)
except MemoryError:
    before = project.trace
    assert before.rows > 100_000 and before["total"][-1] == 2 * before.rows - 1
    project["go"] = True
    print("told", project.time > 0)
"""
    ended = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, timeout=300, cwd=Path(__file__).parent
    )
    assert ended.stdout == "told True\n", ended.stderr


def test_the_first_steps_of_the_readme_run(tmp_path, monkeypatch):
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "projects" / "python" / "README.md").read_text(), re.DOTALL)
    assert len(blocks) >= 3
    monkeypatch.chdir(ROOT)
    script = tmp_path / "steps.py"
    script.write_text("\n".join(blocks).replace('"sweep.jsonl"', repr(str(tmp_path / "sweep.jsonl"))))
    subprocess.run([sys.executable, script], check=True, cwd=ROOT)


def test_what_the_readme_of_all_shows_runs_and_steps_the_shear(tmp_path):
    readme = (ROOT / "README.md").read_text()
    project = re.search(r"<!-- tested: file shear.json -->\n```json\n(.*?)```", readme, re.DOTALL).group(1)
    shown = re.search(r"## From Python\n.*?```python\n(.*?)```", readme, re.DOTALL).group(1)
    (tmp_path / "shear.json").write_text(project)
    (tmp_path / "shear.py").write_text(shown)
    ended = subprocess.run([sys.executable, "shear.py"], check=True, cwd=tmp_path, capture_output=True, text=True)
    first, *alarms, last = ended.stdout.splitlines()
    cuts, position, unit = re.fullmatch(r"(\d+) cuts, the shear at (\S+) (\S+)", first).groups()
    assert int(cuts) >= 3 and 0.0 < float(position) < 350.0 and unit == "mm"
    assert any("Shear: alarm 521: Following error too large" in line for line in alarms)
    assert any(line.startswith("  remedy: check mechanics, brake and drive") for line in alarms)
    more, lowest, highest, unit = re.fullmatch(r"(\d+) cuts, between (\S+) and (\S+) (\S+)", last).groups()
    assert int(more) > int(cuts), "it cuts again once it has been acknowledged"
    assert -5.0 < float(lowest) < 0.5 and 200.0 < float(highest) < 300.0 and unit == "mm"
