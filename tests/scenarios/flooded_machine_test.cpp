// A whole machine while everything around it goes wrong: thirty-two Modbus clients at full speed, half of
// them up to no good, a trace onto a full disk, a network whose subscriber has stopped, kept values that
// nobody takes.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <random>
#include <thread>

#include "hmi_bridge/csv_trace.hpp"
#include "hmi_bridge/lcm_publisher.hpp"
#include "hmi_bridge/modbus_server.hpp"
#include "hmi_bridge/retain_writer.hpp"
#include "hmi_bridge/trace_recorder.hpp"
#include "projects/project.hpp"
#include "tests/hmi_bridge/memory_disk.hpp"
#include "tests/hmi_bridge/modbus_raw_client.hpp"
#include "tests/hmi_bridge/own_network.hpp"
#include "tests/scenarios/small_project.hpp"
#include "tests/support/allocations.hpp"

namespace lockstep::test {
namespace {

using Bytes = RawClient::Bytes;

constexpr char kUrl[] = "udpm://239.255.76.67:7667?ttl=0";
constexpr int kGood = 16;
constexpr int kRounds = 120;       // of each good client
constexpr int kFirstOwn = 100;     // register of the first good client
constexpr int kPair = 200;         // registers of two values that belong together
constexpr int kTicksInARow = 100;  // between two pauses of the cycle

/// Six axes on a line shaft, with a register for each client, two values and an array that change in each
/// tick; all of them are kept.
std::string flooded_project() {
  Json json = example_json("03_line_shaft");
  Json& map = json["modbus"]["map"];
  Json calls = Json::array();
  for (int i = 0; i < kGood; ++i) {
    const std::string tag = "own_" + std::to_string(i);
    json["tags"][tag] = {{"type", "INT"}, {"retain", true}};
    map.push_back({{"tag", tag}, {"table", "holding_register"}, {"address", kFirstOwn + i}});
  }
  for (const char* tag : {"beat", "triple"}) json["tags"][tag] = {{"type", "DINT"}, {"retain", true}};
  json["tags"]["beats"] = {{"type", "ARRAY[0..99] OF DINT"}, {"retain", true}};
  map.push_back({{"tag", "beats"}, {"table", "input_register"}, {"address", kPair}});
  map.push_back({{"tag", "beat"}, {"table", "holding_register"}, {"address", kPair}});
  map.push_back({{"tag", "triple"}, {"table", "holding_register"}, {"address", kPair + 2}});
  json["programs"].push_back({{"name", "Beat"},
                              {"ob", "MC_PreServo"},
                              {"calls",
                               {assignment("beat", "beat + 1"), assignment("triple", "3 * beat"),
                                assignment("beats[beat MOD 100]", "beat")}}});
  return json.dump();
}

std::vector<Signal> places_of(const std::vector<NamedSignal>& signals) {
  std::vector<Signal> places;
  for (const NamedSignal& signal : signals) places.push_back(signal.signal);
  return places;
}

/// The machine with all that `lockstep run` puts around it.
struct Machine {
  explicit Machine(Project loaded)
      : project(std::move(loaded)),
        modbus_image(places_of(project.modbus.signals)),
        ring(places_of(project.trace.signals)),
        keeper(RetainFile("full.retain", project.name, disk.name()), project.retain.values,
               std::chrono::milliseconds(1)) {
    ModbusServerOptions options;
    options.listen = {{"127.0.0.1", 0}};
    server = std::make_unique<ModbusServer>(std::vector<ModbusService>{{options, project.modbus.units_of(0)}},
                                            modbus_image, ModbusIdentity{});
    Controller& controller = *project.controller;
    controller.apply_stimuli = true;
    controller.trace = &ring;
    controller.images = {&modbus_image, &keeper.image()};
    disk.space = 0;
  }

