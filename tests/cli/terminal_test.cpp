// What others wrote into files and onto networks reaches no terminal as more than text.
#include <gtest/gtest.h>
#include <lcm/eventlog.h>

#include <string_view>

#include "cli/monitor/view.hpp"
#include "hmi_bridge/lcm/messages.hpp"
#include "projects/json/problem.hpp"
#include "tests/cli/command_run.hpp"

namespace lockstep::cli::terminal_test {
namespace {

// Clears the screen, names the window, and the same by C1 in UTF-8; a carriage return; right to left.
constexpr char kEvil[] =
    "x\033[2J\033]0;gone\007\xC2\x9B"
    "2J\r\x7F\xE2\x80\xAEy";
// The same in JSON.
constexpr char kEvilJson[] = R"(x\u001b[2J\u001b]0;gone\u0007\u009b2J\r\u007f\u202ey)";

/// Nothing but text and ends of lines has been said, and the evil text is in it.
testing::AssertionResult is_text(const Ended& ended) {
  const std::string all = ended.out + ended.err;
  std::string_view rest = all;
  while (!rest.empty()) {
    std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);  // as the lines of a CSV file end
    if (visible(line) != line) return testing::AssertionFailure() << "said: " << visible(line);
  }
  if (all.find("[2J") == std::string::npos) return testing::AssertionFailure() << "not said: " << all;
  return testing::AssertionSuccess();
}

TEST(Terminal, NamesInACsvTraceAreTextInMessages) {
  const Directory folder;
  const std::string evil = kEvil, picture = folder.file("x.svg");
  const auto plot = [&](const std::string& text, const std::string& signals) {
    return lockstep({"plot", folder.write("evil.csv", text), "-o", picture, "--signals", signals});
  };
  EXPECT_TRUE(is_text(plot("t," + evil + "\n0,1\n", "absent")));
  EXPECT_TRUE(is_text(plot("t," + evil + "\n0,1\n", "x[2J")));
  EXPECT_TRUE(is_text(plot(evil + ",a\n0,1\n", "a")));
  EXPECT_TRUE(is_text(plot("t,a\n0," + evil + "\n", "a")));
  EXPECT_TRUE(is_text(plot("t,a\n0,1e999" + evil + "\n", "a")));
}

TEST(Terminal, ChannelsAndNamesInALogAreTextInMessages) {
  const Directory folder;
  const std::string path = folder.file("evil.lcm"), picture = folder.file("x.svg");
  lcm_eventlog_t* const log = lcm_eventlog_create(path.c_str(), "w");
  ASSERT_NE(log, nullptr);
  LcmEncoder encoder({kEvil, kEvil, 1'000'000, 0},
                     std::vector<TraceSignal>{{kEvil, Type::LREAL, kEvil}, {kEvil, Type::BOOL, kEvil}});
  const auto put = [&](std::string channel, std::span<const std::uint8_t> bytes) {
    lcm_eventlog_event_t event{};
    event.channellen = static_cast<std::int32_t>(channel.size());
    event.channel = channel.data();
    event.datalen = static_cast<std::int32_t>(bytes.size());
    event.data = const_cast<std::uint8_t*>(bytes.data());
    EXPECT_EQ(lcm_eventlog_write_event(log, &event), 0);
  };
  const Value values[2]{};
  put(kEvil + std::string("_HEADER"), encoder.header());
  put(kEvil, encoder.row({0, 0, 0, values}));
  put(kEvil, encoder.row({1, 1, 0, values}).first(60));
  lcm_eventlog_destroy(log);
  EXPECT_TRUE(is_text(lockstep({"plot", path, "-o", picture}))) << "a damaged message";
  EXPECT_TRUE(is_text(lockstep({"plot", path, "-o", picture, "--channel", "ABSENT"})));
}

TEST(Terminal, TextsOfAProjectAndACamAreTextInMessagesAndLists) {
  const Directory folder;
  const std::string evil = kEvilJson;
  const std::string project = folder.write(
      "project.json", R"({"lockstep": 1, "name": "p", "clock": {"servo_cycle": "1ms"}, "description": ")" +
                          evil + R"(", "tags": {"a": {"type": "INT", "comment": ")" + evil + R"("}},
          "modbus": {"server": {"listen": "127.0.0.1:1502"},
                     "map": [{"tag": "a", "table": "holding_register", "address": 0, "access": "read"}]}})");
  for (const char* const form : {"--json", "--csv"})
    EXPECT_TRUE(is_text(lockstep({"tags", project, form}))) << form;
  EXPECT_TRUE(is_text(lockstep({"tags", project})));
  const std::string wrong = folder.write(
      "wrong.json", R"({"lockstep": 1, "name": "p", "clock": {"servo_cycle": "1ms"}, ")" + evil + "\": 1}");
  EXPECT_TRUE(is_text(lockstep({"check", wrong})));
  const std::string points = R"(", "lockstep_cam": 1, "points": [[0.0, 0.0], [360.0, 10.0]]})";
  const std::string named = folder.write("named.cam.json", R"({"name": ")" + evil + points);
  EXPECT_TRUE(is_text(lockstep({"cam", "info", named}))) << "the name is refused";
  const std::string cam = folder.write("evil.cam.json", R"({"name": "c", "description": ")" + evil + points);
  const Ended shown = lockstep({"cam", "info", cam});
  EXPECT_EQ(shown.status, 0);
  EXPECT_TRUE(is_text(shown));
}

TEST(Terminal, AFileWithAnEvilNameIsText) {
  const Directory folder;
  const std::string evil = folder.file(kEvil);
  EXPECT_TRUE(is_text(lockstep({"plot", evil + ".csv", "-o", folder.file("x.svg")})));
  EXPECT_TRUE(is_text(lockstep({"check", evil})));
  EXPECT_TRUE(is_text(lockstep({"cam", "info", evil})));
  EXPECT_TRUE(is_text(lockstep({"monitor", "--once", "--lcm", evil})));
}

TEST(Terminal, ACommandLineThatIsWrongIsText) {
  EXPECT_TRUE(is_text(lockstep({"check", "a", kEvil})));
  EXPECT_TRUE(is_text(lockstep({"run", "a", "--duration", kEvil})));
  EXPECT_TRUE(is_text(lockstep({"describe", kEvil})));
}

TEST(Terminal, WhatTheMonitorShowsIsText) {
  Model model(kEvil);
  model.search = kEvil;
  model.remark = std::string("no record: ") + kEvil;
  const auto lines = [&] {
    Ended shown;
    for (const ViewLine& line : view(model, Model::Clock::time_point{}, {200, 24}, Characters::blocks))
      shown.out += line.text + "\n";
    return shown;
  };
  EXPECT_TRUE(is_text(lines()));
  model.remark.clear();
  EXPECT_TRUE(is_text(lines()));
  model.searching = true;
  EXPECT_TRUE(is_text(lines()));
  model.prompt = model.answer = kEvil;
  EXPECT_TRUE(is_text(lines()));
}

}  // namespace
}  // namespace lockstep::cli::terminal_test
