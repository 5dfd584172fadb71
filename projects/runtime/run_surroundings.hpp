/// What is around the cycle of a run: Modbus, traces, commands of panels, kept values, the audit log.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hmi_bridge/audit/log.hpp"
#include "hmi_bridge/modbus/client.hpp"
#include "hmi_bridge/modbus/server.hpp"
#include "hmi_bridge/retain/writer.hpp"
#include "hmi_bridge/traces/columns.hpp"
#include "hmi_bridge/traces/flight_recorder.hpp"
#include "hmi_bridge/traces/recorder.hpp"
#include "projects/runtime/leading_values.hpp"
#include "projects/runtime/messages.hpp"
#include "projects/runtime/panel_commands.hpp"
#include "projects/runtime/run_options.hpp"
#include "projects/runtime/telegram_recorder.hpp"
#include "projects/studio/session.hpp"
#include "scheduler/real_time.hpp"

namespace lockstep {

/// Everything around the cycle: crossings, server, clients, recorder. Built in order before the first tick,
/// ended after the last one. Whoever owns it runs the cycle, in real or in virtual time, and limits how long
/// it waits for the end: a hung disk may hold up `end` for ever. Thread: the owner, unless said otherwise.
class RunSurroundings {
 public:
  /// Starts all that the project and the options ask for; what is not essential and cannot be is warned of.
  /// `project`, `options` and `messages` outlive this; after a failure the project cannot be run any more.
  /// @param keeper as `restore_kept` gives it; nullptr: nothing is kept
  /// @throws CouldNotStart, and std::exception where the system gives no threads or memory
  RunSurroundings(Project& project, const RunOptions& options, std::unique_ptr<RetainWriter> keeper,
                  Messages& messages);
  RunSurroundings(const RunSurroundings&) = delete;
  RunSurroundings& operator=(const RunSurroundings&) = delete;

  /// Of the trace.
  const std::vector<NamedSignal>& signals() const { return signals_; }
  /// Where the Modbus server listens, with the ports that the system gave; empty: there is none over TCP.
  std::vector<Endpoint> modbus_endpoints() const;
  /// Where the studio listens, with the port that the system gave; none: there is no studio.
  std::optional<Endpoint> studio_endpoint() const;

  /// What the clock that several controllers share shows more than that of the cycle [ns]; none: no leading
  /// value crosses to another process.
  std::optional<std::int64_t> clock_offset() const;
  /// Tells where time 0 of the controller is on that clock. @param start on that of the cycle [ns]
  void tell_start(std::int64_t start);

  /// What the clock of a run in real time tells of itself, which outlives the studio. Any thread.
  void tell_status(const RealTimeStatus& status) noexcept { status_ = &status; }

  /// Between two ticks of virtual time: waits until the recorder has space; false if it takes nothing more.
  bool wait_for_recorder() const {
    return ring_->wait_for_space() && events_.wait_for_space() &&
           (!studio_ || studio_->tap().wait_for_space());
  }
  /// Ends a `wait_for_recorder`. Any thread.
  void wait_no_more();

  /// Before the last tick: nobody is told any more that something has been taken which no tick takes.
  void take_no_more();
  /// Commands of panels have no meaning once the axes are being brought to rest.
  void hear_no_more();
  /// Tells what has gone wrong lately, or is well again.
  void look();

  /// After the last tick: ends the keeping of values, server, clients, recorder and audit log. What matters
  /// most comes first, since time is limited.
  void end();
  /// Tells what is missing. After `end`.
  void tell_losses();
  /// Whether the file of `trace` is not what was asked for. After `end`.
  bool trace_is_incomplete() const;
  /// What `end` has not come to, a line each. Any thread, while it goes on.
  std::vector<std::string> unfinished() const;

 private:
  enum class Part { none, leading, values, server, clients, studio, trace, audit };

  std::string named(const std::string& option) const { return options_.mark + option + ": "; }

  // The trace.
  void choose_signals();
  LcmTraceIdentity identity(const std::string& channel) const;
  LcmTraceIdentity identity() const;
  void add_whole(std::unique_ptr<TraceSink> sink);
  void add_part(std::unique_ptr<TraceSink> sink, const TraceChannelConfig& config);
  void add_trace_file();
  void add_lcm();
  void add_flight_recorder();
  void add_telegram_recorder(const FlightRecorderOptions& recording);
  void start_trace();
  void tell_recordings() const;

  // Modbus.
  std::vector<std::string> modbus_names() const;
  std::vector<ModbusService> modbus_services() const;
  void start_modbus();
  void start_clients();
  void tell_failures(const ModbusClient& client) const;
  void tell_refused_clients() const;

  // The studio.
  void make_studio();
  void empower_studio();
  std::string rights_of_pages() const;
  std::string health() const;
  void start_studio();

  void join_others();

  void start_audit();
  void make_commands();
  void start_commands();
  std::string studio_listen() const;
  bool studio_writes() const noexcept { return options_.studio_write || project_.studio.write; }

  Project& project_;
  const RunOptions& options_;
  Messages& messages_;
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
  std::unique_ptr<TelegramMemory> telegrams_;  // of the flight recorder; none without other processes
  const TelegramRecorder* telegram_flight_ = nullptr;
  bool jobs_told_ = false;
  EventQueue events_;
  std::unique_ptr<TraceRing> ring_;
  std::unique_ptr<TraceRecorder> recorder_;
  std::unique_ptr<ProcessImage> image_;
  std::unique_ptr<ModbusServer> server_;
  std::vector<std::unique_ptr<ProcessImage>> client_images_;
  std::vector<std::unique_ptr<ModbusClient>> clients_;
  std::unique_ptr<PanelCommands> commands_;
  std::vector<std::unique_ptr<LeadingValueExchange>> exchanges_;  // with other processes
  std::unique_ptr<StudioSession> studio_;
  std::unique_ptr<StudioServer> studio_server_;
  std::atomic<const RealTimeStatus*> status_{nullptr};
};

}  // namespace lockstep
