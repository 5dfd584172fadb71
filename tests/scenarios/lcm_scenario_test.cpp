// Traces of the rotary knife over LCM, with LCM's own programs as the other side, in a network of its own.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "hmi_bridge/lcm/trace_reader.hpp"
#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::lcm_scenario_test {
namespace {

/// Runs a script in a network in which only loopback is there, able to multicast; as root, or as the root of
/// a user namespace.
int in_own_network(const std::string& script) {
  const std::string network = "ip link set lo up multicast on\nip route add 224.0.0.0/4 dev lo\n";
  const std::string options = ::geteuid() == 0 ? "-n" : "-Urn";
  Process process({"unshare", options, "bash", "-e", "-c", network + script});
  const int status = process.status();
  EXPECT_EQ(status, 0) << "this test needs a network of its own (unshare " << options << ")\n"
                       << script << process.out() << process.err();
  return status;
}

const std::string kLockstep = std::string(LOCKSTEP_PROGRAM) + " run " + example("02_rotary_knife") + " ";
const std::string kUrl = "'udpm://239.255.76.67:7667?ttl=0'";

/// lcm-logger into a file while a command runs. The logger is there when a message of ours is in its file; at
/// the end it gets time to write what it has.
std::string logged(const std::string& file, const std::string& command) {
  return "lcm-logger -q --flush-interval=1 --lcm-url=" + kUrl + " " + file +
         " & logger=$!\n"
         "until [ -e " +
         file + " ]; do sleep 0.02; done\nsleep 0.2\n" + command +
         "\nsleep 0.2\nkill -INT $logger\nwait $logger || true\n";
}

/// Rows of a log by their times, each with the values by name.
using Rows = std::map<std::int64_t, std::map<std::string, double>>;

Rows rows_of(const std::string& path) {
  Rows rows;
  LcmTraceReader reader(path, "ROTARY_KNIFE");
  while (reader.next()) {
    auto& values = rows[reader.row().t];
    for (std::size_t i = 0; i < reader.signals().size(); ++i) {
      const Value value = reader.row().values[i];
      values[reader.signals()[i].name] =
          reader.signals()[i].type == Type::LREAL ? value.r : static_cast<double>(value.u);
    }
  }
  return rows;
}

TEST(LcmScenario, LcmLoggerRecordsTheRunningKnifeAndTheLogShowsItsMotion) {
  const Directory directory;
  const std::string log = directory.file("knife.lcm");
  ASSERT_EQ(in_own_network(logged(log, kLockstep + "--no-modbus --no-retain --stimuli --duration 3500ms")),
            0);
  const Rows rows = rows_of(log);
  // Multicast may lose a row on a busy machine, and the first ones come before the logger listens.
  EXPECT_GT(rows.size(), 100u) << "of 1750";
  double farthest = 0.0;
  std::size_t synchronous = 0;
  std::size_t late = 0;
  std::int64_t phase = 0;
  for (const auto& [time, row] : rows) {
    if (time % 2'000'000 != phase) ++late;
    phase = time % 2'000'000;
    EXPECT_GE(row.at("Conveyor.Position"), 0.0);
    EXPECT_LT(row.at("Conveyor.Position"), 240.0);
    EXPECT_LE(row.at("Conveyor.Velocity"), 200.0 + 1e-9);
    farthest = std::max(farthest, row.at("Conveyor.Position"));
    if (row.at("gear.InSync") == 0.0) continue;
    const double function = 90.0 + 1.5 * (row.at("Conveyor.Position") - 60.0);
    EXPECT_NEAR(ring_distance(row.at("Knife.Position"), function, 360.0), 0.0, 1e-9);
    ++synchronous;
  }
  EXPECT_LT(late, rows.size() / 4)
      << "rows stand an interpolator cycle apart, but for ticks that a busy machine missed";
  EXPECT_GT(farthest, 100.0);
  EXPECT_GT(synchronous, 0u);
}

TEST(LcmScenario, LcmLogplayerReplaysATraceFileToTheNetworkAsItWas) {
  const Directory directory;
  const std::string trace = directory.file("trace.lcm");
  const std::string heard = directory.file("heard.lcm");
  ASSERT_EQ(lockstep({"run", example("02_rotary_knife"), "--simulate", "--duration", "3s", "--trace", trace})
                .status,
            0);
  ASSERT_EQ(in_own_network(logged(heard, "lcm-logplayer --lcm-url=" + kUrl + " " + trace)), 0);
  const Rows written = rows_of(trace);
  const Rows replayed = rows_of(heard);
  ASSERT_EQ(written.size(), 1500u);
  EXPECT_GT(replayed.size(), 100u) << "multicast may lose some";
  for (const auto& [time, row] : replayed) {
    const auto original = written.find(time);
    ASSERT_NE(original, written.end()) << time;
    EXPECT_EQ(row, original->second) << time;
  }
}

TEST(LcmScenario, WithoutAMulticastRouteTheProjectsTraceIsAWarningAndOneAskedForIsAnError) {
  const Directory directory;
  const std::string options = ::geteuid() == 0 ? "-n" : "-Urn";
  const std::string run = kLockstep + "--no-modbus --no-retain --duration 100ms";
  Process project({"unshare", options, "sh", "-c", run});
  EXPECT_EQ(project.status(), 0);
  EXPECT_NE(project.err().find("warning: no traces over LCM: "), std::string::npos) << project.err();
  EXPECT_NE(project.err().find("no multicast route"), std::string::npos) << project.err();
  Process asked({"unshare", options, "sh", "-c", run + " --lcm " + kUrl});
  EXPECT_EQ(asked.status(), 2) << asked.err();
  EXPECT_NE(asked.err().find("no multicast route"), std::string::npos) << asked.err();
}

// The example of LCM.md, compiled beside the product.
TEST(LcmScenario, AForeignSubscriberShowsRowsAndEvents) {
  const Directory directory;
  const std::string out = directory.file("seen");
  const std::string program = LOCKSTEP_PROGRAM;
  const std::string subscriber = program.substr(0, program.rfind('/')) + "/hmi_bridge/lcm_subscriber";
  const std::string script =
      "timeout 30 " + subscriber + " ROTARY_KNIFE 1000 > " + out + " & reader=$!\nsleep 0.5\n" + kLockstep +
      "--no-modbus --no-retain --stimuli --duration 4s\nkill $reader || true\nwait $reader || true\n";
  ASSERT_EQ(in_own_network(script), 0);
  const std::string seen = content(out);
  EXPECT_NE(seen.find("  Knife.Position "), std::string::npos) << seen.substr(0, 2000);
  EXPECT_NE(seen.find("job started: "), std::string::npos) << seen.substr(0, 2000);
}

// ---- A network that takes nothing

/// Runs the knife until the network hangs or fails, asks for the end and prints the exit status. The mark
/// appears whole: seen while it is still empty, it would stand for a network that hangs.
std::string ended_with(const Directory& directory, const std::string& project, const std::string& how) {
  const std::string mark = directory.file("hang");
  return "export LOCKSTEP_HANG=" + mark +
         "\nLD_PRELOAD=" LOCKSTEP_HUNG_NETWORK " ASAN_OPTIONS=verify_asan_link_order=0 " LOCKSTEP_PROGRAM
         " run " +
         project + " --no-modbus --no-retain --stimuli 2>" + directory.file("messages") +
         " & run=$!\n"
         "until grep -q . " +
         directory.file("messages") +
         " || ! kill -0 $run; do sleep 0.02; done\n"
         "sleep 0.2\necho -n " +
         how + " >" + mark + ".new\nmv " + mark + ".new " + mark +
         "\n"
         "until [ -e " +
         mark +
         ".reached ] || ! kill -0 $run; do sleep 0.02; done\n"
         "kill -TERM $run\nwait $run && status=0 || status=$?\necho $status >" +
         directory.file("status") + "\n";
}

/// The knife with a line at its start by which a script sees that it has begun.
std::string knife(const Directory& directory, bool commands) {
  Json json = example_json("02_rotary_knife");
  json["flight_recorder"] = {{"before", "1s"}, {"file", "nowhere/flight"}};
  if (commands) json["trace"]["lcm"]["commands"] = Json::parse(R"({"axes": {"Conveyor": {}}})");
  return directory.write("project.json", json.dump());
}

TEST(LcmNetworkThatHangs, KeepsNoRunFromEnding) {
  const Directory directory;
  const std::string project = knife(directory, false);
  ASSERT_EQ(in_own_network(ended_with(directory, project, "hang")), 0);
  const std::string messages = content(directory.file("messages"));
  EXPECT_EQ(content(directory.file("status")), "3\n") << messages;
  EXPECT_NE(messages.find("the end is not finished in time"), std::string::npos) << messages;
  EXPECT_NE(messages.find(" lost in udpm://239.255.76.67:7667?ttl=0: it takes nothing"), std::string::npos)
      << messages;
}

TEST(LcmNetworkThatHangs, KeepsNoRunThatTakesCommandsFromEnding) {
  const Directory directory;
  const std::string project = knife(directory, true);
  ASSERT_EQ(in_own_network(ended_with(directory, project, "hang")), 0);
  EXPECT_EQ(content(directory.file("status")), "3\n") << content(directory.file("messages"));
}

TEST(LcmNetworkThatFails, IsToldAndHoldsNothingUp) {
  const Directory directory;
  const std::string project = knife(directory, true);
  ASSERT_EQ(in_own_network(ended_with(directory, project, "fail")), 0);
  const std::string messages = content(directory.file("messages"));
  EXPECT_EQ(content(directory.file("status")), "0\n") << messages;
  EXPECT_NE(messages.find("No buffer space available"), std::string::npos) << messages;
}

}  // namespace
}  // namespace lockstep::test::lcm_scenario_test
