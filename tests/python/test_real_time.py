"""Projects in real time. Nothing here depends on how fast the machine is: what is waited for has a generous limit."""

import os
import signal
import socket
import subprocess
import sys
import threading
import time

import pytest
from conftest import SMALL

import lockstep

LIMIT = 60.0
QUIET = dict(modbus=False, lcm=False, retain=False)


@pytest.fixture
def file(tmp_path):
    import json

    path = tmp_path / "small.json"
    path.write_text(json.dumps(SMALL))
    return path


def comes_true(condition) -> bool:
    end = time.monotonic() + LIMIT
    while not condition():
        if time.monotonic() > end:
            return False
        time.sleep(0.001)
    return True


def test_values_cross_while_it_runs(file):
    with lockstep.RealTime(file, signals=["go", "speed", "Axis.Velocity", "total"], **QUIET) as machine:
        assert machine.state == "running" and machine.name == "small"
        machine["speed"] = 25.0
        machine["go"] = True
        assert machine["speed"] == 25.0  # one's own writes are seen at once
        assert comes_true(lambda: machine["Axis.Velocity"] == 25.0)
        assert machine["total"] > 0 and machine.status["ticks"] > 0 and machine.status["time"] > 0.0
        assert machine.alarms == [] and any("kernel" in text or "processor" in text for text in machine.messages)
        assert list(machine) == machine.paths() == ["go", "speed", "Axis.Velocity", "total"] and "go" in machine
    assert machine.closed and machine.state == "closed" and "closed" in repr(machine)
    for use in (machine.stop, lambda: machine["go"], lambda: machine.status, lambda: machine.wait(0.0)):
        with pytest.raises(lockstep.ClosedError):
            use()
    machine.close()


def test_what_does_not_fit_is_told(file):
    with lockstep.RealTime(file, **QUIET) as machine:
        assert {"go", "count", "Axis.Position"} <= set(machine.paths())
        for path, value, error in [
            ("go", 1, TypeError),
            ("count", 40000, lockstep.OutOfRange),
            ("Axis.Position", 1.0, lockstep.ReadOnly),
            ("Axis.Velocity", 1.0, lockstep.PathError),
            ("nothing", 1.0, lockstep.PathError),
        ]:
            with pytest.raises(error):
                machine[path] = value
        with pytest.raises(lockstep.PathError, match="signals="):
            machine["Axis.Velocity"]


def test_it_ends_by_its_duration_and_leaves_a_trace(file, tmp_path):
    with lockstep.RealTime(file, duration=0.2, trace=tmp_path / "run.csv", **QUIET) as machine:
        assert machine.wait(LIMIT) and machine.state == "ended"
        assert machine.status["time"] >= 0.2 and machine["total"] > 0
    assert lockstep.read_trace(tmp_path / "run.csv").rows > 0


def test_it_is_stopped_from_another_thread(file):
    with lockstep.RealTime(file, **QUIET) as machine:
        assert not machine.wait(0.0)
        ended = []
        waiting = threading.Thread(target=lambda: ended.append(machine.wait(LIMIT)))
        waiting.start()
        machine.stop()
        waiting.join()
        assert ended == [True]


def test_ctrl_c_ends_a_wait_and_not_the_run(file, ctrl_c):
    with lockstep.RealTime(file, **QUIET) as machine:
        timer = threading.Timer(0.1, lambda: signal.pthread_kill(threading.main_thread().ident, signal.SIGINT))
        timer.start()
        with pytest.raises(KeyboardInterrupt):
            machine.wait(LIMIT)
        timer.join()
        assert machine.state == "running"


def test_its_modbus_server_listens_where_it_is_told(file):
    with lockstep.RealTime(file, modbus="127.0.0.1:0", lcm=False, retain=False) as machine:
        (endpoint,) = machine.modbus_endpoints
        host, port = endpoint.rsplit(":", 1)
        with socket.create_connection((host, int(port)), timeout=LIMIT):
            pass


