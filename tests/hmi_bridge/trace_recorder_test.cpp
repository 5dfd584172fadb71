#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <memory>
#include <stdexcept>

#include "hmi_bridge/lcm/log.hpp"
#include "hmi_bridge/lcm/trace_reader.hpp"
#include "hmi_bridge/traces/csv_reader.hpp"
#include "hmi_bridge/traces/csv_trace.hpp"
#include "hmi_bridge/traces/recorder.hpp"
#include "tests/hmi_bridge/own_network.hpp"
#include "tests/hmi_bridge/trace_samples.hpp"

namespace lockstep::trace_recorder_test {
namespace {

const std::vector<TraceSignal> kSignals = {{"x", Type::LREAL, "u"}, {"n", Type::ULINT, ""}};

std::vector<std::unique_ptr<TraceSink>> sinks(std::unique_ptr<TraceSink> first,
                                              std::unique_ptr<TraceSink> second = nullptr) {
  std::vector<std::unique_ptr<TraceSink>> all;
  all.push_back(std::move(first));
  if (second) all.push_back(std::move(second));
  return all;
}

// A run in virtual time: each row waits for space, so that none is lost on the way to the sinks.
struct Producer {
  LREAL x = 0.0;
  ULINT n = 0;
  TraceRing ring{{{&x, Type::LREAL}, {&n, Type::ULINT}}, 1024};

  void rows(std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i, ++n) {
      x = static_cast<double>(n) / 8.0;
      ring.wait_for_space();
      ring.push(static_cast<std::int64_t>(n) * 1'000'000, n);
    }
  }
};

/// What a sink was asked to do.
struct Heard {
  std::atomic<int> begun{0};
  std::atomic<int> ended{0};
  std::atomic<std::uint64_t> rows{0};
  std::atomic<bool> in_order{true};
  std::atomic<bool> release{true};
};

class Listener final : public TraceSink {
 public:
  explicit Listener(Heard& heard) : heard_(heard) {}
  void begin(std::span<const TraceSignal> signals) override {
    heard_.in_order = heard_.in_order && signals.size() == 2;
    ++heard_.begun;
  }
  void row(const TraceRow& row) override {
    while (!heard_.release) std::this_thread::yield();
    if (row.tick != heard_.rows + row.dropped || heard_.begun != 1 || heard_.ended != 0)
      heard_.in_order = false;
    ++heard_.rows;
  }
  void flush() override {}
  void end() override { ++heard_.ended; }
  std::string_view name() const noexcept override { return "listener"; }

 private:
  Heard& heard_;
};

class Thrower final : public TraceSink {
 public:
  void begin(std::span<const TraceSignal>) override { throw std::runtime_error("no beginning"); }
  void row(const TraceRow&) override { throw 1; }
  void flush() override { throw 2; }
  void end() override { throw std::runtime_error("no end"); }
  std::string_view name() const noexcept override { return "thrower"; }
};

TEST(TraceRecorder, EverySinkGetsEveryRowInOrderAndOneEnd) {
  Producer run;
  Heard one;
  Heard two;
  TraceRecorder recorder(run.ring, kSignals,
                         sinks(std::make_unique<Listener>(one), std::make_unique<Listener>(two)));
  run.rows(5000);
  recorder.stop();
  recorder.stop();
  for (const Heard* heard : {&one, &two}) {
    EXPECT_EQ(heard->rows, 5000u);
    EXPECT_EQ(heard->begun, 1);
    EXPECT_EQ(heard->ended, 1);
    EXPECT_TRUE(heard->in_order);
  }
  EXPECT_TRUE(recorder.losses().empty());
}

/// Writes down what it gets, in its order.
class Diary final : public TraceSink {
 public:
  explicit Diary(std::vector<std::string>& lines) : lines_(lines) {}
  void begin(std::span<const TraceSignal>) override {}
  void row(const TraceRow& row) override { lines_.push_back("row " + std::to_string(row.t)); }
  void event(const TraceEvent& event) override {
    lines_.push_back(std::string(event_kind_text(event.kind)) + " " + event.text + " " +
                     std::to_string(event.t) + " " + std::to_string(event.tick) + " " +
                     std::to_string(event.lost));
  }
  void flush() override {}
  void end() override {}
  std::string_view name() const noexcept override { return "diary"; }

