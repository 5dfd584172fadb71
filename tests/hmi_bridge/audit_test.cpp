// The audit log: what repeats is put together, what is lost is told, and files are bounded.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cmath>
#include <csignal>
#include <limits>
#include <sstream>

#include "hmi_bridge/audit/log.hpp"
#include "hmi_bridge/modbus/request.hpp"
#include "hmi_bridge/network/visible_text.hpp"
#include "tests/hmi_bridge/modbus_machine.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::audit_test {
namespace {

using namespace std::chrono_literals;
using test::content;
using test::Directory;
using Clock = AuditQueue::Clock;

constexpr Clock::time_point kBegin{100s};

AuditEntry entry(const std::string& before, const std::string& after, const std::string& tag = "speed") {
  AuditEntry entry;
  entry.time = {};
  entry.tick = 5;
  entry.via = "modbus";
  entry.from = "10.0.0.1:4000";
  entry.source = "10.0.0.1";
  entry.who = "unit 1";
  entry.action = "write";
  entry.target = entry.subject = tag;
  entry.before = before;
  entry.after = after;
  entry.accepted = true;
  return entry;
}

std::vector<std::string> taken(AuditQueue& queue, Clock::time_point now) {
  std::vector<AuditLine> lines;
  queue.take(now, lines);
  std::vector<std::string> texts;
  for (const AuditLine& line : lines) texts.push_back(line.text);
  return texts;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(AuditLine, IsOneJsonObjectWithWhoFromWhereWhatAndWhen) {
  EXPECT_EQ(audit_line(entry("200", "250.5")),
            R"({"time":"1970-01-01T00:00:00.000000Z","tick":5,"via":"modbus","from":"10.0.0.1:4000",)"
            R"("who":"unit 1","action":"write","target":"speed","old":200,"new":250.5,"result":"accepted"})"
            "\n");
  AuditEntry refused = entry("", "");
  refused.accepted = false;
  refused.why = "exception 2: no";
  EXPECT_TRUE(has(audit_line(refused), R"("result":"refused","why":"exception 2: no"})"));
}

TEST(AuditLine, StaysALineWhateverAStrangerPutsIntoIt) {
  AuditEntry evil = entry("1", "2", "a\"b\\c\nd\x1b[2J\xff\u2028{}");
  EXPECT_TRUE(has(audit_line(evil), R"("target":"a\"b\\c?d?[2J????{}")")) << audit_line(evil);
}

TEST(AuditValue, IsJson) {
  EXPECT_EQ(audit_value(Value{.u = 1}, Type::BOOL), "true");
  EXPECT_EQ(audit_value(Value{.i = -7}, Type::INT), "-7");
  EXPECT_EQ(audit_value(Value{.r = 0.1}, Type::LREAL), "0.1");
  EXPECT_EQ(audit_value(Value{.r = std::numeric_limits<double>::infinity()}, Type::LREAL), "\"inf\"");
  EXPECT_EQ(audit_value(Value{.r = std::nan("")}, Type::REAL), "\"nan\"");
}

TEST(AuditQueue, TellsTheFirstAccessAtOnceAndWhatFollowsWithinASecondTogether) {
  AuditQueue queue;
  queue.add(entry("0", "1"), kBegin);
  EXPECT_EQ(taken(queue, kBegin).size(), 1u);
  for (int i = 1; i <= 500; ++i) queue.add(entry(std::to_string(i), std::to_string(i + 1)), kBegin + i * 1ms);
  EXPECT_TRUE(taken(queue, kBegin + 999ms).empty());
  const auto lines = taken(queue, kBegin + 1s);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(has(lines[0], R"("old":1,"new":501,"result":"accepted","folded":500})")) << lines[0];
}

TEST(AuditQueue, TellsTheSameValueAgainOnceAMinute) {
  AuditQueue queue;
  std::size_t lines = 0;
  for (int i = 0; i < 1000; ++i) {  // ten a second
    queue.add(entry("7", "7"), kBegin + i * 100ms);
    lines += taken(queue, kBegin + i * 100ms).size();
  }
  EXPECT_EQ(lines, 2u);
  queue.add(entry("7", "8"), kBegin + 100s);
  const auto other = taken(queue, kBegin + 100s);
  ASSERT_EQ(other.size(), 1u) << "another value does not wait for the minute";
  EXPECT_TRUE(has(other[0], R"("old":7,"new":8)"));
}

TEST(AuditQueue, KeepsSourcesSubjectsAndOutcomesApart) {
  AuditQueue queue;
  queue.add(entry("0", "1"), kBegin);
  queue.add(entry("0", "1", "start"), kBegin);
  AuditEntry other = entry("0", "1");
  other.source = "10.0.0.2";
  queue.add(other, kBegin);
  AuditEntry refused = entry("0", "1");
  refused.accepted = false;
  queue.add(refused, kBegin);
  AuditEntry again = entry("0", "1");
  again.from = "10.0.0.1:4001";  // connected anew
  queue.add(again, kBegin);
  EXPECT_EQ(taken(queue, kBegin).size(), 4u);
}

TEST(AuditQueue, TellsWhatWasPutTogetherAtTheEnd) {
  AuditQueue queue;
  for (int i = 0; i < 3; ++i) queue.add(entry("7", "7"), kBegin);
  std::vector<AuditLine> lines;
  queue.take_all(lines);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_TRUE(has(lines[1].text, R"("folded":2)"));
  EXPECT_EQ(lines[1].entries, 2u);
}

TEST(AuditQueue, CountsWhatItHasNoCapacityForAndTellsItInTheLog) {
  AuditQueue queue(10);
  for (int i = 0; i < 25; ++i) queue.add(entry("0", "1", "tag" + std::to_string(i)), kBegin);
  auto lines = taken(queue, kBegin);
  ASSERT_EQ(lines.size(), 11u);
  EXPECT_TRUE(has(lines[10], R"("event":"lost","entries":15})")) << lines[10];
  EXPECT_EQ(queue.lost(), 15u);
  EXPECT_TRUE(taken(queue, kBegin).empty()) << "told once";
  queue.add(entry("0", "1", "more"), kBegin);
  EXPECT_EQ(taken(queue, kBegin).size(), 1u) << "a subject that is not known is told each time";
}

TEST(AuditQueue, ForgetsSourcesThatAreSilent) {
  AuditQueue queue(10);
  for (int i = 0; i < 10; ++i) queue.add(entry("0", "1", "tag" + std::to_string(i)), kBegin);
  taken(queue, kBegin);
  for (int i = 0; i < 3; ++i) queue.add(entry("0", "1", "new"), kBegin + 61s);
  EXPECT_EQ(taken(queue, kBegin + 61s).size(), 1u);
}

AuditLine line(char c, std::size_t size) {
  return {std::string(size - 1, c) + "\n", 1};
}

TEST(AuditFile, AppendsToWhatIsThereBehindAWholeLine) {
  const Directory folder;
  const std::string path = folder.write("audit.jsonl", "old\ncut");
  AuditFile file({.file = path});
  const AuditLine lines[] = {line('a', 3)};
  EXPECT_EQ(file.append(lines), 1u);
  EXPECT_EQ(content(path), "old\ncut\naa\n");
  struct stat status {};
  const std::string fresh = folder.file("fresh");
  AuditFile other({.file = fresh});
  ASSERT_EQ(::stat(fresh.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0007u, 0u) << "not for everybody";
}

TEST(AuditFile, BeginsTheNextFileInTimeAndKeepsSoMany) {
  const Directory folder;
  const std::string path = folder.file("audit.jsonl");
  AuditFile file({.file = path, .size = 100, .files = 3});
  for (const char c : {'a', 'b', 'c', 'd', 'e', 'f', 'g', 'h'}) {
    const AuditLine lines[] = {line(c, 50)};
    ASSERT_EQ(file.append(lines), 1u);
    EXPECT_EQ(file.problem(), "");
  }
  EXPECT_EQ(content(path)[0], 'g');
  EXPECT_EQ(content(path).size(), 100u);
  EXPECT_EQ(content(path + ".1")[0], 'e');
  EXPECT_EQ(content(path + ".2")[0], 'c');
  EXPECT_FALSE(std::filesystem::exists(path + ".3"));
}

TEST(AuditFile, ThatIsMovedOrReplacedUnderARunIsBegunAnewAndTold) {
  const Directory folder;
  const std::string path = folder.file("audit.jsonl");
  AuditFile file({.file = path});
  const auto write = [&](char c) {
    const AuditLine lines[] = {line(c, 5)};
    EXPECT_EQ(file.append(lines), 1u);
    return file.problem();
  };
  EXPECT_EQ(write('a'), "");
  std::filesystem::rename(path, path + ".moved");
  EXPECT_NE(write('b').find("moved, removed or replaced"), std::string::npos);
  EXPECT_EQ(write('c'), "");
  std::filesystem::remove(path);
  EXPECT_NE(write('d'), "");
  EXPECT_EQ(content(path), line('d', 5).text);
  std::filesystem::rename(folder.write("other", "foreign\n"), path);
  EXPECT_NE(write('e'), "");
  EXPECT_EQ(content(path), "foreign\n" + line('e', 5).text);
  EXPECT_EQ(content(path + ".moved"), line('a', 5).text);
}

TEST(AuditFile, ThatCannotBeOneIsRefused) {
  const Directory folder;
  EXPECT_THROW(AuditFile({.file = folder.file("no/such/folder")}), std::system_error);
  const std::string pipe = folder.file("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(AuditFile({.file = pipe}), std::system_error);
}

/// While it lives, files of this process end at so many bytes: a disk that is full.
class FullDisk {
 public:
  explicit FullDisk(rlim_t size) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{size, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() { grow(); }
  void grow() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST(AuditFile, OnAFullDiskTellsSoAndGoesOnBehindTheCutLine) {
  const Directory folder;
  const std::string path = folder.file("audit.jsonl");
  AuditFile file({.file = path});
  const AuditLine lines[] = {line('a', 40), line('b', 40), line('c', 40)};
  {
    const FullDisk disk(100);
    EXPECT_EQ(file.append(lines), 2u);
    EXPECT_NE(file.problem(), "");
  }
  EXPECT_EQ(file.append(std::span(lines).subspan(2)), 1u);
  const std::string expected = lines[0].text + lines[1].text + std::string(20, 'c') + "\n" + lines[2].text;
  EXPECT_EQ(content(path), expected);
}

TEST(AuditLog, WritesWhatItIsGivenAndTellsItsBegin) {
  const Directory folder;
  const std::string path = folder.file("audit.jsonl");
  {
    AuditLog log({.file = path}, "press \"7\"");
    for (int i = 0; i < 5; ++i) log.add(entry("0", "1", "tag" + std::to_string(i)));
    log.stop();
    EXPECT_EQ(log.lost(), 0u);
    EXPECT_EQ(log.news(), "");
  }
  std::istringstream lines(content(path));
  std::string first, text;
  std::getline(lines, first);
  EXPECT_TRUE(has(first, R"("event":"begin","project":"press \"7\""})")) << first;
  for (int i = 0; i < 5; ++i) {
    std::getline(lines, text);
    EXPECT_TRUE(has(text, "\"tag" + std::to_string(i) + "\"")) << text;
  }
}

TEST(AuditLog, OnAFullDiskHoldsNobodyUpAndCountsWhatItLoses) {
  const Directory folder;
  const std::string path = folder.file("audit.jsonl");
  std::uint64_t lost = 0;
  {
    const FullDisk disk(16);
    AuditLog log({.file = path}, "full", 8);
    const auto deadline = Clock::now() + 60s;
    std::string news;
    for (int i = 0; news.empty() && Clock::now() < deadline; ++i) {
      log.add(entry("0", "1", "tag" + std::to_string(i)));
      news = log.news();
    }
    EXPECT_TRUE(has(news, "audit log " + path + ": ")) << news;
    EXPECT_TRUE(has(news, "tried again every second"));
    for (int i = 0; i < 100; ++i) log.add(entry("0", "1", "more" + std::to_string(i)));
    log.stop();
    lost = log.lost();
  }
  EXPECT_GE(lost, 100u);
  EXPECT_EQ(content(path).size(), 16u);
}

TEST(AuditLog, TellsInItselfWhatAFullDiskHasCost) {
  const Directory folder;
  const std::string path = folder.file("audit.jsonl");
  AuditLog log({.file = path}, "full", 4);
  {
    const FullDisk disk(16);
    const auto deadline = Clock::now() + 60s;
    for (int i = 0; log.lost() == 0 && Clock::now() < deadline; ++i)
      log.add(entry("0", "1", "tag" + std::to_string(i)));
    ASSERT_GT(log.lost(), 0u);
  }
  log.stop();
  EXPECT_TRUE(has(content(path), R"("event":"lost","entries":)")) << content(path);
}

// ---- What Modbus tells

class AuditedModbus : public ::testing::Test {
 protected:
  AuditedModbus() {
    for (std::size_t i = 0; i < machine.signals.size(); ++i) names.push_back("signal" + std::to_string(i));
    names[0] = "start";
    names[2005] = "word";
    responder.audit_to(log, names);
    responder.set_peer(peer);
  }
  void ask(std::vector<std::uint8_t> pdu) {
    std::vector<std::uint8_t> frame = {0, 1, 0, 0, 0, static_cast<std::uint8_t>(pdu.size() + 1), 3};
    frame.insert(frame.end(), pdu.begin(), pdu.end());
    responder.answer(frame);
  }
  /// What the log has, without its first line.
  std::vector<std::string> lines() {
    log.stop();
    std::istringstream all(content(path));
    std::vector<std::string> found;
    for (std::string text; std::getline(all, text);) found.push_back(text);
    if (!found.empty()) found.erase(found.begin());
    return found;
  }

  Directory folder;
  std::string path = folder.file("audit.jsonl");
  ModbusMachine machine;
  std::vector<std::string> names;
  ModbusPeer peer{"[fe80::1]:4711", "fe80::1"};
  AuditLog log{{.file = path}, "modbus"};
  ModbusResponder responder{machine.map, machine.image};
};

TEST_F(AuditedModbus, WriteIsToldWithOldAndNewValueAndTick) {
  machine.tick();
  machine.tick();
  ask({5, 0, 0, 0xFF, 0});
  const auto told = lines();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_TRUE(has(told[0],
                  R"("tick":1,"via":"modbus","from":"[fe80::1]:4711","who":"unit 3","action":"write",)"
                  R"("target":"start","old":false,"new":true,"result":"accepted"})"))
      << told[0];
}

TEST_F(AuditedModbus, MaskedWriteIsToldWithTheWholeValue) {
  ask({22, 0, 30, 0xFF, 0x0F, 0x00, 0xA0});
  const auto told = lines();
  ASSERT_EQ(told.size(), 1u);
  EXPECT_TRUE(has(told[0], R"("old":3855,"new":4015)")) << told[0];
}

TEST_F(AuditedModbus, RefusedWriteIsToldWithItsReasonAndAReadNotAtAll) {
  ask({5, 0, 1, 0xFF, 0});
  ask({6, 0, 31, 0});
  ask({16, 0, 40, 0, 9, 18});
  ask({3, 0, 30, 0, 1});
  ask({3, 0x12, 0x34, 0, 1});
  ask({16});
  const auto told = lines();
  ASSERT_EQ(told.size(), 3u) << "the last one is of the same table and reason as the one before";
  EXPECT_TRUE(has(told[0], R"("target":"coil 1","result":"refused","why":"exception 2: )")) << told[0];
  EXPECT_TRUE(has(told[1], R"("target":"holding_register 31","result":"refused","why":"exception 3: )"));
  EXPECT_TRUE(has(told[2], R"("folded":2})")) << told[2];
}

TEST_F(AuditedModbus, ValueThatItsEntryDoesNotTakeIsToldWithTagValueAndLimits) {
  std::vector<ModbusEntry> entries = machine.map.entries();
  for (ModbusEntry& entry : entries) {
    if (entry.table != ModbusTable::holding_register) continue;
    if (entry.address == 30) entry.range = {10.0, 500.0};
    if (entry.address == 31) entry.range = {-5.0, kAny.highest};
  }
  std::vector<Type> types;
  for (std::uint32_t i = 0; i < machine.signals.size(); ++i) types.push_back(machine.image.type(i));
  const ModbusMap limited(entries, types);
  ASSERT_TRUE(limited.problems().empty());
  ModbusResponder narrow(limited, machine.image);
  narrow.audit_to(log, names);
  narrow.set_peer(peer);
  const auto write = [&narrow](std::uint8_t address, std::uint8_t high, std::uint8_t low) {
    const std::uint8_t frame[] = {0, 1, 0, 0, 0, 6, 3, 6, 0, address, high, low};
    narrow.answer(frame);
  };
  machine.tick();
  write(30, 0x02, 0x58);  // 600
  write(31, 0xFF, 0xFA);  // -6
  write(31, 0x00, 0x80);  // 128, of a SINT
  write(30, 0x01, 0xF4);  // 500
  const auto told = lines();
  ASSERT_EQ(told.size(), 4u);
  EXPECT_TRUE(has(told[0], R"("target":"word","old":3855,"new":600,"result":"refused",)"
                           R"("why":"exception 3: beyond the limits of holding_register 30, 10 to 500"})"))
      << told[0];
  EXPECT_TRUE(has(told[1], R"("new":-6,"result":"refused",)"
                           R"("why":"exception 3: beyond the limits of holding_register 31, -5 and more"})"))
      << told[1];
  EXPECT_TRUE(has(told[2], R"("target":"word","old":3855,"new":500,"result":"accepted"})")) << told[2];
  EXPECT_TRUE(has(told[3], R"("why":"exception 3: what holding_register 31 was to get is no SINT"})"))
      << told[3];
}

}  // namespace
}  // namespace lockstep::audit_test
