// What pages of the studio cost the tick: ./dev bench studio
#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numeric>
#include <random>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bench/flooded_machine.hpp"
#include "bench/pairs.hpp"
#include "hmi_bridge/studio/server.hpp"
#include "projects/studio/session.hpp"
#include "scheduler/processor.hpp"
#include "tests/hmi_bridge/studio_client.hpp"

namespace lockstep::bench {
namespace {

constexpr char kHelp[] =
    R"(studio_bench [--rounds N] [--ticks N] [--axes N] [--share] [--quick]: pages of the studio and the tick
studio_bench --files [--rows N]: how long a trace of ten signals takes to be read, and windows of it to be cut out

A line shaft of six axes, and machines of 32 and 128 axes in gear (or of N alone), run in ticks of their servo
cycle, as in real time. By turns, of every two cycles one:

  no page          with --studio and nobody who looks; the other one without
  eight pages      four that draw 64 signals each, two that have subscribed and read nothing any more, two
                   that subscribe and unsubscribe at full speed; the other one as without --studio, beside the
                   same pages
  100 signals      one page that sees 100 signals; the other one with a trace of the same signals

And in pairs of so many ticks (--ticks), as flood_bench does it:

  eight elsewhere  the same eight pages, of a machine whose rows come from a thread beside the cycle: what their
                   traffic costs a cycle that records nothing; next to it, without
  eight for one    eight pages that draw; next to it, one that sees the same signals

Shown are medians over many pairs (--rounds): processor time of a tick (CLOCK_THREAD_CPUTIME_ID without what
reading this clock takes), and the ratio with the interval in which the true median lies by 95 %; for the middle
one of the ticks and for their mean. The cycle has the last processor for itself, as with `lockstep run --cpu`;
with --share it shares all with the rest.
)";

struct Plan {
  int rounds = 60;
  int ticks = 150;
  int axes = 0;  ///< of a machine that is measured alone; 0: all machines
  bool share = false;
  bool files = false;
  int rows = 1'000'000;  ///< of a file
};

/// Signals of a machine, by their paths.
std::vector<std::string> paths_of(const Project& project, std::size_t count) {
  std::vector<std::string> paths;
  constexpr const char* kVariables[] = {"Position",
                                        "Velocity",
                                        "Acceleration",
                                        "ActualPosition",
                                        "ActualVelocity",
                                        "StatusWord",
                                        "ErrorWord",
                                        "StatusPositioning.FollowingError",
                                        "StatusPositioning.TargetPosition",
                                        "WarningWord",
                                        "Override.Velocity",
                                        "DynamicLimits.MaxVelocity",
                                        "DynamicLimits.MaxAcceleration",
                                        "DynamicLimits.MaxJerk",
                                        "StatusPositioning.Distance",
                                        "ErrorDetail.Number",
                                        "ErrorDetail.Reaction",
                                        "StatusWord2"};
  for (const char* variable : kVariables)
    for (const auto& object : project.controller->objects) {
      const std::string path = object->name + "." + variable;
      if (paths.size() < count && project.names.find(path).place) paths.push_back(path);
    }
  return paths;
}

std::string subscribing(const std::vector<std::string>& paths) {
  return nlohmann::json{{"type", "subscribe"}, {"id", 1}, {"paths", paths}}.dump();
}

/// A page by a socket alone. What it does ends with it.
class Page {
 public:
  enum class Kind { draws, hangs, floods };

  Page(std::uint16_t port, Kind kind, const std::vector<std::string>& paths)
      : connection_(std::make_unique<test::StudioConnection>(port)) {
    if (connection_->upgrade() != 101) throw std::runtime_error("the studio takes no page");
    connection_->say(R"({"type":"hello"})");
    connection_->say(subscribing(paths));
    if (connection_->hear_text("subscribed").empty())
      throw std::runtime_error("the studio takes no subscription");
    if (kind == Kind::draws) thread_ = std::jthread([this] { draw(); });
    if (kind == Kind::floods)
      thread_ = std::jthread([this, paths](const std::stop_token& end) { flood(end, subscribing(paths)); });
  }
  ~Page() {
    thread_.request_stop();
    connection_->finish();
  }
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;

