// A retain file after a loss of power at any point: what is read is one of the states written, whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <random>

#include "hmi_bridge/retain/file.hpp"
#include "tests/hmi_bridge/memory_disk.hpp"
#include "tests/support/property.hpp"

namespace lockstep::test::retain_crash_test {
namespace {

constexpr const char* kFile = "machine.retain";
constexpr const char* kProject = "press";

/// All values of an instant; some change, and with time there are more of them.
std::vector<KeptRow> snapshot(int number) {
  std::vector<KeptRow> rows;
  const int count = 3 + number * 4;
  for (int i = 0; i < count; ++i) {
    const int value = i % 3 == 0 ? number : i;
    rows.push_back({"value_" + std::to_string(i), "DINT", std::to_string(value), i % 5 == 0 ? "Gear=2" : ""});
  }
  // Arrays: of a few elements that change, and of more than a page of the file, which do so now and then.
  const auto add_array = [&rows](int elements, int first) {
    std::string text;
    for (int i = 0; i < elements; ++i) text += (i > 0 ? "," : "") + std::to_string(first + 1000 * i);
    const std::string size = std::to_string(elements);
    rows.push_back({"array_" + size, "ARRAY[1.." + size + "] OF DINT", text, ""});
  };
  add_array(3, number);
  add_array(700, number / 5);
  return rows;
}

std::vector<KeptRow> by_name(std::vector<KeptRow> rows) {
  std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return rows;
}

/// Which of the snapshots a disk holds, 0: none; -1: something else.
int held(const DiskContent& content, int written) {
  MemoryDisk disk(content);
  const RetainFile file(kFile, kProject, disk.name());
  const std::vector<KeptRow> rows = by_name(file.rows());
  if (rows.empty()) return 0;
  for (int number = 1; number <= written; ++number)
    if (rows == by_name(snapshot(number))) return number;
  return -1;
}

struct Recorded {
  std::vector<DiskOperation> operations;
  std::vector<std::size_t> commits;  // operations when the snapshot of a number was told to be written
};

Recorded record(int snapshots) {
  MemoryDisk disk;
  disk.recording = true;
  Recorded recorded;
  RetainFile file(kFile, kProject, disk.name());
  for (int number = 1; number <= snapshots; ++number) {
    EXPECT_EQ(file.write(snapshot(number)), "");
    recorded.commits.push_back(disk.operations.size());
  }
  recorded.operations = disk.operations;
  return recorded;
}

TEST(RetainCrash, AfterEveryPrefixAndEveryLossTheFileHoldsTheLastSnapshotToldOrTheNextOne) {
  std::mt19937 random(seed_of_test(20260711));
  const int snapshots = cases(12, 30);
  const int subsets = cases(8, 40);
  const Recorded recorded = record(snapshots);
  ASSERT_GT(recorded.operations.size(), 8u * static_cast<unsigned>(snapshots));
  std::size_t states = 0;
  for (std::size_t count = 0; count <= recorded.operations.size(); ++count) {
    const auto told = static_cast<int>(
        std::upper_bound(recorded.commits.begin(), recorded.commits.end(), count) - recorded.commits.begin());
    const auto expect_whole = [&](const std::vector<std::size_t>& lost, bool torn) {
      ++states;
      const int found = held(disk_after({}, recorded.operations, count, lost, torn), snapshots);
      EXPECT_TRUE(found == told || found == told + 1)
          << "after " << count << " operations, " << lost.size() << " lost: " << found << ", told " << told;
    };
    expect_whole({}, false);
    const std::vector<std::size_t> at_risk = unsynced(recorded.operations, count);
    expect_whole(at_risk, false);
    expect_whole(at_risk, true);
    for (const std::size_t one : at_risk) {
      expect_whole({one}, false);
      expect_whole({one}, true);
    }
    for (int i = 0; i < subsets && at_risk.size() > 2; ++i) {
      std::vector<std::size_t> some;
      for (const std::size_t one : at_risk)
        if (random() % 2 == 0) some.push_back(one);
      expect_whole(some, random() % 2 == 0);
    }
  }
  std::cout << recorded.operations.size() << " operations, " << states << " states of the disk\n";
}

TEST(RetainCrash, TheTestWouldSeeAFileThatIsNotSynced) {
  // Without the syncs everything may be lost, and then told snapshots are missing.
  Recorded recorded = record(4);
  std::erase_if(recorded.operations,
                [](const DiskOperation& operation) { return operation.kind == DiskOperation::sync; });
  const std::size_t count = recorded.operations.size();
  EXPECT_NE(held(disk_after({}, recorded.operations, count, unsynced(recorded.operations, count)), 4), 4);
}

TEST(RetainCrash, AFileWithAChangedByteIsRefusedOrHoldsWhatWasWritten) {
  MemoryDisk disk;
  {
    RetainFile file(kFile, kProject, disk.name());
    for (int number = 1; number <= 3; ++number) ASSERT_EQ(file.write(snapshot(number)), "");
  }
  std::mt19937 random(seed_of_test(20260712));
  int refused = 0;
  const std::size_t size = disk.content[kFile].size();
  for (std::size_t place = 0; place < size; place += soak() ? 1 : 1 + random() % 8) {
    DiskContent changed = disk.content;
    changed[kFile][place] = static_cast<char>(changed[kFile][place] ^ (1 << random() % 8));
    try {
      EXPECT_EQ(held(changed, 3), 3) << "byte " << place;
    } catch (const RetainFileError& error) {
      ++refused;
      EXPECT_NE(std::string(error.what()).find(kFile), std::string::npos);
    }
  }
  EXPECT_GT(refused, 20);
}

TEST(RetainCrash, AFileCutShortIsRefusedUnlessWhatIsMissingIsEmpty) {
  MemoryDisk disk;
  {
    RetainFile file(kFile, kProject, disk.name());
    for (int number = 1; number <= 3; ++number) ASSERT_EQ(file.write(snapshot(number)), "");
  }
  for (std::size_t size = 1; size < disk.content[kFile].size(); size += soak() ? 1 : 97) {
    DiskContent cut = disk.content;
    cut[kFile].resize(size);
    // The last page may end with room that nothing has used.
    const std::string& whole = disk.content[kFile];
    const bool is_empty = whole.find_first_not_of('\0', size) == whole.npos;
    if (is_empty) {
      EXPECT_EQ(held(cut, 3), 3) << size;
    } else {
      EXPECT_THROW(held(cut, 3), RetainFileError) << size;
    }
  }
}

TEST(RetainFullDisk, IsToldHurtsNothingAndIsOverWhenThereIsSpace) {
  for (std::size_t capacity = 0; capacity <= 40'000; capacity += 512) {
    MemoryDisk disk;
    RetainFile file(kFile, kProject, disk.name());
    ASSERT_EQ(file.write(snapshot(1)), "");
    const DiskContent before = disk.content;
    disk.space = capacity;
    int number = 1;
    std::string problem;
    while (problem.empty() && number < 12) problem = file.write(snapshot(++number));
    if (capacity < 10'000) {
      EXPECT_NE(problem.find("full"), std::string::npos) << problem;
    }
    if (!problem.empty()) {
      EXPECT_EQ(by_name(file.rows()), by_name(snapshot(number - 1)));
      EXPECT_EQ(held(disk.content, 12), number - 1) << "what is on the disk, with " << capacity;
    }
    disk.space = SIZE_MAX;
    EXPECT_EQ(file.write(snapshot(number)), "");
    EXPECT_EQ(held(disk.content, 12), number);
  }
}

TEST(RetainFullDisk, FromTheFirstWriteOnIsNoReasonNotToStart) {
  MemoryDisk disk;
  disk.space = 0;
  RetainFile file(kFile, kProject, disk.name());
  EXPECT_NE(file.write(snapshot(1)), "");
  disk.space = SIZE_MAX;
  EXPECT_EQ(file.write(snapshot(1)), "");
  EXPECT_EQ(held(disk.content, 1), 1);
}

TEST(RetainFullDisk, ABrokenOneIsToldAndTriedAgain) {
  MemoryDisk disk;
  RetainFile file(kFile, kProject, disk.name());
  ASSERT_EQ(file.write(snapshot(1)), "");
  disk.broken = true;
  EXPECT_NE(file.write(snapshot(2)), "");
  EXPECT_NE(file.write(snapshot(2)), "");
  disk.broken = false;
  EXPECT_EQ(file.write(snapshot(2)), "");
  EXPECT_EQ(held(disk.content, 2), 2);
}

TEST(RetainVerification, OfAnotherContentIsToldAndTheNextWriteWritesAllOfItAgain) {
  MemoryDisk disk;
  RetainFile file(kFile, kProject, disk.name());
  ASSERT_EQ(file.write(snapshot(1)), "");
  EXPECT_TRUE(file.verify());
  const std::vector<KeptRow> beside = {{"Beside", "INT", "815", ""}};
  disk.spoiled = "815";
  ASSERT_EQ(file.write(beside), "");
  EXPECT_FALSE(file.verify());
  disk.spoiled.clear();
  ASSERT_EQ(file.write(snapshot(1)), "") << "nothing new, but for what the disk has not";
  EXPECT_TRUE(file.verify());
  const RetainFile again(kFile, kProject, disk.name());
  ASSERT_NE(again.find("Beside"), nullptr);
  EXPECT_EQ(again.find("Beside")->value, "815");
  EXPECT_EQ(by_name(again.rows()), by_name(file.rows()));
}

}  // namespace
}  // namespace lockstep::test::retain_crash_test
