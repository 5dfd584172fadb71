#include "scheduler/large_pages.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <memory>

namespace lockstep {
namespace {

constexpr std::uintptr_t kLargePage = std::uintptr_t{1} << 21;
constexpr int kCollapse = 25;  // MADV_COLLAPSE, which older headers do not know

struct Mapping {
  std::uintptr_t begin = 0;
  std::uintptr_t end = 0;
};

/// The mapping of this process that holds an address; an empty one if it cannot be told.
Mapping mapping_of(std::uintptr_t address) noexcept {
  const auto close = [](std::FILE* file) { std::fclose(file); };
  const std::unique_ptr<std::FILE, decltype(close)> maps(std::fopen("/proc/self/maps", "re"), close);
  char line[512];
  while (maps != nullptr && std::fgets(line, sizeof line, maps.get()) != nullptr) {
    Mapping range;
    if (std::sscanf(line, "%" SCNxPTR "-%" SCNxPTR, &range.begin, &range.end) == 2 &&
        range.begin <= address && address < range.end)
      return range;
  }
  return {};
}

}  // namespace

void lay_into_large_pages(const void* lowest, const void* highest) noexcept {
  const auto first = reinterpret_cast<std::uintptr_t>(lowest);
  const auto last = reinterpret_cast<std::uintptr_t>(highest);
  const Mapping mapping = mapping_of(first);
  // Whole large pages that lie within the mapping.
  const std::uintptr_t begin =
      std::max(first / kLargePage, (mapping.begin + kLargePage - 1) / kLargePage) * kLargePage;
  const std::uintptr_t end = std::min(last / kLargePage + 1, mapping.end / kLargePage) * kLargePage;
  if (begin >= end) return;
  char* const address =
      static_cast<char*>(const_cast<void*>(lowest)) + static_cast<std::ptrdiff_t>(begin - first);
  static_cast<void>(madvise(address, end - begin, kCollapse));
}

}  // namespace lockstep
