/// Seeds and numbers of random cases, with GoogleTest (property.hpp) and without it. By the environment:
///   LOCKSTEP_SOAK          the numbers of `./dev soak`
///   LOCKSTEP_FIRST_SEED=N  begin with another seed
///   LOCKSTEP_SEED=N        this seed alone, told as it runs where a test can do that
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <random>

namespace lockstep::test {

/// Whether random tests are to run for long.
inline bool soak() {
  return std::getenv("LOCKSTEP_SOAK") != nullptr;
}

/// A number of cases: that of CI, or in a soak the other.
inline int cases(int usual, int in_a_soak) {
  return soak() ? in_a_soak : usual;
}

/// A seed of the environment, if there is one.
inline std::optional<std::uint64_t> seed_of(const char* variable) {
  const char* const text = std::getenv(variable);
  if (text == nullptr) return std::nullopt;
  return std::strtoull(text, nullptr, 10);
}

/// The seed of one generator for many cases, printed at once, so that it is known when the program crashes:
/// that of the environment; else in a soak a new one, `usual` otherwise.
inline std::uint64_t seed_of_run(std::uint64_t usual) {
  auto seed = seed_of("LOCKSTEP_SEED");
  if (!seed) seed = seed_of("LOCKSTEP_FIRST_SEED");
  if (!seed) seed = soak() ? std::random_device{}() : usual;
  std::printf("seed %llu; follow it with LOCKSTEP_SEED\n", static_cast<unsigned long long>(*seed));
  std::fflush(stdout);
  return *seed;
}

}  // namespace lockstep::test
