// lockstep monitor: live values of the traces on an LCM network.
#include <fmt/format.h>
#include <lcm/lcm.h>
#include <poll.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <system_error>

#include "cli/command/command.hpp"
#include "cli/command/standard_streams.hpp"
#include "cli/describe/table.hpp"
#include "cli/monitor/inbox.hpp"
#include "cli/monitor/keys.hpp"
#include "cli/monitor/record.hpp"
#include "cli/monitor/screen.hpp"
#include "cli/monitor/view.hpp"
#include "hmi_bridge/lcm/publisher.hpp"
#include "hmi_bridge/network/write_signals.hpp"

namespace lockstep::cli {
namespace {

using namespace std::chrono_literals;
using Clock = HeardTrace::Clock;

constexpr char kUsualUrl[] = "udpm://239.255.76.67:7667?ttl=0";
constexpr auto kRefresh = 200ms;               // of the terminal
constexpr auto kInterval = 1s;                 // between two tables in a pipe
constexpr auto kGather = 1200ms;               // of --once: every trace tells its signals once a second
constexpr auto kPatience = 2000ms;             // of --once
constexpr std::size_t kMessagesAtOnce = 1000;  // messages taken between two looks at the clock

volatile std::sig_atomic_t end_requested = 0;

void request_end(int /*signal*/) {
  end_requested = 1;
}

void take_signals() {
  struct sigaction action {};
  action.sa_handler = &request_end;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

/// What the command line asks for.
struct MonitorOptions {
  std::string url = kUsualUrl;
  bool once = false;
  bool panel = false;
  std::string record;  ///< file; empty: a name by date and time
};

std::int64_t wall_clock() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

/// Such as monitor_20260701_120000.lcm.
std::string record_name() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[64];
  const std::size_t length = std::strftime(text, sizeof text, "monitor_%Y%m%d_%H%M%S.lcm", &local);
  return {text, length};
}

std::optional<Panel> panel_of(const MonitorOptions& options) {
  if (!options.panel) return std::nullopt;
  std::random_device chance;
  return Panel(static_cast<std::int64_t>(std::uint64_t{chance()} << 32 | chance()));
}

/// The network: takes what comes, as long as it is told.
class Listener {
 public:
  /// @throws std::runtime_error without a multicast route, or for a URL that is none
  explicit Listener(const MonitorOptions& options)
      : model(options.url, panel_of(options)),
        joined_(options.url, LcmTraceIdentity{"monitor", "MONITOR", 0, 0}),
        inbox_(joined_) {}

  /// Listens until a time, a key or a signal.
  void listen(Clock::time_point until) {
    while (end_requested == 0) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
      if (left <= 0) return;
      pollfd sources[] = {{inbox_.descriptor(), POLLIN, 0}, {STDIN_FILENO, POLLIN, 0}};
      const nfds_t count = keys ? 2 : 1;
      if (poll(sources, count, static_cast<int>(left)) < 0) return;
      if (keys && sources[1].revents != 0) return;
      if (sources[0].revents != 0)
        inbox_.take(kMessagesAtOnce, [this](const std::string& channel, std::span<const std::uint8_t> bytes) {
          take(channel, bytes);
        });
    }
  }

  void send(const OutgoingCommand& out) {
    const auto bytes = encoded(out.command);
    if (lcm_publish(joined_.instance(), out.channel.c_str(), bytes.data(),
                    static_cast<unsigned>(bytes.size())) != 0)
      model.remark = "the command could not be sent";
  }

  /// Begins a record with what describes the traces, so that its first rows can be read.
  void begin_record(const std::string& path) try {
    record_ = std::make_unique<MonitorRecord>(path);
    model.record = path;
    for (const auto& [channel, trace] : model.heard().traces.all())
      record_->message(channel + std::string(kHeaderSuffix), trace.header_message(), wall_clock());
  } catch (const std::system_error& error) {
    model.remark = std::string("no record: ") + error.what();
  }
  void end_record() {
    if (!record_) return;
    record_->end();
    model.remark = record_->reason().empty()
                       ? fmt::format("recorded {} messages in {}", record_->messages(), record_->name())
                       : fmt::format("record incomplete: {} messages lost in {}: {}", record_->lost(),
                                     record_->name(), record_->reason());
    record_.reset();
    model.record.clear();
  }
  bool recording() const { return record_ != nullptr; }
  /// Writes out what is held back; a disk that is full ends the record, and is told.
  void look_at_record() {
    if (!record_) return;
    record_->flush();
    model.recorded = record_->messages();
    if (!record_->reason().empty()) end_record();
  }

  Model model;
  bool keys = false;  ///< whether a key ends `listen`

 private:
  void take(const std::string& channel, std::span<const std::uint8_t> bytes) {
    if (model.accept(channel, bytes, Clock::now()) && record_) record_->message(channel, bytes, wall_clock());
  }

