"""What the tests of the Python package share."""

import os
import signal
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]

SMALL: dict[str, Any] = {
    "lockstep": 1,
    "name": "small",
    "description": "An axis, and a tag of each kind.",
    "clock": {"servo_cycle": "1ms", "interpolator_ratio": 2},
    "technology_objects": {"Axis": {"type": "TO_PositioningAxis", "config": {"VirtualAxis": {"Mode": 1}}}},
    "tags": {
        "go": {"type": "BOOL"},
        "speed": {"type": "LREAL", "init": 10.0},
        "share": {"type": "REAL"},
        "count": {"type": "INT"},
        "long": {"type": "LINT"},
        "total": {"type": "ULINT"},
        "mask": {"type": "WORD"},
        "pause": {"type": "TIME", "init": "1.5s"},
        "kind": {"type": "STRING[8]", "init": "ale"},
        "heights": {"type": "ARRAY[0..3] OF LREAL", "init": [5.0, 7.5]},
        "points": {"type": "ARRAY[1..2] OF TO_Cam_Struct_PointData"},
    },
    "programs": [
        {
            "name": "Main",
            "ob": "Main",
            "cycle": "1ms",
            "calls": [
                {"set": "total", "to": "total + 1"},
                {"fb": "MC_Power", "name": "power", "in": {"Axis": "Axis", "Enable": True}},
                {
                    "fb": "MC_MoveVelocity",
                    "name": "run",
                    "in": {"Axis": "Axis", "Execute": "power.Status AND go", "Velocity": "speed"},
                },
            ],
        }
    ],
    "trace": {"signals": ["Axis.Position", "run.InVelocity", "count", "total", "pause"]},
}


@pytest.fixture
def small() -> dict[str, Any]:
    """The content of a small project."""
    return SMALL


@pytest.fixture
def knife() -> Path:
    """The project file of the rotary knife."""
    return ROOT / "projects" / "02_rotary_knife" / "project.json"


@pytest.fixture
def program() -> str:
    """The lockstep command of the same build."""
    return os.environ["LOCKSTEP_PROGRAM"]


@pytest.fixture
def ctrl_c():
    """As in a terminal: what a shell has put into the background ignores it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)
