// Runs in real time: how they end, what a terminal or a client cannot do to them.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/socket.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>

#include "tests/scenarios/modbus_client.hpp"
#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::real_time_test {
namespace {

/// What `lockstep run` says of the ticks at its end.
struct Ticks {
  double time = -1.0;  // [s]
  long executed = -1;
  long missed = -1;
};

Ticks ticks_of(const std::string& text) {
  std::smatch match;
  if (!std::regex_search(text, match,
                         std::regex("ran ([0-9.]+) s: ([0-9]+) ticks, [0-9]+ overruns, ([0-9]+) missed"))) {
    ADD_FAILURE() << "no summary in\n" << text;
    return {};
  }
  return {std::stod(match[1]), std::stol(match[2]), std::stol(match[3])};
}

/// An axis that runs at 200 mm/s and needs a second to come to rest, whatever asks it to.
std::string slow_to_brake(const Directory& directory) {
  Json project = empty_project();
  Json axis = virtual_axis();
  axis["config"]["DynamicLimits"] = {{"MaxDeceleration", 200.0}, {"MaxAcceleration", 1e5}, {"MaxJerk", 0.0}};
  axis["config"]["DynamicDefaults"] = {
      {"Deceleration", 200.0}, {"Acceleration", 1e5}, {"Jerk", 0.0}, {"EmergencyDeceleration", 200.0}};
  project["technology_objects"]["A"] = axis;
  project["tags"]["alive"] = {{"type", "UDINT"}};
  project["programs"].push_back(
      {{"name", "Main"},
       {"ob", "Main"},
       {"cycle", "1ms"},
       {"calls",
        {assignment("alive", "alive + 1"), call("MC_Power", "power", {{"Axis", "A"}, {"Enable", true}}),
         call("MC_MoveVelocity", "run",
              {{"Axis", "A"}, {"Execute", "power.Status"}, {"Velocity", 200.0}})}}});
  project["modbus"]["map"] = {
      {{"tag", "A.Velocity"}, {"table", "input_register"}, {"address", 0}, {"type", "REAL"}},
      {{"tag", "alive"}, {"table", "input_register"}, {"address", 2}}};
  return directory.write("project.json", project.dump());
}

/// Tells where the axis was when the programs ended, and that it stands where braking takes it, which at 200
/// mm/s² is 100 mm further.
void expect_told_at_rest(const std::string& text) {
  std::smatch match;
  ASSERT_TRUE(std::regex_search(text, match,
                                std::regex("A +moving +at ([0-9.]+) mm; brought to rest at ([0-9.]+) mm\\n")))
      << text;
  EXPECT_NEAR(std::stod(match[2]) - std::stod(match[1]), 100.0, 1.0) << text;
}

/// A line of the shell with arguments; its exit status.
int lockstep_shell(const std::string& line, const std::vector<std::string>& arguments) {
  std::vector<std::string> command{"sh", "-c", line, "sh"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return Process(command).status();
}

bool running_at_200(ModbusClient& client) {
  return wait_until([&] { return client.input_float(0) == 200.0F; });
}

/// Whether programs are called: their count grows.
bool alive(ModbusClient& client) {
  const std::uint32_t before = client.input_double_word(2);
  return wait_until([&] { return client.input_double_word(2) >= before + 100; });
}

class EndedBySignal : public testing::TestWithParam<int> {};

TEST_P(EndedBySignal, BringsItsAxesToRestAndEndsWith0) {
  const Directory directory;
  RunningLockstep run(slow_to_brake(directory));
  ModbusClient client(run.port());
  ASSERT_TRUE(running_at_200(client));
  const auto asked = Clock::now();
  run.send(GetParam());
  EXPECT_EQ(run.status(), 0) << run.err();
  EXPECT_GT(Clock::now() - asked, std::chrono::milliseconds(900)) << "the axis cannot stand yet";
  expect_told_at_rest(run.err());
}

/// "SIGTERM", "RTMIN"
std::string name_of_signal(int signal) {
  if (signal == SIGRTMIN) return "SIGRTMIN";
  if (signal == SIGRTMAX) return "SIGRTMAX";
  return std::string("SIG") + ::sigabbrev_np(signal);
}

INSTANTIATE_TEST_SUITE_P(Signals, EndedBySignal, testing::Values(SIGINT, SIGTERM, SIGQUIT, SIGPWR, SIGXCPU),
                         [](const auto& signal) { return name_of_signal(signal.param); });

class NotEndedBySignal : public testing::TestWithParam<int> {};

TEST_P(NotEndedBySignal, GoesOnAsIfNothingHadBeen) {
  const Directory directory;
  RunningLockstep run(slow_to_brake(directory));
  ModbusClient client(run.port());
  ASSERT_TRUE(running_at_200(client));
  run.send(GetParam());
  EXPECT_TRUE(alive(client));
  EXPECT_EQ(client.input_float(0), 200.0F);
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 0);
}

INSTANTIATE_TEST_SUITE_P(Signals, NotEndedBySignal,
                         testing::Values(SIGHUP, SIGPIPE, SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF,
                                         SIGSTKFLT, SIGIO, SIGXFSZ, SIGTSTP, SIGTTIN, SIGTTOU, SIGRTMIN,
                                         SIGRTMAX),
                         [](const auto& signal) { return name_of_signal(signal.param); });

TEST(RealTime, AnAxisThatCannotBeBrakedInTimeHoldsNoEndUpForLongerThanTenSecondsAndIsTold) {
  const Directory directory;
  Json json = Json::parse(content(slow_to_brake(directory)));
  Json& config = json["technology_objects"]["A"]["config"];
  config["DynamicLimits"]["MaxDeceleration"] = 2.0;
  config["DynamicDefaults"]["Deceleration"] = 2.0;
  config["DynamicDefaults"]["EmergencyDeceleration"] = 2.0;
  RunningLockstep run(directory.write("slower.json", json.dump()));
  ModbusClient client(run.port());
  ASSERT_TRUE(running_at_200(client));
  const auto asked = Clock::now();
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 0) << run.err();
  EXPECT_GT(Clock::now() - asked, std::chrono::seconds(9));
  EXPECT_NE(run.err().find("warning: A was not at rest"), std::string::npos) << run.err();
  EXPECT_EQ(run.err().find("brought to rest"), std::string::npos) << run.err();
}

