/// What a fuzz target gives, whoever drives it: libFuzzer (./dev fuzz) or the driver of the tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

namespace lockstep::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// Inputs to begin with, each of which the target takes as good.
std::vector<std::string> seeds();

/// Ends the program where something does not hold that has to hold for every input.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

}  // namespace lockstep::fuzz

/// Takes one input; whatever it is, it returns 0.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
