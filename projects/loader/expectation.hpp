/// What a project is to have come to in a simulated run.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scheduler/expression.hpp"

namespace lockstep {

/// A value that an expectation names, which tells why it is what it is.
struct SeenValue {
  std::string name;
  std::optional<Signal> signal;  ///< none: a text
  Text text{};
};

/// A BOOL that is to be TRUE, or a number that is to have a value.
struct Expectation {
  std::optional<std::int64_t> at;  ///< [ns] behind the first tick from then on; none: behind the last tick
  Expression expression;           ///< a BOOL; with `value` an LREAL, LINT or ULINT
  std::optional<double> value;
  double tolerance = 0.0;       ///< by which the number may differ
  std::string text;             ///< what it means; empty: the expression says it
  std::string written;          ///< the expression in the project
  std::string file;             ///< in which it stands; empty: the project file
  std::size_t line = 0;         ///< there
  std::vector<SeenValue> seen;  ///< in its expression
};

struct Expectations {
  std::vector<Expectation> list;  ///< in the order of the file
  std::int64_t duration = 0;      ///< to simulate [ns]
};

}  // namespace lockstep