TEST(RealTime, ToTheJournalWarningsAndErrorsHaveTheirGravity) {
  const Directory directory;
  const std::string project = slow_to_brake(directory);
  // systemd announces the stream that is standard error by its device and inode.
  const auto to_journal = [&](const std::string& file) {
    return lockstep_shell(
        "exec 2>\"$1/journal\"; JOURNAL_STREAM=$(stat -L -c %d:%i /proc/self/fd/2) exec \"$2\" run \"$3\" "
        "--duration 20ms --no-modbus --no-lcm",
        {directory.file(""), LOCKSTEP_PROGRAM, file});
  };
  EXPECT_EQ(to_journal(project), 0);
  std::string journal = content(directory.file("journal"));
  EXPECT_EQ(journal.find('\033'), std::string::npos) << journal;
  EXPECT_EQ(journal.find('\r'), std::string::npos) << "progress in a log: " << journal;
  EXPECT_EQ(to_journal(directory.file("missing.json")), 2);
  journal = content(directory.file("journal"));
  EXPECT_EQ(journal.find("<3>lockstep: "), 0u) << journal;
  EXPECT_EQ(to_journal(directory.write("wrong.json", "{}")), 1);
  journal = content(directory.file("journal"));
  EXPECT_EQ(journal.find("<3>" + directory.file("wrong.json")), 0u) << journal;
}

