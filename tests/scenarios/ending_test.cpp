// How a run ends: nothing that was acknowledged is lost, and nothing keeps it from ending.
#include <gtest/gtest.h>
#include <modbus/modbus.h>
#include <sys/ioctl.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <thread>
#include <utility>

#include "hmi_bridge/retain/file.hpp"
#include "tests/hmi_bridge/serial_cable.hpp"
#include "tests/scenarios/modbus_client.hpp"
#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::ending_test {
namespace {

using namespace std::chrono_literals;

/// An axis that needs a tenth of a second to come to rest, a retained tag, and one that grows.
Json machine() {
  Json json = empty_project();
  Json axis = virtual_axis();
  axis["config"]["DynamicLimits"] = {{"MaxDeceleration", 1000.0}, {"MaxAcceleration", 1e5}, {"MaxJerk", 0.0}};
  axis["config"]["DynamicDefaults"] = {
      {"Deceleration", 1000.0}, {"Acceleration", 1e5}, {"Jerk", 0.0}, {"EmergencyDeceleration", 1000.0}};
  json["technology_objects"]["A"] = axis;
  json["tags"] = {{"number", {{"type", "UINT"}, {"retain", true}}}, {"count", {{"type", "UDINT"}}}};
  json["programs"].push_back(
      {{"name", "Main"},
       {"ob", "Main"},
       {"cycle", "1ms"},
       {"calls",
        {assignment("count", "count + 1"), call("MC_Power", "power", {{"Axis", "A"}, {"Enable", true}}),
         call("MC_MoveVelocity", "run",
              {{"Axis", "A"}, {"Execute", "power.Status"}, {"Velocity", 100.0}})}}});
  json["retain"] = {{"interval", "1h"}};
  json["modbus"]["map"] = {
      {{"tag", "number"}, {"table", "holding_register"}, {"address", 0}},
      {{"tag", "A.Velocity"}, {"table", "input_register"}, {"address", 0}, {"type", "REAL"}},
      {{"tag", "count"}, {"table", "input_register"}, {"address", 2}}};
  return json;
}

bool is_moving(const RunningLockstep& run) {
  ModbusClient client(run.port());
  return wait_until([&] { return client.input_float(0) == 100.0F; });
}

std::string kept_number(const std::string& file) {
  const RetainFile kept(file, "small");
  const KeptRow* const row = kept.find("number");
  return row == nullptr ? "none" : row->value;
}

/// Writes 1, 2, 3 … as fast as it is answered, until it is refused or hung up on.
class Hammer {
 public:
  explicit Hammer(modbus_t* library) : library_(library) {
    modbus_set_response_timeout(library_, 5, 0);
    EXPECT_EQ(modbus_connect(library_), 0) << modbus_strerror(errno);
    thread_ = std::thread([this] {
      while (modbus_write_register(library_, 0, static_cast<std::uint16_t>(acknowledged_ + 1)) == 1)
        ++acknowledged_;
    });
  }
  ~Hammer() {
    end();
    modbus_close(library_);
    modbus_free(library_);
  }
  Hammer(const Hammer&) = delete;
  Hammer& operator=(const Hammer&) = delete;

  int acknowledged() const { return acknowledged_; }
  /// The last number that was acknowledged.
  std::string last() {
    end();
    return std::to_string(static_cast<std::uint16_t>(acknowledged_));
  }

 private:
  void end() {
    if (thread_.joinable()) thread_.join();
  }

  modbus_t* const library_;
  std::atomic<int> acknowledged_{0};
  std::thread thread_;
};

TEST(Ending, WhatAModbusClientWasToldToBeWrittenIsKept) {
  const Directory directory;
  const std::string project = directory.write("project.json", machine().dump());
  for (int round = 0; round < 3; ++round) {
    std::filesystem::remove(directory.file("project.retain"));
    RunningLockstep run(project);
    ASSERT_TRUE(is_moving(run));
    Hammer hammer(modbus_new_tcp("127.0.0.1", run.port()));
    ASSERT_TRUE(wait_until([&] { return hammer.acknowledged() > 100; }));
    run.send(SIGTERM);
    EXPECT_EQ(run.status(), 0) << run.err();
    EXPECT_EQ(kept_number(directory.file("project.retain")), hammer.last());
  }
}

TEST(Ending, WhatAClientWasToldToBeWrittenIsKeptAtTheEndOfADurationToo) {
  const Directory directory;
  const std::string project = directory.write("project.json", machine().dump());
  RunningLockstep run(project, {"--duration", "1s"});
  Hammer hammer(modbus_new_tcp("127.0.0.1", run.port()));
  EXPECT_EQ(run.status(), 0) << run.err();
  EXPECT_EQ(kept_number(directory.file("project.retain")), hammer.last());
}

TEST(Ending, WhatAClientOnASerialLineWasToldToBeWrittenIsKept) {
  const Directory directory;
  const SerialCable cable;
  Json json = machine();
  json["modbus"]["server"] = {
      {{"serial", {{"device", cable.left()}, {"baud", 115200}, {"silence", "5ms"}}}, {"unit", 1}}};
  const std::string project = directory.write("project.json", json.dump());
  Process run(lockstep_command({"run", project, "--no-lcm"}));
  ASSERT_TRUE(wait_until([&] { return run.err().find("unit 1") != std::string::npos; })) << run.err();
  modbus_t* const library = modbus_new_rtu(cable.right().c_str(), 115200, 'E', 8, 1);
  modbus_set_slave(library, 1);
  Hammer hammer(library);
  ASSERT_TRUE(wait_until([&] { return hammer.acknowledged() > 10; }));
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 0) << run.err();
  EXPECT_EQ(kept_number(directory.file("project.retain")), hammer.last());
}

