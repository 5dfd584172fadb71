#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "hmi_bridge/lcm/event_messages.hpp"
#include "hmi_bridge/lcm/log.hpp"
#include "hmi_bridge/lcm/messages.hpp"
#include "hmi_bridge/lcm/trace_reader.hpp"
#include "tests/hmi_bridge/trace_samples.hpp"

namespace lockstep::lcm_log_test {
namespace {

constexpr std::int64_t kPeriod = 250'000'000;  // [ns]

const LcmTraceIdentity kIdentity{"rotary_knife", "KNIFE", kPeriod, 0};

void write_log(const std::string& path, const LcmTraceIdentity& identity,
               const std::vector<std::vector<Value>>& rows) {
  LcmLog log(path, identity);
  log.begin(sample_signals());
  for (std::size_t i = 0; i < rows.size(); ++i)
    log.row({static_cast<std::int64_t>(i) * identity.period, 2 * i, 0, rows[i]});
  log.end();
  EXPECT_EQ(log.reason(), "");
}

std::string message_of(const std::string& path, const std::string& channel = "") {
  try {
    read_lcm_trace(path, channel);
  } catch (const TraceFormatError& error) {
    return error.what();
  }
  return "no error";
}

TEST(LcmLog, ALogReadsBackWithoutALostBit) {
  const Directory directory;
  const std::string path = directory.file("run.lcm");
  const auto rows = sample_rows(500, 17);
  write_log(path, kIdentity, rows);

  LcmTraceReader reader(path);
  EXPECT_EQ(reader.signals(), sample_signals());
  EXPECT_EQ(reader.header().project, "rotary_knife");
  EXPECT_EQ(reader.header().period, kPeriod);
  std::size_t count = 0;
  for (; reader.next(); ++count) {
    const TraceRow row = reader.row();
    ASSERT_EQ(row.t, static_cast<std::int64_t>(count) * kPeriod);
    ASSERT_EQ(row.tick, 2 * count);
    for (std::size_t i = 0; i < row.values.size(); ++i) ASSERT_EQ(row.values[i].u, rows[count][i].u);
  }
  EXPECT_EQ(count, rows.size());
  EXPECT_EQ(reader.remark(), "");
}

TEST(LcmLog, InVirtualTimeTheStampsAreVirtualAndTwoLogsAreTheSameBytes) {
  const Directory directory;
  write_log(directory.file("a.lcm"), kIdentity, sample_rows(100, 3));
  write_log(directory.file("b.lcm"), kIdentity, sample_rows(100, 3));
  EXPECT_EQ(content(directory.file("a.lcm")), content(directory.file("b.lcm")));
  LcmTraceReader reader(directory.file("a.lcm"));
  for (std::int64_t i = 0; reader.next(); ++i) {
    EXPECT_EQ(reader.event_time(), i * 250'000);
    EXPECT_EQ(reader.utime(), i * 250'000);
  }
}

TEST(LcmLog, InRealTimeTheStampsCountFromTheStartOnTheWallClock) {
  const Directory directory;
  constexpr std::int64_t kStart = 1'700'000'000'000'000;
  write_log(directory.file("a.lcm"), {"p", "C", kPeriod, kStart}, sample_rows(3, 3));
  LcmTraceReader reader(directory.file("a.lcm"));
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(reader.next());
  EXPECT_EQ(reader.event_time(), kStart + 500'000);
}

TEST(LcmLog, TheHeaderStandsAtTheFrontAndOnceForEverySecond) {
  const Directory directory;
  write_log(directory.file("run.lcm"), kIdentity, sample_rows(9, 3));
  lcm_eventlog_t* log = lcm_eventlog_create(directory.file("run.lcm").c_str(), "r");
  ASSERT_NE(log, nullptr);
  std::string order;
  while (lcm_eventlog_event_t* event = lcm_eventlog_read_next_event(log)) {
    const std::string channel(event->channel, static_cast<std::size_t>(event->channellen));
    order += channel == "KNIFE_HEADER" ? 'H' : channel == "KNIFE" ? 'r' : '?';
    lcm_eventlog_free_event(event);
  }
  lcm_eventlog_destroy(log);
  EXPECT_EQ(order, "HrrrrHrrrrHr");
}

TraceEvent alarm_of_the_knife() {
  TraceEvent event;
  event.kind = EventKind::alarm;
  event.t = kPeriod;
  event.tick = 2;
  event.source = "Knife";
  event.type = "TO_SynchronousAxis";
  event.number = 521;
  event.text = "following error";
  event.reaction = 6;
  event.reaction_text = "remove the enable";
  event.cause = "it lags";
  event.remedy = "look at Kv";
  event.value_name = "following error";
  event.limit_name = "permitted";
  event.unit = "°";
  event.value = 5.25;
  event.limit = 5.0;
  return event;
}

TEST(LcmLog, TellsItsEventsWithAllThatIsKnownOfThemAndHowFarItIs) {
  const Directory directory;
  const std::string path = directory.file("run.lcm");
  const auto rows = sample_rows(40, 17);
  TraceEvent started;
  started.kind = EventKind::job_started;
  started.source = "gear";
  started.type = "MC_GearIn";
  LcmLog log(path, kIdentity);
  log.begin(sample_signals());
  log.event(started);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    log.row({static_cast<std::int64_t>(i) * kPeriod, 2 * i, 0, rows[i]});
    if (i == 1) log.event(alarm_of_the_knife());
  }
  log.end();

  std::vector<TraceEvent> heard;
  LcmTraceReader reader(path);
  reader.hear_events([&heard](TraceEvent event) { heard.push_back(std::move(event)); });
  double before = reader.progress();
  EXPECT_LT(before, 0.2);
  while (reader.next()) {
    EXPECT_GT(reader.progress(), before);
    before = reader.progress();
  }
  EXPECT_EQ(reader.progress(), 1.0);
  ASSERT_EQ(heard.size(), 2u);
  EXPECT_EQ(heard[0].kind, EventKind::job_started);
  EXPECT_EQ(heard[0].source, "gear");
  const TraceEvent wanted = alarm_of_the_knife();
  EXPECT_EQ(heard[1].kind, wanted.kind);
  EXPECT_EQ(heard[1].t, wanted.t);
  EXPECT_EQ(heard[1].number, 521);
  EXPECT_EQ(heard[1].text, wanted.text);
  EXPECT_EQ(heard[1].reaction_text, wanted.reaction_text);
  EXPECT_EQ(detail_lines(heard[1]), detail_lines(wanted));
}

TEST(LcmLog, PassesOverWhatIsNoEventOnTheirChannel) {
  const std::vector<std::uint8_t> bytes(
      LcmEncoder(kIdentity, sample_signals()).event(alarm_of_the_knife()).size());
  EXPECT_FALSE(event_of(bytes)) << "all of it is 0";
  LcmEncoder encoder(kIdentity, sample_signals());
  const auto encoded = encoder.event(alarm_of_the_knife());
  const std::vector<std::uint8_t> whole(encoded.begin(), encoded.end());
  ASSERT_TRUE(event_of(whole));
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(event_of(std::span(whole).first(size))) << size;
  // Whatever is changed of it, it is an event or none, and takes no more memory than it has bytes.
  for (std::size_t at = 0; at < whole.size(); ++at)
    for (const int value : {0, 1, 0x7f, 0xff}) {
      std::vector<std::uint8_t> changed = whole;
      changed[at] = static_cast<std::uint8_t>(value);
      const auto event = event_of(changed);
      EXPECT_TRUE(!event || event->text.size() < whole.size());
    }
  TraceEvent other = alarm_of_the_knife();
  const auto detail = encoder.detail(other);
  const std::vector<std::uint8_t> known(detail.begin(), detail.end());
  ++other.number;
  EXPECT_FALSE(add_detail(other, known)) << "of another event";
  for (std::size_t size = 0; size < known.size(); ++size) {
    TraceEvent event = *event_of(whole);
    EXPECT_FALSE(add_detail(event, std::span(known).first(size))) << size;
  }
}

TEST(LcmLog, ATraceWithoutRowsStillTellsWhatItWouldHaveHeld) {
  const Directory directory;
  write_log(directory.file("run.lcm"), kIdentity, {});
  const TraceTable table = read_lcm_trace(directory.file("run.lcm"));
  EXPECT_EQ(table.signals, sample_signals());
  EXPECT_TRUE(table.t.empty());
}

TEST(LcmLog, ItsOwnTraceIsTheFirstOfAllChannels) {
  const Directory directory;
  const std::string path = directory.file("run.lcm");
  const auto rows = sample_rows(2, 17);
  LcmLog log(path, kIdentity);
  const auto channel = log.add_channel({"rotary_knife", "SLOW", kPeriod, 0});
  for (TraceSink* sink : {channel.get(), static_cast<TraceSink*>(&log)}) sink->begin(sample_signals());
  channel->row({0, 0, 0, rows[0]});
  for (std::int64_t i = 0; i < 2; ++i) log.row({i * kPeriod, 0, 0, rows[static_cast<std::size_t>(i)]});
  channel->end();
  log.end();
  EXPECT_EQ(read_lcm_trace(path).t.size(), 2u);
  EXPECT_EQ(read_lcm_trace(path, "SLOW").t.size(), 1u);
}

TEST(LcmTraceReader, TellsTheOtherTracesOfALogThatHaveRows) {
  const Directory directory;
  const std::string path = directory.file("run.lcm");
  const auto rows = sample_rows(4, 17);
  LcmLog log(path, kIdentity);
  const auto slow = log.add_channel({"rotary_knife", "SLOW", kPeriod, 0});
  const auto fast = log.add_channel({"rotary_knife", "FAST", kPeriod, 0});
  const auto empty = log.add_channel({"rotary_knife", "EMPTY", kPeriod, 0});
  for (TraceSink* sink : {slow.get(), fast.get(), empty.get(), static_cast<TraceSink*>(&log)})
    sink->begin(sample_signals());
  for (std::size_t i = 0; i < 4; ++i)
    for (TraceSink* sink : {slow.get(), fast.get(), static_cast<TraceSink*>(&log)})
      sink->row({static_cast<std::int64_t>(i) * kPeriod, 0, 0, rows[i]});
  for (TraceSink* sink : {slow.get(), fast.get(), empty.get()}) sink->end();
  log.event(alarm_of_the_knife());
  log.end();
  LcmTraceReader reader(path);
  while (reader.next()) continue;
  EXPECT_EQ(reader.others(), (std::vector<std::string>{"FAST", "SLOW"})) << "by name; no row, no trace";
  LcmTraceReader other(path, "SLOW");
  while (other.next()) continue;
  EXPECT_EQ(other.others(), (std::vector<std::string>{"FAST", "KNIFE"}));
}

TEST(LcmTraceReader, WithoutAChannelReadsTheFirstTraceThatHasRows) {
  const Directory directory;
  const std::string path = directory.file("run.lcm");
  const auto rows = sample_rows(1, 17);
  LcmLog log(path, kIdentity);
  const auto channel = log.add_channel({"rotary_knife", "SLOW", kPeriod, 0});
  for (TraceSink* sink : {channel.get(), static_cast<TraceSink*>(&log)}) sink->begin(sample_signals());
  channel->row({0, 0, 0, rows[0]});
  channel->end();
  log.end();
  EXPECT_EQ(read_lcm_trace(path).t.size(), 1u);
  EXPECT_EQ(read_lcm_trace(path, "KNIFE").t.size(), 0u);
}

TEST(LcmLog, AFileThatCannotBeOpenedIsNamed) {
  try {
    LcmLog log("/no/such/folder/run.lcm", kIdentity);
    FAIL() << "opened";
  } catch (const std::system_error& error) {
    EXPECT_EQ(std::string(error.what()), "/no/such/folder/run.lcm: No such file or directory");
  }
}

TEST(LcmTraceReader, WhatHasNoEndIsRefused) {
  const Directory directory;
  const std::string link = directory.file("zero.lcm");
  std::filesystem::create_symlink("/dev/zero", link);
  const std::string pipe = directory.file("pipe.lcm");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& path : {link, pipe}) {
    try {
      LcmTraceReader reader(path);
      FAIL() << path;
    } catch (const TraceFormatError& error) {
      EXPECT_EQ(error.what(), path + ": is no regular file but a pipe, a device or a socket");
    }
  }
}

TEST(LcmTraceReader, ALogThatWasCutShortGivesItsWholeRowsAndARemark) {
  const Directory directory;
  const std::string path = directory.file("run.lcm");
  write_log(path, kIdentity, sample_rows(10, 3));
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 5);
  const TraceTable table = read_lcm_trace(path);
  EXPECT_EQ(table.t.size(), 9u);
  EXPECT_EQ(table.remark, "the log is cut short or damaged behind event 11");
}

TEST(LcmTraceReader, AnEventThatClaimsMoreThanTheFileHasEndsTheLog) {
  const Directory directory;
  const std::string path = directory.file("run.lcm");
  write_log(path, kIdentity, sample_rows(10, 3));
  constexpr std::uint8_t kTwoGigabytes[] = {0x7F, 0xFF, 0xFF, 0xFF};
  std::string bytes = content(path);
  constexpr std::size_t kDataLength = 24;
  const std::size_t last = bytes.rfind("\xED\xA1\xDA\x01");
  std::copy(std::begin(kTwoGigabytes), std::end(kTwoGigabytes),
            bytes.begin() + static_cast<std::ptrdiff_t>(last + kDataLength));
  std::ofstream(path, std::ios::binary) << bytes;

  const TraceTable table = read_lcm_trace(path);
  EXPECT_EQ(table.t.size(), 9u);
  EXPECT_EQ(table.remark, "the log is cut short or damaged behind event 11");

  // Such a claim of the first event already.
  std::ofstream(path, std::ios::binary) << bytes.substr(last);
  EXPECT_EQ(message_of(path), path + ": is not an LCM event log");
}

// Lengths that the file holds and no log has: the library would write of them, or take 1.5 GiB.
TEST(LcmTraceReader, AnEventOfALengthThatNoMessageHasEndsTheLog) {
  const Directory directory;
  const std::string path = directory.file("long.lcm");
  const auto log_of = [&](std::uint32_t channel, std::uint32_t data) {
    std::string head = "\xED\xA1\xDA\x01";
    head.append(16, '\0');
    for (const std::uint32_t length : {channel, data})
      for (int shift = 24; shift >= 0; shift -= 8) head += static_cast<char>(length >> shift);
    std::ofstream(path, std::ios::binary) << head;
    std::filesystem::resize_file(path, std::uintmax_t{3} << 30);  // a hole, which takes no disk
    testing::internal::CaptureStderr();
    const std::string message = message_of(path);
    return message + testing::internal::GetCapturedStderr();
  };
  const std::string refused = path + ": is not an LCM event log";
  EXPECT_EQ(log_of(0, 8), refused);
  EXPECT_EQ(log_of(1000, 8), refused);
  EXPECT_EQ(log_of(0x80000000, 8), refused);
  EXPECT_EQ(log_of(1, 0x80000001), refused);
  EXPECT_EQ(log_of(1, (1u << 28) + 1), refused);
}

TEST(LcmTraceReader, ALogThatGrowsWhileItIsReadIsReadToItsEnd) {
  const Directory directory;
  const std::string path = directory.file("run.lcm");
  write_log(path, kIdentity, sample_rows(10, 3));
  const std::string bytes = content(path);
  std::ofstream(path, std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  LcmTraceReader reader(path);
  ASSERT_TRUE(reader.next());
  std::ofstream(path, std::ios::binary | std::ios::app) << bytes.substr(bytes.size() / 2);
  int rows = 1;
  while (reader.next()) ++rows;
  EXPECT_EQ(rows, 10);
  EXPECT_EQ(reader.remark(), "");
}

/// A log of so many headers, each on a channel of its own, and then a row on the last of them. Half of the
/// headers are none.
void write_headers(const std::string& path, std::size_t headers) {
  LcmEncoder encoder(kIdentity, sample_signals());
  const std::span<const std::uint8_t> bytes = encoder.header();
  const std::vector<std::uint8_t> header(bytes.begin(), bytes.end());
  const auto row = encoder.row({0, 0, 0, sample_rows(1, 3)[0]});
  lcm_eventlog_t* const log = lcm_eventlog_create(path.c_str(), "w");
  const auto write = [&](std::string channel, std::span<const std::uint8_t> data) {
    lcm_eventlog_event_t event{};
    event.channellen = static_cast<std::int32_t>(channel.size());
    event.channel = channel.data();
    event.datalen = static_cast<std::int32_t>(data.size());
    event.data = const_cast<std::uint8_t*>(data.data());
    ASSERT_EQ(lcm_eventlog_write_event(log, &event), 0);
  };
  for (std::size_t i = 0; i < headers; ++i) {
    write("C" + std::to_string(i) + "_HEADER", header);
    write("F" + std::to_string(i) + "_HEADER", std::span(header).first(i % 9));
  }
  write("C" + std::to_string(headers - 1), row);
  lcm_eventlog_destroy(log);
}

TEST(LcmTraceReader, ALogOfManyHeadersTakesStepsAsItsLengthDoesAndFindsItsTrace) {
  const Directory directory;
  const std::string path = directory.file("many.lcm");
  for (const std::size_t headers : {100u, 6000u}) {
    write_headers(path, headers);
    LcmTraceReader reader(path);
    EXPECT_TRUE(reader.next()) << "the one that has rows, though it is the last";
    EXPECT_FALSE(reader.next());
    EXPECT_LT(reader.comparisons(), headers * 128) << "a few look-ups of 13 steps for each of two events";
  }
}

TEST(LcmTraceReader, TellsAFewChannelsOfManyAndNothingThatATerminalObeys) {
  const Directory directory;
  const std::string path = directory.file("many.lcm");
  write_headers(path, 500);
  const std::string told = message_of(path, "other\x1b[2J");
  EXPECT_NE(told.find("holds no trace on channel other?[2J; it holds: C0, C1, "), std::string::npos) << told;
  EXPECT_TRUE(told.ends_with("C23, …")) << told;
}

TEST(LcmTraceReader, RowsThatTheRunDroppedAreRemarked) {
  const Directory directory;
  {
    LcmLog log(directory.file("run.lcm"), kIdentity);
    log.begin({});
    log.row({0, 0, 0, {}});
    log.row({kPeriod, 1, 4, {}});
    log.end();
  }
  EXPECT_EQ(read_lcm_trace(directory.file("run.lcm")).remark, "4 rows were dropped by the run");
}

TEST(LcmTraceReader, WhatIsNoTraceIsRefusedWithTheReason) {
  const Directory directory;
  const std::string path = directory.file("run.lcm");
  EXPECT_EQ(message_of(path), path + ": No such file or directory");
  EXPECT_EQ(message_of("/"), "/: Is a directory");
  std::ofstream(path) << "t,a\n0,1\n";
  EXPECT_EQ(message_of(path), path + ": is not an LCM event log");
  write_log(path, kIdentity, sample_rows(1, 3));
  EXPECT_EQ(message_of(path, "CUTTER"), path + ": holds no trace on channel CUTTER; it holds: KNIFE");
  EXPECT_EQ(message_of(path, "KNIFE"), "no error");
}

TEST(LcmTraceReader, ADamagedMessageIsNamedByItsEvent) {
  const Directory directory;
  const std::string path = directory.file("run.lcm");
  lcm_eventlog_t* log = lcm_eventlog_create(path.c_str(), "w");
  ASSERT_NE(log, nullptr);
  LcmEncoder encoder(kIdentity, sample_signals());
  const auto rows = sample_rows(1, 3);
  const auto write = [log](std::string channel, std::span<const std::uint8_t> bytes) {
    std::vector<std::uint8_t> data(bytes.begin(), bytes.end());
    lcm_eventlog_event_t event{};
    event.channel = channel.data();
    event.channellen = static_cast<std::int32_t>(channel.size());
    event.data = data.data();
    event.datalen = static_cast<std::int32_t>(data.size());
    EXPECT_EQ(lcm_eventlog_write_event(log, &event), 0);
  };
  write("OTHER", std::vector<std::uint8_t>(3));  // other traffic on the network is passed over
  write("KNIFE_HEADER", encoder.header());
  write("KNIFE", encoder.row({0, 0, 0, rows[0]}));
  write("KNIFE", encoder.row({0, 0, 0, rows[0]}).first(60));
  lcm_eventlog_destroy(log);
  EXPECT_EQ(message_of(path), path + ": event 3: a damaged message on channel KNIFE");
}

}  // namespace
}  // namespace lockstep::lcm_log_test
