// lockstep run: puts the parts together, runs them and tells how it went.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <system_error>
#include <thread>

#include "cli/command/command.hpp"
#include "cli/command/shortage.hpp"
#include "cli/run/ending.hpp"
#include "cli/run/events.hpp"
#include "cli/run/retain.hpp"
#include "cli/run/run_command.hpp"
#include "cli/run/run_commands.hpp"
#include "cli/run/service_manager.hpp"
#include "cli/run/state_directory.hpp"
#include "hmi_bridge/audit/log.hpp"
#include "hmi_bridge/lcm/log.hpp"
#include "hmi_bridge/lcm/publisher.hpp"
#include "hmi_bridge/lcm/url.hpp"
#include "hmi_bridge/modbus/client.hpp"
#include "hmi_bridge/modbus/server.hpp"
#include "hmi_bridge/network/thread_stacks.hpp"
#include "hmi_bridge/traces/channel.hpp"
#include "hmi_bridge/traces/columns.hpp"
#include "hmi_bridge/traces/csv_trace.hpp"
#include "hmi_bridge/traces/flight_recorder.hpp"
#include "hmi_bridge/traces/recorder.hpp"
#include "scheduler/processor.hpp"
#include "scheduler/real_time.hpp"

namespace lockstep::cli {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kTraceRows = 1 << 14;  // of the ring: seconds of a trace that a slow disk may hold up
constexpr std::size_t kTraceValues = std::size_t{1} << 23;  // in the ring at most, 64 MiB
constexpr auto kRefresh = 100ms;                            // of the display
constexpr auto kLookWhileBraking = 10ms;                    // whether the axes are at rest
constexpr std::size_t kDescriptors = 40;                    // beside those of Modbus clients
constexpr std::size_t kMemory = std::size_t{32} << 20;      // [byte] stacks, and what grows with the run
constexpr std::uint64_t kTicksBetweenLooks = 4096;          // of a simulation, at the clock and for signals

/// What could not be started; its text says what and why.
struct CouldNotStart : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Everything around the cycle: crossings, server, recorder. Ends in the reverse order of its making.
class Surroundings {
 public:
  Surroundings(Project& project, const RunOptions& options, std::unique_ptr<RetainWriter> keeper)
      : project_(project), options_(options), keeper_(std::move(keeper)) {
    choose_signals();
    start_audit();
    start_trace();
    start_modbus();
    start_clients();
    start_commands();
    if (keeper_) project_.controller->images.push_back(&keeper_->image());
    if (keeper_) keeper_->start();
  }

  const std::vector<NamedSignal>& signals() const { return signals_; }

  /// Between two ticks of virtual time: waits until the recorder has room; false if it takes nothing more.
  bool wait_for_recorder() const { return ring_->wait_for_space() && events_.wait_for_space(); }

  /// Ends a `wait_for_recorder`. Any thread.
  void wait_no_more() {
    ring_->close();
    events_.close();
  }

  /// Before the last tick: nobody is told any more that something has been taken which no tick takes.
  void take_no_more() {
    hear_no_more();
    if (server_) server_->refuse_writes();
  }

  /// Commands of panels have no meaning once the axes are being brought to rest.
  void hear_no_more() {
    if (commands_) commands_->end();
  }

  /// Tells what has gone wrong lately, or is well again.
  void look() {
    if (audit_)
      if (const std::string news = audit_->news(); !news.empty()) tell("warning: " + news);
    if (!keeper_) return;
    for (std::string news; !(news = keeper_->news()).empty();) tell("warning: " + news);
  }

  /// After the last tick: ends the keeping of values, server, clients and recorder. What matters most comes
  /// first, since time is limited.
  void end() {
    part_ = Part::values;
    stop_keeper();
    part_ = Part::server;
    if (server_) server_->stop();
    part_ = Part::clients;
    for (const auto& client : clients_) client->stop();
    part_ = Part::trace;
    hear_no_more();
    recorder_->stop();
    part_ = Part::audit;
    if (audit_) audit_->stop();
    part_ = Part::none;
  }