// ---- What it shows

TEST(Ending, IsInTheTraceUntilTheAxesAreAtRest) {
  const Directory directory;
  const std::string project = directory.write("project.json", machine().dump());
  const std::string file = directory.file("trace.csv");
  RunningLockstep run(project, {"--trace", file, "--signals", "count,A.Velocity"});
  ASSERT_TRUE(is_moving(run));
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 0) << run.err();
  const CsvTable trace = read_csv(file);
  const std::vector<double>& all = trace["A.Velocity"];
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all.back(), 0.0);
  const auto slower = std::find(all.rbegin(), all.rend(), 100.0).base();
  EXPECT_GT(all.end() - slower, 20) << "a tenth of a second, of which ticks may be missed";
  EXPECT_TRUE(std::is_sorted(slower, all.end(), std::greater<>()));
}

// ---- What does not come to an end

/// A pipe with a reader that does not read.
class UnreadPipe {
 public:
  explicit UnreadPipe(const std::string& path) : path_(path) {
    EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
    reader_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    EXPECT_GT(::fcntl(reader_, F_SETPIPE_SZ, 4096), 0);
  }
  ~UnreadPipe() { ::close(reader_); }
  UnreadPipe(const UnreadPipe&) = delete;
  UnreadPipe& operator=(const UnreadPipe&) = delete;

  const std::string& path() const { return path_; }
  /// Whether nothing has come for a second: a write that does not fit as a whole may leave a part of the page
  /// empty while it waits.
  bool is_full() const {
    int waiting = 0;
    EXPECT_EQ(::ioctl(reader_, FIONREAD, &waiting), 0);
    if (waiting != std::exchange(seen_, waiting)) since_ = Clock::now();
    return waiting > 0 && Clock::now() - since_ > 1s;
  }

 private:
  std::string path_;
  int reader_ = -1;
  mutable int seen_ = 0;                            // [byte] at the last look
  mutable Clock::time_point since_ = Clock::now();  // that many stand there
};

class EndingWithAHungTrace : public testing::TestWithParam<const char*> {};

TEST_P(EndingWithAHungTrace, TakesSecondsTellsWhatIsLostAndKeepsTheValues) {
  const Directory directory;
  const std::string project = directory.write("project.json", machine().dump());
  const UnreadPipe pipe(directory.file(GetParam()));
  RunningLockstep run(project, {"--trace", pipe.path(), "--signals", "count,A.Position"});
  ASSERT_TRUE(is_moving(run));
  ASSERT_TRUE(wait_until([&] { return pipe.is_full(); }));
  ModbusClient(run.port()).write_register(0, 77);
  const auto asked = Clock::now();
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 3) << run.err();
  EXPECT_GT(Clock::now() - asked, 4s) << "it is given some time";
  EXPECT_NE(run.err().find("the end is not finished in time"), std::string::npos) << run.err();
  EXPECT_NE(run.err().find(" lost in " + pipe.path() + ": it takes nothing"), std::string::npos) << run.err();
  EXPECT_EQ(run.err().find("values are not kept"), std::string::npos) << run.err();
  EXPECT_EQ(kept_number(directory.file("project.retain")), "77");
}

INSTANTIATE_TEST_SUITE_P(Files, EndingWithAHungTrace, testing::Values("trace.csv", "trace.lcm"),
                         [](const auto& file) { return std::string(file.param).substr(6); });

