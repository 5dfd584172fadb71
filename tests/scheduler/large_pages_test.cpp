#include "scheduler/large_pages.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>

namespace lockstep::large_pages_test {
namespace {

constexpr std::size_t kLarge = std::size_t{1} << 21;

/// Memory of its own mapping, that only small pages hold as long as nobody asks for others.
class Memory {
 public:
  explicit Memory(std::size_t size)
      : size_(size),
        begin_(static_cast<std::uint8_t*>(
            mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0))) {
    for (std::size_t i = 0; i < size_; i += 64) begin_[i] = value(i);
  }
  ~Memory() { munmap(begin_, size_); }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  std::uint8_t* at(std::size_t place) const { return begin_ + place; }
  bool unchanged() const {
    for (std::size_t i = 0; i < size_; i += 64)
      if (begin_[i] != value(i)) return false;
    return true;
  }

 private:
  static std::uint8_t value(std::size_t place) { return static_cast<std::uint8_t>(1 + place / 64 % 251); }

  std::size_t size_;
  std::uint8_t* begin_;
};

/// Memory of this process in large pages [KiB].
long in_large_pages() {
  std::ifstream smaps("/proc/self/smaps_rollup");
  for (std::string line; std::getline(smaps, line);)
    if (long size = 0; std::sscanf(line.c_str(), "AnonHugePages: %ld", &size) == 1) return size;
  return -1;
}

TEST(LargePages, HoldWhatLiesBetweenTwoPlacesAndChangeNothing) {
  const Memory probe(4 * kLarge);
  constexpr int kCollapse = 25;
  std::uint8_t* const second = probe.at(kLarge);
  const bool possible =
      madvise(second - reinterpret_cast<std::uintptr_t>(second) % kLarge, kLarge, kCollapse) == 0;

  const Memory memory(8 * kLarge);
  const long before = in_large_pages();
  lay_into_large_pages(memory.at(100), memory.at(8 * kLarge - 100));
  EXPECT_TRUE(memory.unchanged());
  if (!possible || before < 0) GTEST_SKIP() << "this system lays nothing into large pages";
  EXPECT_GE(in_large_pages() - before, 6 * 2048L);
}

TEST(LargePages, AreNotAskedForWhereThereIsNoMemory) {
  const Memory memory(kLarge / 2);
  lay_into_large_pages(memory.at(0), memory.at(kLarge / 2 - 1));
  lay_into_large_pages(nullptr, nullptr);
  EXPECT_TRUE(memory.unchanged());
}

}  // namespace
}  // namespace lockstep::large_pages_test
