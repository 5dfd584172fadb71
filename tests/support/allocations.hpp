/// Counts what the program takes from the heap, if it is built with counting_operators.cpp.
#pragma once

#include <cstdint>

namespace lockstep::test {

/// Allocations and releases that this thread has made while a scope of CountAllocations was open in it.
std::uint64_t allocations_counted() noexcept;

/// Counts those of this thread from construction to destruction; other threads may allocate.
class CountAllocations {
 public:
  CountAllocations() noexcept;
  ~CountAllocations();
  CountAllocations(const CountAllocations&) = delete;
  CountAllocations& operator=(const CountAllocations&) = delete;
};

}  // namespace lockstep::test
