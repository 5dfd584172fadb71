/// A project whose leading values go over transfer areas: within it, to another controller and from one.
#pragma once

#include <string>

namespace lockstep::test {

inline std::string crossing_project() {
  return R"({ "lockstep": 1, "name": "crossing", "clock": { "servo_cycle": "1ms" },
    "technology_objects": {
      "Main": { "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 },
        "CrossPlcSynchronousOperation": { "Interface[1]": { "EnableLeadingValueOutput": true },
          "Interface[2]": { "EnableLeadingValueOutput": true }, "LocalLeadingValueDelayTime": 0.004 } } },
      "Line": { "type": "TO_LeadingAxisProxy", "config": { "Parameter": { "LocalLeadingValueDelayTime": 0.002 } } },
      "Beyond": { "type": "TO_LeadingAxisProxy" },
      "Near": { "type": "TO_SynchronousAxis", "config": { "VirtualAxis": { "Mode": 1 } },
        "leading_values": [ { "to": "Main", "coupling": "delayed" } ] },
      "Far": { "type": "TO_SynchronousAxis", "config": { "VirtualAxis": { "Mode": 1 } },
        "leading_values": [ { "to": "Line" }, { "to": "Beyond" }, { "to": "Main" } ] }
    },
    "transfer_areas": {
      "line": { "from": "Main", "to": "Line" },
      "out": { "direction": "send", "from": "Main", "interface": 2 },
      "belt": { "direction": "receive", "to": "Beyond", "controller": "Infeed", "source": "Conveyor" }
    },
    "programs": [ { "name": "all", "ob": "Main", "cycle": "1ms", "calls": [
      { "fb": "MC_GearIn", "name": "gear", "in": { "Master": "Main", "Slave": "Near" } } ] } ] })";
}

}  // namespace lockstep::test