  Project project;
  MemoryDisk disk;
  ProcessImage modbus_image;
  TraceRing ring;
  RetainWriter keeper;
  std::unique_ptr<ModbusServer> server;
  std::unique_ptr<TraceRecorder> recorder;
};

class Clients {
 public:
  explicit Clients(std::uint16_t port) : port_(port) {
    for (int i = 0; i < 5; ++i) be_silent();
    for (int i = 0; i < kGood; ++i) threads_.emplace_back([this, i] { be_good(i); });
    for (unsigned i = 0; i < 6; ++i) threads_.emplace_back([this, i] { be_malformed(20240604 + i); });
    for (int i = 0; i < 5; ++i) threads_.emplace_back([this] { be_slow(); });
  }
  ~Clients() {
    is_over_ = true;
    for (std::thread& thread : threads_) thread.join();
  }

  std::atomic<int> good_left{kGood};
  std::atomic<int> wrong{0};
  std::atomic<int> torn{0};

 private:
  /// Writes its register and reads it back, and the two values that belong together.
  void be_good(int number) {
    RawClient client(port_);
    const auto low = static_cast<std::uint8_t>(kFirstOwn + number);
    for (int n = 0; n < kRounds; ++n) {
      const auto value = static_cast<std::uint8_t>(n);
      const Bytes write = {0, value, 0, 0, 0, 6, 1, 6, 0, low, 0, value};
      const Bytes read = {0, value, 0, 0, 0, 6, 1, 3, 0, low, 0, 1};
      const Bytes answer = {0, value, 0, 0, 0, 5, 1, 3, 2, 0, value};
      if (!client.send(write) || client.receive(write.size()) != write) ++wrong;
      if (!client.send(read) || client.receive(answer.size()) != answer) ++wrong;
      const Bytes pair = {0, value, 0, 0, 0, 6, 1, 3, 0, kPair, 0, 4};
      if (!client.send(pair)) ++wrong;
      const Bytes both = client.receive(17);
      if (both.size() != 17 || both[8] != 8) {
        ++wrong;
        continue;
      }
      const auto number_at = [&both](std::size_t i) {
        return std::uint32_t{both[i]} << 24 | std::uint32_t{both[i + 1]} << 16 |
               std::uint32_t{both[i + 2]} << 8 | both[i + 3];
      };
      if (number_at(13) != 3 * number_at(9)) ++torn;
    }
    --good_left;
  }
  void be_malformed(unsigned seed) {
    std::mt19937 random(seed);
    while (!is_over_) {
      RawClient client(port_);
      Bytes bytes = {0, 1, 0, 0, 0, 6, 1, 3, 0, 30, 0, 3};
      for (int i = 0; i < 3; ++i) {
        const std::size_t place = random() % bytes.size();
        if (place != 7) bytes[place] = static_cast<std::uint8_t>(random());  // not the function: no writes
      }
      client.send(bytes);
      client.end_sending();
      client.is_hung_up_on();
    }
  }
  void be_slow() {
    RawClient client(port_);
    const Bytes request = {0, 1, 0, 0, 0, 6, 1, 3, 0, kFirstOwn, 0, 1};
    while (!is_over_) {
      for (const std::uint8_t byte : request) {
        if (is_over_ || !client.send({byte})) return;
        std::this_thread::yield();
      }
      if (client.receive(11).size() != 11) ++wrong;
    }
  }
  void be_silent() {
    RawClient client(port_);
    client.send({0, 1, 0, 0, 0, 6});
    silent_.push_back(std::move(client));
  }

