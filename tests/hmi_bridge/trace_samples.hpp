/// Signals, rows and places for the tests of traces.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "hmi_bridge/traces/sink.hpp"
#include "tests/support/directory.hpp"
#include "tests/support/values.hpp"

namespace lockstep {

using test::content;
using test::Directory;
using test::integer;
using test::real;

/// One signal of each kind.
inline std::vector<TraceSignal> sample_signals() {
  return {{"Knife.Position", Type::LREAL, "u"},
          {"gear.InSync", Type::BOOL, ""},
          {"count", Type::DINT, ""},
          {"total", Type::LINT, ""},
          {"mask", Type::LWORD, ""},
          {"after", Type::TIME, "s"},
          {"share", Type::REAL, "%"}};
}

/// Seeded rows of `sample_signals`, whose 64-bit values do not fit a double.
inline std::vector<std::vector<Value>> sample_rows(std::size_t rows, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> position(-1e3, 1e3);
  std::vector<std::vector<Value>> values;
  for (std::size_t i = 0; i < rows; ++i)
    values.push_back({real(position(random)), integer(static_cast<std::int64_t>(random() & 1)),
                      integer(static_cast<std::int32_t>(random())),
                      integer(static_cast<std::int64_t>(random() | 1)),
                      integer(static_cast<std::int64_t>(random() | 1)),
                      integer(static_cast<std::int64_t>(random() >> 8 | 1)),
                      real(static_cast<double>(static_cast<float>(position(random))))});
  return values;
}

}  // namespace lockstep
