// Leading values between controllers, as the monitor shows them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cli/monitor/leading.hpp"
#include "cli/monitor/view.hpp"

namespace lockstep::cli::monitor_leading_test {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;
using Time = HeardLeadingValues::Clock::time_point;

template <class Message>
Bytes bytes_of(const Message& message) {
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

Bytes telegram(std::int64_t sequence, const std::string& area = "line.main", std::int64_t run = 1,
               const std::string& sender = "PLC_1") {
  leading_value_t value{};
  value.run = run;
  value.sequence = sequence;
  value.cycle = 1'000'000;
  value.position = 12.5;
  value.velocity = 100.0;
  value.flags = leading_value_t::VALID;
  value.area = area;
  value.sender = sender;
  return bytes_of(value);
}

Bytes proxies(const std::string& controller, std::int64_t foreign = 0,
              const std::string& area = "line.main") {
  leading_proxies_t told{};
  told.accepted = 42;
  told.foreign = foreign;
  told.area = area;
  told.controller = controller;
  told.proxies = "Line";
  return bytes_of(told);
}

std::string text_of(const HeardLeadingValues& heard, Time now, std::size_t width = 200) {
  std::string text;
  for (const std::string& line : leading_lines(heard, now, width)) text += line + "\n";
  return text;
}

TEST(MonitorLeading, ShowsSourcesWithTheProxiesThatHearThem) {
  HeardLeadingValues heard;
  const Time now{};
  EXPECT_TRUE(heard.accept("line.main", telegram(7), now));
  EXPECT_TRUE(heard.accept("line.main", telegram(10), now));
  EXPECT_TRUE(heard.accept("line.main", telegram(9), now));
  EXPECT_TRUE(heard.accept("line.main_PROXIES", proxies("PLC_3", 5), now));
  EXPECT_TRUE(heard.accept("line.main_PROXIES", proxies("PLC_2"), now));
  EXPECT_EQ(text_of(heard, now),
            "leading values:\n"
            "  line.main from PLC_1  #10  12.5000, 100.0000/s  every 1.000 ms  1 missing\n"
            "    to PLC_2.Line  42 taken\n"
            "    to PLC_3.Line  42 taken  5 foreign\n");
  const std::string later = text_of(heard, now + 5s);
  EXPECT_NE(later.find("1 missing  SILENT for 5.0 s"), std::string::npos) << later;
  EXPECT_NE(later.find("42 taken  SILENT for 5.0 s"), std::string::npos) << later;
}

TEST(MonitorLeading, ShowsProxiesThatNobodyLeads) {
  HeardLeadingValues heard;
  EXPECT_TRUE(heard.accept("line.main_PROXIES", proxies("PLC_2"), {}));
  EXPECT_EQ(text_of(heard, {}), "leading values:\n  line.main  NO SOURCE\n    to PLC_2.Line  42 taken\n");
}

TEST(MonitorLeading, BeginsAnewWithAnotherRunOfTheSource) {
  HeardLeadingValues heard;
  heard.accept("line.main", telegram(100), {});
  heard.accept("line.main", telegram(200), {});
  heard.accept("line.main", telegram(1, "line.main", 2), {});
  EXPECT_EQ(heard.sources().at("line.main").missing, 0u);
  EXPECT_EQ(heard.sources().at("line.main").value.sequence, 1);
}

TEST(MonitorLeading, TakesNothingElseAndNoMoreThanItMay) {
  HeardLeadingValues heard;
  EXPECT_FALSE(heard.accept("line.main", {}, {}));
  EXPECT_FALSE(heard.accept("line.other", telegram(1), {})) << "on another channel than its area's";
  EXPECT_FALSE(heard.accept("line.main", proxies("PLC_2"), {}));
  const std::string longest(5000, 'x');
  EXPECT_FALSE(heard.accept(longest, telegram(1, longest), {}));
  EXPECT_TRUE(heard.empty());
  for (int i = 0; i < 1000; ++i) {
    const std::string area = "line." + std::to_string(i);
    heard.accept(area, telegram(1, area), {});
    heard.accept(area + "_PROXIES", proxies("PLC_2", 0, area), {});
  }
  EXPECT_EQ(heard.sources().size(), HeardLeadingValues::kMaximum);
  EXPECT_EQ(heard.proxies().size(), HeardLeadingValues::kMaximum);
}

TEST(MonitorLeading, ShowsWhatATerminalWouldObeyAsSomethingElse) {
  HeardLeadingValues heard;
  heard.accept("\x1b[2J", telegram(1, "\x1b[2J", 1, "\x1b]0;x"), {});
  heard.accept(std::string("\x1b[2J") + "_PROXIES", proxies("\x1b[2J", 0, "\x1b[2J"), {});
  EXPECT_FALSE(heard.empty());
  EXPECT_EQ(text_of(heard, {}).find('\x1b'), std::string::npos);
}

TEST(MonitorLeading, IsAPaneOfTheView) {
  Model model("udpm://x");
  model.accept("line.main", telegram(7), {});
  const auto shown = [&] {
    std::string text;
    for (const ViewLine& line : view(model, {}, {100, 24}, Characters::ascii)) text += line.text + "\n";
    return text;
  };
  EXPECT_EQ(shown().find("line.main from PLC_1"), std::string::npos);
  model.leading = true;
  EXPECT_NE(shown().find("line.main from PLC_1"), std::string::npos) << shown();
}

}  // namespace
}  // namespace lockstep::cli::monitor_leading_test
