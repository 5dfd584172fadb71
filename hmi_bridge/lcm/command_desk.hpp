/// The desk where commands of operators' panels are looked at: what is let through is posted to the cycle.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "hmi_bridge/lcm/commands.hpp"
#include "scheduler/process_image.hpp"

namespace lockstep {

/// The signals of an axis in the image of a desk, in this order. Those up to `kStarts` the desk writes; a
/// count asks for something by changing.
enum class PanelSignal : std::uint8_t {
  kEnable,        ///< BOOL
  kForward,       ///< BOOL: jog, as long as kBeat changes
  kBackward,      ///< BOOL
  kBeat,          ///< UDINT: count of jog commands
  kJogVelocity,   ///< LREAL [u/s]
  kHomings,       ///< UDINT: count
  kHomePosition,  ///< LREAL [u]
  kResets,        ///< UDINT: count
  kOverride,      ///< LREAL [%]
  kOverrides,     ///< UDINT: count
  kStops,         ///< UDINT: count, of a device: its program
  kProgram,       ///< LREAL: number of a program
  kStarts,        ///< UDINT: count
  kStatusWord,    ///< DWORD, from here on of the axis
  kAlarm,         ///< UDINT
  kPosition,      ///< LREAL [u]; of a speed axis, which has none, 0
  kVelocity,      ///< LREAL [u/s]
  kSpeed,         ///< LREAL [%]
  kCount
};
inline constexpr std::size_t kPanelSignals = static_cast<std::size_t>(PanelSignal::kCount);

/// An axis that takes commands.
struct CommandAxis {
  std::string name;
  double jog_velocity = 0.0;                ///< highest velocity of jogging [u/s], > 0
  std::string enabled_by;                   ///< instance of MC_Power in a program; empty: the panel's own
  std::vector<Signal> signals;              ///< `kPanelSignals` of them
  std::string type = "TO_PositioningAxis";  ///< published type
  std::string velocity_unit = "u/s";        ///< of its velocities
  bool has_position = true;                 ///< a speed axis has none, so it cannot be homed
  bool has_programs = false;                ///< a device: stop, reset and start of a program are all it takes
  bool by_lcm = true;                       ///< takes commands over LCM
  bool by_studio = true;                    ///< takes commands of pages of the studio
};

/// By which route a command has come.
enum class CommandRoute : std::uint8_t { lcm, studio };

/// Whether an axis takes commands that come by a route.
inline bool is_commanded_by(const CommandAxis& axis, CommandRoute route) noexcept {
  return route == CommandRoute::lcm ? axis.by_lcm : axis.by_studio;
}

/// What has come, by what has become of it.
struct CommandCounters {
  std::uint64_t accepted = 0;
  std::uint64_t malformed = 0;   ///< no message of this type
  std::uint64_t stale = 0;       ///< of another run, too old, or repeated
  std::uint64_t not_valid = 0;   ///< unknown axis or action, a value that is not permitted
  std::uint64_t impossible = 0;  ///< a program has the enable, another panel jogs
  std::uint64_t too_many = 0;    ///< of commands in a second, or of panels

  std::uint64_t refused() const noexcept { return malformed + stale + not_valid + impossible + too_many; }
};

/// Judges commands and posts what is permitted. Knows no network. Thread: one of the bridge.
class CommandDesk {
 public:
  using Clock = std::chrono::steady_clock;
  /// A command cites a beat of the run that is no older than this many beats.
  static constexpr std::int64_t kOldestBeat = 10;
  /// While it has come within this time, a jog command keeps other panels from jogging the axis.
  static constexpr std::chrono::milliseconds kHold{300};
  static constexpr int kMaximumPerSecond = 200;  ///< commands beyond it are refused, but for stop and disable
  static constexpr int kMaximumTold = 20;        ///< refusals told in a second; the others are only counted
  static constexpr std::size_t kMaximumSenders = 16;  ///< panels of the last seconds

  /// What is to be told of a command.
  struct Answer {
    bool accepted = false;
    std::string axis;    ///< may be any text
    std::string action;  ///< empty: unknown
    std::string reason;  ///< of a refusal: what is wrong, what is allowed
  };

