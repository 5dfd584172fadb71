/// A project with everything in it that a project may have, for the tests of the loader.
#pragma once

namespace lockstep {

inline constexpr char kExampleProject[] = R"json({
  "lockstep": 1,
  "name": "rotary_knife",
  "description": "A knife drum geared to a conveyor.",
  "clock": { "servo_cycle": "1ms", "interpolator_ratio": 2 },
  "technology_objects": {
    "Conveyor": {
      "type": "TO_PositioningAxis",
      "config": {
        "VirtualAxis": { "Mode": 1 },
        "DynamicDefaults": { "Velocity": 100.0, "Acceleration": 1000.0, "Deceleration": 1000.0, "Jerk": 10000.0 }
      }
    },
    "Knife": {
      "type": "TO_SynchronousAxis",
      "config": {
        "Properties": { "MotionType": 1 },
        "Modulo": { "Enable": true, "Length": 360.0, "StartValue": 0.0 }
      },
      "drive": { "model": "simulated", "time_constant": "2ms", "dead_time": "1ms" },
      "leading_values": [ { "to": "Conveyor", "coupling": "setpoint" } ]
    }
  },
  "tags": {
    "start":  { "type": "BOOL",  "init": false, "comment": "from the HMI" },
    "speed":  { "type": "LREAL", "init": 200.0, "retain": true },
    "synced": { "type": "BOOL" }
  },
  "programs": [
    {
      "name": "Main", "ob": "Main", "cycle": "10ms",
      "calls": [
        { "fb": "MC_Power", "name": "power_c", "in": { "Axis": "Conveyor", "Enable": true } },
        { "fb": "MC_Power", "name": "power_k", "in": { "Axis": "Knife", "Enable": true } },
        { "fb": "MC_Home", "name": "home_k", "in": { "Axis": "Knife", "Execute": "power_k.Status", "Mode": 0, "Position": 0.0 } },
        { "fb": "MC_MoveVelocity", "name": "run", "in": { "Axis": "Conveyor", "Execute": "power_c.Status AND start", "Velocity": "speed" } },
        { "fb": "MC_GearInPos", "name": "gear",
          "in": { "Master": "Conveyor", "Slave": "Knife", "Execute": "home_k.Done AND start", "RatioNumerator": 3, "RatioDenominator": 2,
                  "MasterSyncPosition": 300.0, "SlaveSyncPosition": 90.0, "SyncProfileReference": 1, "MasterStartDistance": 100.0 } },
        { "set": "synced", "to": "gear.InSync" },
        { "if": "gear.Error", "then": [ { "set": "start", "to": "FALSE" } ], "else": [] }
      ]
    }
  ],
  "stimuli": [ { "at": "0.5s", "set": { "start": true } } ],
  "modbus": {
    "server": { "listen": "127.0.0.1:1502" },
    "map": [
      { "tag": "start",                "table": "coil",             "address": 0 },
      { "tag": "speed",                "table": "holding_register", "address": 10, "type": "REAL" },
      { "tag": "synced",               "table": "discrete_input",   "address": 0 },
      { "tag": "Knife.ActualPosition", "table": "input_register",   "address": 0,  "type": "REAL" }
    ],
    "watchdog": { "tag": "start", "timeout": "1h", "set": { "speed": 0.0 } }
  },
  "audit": { "file": "audit.jsonl", "size": 16777216, "files": 10 },
  "trace": {
    "lcm": { "url": "udpm://239.255.76.67:7667?ttl=0", "channel": "ROTARY_KNIFE" },
    "signals": [ "Conveyor.Position", "Knife.Position", "gear.InSync", "Knife.StatusWord.X22" ]
  }
}
)json";

}  // namespace lockstep
