/// The axis panel of the monitor: which axes take commands, and the commands. It sends nothing itself.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hmi_bridge/lcm/commands.hpp"

namespace lockstep::cli {

/// An axis of a run that takes commands.
struct PanelAxis {
  std::string channel;  ///< of the trace; commands go to CHANNEL_CMD
  panel_t state;
  std::chrono::steady_clock::time_point heard;
};

/// A command with the channel to which it goes.
struct OutgoingCommand {
  std::string channel;
  command_t command;
};

/// Any one thread.
class Panel {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kMaximumAxes = 64;
  static constexpr std::chrono::seconds kSilent{1};  ///< after which an axis takes no commands any more
  static constexpr int kPercents[] = {1, 5, 10, 25, 50, 100};

  /// @param sender number by which runs tell panels apart
  explicit Panel(std::int64_t sender = 0) : sender_(sender) {}

  void accept(const std::string& channel, const panel_t& state, Clock::time_point now);

  const std::map<std::pair<std::string, std::string>, PanelAxis>& axes() const noexcept { return axes_; }
  /// The chosen axis; nullptr: none is heard. The first one until another is chosen.
  const PanelAxis* chosen() const;
  void choose_next();
  /// Velocity of jogging in percent of the highest.
  int percent() const noexcept { return kPercents[percent_]; }
  void change_percent(int steps) noexcept;

  /// A command for the chosen axis; none while it is not heard.
  /// @param value of homing and override; that of jogging is known
  std::optional<OutgoingCommand> command(std::int32_t action, double value, Clock::time_point now);

 private:
  std::int64_t sender_;
  std::int64_t sequence_ = 0;
  std::map<std::pair<std::string, std::string>, PanelAxis> axes_;
  std::pair<std::string, std::string> chosen_;
  int percent_ = 2;
};

}  // namespace lockstep::cli
