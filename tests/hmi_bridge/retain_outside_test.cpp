// What others do to a retain file while it is in use: nothing that was told to be kept may be missing under
// its name, and nothing of others is thrown away.
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <thread>

#include "fb/save_encoder_data.hpp"
#include "hmi_bridge/retain/writer.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::test::retain_outside_test {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

template <class Condition>
bool wait_until(Condition condition) {
  const auto deadline = std::chrono::steady_clock::now() + 30s;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

/// As a run has it, but for how often it looks at its file.
RetainWriter watchful(const std::string& path, std::int32_t& count) {
  static_assert(RetainWriter::kWatch == 1s, "as RETAIN.md says");
  return {RetainFile(path, "p"), {{.name = "count", .signal = {&count, Type::DINT, -1}}}, 1h, nullptr, 20ms};
}

std::vector<KeptRow> row(int number) {
  return {{"count", "DINT", std::to_string(number), ""}};
}

/// What is kept under a name; the file may be open in this process.
std::string kept(const std::string& path, const std::string& project = "p") {
  const Directory directory;
  const std::string copy = directory.file("copy");
  std::error_code error;
  fs::copy_file(path, copy, error);
  if (error) return error.message();
  try {
    const RetainFile file(copy, project);
    const KeptRow* const count = file.find("count");
    return count == nullptr ? "no row" : count->value;
  } catch (const RetainFileError& problem) {
    return problem.what();
  }
}

/// Something that somebody does to a file that is in use.
struct Deed {
  const char* name;
  std::function<void(const std::string&)> perform;
  bool leaves_something;  ///< under the name of the file
};

void PrintTo(const Deed& deed, std::ostream* out) {
  *out << deed.name;
}

void replace_by_copy(const std::string& path, const std::string& content) {
  std::ofstream(path + ".copy", std::ios::binary) << content;
  fs::rename(path + ".copy", path);
}

const Deed kDeeds[] = {
    {"Deleted", [](const std::string& path) { fs::remove(path); }, false},
    {"Moved", [](const std::string& path) { fs::rename(path, path + ".moved"); }, false},
    {"Truncated", [](const std::string& path) { fs::resize_file(path, 0); }, true},
    {"Cut", [](const std::string& path) { fs::resize_file(path, 5000); }, true},
    {"ReplacedByText", [](const std::string& path) { replace_by_copy(path, "something else"); }, true},
    {"ReplacedByAnEmptyFile", [](const std::string& path) { replace_by_copy(path, ""); }, true},
    {"ReplacedByAnOlderState",
     [](const std::string& path) {
       fs::remove(path + ".old");
       EXPECT_EQ(RetainFile(path + ".old", "p").write(row(-1)), "");
       fs::rename(path + ".old", path);
     },
     true},
    {"OverwrittenInPlaceByAnOlderState",
     [](const std::string& path) {
       fs::remove(path + ".old");
       EXPECT_EQ(RetainFile(path + ".old", "p").write(row(-1)), "");
       std::ofstream(path, std::ios::binary) << content(path + ".old");
       fs::remove(path + ".old");
     },
     true},
    {"ReplacedByADirectory",
     [](const std::string& path) {
       fs::remove(path);
       fs::create_directory(path);
     },
     true},
};

class RetainOutside : public testing::TestWithParam<Deed> {
 protected:
  const Directory directory;
  const std::string path = directory.file("values.retain");
  const Deed& deed = GetParam();

  void expect_told(const std::string& remark) const {
    EXPECT_NE(remark.find(path), std::string::npos) << remark;
    EXPECT_NE(remark.find("made again with all values"), std::string::npos) << remark;
    EXPECT_EQ(remark.find(".aside-1") != std::string::npos, deed.leaves_something) << remark;
    EXPECT_EQ(fs::exists(path + ".aside-1"), deed.leaves_something);
  }
};

TEST_P(RetainOutside, WhatWasWrittenIsMadeAgainAndWhatWasThereStays) {
  RetainFile file(path, "p");
  ASSERT_EQ(file.write(row(1)), "");
  EXPECT_EQ(file.hold(), "");
  EXPECT_EQ(file.remark(), "");
  deed.perform(path);
  EXPECT_EQ(file.hold(), "");
  expect_told(file.remark());
  EXPECT_EQ(kept(path), "1");
  EXPECT_EQ(file.write(row(2)), "");
  EXPECT_EQ(file.remark(), "") << "told once";
  EXPECT_EQ(kept(path), "2");
}

TEST_P(RetainOutside, AWriteReachesTheDiskUnderTheNameOfTheFile) {
  RetainFile file(path, "p");
  ASSERT_EQ(file.write(row(1)), "");
  deed.perform(path);
  EXPECT_EQ(file.write(row(2)), "");
  expect_told(file.remark());
  EXPECT_EQ(kept(path), "2");
  deed.perform(path);
  EXPECT_EQ(file.write(row(2)), "") << "nothing new, but it is not there any more";
  EXPECT_EQ(kept(path), "2");
}

TEST_P(RetainOutside, SavingIsDoneOnlyWhenTheValuesAreUnderTheNameOfTheFile) {
  std::int32_t count = 7;
  EncoderSaving saving;
  MC_SaveAbsoluteEncoderData save;
  save.connect(saving);
  RetainWriter writer(RetainFile(path, "p"), {{.name = "count", .signal = {&count, Type::DINT, -1}}}, 1h,
                      &saving);
  writer.start();
  std::int64_t now = 0;
  const auto tick = [&] {
    writer.image().take_writes();
    saving.step();
    save.call(now);
    writer.image().publish(now++);
  };
  const auto ask = [&] {
    save.Execute = true;
    tick();
    EXPECT_TRUE(wait_until([&] {
      tick();
      return !save.Busy;
    }));
    const bool done = save.Done;
    save.Execute = false;
    tick();
    return done;
  };
  ASSERT_TRUE(ask());
  for (const bool is_new : {true, false}) {
    if (is_new) ++count;
    tick();
    deed.perform(path);
    ASSERT_TRUE(ask());
    EXPECT_EQ(kept(path), std::to_string(count)) << (is_new ? "a new value" : "nothing new");
  }
  writer.stop();
  expect_told(writer.news());
}

TEST_P(RetainOutside, WhereNothingIsToBeWrittenItIsSeenAllTheSame) {
  std::int32_t count = 7;
  RetainWriter writer = watchful(path, count);
  writer.start();
  ASSERT_TRUE(wait_until([&] { return writer.commits() == 1; }));
  deed.perform(path);
  std::string news;
  ASSERT_TRUE(wait_until([&] { return !(news = writer.news()).empty(); }));
  expect_told(news);
  EXPECT_EQ(kept(path), "7");
  writer.stop();
}

INSTANTIATE_TEST_SUITE_P(Deeds, RetainOutside, testing::ValuesIn(kDeeds),
                         [](const auto& deed) { return std::string(deed.param.name); });

TEST(RetainOutsideFile, WithValuesOfOtherProjectsIsMadeAgainWithThoseToo) {
  const Directory directory;
  const std::string path = directory.file("both");
  { EXPECT_EQ(RetainFile(path, "other").write(row(5)), ""); }
  RetainFile file(path, "p");
  EXPECT_EQ(file.write(row(1)), "");
  fs::remove(path);
  EXPECT_EQ(file.hold(), "");
  EXPECT_EQ(kept(path, "other"), "5");
  EXPECT_EQ(kept(path), "1");
}

TEST(RetainOutsideFile, ThatIsTouchedCopiedOrGivenOtherRightsIsTheSame) {
  const Directory directory;
  const std::string path = directory.file("values");
  RetainFile file(path, "p");
  EXPECT_EQ(file.write(row(1)), "");
  const auto inode = [&] {
    struct stat status {};
    EXPECT_EQ(::stat(path.c_str(), &status), 0);
    return status.st_ino;
  };
  const ino_t before = inode();
  ASSERT_EQ(::chmod(path.c_str(), 0600), 0);
  fs::create_hard_link(path, directory.file("link"));
  EXPECT_EQ(file.write(row(2)), "");
  EXPECT_EQ(file.remark(), "");
  EXPECT_EQ(inode(), before);
  EXPECT_EQ(kept(path), "2");
}

TEST(RetainOutsideFile, KeepsItsRightsWhenItIsMadeAgain) {
  const Directory directory;
  const std::string path = directory.file("values");
  RetainFile file(path, "p");
  ASSERT_EQ(::chmod(path.c_str(), 0600), 0);
  EXPECT_EQ(file.write(row(2)), "");
  fs::remove(path);
  EXPECT_EQ(file.hold(), "");
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(RetainOutsideFile, ThatAnotherRunHasTakenIsLeftAloneAndWritingFails) {
  const Directory directory;
  const std::string path = directory.file("values");
  RetainFile file(path, "p");
  EXPECT_EQ(file.write(row(1)), "");
  fs::remove(path);
  {
    RetainFile other(path, "p");
    EXPECT_EQ(other.write(row(5)), "");
    EXPECT_NE(file.write(row(2)).find("in use"), std::string::npos);
    EXPECT_NE(file.hold(), "");
    EXPECT_EQ(kept(path), "5");
    EXPECT_EQ(other.write(row(6)), "");
    EXPECT_EQ(other.remark(), "");
  }
  EXPECT_EQ(file.write(row(3)), "") << "the other run is over";
  EXPECT_EQ(kept(path), "3");
  EXPECT_EQ(kept(path + ".aside-1"), "6");
}

TEST(RetainOutsideFile, WithoutItsDirectoryFailsUntilThereIsOneAgain) {
  const Directory directory;
  const std::string folder = directory.file("state");
  fs::create_directory(folder);
  const std::string path = folder + "/values";
  std::int32_t count = 7;
  RetainWriter writer = watchful(path, count);
  writer.start();
  ASSERT_TRUE(wait_until([&] { return writer.commits() == 1; }));
  fs::rename(folder, directory.file("elsewhere"));
  std::string news;
  ASSERT_TRUE(wait_until([&] { return !(news = writer.news()).empty(); }));
  EXPECT_NE(news.find("deleted or moved and cannot be made again: No such file"), std::string::npos) << news;
  EXPECT_TRUE(writer.failing());
  fs::create_directory(folder);
  ASSERT_TRUE(wait_until([&] { return !writer.failing(); }));
  EXPECT_EQ(kept(path), "7");
  writer.stop();
}

/// The journal holds what a loss of power needs.
TEST(RetainOutsideFile, WhoseJournalIsGoneIsOpenedAgain) {
  const Directory directory;
  const std::string path = directory.file("values");
  RetainFile file(path, "p");
  EXPECT_EQ(file.write(row(1)), "");
  ASSERT_TRUE(fs::exists(path + "-journal"));
  fs::remove(path + "-journal");
  EXPECT_EQ(file.write(row(2)), "");
  EXPECT_TRUE(fs::exists(path + "-journal"));
  EXPECT_EQ(file.remark(), "");
  EXPECT_EQ(kept(path), "2");
}

TEST(RetainOutsideFile, OfAnotherRunsJournalTakesNothingOver) {
  const Directory directory;
  const std::string path = directory.file("values");
  {
    RetainFile file(path, "p");
    EXPECT_EQ(file.write(row(1)), "");
    fs::copy_file(path + "-journal", path + "-kept");
  }
  fs::remove(path);
  fs::rename(path + "-kept", path + "-journal");
  RetainFile file(path, "p");
  EXPECT_TRUE(file.rows().empty());
  EXPECT_EQ(file.write(row(2)), "");
  EXPECT_EQ(kept(path), "2");
}

TEST(RetainOutsideFile, OfALinkIsMadeWhereTheLinkLeads) {
  const Directory directory;
  fs::create_symlink("target", directory.file("link"));
  RetainFile file(directory.file("link"), "p");
  EXPECT_EQ(file.write(row(1)), "");
  EXPECT_EQ(kept(directory.file("target")), "1");
  fs::remove(directory.file("target"));
  EXPECT_EQ(file.hold(), "");
  EXPECT_EQ(kept(directory.file("target")), "1");
  EXPECT_TRUE(fs::is_symlink(directory.file("link")));
}

TEST(RetainOutsideFile, OfNoBytesOrOneIsDamagedAndLeftAlone) {
  const Directory directory;
  for (const std::string& text : {std::string(), std::string(1, '\0'), std::string(1, 'S')}) {
    const std::string path = directory.write("values", text);
    EXPECT_NE(kept(path).find("damaged (it is empty)"), std::string::npos) << kept(path);
    EXPECT_THROW(RetainFile(path, "p"), RetainFileError);
    EXPECT_EQ(content(path), text);
  }
  fs::remove(directory.file("values"));
  fs::create_directory(directory.file("values"));
  EXPECT_THROW(RetainFile(directory.file("values"), "p"), RetainFileError);
}

/// A run that is killed before its first write leaves no file that counts as damaged.
TEST(RetainOutsideFile, ThatWasMadeAndNeverWrittenIsNewAndLeavesNothingBeside) {
  const Directory directory;
  const std::string path = directory.file("values");
  { const RetainFile file(path, "p"); }
  EXPECT_GT(fs::file_size(path), 0u);
  EXPECT_EQ(std::distance(fs::directory_iterator(directory.file("")), fs::directory_iterator()), 1);
  EXPECT_EQ(kept(path), "no row");
}

}  // namespace
}  // namespace lockstep::test::retain_outside_test
