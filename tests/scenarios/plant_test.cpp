// Controllers in processes of their own, each in a network of its own, on a wire that takes time and loses
// telegrams: what follows on one of them stays together with what leads on another.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include "tests/projects/system_files.hpp"
#include "tests/scenarios/csv_table.hpp"
#include "tests/scenarios/lockstep_process.hpp"
#include "tests/support/seeds.hpp"
#include "tests/support/virtual_wire.hpp"

namespace lockstep::test::plant_test {
namespace {

constexpr double kRing = 360.0;           // [u]
constexpr double kVelocity = 500.0;       // [u/s]
constexpr double kAcceleration = 4000.0;  // [u/s²]
constexpr double kJerk = 80000.0;         // [u/s³]

void limit(SystemJson& axis) {
  axis["config"]["DynamicLimits"] = {{"MaxVelocity", 5000.0},
                                     {"Velocity", 5000.0},
                                     {"MaxAcceleration", 1e5},
                                     {"MaxDeceleration", 1e5},
                                     {"MaxJerk", 1e6}};
}

/// An axis that follows another one, or a proxy as soon as that leads.
void follow(ControllerFile& file, const std::string& axis, const std::string& leading, bool proxy,
            const std::string& coupling = "setpoint") {
  SystemJson& made = file.axis(axis, kRing);
  limit(made);
  made["config"]["Synchronization"]["MasterReversionTolerance"] = 1000.0;
  file.interconnect(axis, leading, coupling);
  file.call(
      {{"fb", "MC_GearIn"},
       {"name", "gear_" + axis},
       {"in",
        {{"Master", leading},
         {"Slave", axis},
         {"Execute", "power_" + axis + ".Status" + (proxy ? " AND " + leading + ".StatusWord.X4" : "")}}}});
}

/// Counts what becomes of the telegrams of a proxy.
void count(ControllerFile& file, const std::string& proxy) {
  for (const char* const kind : {"received", "missing", "late", "foreign", "malformed", "stale"}) {
    const std::string tag = proxy + "_" + kind;
    file.json["tags"][tag]["type"] = "ULINT";
    file.json["technology_objects"][proxy]["telegrams"][kind] = tag;
  }
}

void record(ControllerFile& file, const std::vector<std::string>& signals) {
  for (const std::string& signal : signals) file.json["trace"]["signals"].push_back(signal);
}

/// The leading axis goes to and fro, with jerk.
ControllerFile source() {
  ControllerFile file("source");
  limit(file.axis("Conveyor", kRing));
  file.provide("Conveyor", 0.004);
  follow(file, "Near", "Conveyor", false, "delayed");
  file.json["tags"]["k"]["type"] = "DINT";
  file.call({{"set", "k"}, {"to", "k + 1"}});
  for (const int direction : {1, -1})
    file.call({{"fb", "MC_MoveVelocity"},
               {"name", direction > 0 ? "forward" : "back"},
               {"in",
                {{"Axis", "Conveyor"},
                 {"Execute", std::string("power_Conveyor.Status AND k > 2500 AND (k MOD 2000) ") +
                                 (direction > 0 ? "< 1000" : ">= 1000")},
                 {"Velocity", direction * kVelocity},
                 {"Acceleration", kAcceleration},
                 {"Deceleration", kAcceleration},
                 {"Jerk", kJerk}}}});
  record(file, {"Conveyor.StatusProvidedLeadingValue.DelayedLeadingValue.Position", "Near.Position"});
  return file;
}

/// Passes what it gets on to another one.
ControllerFile middle() {
  ControllerFile file("middle");
  file.proxy("Line", 0.5, 0.002);
  count(file, "Line");
  follow(file, "Draw", "Line", true);
  file.provide("Draw", 0.002);
  follow(file, "Press", "Line", true, "delayed");
  record(file, {"Line.Position", "Line.StatusExternalLeadingValue.AdjustmentTime", "Press.Position",
                "Draw.StatusProvidedLeadingValue.DelayedLeadingValue.Position", "Line_received",
                "Line_missing", "Line_late", "Line_foreign", "Line_malformed", "Line_stale"});
  return file;
}

ControllerFile last() {
  ControllerFile file("last");
  for (const char* const proxy : {"Line", "Web"}) {
    file.proxy(proxy, 0.5);
    count(file, proxy);
    for (const char* const kind : {"received", "missing", "late", "foreign", "malformed", "stale"})
      record(file, {std::string(proxy) + "_" + kind});
    record(file, {std::string(proxy) + ".Position",
                  std::string(proxy) + ".StatusExternalLeadingValue.AdjustmentTime"});
  }
  follow(file, "Stacker", "Line", true);
  follow(file, "Reel", "Web", true);
  record(file, {"Stacker.Position", "Reel.Position"});
  return file;
}

SystemFiles three() {
  SystemFiles files;
  files.add("PLC_1", source());
  files.add("PLC_2", middle());
  files.add("PLC_3", last());
  files.area("line", "PLC_1.Conveyor", {"PLC_2.Line", "PLC_3.Line"});
  files.area("draw", "PLC_2.Draw", {"PLC_3.Web"});
  files.json["network"]["lcm"] = "udpm://239.255.76.67:7667?ttl=1";
  for (int i = 1; i <= 3; ++i)
    files.json["controllers"]["PLC_" + std::to_string(i)]["address"] = "10.7.0." + std::to_string(i);
  return files;
}

/// What a process has recorded, by milliseconds of the clock that all share.
class Recorded {
 public:
  Recorded(const std::string& trace, const std::string& messages) : table_(read_csv(trace)) {
    std::smatch match;
    EXPECT_TRUE(std::regex_search(messages, match, std::regex("time 0 is ([0-9]+) ns of CLOCK_MONOTONIC")))
        << messages;
    if (match.empty()) return;
    start_ = std::stoll(match[1]);
    EXPECT_EQ(start_ % 1'000'000, 0) << "ticks begin at whole cycles of the clock";
    const std::vector<double>& t = table_["t"];
    for (std::size_t i = 0; i < t.size(); ++i)
      rows_[std::llround((static_cast<double>(start_) + t[i] * 1e9) * 1e-6)] = i;
  }
  const std::map<std::int64_t, std::size_t>& rows() const { return rows_; }
  const std::vector<double>& operator[](const std::string& name) { return table_[name]; }
  double last(const std::string& name) { return table_[name].back(); }

