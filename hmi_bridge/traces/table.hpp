/// A whole trace in memory, as the readers give it to plots and tests.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "hmi_bridge/traces/sink.hpp"

namespace lockstep {

/// A trace by columns. All columns are as long as `t`.
struct TraceTable {
  std::vector<TraceSignal> signals;
  std::vector<double> t;                     ///< [s]
  std::vector<std::vector<double>> columns;  ///< one for each signal; BOOL as 0 or 1, TIME in seconds
  /// Of a CSV file: columns of which a value was written as a real number, with a point or an exponent.
  std::vector<bool> reals;
  /// What is missing, such as a last row that was cut short when a run was killed; empty if nothing is.
  std::string remark;
};

/// A trace file that cannot be opened or is damaged. The text begins with the file's name and tells the
/// place: "FILE:line:column: …" in a CSV file, "FILE: event n: …" in an LCM log.
struct TraceFormatError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace lockstep