def test_what_cannot_be_started_is_told(file, tmp_path):
    broken = tmp_path / "broken.json"
    broken.write_text("{}")
    with pytest.raises(lockstep.InvalidProject) as error:
        lockstep.RealTime(broken)
    assert error.value.problems == lockstep.check(broken)
    with pytest.raises(FileNotFoundError):
        lockstep.RealTime(tmp_path / "none.json")
    for wrong in (dict(modbus="nowhere"), dict(trace=tmp_path / "run.txt"), dict(trace="/nowhere/at/all/run.csv")):
        with pytest.raises(lockstep.RunError):
            lockstep.RealTime(file, **{**QUIET, **wrong})
    for wrong in (dict(duration=0.0), dict(duration=float("nan")), dict(cpu=-1)):
        with pytest.raises(lockstep.OutOfRange):
            lockstep.RealTime(file, **wrong)
    with pytest.raises(lockstep.PathError):
        lockstep.RealTime(file, signals=["nothing"], **QUIET)
    for wrong in (dict(modbus=True), dict(lcm=3), dict(cpu=1.5), dict(cpu="0"), dict(signals="go"), dict(signals=[3])):
        with pytest.raises(TypeError):
            lockstep.RealTime(file, **wrong)


def test_it_is_brought_to_rest_when_nobody_has_it_any_more(file):
    machine = lockstep.RealTime(file, **QUIET)
    machine["go"] = True
    del machine  # nothing crashes, nothing runs on
    assert threading.active_count() == 1


@pytest.mark.parametrize("path", ["count", "speed"])
def test_a_value_that_closes_the_run_is_not_written(file, path):
    machine = lockstep.RealTime(file, signals=["count", "speed"], **QUIET)

    class Closing:
        def __index__(self):
            machine.close()
            return 1

        def __float__(self):
            return float(self.__index__())

    with pytest.raises(lockstep.ClosedError):
        machine[path] = Closing()


def ended_in_child(child) -> bool:
    """Whether a forked process that calls this comes to its end, and by itself."""
    pid = os.fork()
    if pid == 0:
        status = 1
        try:
            child()
            status = 0
        finally:
            os._exit(status)
    end = time.monotonic() + LIMIT
    while time.monotonic() < end:
        ended, status = os.waitpid(pid, os.WNOHANG)
        if ended:
            return status == 0
        time.sleep(0.001)
    os.kill(pid, signal.SIGKILL)
    os.waitpid(pid, 0)
    return False


def test_a_child_of_a_fork_has_no_run(file):
    machines = [lockstep.RealTime(file, **QUIET)]

    def is_refused():
        (machine,) = machines
        assert machine.closed and machine.state == "closed" and "closed" in repr(machine)
        uses = [machine.stop, lambda: machine["go"], lambda: machine.status, lambda: machine.wait(1.0)]
        for use in [*uses, lambda: machine.events, lambda: machine.messages, lambda: machine.modbus_endpoints]:
            with pytest.raises(lockstep.ClosedError, match="forked"):
                use()
        with pytest.raises(lockstep.ClosedError, match=str(os.getppid())):
            machine["go"] = True

    assert ended_in_child(is_refused)
    assert ended_in_child(machines[0].close)
    assert ended_in_child(machines.clear)
    assert machines[0].state == "running"
    machines[0].close()


def test_a_child_of_a_fork_ends_as_if_there_were_no_run(file):
    script = (
        "import lockstep, os, sys\n"
        f"machine = lockstep.RealTime({str(file)!r}, modbus=False, lcm=False, retain=False)\n"
        "pid = os.fork()\n"
        "if pid == 0: sys.exit(0)\n"
        "print(os.waitpid(pid, 0)[1], machine.state)\n"
        "machine.close()\n"
    )
    ended = subprocess.run([sys.executable, "-c", script], timeout=LIMIT, capture_output=True, text=True)
    assert (ended.returncode, ended.stdout) == (0, "0 running\n"), ended.stderr