 private:
  std::vector<std::string>& lines_;
};

/// One signal, and what the recorder tells of it and of events.
struct Told {
  std::vector<std::string> lines;
  LREAL x = 0.0;
  TraceRing ring{{{&x, Type::LREAL}}, 16};
  EventQueue queue;
  TraceRecorder recorder{
      ring, {{"x", Type::LREAL, ""}}, sinks(std::make_unique<Diary>(lines)), EventSource{&queue, {}, true}};
};

TraceEvent answer(const std::string& text, std::int64_t t) {
  TraceEvent event;
  event.kind = EventKind::command_accepted;
  event.text = text;
  event.t = t;
  event.tick = static_cast<std::uint64_t>(t);
  return event;
}

TEST(TraceRecorder, WhatTheBridgeTellsStandsAmongTheRowsAndTimeNeverGoesBack) {
  Told run;
  run.recorder.tell(answer("first", 2));
  run.ring.push(1, 1);
  run.queue.push({.kind = EventKind::overrun, .t = 2, .tick = 2});
  run.ring.push(2, 2);
  run.ring.push(3, 3);
  ASSERT_TRUE(wait_until([&] { return run.ring.readable() == 0; }));
  run.recorder.tell(answer("late", 1));
  run.recorder.tell(answer("after all rows", 9));
  run.ring.push(4, 4);
  run.recorder.stop();
  run.recorder.tell(answer("too late", 10));
  EXPECT_EQ(run.lines, (std::vector<std::string>{"row 1", "overrun  2 2 0", "command accepted first 2 2 0",
                                                 "row 2", "row 3", "command accepted late 3 3 0", "row 4",
                                                 "command accepted after all rows 9 9 0"}));
}

TEST(TraceRecorder, WhatTheBridgeTellsStandsBeforeEventsOfLaterTicks) {
  Told run;
  run.recorder.tell(answer("of tick 8", 8));
  run.queue.push({.kind = EventKind::overrun, .t = 10, .tick = 10});
  run.ring.push(10, 10);
  run.recorder.stop();
  EXPECT_EQ(run.lines,
            (std::vector<std::string>{"command accepted of tick 8 8 8 0", "overrun  10 10 0", "row 10"}));
}

TEST(TraceRecorder, WhatTheBridgeTellsBeyondTheRoomForItIsCounted) {
  Told run;
  for (std::size_t i = 0; i < 5 * TraceRecorder::kMaximumTold; ++i) run.recorder.tell(answer("", 7));
  const std::vector<std::string> losses = run.recorder.losses();
  ASSERT_EQ(losses.size(), 1u);
  EXPECT_NE(losses[0].find("list of events incomplete: "), std::string::npos) << losses[0];
  run.recorder.stop();
  EXPECT_LE(run.lines.size(), 2 * TraceRecorder::kMaximumTold);
  EXPECT_GE(run.lines.size(), TraceRecorder::kMaximumTold);
}

TEST(TraceRecorder, ASinkThatThrowsIsReportedAndHoldsNobodyUp) {
  Producer run;
  Heard heard;
  TraceRecorder recorder(run.ring, kSignals,
                         sinks(std::make_unique<Thrower>(), std::make_unique<Listener>(heard)));
  run.rows(100);
  recorder.stop();
  EXPECT_EQ(heard.rows, 100u);
  EXPECT_EQ(recorder.losses(),
            std::vector<std::string>{"trace incomplete: 100 rows lost in thrower: no beginning"});
}

TEST(TraceRecorder, RowsThatFoundTheRingFullAreReported) {
  Producer run;
  Heard heard;
  heard.release = false;
  TraceRecorder recorder(run.ring, kSignals, sinks(std::make_unique<Listener>(heard)));
  std::uint64_t refused = 0;
  for (run.n = 0; run.n < 1100; ++run.n) refused += !run.ring.push(0, run.n);
  heard.release = true;
  recorder.stop();
  EXPECT_EQ(refused, 1100 - run.ring.capacity());
  EXPECT_EQ(heard.rows, run.ring.capacity());
  EXPECT_TRUE(heard.in_order);
  EXPECT_EQ(
      recorder.losses(),
      std::vector<std::string>{"trace incomplete: 76 rows lost in the trace buffer: the recorder could not "
                               "keep up with the run"});
}

TEST(TraceRecorder, VirtualTimeWritesEveryRowToCsvAndLogAlike) {
  const Directory directory;
  Producer run;
  const LcmTraceIdentity identity{"sample", "SAMPLE", 1'000'000, 0};
  TraceRecorder recorder(run.ring, kSignals,
                         sinks(std::make_unique<CsvTrace>(directory.file("run.csv")),
                               std::make_unique<LcmLog>(directory.file("run.lcm"), identity)));
  run.rows(20'000);
  recorder.stop();
  EXPECT_TRUE(recorder.losses().empty());
  const TraceTable csv = read_csv_trace(directory.file("run.csv"));
  const TraceTable log = read_lcm_trace(directory.file("run.lcm"));
  ASSERT_EQ(csv.t.size(), 20'000u);
  EXPECT_EQ(csv.t, log.t);
  EXPECT_EQ(csv.columns, log.columns);
  EXPECT_EQ(log.signals, kSignals);
}

TEST(TraceRecorder, AFullDiskIsReportedWithItsRowsAndTheRunGoesOn) {
  Producer run;
  const LcmTraceIdentity identity{"sample", "SAMPLE", 1'000'000, 0};
  TraceRecorder recorder(
      run.ring, kSignals,
      sinks(std::make_unique<CsvTrace>("/dev/full"), std::make_unique<LcmLog>("/dev/full", identity)));
  run.rows(50'000);
  recorder.stop();
  const std::string text = "trace incomplete: 50000 rows lost in /dev/full: No space left on device";
  EXPECT_EQ(recorder.losses(), (std::vector<std::string>{text, text}));
}

TEST(TraceRecorder, AClosedPipeIsReportedAndNoSignalComes) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  Producer run;
  TraceRecorder recorder(run.ring, kSignals,
                         sinks(std::make_unique<CsvTrace>("/dev/fd/" + std::to_string(ends[1]))));
  ::close(ends[0]);
  ::close(ends[1]);
  run.rows(50'000);
  recorder.stop();
  ASSERT_EQ(recorder.losses().size(), 1u);
  EXPECT_EQ(recorder.losses()[0],
            "trace incomplete: 50000 rows lost in /dev/fd/" + std::to_string(ends[1]) + ": Broken pipe");
}

// The limit of the file's size stands for a disk that fills up: rows reach it in part.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST(TraceRecorder, AFileThatReachesItsLimitEndsWithAWholeRowAndTheRestIsCounted) {
  constexpr std::uint64_t kRows = 50'000;
  const Directory directory;
  Producer run;
  const LcmTraceIdentity identity{"sample", "SAMPLE", 1'000'000, 0};
  std::vector<std::string> losses;
  {
    const FileSizeLimit limit(300'001);
    TraceRecorder recorder(run.ring, kSignals,
                           sinks(std::make_unique<CsvTrace>(directory.file("run.csv")),
                                 std::make_unique<LcmLog>(directory.file("run.lcm"), identity)));
    run.rows(kRows);
    recorder.stop();
    losses = recorder.losses();
  }
  const TraceTable csv = read_csv_trace(directory.file("run.csv"));
  const TraceTable log = read_lcm_trace(directory.file("run.lcm"));
  const auto lost = [](std::size_t rows, const std::string& file) {
    return "trace incomplete: " + std::to_string(rows) + " rows lost in " + file + ": File too large";
  };
  EXPECT_GT(csv.t.size(), 1000u);
  EXPECT_GT(log.t.size(), 1000u);
  EXPECT_EQ(csv.remark, "");
  EXPECT_EQ(log.remark, "");
  EXPECT_EQ(losses, (std::vector<std::string>{lost(kRows - csv.t.size(), directory.file("run.csv")),
                                              lost(kRows - log.t.size(), directory.file("run.lcm"))}));
}

}  // namespace
}  // namespace lockstep::trace_recorder_test
