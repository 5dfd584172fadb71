/// A leading and a following axis with the blocks that ready them, watched at every tick.
#pragma once

#include <cmath>
#include <deque>
#include <sstream>
#include <string>
#include <vector>

#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "scheduler/controller.hpp"
#include "tests/conformance/allocations.hpp"
#include "tests/conformance/subject.hpp"

namespace lockstep::test {

/// Limits of both axes, low enough that a motion beyond them shows.
struct BenchLimits {
  static constexpr double kVelocity = 500.0;          // [u/s]
  static constexpr double kAcceleration = 5000.0;     // [u/s²]
  static constexpr double kEmergency = 20000.0;       // [u/s²]
  static constexpr double kJerk = 100000.0;           // [u/s³]
  static constexpr double kLeadingVelocity = 200.0;   // [u/s]
  static constexpr double kLeadingLength = 100.0;     // [u] ring of the leading axis
  static constexpr std::int64_t kPeriod = 4'000'000;  // [ns]
};

/// Ticks within which an axis of the bench surely stands once it is disabled.
inline constexpr int kStoppingTicks = 3000;

class Bench {
 public:
  /// @param modulo whether the following axis has a ring
  /// @param enable_following false: a block under test does it, or the axis stays off
  explicit Bench(bool modulo = false, bool enable_following = true)
      : leading(make_axis("Leading", true)), following(make_axis("Following", modulo)) {
    controller.clock = {BenchLimits::kPeriod, 1};
    following.leading_values.push_back({&leading, Coupling::setpoint});
    following.data.Modulo.Length = 360.0;
    controller.finish();
    power_leading.Axis = run_leading.Axis = &leading;
    power_following.Axis = home_following.Axis = &following;
    reset_following.Axis = relative_following.Axis = &following;
    power_leading.Enable = true;
    run_leading.Velocity = BenchLimits::kLeadingVelocity;
    power_following.Enable = enable_following;
    support_ = {&power_leading, &run_leading};
    if (enable_following) support_.push_back(&power_following);
    for (Block* block : {static_cast<Block*>(&home_following), static_cast<Block*>(&reset_following),
                         static_cast<Block*>(&relative_following)})
      support_.push_back(block);
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  /// A block on the bench: its object pins are wired, a leading axis where one is asked for.
  Subject& add(const BlockType& type) {
    Subject& subject = subjects_.emplace_back(type);
    for (const Pin& pin : type.pins)
      if (pin.type == Type::AXIS) subject.wire(pin, pin.name == "Master" ? &leading : &following);
    return subject;
  }

  /// Leading axis running, following axis homed and at rest.
  void ready() {
    run(3);
    run_leading.Execute = home_following.Execute = true;
    run(4);
    home_following.Execute = false;
    run(2);
  }

  void tick() noexcept {
    {
      const std::uint64_t before = allocations_counted();
      const CountAllocations count;
      controller.tick();
      for (Block* block : support_) block->call(now());
      for (Subject& subject : subjects_) subject.block().call(now());
      allocations += allocations_counted() - before;
    }
    for (Subject& subject : subjects_)
      if (const char* wrong = subject.wrong_outputs()) fault(subject.name() + ": " + wrong);
    watch(leading, last_[0]);
    watch(following, last_[1]);
  }

  void run(int ticks) noexcept {
    for (int i = 0; i < ticks; ++i) tick();
  }

  template <class Condition>
  bool run_until(Condition condition, int most) {
    for (int i = 0; i < most; ++i) {
      tick();
      if (condition()) return true;
    }
    return false;
  }

  /// Notes what went wrong; the first is kept.
  void fault(const std::string& text) {
    if (!first_fault.empty()) return;
    std::ostringstream note;
    note << text << " (at " << static_cast<double>(now()) * 1e-9 << " s)";
    first_fault = note.str();
  }

  /// The position of the following axis is renamed: homing, restart.
  void allow_position_step() noexcept { position_steps_ = true; }

  /// Whether the following axis is braking from beyond what its ramp can brake in kStoppingTicks.
  bool brakes_for_long() const noexcept {
    const Setpoint& s = following.setpoint();
    const double seconds = kStoppingTicks * static_cast<double>(BenchLimits::kPeriod) * 1e-9;
    return s.velocity * s.acceleration < 0.0 && std::abs(s.velocity) > BenchLimits::kEmergency * seconds;
  }

  std::int64_t now() const noexcept { return controller.now() - BenchLimits::kPeriod; }

  Controller controller;
  Axis& leading;
  Axis& following;
  MC_Power power_leading, power_following;
  MC_MoveVelocity run_leading;
  MC_Home home_following;
  MC_Reset reset_following;
  MC_MoveRelative relative_following;
  std::uint64_t allocations = 0;
  std::string first_fault;

 private:
  struct Last {
    bool known = false;
    bool coupled = false;
    bool beyond_limits = false;  // left there by a coupling
    Setpoint setpoint;
  };

  Axis& make_axis(const char* name, bool modulo) {
    Axis& axis = controller.add_axis(ObjectKind::TO_SynchronousAxis, name);
    axis.data.VirtualAxis.Mode = 1;
    axis.data.Modulo.Enable = modulo;
    axis.data.Modulo.Length = BenchLimits::kLeadingLength;
    axis.data.DynamicLimits = {BenchLimits::kVelocity, BenchLimits::kVelocity, BenchLimits::kAcceleration,
                               BenchLimits::kAcceleration, BenchLimits::kJerk};
    axis.data.DynamicDefaults.Jerk = 20000.0;
    axis.data.DynamicDefaults.EmergencyDeceleration = BenchLimits::kEmergency;
    return axis;
  }

  /// Finite at any time. While the axis moves on its own: no step of position or velocity, and inside the
  /// limits unless a coupling has left it beyond them.
  void watch(const Axis& axis, Last& last) noexcept {
    const Setpoint& s = axis.setpoint();
    const Last before = last;
    last.known = true;
    last.coupled = has_bit(axis.data.StatusWord, StatusBit::Synchronizing) ||
                   has_bit(axis.data.StatusWord, StatusBit::Synchronous);
    last.setpoint = s;
    if (!std::isfinite(s.position.value) || !std::isfinite(s.velocity) || !std::isfinite(s.acceleration))
      return fault(axis.name + ": setpoint not finite");
    const bool speeding_up = s.velocity * s.acceleration > 0.0;
    if (last.coupled) last.beyond_limits = true;
    if (!before.known || last.coupled || before.coupled) return;
    if (axis.pending_alarm() == alarm::kPositionRangeExceeded) return;  // at the end of the numbers it stands
    const double v = std::abs(s.velocity), a = std::abs(s.acceleration);
    if (v <= BenchLimits::kVelocity && !speeding_up) last.beyond_limits = false;
    const double was_a = std::abs(before.setpoint.acceleration);
    if (!last.beyond_limits && v > BenchLimits::kVelocity * (1 + kSlack))
      fault(axis.name + ": velocity " + std::to_string(s.velocity) + " beyond its limit");
    const double most_a = speeding_up ? BenchLimits::kAcceleration : BenchLimits::kEmergency;
    if (a > std::max(most_a, was_a) * (1 + kSlack))
      fault(axis.name + ": acceleration " + std::to_string(s.acceleration) + " beyond its limit");
    watch_steps(axis, before.setpoint, s);
  }

  void watch_steps(const Axis& axis, const Setpoint& before, const Setpoint& s) noexcept {
    constexpr double kPeriod = static_cast<double>(BenchLimits::kPeriod) * 1e-9;
    const double most_a = std::max(BenchLimits::kEmergency, std::abs(before.acceleration));
    if (std::abs(s.velocity - before.velocity) > most_a * kPeriod * (1 + kSlack) + kSlack)
      fault(axis.name + ": step of the velocity from " + std::to_string(before.velocity) + " to " +
            std::to_string(s.velocity));
    if (position_steps_) return;
    const double way = difference(s.position, before.position, axis.modulo()).rounded();
    const double mean = 0.5 * (s.velocity + before.velocity) * kPeriod;
    const double rounding = 1e-12 * std::abs(s.position.value);
    if (std::abs(way - mean) > most_a * kPeriod * kPeriod + rounding + kSlack)
      fault(axis.name + ": step of the position by " + std::to_string(way));
  }

  static constexpr double kSlack = 1e-9;

  std::vector<Block*> support_;
  std::deque<Subject> subjects_;
  Last last_[2];
  bool position_steps_ = false;
};

}  // namespace lockstep::test