  std::uint16_t port_;
  std::vector<std::thread> threads_;
  std::vector<RawClient> silent_;
  std::atomic<bool> is_over_{false};
};

/// Waits of the calling thread in the system: switches that it asked for.
long waits() {
  rusage usage{};
  ::getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_nvcsw;
}

TEST(FloodedMachine, ItsCycleNeitherWaitsNorAllocatesAndEveryAnswerIsRightAndOfOneInstant) {
  in_own_network([] {
    bring_up_network();
    const Directory directory;
    ForeignProgram subscriber(
        {"lcm-logger", "--quiet", std::string("--lcm-url=") + kUrl, directory.file("never.lcm")});
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    subscriber.stop();

    LoadedProject loaded = load_project(flooded_project());
    ASSERT_TRUE(loaded.project.has_value()) << loaded.problems[0].place << loaded.problems[0].text;
    Machine machine(std::move(*loaded.project));
    std::vector<std::unique_ptr<TraceSink>> sinks;
    sinks.push_back(std::make_unique<CsvTrace>("/dev/full"));
    sinks.push_back(std::make_unique<LcmPublisher>(kUrl, LcmTraceIdentity{"flood", "FLOOD", 2'000'000, 0}));
    std::vector<TraceSignal> columns;
    for (const NamedSignal& signal : machine.project.trace.signals)
      columns.push_back({signal.name, signal.signal.value_type(), ""});
    machine.recorder = std::make_unique<TraceRecorder>(machine.ring, std::move(columns), std::move(sinks));
    ASSERT_EQ(machine.server->start(), "");
    machine.keeper.start();

    Clients clients(machine.server->port());
    Controller& controller = *machine.project.controller;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(120);
    long waited = 0;
    const std::uint64_t allocated = allocations_counted();
    while (clients.good_left > 0 && std::chrono::steady_clock::now() < deadline) {
      const long before = waits();
      {
        const CountAllocations count;
        for (int i = 0; i < kTicksInARow; ++i) controller.tick();
      }
      waited += waits() - before;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(clients.good_left, 0) << "in two minutes";
    EXPECT_EQ(waited, 0);
    EXPECT_EQ(allocations_counted(), allocated);
    EXPECT_EQ(clients.wrong, 0);
    EXPECT_EQ(clients.torn, 0) << "answers of two instants";
    EXPECT_EQ(machine.server->counters().faults, 0u);
    EXPECT_GT(machine.server->counters().malformed, 0u);
    EXPECT_TRUE(machine.keeper.failing()) << "the disk of the kept values is full";
    machine.keeper.stop();
    machine.recorder->stop();
    ASSERT_FALSE(machine.recorder->losses().empty());
    EXPECT_NE(machine.recorder->losses()[0].find("No space left"), std::string::npos)
        << machine.recorder->losses()[0];
    for (const Axis* axis : controller.axes) EXPECT_EQ(axis->data.ErrorDetail.Number, 0u) << axis->name;
    EXPECT_GT(controller.counters().ticks, 1000u);
  });
}

TEST(FloodedMachine, TheCountOfAllocationsSeesThem) {
  const std::uint64_t before = allocations_counted();
  {
    const CountAllocations count;
    delete new std::vector<int>(10);
  }
  EXPECT_GE(allocations_counted(), before + 2);
}

/// The thread of a process with a name; 0: none.
pid_t thread_named(pid_t process, const std::string& name) {
  const std::string tasks = "/proc/" + std::to_string(process) + "/task";
  for (const auto& task : std::filesystem::directory_iterator(tasks)) {
    std::string found;
    std::getline(std::ifstream(task.path() / "comm"), found);
    if (found == name) return std::stoi(task.path().filename().string());
  }
  return 0;
}

TEST(FloodedMachine, TheThreadOfTheCycleAsksTheSystemForNothingButTheTimeOfItsNextTick) {
  const Directory directory;
  const std::string project = directory.write("project.json", flooded_project());
  RunningLockstep run(project,
                      {"--stimuli", "--trace", directory.file("t.csv"), "--retain", directory.file("kept")});
  pid_t cycle = 0;
  ASSERT_TRUE(wait_until([&] { return (cycle = thread_named(run.pid(), "cycle")) != 0; }));
  const std::string calls = directory.file("calls");
  Process strace({"timeout", "-s", "INT", "3", "strace", "-qq", "-o", calls, "-p", std::to_string(cycle)});
  Clients clients(static_cast<std::uint16_t>(run.port()));
  strace.status();
  std::ifstream lines(calls);
  int sleeps = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME") ||
        line.starts_with("restart_syscall"))
      ++sleeps;
    else
      EXPECT_EQ(line, "") << "a system call of the cycle";
  }
  EXPECT_GT(sleeps, 500);
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 0) << run.err();
}

}  // namespace
}  // namespace lockstep::test
