#include <gtest/gtest.h>

#include <limits>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "projects/literals/duration.hpp"

namespace lockstep::expression_duration_test {
namespace {

TEST(Duration, NumbersWithAUnitAreExact) {
  const std::vector<std::pair<std::string, std::int64_t>> cases = {
      {"10ms", 10'000'000},
      {"250us", 250'000},
      {"2s", 2'000'000'000},
      {"1.5min", 90'000'000'000},
      {"1h", 3'600'000'000'000},
      {"2d", 172'800'000'000'000},
      {"7ns", 7},
      {"0.1us", 100},
      {"0.000000001s", 1},
      {"0s", 0},
      {"1_000ms", 1'000'000'000},
      {"0.30000000000000000000000ms", 300'000},
      {"-5ms", -5'000'000},
      {"9223372036854775807ns", std::numeric_limits<std::int64_t>::max()},
      {"-9223372036854775808ns", std::numeric_limits<std::int64_t>::min()},
      {"9223372036.854775807s", std::numeric_limits<std::int64_t>::max()},
      {"T#1s500ms", 1'500'000'000},
      {"time#-10ms", -10'000'000},
      {"T#25h_15m", 90'900'000'000'000},
      {"T#1d2h3m4s5ms6us7.0ns", 93'784'005'006'007},
      {"t#14.7S", 14'700'000'000}};
  for (const auto& [text, expected] : cases) {
    std::string message;
    EXPECT_EQ(parse_duration(text, message), expected) << text << ": " << message;
  }
}

TEST(Duration, WhatIsNoDurationIsRefusedWithItsReason) {
  const std::string form =
      " is not a duration; allowed are a number with ns, us, ms, s, min, h or d, as in 1.5min, or T#1s500ms";
  const std::string iec = " is not a duration; allowed are d h m s ms us ns in this order, as in T#1s500ms";
  const std::string whole = " is not a whole number of nanoseconds";
  const std::string large = " is longer than 9223372036854775807 ns (about 292 years)";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", form},
      {"10", form},
      {"ms", form},
      {"10 ms", form},
      {"10MS", form},
      {"1m", form},
      {"1.ms", form},
      {".5ms", form},
      {"1e3ms", form},
      {"--1s", form},
      {"1s500ms", form},
      {"nans", form},
      {"1__0s", form},
      {"X#1s", form},
      {"T#", iec},
      {"T#10", iec},
      {"T#1s1h", iec},
      {"T#1s2s", iec},
      {"T#1s_", iec},
      {"T#1min", iec},
      {"T#1s -1ms", iec},
      {"T#1.5s1ms", " has decimals before its last unit; only the last one may have them"},
      {"0.1ns", whole},
      {"0.0000000001s", whole},
      {"1.0000000000000000000000001s", whole},
      {"9223372036854775808ns", large},
      {"-9223372036854775809ns", large},
      {"9223372036.854775808s", large},
      {"100000000000000000000000000000d", large},
      {"T#200000d", large},
      {"T#106751d23h47m16s854ms775us808ns", large}};
  for (const auto& [text, reason] : cases) {
    std::string message;
    EXPECT_EQ(parse_duration(text, message), std::nullopt) << text;
    EXPECT_EQ(message, "'" + text + "'" + reason);
  }
}

TEST(Duration, ThePatternForEditorsRefusesNoneAndWhatIsNone) {
  const std::regex pattern(duration_pattern());
  for (const char* const text : {"10ms", "+1.5min", "-2d", "1_000ns", "T#1s500ms", "time#-10ms", "T#25h_15m",
                                 "T#1d2h3m4s5ms6us7.0ns", "t#14.7S", "0us", "1.5s"}) {
    std::string message;
    EXPECT_TRUE(parse_duration(text, message)) << message;
    EXPECT_TRUE(std::regex_match(text, pattern)) << text;
  }
  for (const char* const text : {"", "10", "ms", "10 ms", "1h30", "10sec", "1m", ".5s", "5.ms", "T#", "T#5",
                                 "X#1s", "T#1s ", " 1s", "1s1", "T#1min"}) {
    std::string message;
    EXPECT_FALSE(parse_duration(text, message)) << text;
    EXPECT_FALSE(std::regex_match(text, pattern)) << text;
  }
}

TEST(Duration, HostileTextsAreRefused) {
  std::string message;
  EXPECT_EQ(parse_duration(std::string(1'000'000, '9') + "s", message), std::nullopt);
  EXPECT_LT(message.size(), 300u);
  EXPECT_EQ(parse_duration("0." + std::string(1'000'000, '0') + "1s", message), std::nullopt);
  EXPECT_EQ(parse_duration(std::string("1\0s", 3), message), std::nullopt);
  EXPECT_EQ(parse_duration("T#" + std::string(1'000'000, '-'), message), std::nullopt);
}

}  // namespace
}  // namespace lockstep::expression_duration_test