  LcmPublisher joined_;  // publishes commands at most; it joins and tells why it cannot
  Inbox inbox_;
  std::unique_ptr<MonitorRecord> record_;
};

/// Writes a table to standard output. @throws OutputFailed
void print(const Listener& listener, const char* after) {
  std::string text;
  for (const std::string& line : trace_lines(listener.model.heard().traces, Clock::now(), output_width()))
    text += line + "\n";
  for (const std::string& line : leading_lines(listener.model.heard().leading, Clock::now(), output_width()))
    text += line + "\n";
  if (text.empty()) text = "no trace heard\n";
  write_data(text + after);
}

int show_once(Listener& listener) {
  const auto begin = Clock::now();
  listener.listen(begin + kGather);
  const auto heard = [&listener] {
    return listener.model.heard().traces.any_row() || !listener.model.heard().leading.empty();
  };
  while (!heard() && Clock::now() < begin + kPatience && end_requested == 0)
    listener.listen(std::min(Clock::now() + 50ms, begin + kPatience));
  if (!heard()) {
    write_message("lockstep: no trace was heard; is a project running with lcm in its trace?\n");
    return kNotValid;
  }
  print(listener, "");
  return kOk;
}

int show_in_pipe(Listener& listener) try {
  for (auto due = Clock::now() + kInterval; end_requested == 0; due += kInterval) {
    listener.listen(due);
    if (end_requested != 0) break;
    print(listener, "\n");
  }
  return kOk;
} catch (const OutputFailed& failure) {
  // Nobody reads any more, or a signal has come while nobody did: what is left waits for nobody.
  if (failure.error != EPIPE && end_requested == 0) throw;
  return kOk;
}

void fulfil(const Wish& wish, Listener& listener, const MonitorOptions& options) {
  if (wish.command) listener.send(*wish.command);
  if (!wish.record) return;
  if (listener.recording())
    listener.end_record();
  else
    listener.begin_record(options.record.empty() ? record_name() : options.record);
}

/// The keys that have been pressed. @return false if one of them asks for the end
bool take_keys(Screen& screen, Listener& listener, const MonitorOptions& options) {
  bool ended = false;
  for (const Key& key : screen.keys(ended)) {
    const Wish wish = press(listener.model, key, page_of(listener.model, screen.size()), Clock::now());
    if (wish.end) return false;
    fulfil(wish, listener, options);
  }
  return !ended;
}

int show_on_terminal(Listener& listener, const MonitorOptions& options) {
  block_write_signals();  // a record that may grow no further is an error of its own
  {
    Screen screen;
    listener.keys = true;
    auto due = Clock::now();
    while (end_requested == 0 && take_keys(screen, listener, options)) {
      listener.look_at_record();
      screen.show(view(listener.model, Clock::now(), screen.size(), screen.characters()));
      if (Clock::now() >= due) due = Clock::now() + kRefresh;
      listener.listen(due);
    }
  }
  const bool recorded = listener.recording();
  listener.end_record();
  if (recorded) tell(listener.model.remark);
  return kOk;
}

int monitor(const MonitorOptions& options) {
  take_signals();
  const bool terminal = isatty(STDOUT_FILENO) == 1 && isatty(STDIN_FILENO) == 1;
  if (options.panel && (options.once || !terminal)) {
    write_message("lockstep: --panel needs a terminal, for its keys\n");
    return kCouldNotStart;
  }
  try {
    Listener listener(options);
    if (options.once) return show_once(listener);
    return terminal ? show_on_terminal(listener, options) : show_in_pipe(listener);
  } catch (const std::runtime_error& error) {
    tell(error.what(), Severity::error);
    return kCouldNotStart;
  }
}

}  // namespace

void add_monitor_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("monitor", "Show live values of the traces on the network");
  auto options = std::make_shared<MonitorOptions>();
  command->add_option("--lcm", options->url, "the network to listen to")->capture_default_str();
  command->add_flag("--once", options->once, "print one table, after up to 2 s, and end");
  command->add_option("--record", options->record, "file for the key r (monitor_DATE_TIME.lcm)");
  command->add_flag("--panel", options->panel,
                    "keys act on axes, where the project allows it ('commands' of its lcm)");
  command->footer(
      "Of each channel: project, time of the run, rows in a second, age of the last row, rows that the run\n"
      "could not record (dropped) and that did not come through the network (lost).\n"
      "In a terminal: arrows, PgUp, PgDn, Home and End choose a signal; / searches, s sorts, g plots, + and "
      "-\n"
      "change the window, j shows jobs, a alarms, l leading values between controllers, p pauses, r records, "
      "? helps; q or Ctrl-C ends.\n"
      "With --panel: Tab chooses an axis, e and d enable and disable it, left and right jog it while the key "
      "is\n"
      "held, Space stops, h sets its position, x resets alarms, n starts the program of an MCO_305, [ and ] "
      "change the override, < and > the\n"
      "velocity of jogging. A jog ends 300 ms after its last key.\n"
      "In a pipe: one table a second.\n"
      "Exit status: 0, 1 if --once has heard nothing, 2 without a network or a terminal that is known");
  command->callback([&action, options] { action = [options] { return monitor(*options); }; });
}

}  // namespace lockstep::cli
