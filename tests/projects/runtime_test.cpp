// Embedding in real time: what a program starts, hears, stops and is refused.
#include "projects/runtime/runtime.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <modbus.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "projects/loader/simulation.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::runtime_test {
namespace {

using namespace std::chrono_literals;

constexpr auto kLimit = 60s;  // for anything that is waited for

constexpr char kCounter[] = R"json({
  "lockstep": 1,
  "name": "counter",
  "clock": { "servo_cycle": "1ms" },
  "tags": {
    "kept":  { "type": "INT", "init": 3, "retain": true },
    "twice": { "type": "INT" }
  },
  "programs": [ { "name": "Main", "ob": "Main", "cycle": "10ms", "calls": [ { "set": "twice", "to": "2 * kept" } ] } ],
  "modbus": { "map": [
    { "tag": "kept",  "table": "holding_register", "address": 0 },
    { "tag": "twice", "table": "input_register",   "address": 0 }
  ] },
  "trace": { "signals": [ "kept", "twice" ] }
})json";

class Heard final : public Messages {
 public:
  void inform(const std::string& text) noexcept override { add(text); }
  void warn(const std::string& text) noexcept override { add("warning: " + text); }

  bool has(const std::string& part) const {
    const std::lock_guard lock(mutex_);
    return std::any_of(texts_.begin(), texts_.end(),
                       [&](const std::string& text) { return text.find(part) != std::string::npos; });
  }

 private:
  void add(const std::string& text) {
    const std::lock_guard lock(mutex_);
    texts_.push_back(text);
  }

  mutable std::mutex mutex_;
  std::vector<std::string> texts_;
};

