/// What a fuzz target gives, whoever drives it: libFuzzer (./dev fuzz), of which each is a program, or the
/// driver of the tests, which has them all. Its source, NAME_target.cpp, defines seeds() and take() in
/// lockstep::fuzz::NAME_target.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep::fuzz {

using Bytes = std::span<const std::uint8_t>;

struct Target {
  std::string_view name;
  /// Inputs to begin with, each of which the target takes as good.
  std::vector<std::string> (*seeds)();
  /// Takes one input; whatever it is, it returns 0.
  int (*take)(const std::uint8_t* data, std::size_t size);
};

/// Those of the program, of which CMake writes the list.
std::span<const Target> targets();

/// Ends the program where something does not hold that has to hold for every input.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

}  // namespace lockstep::fuzz
