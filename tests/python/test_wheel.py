"""The wheel that ./dev python builds: it is whole, and what is installed from it runs a project."""

import os
import re
import subprocess
import sys
import zipfile

import pytest
from conftest import ROOT

import lockstep
from lockstep import _lockstep

OF_EVERY_SYSTEM = {"libc", "libm", "libstdc", "libgcc_s"}


@pytest.fixture(scope="module")
def environment(tmp_path_factory):
    """The interpreter of an environment with pip, into which the wheel is installed, and the wheel."""
    work = tmp_path_factory.mktemp("wheel")
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", work / "venv"], check=True)
    python = work / "venv" / "bin" / "python"
    # The module of this build: building another one is what ./dev python does.
    building = {**os.environ, "LOCKSTEP_MODULE": _lockstep.__file__, "LOCKSTEP_BUILD": str(work / "build")}
    pip = [python, "-m", "pip", "-q", "--disable-pip-version-check"]
    offline = ["--no-deps", "--no-index"]
    subprocess.run(
        [*pip, "wheel", *offline, "--no-build-isolation", "-w", work, ROOT / "projects" / "python"],
        check=True, env=building,
    )
    (wheel,) = work.glob("lockstep-*.whl")
    subprocess.run([*pip, "install", *offline, "--force-reinstall", wheel], check=True)
    return python, wheel


def test_it_has_every_file_of_the_package_and_its_version(environment):
    _, wheel = environment
    names = set(zipfile.ZipFile(wheel).namelist())
    package = ROOT / "projects" / "python" / "src" / "lockstep"
    files = {f"lockstep/{path.name}" for path in package.iterdir() if path.suffix in {".py", ".pyi", ".typed"}}
    assert len(files) > 8 and files <= names
    assert [name for name in names if name.startswith("lockstep/_lockstep.") and name.endswith(".so")]
    assert wheel.name.startswith(f"lockstep-{lockstep.__version__}-cp3")
    information = zipfile.ZipFile(wheel).read(f"lockstep-{lockstep.__version__}.dist-info/METADATA").decode()
    assert "Requires-Dist: numpy" in information
    # Whoever has the wheel alone is told which packages of Debian it needs.
    needed = subprocess.run(["readelf", "-d", _lockstep.__file__], check=True, capture_output=True, text=True).stdout
    libraries = set(re.findall(r"NEEDED.*\[(lib\w+)\.so\.(\d+)\]", needed))
    others = {name + ("-" if name[-1].isdigit() else "") + major for name, major in libraries if name not in OF_EVERY_SYSTEM}
    assert {"libfmt9", "libsqlite3-0"} <= others
    assert [package for package in sorted(others) if package not in information] == []


def test_what_is_installed_from_it_runs_a_project(environment, tmp_path):
    python, _ = environment
    script = (
        "import lockstep, sys\n"
        f"with lockstep.Project({str(ROOT / 'projects/02_rotary_knife/project.json')!r}) as knife:\n"
        "    knife.run(5.0)\n"
        "    print(lockstep.__file__, knife.trace['Knife.Velocity'].max())\n"
    )
    outside = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    ended = subprocess.run([python, "-c", script], check=True, cwd=tmp_path, env=outside, capture_output=True, text=True)
    file, velocity = ended.stdout.split()
    assert file.startswith(str(python.parent.parent)) and float(velocity) > 100.0