TEST(Ending, IsShortenedByASecondSignalOnceTheAxesAreAtRest) {
  const Directory directory;
  Json json = machine();
  for (const char* key : {"Deceleration", "EmergencyDeceleration"})
    json["technology_objects"]["A"]["config"]["DynamicDefaults"][key] = 50.0;
  json["technology_objects"]["A"]["config"]["DynamicLimits"]["MaxDeceleration"] = 50.0;
  const std::string project = directory.write("project.json", json.dump());
  const UnreadPipe pipe(directory.file("trace.csv"));
  RunningLockstep run(project, {"--trace", pipe.path(), "--signals", "count,A.Position"});
  ASSERT_TRUE(is_moving(run));
  ASSERT_TRUE(wait_until([&] { return pipe.is_full(); }));
  const auto asked = Clock::now();
  run.send(SIGTERM);
  ModbusClient client(run.port());
  ASSERT_TRUE(wait_until([&] { return client.input_float(0) < 100.0F; }));
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 3) << run.err();
  EXPECT_GT(Clock::now() - asked, 1900ms) << "the axis needs two seconds, whoever is impatient";
  EXPECT_LT(Clock::now() - asked, 6500ms) << "five seconds of patience are left out";
}

TEST(Ending, OfASimulationThatWaitsForAPipeIsBoundedToo) {
  const Directory directory;
  const std::string project = directory.write("project.json", machine().dump());
  const UnreadPipe pipe(directory.file("trace.csv"));
  Process run(lockstep_command({"run", project, "--simulate", "--trace", pipe.path(), "--signals", "count"}));
  ASSERT_TRUE(wait_until([&] { return pipe.is_full(); }));
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 3) << run.err();
  EXPECT_NE(run.err().find("it takes nothing"), std::string::npos) << run.err();
}

/// Whether a process has SIGTERM for a thread of its own that waits for it.
bool has_taken_signals(pid_t process) {
  const std::string status = content("/proc/" + std::to_string(process) + "/status");
  const std::string mark = "SigBlk:\t";
  const std::size_t at = status.find(mark);
  return at != std::string::npos &&
         (std::stoull(status.substr(at + mark.size()), nullptr, 16) >> (SIGTERM - 1) & 1) != 0;
}

TEST(Ending, BeforeThePipeHasAReaderIsBoundedToo) {
  const Directory directory;
  const std::string project = directory.write("project.json", machine().dump());
  const std::string pipe = directory.file("trace.csv");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  Process run(lockstep_command({"run", project, "--no-modbus", "--no-lcm", "--trace", pipe}));
  ASSERT_TRUE(wait_until([&] { return run.err().find("values are kept in") != std::string::npos; }));
  ASSERT_TRUE(wait_until([&] { return has_taken_signals(run.pid()); }));
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 2) << run.err();
  EXPECT_NE(run.err().find("asked to end while it starts"), std::string::npos) << run.err();
}

TEST(Ending, WithADiskThatDoesNotAnswerTellsThatTheValuesAreNotKept) {
  const Directory directory;
  const std::string project = directory.write("project.json", machine().dump());
  const std::string mark = directory.file("hang");
  std::vector<std::string> command{"env", "LOCKSTEP_HANG=" + mark, "LD_PRELOAD=" LOCKSTEP_HUNG_DISK,
                                   "ASAN_OPTIONS=verify_asan_link_order=0"};
  const std::string trace = directory.file("trace.csv");
  for (const std::string& word : lockstep_command(
           {"run", project, "--modbus", "127.0.0.1:0", "--no-lcm", "--trace", trace, "--signals", "count"}))
    command.push_back(word);
  Process run(command);
  ASSERT_TRUE(wait_until([&] {
    return content(directory.file("project.retain")).find("number") != std::string::npos;
  })) << run.err();
  directory.write("hang", "");
  const std::string at = "Modbus server on 127.0.0.1:";
  ModbusClient(std::atoi(run.err().c_str() + run.err().find(at) + at.size())).write_register(0, 77);
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 3) << run.err();
  EXPECT_NE(run.err().find("project.retain: writing does not end; the last values are not kept"),
            std::string::npos)
      << run.err();
  EXPECT_GT(read_csv(trace).rows, 0u) << "what can be written is";
}

/// What SIGXFSZ would kill: a message to a file that may not grow.
TEST(Ending, ALimitOfTheSizeOfFilesEndsNoRun) {
  const Directory directory;
  const std::string project = directory.write("project.json", machine().dump());
  const std::string trace = directory.file("trace.csv");
  std::vector<std::string> command{"sh",
                                   "-c",
                                   "ulimit -f 8; exec \"$@\"",
                                   "sh",
                                   LOCKSTEP_PROGRAM,
                                   "run",
                                   project,
                                   "--no-modbus",
                                   "--no-lcm",
                                   "--no-retain",
                                   "--duration",
                                   "1s",
                                   "--trace",
                                   trace,
                                   "--signals",
                                   "count,A.Position"};
  Process limited(command);
  EXPECT_EQ(limited.status(), 0);
  EXPECT_NE(limited.err().find(trace + ": File too large"), std::string::npos) << limited.err();
  command[2] = "ulimit -f 0; exec \"$@\" 2>\"$0.err\"";
  command[3] = directory.file("messages");
  EXPECT_EQ(Process(command).status(), 0) << "no message can be written";
}

}  // namespace
}  // namespace lockstep::test::ending_test