template <class Condition>
bool comes_true(const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + kLimit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

/// A client of the machine's map; -1: no answer.
class Client {
 public:
  explicit Client(const Runtime& machine)
      : client_(modbus_new_tcp("127.0.0.1", machine.modbus_endpoints().at(0).port)) {
    modbus_set_response_timeout(client_, 10, 0);
    if (modbus_connect(client_) != 0) ADD_FAILURE() << modbus_strerror(errno);
  }
  ~Client() {
    modbus_close(client_);
    modbus_free(client_);
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  int kept() { return value(modbus_read_registers); }
  int twice() { return value(modbus_read_input_registers); }
  bool keep(std::uint16_t value) { return modbus_write_register(client_, 0, value) == 1; }

 private:
  int value(int (*read)(modbus_t*, int, int, std::uint16_t*)) {
    std::uint16_t word = 0;
    return read(client_, 0, 1, &word) == 1 ? word : -1;
  }

  modbus_t* client_;
};

/// The machine of a test, its files in a directory of its own.
class Given {
 public:
  std::string file(const std::string& name) const { return directory_.file(name); }
  RunOptions options(const std::string& text = kCounter) const {
    RunOptions options;
    options.file = directory_.write("machine.json", text);
    options.modbus = "127.0.0.1:0";
    return options;
  }
  std::string refusal(const RunOptions& options) const {
    try {
      Runtime machine(options);
      machine.start();
    } catch (const CouldNotStart& error) {
      return error.what();
    }
    return "";
  }

 private:
  test::Directory directory_;
};

TEST(Runtime, ServesModbusFromStartToStop) {
  const Given given;
  const auto heard = std::make_shared<Heard>();
  Runtime machine(given.options(), heard);
  EXPECT_EQ(machine.state(), RuntimeState::loaded);
  machine.start();
  EXPECT_EQ(machine.state(), RuntimeState::running);
  EXPECT_TRUE(heard->has("Modbus server on 127.0.0.1:"));
  {
    Client client(machine);
    EXPECT_TRUE(comes_true([&] { return client.twice() == 6; }));
    EXPECT_TRUE(client.keep(21));
    EXPECT_TRUE(comes_true([&] { return client.twice() == 42; }));
  }
  machine.stop();
  EXPECT_TRUE(machine.wait(kLimit));
  EXPECT_EQ(machine.state(), RuntimeState::ended);
  EXPECT_GT(machine.status().ticks.load(), 0u);
  EXPECT_TRUE(machine.unfinished().empty());
}

TEST(Runtime, EndsByItselfWhenItsDurationIsOver) {
  const Given given;
  RunOptions wanted = given.options();
  wanted.duration = 20'000'000;
  wanted.trace = given.file("run.csv");
  Runtime machine(wanted);
  machine.start();
  EXPECT_TRUE(machine.wait(kLimit));
  EXPECT_TRUE(test::content(wanted.trace).starts_with("t,kept,twice\n"));
}

TEST(Runtime, KeepsValuesForTheNextOneAndAuditsWhoWroteThem) {
  const Given given;
  RunOptions wanted = given.options();
  wanted.audit = given.file("audit.csv");
  {
    Runtime machine(wanted);
    machine.start();
    EXPECT_TRUE(Client(machine).keep(77));
  }
  EXPECT_NE(test::content(wanted.audit).find("kept"), std::string::npos);
  Runtime next(wanted);
  next.start();
  Client client(next);
  EXPECT_TRUE(comes_true([&] { return client.kept() == 77; }));
}

TEST(Runtime, IsStoppedBeforeItsFirstTickToo) {
  const Given given;
  Runtime machine(given.options());
  machine.stop();
  machine.start();
  EXPECT_TRUE(machine.wait(kLimit));
  EXPECT_THROW(machine.start(), std::logic_error);
}

TEST(Runtime, RunsAProjectThatIsLoadedAndShowsItToItsOwnerFromBeforeTheFirstTick) {
  const Given given;
  const RunOptions wanted = given.options();
  LoadedProject loaded = load_project_file(wanted.file);
  ASSERT_TRUE(loaded.project);
  Runtime machine(std::move(*loaded.project), nullptr, wanted);
  machine.prepare();
  EXPECT_EQ(machine.state(), RuntimeState::loaded);
  ASSERT_EQ(machine.trace_signals().size(), 2u);
  EXPECT_EQ(machine.trace_signals()[1].name, "twice");
  ProcessImage image({machine.trace_signals()[1].signal});
  machine.project().controller->images.push_back(&image);
  machine.start();
  EXPECT_TRUE(comes_true([&] {
    image.refresh();
    return image.value(0).i == 6;
  }));
  EXPECT_FALSE(machine.wait_for_rest(1ms));
  machine.stop();
  EXPECT_TRUE(comes_true([&] { return machine.wait_for_rest(10ms); }));
  EXPECT_TRUE(machine.wait(kLimit));
  EXPECT_THROW(machine.prepare(), std::logic_error);
}

TEST(Runtime, TellsWhatTheSystemGives) {
  const Given given;
  const auto heard = std::make_shared<Heard>();
  Runtime machine(given.options(), heard);
  machine.start();
  EXPECT_TRUE(heard->has("the system gives "));
  EXPECT_TRUE(heard->has(", kernel "));
}

TEST(Runtime, CannotBeStartedWhenItCouldNotBePrepared) {
  const Given given;
  RunOptions wanted = given.options();
  wanted.signals = {"nobody"};
  Runtime machine(wanted);
  EXPECT_THROW(machine.prepare(), CouldNotStart);
  EXPECT_THROW(machine.start(), std::logic_error);
}

TEST(Runtime, RefusesToStartWithTheReason) {
  const Given given;
  RunOptions wanted = given.options();
  wanted.modbus = "127.0.0.1";
  EXPECT_NE(given.refusal(wanted).find("modbus: '127.0.0.1'"), std::string::npos) << given.refusal(wanted);
  wanted = given.options();
  wanted.signals = {"nobody"};
  EXPECT_NE(given.refusal(wanted).find("signals: "), std::string::npos) << given.refusal(wanted);
  wanted = given.options();
  wanted.trace = given.file("no/run.csv");
  EXPECT_NE(given.refusal(wanted).find("No such file or directory"), std::string::npos)
      << given.refusal(wanted);
  wanted = given.options();
  wanted.simulate = true;
  EXPECT_NE(given.refusal(wanted).find("virtual time"), std::string::npos) << given.refusal(wanted);
}

TEST(Runtime, RefusesAPortThatIsTaken) {
  const Given given;
  Runtime machine(given.options());
  machine.start();
  RunOptions wanted = given.options();
  wanted.no_retain = true;
  wanted.modbus = "127.0.0.1:" + std::to_string(machine.modbus_endpoints().at(0).port);
  EXPECT_EQ(given.refusal(wanted), "Modbus: " + wanted.modbus + ": Address already in use");
}

TEST(Runtime, RefusesAProjectThatIsNotValid) {
  const Given given;
  try {
    Runtime machine(given.options(R"({ "lockstep": 1, "name": "x", "tags": { "a": { "type": "REEL" } } })"));
    ADD_FAILURE() << "has been loaded";
  } catch (const InvalidProject& error) {
    EXPECT_NE(std::string(error.what()).find("/tags/a/type"), std::string::npos) << error.what();
  }
}

/// A pipe that nobody reads.
class FullPipe {
 public:
  explicit FullPipe(const std::string& path) {
    EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
    pipe_ = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  }
  ~FullPipe() { ::close(pipe_); }
  FullPipe(const FullPipe&) = delete;
  FullPipe& operator=(const FullPipe&) = delete;

  void fill() const {
    const std::string page(4096, '\n');
    while (::write(pipe_, page.data(), page.size()) > 0) continue;
    while (::write(pipe_, page.data(), 1) > 0) continue;
  }
  void drain() const {
    char bytes[4096];
    while (::read(pipe_, bytes, sizeof bytes) > 0) continue;
  }

 private:
  int pipe_;
};

TEST(Runtime, TellsInBoundedTimeWhatDoesNotComeToItsEnd) {
  const Given given;
  RunOptions wanted = given.options();
  wanted.trace = given.file("hung.csv");
  const FullPipe pipe(wanted.trace);
  Runtime machine(wanted);
  machine.start();
  pipe.fill();
  machine.stop();
  EXPECT_FALSE(machine.wait(100ms));
  EXPECT_EQ(machine.state(), RuntimeState::ending);
  EXPECT_TRUE(comes_true([&] {
    const std::vector<std::string> held = machine.unfinished();
    return std::any_of(held.begin(), held.end(),
                       [](const std::string& text) { return text.find("hung.csv") != std::string::npos; });
  }));
  EXPECT_TRUE(comes_true([&] {
    pipe.drain();
    return machine.wait(1ms);
  }));
}

}  // namespace
}  // namespace lockstep::runtime_test
