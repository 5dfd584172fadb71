"""Finds the cam with the least peak acceleration: a lift that goes up, rests and comes down in a turn of its master.

Going up follows one motion law, coming down another. The sooner it is up, the more time there is to come down: somewhere
between, both ends of the scale ask for the same acceleration. Run it as a whole, or cell by cell in an editor that
knows ``# %%``.
"""

# %% The machine: two axes, a cam, and a program that couples them.
import math
from concurrent.futures import ProcessPoolExecutor

import lockstep

STROKE, REST, GOING_UP, DOWN = 80.0, 30.0, 20.0, 340.0  # [mm], then degrees of the master

MACHINE = {
    "lockstep": 1,
    "name": "lift",
    "clock": {"servo_cycle": "1ms"},
    "technology_objects": {
        "Master": {
            "type": "TO_PositioningAxis",
            "config": {
                "VirtualAxis": {"Mode": 1},
                "Modulo": {"Enable": True, "Length": 360.0},
                "DynamicDefaults": {"Velocity": 360.0, "Acceleration": 3600.0, "Deceleration": 3600.0, "Jerk": 0.0},
            },
        },
        "Lift": {
            "type": "TO_SynchronousAxis",
            "config": {"VirtualAxis": {"Mode": 1}},
            "leading_values": [{"to": "Master", "coupling": "setpoint"}],
        },
        "Profile": {
            "type": "TO_Cam",
            "elements": [
                {"type": "line", "start": 0, "end": GOING_UP, "start_value": 0, "slope": 0},
                {"type": "transition", "law": "modified acceleration trapezoid"},
                {"type": "line", "start": 165, "end": 195, "start_value": STROKE, "slope": 0},
                {"type": "transition", "law": "modified sine"},
                {"type": "line", "start": DOWN, "end": 360, "start_value": 0, "slope": 0},
            ],
        },
    },
    "programs": [
        {
            "name": "Main", "ob": "Main", "cycle": "1ms",
            "calls": [
                {"fb": "MC_Power", "name": "master_on", "in": {"Axis": "Master", "Enable": True}},
                {"fb": "MC_Power", "name": "lift_on", "in": {"Axis": "Lift", "Enable": True}},
                {"fb": "MC_Home", "name": "master_home", "in": {"Axis": "Master", "Execute": "master_on.Status", "Mode": 0}},
                {"fb": "MC_Home", "name": "lift_home", "in": {"Axis": "Lift", "Execute": "lift_on.Status", "Mode": 0}},
                {"fb": "MC_CamIn", "name": "follow",
                 "in": {"Master": "Master", "Slave": "Lift", "Cam": "Profile", "Execute": "master_home.Done AND lift_home.Done",
                        "SyncProfileReference": 2, "ApplicationMode": 1}},
                {"fb": "MC_MoveVelocity", "name": "run",
                 "in": {"Axis": "Master", "Execute": "follow.InSync", "Velocity": 360.0}},
            ],
        }
    ],
    "trace": {"signals": ["Master.Position", "Lift.Position", "Lift.Velocity", "Lift.Acceleration"]},
}  # fmt: skip


# %% What is judged: the peak of the acceleration, from the trace of a run.
def judge(project: lockstep.Project) -> dict[str, float]:
    """Called where the variant ran, with the project as it is then."""
    return {"peak": abs(project.trace["Lift.Acceleration"]).max(), "stroke": project.trace["Lift.Position"].max()}


def upper_rest(start: float) -> dict[str, float]:
    """The variant whose lift is up at `start` degrees of the master."""
    element = "/technology_objects/Profile/elements/2"
    return {f"{element}/start": start, f"{element}/end": start + REST}


# %% The search: a row of variants at once, then a narrower one around the best.
def search(pool: ProcessPoolExecutor, low: float = 60.0, high: float = 260.0, resolution: float = 0.05) -> tuple[float, float]:
    """(degrees of the master, peak acceleration [mm/s²]) of the best cam."""
    while True:
        step = (high - low) / 10
        starts = [low + step * i for i in range(11)]
        rows = lockstep.sweep(MACHINE, map(upper_rest, starts), pool, seconds=3.0, function=judge)
        for row in rows:
            assert row.error is None and abs(row.values["stroke"] - STROKE) < 0.01, row
        best = min(rows, key=lambda row: row.values["peak"])
        start = starts[best.index]
        print(f"{low:7.2f}° to {high:6.2f}°: the best is {start:7.3f}° with {best.values['peak']:8.1f} mm/s²")
        if step < resolution:
            return start, best.values["peak"]
        low, high = start - step, start + step


# %% The optimum, beside what the figures of the laws say: Ca = 4.888 and 5.528 (VDI 2143).
if __name__ == "__main__":
    with ProcessPoolExecutor() as workers:
        found, peak = search(workers)
    share = math.sqrt(4.8881) / (math.sqrt(4.8881) + math.sqrt(5.5280))
    expected = GOING_UP + share * (DOWN - GOING_UP - REST)
    print(f"up at {found:.2f}°, peak {peak:.1f} mm/s²; by the figures of the laws up at {expected:.2f}°")
    raise SystemExit(0 if abs(found - expected) < 0.5 else 1)
