/// Counts what the program takes from the heap; the operators themselves stand in allocation_test.cpp.
#pragma once

#include <cstdint>

namespace lockstep::test {

/// Allocations and releases seen while a scope of CountAllocations was open.
std::uint64_t allocations_counted() noexcept;

/// Counts allocations from construction to destruction. One thread only, as the cycle is.
class CountAllocations {
 public:
  CountAllocations() noexcept;
  ~CountAllocations();
  CountAllocations(const CountAllocations&) = delete;
  CountAllocations& operator=(const CountAllocations&) = delete;
};

}  // namespace lockstep::test
