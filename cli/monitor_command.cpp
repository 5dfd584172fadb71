// lockstep monitor: live values of the traces on an LCM network.
#include <fmt/format.h>
#include <lcm/lcm.h>
#include <poll.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>

#include "cli/command.hpp"
#include "cli/describe_table.hpp"
#include "cli/monitor_traces.hpp"
#include "hmi_bridge/lcm_publisher.hpp"

namespace lockstep::cli {
namespace {

using namespace std::chrono_literals;
using Clock = HeardTrace::Clock;

constexpr char kUsualUrl[] = "udpm://239.255.76.67:7667?ttl=0";
constexpr auto kRefresh = 200ms;    // of the terminal
constexpr auto kInterval = 1s;      // between two tables in a pipe
constexpr auto kGather = 1200ms;    // of --once: every trace tells its signals once a second
constexpr auto kPatience = 2000ms;  // of --once
constexpr int kQueue = 20'000;      // messages that wait, beyond which LCM drops them
constexpr int kBurst = 1000;        // messages taken between two looks at the clock

volatile std::sig_atomic_t end_requested = 0;

void request_end(int /*signal*/) {
  end_requested = 1;
}

void take_signals() {
  struct sigaction action {};
  action.sa_handler = &request_end;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

/// The network: takes what comes, as long as it is told.
class Listener {
 public:
  /// @throws std::runtime_error without a multicast route, or for a URL that is none
  explicit Listener(const std::string& url) : joined_(url, LcmTraceIdentity{"monitor", "MONITOR", 0, 0}) {
    auto* const subscription = lcm_subscribe(joined_.instance(), ".*", &Listener::take, this);
    if (subscription == nullptr) throw std::runtime_error("LCM on " + url + ": cannot be subscribed to");
    lcm_subscription_set_queue_capacity(subscription, kQueue);
  }

  /// Listens until a time, a key or a signal.
  void listen(Clock::time_point until) {
    while (end_requested == 0) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
      if (left <= 0) return;
      pollfd sources[] = {{lcm_get_fileno(joined_.instance()), POLLIN, 0}, {STDIN_FILENO, POLLIN, 0}};
      const nfds_t count = keys ? 2 : 1;
      if (poll(sources, count, static_cast<int>(left)) < 0) return;
      if (keys && sources[1].revents != 0) return;
      for (int i = 0; i < kBurst && sources[0].revents != 0; ++i)
        if (lcm_handle_timeout(joined_.instance(), 0) <= 0) break;
    }
  }

  HeardTraces traces;
  bool keys = false;  ///< whether a key ends `listen`

 private:
  static void take(const lcm_recv_buf_t* buffer, const char* channel, void* self) {
    static_cast<Listener*>(self)->traces.accept(
        channel, {static_cast<const std::uint8_t*>(buffer->data), buffer->data_size}, Clock::now());
  }

  LcmPublisher joined_;  // publishes nothing; it joins and tells why it cannot
};

/// Writes a table to standard output. @return false if nobody reads it any more
bool print(const Listener& listener) {
  std::string text;
  for (const std::string& line : trace_lines(listener.traces, Clock::now(), output_width()))
    text += line + "\n";
  if (text.empty()) text = "no trace heard\n";
  return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
}

int show_once(Listener& listener) {
  const auto begin = Clock::now();
  listener.listen(begin + kGather);
  while (!listener.traces.any_row() && Clock::now() < begin + kPatience && end_requested == 0)
    listener.listen(std::min(Clock::now() + 50ms, begin + kPatience));
  if (!listener.traces.any_row()) {
    write_message("lockstep: no trace was heard; is a project running with lcm in its trace?\n");
    return kNotValid;
  }
  return print(listener) ? kOk : kCouldNotStart;
}

int show_in_pipe(Listener& listener) {
  for (auto due = Clock::now() + kInterval; end_requested == 0; due += kInterval) {
    listener.listen(due);
    if (end_requested != 0) break;
    if (!print(listener) || std::putc('\n', stdout) == EOF) break;
  }
  return kOk;
}

int show_on_terminal(Listener& listener, const std::string& url) {
  Screen screen;
  listener.keys = isatty(STDIN_FILENO) == 1;
  auto due = Clock::now();
  while (end_requested == 0 && screen.take_keys()) {
    const std::string title =
        fmt::format("lockstep monitor  {}  traces: {}", url, listener.traces.all().size());
    std::vector<std::string> lines = trace_lines(listener.traces, Clock::now(), screen.width());
    if (lines.empty()) lines.emplace_back("no trace heard yet");
    screen.show(title, lines);
    if (Clock::now() >= due) due = Clock::now() + kRefresh;
    listener.listen(due);
  }
  return kOk;
}

int monitor(const std::string& url, bool once) {
  take_signals();
  try {
    Listener listener(url);
    if (once) return show_once(listener);
    return isatty(STDOUT_FILENO) == 1 ? show_on_terminal(listener, url) : show_in_pipe(listener);
  } catch (const std::runtime_error& error) {
    write_message(std::string("lockstep: ") + error.what() + "\n");
    return kCouldNotStart;
  }
}

}  // namespace

void add_monitor_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("monitor", "Show live values of the traces on the network");
  auto url = std::make_shared<std::string>(kUsualUrl);
  auto once = std::make_shared<bool>(false);
  command->add_option("--lcm", *url, "the network to listen to")->capture_default_str();
  command->add_flag("--once", *once, "print one table, after up to 2 s, and end");
  command->footer(
      "Of each channel: project, time of the run, rows in a second, age of the last row, rows that the run\n"
      "could not record (dropped) and that did not come through the network (lost).\n"
      "In a terminal: arrows, PgUp, PgDn, Home and End scroll, q or Ctrl-C ends. In a pipe: one table a\n"
      "second.\n"
      "Exit status: 0, 1 if --once has heard nothing, 2 without a network");
  command->callback([&action, url, once] { action = [url, once] { return monitor(*url, *once); }; });
}

}  // namespace lockstep::cli
