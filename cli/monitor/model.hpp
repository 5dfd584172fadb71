/// The model of the monitor: what is known of the network, and what the user has chosen. No terminal, no
/// network, no clock of its own.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/monitor/events.hpp"
#include "cli/monitor/history.hpp"
#include "cli/monitor/leading.hpp"
#include "cli/monitor/panel.hpp"
#include "cli/monitor/traces.hpp"

namespace lockstep::cli {

/// What has been heard.
struct Heard {
  HeardTraces traces;
  std::map<std::string, std::vector<History>>
      histories;  ///< by channel; fewer than signals if there are many
  HeardEvents events;
  HeardLeadingValues leading;
  HeardTrace::Clock::time_point at;  ///< when the last of it came, or when it was shown last
};

/// A signal of the table.
struct SignalRow {
  std::string channel;
  std::size_t index = 0;  ///< among the signals of the channel
  bool operator==(const SignalRow&) const = default;
};

enum class Order : std::uint8_t { as_told, by_name, by_movement };

/// Any one thread.
class Model {
 public:
  using Clock = HeardTrace::Clock;
  static constexpr std::size_t kMaximumHistories = 2048;
  static constexpr std::size_t kLongestNote = 4096;  ///< message of an event or a panel that is kept [byte]
  static constexpr int kWindows[] = {5, 10, 20, 30, 60};  ///< [s]

  /// @param url for the title  @param panel with which the axis panel is there; none: nothing can be
  /// commanded
  explicit Model(std::string url, std::optional<Panel> panel = {});

  /// Takes any message of the network. @return whether it belongs to what is shown, and so into a record
  bool accept(const std::string& channel, std::span<const std::uint8_t> bytes, Clock::time_point now);

  /// What is shown: what has been heard, or while paused what had been.
  const Heard& shown() const noexcept { return frozen_ ? *frozen_ : heard_; }
  const Heard& heard() const noexcept { return heard_; }
  /// The time to which ages are shown.
  Clock::time_point time(Clock::time_point now) const noexcept { return frozen_ ? frozen_->at : now; }
  bool paused() const noexcept { return frozen_.has_value(); }
  void pause(bool on, Clock::time_point now);

  /// The signals that the search lets through, in the chosen order, channel by channel.
  std::vector<SignalRow> rows() const;
  /// The index of the chosen signal among them; 0 if it is not there.
  std::size_t chosen(const std::vector<SignalRow>& rows) const;
  /// Chooses another signal. @param steps down
  void move(std::ptrdiff_t steps);

  const TraceSignal& signal(const SignalRow& row) const;
  std::optional<Value> value(const SignalRow& row) const;
  const History* history(const SignalRow& row) const;

  std::int64_t window() const noexcept { return std::int64_t{kWindows[window_index]} * 1'000'000'000; }

  const std::string url;
  std::optional<Panel> panel;
  std::string search;      ///< part of names, without regard to case; empty: all
  bool searching = false;  ///< keys go to the search
  Order order = Order::as_told;
  bool plot = false, jobs = false, alarms = false, leading = false, help = false;
  int window_index = 2;
  std::string prompt;          ///< what is asked for, such as "home Knife at"; empty: nothing
  std::string answer;          ///< what has been typed
  std::string remark;          ///< of what has happened last, such as the end of a record
  std::string record;          ///< file being recorded; empty: none
  std::uint64_t recorded = 0;  ///< messages in it

 private:
  bool matches(const std::string& name) const;

  Heard heard_;
  std::optional<Heard> frozen_;
  std::optional<SignalRow> chosen_;
  std::size_t histories_ = 0;
};

}  // namespace lockstep::cli