  /// Tells what is missing. After `end`.
  void tell_losses() {
    look();
    if (keeper_ && keeper_->failing()) tell("warning: the last values are not kept");
    if (audit_ && audit_->lost() != 0)
      tell(fmt::format("warning: audit log {}: {} entries are lost", audit_->path(), audit_->lost()));
    if (server_) tell_refused_clients();
    for (const auto& client : clients_) tell_failures(*client);
    if (commands_) commands_->tell_counters();
    if (flight_ != nullptr) tell_recordings();
    for (const std::string& loss : recorder_->losses()) tell("warning: " + loss);
  }

  /// What `end` has not come to. Any thread, while it goes on.
  std::vector<std::string> unfinished() const {
    std::vector<std::string> texts = recorder_->losses();
    if (std::string held_up = recorder_->held_up(); !held_up.empty()) texts.push_back(std::move(held_up));
    const Part part = part_;
    if (part == Part::values)
      texts.push_back("retain file " + keeper_->path() +
                      ": writing does not end; the last values are not kept");
    if (part == Part::server) texts.push_back("the Modbus server does not end");
    if (part == Part::clients) texts.push_back("a Modbus client does not end");
    if (part == Part::audit)
      texts.push_back("audit log " + audit_->path() + ": writing does not end; the last entries are lost");
    return texts;
  }

 private:
  enum class Part { none, values, server, clients, trace, audit };

  void tell_recordings() const {
    for (const std::string& file : flight_->written()) tell("flight recorder: wrote " + file);
    for (const std::string& problem : flight_->not_removed()) tell("warning: flight recorder: " + problem);
  }

  /// The values of the last tick.
  void stop_keeper() {
    if (keeper_) keeper_->stop();
  }

  void choose_signals() {
    if (options_.signals.empty()) {
      signals_ = project_.trace.signals;
      return;
    }
    for (const std::string& name : options_.signals) {
      const FoundPlace found = project_.names.find(name);
      if (!found.place) throw CouldNotStart("--signals: " + found.problem);
      const Type type = found.place->signal.type;
      if (type >= Type::AXIS) throw CouldNotStart("--signals: " + name + " has no value to record");
      signals_.push_back({name, found.place->signal, found.place->unit});
    }
  }

  /// In virtual time only where somebody asks for it, as the others that look out.
  void start_audit() {
    AuditOptions wanted = project_.audit.value_or(AuditOptions{});
    wanted.file = path_of_run(options_.file, wanted.file);
    if (!options_.audit.empty())
      wanted.file = options_.audit;
    else if (options_.simulate || !project_.audit)
      return;
    try {
      audit_ = std::make_unique<AuditLog>(std::move(wanted), project_.name);
    } catch (const std::system_error& error) {
      throw CouldNotStart(std::string("audit log: ") + error.what());
    }
    tell("writes and commands from outside are told in " + audit_->path());
  }

  /// What the audit log calls the signals of the map.
  std::vector<std::string> modbus_names() const {
    std::vector<std::string> names;
    for (const NamedSignal& signal : project_.modbus.signals) names.push_back(signal.name);
    for (const ModbusMapConfig& map : project_.modbus.maps)
      for (const ModbusText& text : map.texts)
        for (std::size_t i = 0; i < text.count(); ++i)
          names[map.map.entries()[text.first + i].signal] +=
              fmt::format(" (characters {} and {})", 2 * i + 1, 2 * i + 2);
    return names;
  }

  LcmTraceIdentity identity(const std::string& channel) const {
    LcmTraceIdentity named = identity();
    named.channel = channel;
    return named;
  }

  LcmTraceIdentity identity() const {
    return {.project = project_.name,
            .channel = project_.trace.channel.empty() ? "LOCKSTEP" : project_.trace.channel,
            .period = project_.controller->clock.interpolator_cycle(),
            .epoch = options_.simulate ? 0 : epoch_};
  }

  /// A sink that gets the signals of the trace.
  void add_whole(std::unique_ptr<TraceSink> sink) {
    sinks_.push_back(std::make_unique<TraceChannel>(std::move(sink), columns_.of(signals_)));
  }

  void add_part(std::unique_ptr<TraceSink> sink, const TraceChannelConfig& config) {
    std::optional<std::size_t> occasion;
    if (config.occasion) occasion = columns_.of(*config.occasion);
    sinks_.push_back(std::make_unique<TraceChannel>(std::move(sink), columns_.of(config.signals),
                                                    config.selection, occasion));
  }

