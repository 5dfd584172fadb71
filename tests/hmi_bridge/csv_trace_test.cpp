#include "hmi_bridge/traces/csv_trace.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <system_error>

#include "hmi_bridge/traces/csv_number.hpp"
#include "hmi_bridge/traces/csv_reader.hpp"
#include "tests/hmi_bridge/trace_samples.hpp"
#include "tests/support/property.hpp"

namespace lockstep::csv_trace_test {
namespace {

std::string seconds(std::int64_t nanoseconds) {
  char text[kNumberLength];
  return {text, print_seconds(text, nanoseconds)};
}

std::string printed(Value value, Type type) {
  char text[kNumberLength];
  return {text, print_value(text, value, type)};
}

std::string message_of(const std::string& text) {
  try {
    parse_csv_trace(text, "run.csv");
  } catch (const TraceFormatError& error) {
    return error.what();
  }
  return "no error";
}

TEST(CsvTrace, AFileIsAsTheContractHasItToTheByte) {
  const Directory directory;
  const std::string path = directory.file("run.csv");
  {
    CsvTrace trace(path);
    trace.begin(sample_signals());
    const std::vector<Value> first = {real(0.1),
                                      integer(0),
                                      integer(-5),
                                      integer(INT64_MIN),
                                      integer(-1),
                                      integer(0),
                                      real(static_cast<double>(0.1f))};
    const std::vector<Value> second = {real(1e22),         integer(1),   integer(7),
                                       integer(INT64_MAX), integer(255), integer(1'500'000'001),
                                       real(-0.0)};
    trace.row({0, 0, 0, first});
    trace.row({2'000'000, 2, 0, second});
    trace.end();
    EXPECT_EQ(trace.lost(), 0u);
    EXPECT_EQ(trace.reason(), "");
  }
  EXPECT_EQ(content(path),
            "t,Knife.Position,gear.InSync,count,total,mask,after,share\n"
            "0,0.1,0,-5,-9223372036854775808,18446744073709551615,0,0.10000000149011612\n"
            "0.002,1e+22,1,7,9223372036854775807,255,1.500000001,-0.0\n");
}

TEST(CsvTrace, ATraceWithoutSignalsOrRowsIsItsFirstLine) {
  const Directory directory;
  CsvTrace trace(directory.file("run.csv"));
  trace.begin({});
  trace.row({1'000'000'000, 0, 0, {}});
  trace.end();
  EXPECT_EQ(content(directory.file("run.csv")), "t\n1\n");
}

TEST(CsvTrace, FlushedRowsAreOnTheDiskWhileTheRunGoesOn) {
  const Directory directory;
  CsvTrace trace(directory.file("run.csv"));
  trace.begin({});
  trace.row({0, 0, 0, {}});
  trace.flush();
  EXPECT_EQ(content(directory.file("run.csv")), "t\n0\n");
}

TEST(CsvTrace, AFileThatCannotBeOpenedIsNamed) {
  try {
    CsvTrace trace("/no/such/folder/run.csv");
    FAIL() << "opened";
  } catch (const std::system_error& error) {
    EXPECT_EQ(std::string(error.what()), "/no/such/folder/run.csv: No such file or directory");
  }
}

TEST(CsvNumber, TimesAreExactDecimalSeconds) {
  EXPECT_EQ(seconds(0), "0");
  EXPECT_EQ(seconds(2'000'000), "0.002");
  EXPECT_EQ(seconds(1'000'000'000), "1");
  EXPECT_EQ(seconds(12'345'678'900), "12.3456789");
  EXPECT_EQ(seconds(1), "0.000000001");
  EXPECT_EQ(seconds(-1'500'000'000), "-1.5");
  EXPECT_EQ(seconds(INT64_MAX), "9223372036.854775807");
  EXPECT_EQ(seconds(INT64_MIN), "-9223372036.854775808");
}

TEST(CsvNumber, ATimeReadsBackAsTheDoubleNearestToIt) {
  std::mt19937_64 random(test::seed_of_test(20240117));
  for (int i = 0; i < test::cases(100'000, 10'000'000); ++i) {
    const auto t =
        static_cast<std::int64_t>(random() >> (11 + random() % 50));  // below 2^53: exact as a double
    ASSERT_EQ(std::strtod(seconds(t).c_str(), nullptr), static_cast<double>(t) / 1e9) << "t " << t;
  }
}

TEST(CsvNumber, WhatIsNoFiniteNumberIsWrittenWithoutASignOfNan) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(printed(real(kInfinity), Type::LREAL), "inf");
  EXPECT_EQ(printed(real(-kInfinity), Type::LREAL), "-inf");
  EXPECT_EQ(printed(real(nan), Type::LREAL), "nan");
  EXPECT_EQ(printed(real(std::copysign(nan, -1.0)), Type::REAL), "nan");
  const TraceTable table = parse_csv_trace("t,a,b,c\n0,nan,inf,-inf\n", "run.csv");
  EXPECT_TRUE(std::isnan(table.columns[0][0]));
  EXPECT_EQ(table.columns[1][0], kInfinity);
  EXPECT_EQ(table.columns[2][0], -kInfinity);
}

// Doubles of every exponent, subnormal ones among them.
TEST(CsvTrace, EveryDoubleReadsBackBitForBit) {
  constexpr std::size_t kRows = 20'000;
  const Directory directory;
  const std::string path = directory.file("run.csv");
  std::mt19937_64 random(test::seed_of_test(4711));
  std::vector<double> numbers = {0.0, -0.0, std::numeric_limits<double>::denorm_min(),
                                 std::numeric_limits<double>::max(), std::numeric_limits<double>::min()};
  while (numbers.size() < kRows) {
    const auto number = std::bit_cast<double>(random());
    if (std::isfinite(number)) numbers.push_back(number);
  }
  {
    CsvTrace trace(path);
    trace.begin(std::vector<TraceSignal>{{"x", Type::LREAL, ""}});
    for (std::size_t i = 0; i < kRows; ++i) {
      const Value value = real(numbers[i]);
      trace.row({static_cast<std::int64_t>(i) * 250'000, i, 0, {&value, 1}});
    }
    trace.end();
    ASSERT_EQ(trace.lost(), 0u);
  }
  const TraceTable table = read_csv_trace(path);
  ASSERT_EQ(table.t.size(), kRows);
  EXPECT_EQ(table.remark, "");
  EXPECT_EQ(table.signals.at(0).name, "x");
  for (std::size_t i = 0; i < kRows; ++i) {
    ASSERT_EQ(table.t[i], static_cast<double>(i * 250'000) / 1e9) << i;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(table.columns[0][i]), std::bit_cast<std::uint64_t>(numbers[i]))
        << "number " << i;
  }
}

TEST(CsvReader, ErrorsNameLineAndColumn) {
  EXPECT_EQ(message_of(""), "run.csv:1:1: the file is empty");
  EXPECT_EQ(message_of("t,a"), "run.csv:1:1: the line of the names has no end");
  EXPECT_EQ(message_of("x,a\n"), "run.csv:1:1: the first column is 'x', it has to be 't'");
  EXPECT_EQ(message_of("t,a,,b\n"), "run.csv:1:5: a column has no name");
  EXPECT_EQ(message_of("t,a\n0,1\n0.1,2.5x\n"), "run.csv:3:5: \"2.5x\" is not a number");
  EXPECT_EQ(message_of("t,a\n0,\n"), "run.csv:2:3: \"\" is not a number");
  EXPECT_EQ(message_of("t,a\n0,TRUE\n"), "run.csv:2:3: \"TRUE\" is not a number");
  EXPECT_EQ(message_of("t,a\n0,1e999\n"), "run.csv:2:3: \"1e999\" is outside the range of a double");
  EXPECT_EQ(message_of("t,a\n0\n"), "run.csv:2:2: fewer values than names: a line has 2 values");
  EXPECT_EQ(message_of("t,a\n0,1,2\n"), "run.csv:2:5: more values than names: a line has 2 values");
  EXPECT_EQ(message_of("t,a\n\n"), "run.csv:2:1: \"\" is not a number");
  EXPECT_THROW(read_csv_trace("/no/such/run.csv"), TraceFormatError);
  EXPECT_THROW(read_csv_trace("/"), TraceFormatError);
}

TEST(CsvReader, WhatHasNoEndIsRefused) {
  const Directory directory;
  const auto refused = [](const std::string& path) {
    try {
      read_csv_trace(path);
    } catch (const TraceFormatError& error) {
      return std::string(error.what());
    }
    return std::string("was read");
  };
  for (const char* const device : {"/dev/zero", "/dev/full"}) {
    const std::string link = directory.file(device + 5) + ".csv";
    std::filesystem::create_symlink(device, link);
    EXPECT_EQ(refused(link), link + ": is no regular file but a pipe, a device or a socket");
  }
  const std::string pipe = directory.file("pipe.csv");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(refused(pipe), pipe + ": is no regular file but a pipe, a device or a socket");
  // A terabyte of holes: the third line has no end.
  const std::string holes = directory.file("holes.csv");
  std::ofstream(holes) << "t,a\n0,1\n";
  std::filesystem::resize_file(holes, std::uintmax_t{1} << 40);
  EXPECT_EQ(refused(holes), holes + ":3:1: the line is longer than 16 MiB");
}

TEST(CsvReader, ALastLineThatWasCutShortIsLeftOutWithARemark) {
  const TraceTable table = parse_csv_trace("t,a\r\n0,1.5\r\n0.001,12", "run.csv");
  ASSERT_EQ(table.t.size(), 1u);
  EXPECT_EQ(table.columns[0][0], 1.5);
  EXPECT_EQ(table.remark, "run.csv:3:1: the last line has no end: it was cut short and is left out");
}

}  // namespace
}  // namespace lockstep::csv_trace_test
