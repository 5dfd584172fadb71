// lockstep monitor, with `lockstep run` on a network that the test makes for itself.
#include <gtest/gtest.h>
#include <lcm/eventlog.h>
#include <poll.h>
#include <pty.h>

#include <chrono>
#include <random>

#include "hmi_bridge/lcm_messages.hpp"
#include "tests/cli/command_run.hpp"

namespace lockstep::cli {
namespace {

constexpr char kKnife[] = LOCKSTEP_SOURCE_DIR "/projects/02_rotary_knife/project.json";
constexpr char kNetwork[] = "ip link set lo up multicast on && ip route add 224.0.0.0/4 dev lo || exit 9; ";
constexpr std::chrono::seconds kDeadline{60};

/// The command that runs a line of the shell in a network of its own: as root, or as the root of a user
/// namespace.
std::vector<std::string> in_own_network(const std::string& line) {
  return {"unshare", ::geteuid() == 0 ? "-n" : "-Urn", "sh", "-c", line};
}

std::string quoted(const std::string& text) {
  return "'" + text + "'";
}

/// Runs the knife in the background for as long as the rest of the line takes.
std::string with_knife(const std::string& line) {
  return std::string(kNetwork) + quoted(LOCKSTEP_EXECUTABLE) + " run " + quoted(kKnife) + " --no-retain" +
         " --no-modbus --lcm 'udpm://239.255.76.67:7667?ttl=0' --stimuli >/dev/null 2>&1 & knife=$!; " +
         line + "; status=$?; kill $knife; wait $knife; exit $status";
}

// Monitor hears nothing before the run has joined the network, so it is asked until it does.
std::string monitor_until_heard(const std::string& options) {
  return "for i in 1 2 3 4 5 6 7 8 9 10; do " + quoted(LOCKSTEP_EXECUTABLE) + " monitor " + options +
         " && break; done";
}

TEST(Monitor, OnceShowsTheTraceOfARunningProject) {
  const Ended ended = run(in_own_network(with_knife(monitor_until_heard("--once"))));
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(ended.out.find("ROTARY_KNIFE: rotary_knife\n  t "), 0u) << ended.out;
  for (const char* text :
       {"rows/s", "age 0.", "dropped 0", "\n  Knife.Position ", " u/s\n", "\n  gear.InSync "})
    EXPECT_NE(ended.out.find(text), std::string::npos) << text << "\n" << ended.out;
}

TEST(Monitor, OnceExitsWith1IfNothingIsHeard) {
  const Ended ended =
      run(in_own_network(std::string(kNetwork) + quoted(LOCKSTEP_EXECUTABLE) + " monitor --once"));
  EXPECT_EQ(ended.status, 1) << ended.err;
  EXPECT_NE(ended.err.find("no trace was heard"), std::string::npos) << ended.err;
  EXPECT_EQ(ended.out, "");
}

TEST(Monitor, InAPipeATableComesEverySecondUntilItIsInterrupted) {
  const Ended ended = run(in_own_network(
      with_knife("timeout -s INT 4 " + quoted(LOCKSTEP_EXECUTABLE) + " monitor; test $? -le 124")));
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.out.find("ROTARY_KNIFE: rotary_knife"), std::string::npos) << ended.out;
  EXPECT_EQ(ended.out.find('\033'), std::string::npos) << "no control sequences in a pipe";
}

TEST(Monitor, WithoutAMulticastRouteOrWithAWrongUrlExitsWith2) {
  const Ended ended = run(in_own_network(quoted(LOCKSTEP_EXECUTABLE) + " monitor --once"));
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find("no multicast route"), std::string::npos) << ended.err;
  const Ended wrong = lockstep({"monitor", "--once", "--lcm", "tcp://localhost"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("unknown network"), std::string::npos) << wrong.err;
}

/// An event log of anything that may be on a network, and among it a good trace on channel GOOD.
void write_hostile_log(const std::string& path, std::uint32_t seed) {
  lcm_eventlog_t* const log = lcm_eventlog_create(path.c_str(), "w");
  ASSERT_NE(log, nullptr);
  std::mt19937 random(seed);
  std::int64_t time = 0;
  const auto put = [&](std::string channel, std::span<const std::uint8_t> bytes) {
    std::vector<std::uint8_t> data(bytes.begin(), bytes.end());
    lcm_eventlog_event_t event{};
    event.timestamp = time += 200;
    event.channellen = static_cast<std::int32_t>(channel.size());
    event.channel = channel.data();
    event.datalen = static_cast<std::int32_t>(data.size());
    event.data = data.data();
    lcm_eventlog_write_event(log, &event);
  };
  LcmEncoder good({"knife", "GOOD", 1'000'000, 0}, std::vector<TraceSignal>{{"x", Type::LREAL, "u"}});
  LcmEncoder evil({"\033[2J\033]0;gone\007", "EVIL", 1'000'000, 0},
                  std::vector<TraceSignal>{{"\033[31mred\r\n", Type::DINT, "\x9b"}, {"", Type::TIME, ""}});
  for (int i = 0; i < 2000; ++i) {
    Value value{};
    value.r = 12.25;
    put("GOOD_HEADER", good.header());
    put("GOOD", good.row({i * 1'000'000, static_cast<std::uint64_t>(i), 0, std::span(&value, 1)}));
    std::vector<std::uint8_t> bytes(1 + random() % 300);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    put(i % 2 == 0 ? "RANDOM_HEADER" : "GOOD", bytes);
    const Value nothing[2]{};
    for (const auto whole : {evil.header(), evil.row({i, 0, 0, nothing})}) {
      bytes.assign(whole.begin(), whole.end());
      for (unsigned times = random() % 4; times > 0; --times)
        bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
      if (random() % 5 == 0) bytes.resize(8 + random() % (bytes.size() - 7));
      put("EVIL\033[1m" + std::to_string(random() % 40) + (i % 2 == 0 ? "_HEADER" : ""), bytes);
    }
  }
  lcm_eventlog_destroy(log);
}

TEST(Monitor, HostileMessagesNeitherEndItNorHideATraceNorReachTheTerminal) {
  const std::uint32_t seed = 20260715;
  std::printf("seed %u\n", seed);
  const Folder folder;
  write_hostile_log(folder.file("hostile.lcm"), seed);
  const std::string play = "(while lcm-logplayer --lcm-url='udpm://239.255.76.67:7667?ttl=0' " +
                           quoted(folder.file("hostile.lcm")) + " >/dev/null 2>&1; do :; done) & player=$!; ";
  const Ended ended =
      run(in_own_network(std::string(kNetwork) + play + "timeout -s INT 5 " + quoted(LOCKSTEP_EXECUTABLE) +
                         " monitor --lcm 'udpm://239.255.76.67:7667?ttl=0'; status=$?; kill $player; "
                         "test $status -eq 124 -o $status -eq 0"));
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.out.find("GOOD: knife"), std::string::npos) << ended.out.substr(0, 2000);
  EXPECT_NE(ended.out.find(" 12.2500"), std::string::npos) << ended.out.substr(0, 2000);
  EXPECT_EQ(ended.out.find_first_of("\033\007\r"), std::string::npos) << "control characters got through";
}

