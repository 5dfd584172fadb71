// Values that are kept across runs: their texts, their file, and the thread that writes them.
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <thread>

#include "fb/save_encoder_data.hpp"
#include "hmi_bridge/retain/writer.hpp"
#include "tests/hmi_bridge/memory_disk.hpp"
#include "tests/support/values.hpp"

namespace lockstep::test::retain_test {
namespace {

using test::integer;
using test::real;

using namespace std::chrono_literals;

constexpr auto kDeadline = 30s;

template <class Condition>
bool wait_until(Condition condition) {
  const auto deadline = std::chrono::steady_clock::now() + kDeadline;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

/// A retain file on a real disk, gone with the test.
struct OnDisk : testing::Test {
  std::string path = testing::TempDir() + "lockstep_" + std::to_string(::getpid()) + ".retain";
  void SetUp() override { TearDown(); }
  void TearDown() override {
    std::filesystem::remove(path);
    std::filesystem::remove(path + "-journal");
  }
  /// What there is to say of values that have been given back.
  std::vector<std::string> restored(const std::vector<KeptValue>& values) const {
    RetainFile file(path, "p");
    return restore(file, values);
  }
  std::string refusal(const std::string& project = "p") const {
    try {
      const RetainFile file(path, project);
    } catch (const RetainFileError& error) {
      return error.what();
    }
    return "";
  }
};
using RetainFileTest = OnDisk;
using RetainWriterTest = OnDisk;

bool same(Value a, Value b) {
  return a.u == b.u;
}
TEST(KeptText, GivesTheSameBitsBack) {
  for (int number = 0; number <= static_cast<int>(Type::TIME); ++number) {
    const auto type = static_cast<Type>(number);
    std::vector<Value> values{integer(0), integer(1)};
    if (is_real(type)) {
      values = {real(0.0), real(-0.0), real(0.1F), real(-1e30F), real(INFINITY), real(-INFINITY)};
      if (type == Type::LREAL)
        for (const double r : {0.1, 1e-310, 1.0 / 3.0, std::numeric_limits<double>::max()})
          values.push_back(real(r));
    } else if (type == Type::TIME) {
      values.insert(values.end(), {integer(INT64_MAX), integer(INT64_MIN)});
    } else if (type != Type::BOOL) {
      values.push_back(integer(lowest(type)));
      values.push_back(std::bit_cast<Value>(highest(type)));
    }
    for (const Value value : values) {
      const std::string text = kept_text(value, type);
      const auto back = kept_value(text, type);
      ASSERT_TRUE(back.has_value()) << type_name(type) << " " << text;
      EXPECT_TRUE(same(*back, value)) << type_name(type) << " " << text;
    }
  }
  EXPECT_TRUE(std::isnan(kept_value(kept_text(real(NAN), Type::LREAL), Type::LREAL)->r));
}

TEST(KeptText, OfNoValueOfTheTypeIsNone) {
  for (const auto& [text, type] :
       std::initializer_list<std::pair<const char*, Type>>{{"128", Type::SINT},
                                                           {"-129", Type::SINT},
                                                           {"-1", Type::UINT},
                                                           {"65536", Type::WORD},
                                                           {"1.5", Type::INT},
                                                           {"", Type::LREAL},
                                                           {"1 ", Type::LREAL},
                                                           {"1", Type::BOOL},
                                                           {"true", Type::BOOL},
                                                           {"9223372036854775808", Type::TIME},
                                                           {"x", Type::ULINT}})
    EXPECT_FALSE(kept_value(text, type).has_value()) << text;
}

TEST_F(RetainFileTest, GivesBackWhatWasWrittenUnderNamesInAnyCase) {
  {
    RetainFile file(path, "p");
    EXPECT_TRUE(file.rows().empty());
    EXPECT_EQ(file.write(std::vector<KeptRow>{{"Speed", "LREAL", "1.5", ""}, {"on", "BOOL", "TRUE", "b"}}),
              "");
    EXPECT_EQ(file.write(std::vector<KeptRow>{{"Speed", "LREAL", "2.5", ""}}), "");
    EXPECT_EQ(file.commits(), 2u);
    EXPECT_EQ(file.write(std::vector<KeptRow>{{"Speed", "LREAL", "2.5", ""}}), "");
    EXPECT_EQ(file.commits(), 2u) << "nothing new";
  }
  const RetainFile file(path, "p");
  ASSERT_NE(file.find("SPEED"), nullptr);
  EXPECT_EQ(file.find("speed")->value, "2.5");
  EXPECT_EQ(file.find("on")->basis, "b");
  EXPECT_EQ(file.find("off"), nullptr);
}

TEST_F(RetainFileTest, HoldsProjectsApart) {
  {
    RetainFile file(path, "one");
    EXPECT_EQ(file.write(std::vector<KeptRow>{{"a", "INT", "1", ""}}), "");
  }
  {
    RetainFile file(path, "two");
    EXPECT_TRUE(file.rows().empty());
    EXPECT_EQ(file.other_projects(), std::vector<std::string>{"one"});
    EXPECT_EQ(file.write(std::vector<KeptRow>{{"a", "INT", "2", ""}}), "");
  }
  EXPECT_EQ(RetainFile(path, "one").find("a")->value, "1");
}

TEST_F(RetainFileTest, IsForOneRunAtATime) {
  const RetainFile first(path, "p");
  EXPECT_NE(refusal().find("in use by another run"), std::string::npos) << refusal();
}

TEST_F(RetainFileTest, ThatCannotBeMadeIsToldWithItsPlace) {
  path = testing::TempDir() + "no_such_directory_here/x.retain";
  EXPECT_NE(refusal().find(path), std::string::npos) << refusal();
}

TEST_F(RetainFileTest, OfSomethingElseIsRefusedAndLeftAlone) {
  const std::string text(5000, 'x');
  std::ofstream(path) << text;
  EXPECT_NE(refusal().find("damaged"), std::string::npos) << refusal();
  EXPECT_EQ(std::filesystem::file_size(path), text.size());
  std::filesystem::remove(path);
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  sqlite3_exec(database, "CREATE TABLE recipes (name)", nullptr, nullptr, nullptr);
  sqlite3_close(database);
  EXPECT_NE(refusal().find("another program"), std::string::npos) << refusal();
}

TEST_F(RetainFileTest, ChangedByHandOrByANewerVersionIsRefused) {
  { EXPECT_EQ(RetainFile(path, "p").write(std::vector<KeptRow>{{"a", "INT", "1", ""}}), ""); }
  const auto change = [this](const char* text) {
    sqlite3* database = nullptr;
    sqlite3_open(path.c_str(), &database);
    EXPECT_EQ(sqlite3_exec(database, text, nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(database);
  };
  change("UPDATE kept SET value = '2'");
  EXPECT_NE(refusal().find("not those that were written"), std::string::npos) << refusal();
  change("UPDATE kept SET value = '1'");
  EXPECT_EQ(refusal(), "");
  change("DELETE FROM state");
  EXPECT_NE(refusal().find("damaged"), std::string::npos) << refusal();
  change("PRAGMA user_version = 2");
  EXPECT_NE(refusal().find("version 2"), std::string::npos) << refusal();
}

/// Two values that always change together, and an adjustment.
struct Machine {
  std::int32_t count = 7;
  double triple = 21.0;
  bool adjusted = false;
  double offset = 0.0;

  std::vector<KeptValue> values(const std::string& basis = "Gear=2") {
    return {{.name = "count", .signal = {&count, Type::DINT, -1}},
            {.name = "triple", .signal = {&triple, Type::LREAL, -1}},
            {.name = "offset",
             .signal = {&offset, Type::LREAL, -1},
             .present = Signal{&adjusted, Type::BOOL, -1},
             .basis = basis}};
  }
  void set(int value) {
    count = value;
    triple = 3.0 * value;
  }
};

TEST_F(RetainWriterTest, KeepsAllValuesOfTheLastTickAndGivesThemBack) {
  {
    Machine machine;
    RetainWriter writer(RetainFile(path, "p"), machine.values(), 1h);
    writer.start();
    for (int tick = 0; tick < 100; ++tick) {
      machine.set(tick);
      writer.image().publish(tick);
    }
    writer.stop();
    EXPECT_LE(writer.commits(), 2u) << "once at the start, once at the end";
  }
  Machine machine;
  EXPECT_TRUE(restored(machine.values()).empty());
  EXPECT_EQ(machine.count, 99);
  EXPECT_EQ(machine.triple, 297.0);
  EXPECT_FALSE(machine.adjusted) << "there was nothing to keep";
}

TEST_F(RetainWriterTest, WritesWhileTheCycleRunsAlwaysOneInstant) {
  Machine machine;
  {
    RetainWriter writer(RetainFile(path, "p"), machine.values(), 1ms);
    writer.start();
    machine.adjusted = true;
    for (int tick = 1; writer.commits() < 20; ++tick) {
      machine.set(tick);
      machine.offset = -tick;
      writer.image().publish(tick);
      std::this_thread::yield();
    }
    writer.stop();
  }
  Machine next;
  EXPECT_TRUE(restored(next.values()).empty());
  EXPECT_EQ(next.count, machine.count);
  EXPECT_EQ(next.triple, 3.0 * next.count);
  EXPECT_TRUE(next.adjusted);
  EXPECT_EQ(next.offset, -next.count);
}

TEST_F(RetainWriterTest, TellsOnceThatTheDiskIsFullAndOnceThatItIsNoLonger) {
  MemoryDisk disk;
  Machine machine;
  RetainFile file("full.retain", "p", disk.name());
  disk.space = 0;
  RetainWriter writer(std::move(file), machine.values(), 1ms);
  writer.start();
  std::string news;
  ASSERT_TRUE(wait_until([&] { return !(news = writer.news()).empty(); }));
  EXPECT_NE(news.find("full"), std::string::npos) << news;
  EXPECT_TRUE(writer.failing());
  std::this_thread::sleep_for(20ms);
  EXPECT_EQ(writer.news(), "") << "told again";
  disk.space = SIZE_MAX;
  ASSERT_TRUE(wait_until([&] { return !(news = writer.news()).empty(); }));
  EXPECT_NE(news.find("again"), std::string::npos) << news;
  EXPECT_FALSE(writer.failing());
  writer.stop();
}

/// A program that asks for the adjustments to be kept, tick by tick.
struct Asking {
  EncoderSaving saving;
  MC_SaveAbsoluteEncoderData save;
  std::int64_t now = 0;

  Asking() { save.connect(saving); }
  void tick(RetainWriter& writer) {
    writer.image().take_writes();
    saving.step();
    save.call(now);
    writer.image().publish(now++);
  }
  /// A whole job; the error that it ends with.
  WORD ask(RetainWriter& writer) {
    save.Execute = true;
    tick(writer);
    EXPECT_TRUE(save.Busy);
    EXPECT_TRUE(wait_until([&] {
      tick(writer);
      return !save.Busy;
    }));
    const WORD error = save.ErrorID;
    EXPECT_EQ(save.Done, error == WORD{});
    save.Execute = false;
    tick(writer);
    return error;
  }
};

TEST_F(RetainWriterTest, AnswersAJobWhenTheDiskHasTheAdjustmentsOfItsTick) {
  Machine machine;
  Asking program;
  RetainWriter writer(RetainFile(path, "p"), machine.values(), 1h, &program.saving);
  writer.start();
  for (int round = 1; round <= 3; ++round) {
    machine.adjusted = true;
    machine.offset = 0.5 * round;
    EXPECT_EQ(program.ask(writer), WORD{});
    const std::string copy = path + ".copy";
    std::filesystem::copy_file(path, copy, std::filesystem::copy_options::overwrite_existing);
    const RetainFile opened(copy, "p");
    ASSERT_NE(opened.find("offset"), nullptr) << round;
    EXPECT_EQ(opened.find("offset")->value,
              kept_text(Signal{&machine.offset, Type::LREAL, -1}.load(), Type::LREAL));
    std::filesystem::remove(copy);
  }
  const std::uint64_t commits = writer.commits();
  EXPECT_EQ(program.ask(writer), WORD{}) << "the disk has them already";
  EXPECT_EQ(writer.commits(), commits);
  writer.stop();
}

TEST_F(RetainWriterTest, AnswersAJobThatItCannotWriteWithTheReason) {
  MemoryDisk disk;
  Machine machine;
  Asking program;
  RetainFile file("full.retain", "p", disk.name());
  disk.space = 0;
  RetainWriter writer(std::move(file), machine.values(), 1h, &program.saving);
  writer.start();
  EXPECT_EQ(program.ask(writer), static_cast<WORD>(ErrorId::encoder_data_no_space));
  disk.space = SIZE_MAX;
  EXPECT_EQ(program.ask(writer), WORD{});
  writer.stop();

  MemoryDisk broken;
  RetainFile other("broken.retain", "p", broken.name());
  broken.broken = true;
  Asking next;
  RetainWriter failing(std::move(other), machine.values(), 1h, &next.saving);
  failing.start();
  EXPECT_EQ(next.ask(failing), static_cast<WORD>(ErrorId::encoder_data_not_written));
  failing.stop();
}

TEST_F(RetainWriterTest, AValueOfAnotherTypeIsToldAndNotTaken) {
  { EXPECT_EQ(RetainFile(path, "p").write(std::vector<KeptRow>{{"count", "REAL", "1.5", ""}}), ""); }
  Machine machine;
  const auto remarks = restored(machine.values());
  ASSERT_EQ(remarks.size(), 1u);
  for (const char* part : {"count", "REAL", "1.5", "DINT"})
    EXPECT_NE(remarks[0].find(part), std::string::npos) << remarks[0];
  EXPECT_EQ(machine.count, 7);
}

/// An array as a tag is one.
struct KeptArray {
  explicit KeptArray(std::size_t count, double first = 0.0) : numbers(count, first) {}
  std::vector<double> numbers;

  KeptValue value(const std::string& type) {
    KeptValue kept{.name = "recipe", .signal = {numbers.data(), Type::LREAL, -1}};
    for (double& number : numbers) kept.elements.push_back({&number, Type::LREAL, -1});
    kept.array_type = type;
    return kept;
  }
};

TEST_F(RetainWriterTest, KeepsArraysWithAllTheirElementsOfOneTick) {
  KeptArray array(1000);
  Machine machine;
  {
    std::vector<KeptValue> values = machine.values();
    values.insert(values.begin() + 1, array.value("ARRAY[1..1000] OF LREAL"));
    RetainWriter writer(RetainFile(path, "p"), values, 1ms);
    writer.start();
    machine.adjusted = true;
    for (int tick = 1; writer.commits() < 20; ++tick) {
      machine.set(tick);
      machine.offset = -tick;
      for (std::size_t i = 0; i < array.numbers.size(); ++i)
        array.numbers[i] = tick + 0.001 * static_cast<double>(i);
      writer.image().publish(tick);
      std::this_thread::yield();
    }
    writer.stop();
  }
  KeptArray next(1000);
  Machine other;
  std::vector<KeptValue> values = other.values();
  values.push_back(next.value("ARRAY[1..1000] OF LREAL"));
  EXPECT_TRUE(restored(values).empty());
  EXPECT_EQ(next.numbers, array.numbers) << "the same bits";
  EXPECT_EQ(other.count, machine.count);
  EXPECT_EQ(other.offset, machine.offset);
  EXPECT_EQ(next.numbers.front(), other.count);
}

TEST_F(RetainWriterTest, AnElementThatChangesAloneIsWritten) {
  KeptArray array(3, 1.5);
  const std::vector<KeptValue> values{array.value("ARRAY[0..2] OF LREAL")};
  {
    RetainWriter writer(RetainFile(path, "p"), values, 1ms);
    writer.start();
    ASSERT_TRUE(wait_until([&] { return writer.commits() == 1; }));
    array.numbers[1] = 2.5;
    writer.image().publish(0);
    ASSERT_TRUE(wait_until([&] { return writer.commits() == 2; }));
    writer.stop();
    EXPECT_EQ(writer.commits(), 2u);
  }
  const RetainFile file(path, "p");
  EXPECT_EQ(file.find("recipe")->value, "1.5,2.5,1.5");
  EXPECT_EQ(file.find("recipe")->type, "ARRAY[0..2] OF LREAL");
}

TEST_F(RetainWriterTest, AnArrayOfAnotherShapeIsToldNotTakenAndPutAside) {
  {
    EXPECT_EQ(
        RetainFile(path, "p").write(std::vector<KeptRow>{{"recipe", "ARRAY[0..1] OF LREAL", "5,7.5", ""}}),
        "");
  }
  KeptArray array(3, 1.0);
  const std::string type = "ARRAY[0..2] OF LREAL";
  {
    RetainFile file(path, "p");
    const auto remarks = restore(file, {array.value(type)});
    ASSERT_EQ(remarks.size(), 1u);
    for (const char* part :
         {"recipe was kept as ARRAY[0..1] OF LREAL (5,7.5) and is ARRAY[0..2] OF LREAL now",
          "begins with its init value", "stays in the file as 'recipe@ARRAY[0..1] OF LREAL'"})
      EXPECT_NE(remarks[0].find(part), std::string::npos) << remarks[0];
    EXPECT_EQ(array.numbers, std::vector<double>(3, 1.0));
    RetainWriter writer(std::move(file), {array.value(type)}, 1ms);
    writer.start();
    writer.stop();
  }
  {
    const RetainFile file(path, "p");
    EXPECT_EQ(file.find("recipe")->value, "1,1,1");
    EXPECT_EQ(file.find("recipe@ARRAY[0..1] OF LREAL")->value, "5,7.5");
  }
  EXPECT_TRUE(restored({array.value(type)}).empty()) << "told once";
  // Of other bounds with as many elements, and of an array that has become a value.
  EXPECT_EQ(restored({array.value("ARRAY[1..3] OF LREAL")}).size(), 1u);
  double number = 3.0;
  EXPECT_EQ(restored({KeptValue{.name = "recipe", .signal = {&number, Type::LREAL, -1}}}).size(), 1u);
  EXPECT_EQ(number, 3.0);
}

TEST_F(RetainWriterTest, AnArrayThatCannotBePutAsideForWantOfSpaceEndsTheStart) {
  MemoryDisk disk;
  RetainFile file("full.retain", "p", disk.name());
  ASSERT_EQ(
      file.write(std::vector<KeptRow>{{"recipe", "ARRAY[0..1] OF LREAL", std::string(9000, '1') + ",1", ""}}),
      "");
  disk.space = 0;
  KeptArray array(3, 1.0);
  EXPECT_THROW(restore(file, {array.value("ARRAY[0..2] OF LREAL")}), RetainFileError);
  EXPECT_NE(file.find("recipe"), nullptr);
}

TEST_F(RetainWriterTest, ATextOfAnArrayWithMoreOrFewerOrOtherValuesIsDamage) {
  KeptArray array(2, 1.0);
  for (const char* text : {"1", "1,2,3", "1,x", "", "1,", "1 ,2"}) {
    {
      EXPECT_EQ(
          RetainFile(path, "p").write(std::vector<KeptRow>{{"recipe", "ARRAY[0..1] OF LREAL", text, ""}}),
          "");
    }
    EXPECT_THROW(restored({array.value("ARRAY[0..1] OF LREAL")}), RetainFileError) << text;
    EXPECT_EQ(array.numbers, std::vector<double>(2, 1.0)) << "all of them or none";
  }
}

TEST_F(RetainWriterTest, AnAdjustmentOfAnEncoderWithOtherSettingsIsToldNotTakenAndLeftInTheFile) {
  { EXPECT_EQ(RetainFile(path, "p").write(std::vector<KeptRow>{{"offset", "LREAL", "12", "Gear=2"}}), ""); }
  Machine machine;
  {
    RetainFile file(path, "p");
    const auto remarks = restore(file, machine.values("Gear=3"));
    ASSERT_EQ(remarks.size(), 1u);
    EXPECT_NE(remarks[0].find("Gear=2; it is: Gear=3"), std::string::npos) << remarks[0];
    EXPECT_FALSE(machine.adjusted);
    RetainWriter writer(std::move(file), machine.values("Gear=3"), 1ms);
    writer.start();
    writer.stop();
  }
  EXPECT_TRUE(restored(machine.values()).empty());
  EXPECT_EQ(machine.offset, 12.0);
}

TEST_F(RetainWriterTest, ATextThatIsNoValueOfItsTypeIsDamage) {
  { EXPECT_EQ(RetainFile(path, "p").write(std::vector<KeptRow>{{"count", "DINT", "seven", ""}}), ""); }
  Machine machine;
  EXPECT_THROW(restored(machine.values()), RetainFileError);
}

}  // namespace
}  // namespace lockstep::test::retain_test