 private:
  /// Says of each frame that it has been drawn.
  void draw() const {
    for (auto message = connection_->hear(); message.is_there; message = connection_->hear())
      if (message.is_binary)
        connection_->say(
            nlohmann::json{{"type", "ack"}, {"frame", test::DecodedFrame(message.bytes).frame}}.dump());
  }
  void flood(const std::stop_token& end, const std::string& subscribe) const {
    while (!end.stop_requested()) {
      for (int i = 0; i < 20; ++i) {
        connection_->say(R"({"type":"unsubscribe","id":1})");
        connection_->say(subscribe);
      }
      if (connection_->hear_text("subscribed").empty()) return;
    }
  }

  std::unique_ptr<test::StudioConnection> connection_;
  std::jthread thread_;
};

/// A machine with its studio, or without.
class WatchedMachine {
 public:
  WatchedMachine(const std::string& text, int processor)
      : project_(project_of(text)),
        session_(project_, 0),
        server_(options(), session_),
        processor_(processor) {
    project_.controller->apply_stimuli = true;
    if (const std::string problem = server_.start(); !problem.empty()) throw std::runtime_error(problem);
    run(1000);
  }
  ~WatchedMachine() { server_.stop(); }
  WatchedMachine(const WatchedMachine&) = delete;
  WatchedMachine& operator=(const WatchedMachine&) = delete;

  TickTimes run(int ticks) { return run_ticks(*project_.controller, processor_, ticks); }
  /// Ticks with --studio.
  TickTimes watched(int ticks) {
    project_.controller->tap = &session_.tap();
    const TickTimes times = run(ticks);
    project_.controller->tap = nullptr;
    return times;
  }
  /// The same by turns.
  TurnTimes watched_or_not(int ticks) { return by_turns(ticks, nullptr); }
  TurnTimes watched_or_traced(int ticks, std::vector<Signal> signals) {
    TraceRing ring(std::move(signals));
    std::jthread reader([&ring](const std::stop_token& end) {
      while (!end.stop_requested()) {
        ring.pop(ring.readable());
        std::this_thread::sleep_for(std::chrono::milliseconds(16));
      }
    });
    return by_turns(ticks, &ring);
  }
  /// Rows from a thread that shares its processor with the rest, at the pace of the cycle, as long as the
  /// result is there. Nothing else runs this machine meanwhile.
  std::jthread told_elsewhere() {
    return std::jthread([this](const std::stop_token& end) {
      SignalTap& tap = session_.tap();
      const std::int64_t cycle = project_.controller->clock.interpolator_cycle();
      auto due = std::chrono::steady_clock::now();
      while (!end.stop_requested()) {
        tap.exchange();
        tap.push(elsewhere_ * cycle, static_cast<std::uint64_t>(elsewhere_));
        ++elsewhere_;
        std::this_thread::sleep_until(due += std::chrono::nanoseconds(cycle));
      }
    });
  }
  const Project& project() const { return project_; }
  std::uint16_t port() const { return server_.endpoint().port; }

 private:
  static StudioServerOptions options() {
    StudioServerOptions options;
    options.listen = {"127.0.0.1", 0};
    return options;
  }
  TurnTimes by_turns(int ticks, TraceRing* trace) {
    Controller& controller = *project_.controller;
    const TurnTimes times = run_ticks_by_turns(controller, processor_, ticks, [&](bool with) {
      controller.tap = with ? &session_.tap() : nullptr;
      controller.trace = with ? nullptr : trace;
    });
    controller.tap = nullptr;
    controller.trace = nullptr;
    return times;
  }

