/// What a trigger of an oscilloscope waits for.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "scheduler/events.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

enum class StudioTriggerKind : std::uint8_t {
  above,    ///< a value is greater than the level
  below,    ///< … less
  rising,   ///< it comes from not above the level, less the hysteresis, to above it
  falling,  ///< it comes from not below the level, plus the hysteresis, to below it
  change,   ///< it differs from the value before
  outside,  ///< it is less than the level or greater than the upper level; `window` is another name
  bits,     ///< those of the mask are as they are wanted
  alarm,    ///< an alarm is raised
  job       ///< a job begins
};

/// The kind of a name; none: it is no kind.
std::optional<StudioTriggerKind> studio_trigger_kind(std::string_view name) noexcept;
/// All names, for messages.
std::string_view studio_trigger_kinds() noexcept;

/// Judges the values of one signal, row by row. What is no number changes nothing.
class StudioTrigger {
 public:
  struct Condition {
    StudioTriggerKind kind = StudioTriggerKind::rising;
    double level = 0.0;
    double upper = 0.0;       ///< of `outside`
    double hysteresis = 0.0;  ///< of `rising` and `falling`, ≥ 0
    std::uint64_t mask = 0;   ///< of `bits`
    std::uint64_t wanted = 0;
  };

  explicit StudioTrigger(const Condition& condition) noexcept : condition_(condition) {}

  /// Of alarms and jobs, which no value tells.
  bool waits_for_event() const noexcept {
    return condition_.kind == StudioTriggerKind::alarm || condition_.kind == StudioTriggerKind::job;
  }
  bool is_of(EventKind event) const noexcept {
    return (condition_.kind == StudioTriggerKind::alarm && event == EventKind::alarm) ||
           (condition_.kind == StudioTriggerKind::job && event == EventKind::job_started);
  }
  /// The value of the next row. @return whether this is the occasion
  bool judge(double value) noexcept { return judge(Value{.r = value}, Type::LREAL); }
  bool judge(Value value, Type type) noexcept;
  /// Begins anew: what was before is forgotten.
  void begin() noexcept {
    is_ready_ = false;
    before_.reset();
  }

 private:
  Condition condition_;
  bool is_ready_ = false;        // it has been on the other side
  std::optional<Value> before_;  // value of the row before
};

}  // namespace lockstep
