/// The example project with an object of every type, and every structure that a project may have.
#pragma once

#include "changed_project.hpp"

namespace lockstep {

inline constexpr char kRestOfProject[] = R"json({
  "technology_objects": {
    "Fan": { "type": "TO_SpeedAxis", "config": {}, "drive": { "model": "simulated" } },
    "Arm": {
      "type": "TO_PositioningAxis",
      "config": { "Sensor[2]": { "Existent": true } },
      "drive": {
        "model": "simulated",
        "zero_marks": { "position": 3.0, "period": 10.0 },
        "limit_switches": { "min": -200.0, "max": 400.0 },
        "digital_inputs": [ { "tag": "switch", "range": [1.0, 2.0] } ],
        "plant": { "inertia": 0.002, "fixed_stop": { "position": 100.0, "stiffness": 200.0 } },
        "faults": { "drive": "fault" },
        "sensors": [ { "sensor": 2 } ]
      }
    },
    "Slide": {
      "type": "TO_PositioningAxis",
      "config": { "Actor": { "MotorType": 1 } },
      "drive": {
        "model": "linear_motor", "force_constant": 40.0, "slider_mass": 0.829, "load_mass": 1.2, "P": 1.0, "D": 4.0,
        "maximal_current": 5.0, "external_force": "seconds",
        "spring": { "position": 0.0, "stiffness": 10.0 },
        "fixed_stops": [ { "position": 35.0, "stiffness": 1000.0, "damping": 10.0 } ]
      }
    },
    "Encoder": {
      "type": "TO_ExternalEncoder",
      "config": {},
      "encoder": { "model": "simulated", "signal": "speed", "zero_marks": { "position": 1.0 } }
    },
    "Line": { "type": "TO_LeadingAxisProxy", "config": {}, "telegrams": { "refused": "refused" } },
    "Provider": {
      "type": "TO_PositioningAxis",
      "config": { "VirtualAxis": { "Mode": 1 },
                  "CrossPlcSynchronousOperation": { "Interface[2]": { "EnableLeadingValueOutput": true },
                                                    "Interface[3]": { "EnableLeadingValueOutput": true } } }
    },
    "Probe": { "type": "TO_MeasuringInput", "config": {}, "assigned_to": "Knife", "marks": { "period": 10.0 } },
    "Glue": {
      "type": "TO_OutputCam", "config": {}, "assigned_to": "Knife", "switching_times": { "on": "seconds" }
    },
    "Track": {
      "type": "TO_CamTrack", "config": {}, "assigned_to": "Knife", "switching_times": { "off": "seconds" }
    },
    "Curve": { "type": "TO_Cam", "config": {}, "points": [ [0.0, 0.0], [1.0, 1.0] ] },
    "Curve10": { "type": "TO_Cam_10k", "config": {}, "points": [ [0.0, 0.0], [1.0, 1.0] ] },
    "Device": {
      "type": "MCO_305", "parameters": { "VELMAX": 3000 }, "drive": { "model": "none" },
      "master": { "follows": "Knife", "counts_per_unit": [1, 1], "markers": { "period": 1000.0 } }, "markers": { "period": 500.0 },
      "faults": { "supply": "fault" },
      "inputs": { "1": "switch" }, "outputs": { "1": "fault" },
      "programs": [ { "number": 0, "lines": [ "DELAY 10" ] } ]
    },
    "Servo": {
      "type": "LinMot_Controller", "control_cycle": "100us",
      "config": { "Drives": { "Drive A": { "Type": "LinMot P0x-37" } } },
      "motors": {
        "A": { "force_constant": 40.0, "slider_mass": 0.829, "spring": { "position": 0.0, "stiffness": 10.0 },
               "thermal": { "nominal_current": 2.0 },
               "fixed_stops": [ { "position": 35.0, "stiffness": 1000.0, "damping": 10.0 } ] }
      },
      "curves": { "1": { "end": 10.0, "time": "200ms" }, "2": { "parts": [ { "end": 10.0, "time": "200ms" } ] } },
      "state_table": { "0": { "A": { "Curve": [1] } } },
      "input_table": { "0001": ["Goto state", 0] },
      "io": { "RUN": "switch" },
      "faults": { "heat_sink_hot": "fault", "A": { "slider_missing": "fault" } },
      "profibus": { "modules": [ "Control/Status", "Max. Speed" ], "preset": { "Max. Speed": 4096 } }
    }
  },
  "ascii": [ { "controllers": { "1": "Servo" } } ],
  "stimuli": [ { "at": "1s", "set": { "switch": true }, "ascii": { "line": 0, "send": "!GS1" } } ],
  "transfer_areas": { "line": { "from": "Provider", "interface": 2, "to": "Line" },
                      "out": { "direction": "send", "from": "Provider", "interface": 3, "channel": "whole.out" } },
  "network": { "lcm": "udpm://239.255.76.67:7667?ttl=0", "clock": "tai", "controller": "Whole" },
  "telegrams": { "failed": "refused" },
  "tags": {
    "switch": { "type": "BOOL" }, "fault": { "type": "BOOL" }, "seconds": { "type": "LREAL" },
    "silent": { "type": "BOOL" }, "heard": { "type": "BOOL" }, "since": { "type": "TIME" },
    "remote": { "type": "INT" }, "refused": { "type": "ULINT" }
  },
  "modbus": {
    "server": [
      { "listen": "127.0.0.1:1502",
        "map": [ { "tag": "switch", "table": "coil", "address": 7 } ],
        "watchdog": { "tag": "switch", "timeout": "1s", "status": "silent" } },
      { "serial": { "device": "/dev/ttyS0" } }
    ],
    "units": [ { "unit": 7, "map": [ { "tag": "fault", "table": "coil", "address": 0 } ],
                 "watchdog": { "tag": "fault", "timeout": "1s", "set": { "synced": false } } } ],
    "clients": [
      { "connect": "127.0.0.1:1600", "devices": [
        { "name": "drive", "cycle": "100ms",
          "read": [ { "tag": "remote", "table": "input_register", "address": 1 } ],
          "write": [ { "tag": "remote", "table": "holding_register", "address": 1 } ] } ] },
      { "serial": { "device": "/dev/ttyS1" }, "devices": [] }
    ]
  },
  "trace": {
    "lcm": { "commands": { "axes": { "Fan": {} } } },
    "channels": [ { "channel": "SLOW", "signals": [ "speed" ], "trigger": { "on": "above", "signal": "speed" } } ]
  },
  "templates": { "station": { "parameters": { "n": { "default": 1 } },
                               "modbus": { "map": [] }, "trace": { "signals": [] } } },
  "instances": [ { "template": "station", "name": "Station" } ],
  "expectations": [ { "at": "1s", "expect": "TRUE" } ],
  "duration": "2s",
  "retain": { "file": "kept", "interval": "1s" },
  "studio": { "listen": "127.0.0.1:8780", "commands": { "axes": { "Fan": {} } } },
  "flight_recorder": { "before": "1s", "file": "flight", "signals": [ "speed" ] }
})json";

inline Json whole_project() {
  Json project = Json::parse(kExampleProject);
  project.merge_patch(Json::parse(kRestOfProject));
  project["programs"][0]["calls"].push_back(
      Json::parse(R"({ "set_start": "Knife.Modulo.Length", "to": 180.0 })"));
  return project;
}

}  // namespace lockstep
