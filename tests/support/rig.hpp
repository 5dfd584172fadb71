/// A machine on the bench: axes and block instances in virtual time, watched at every tick.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fb/home.hpp"
#include "scheduler/controller.hpp"

namespace lockstep::test {

/// What an axis may do between two ticks; the rig asserts it at each of them.
struct Continuity {
  bool velocity =
      true;  ///< no step of the position beyond the velocity, none of the velocity beyond the acceleration
  bool acceleration = true;           ///< no step of the acceleration beyond the jerk
  double highest_acceleration = 1e5;  ///< [u/s²]
  double highest_jerk = 5e6;          ///< [u/s³]
  bool homing = false;                ///< the position may step in the tick in which it is renamed
};

/// Builds a controller, calls blocks in the order in which they were made, once per tick after the
/// interpolator.
class Rig {
 public:
  explicit Rig(std::int64_t servo_cycle = 1'000'000, int ratio = 1) {
    controller.clock = {servo_cycle, ratio};
  }

  /// A virtual axis of the kind TO_SynchronousAxis.
  Axis& axis(const std::string& name, const std::function<void(AxisData&)>& configure = {}) {
    Axis& made = controller.add_axis(ObjectKind::TO_SynchronousAxis, name);
    made.data.VirtualAxis.Mode = 1;
    if (configure) configure(made.data);
    continuity.emplace_back();
    return made;
  }

  /// Interconnects a leading value by its setpoint.
  void lead(Axis& following, Axis& leading) {
    following.leading_values.push_back({&leading, Coupling::setpoint});
  }

  template <class B>
  B& block() {
    auto made = std::make_unique<B>();
    B& reference = *made;
    blocks_.push_back(std::move(made));
    return reference;
  }

  /// Calls an axis homed where it is, with the first calls of blocks: MC_Home Mode 1 by 0.
  void home_in_place(Axis& axis) {
    auto& home = block<MC_Home>();
    home.Axis = &axis;
    home.Mode = 1;
    home.Execute = true;
  }

  /// One tick: the cycle, then the blocks.
  void tick() {
    if (!finished_) {
      controller.finish();
      finished_ = true;
    }
    controller.tick();
    const std::int64_t now = controller.now() - controller.clock.servo_cycle;
    for (auto& block : blocks_) block->call(now);
    for (std::size_t i = 0; i < controller.axes.size(); ++i) watch(i);
  }

  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) tick();
  }

  /// Runs until a condition holds; fails after `maximum` ticks.
  ::testing::AssertionResult run_until(const std::function<bool()>& condition, int maximum = 20000) {
    for (int i = 0; i < maximum; ++i) {
      tick();
      if (condition()) return ::testing::AssertionSuccess();
    }
    return ::testing::AssertionFailure() << "not within " << maximum << " ticks";
  }

  double period() const { return static_cast<double>(controller.clock.interpolator_cycle()) * 1e-9; }

  Controller controller;
  std::vector<Continuity> continuity;  ///< of each axis, in the order in which they were made

 private:
  struct Last {
    bool known = false;
    DoubleDouble names;  // by what homing has renamed positions [u]
    Setpoint setpoint;
  };

  void watch(std::size_t index) {
    const Axis& axis = *controller.axes[index];
    const Continuity& rule = continuity[index];
    const Setpoint& now = axis.setpoint();
    last_.resize(controller.axes.size());
    const Last last = last_[index];
    last_[index] = {true, axis.renamed(), now};
    ASSERT_TRUE(std::isfinite(now.position.value) && std::isfinite(now.velocity) &&
                std::isfinite(now.acceleration))
        << axis.name << " at " << controller.now();
    if (last.known && controller.counters().interpolator_ticks != seen_ && rule.velocity) {
      const double dt = period();
      const double distance = difference(now.position, last.setpoint.position, axis.modulo()).rounded();
      const double mean = 0.5 * (now.velocity + last.setpoint.velocity) * dt;
      const double slack = rule.highest_acceleration * dt * dt + 1e-9;
      const bool renamed = rule.homing && (axis.renamed() - last.names).rounded() != 0.0;
      ASSERT_TRUE(renamed || std::abs(distance - mean) <= slack)
          << axis.name << ": step of the position by " << distance - mean << " at " << controller.now();
      ASSERT_LE(std::abs(now.velocity - last.setpoint.velocity),
                rule.highest_acceleration * dt * (1 + 1e-9) + 1e-9)
          << axis.name << ": step of the velocity at " << controller.now();
      if (rule.acceleration) {
        ASSERT_LE(std::abs(now.acceleration - last.setpoint.acceleration),
                  rule.highest_jerk * dt * (1 + 1e-9) + 1e-6)
            << axis.name << ": step of the acceleration at " << controller.now();
      }
    }
    if (index + 1 == controller.axes.size()) seen_ = controller.counters().interpolator_ticks;
  }

  std::vector<std::unique_ptr<Block>> blocks_;
  std::vector<Last> last_;
  std::uint64_t seen_ = 0;
  bool finished_ = false;
};

/// A bit of the status word.
inline bool bit(const Axis& axis, StatusBit which) {
  return has_bit(axis.data.StatusWord, which);
}

}  // namespace lockstep::test
