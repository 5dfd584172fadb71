/// The one desk of a run for all who command it, however their commands come: two desks would count against
/// each other.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/audit/log.hpp"
#include "hmi_bridge/lcm/command_desk.hpp"
#include "hmi_bridge/traces/event.hpp"

namespace lockstep {

/// Each call is whole for itself. Answers are events, which go where those of the cycle go. Thread: any but
/// the cycle's.
class SharedDesk {
 public:
  using Clock = CommandDesk::Clock;
  static constexpr std::chrono::milliseconds kBeat{100};

  /// Takes an answer; on the thread of whoever has commanded.
  using Answers = std::function<void(TraceEvent)>;

  /// How an axis stands, and who jogs it.
  struct Panel {
    panel_t stand;
    std::string enabled_by;   ///< instance of a program that does; empty: panels may
    std::int64_t holder = 0;  ///< sender of the jog that goes on; 0: none does
  };

  /// @param image of the axes' signals, which nobody else reads or writes; outlives this
  /// @param servo_cycle [ns]
  SharedDesk(std::vector<CommandAxis> axes, ProcessImage& image, std::int64_t servo_cycle, Answers answers);

  /// Commands, carried out or refused, are told to a log, which outlives this. Before the first of them.
  void audit_to(AuditLog& log);

  /// A message over LCM. @param sender as the network names it; empty: this process
  void take(std::span<const std::uint8_t> bytes, std::string_view sender);
  /// A command of a page. @param address of the client
  CommandDesk::Verdict give(const command_t& command, std::string_view address);
  /// A panel is gone: what it jogs stops.
  void leave(std::int64_t sender);

  /// Begins the next beat if it is time; whoever tells panels how axes stand calls it.
  void beat(Clock::time_point now);
  /// The axes that take commands by a route.
  std::vector<Panel> panels(CommandRoute route);
  bool has_axes(CommandRoute route) const noexcept;
  std::string axes_text(CommandRoute route) const;
  CommandCounters counters() const;

 private:
  std::int64_t time() const noexcept;
  void tell(bool accepted, const std::string& axis, std::string_view action, const std::string& reason,
            std::string_view address);
  AuditEntry entry_of(const CommandDesk::Judged& judged) const;

  mutable std::mutex mutex_;
  ProcessImage& image_;
  CommandDesk desk_;
  const std::int64_t servo_cycle_;
  const Answers answers_;
  Clock::time_point next_beat_{};
  std::string_view from_;        // of the command at hand
  std::string_view route_name_;  // of the command at hand
};

}  // namespace lockstep