 private:
  CsvTable table_;
  std::int64_t start_ = 0;
  std::map<std::int64_t, std::size_t> rows_;
};

struct Signal {
  Recorded& of;
  std::string name;
};

/// The largest distance of two signals on the ring, one `later` [ms] than the other, from `from` [s] of the
/// second one on.
double largest_deviation(Signal a, Signal b, std::int64_t later, double from) {
  const std::vector<double>& va = a.of[a.name];
  const std::vector<double>& vb = b.of[b.name];
  const std::vector<double>& t = b.of["t"];
  double largest = 0.0;
  std::size_t compared = 0;
  for (const auto& [time, row] : b.of.rows()) {
    const auto other = a.of.rows().find(time + later);
    if (other == a.of.rows().end() || t[row] < from) continue;
    largest = std::max(largest, std::abs(std::remainder(va[other->second] - vb[row], kRing)));
    ++compared;
  }
  EXPECT_GT(compared, 500u) << a.name << ", " << b.name;
  return largest;
}

/// What extrapolation by that long may be wrong by, and what is left of that on the way back.
/// @param time [s]
double extrapolation_bound(double time) {
  return 0.5 * kAcceleration * time * time + kJerk * time * time * time;
}

struct Adjustments {
  double least = INFINITY, most = -INFINITY;  // [s]
};
Adjustments adjustments(Recorded& of, const std::string& proxy, double from) {
  const std::vector<double>& t = of["t"];
  const std::vector<double>& time = of[proxy + ".StatusExternalLeadingValue.AdjustmentTime"];
  Adjustments found;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] < from) continue;
    found.least = std::min(found.least, time[i]);
    found.most = std::max(found.most, time[i]);
  }
  return found;
}

/// For how long a process has had no tick within a tenth of a second, at worst [s]: its axes stood still in
/// that time, and what looks ahead of what it tells goes on.
double longest_stall(Recorded& of, double from) {
  const std::vector<double>& t = of["t"];
  double longest = 0.0;
  for (std::size_t i = 1, begin = 1; i < t.size(); ++i) {
    while (t[i] - t[begin - 1] > 0.1 && begin < i) ++begin;
    if (t[begin - 1] >= from)
      longest = std::max(longest, t[i] - t[begin - 1] - 0.001 * static_cast<double>(i + 1 - begin));
  }
  return longest;
}

/// Nothing steps: from row to row no further than the velocity takes it, ticks that were missed included.
/// @param beside by how much it may have been beside its path, to which it goes back in eight cycles at least
/// [u]
void expect_no_step(Recorded& of, const std::string& name, double from, double beside) {
  const double velocity = 1.5 * kVelocity + 2.0 * beside / 0.008;
  const std::vector<double>& t = of["t"];
  const std::vector<double>& position = of[name];
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (t[i - 1] < from) continue;
    const double moved = std::abs(std::remainder(position[i] - position[i - 1], kRing));
    ASSERT_LE(moved, velocity * (t[i] - t[i - 1]) + 1e-6) << name << " at " << t[i] << " s";
  }
}

