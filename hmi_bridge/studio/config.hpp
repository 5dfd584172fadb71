/// What a project says of its studio.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hmi_bridge/network/network.hpp"

namespace lockstep {

/// Where a run can be looked into by a browser, and who may do what there.
struct StudioConfig {
  std::string listen{};                   ///< HOST:PORT; empty: nowhere unless the command line says so
  bool write = false;                     ///< it may write, and command the axes that take commands
  std::vector<IpNetwork> allow{};         ///< from which clients may come; none: from everywhere
  std::int64_t history = 60'000'000'000;  ///< of the run that is kept for it [ns]
};

}  // namespace lockstep