  void add_trace_file() {
    const std::string& path = options_.trace_file;
    if (path.empty()) return;
    try {
      if (path.ends_with(".csv")) {
        add_whole(std::make_unique<CsvTrace>(path));
      } else if (path.ends_with(".lcm")) {
        auto log = std::make_unique<LcmLog>(path, identity());
        for (const TraceChannelConfig& channel : project_.trace.channels)
          add_part(log->add_channel(identity(channel.channel)), channel);
        add_whole(std::move(log));
        project_.controller->tell_jobs();
        jobs_told_ = true;
      } else {
        throw CouldNotStart("--trace: '" + path + "' has to end in .csv or .lcm");
      }
    } catch (const std::system_error& error) {
      throw CouldNotStart(std::string("--trace: ") + error.what());
    }
  }

  void add_lcm() {
    const bool asked = !options_.lcm.empty();
    const bool wanted = asked || (!options_.simulate && !options_.no_lcm && !project_.trace.url.empty());
    if (!wanted) return;
    const std::string url = asked ? options_.lcm : project_.trace.url;
    try {
      add_whole(std::make_unique<LcmPublisher>(url, identity()));
      for (const TraceChannelConfig& channel : project_.trace.channels)
        add_part(std::make_unique<LcmPublisher>(url, identity(channel.channel), false), channel);
      if (!jobs_told_) project_.controller->tell_jobs();
    } catch (const std::exception& error) {
      if (asked) throw CouldNotStart(std::string("--lcm: ") + error.what());
      tell(std::string("warning: no traces over LCM: ") + error.what());
    }
  }

  void add_flight_recorder() {
    if (!project_.flight_recorder) return;
    const FlightRecorderConfig& config = *project_.flight_recorder;
    FlightRecorderOptions recording = config.options;
    recording.file = path_of_run(options_.file, recording.file);
    if (const std::string problem = Recordings(recording.file).problem(); !problem.empty())
      tell("warning: the flight recorder cannot write: " + problem);
    auto recorder = std::make_unique<FlightRecorder>(std::move(recording), columns_.of(config.signals),
                                                     project_.controller->clock.interpolator_cycle());
    flight_ = recorder.get();
    sinks_.push_back(std::move(recorder));
  }

  /// Alarms are told in any case; rows are recorded only for somebody.
  void start_trace() {
    add_trace_file();
    add_lcm();
    add_flight_recorder();
    const bool rows = !sinks_.empty();
    sinks_.insert(sinks_.begin(), std::make_unique<AlarmMessages>(options_.simulate ? 500 : 0));
    std::vector<Signal> places = columns_.places();
    const std::size_t fitting = kTraceValues / (places.size() + 1);
    ring_ = std::make_unique<TraceRing>(std::move(places),
                                        rows ? std::clamp<std::size_t>(fitting, 1 << 10, kTraceRows) : 2);
    if (rows) project_.controller->trace = ring_.get();
    project_.controller->events = &events_;
    recorder_ =
        std::make_unique<TraceRecorder>(*ring_, columns_.described(), std::move(sinks_),
                                        EventSource{&events_, EventTexts(*project_.controller), rows});
  }

  /// What is served where: as the project says, or at the one place that the command line names.
  std::vector<ModbusService> modbus_services() const {
    const ModbusConfig& modbus = project_.modbus;
    std::vector<ModbusService> services;
    for (std::size_t i = 0; i < modbus.servers.size(); ++i)
      services.push_back({modbus.servers[i], modbus.units_of(i)});
    if (options_.modbus.empty()) return services;
    std::string problem;
    const std::optional<Endpoint> endpoint = parse_endpoint(options_.modbus, problem);
    if (!endpoint) throw CouldNotStart("--modbus: " + problem);
    if (services.empty()) services.push_back({ModbusServerOptions{}, modbus.units_of(0)});
    services.erase(services.begin() + 1, services.end());
    services[0].options.listen = {*endpoint};
    services[0].options.serial.reset();
    if (!is_loopback(endpoint->host) && services[0].options.allow.empty())
      tell("warning: --modbus: whoever reaches " + to_string(*endpoint) +
               " may read and write what the map shows; 'allow' of the project says from which networks "
               "clients "
               "may come",
           Gravity::warning);
    return services;
  }