  /// What has become of a command.
  struct Verdict {
    bool accepted = false;
    std::string reason;    ///< of a refusal: what is wrong, what is allowed
    bool is_told = false;  ///< to all; not: it is only counted, or a jog that goes on
  };

  /// What has become of a message, for the audit log; what it refers to lasts as long as the call.
  struct Judged {
    const command_t* command;               ///< nullptr: it was none
    std::uint64_t CommandCounters::*count;  ///< in which it is counted
    std::string reason;                     ///< of a refusal; empty: accepted
    std::string before, after;              ///< values as JSON; empty: there are none
  };
  using Watch = std::function<void(const Judged&)>;

  /// @param image made of the signals of all axes, one after the other; nobody else writes through it
  /// @param run number of the run, which no other run has
  CommandDesk(std::vector<CommandAxis> axes, ProcessImage& image, std::int64_t run);

  /// From here on each message is told, before it is carried out. Before the first message.
  void watch(Watch watch) { watch_ = std::move(watch); }

  /// Takes one message. @return what is to be told; none for what is only counted and for a jog that goes on
  std::optional<Answer> accept(std::span<const std::uint8_t> bytes, Clock::time_point now);
  /// Takes one command, as a message brings it.
  Verdict give(const command_t& command, Clock::time_point now, CommandRoute route);
  /// A panel is gone: what it jogs stops.
  void leave(std::int64_t sender, Clock::time_point now);
  /// Who jogs an axis; 0: nobody.
  std::int64_t holder(std::size_t axis, Clock::time_point now) const noexcept;

  /// Begins the next beat; ten times a second.
  void beat() noexcept { ++beat_; }
  /// How an axis stands, as the image shows it; `t` and `utime` are the caller's.
  panel_t panel(std::size_t axis) const;

  const std::vector<CommandAxis>& axes() const noexcept { return axes_; }
  const CommandCounters& counters() const noexcept { return counters_; }

 private:
  struct Refusal {
    std::uint64_t CommandCounters::*count;
    std::string reason;
  };
  struct Sender {
    std::int64_t sequence;
    Clock::time_point last;
    std::set<std::size_t> ended;  // axes whose jog it has not stopped itself: it says stop before it jogs
  };
  struct Jog {
    std::int64_t sender = 0;
    std::int32_t action = command_t::STOP;
    Clock::time_point until;
  };
  /// So many things in each second.
  struct Allowance {
    Clock::time_point second;
    int used = 0;
    bool take(Clock::time_point now, int maximum) noexcept;
  };

  std::optional<Refusal> judge(const command_t& command, Clock::time_point now, CommandRoute route);
  std::optional<Refusal> judge_sender(const command_t& command, Clock::time_point now);
  std::optional<Refusal> judge_program(const command_t& command, std::size_t axis) const;
  std::optional<Refusal> judge_value(const command_t& command, std::size_t axis) const;
  std::optional<Refusal> judge_jog(const command_t& command, std::size_t axis, Clock::time_point now,
                                   CommandRoute route) const;
  void replace_jog(const command_t& command, std::size_t axis, Clock::time_point now);
  void carry_out(const command_t& command, std::size_t axis);
  void tell_watch(const command_t& command, std::size_t axis) const;
  Verdict refuse(const Refusal& refusal, const command_t* command, Clock::time_point now);
  std::optional<std::size_t> find(const std::string& axis, CommandRoute route) const;
  Value value(std::size_t axis, PanelSignal signal) const noexcept;

  const std::vector<CommandAxis> axes_;
  ProcessImage& image_;
  const std::int64_t run_;
  std::int64_t beat_ = 0;
  std::vector<Jog> jogs_;                // of the axes
  std::vector<std::uint32_t> requests_;  // counts that ask, by axis and signal
  std::unordered_map<std::int64_t, Sender> senders_;
  Allowance commands_, told_;
  CommandCounters counters_;
  Watch watch_;
};

}  // namespace lockstep