// Ten minutes in a soak; here a hundredth.
TEST(Plant, OfThreeControllersOnABadNetworkStaysTogether) {
  const int seconds = cases(8, 600);
  in_own_network(
      [seconds] {
        const VirtualPlant plant(3, {});
        ASSERT_FALSE(HasFailure());
        const SystemFiles files = three();
        const std::string system = files.path();
        const std::string trace = files.directory().file("t.csv");
        std::vector<std::unique_ptr<Process>> processes;
        for (std::size_t i = 0; i < 3; ++i)
          processes.push_back(std::make_unique<Process>(
              plant.on(i, lockstep_command({"run", system, "--controller", "PLC_" + std::to_string(i + 1),
                                            "--trace", trace, "--duration", std::to_string(seconds) + "s",
                                            "--fail-on", "alarm,job"}))));
        const auto all_ended = [&] {
          return std::ranges::none_of(processes, [](auto& process) { return process->running(); });
        };
        ASSERT_TRUE(wait_until(all_ended, std::chrono::seconds(seconds) + kDeadline));
        for (auto& process : processes) EXPECT_EQ(process->status(), 0) << process->err();
        ASSERT_FALSE(HasFailure());

        const auto of = [&](int number) {
          return Recorded(files.directory().file("t.PLC_" + std::to_string(number) + ".csv"),
                          processes[static_cast<std::size_t>(number - 1)]->err());
        };
        Recorded first = of(1), second = of(2), third = of(3);
        constexpr double kFrom = 0.7;  // [s] when all of them lead, and the conveyor stands yet
        const char* const source = "Conveyor.StatusProvidedLeadingValue.DelayedLeadingValue.Position";
        struct Way {
          const char* text;
          Recorded* of;
          std::string proxy;
          Signal source;
          std::int64_t later;  // [ms] by which the source shows its value
        };
        const Way ways[] = {{"PLC_2.Line", &second, "Line", {first, source}, 2},
                            {"PLC_3.Line", &third, "Line", {first, source}, 0},
                            {"PLC_3.Web",
                             &third,
                             "Web",
                             {second, "Draw.StatusProvidedLeadingValue.DelayedLeadingValue.Position"},
                             0}};
        const double stalled = std::max(
            {longest_stall(first, kFrom), longest_stall(second, kFrom), longest_stall(third, kFrom)});
        // How far the copies lie beside their sources says something of the product only where all had their
        // ticks.
        const bool judged = stalled < 0.002;
        double largest = 0.0;
        std::printf("%d s at 1 ms, 200 ± 50 µs and 0.1 %% loss by %s; without a tick for up to %.1f ms%s:\n",
                    seconds, plant.carrier().c_str(), stalled * 1e3,
                    judged ? "" : ", so deviations are not judged");
        for (const Way& way : ways) {
          const Adjustments adjusted = adjustments(*way.of, way.proxy, kFrom);
          const double deviation =
              largest_deviation(way.source, {*way.of, way.proxy + ".Position"}, way.later, kFrom);
          std::printf(
              "  %-10s  %.0f telegrams, %.0f missing, %.0f late; AdjustmentTime %.3f … %.3f ms; largest "
              "deviation %.3g u\n",
              way.text, way.of->last(way.proxy + "_received"), way.of->last(way.proxy + "_missing"),
              way.of->last(way.proxy + "_late"), adjusted.least * 1e3, adjusted.most * 1e3, deviation);
          const double bound = 1e-9 + extrapolation_bound(std::max(adjusted.most, 0.0)) +
                               (adjusted.most > 0.0 ? 2.0 * kVelocity * stalled : 0.0);
          if (judged) {
            EXPECT_LE(deviation, bound) << way.text;
          }
          for (const char* const kind : {"_foreign", "_malformed", "_stale"})
            EXPECT_EQ(way.of->last(way.proxy + kind), 0.0) << way.text << kind;
          if (judged) expect_no_step(*way.of, way.proxy + ".Position", kFrom, bound);
          largest = std::max(largest, bound);
        }
        std::fflush(stdout);
        for (const char* const axis : {"Stacker.Position", "Reel.Position"})
          if (judged) expect_no_step(third, axis, kFrom, largest);
        if (plant.wire() != nullptr) {
          EXPECT_GT(plant.wire()->lost(), 0u);
        }
      },
      std::chrono::seconds(seconds) + 4 * kDeadline);
}

}  // namespace
}  // namespace lockstep::test::plant_test