/// A program on a terminal of its own.
class OnTerminal {
 public:
  explicit OnTerminal(std::vector<std::string> command) {
    winsize size{.ws_row = 24, .ws_col = 80, .ws_xpixel = 0, .ws_ypixel = 0};
    pid_ = ::forkpty(&fd_, nullptr, nullptr, &size);
    if (pid_ != 0) return;
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (std::string& argument : command) arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
  }
  ~OnTerminal() {
    if (!ended_) ::kill(pid_, SIGKILL);
    status();
    ::close(fd_);
  }
  OnTerminal(const OnTerminal&) = delete;
  OnTerminal& operator=(const OnTerminal&) = delete;

  void press(const std::string& keys) { EXPECT_EQ(::write(fd_, keys.data(), keys.size()), std::ssize(keys)); }

  /// Reads until a text has come. @return all that has come, without it if the deadline has passed
  std::string read_until(const std::string& text) {
    const auto deadline = std::chrono::steady_clock::now() + kDeadline;
    while (seen_.find(text) == std::string::npos && std::chrono::steady_clock::now() < deadline) {
      pollfd source{.fd = fd_, .events = POLLIN, .revents = 0};
      if (::poll(&source, 1, 100) != 1) continue;
      char bytes[4096];
      const ssize_t got = ::read(fd_, bytes, sizeof bytes);
      if (got <= 0) break;
      seen_.append(bytes, static_cast<std::size_t>(got));
    }
    return std::exchange(seen_, "");
  }

  int status() {
    if (!ended_) ::waitpid(pid_, &status_, 0);
    ended_ = true;
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
  }

 private:
  int fd_ = -1;
  pid_t pid_ = -1;
  int status_ = 0;
  bool ended_ = false;
  std::string seen_;
};

TEST(Monitor, OnATerminalItShowsLiveValuesScrollsAndLeavesTheTerminalAsItWas) {
  for (const char* last_key : {"q", "\x03"}) {
    OnTerminal terminal(in_own_network(with_knife("stty rows 8; stty -g >&2; " + quoted(LOCKSTEP_EXECUTABLE) +
                                                  " monitor; status=$?; stty -g >&2; (exit $status)")));
    const std::string before = terminal.read_until("\033[?1049h");
    EXPECT_NE(before.find("\033[?1049h"), std::string::npos) << before;
    EXPECT_NE(terminal.read_until("Knife.Position").find("Knife.Position"), std::string::npos);
    terminal.press("\033[6~");
    EXPECT_NE(terminal.read_until("lines 7 to 12 of 12").find("lines 7 to 12 of 12"), std::string::npos);
    terminal.press("\033[A");
    EXPECT_NE(terminal.read_until("lines 6 to 11 of 12").find("lines 6 to 11 of 12"), std::string::npos);
    terminal.press(last_key);
    const std::string after = terminal.read_until("\033[?25h\033[?1049l");
    EXPECT_NE(after.find("\033[?25h\033[?1049l"), std::string::npos);
    const std::string settings = before.substr(0, before.find('\r'));
    EXPECT_NE(terminal.read_until(settings).find(settings), std::string::npos)
        << "the settings are others now";
    EXPECT_EQ(terminal.status(), 0);
  }
}

}  // namespace
}  // namespace lockstep::cli