  Project project_;
  StudioSession session_;
  StudioServer server_;
  int processor_;
  std::int64_t elsewhere_ = 10'000;  // cycles that have been told elsewhere, behind all of its own
};

void measure(const std::string& name, const std::string& text, int processor, const Plan& plan) {
  WatchedMachine machine(text, processor);
  WatchedMachine other(text, processor);
  const std::vector<std::string> hundred = paths_of(machine.project(), 100);
  const std::vector<std::string> seen(
      hundred.begin(),
      hundred.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(64, hundred.size())));
  std::vector<Signal> signals;
  for (const std::string& path : hundred) signals.push_back(machine.project().names.find(path).place->signal);
  const auto alone = [&] { return machine.run(plan.ticks); };
  using Kinds = std::vector<std::pair<Page::Kind, int>>;
  const auto open = [](const WatchedMachine& seen_one, const Kinds& kinds,
                       const std::vector<std::string>& paths) {
    std::vector<std::unique_ptr<Page>> pages;
    for (const auto& [kind, count] : kinds)
      for (int i = 0; i < count; ++i) pages.push_back(std::make_unique<Page>(seen_one.port(), kind, paths));
    return pages;
  };
  // What they want has been taken.
  const auto opened_and_taken = [&](const Kinds& kinds, const std::vector<std::string>& paths) {
    auto opened = open(machine, kinds, paths);
    machine.watched(50);
    return opened;
  };
  const auto drawing = [&](int count) {
    const auto opened = opened_and_taken({{Page::Kind::draws, count}}, seen);
    return machine.watched(plan.ticks);
  };
  const Kinds mixed = {{Page::Kind::draws, 4}, {Page::Kind::hangs, 2}, {Page::Kind::floods, 2}};
  Company nobody{"no page"};
  Company eight{"eight pages"};
  Company many{"100 signals"};
  Company elsewhere{"eight elsewhere", [&] {
                      const std::jthread rows = other.told_elsewhere();
                      const auto opened = open(other, mixed, seen);
                      machine.run(50);
                      return machine.run(plan.ticks);
                    }};
  Company more{"eight for one", [&] { return drawing(8); }};
  for (int round = 0; round < plan.rounds; ++round) {
    const bool first = round % 2 == 0;
    nobody.add(machine.watched_or_not(plan.ticks));
    {
      const auto opened = opened_and_taken(mixed, seen);
      eight.add(machine.watched_or_not(plan.ticks));
    }
    {
      const auto opened = opened_and_taken({{Page::Kind::draws, 1}}, hundred);
      many.add(machine.watched_or_traced(plan.ticks, signals));
    }
    elsewhere.measure(alone, first);
    more.measure([&] { return drawing(1); }, first);
  }
  std::printf("\n%-18s  %-35s  %s\n%-18s", name.c_str(), "median of the ticks [us]", "mean of the ticks [us]",
              "");
  for (int i = 0; i < 2; ++i) std::printf("  %6s %6s  %-20s", "next", "so", "ratio");
  std::printf("\n");
  for (const Company* const company : {&nobody, &eight, &many, &elsewhere, &more}) print(*company);
  std::printf("pages see %zu signals, the last one %zu\n", seen.size(), hundred.size());
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// A trace of ten signals with a peak in each thousandth row.
void write_trace(const std::string& path, int rows) {
  std::ofstream file(path);
  file << "t,a,b,c,d,e,f,g,h,i,j\n";
  for (int row = 0; row < rows; ++row) {
    file << row / 1000 << '.' << std::to_string(1000 + row % 1000).substr(1);
    for (int column = 0; column < 10; ++column)
      file << ',' << (row % 1000 == 500 ? "100" : std::to_string((row * (column + 3)) % 1009) + "e-3");
    file << '\n';
  }
}

void measure_files(int rows) {
  std::string folder = std::filesystem::temp_directory_path().string() + "/studio_bench_XXXXXX";
  if (::mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no folder for a trace");
  const std::string path = folder + "/trace.csv";
  write_trace(path, rows);
  StudioTraceFiles files;
  const auto begin = std::chrono::steady_clock::now();
  const std::string id = files.add(path, "trace.csv", false)->id;
  while (files.find(id)->state == StudioFileState::loading) {
    files.look([](const StudioTraceFile&) {});
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const double spent = seconds_since(begin);
  const double size = static_cast<double>(std::filesystem::file_size(path)) * 1e-6;
  std::filesystem::remove_all(folder);
  const StudioTraceFile& file = *files.find(id);
  if (file.state != StudioFileState::ready) throw std::runtime_error(file.error);
  const TraceStore& store = file.store;
  const double data = static_cast<double>(store.end() - store.begin()) * (10 + 2) * 8;
  std::printf("CSV of %.1e values, %.0f MB: whole after %.2f s; memory %.2f times its data\n", 10.0 * rows,
              size, spent, static_cast<double>(store.bytes()) / data);
  std::vector<std::size_t> columns(10);
  std::iota(columns.begin(), columns.end(), std::size_t{0});
  std::vector<double> times;
  std::mt19937_64 random(20260714);
  const std::uint64_t count = store.end() - store.begin();
  for (int i = 0; i < 300; ++i) {
    const std::uint64_t length = std::max<std::uint64_t>(count >> (random() % 12), 2000);
    const std::uint64_t first = store.begin() + random() % (count - std::min(length, count) + 1);
    const std::uint64_t behind = std::min(first + length, store.end());
    const auto before = std::chrono::steady_clock::now();
    const TraceWindow window = store.window(columns, first, behind, 1200);
    times.push_back(seconds_since(before) * 1e3);
    // Each peak that lies in it is seen.
    const bool has_peak = behind - first >= 1000;
    const TraceWindow::Column& seen = window.columns[0];
    const auto& highest = seen.maximum.empty() ? seen.first : seen.maximum;
    const bool is_seen =
        std::any_of(highest.begin(), highest.end(), [](Value value) { return value.r == 100.0; });
    if (has_peak && !is_seen) throw std::runtime_error("a window has lost a peak");
  }
  std::sort(times.begin(), times.end());
  std::printf(
      "a window of ten signals, 1200 pixels: median %.2f ms, longest of 300 %.2f ms; each had its peaks\n",
      times[150], times.back());
}

void run(const Plan& plan) {
  if (plan.files) return measure_files(plan.rows);
  int processor = -1;
  if (!plan.share) {
    processor = static_cast<int>(std::thread::hardware_concurrency()) - 1;
    if (const std::string problem = leave_processor(processor); !problem.empty()) {
      std::printf("the cycle shares its processor: %s\n", problem.c_str());
      processor = -1;
    }
  }
  const auto in_gear = [](int axes) {
    return std::pair("gear, " + std::to_string(axes) + " axes", axes_in_gear(axes));
  };
  std::vector<std::pair<std::string, std::string>> machines = {
      {"line shaft, 6 axes", line_shaft()}, in_gear(32), in_gear(128)};
  if (plan.axes > 0) machines = {in_gear(plan.axes)};
  for (const auto& [name, text] : machines) measure(name, text, processor, plan);
}

}  // namespace
}  // namespace lockstep::bench

int main(int argc, char** argv) {
  lockstep::bench::Plan plan;
  for (int i = 1; i < argc; ++i) {
    const bool has_value = i + 1 < argc;
    if (std::strcmp(argv[i], "--quick") == 0)
      plan.rounds = 1, plan.ticks = 50, plan.axes = 6, plan.rows = 10'000;
    else if (std::strcmp(argv[i], "--files") == 0)
      plan.files = true;
    else if (std::strcmp(argv[i], "--rows") == 0 && has_value)
      plan.rows = std::max(5000, std::atoi(argv[++i]));
    else if (std::strcmp(argv[i], "--share") == 0)
      plan.share = true;
    else if (std::strcmp(argv[i], "--rounds") == 0 && has_value)
      plan.rounds = std::max(1, std::atoi(argv[++i]));
    else if (std::strcmp(argv[i], "--ticks") == 0 && has_value)
      plan.ticks = std::max(1, std::atoi(argv[++i]));
    else if (std::strcmp(argv[i], "--axes") == 0 && has_value)
      plan.axes = std::max(1, std::atoi(argv[++i]));
    else
      return std::fputs(lockstep::bench::kHelp, stderr), 2;
  }
  try {
    lockstep::bench::run(plan);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "studio_bench: %s\n", error.what());
    return 1;
  }
}
