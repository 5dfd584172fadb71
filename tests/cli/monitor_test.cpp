// lockstep monitor, with `lockstep run` on a network that the test makes for itself.
#include <gtest/gtest.h>
#include <lcm/eventlog.h>
#include <poll.h>
#include <pty.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <random>
#include <utility>

#include "hmi_bridge/lcm/messages.hpp"
#include "tests/cli/command_run.hpp"
#include "tests/support/property.hpp"

namespace lockstep::cli::monitor_test {
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
       {"rows/s", "age 0.", "dropped 0", "\n  Knife.Position ", " °/s\n", "\n  gear.InSync "})
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
void write_hostile_log(const std::string& path) {
  lcm_eventlog_t* const log = lcm_eventlog_create(path.c_str(), "w");
  ASSERT_NE(log, nullptr);
  std::mt19937 random(test::seed_of_test(20260715));
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
  const Directory folder;
  write_hostile_log(folder.file("hostile.lcm"));
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

/// What a terminal of the kind vt100 shows of what is written to it.
class Picture {
 public:
  Picture(std::size_t rows, std::size_t columns) : cells_(rows, std::vector<std::string>(columns, " ")) {}

  void take(char byte) {
    if (!sequence_.empty()) return take_sequence(byte);
    const auto code = static_cast<unsigned char>(byte);
    if (code >= 0x80) return take_part(byte);
    if (byte == '\033')
      sequence_ = "\033";
    else if (byte == '\r')
      column_ = 0;
    else if (byte == '\n')
      row_ = std::min(row_ + 1, cells_.size() - 1);
    else if (byte == '\b')
      column_ -= std::min<std::size_t>(column_, 1);
    else if (code >= 0x20)
      put(std::string(1, byte));
  }
  std::string text() const {
    std::string text;
    for (const auto& row : cells_) {
      for (const std::string& cell : row) text += cell;
      text += "\n";
    }
    return text;
  }

 private:
  void put(const std::string& character) {
    if (column_ >= cells_[row_].size()) {  // the last column holds the cursor until something follows
      column_ = 0;
      row_ = std::min(row_ + 1, cells_.size() - 1);
    }
    cells_[row_][column_++] = character;
  }
  void take_part(char byte) {
    part_ += byte;
    const auto lead = static_cast<unsigned char>(part_[0]);
    const std::size_t size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (part_.size() == size) put(std::exchange(part_, ""));
  }
  void take_sequence(char byte) {
    sequence_ += byte;
    const char kind = sequence_[1];
    if (kind == '(' || kind == ')' || kind == '#') {
      if (sequence_.size() == 3) sequence_.clear();
      return;
    }
    if (kind == '[' && (sequence_.size() == 2 || byte < 0x40)) return;
    if (kind == '[') carry_out(byte, sequence_.substr(2, sequence_.size() - 3));
    if (kind == 'M') row_ -= std::min<std::size_t>(row_, 1);
    sequence_.clear();
  }
  void carry_out(char kind, const std::string& parameters) {
    const auto semicolon = parameters.find(';');
    const auto number = [&](const std::string& text) {
      return text.empty() || text[0] < '0' || text[0] > '9' ? std::size_t{0} : std::stoul(text);
    };
    const std::size_t first = number(parameters);
    const std::size_t second = semicolon == std::string::npos ? 0 : number(parameters.substr(semicolon + 1));
    const std::size_t distance = std::max<std::size_t>(first, 1);
    if (kind == 'H') row_ = std::min(distance, cells_.size()) - 1;
    if (kind == 'H') column_ = std::min(std::max<std::size_t>(second, 1), cells_[0].size()) - 1;
    if (kind == 'A') row_ -= std::min(row_, distance);
    if (kind == 'B') row_ = std::min(row_ + distance, cells_.size() - 1);
    if (kind == 'C') column_ = std::min(column_ + distance, cells_[0].size() - 1);
    if (kind == 'D') column_ -= std::min(column_, distance);
    if (kind == 'K' || kind == 'J') clear(kind == 'J', first);
  }
  /// Of the line, or of all lines: 0 from the cursor on, 1 up to it, 2 everything.
  void clear(bool lines, std::size_t which) {
    for (std::size_t row = 0; row < cells_.size(); ++row)
      for (std::size_t column = 0; column < cells_[row].size(); ++column) {
        const bool after = row > row_ || (row == row_ && column >= column_);
        const bool before = row < row_ || (row == row_ && column <= column_);
        const bool here = lines || row == row_;
        if (here && (which == 2 || (which == 0 && after) || (which == 1 && before)))
          cells_[row][column] = " ";
      }
  }

  std::vector<std::vector<std::string>> cells_;
  std::size_t row_ = 0, column_ = 0;
  std::string sequence_, part_;
};

/// A program on a terminal of its own.
class OnTerminal {
 public:
  explicit OnTerminal(std::vector<std::string> command, const std::string& locale = "C.UTF-8",
                      const std::string& kind = "vt100") {
    winsize size{.ws_row = kRows, .ws_col = kColumns, .ws_xpixel = 0, .ws_ypixel = 0};
    pid_ = ::forkpty(&fd_, nullptr, nullptr, &size);
    if (pid_ != 0) return;
    ::setenv("TERM", kind.c_str(), 1);
    ::setenv("LC_ALL", locale.c_str(), 1);
    for (const char* const name : {"LINES", "COLUMNS"}) ::unsetenv(name);
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (std::string& argument : command) arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
  }
  ~OnTerminal() {
    if (!ended_) ::kill(-pid_, SIGKILL);  // what it has started too: they are one process group
    status();
    ::close(fd_);
  }
  OnTerminal(const OnTerminal&) = delete;
  OnTerminal& operator=(const OnTerminal&) = delete;

  void press(const std::string& keys) { EXPECT_EQ(::write(fd_, keys.data(), keys.size()), std::ssize(keys)); }

  void resize(std::size_t rows, std::size_t columns) {
    picture_ = Picture(rows, columns);
    winsize size{};
    size.ws_row = static_cast<unsigned short>(rows);
    size.ws_col = static_cast<unsigned short>(columns);
    EXPECT_EQ(::ioctl(fd_, TIOCSWINSZ, &size), 0);
  }

  /// Waits until the terminal shows all the texts. @return whether it does before the deadline
  testing::AssertionResult shows(const std::vector<std::string>& texts) {
    const auto all = [&] {
      const std::string text = picture_.text();
      return std::all_of(texts.begin(), texts.end(),
                         [&](const std::string& part) { return text.find(part) != std::string::npos; });
    };
    wait_for(all);
    if (all()) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "the terminal shows\n" << picture_.text();
  }
  /// Waits until what the terminal shows is as it should be; false at the deadline.
  bool comes(const std::function<bool(const std::string&)>& condition) {
    wait_for([&] { return condition(picture_.text()); });
    return condition(picture_.text());
  }
  std::string text() const { return picture_.text(); }
  /// Waits until a text has been written. @return all that has been written
  std::string read_until(const std::string& text) {
    wait_for([&] { return seen_.find(text) != std::string::npos; });
    return seen_;
  }

  int status() {
    if (!ended_) ::waitpid(pid_, &status_, 0);
    ended_ = true;
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
  }

 private:
  static constexpr unsigned short kRows = 24, kColumns = 80;

  template <class Condition>
  void wait_for(Condition condition) {
    const auto deadline = std::chrono::steady_clock::now() + kDeadline;
    while (!condition() && std::chrono::steady_clock::now() < deadline) {
      pollfd source{.fd = fd_, .events = POLLIN, .revents = 0};
      if (::poll(&source, 1, 100) != 1) continue;
      char bytes[4096];
      const ssize_t got = ::read(fd_, bytes, sizeof bytes);
      if (got <= 0) break;
      seen_.append(bytes, static_cast<std::size_t>(got));
      for (ssize_t i = 0; i < got; ++i) picture_.take(bytes[i]);
    }
  }

  int fd_ = -1;
  pid_t pid_ = -1;
  int status_ = 0;
  bool ended_ = false;
  std::string seen_;
  Picture picture_{kRows, kColumns};
};

/// Shows the settings of the terminal before and after a monitor.
std::string with_settings(const std::string& options) {
  return "stty -g | sed 's/^/before /'; " + quoted(LOCKSTEP_EXECUTABLE) + " monitor " + options +
         "; status=$?; stty -g | sed 's/^/after /'; echo ended $status; (exit $status)";
}

/// What stands behind a word up to the end of its line.
std::string behind(const std::string& text, const std::string& word) {
  const auto at = text.find(word);
  return at == std::string::npos ? "" : text.substr(at + word.size(), text.find('\r', at) - at - word.size());
}

TEST(Monitor, OnATerminalItIsATableThatSearchesPlotsPausesAndLeavesTheTerminalAsItWas) {
  for (const char* last_key : {"q", "\x03"}) {
    OnTerminal terminal(in_own_network(with_knife(with_settings(""))));
    ASSERT_TRUE(
        terminal.shows({"lockstep monitor", "ROTARY_KNIFE: rotary_knife", "Knife.Position", "q ends"}));
    terminal.press("/veloc\r");
    EXPECT_TRUE(terminal.shows({"/veloc  s sort", "Velocity"}));
    terminal.press("g");
    EXPECT_TRUE(terminal.shows({"[°/s]  min ", "now", "-20 s"}));
    terminal.press("-");
    EXPECT_TRUE(terminal.shows({"-10 s"}));
    terminal.press("p");
    EXPECT_TRUE(terminal.shows({"PAUSED"}));
    terminal.press("?");
    EXPECT_TRUE(terminal.shows({"record everything heard"}));
    terminal.resize(10, 40);
    EXPECT_TRUE(terminal.shows({"lockstep monitor", "choose a sign"}));
    terminal.press(last_key);
    const std::string all = terminal.read_until("ended 0");
    EXPECT_NE(all.find("ended 0"), std::string::npos) << all;
    EXPECT_FALSE(behind(all, "before ").empty());
    EXPECT_EQ(behind(all, "before "), behind(all, "after ")) << "the settings are others now";
    EXPECT_EQ(terminal.status(), 0);
  }
}

TEST(Monitor, ASignalEndsItAsAKeyDoes) {
  for (const char* const signal : {"TERM", "INT", "HUP"}) {
    OnTerminal terminal(in_own_network(
        std::string(kNetwork) + "stty -g | sed 's/^/before /'; " + "timeout --foreground -s " + signal +
        " 1 " + quoted(LOCKSTEP_EXECUTABLE) + " monitor; stty -g | sed 's/^/after /'; echo ended"));
    const std::string all = terminal.read_until("ended\r");
    EXPECT_NE(all.find("no trace heard yet"), std::string::npos) << all;
    EXPECT_FALSE(behind(all, "before ").empty());
    EXPECT_EQ(behind(all, "before "), behind(all, "after ")) << signal;
  }
}

TEST(Monitor, InALocaleWithoutUnicodeWritesAsciiOnly) {
  OnTerminal terminal(in_own_network(with_knife(with_settings(""))), "C");
  ASSERT_TRUE(terminal.shows({"Knife.Position"}));
  terminal.press("g");
  EXPECT_TRUE(terminal.shows({"-20 s", "*"}));
  terminal.press("q");
  const std::string all = terminal.read_until("ended 0");
  EXPECT_TRUE(std::all_of(all.begin(), all.end(), [](char c) { return static_cast<signed char>(c) >= 0; }));
}

TEST(Monitor, ATerminalThatNobodyKnowsIsToldAndEndsWith2) {
  OnTerminal terminal(in_own_network(std::string(kNetwork) + with_settings("")), "C.UTF-8",
                      "no_such_terminal");
  const std::string all = terminal.read_until("ended 2");
  EXPECT_NE(all.find("'no_such_terminal' is unknown"), std::string::npos) << all;
  EXPECT_EQ(behind(all, "before "), behind(all, "after "));
}

TEST(Monitor, ARecordIsALogThatPlotReads) {
  const Directory folder;
  const std::string log = folder.file("record.lcm");
  OnTerminal terminal(in_own_network(with_knife(with_settings("--record " + quoted(log)))));
  terminal.resize(24, 160);  // room for the name of the file
  ASSERT_TRUE(terminal.shows({"Knife.Position", "rows/s"}));
  terminal.press("r");
  EXPECT_TRUE(terminal.shows({"REC "}));
  terminal.press("p");
  EXPECT_TRUE(terminal.shows({"PAUSED"}));
  const auto recorded = [](const std::string& text) {
    return text.find("record.lcm (") == std::string::npos
               ? 0
               : std::atoi(text.c_str() + text.find("record.lcm (") + std::strlen("record.lcm ("));
  };
  const int before = recorded(terminal.text());
  EXPECT_TRUE(terminal.comes([&](const std::string& text) { return recorded(text) > before + 100; }))
      << "recording goes on behind a pause\n"
      << terminal.text();
  terminal.press("r");
  EXPECT_TRUE(terminal.shows({"recorded "}));
  terminal.press("r");
  EXPECT_TRUE(terminal.shows({"no record: ", "File exists"}));
  terminal.press("q");
  EXPECT_NE(terminal.read_until("ended 0").find("ended 0"), std::string::npos);
  const Ended plotted = lockstep({"plot", log, "-o", folder.file("picture.svg")});
  EXPECT_EQ(plotted.status, 0) << plotted.err;
  EXPECT_NE(content(folder.file("picture.svg")).find("Knife"), std::string::npos);
}

TEST(Monitor, AFullDiskEndsTheRecordAndIsTold) {
  OnTerminal terminal(
      in_own_network(with_knife("ulimit -f 8; " + with_settings("--record \"$(mktemp -u)\""))));
  ASSERT_TRUE(terminal.shows({"Knife.Position"}));
  terminal.press("r");
  EXPECT_TRUE(terminal.shows({"record incomplete: ", " messages lost in "}));
  terminal.press("q");
  EXPECT_NE(terminal.read_until("ended 0").find("ended 0"), std::string::npos);
}

TEST(Monitor, APanelNeedsATerminal) {
  for (const char* const option : {"--once", "--panel"}) {
    const Ended ended = lockstep({"monitor", "--panel", option});
    EXPECT_EQ(ended.status, 2);
    EXPECT_NE(ended.err.find("--panel needs a terminal"), std::string::npos) << ended.err;
  }
}

}  // namespace
}  // namespace lockstep::cli::monitor_test