TEST(RealTime, ADurationEndsItAndTheAxesAreBroughtToRestAfterIt) {
  const Directory directory;
  const std::string trace = directory.file("trace.csv");
  const Ended ended = lockstep(
      {"run", slow_to_brake(directory), "--duration", "500ms", "--trace", trace, "--signals", "A.Velocity"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  const Ticks ticks = ticks_of(ended.err);
  EXPECT_GE(ticks.executed + ticks.missed, 1490) << "500 ms and a second of braking";
  expect_told_at_rest(ended.err);
  const CsvTable table = read_csv(trace);
  ASSERT_GT(table.rows, 0u);
  EXPECT_LT(table["t"].back(), 0.5) << "the trace ends with the duration";
}

/// Of each thread of a process, by its name: the processors that it may use, as Linux writes them.
std::multimap<std::string, std::string> processors_of_threads(pid_t process) {
  std::multimap<std::string, std::string> threads;
  for (const auto& thread :
       std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
    std::ifstream status(thread.path() / "status");
    std::string name, processors;
    for (std::string line; std::getline(status, line);) {
      if (line.starts_with("Name:\t")) name = line.substr(6);
      if (line.starts_with("Cpus_allowed_list:\t")) processors = line.substr(19);
    }
    threads.emplace(name, processors);
  }
  return threads;
}

/// Whether all threads of a process are stopped: on a busy machine that takes a while.
bool stands(pid_t process) {
  const std::string tasks = "/proc/" + std::to_string(process) + "/task";
  for (const auto& thread : std::filesystem::directory_iterator(tasks)) {
    std::ifstream status(thread.path() / "status");
    for (std::string line; std::getline(status, line);)
      if (line.starts_with("State:") && !line.starts_with("State:\tT")) return false;
  }
  return true;
}

TEST(RealTime, TicksThatItMissesAreToldWithWhatTheyMayExplain) {
  const Directory directory;
  RunningLockstep run(slow_to_brake(directory));
  ModbusClient client(run.port());
  ASSERT_TRUE(running_at_200(client));
  run.send(SIGSTOP);
  EXPECT_TRUE(wait_until([&] { return stands(run.pid()); }));
  const auto stopped = Clock::now();
  EXPECT_TRUE(wait_until([&] { return Clock::now() - stopped > std::chrono::milliseconds(100); }));
  run.send(SIGCONT);
  EXPECT_TRUE(alive(client));
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 0);
  EXPECT_GE(ticks_of(run.err()).missed, 90);
  EXPECT_TRUE(std::regex_search(run.err(), std::regex("warning: [0-9]+ ticks were missed: "))) << run.err();
  expect_told_at_rest(run.err());
}

TEST(RealTime, OnAProcessorOfItsOwnTheCycleIsAloneAndEverythingElseElsewhere) {
  cpu_set_t permitted;
  ASSERT_EQ(sched_getaffinity(0, sizeof permitted, &permitted), 0);
  if (CPU_COUNT(&permitted) < 2) GTEST_SKIP() << "there is one processor";
  int first = 0;
  while (!CPU_ISSET(static_cast<unsigned>(first), &permitted)) ++first;
  const std::string own = std::to_string(first);
  const Directory directory;
  RunningLockstep run(slow_to_brake(directory), {"--cpu", own});
  ModbusClient client(run.port());
  ASSERT_TRUE(running_at_200(client));
  EXPECT_TRUE(wait_until([&] {
    const auto threads = processors_of_threads(run.pid());
    return threads.count("cycle") == 1 && threads.find("cycle")->second == own;
  }));
  for (const auto& [name, processors] : processors_of_threads(run.pid())) {
    if (name == "cycle") continue;
    EXPECT_NE(processors, own) << name;
    EXPECT_FALSE(processors.starts_with(own + "-") || processors.starts_with(own + ","))
        << name << " may use " << processors;
  }
}

TEST(RealTime, AProcessorThatThereIsNotCannotBeTheCycles) {
  const Directory directory;
  const Ended ended = lockstep({"run", slow_to_brake(directory), "--cpu", "1000", "--duration", "1s"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(std::regex_search(ended.err, std::regex("processor 1000: this process may use [0-9]")))
      << ended.err;
}

TEST(RealTime, TheExamplesRunWithoutAlarms) {
  for (const std::string& name : example_names()) {
    const Ended ended = lockstep(
        {"run", example(name), "--stimuli", "--duration", "1s", "--no-modbus", "--no-lcm", "--no-retain"});
    EXPECT_EQ(ended.status, 0) << name << "\n" << ended.err;
    EXPECT_FALSE(std::regex_search(ended.err, std::regex("alarm [0-9]"))) << name << "\n" << ended.err;
    EXPECT_EQ(ended.err.find("not enabled"), std::string::npos) << name << "\n" << ended.err;
  }
}

TEST(RealTime, ASecondServerOnAPortThatIsTakenCannotStart) {
  const Directory directory;
  RunningLockstep first(slow_to_brake(directory));
  const std::string endpoint = "127.0.0.1:" + std::to_string(first.port());
  const Ended second = lockstep({"run", slow_to_brake(directory), "--modbus", endpoint, "--duration", "50s"});
  EXPECT_EQ(second.status, 2);
  EXPECT_NE(second.err.find(endpoint), std::string::npos) << second.err;
  ModbusClient client(first.port());
  EXPECT_TRUE(alive(client)) << "the first one is disturbed";
}

TEST(RealTime, AClosedTerminalNeitherEndsNorStallsIt) {
  const Directory directory;
  const std::string trace = directory.file("trace.csv");
  RunningLockstep run(slow_to_brake(directory), {"--trace", trace, "--signals", "alive"},
                      Process::Output::terminal);
  EXPECT_TRUE(wait_until([&] { return run.err().find("alive ") != std::string::npos; }))
      << "a terminal gets progress";
  run.close_terminal();
  ModbusClient client(run.port());
  EXPECT_TRUE(alive(client));
  EXPECT_TRUE(alive(client));
  const double seen = client.input_double_word(2);
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 0);
  const CsvTable table = read_csv(trace);
  ASSERT_GT(table.rows, 0u);
  EXPECT_GE(table["alive"].back(), seen) << "the trace ends too early";
}

TEST(RealTime, ATerminalThatNobodyReadsDoesNotHoldUpItsEnd) {
  const Directory directory;
  RunningLockstep run(slow_to_brake(directory), {}, Process::Output::terminal);
  ModbusClient client(run.port());
  for (int i = 0; i < 8; ++i) ASSERT_TRUE(alive(client));
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 0);
}

/// A socket that has sent the first bytes of a request and now says nothing.
class SilentClient {
 public:
  explicit SilentClient(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    const unsigned char begin[] = {0, 1, 0, 0, 0, 6, 1, 3, 0};  // of a request to read registers
    EXPECT_EQ(::send(socket_, begin, sizeof begin, 0), static_cast<ssize_t>(sizeof begin));
  }
  ~SilentClient() { ::close(socket_); }
  SilentClient(const SilentClient&) = delete;
  SilentClient& operator=(const SilentClient&) = delete;

 private:
  int socket_;
};

TEST(RealTime, AClientThatStopsInTheMiddleOfARequestStallsNeitherTheTicksNorOtherClients) {
  const Directory directory;
  RunningLockstep run(slow_to_brake(directory), {"--duration", "2s"});
  const SilentClient silent(run.port());
  ModbusClient client(run.port());
  EXPECT_TRUE(running_at_200(client));
  EXPECT_TRUE(alive(client));
  EXPECT_EQ(run.status(), 0);
  // Every tick of the grid was executed or counted as missed; how many were missed is up to the machine.
  const Ticks ticks = ticks_of(run.err());
  EXPECT_GE(ticks.executed + ticks.missed, 2990) << "2 s and a second of braking";
  EXPECT_LE(ticks.time, static_cast<double>(ticks.executed + ticks.missed) * 1e-3 + 0.01);
  EXPECT_GT(ticks.executed, 300) << "less than a tenth of the ticks";
}

}  // namespace
}  // namespace lockstep::test::real_time_test