  void start_modbus() {
    const bool asked = !options_.modbus.empty();
    const bool wanted =
        asked || (!options_.simulate && !options_.no_modbus && !project_.modbus.servers.empty());
    if (!wanted) return;
    std::vector<ModbusService> services = modbus_services();
    image_ = std::make_unique<ProcessImage>(places_of(project_.modbus.signals));
    project_.controller->images.push_back(image_.get());
    ModbusIdentity identity;
    identity.revision = LOCKSTEP_VERSION;
    identity.application = project_.name;
    server_ = std::make_unique<ModbusServer>(std::move(services), *image_, identity);
    if (audit_) server_->audit_to(*audit_, modbus_names());
    if (const std::string error = server_->start(); !error.empty()) throw CouldNotStart("Modbus: " + error);
    for (const Endpoint& place : server_->places()) tell("Modbus server on " + to_string(place));
    if (asked) return;
    for (const ModbusServerOptions& server : project_.modbus.servers)
      if (server.serial)
        tell(fmt::format("Modbus server on {}, unit {}", server.serial->device, server.serial_unit));
  }

  /// Foreign devices have no place in a simulation.
  void start_clients() {
    if (options_.simulate || options_.no_modbus) return;
    for (const ModbusClientConfig& client : project_.modbus.clients) {
      client_images_.push_back(std::make_unique<ProcessImage>(places_of(client.signals)));
      project_.controller->images.push_back(client_images_.back().get());
      clients_.push_back(std::make_unique<ModbusClient>(client.options, *client_images_.back()));
    }
    for (const auto& client : clients_) client->start();
  }

  /// Nobody jogs in virtual time.
  void start_commands() {
    if (options_.simulate || options_.no_lcm || project_.commands.axes.empty()) return;
    const std::string url = options_.lcm.empty() ? project_.trace.url : options_.lcm;
    try {
      commands_ = std::make_unique<RunCommands>(project_, url, identity(), *recorder_, audit_.get());
      // Of the project's own network the loader has warned.
      if (!options_.lcm.empty() && lcm_leaves_machine(url))
        tell("warning: --lcm: " + std::string(kLcmCommandsWarning));
    } catch (const std::exception& error) {
      tell(std::string("warning: no commands over LCM: ") + error.what());
    }
  }

  static void tell_failures(const ModbusClient& client) {
    const ModbusClientCounters& counters = client.counters();
    const auto warn = [&](const std::atomic<std::uint64_t>& count, std::string_view text) {
      if (count != 0)
        tell(
            fmt::format("warning: Modbus client of {}: {} {}", client.options().place(), count.load(), text));
    };
    warn(counters.unreachable, "attempts to connect failed");
    warn(counters.failed, "requests without a good answer");
    warn(counters.refused, "requests refused with an exception");
    warn(counters.bad_values, "values read that their tags cannot hold");
    warn(counters.faults, "internal faults survived");
  }

  /// Clients that were turned away: somebody may be missing, or somebody may have tried.
  void tell_refused_clients() const {
    const ModbusCounters& counters = server_->counters();
    const auto warn = [](const std::atomic<std::uint64_t>& count, std::string_view text) {
      if (count != 0) tell(fmt::format("warning: Modbus: {} {}", count.load(), text));
    };
    warn(counters.not_allowed, "connections refused: not from a network in 'allow'");
    warn(counters.refused, "connections refused: too many clients");
    warn(counters.displaced, "silent clients lost their place to new ones");
    warn(counters.malformed, "connections closed: what came was not Modbus");
    warn(counters.stalled, "connections closed: a request not ended or an answer not taken");
    warn(counters.throttled, "requests held back: more than 'max_requests_per_second'");
    warn(counters.bad_frames, "frames on serial lines dropped: wrong check or length");
    warn(counters.broken_lines, "times a serial line broke");
    warn(counters.faults, "internal faults survived");
  }

