// lockstep doctor: its measuring, its verdict, its words.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "cli/doctor/lateness.hpp"
#include "cli/doctor/report.hpp"
#include "tests/cli/command_run.hpp"

namespace lockstep::cli::doctor_test {
namespace {

using nlohmann::json;

constexpr RealTimeRights kAll{.priority = true, .memory = true};

/// A machine on which nothing is left to be done.
SystemFacts ready() {
  return {.kernel = "6.1.0-18-rt-amd64",
          .preemption = Preemption::real_time,
          .preemption_now = "",
          .processors = "0-3",
          .isolated = "3",
          .governors = {"performance"},
          .priority_limit = 80,
          .memory_limit = -1};
}

Findings found(std::int64_t worst, std::int64_t servo_cycle, RealTimeRights rights = kAll,
               const SystemFacts& facts = ready()) {
  Findings findings;
  findings.servo_cycle = servo_cycle;
  findings.duration = 10'000'000'000;
  findings.processor = 3;
  findings.wakeups = 10'000;
  findings.median = 3'000;
  findings.one_percent = 9'000;
  findings.rarest = 41'000;
  findings.worst = worst;
  findings.facts = facts;
  findings.rights = rights;
  findings.verdict = judge(worst, servo_cycle, rights);
  findings.advice = advise(facts, rights, 3);
  return findings;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::vector<std::string> keys(const std::vector<Advice>& advice) {
  std::vector<std::string> all;
  for (const Advice& one : advice) all.push_back(one.key);
  return all;
}

TEST(Doctor, HoldsACycleThatIsThreeTimesTheWorstLatenessAndNoShorterOne) {
  EXPECT_TRUE(judge(333'333, 1'000'000, kAll).holds);
  EXPECT_FALSE(judge(333'334, 1'000'000, kAll).holds);
  EXPECT_EQ(judge(333'333, 1'000'000, kAll).shortest, 1'000'000);
  EXPECT_EQ(judge(333'334, 1'000'000, kAll).shortest, 2'000'000);
  EXPECT_EQ(judge(0, 1'000'000, kAll).shortest, 125'000);
  EXPECT_EQ(judge(20'000'000, 1'000'000, kAll).shortest, 0);
}

TEST(Doctor, HoldsNothingWithoutRealTimePriority) {
  const Verdict verdict = judge(10'000, 1'000'000, {.priority = false, .memory = true});
  EXPECT_TRUE(verdict.fits);
  EXPECT_FALSE(verdict.holds);
}

TEST(Doctor, SaysWhatAMachineHolds) {
  const std::string good = report_text(found(84'000, 1'000'000));
  EXPECT_TRUE(has(good, "10000 wake-ups in 10 s, every 1 ms, on processor 3\n")) << good;
  EXPECT_TRUE(has(good, "late by: median 3 µs, 99 % within 9 µs, 99.99 % within 41 µs, worst 84 µs\n"))
      << good;
  EXPECT_TRUE(has(good, "This machine holds a servo_cycle of 1 ms.\nThe shortest that it holds is 500 µs.\n"))
      << good;
  EXPECT_TRUE(has(good, "Nothing is left")) << good;
  const std::string just = report_text(found(300'000, 1'000'000));
  EXPECT_TRUE(has(just, "This machine holds a servo_cycle of 1 ms, and no shorter one.\n")) << just;
  const std::string late = report_text(found(700'000, 1'000'000));
  EXPECT_TRUE(has(late,
                  "This machine does not hold a servo_cycle of 1 ms.\n"
                  "The shortest that fits what was measured is 4 ms.\n"))
      << late;
  const std::string worse = report_text(found(50'000'000, 1'000'000));
  EXPECT_TRUE(has(worse, "It holds none that is usual.\n")) << worse;
  const std::string alone = report_text(found(10'000, 1'000'000, {.priority = false, .memory = true}));
  EXPECT_TRUE(has(alone, "without real-time priority any other process may delay a tick")) << alone;
}

TEST(Doctor, AdvisesWhatIsMissingEachWithACommand) {
  EXPECT_TRUE(advise(ready(), kAll, 3).empty());
  SystemFacts facts = ready();
  facts.preemption = Preemption::dynamic;
  facts.isolated = "";
  facts.governors = {"performance", "powersave"};
  const std::vector<Advice> all = advise(facts, {}, -1);
  EXPECT_EQ(keys(all),
            (std::vector<std::string>{"priority", "memory", "kernel", "preempt", "isolation", "governor"}));
  for (const Advice& one : all) EXPECT_FALSE(one.command.empty()) << one.key;
  const std::string text = report_text(found(84'000, 1'000'000, {}, facts));
  for (const char* part : {"rtprio 80", "memlock unlimited", "linux-image-rt-", "preempt=full", "isolcpus=3 ",
                           "echo performance", "lockstep run --cpu 3"})
    EXPECT_TRUE(has(text, part)) << part << "\n" << text;
}

TEST(Doctor, AdvisesNothingThatTheMachineHasOrCannotHave) {
  SystemFacts facts = ready();
  EXPECT_EQ(keys(advise(facts, kAll, -1)), std::vector<std::string>{"processor"})
      << "3 is isolated, not used";
  facts.isolated = "";
  facts.processors = "0";
  EXPECT_TRUE(advise(facts, kAll, -1).empty()) << "a single processor cannot be isolated";
  facts.governors = {};
  EXPECT_TRUE(advise(facts, kAll, -1).empty()) << "nothing is told of its frequency";
  facts.preemption = Preemption::dynamic;
  facts.preemption_now = "full";
  EXPECT_EQ(keys(advise(facts, kAll, -1)), std::vector<std::string>{"kernel"});
}

TEST(Doctor, GivesProgramsTheSameAsJson) {
  SystemFacts facts = ready();
  facts.preemption = Preemption::none;
  const json report = json::parse(report_json(found(700'000, 1'000'000, kAll, facts)));
  EXPECT_EQ(report["servo_cycle_ns"], 1'000'000);
  EXPECT_EQ(report["holds"], false);
  EXPECT_EQ(report["shortest_ns"], 4'000'000);
  EXPECT_EQ(report["measured"]["lateness_ns"]["worst"], 700'000);
  EXPECT_EQ(report["measured"]["processor"], 3);
  EXPECT_EQ(report["system"]["isolated"], "3");
  EXPECT_EQ(report["advice"][0]["key"], "kernel");
  EXPECT_TRUE(json::parse(report_json(found(50'000'000, 1'000'000)))["shortest_ns"].is_null());
}

/// A clock whose sleeper is as late as a list says, by turns.
class LateClock final : public WaitingClock {
 public:
  explicit LateClock(std::vector<std::int64_t> late) : late_(std::move(late)) {}

  std::int64_t now() noexcept override { return time_; }
  void sleep_until(std::int64_t due) noexcept override {
    early_ = early_ || due < time_;
    time_ = std::max(time_, due) + late_[next_++ % late_.size()];
  }
  bool was_early() const { return early_; }

 private:
  std::vector<std::int64_t> late_;
  std::size_t next_ = 0;
  std::int64_t time_ = 1'000'000'000;
  bool early_ = false;
};

TEST(Doctor, MeasuresEachWakeUpAndLeavesOutCyclesThatHavePassed) {
  LateClock clock({2'000, 2'000, 5'500, 2'000, 3'200'000, 2'000, 2'000, 2'000, 2'000, 2'000});
  Lateness lateness;
  measure(clock, 1'000'000, 100'000'000, lateness);
  EXPECT_FALSE(clock.was_early());
  EXPECT_EQ(lateness.worst(), 3'200'000);
  EXPECT_EQ(lateness.quantile(0.5), 2'000);
  EXPECT_EQ(lateness.quantile(0.85), 6'000) << "rounded up";
  EXPECT_EQ(lateness.quantile(1.0), 3'200'000);
  EXPECT_GT(lateness.count(), 70u);
  EXPECT_LT(lateness.count(), 80u) << "three of thirteen cycles have passed";
}

TEST(Doctor, KnowsOfLatenessBeyondItsBucketsTheWorst) {
  Lateness lateness;
  EXPECT_EQ(lateness.quantile(0.5), 0);
  lateness.add(-5);
  lateness.add(5'000'000'000);
  EXPECT_EQ(lateness.quantile(0.5), 0);
  EXPECT_EQ(lateness.quantile(0.99), 5'000'000'000);
}

TEST(DoctorFacts, AreReadFromTheSystem) {
  const Directory root;
  const auto write = [&](const std::string& path, const std::string& text) {
    const std::string file = root.file(path);
    std::filesystem::create_directories(std::filesystem::path(file).parent_path());
    std::ofstream(file) << text << "\n";
  };
  const std::string processors = "sys/devices/system/cpu/";
  write(processors + "online", "0-7");
  write(processors + "isolated", "2,5-7");
  write(processors + "cpu0/cpufreq/scaling_governor", "powersave");
  write(processors + "cpu1/cpufreq/scaling_governor", "performance");
  write(processors + "cpu2/cpufreq/scaling_governor", "powersave");
  write("sys/kernel/realtime", "1");
  const SystemFacts facts = read_system_facts(root.file(""));
  EXPECT_EQ(facts.processors, "0-7");
  EXPECT_EQ(count_in_list(facts.processors), 8);
  EXPECT_EQ(facts.isolated, "2,5-7");
  EXPECT_TRUE(is_in_list(6, facts.isolated));
  EXPECT_FALSE(is_in_list(3, facts.isolated));
  EXPECT_EQ(highest_in_list(facts.isolated), 7);
  EXPECT_EQ(facts.governors, (std::vector<std::string>{"performance", "powersave"}));
  EXPECT_EQ(facts.preemption, Preemption::real_time);
  const SystemFacts nothing = read_system_facts(root.file("nowhere"));
  EXPECT_EQ(nothing.processors, "");
  EXPECT_EQ(highest_in_list(nothing.processors), -1);
}

TEST(DoctorFacts, AreALineOfARun) {
  SystemFacts facts = ready();
  EXPECT_EQ(system_text(facts, kAll, 3),
            "the system gives priority 80, locked memory, processor 3, isolated, kernel 6.1.0-18-rt-amd64 "
            "PREEMPT_RT");
  facts.isolated = "";
  facts.preemption = Preemption::dynamic;
  facts.preemption_now = "voluntary";
  EXPECT_EQ(system_text(facts, {}, -1),
            "the system gives no real-time priority, no locked memory, no processor isolated, kernel "
            "6.1.0-18-rt-amd64 PREEMPT_DYNAMIC (voluntary); lockstep doctor tells what helps");
}

TEST(DoctorCommand, MeasuresThisMachine) {
  const Ended ended = lockstep({"doctor", "--duration", "100ms", "--servo-cycle", "2ms", "--json"});
  const json report = json::parse(ended.out, nullptr, false);
  ASSERT_TRUE(report.is_object()) << ended.out << ended.err;
  EXPECT_EQ(report["servo_cycle_ns"], 2'000'000);
  EXPECT_GT(report["measured"]["wakeups"], 0);
  EXPECT_EQ(ended.status, report["holds"] == true ? 0 : 1);
  EXPECT_EQ(ended.err, "");
}

TEST(DoctorCommand, TakesTheServoCycleOfAProject) {
  const Directory folder;
  const std::string project =
      folder.write("project.json", R"({ "lockstep": 1, "name": "slow", "clock": { "servo_cycle": "4ms" } })");
  const Ended ended = lockstep({"doctor", project, "--duration", "20ms"});
  EXPECT_TRUE(has(ended.out, "every 4 ms")) << ended.out << ended.err;
  EXPECT_TRUE(has(ended.out, "a servo_cycle of 4 ms")) << ended.out;
}

TEST(DoctorCommand, EndsWith2WhereItCannotMeasure) {
  EXPECT_EQ(lockstep({"doctor", "/nowhere/project.json"}).status, 2);
  EXPECT_EQ(lockstep({"doctor", "--duration", "soon"}).status, 2);
  EXPECT_EQ(lockstep({"doctor", "--duration", "0s"}).status, 2);
  EXPECT_EQ(lockstep({"doctor", "--servo-cycle", "2min"}).status, 2);
  const Ended absent = lockstep({"doctor", "--cpu", "100000"});
  EXPECT_EQ(absent.status, 2);
  EXPECT_TRUE(has(absent.err, "--cpu: processor 100000")) << absent.err;
}

}  // namespace
}  // namespace lockstep::cli::doctor_test