  Project& project_;
  const RunOptions& options_;
  std::atomic<Part> part_{Part::none};  // that is being ended
  // Once for all channels, so that what is of one instant has one time stamp.
  const std::int64_t epoch_ = std::chrono::duration_cast<std::chrono::microseconds>(
                                  std::chrono::system_clock::now().time_since_epoch())
                                  .count();
  std::unique_ptr<RetainWriter> keeper_;
  std::unique_ptr<AuditLog> audit_;
  std::vector<NamedSignal> signals_;  // of the trace
  TraceColumns columns_;              // of the ring: those, and what else somebody asks for
  std::vector<std::unique_ptr<TraceSink>> sinks_;
  const FlightRecorder* flight_ = nullptr;
  bool jobs_told_ = false;
  EventQueue events_;
  std::unique_ptr<TraceRing> ring_;
  std::unique_ptr<TraceRecorder> recorder_;
  std::unique_ptr<ProcessImage> image_;
  std::unique_ptr<ModbusServer> server_;
  std::vector<std::unique_ptr<ProcessImage>> client_images_;
  std::vector<std::unique_ptr<ModbusClient>> clients_;
  std::unique_ptr<RunCommands> commands_;
};

/// What a signal is to do is forgotten with what it is done to.
struct Forgetting {
  Ending& ending;
  ~Forgetting() { ending.finished(); }
};

/// From here on time is limited, and what is not finished in it is told.
void end(Surroundings& surroundings, Display& display, Ending& ending) {
  ending.limit([&surroundings] { return surroundings.unfinished(); });
  surroundings.end();
  ending.finished();
  display.close();
}

/// Virtual time: as fast as the machine can; waits for the disk, never for the clock.
void simulate(Project& project, Surroundings& surroundings, Display& display, Ending& ending,
              std::int64_t duration) {
  Controller& controller = *project.controller;
  const auto begin = std::chrono::steady_clock::now();
  auto next_look = begin;
  const Forgetting at_the_end{ending};
  ending.run([&surroundings] { surroundings.wait_no_more(); });
  bool last = false;
  controller.employ_processors();
  for (std::uint64_t tick = 0; !last && surroundings.wait_for_recorder(); ++tick) {
    last =
        (duration >= 0 && controller.now() + controller.clock.servo_cycle >= duration) || ending.requested();
    if (last) surroundings.take_no_more();
    controller.tick();
    if (tick % kTicksBetweenLooks != 0) continue;
    const auto now = std::chrono::steady_clock::now();
    if (now < next_look) continue;
    display.show(controller.now(), "");
    next_look = now + kRefresh;
  }
  controller.take_summary();
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  end(surroundings, display, ending);
  const double simulated = static_cast<double>(controller.now()) * 1e-9;
  write_message(fmt::format("simulated {:.3f} s in {:.3f} s ({:.0f} × real time), {} ticks\n", simulated,
                            spent.count(), simulated / spent.count(), controller.counters().ticks));
}

/// What goes wrong with the clock, for the display; nothing as long as nothing does.
std::string trouble(const RealTimeStatus& status) {
  const std::uint64_t overruns = status.overruns.load();
  const std::uint64_t missed = status.missed_ticks.load();
  return overruns + missed == 0 ? "" : fmt::format("  overruns {}  missed ticks {}", overruns, missed);
}

/// What missed ticks may explain, so that nobody looks for it at the machine.
void tell_missed(const RealTimeStatus& status) {
  if (const std::uint64_t missed = status.missed_ticks.load(); missed > 0)
    tell(fmt::format(
        "warning: {} ticks were missed: motion stood still in them, while encoder signals, Modbus "
        "and timers went on; following errors and alarms within a second of missed ticks may come "
        "from that",
        missed));
}

/// Axes that could not be brought to rest in the time that there is for it.
void tell_moving(const Controller& controller) {
  for (const Axis* axis : controller.axes)
    if (!axis->off())
      tell("warning: " + axis->name +
           " was not at rest when the time for it was over; nothing brakes it now");
}

/// Real time, on a thread of its own; this one only looks and tells.
int run_in_real_time(Project& project, Surroundings& surroundings, Display& display, Ending& ending,
                     const RunOptions& options) {
  const OverrunPolicy policy = project.stop_on_overrun ? OverrunPolicy::stop : OverrunPolicy::report;
  ServiceManager manager(project.controller->clock.servo_cycle);
  RealTimeRun run(*project.controller, policy, options.duration, options.cpu);
  for (const std::string& warning : run.start()) tell("warning: " + warning);
  const RealTimeStatus& status = run.status();
  const Forgetting at_the_end{ending};
  ending.run([&run] { run.stop(); });
  while (!status.at_rest.load(std::memory_order_acquire)) {
    ending.wait(ending.requested() ? kLookWhileBraking : manager.interval(kRefresh));
    manager.look(status.ticks.load());
    if (ending.requested()) {
      manager.stopping();
      surroundings.hear_no_more();
    }
    display.show(status.time.load(), trouble(status));
    surroundings.look();
  }
  manager.look(status.ticks.load());
  manager.stopping();
  // What is acknowledged up to here is taken by the tick that comes before the end.
  ending.limit({});
  surroundings.take_no_more();
  run.wait();
  end(surroundings, display, ending);
  write_message(fmt::format(
      "ran {:.3f} s: {} ticks, {} overruns, {} missed ticks, worst lateness {:.1f} µs, longest tick "
      "{:.1f} µs\n",
      static_cast<double>(status.time.load()) * 1e-9, status.ticks.load(), status.overruns.load(),
      status.missed_ticks.load(), static_cast<double>(status.worst_lateness.load()) * 1e-3,
      static_cast<double>(status.longest_tick.load()) * 1e-3));
  tell_missed(status);
  tell_moving(*project.controller);
  if (!status.stopped_by_overrun.load()) return kOk;
  tell("stopped: three interpolator cycles in a row were not over in time (clock.overrun is \"stop\")",
       Gravity::error);
  return kStoppedByFault;
}

void tell_counters(const Controller& controller) {
  if (const auto zero = controller.counters().evaluation.integer_divisions_by_zero; zero != 0)
    tell(fmt::format("warning: {} integer divisions by zero gave 0", zero));
  if (const auto outside = controller.counters().evaluation.indices_out_of_range; outside != 0)
    tell(
        fmt::format("warning: {} indices of arrays were out of range; what was read there counted as 0, what "
                    "was to be written is lost",
                    outside));
  std::uint64_t silences = 0;
  for (const Watchdog& watchdog : controller.watchdogs) silences += watchdog.silences();
  if (silences != 0)
    tell(fmt::format("warning: Modbus: a watchdog has found its client silent {} times", silences));
  std::uint64_t refused = 0;
  for (const Program& program : controller.programs) refused += program.refused_assignments();
  if (refused != 0)
    tell(fmt::format("warning: {} assignments of values that are not permitted were refused", refused));
}

/// Connections that the Modbus of a project may have at once.
std::size_t clients_of(const Project& project) {
  std::size_t clients = project.modbus.clients.size();
  for (const ModbusServerOptions& server : project.modbus.servers)
    clients += server.listen.size() + static_cast<std::size_t>(server.max_clients);
  return clients;
}

int run_project(Project& project, std::unique_ptr<RetainWriter> keeper, const RunOptions& options) {
  if (options.cpu >= 0)
    if (const std::string problem = leave_processor(options.cpu); !problem.empty())
      throw CouldNotStart("--cpu: " + problem);
  project.controller->apply_stimuli = options.simulate || options.stimuli;
  const bool alone = options.simulate && options.modbus.empty();  // virtual time, without Modbus
  require_descriptors(kDescriptors + (alone ? 0 : clients_of(project)));
  require_memory(kMemory);
  Ending ending;
  Surroundings surroundings(project, options, std::move(keeper));
  Display display(project, surroundings.signals(), options.duration);
  int status = kOk;
  if (options.simulate) {
    simulate(project, surroundings, display, ending, options.duration);
  } else {
    status = run_in_real_time(project, surroundings, display, ending, options);
  }
  surroundings.tell_losses();
  tell_axes(*project.controller);
  tell_counters(*project.controller);
  return status;
}

}  // namespace

int run_project(const RunOptions& options) {
  keep_stacks_small();
  try {
    std::unique_ptr<RetainWriter> keeper;
    int status = kOk;
    std::optional<Project> project =
        load_or_tell(options.file, status, [&](Project& loaded) { keeper = restore_kept(loaded, options); });
    return project ? run_project(*project, std::move(keeper), options) : status;
  } catch (const CouldNotStart& error) {
    tell(with_help(error.what()), Gravity::error);
  } catch (const RetainFileError& error) {
    tell(with_help(error.what()), Gravity::error);
    tell(
        "--retain FILE keeps values in another file; --no-retain begins with their init values and keeps "
        "nothing");
  }
  return kCouldNotStart;
}

}  // namespace lockstep::cli
