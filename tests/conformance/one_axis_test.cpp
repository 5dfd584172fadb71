// Short random sequences of jobs on one axis, virtual or with a drive that moves a machine, with faults,
// torque limits, overrides, changing limits, software limit switches, resets and disabling: no setpoint
// leaves its limits, jumps or is not finite, and every job that an instance shows ends in exactly one way.
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "fb/power.hpp"
#include "scheduler/controller.hpp"
#include "tests/conformance/subject.hpp"
#include "tests/support/property.hpp"

namespace lockstep::test::one_axis_test {
namespace {

constexpr std::uint64_t kFirstSeed = 20260;
constexpr int kSequencesOfASeed = 100;  // on one machine, one after another
constexpr int kSeeds = 1000;            // a hundredth of the soak
constexpr int kSoakSeeds = 100000;      // 10^7 sequences
constexpr int kMaximumActions = 6;
constexpr int kMaximumWait = 14;     // [ticks] between two actions
constexpr int kLongWait = 150;       // seldom
constexpr int kRunDown = 200;        // [ticks] to run an acceleration down that a lowered limit finds
constexpr int kStoppingTicks = 400;  // within which an axis is surely off

constexpr std::int64_t kPeriod = 4'000'000;  // [ns]
constexpr double kSeconds = 0.004;
constexpr double kVelocity = 500.0;       // [u/s]
constexpr double kAcceleration = 5000.0;  // [u/s²]
constexpr double kEmergency = 20000.0;    // [u/s²]
constexpr double kJerk = 100000.0;        // [u/s³]
constexpr double kSlack = 1e-9;

/// What is in force at the end of a tick.
struct Seen {
  Setpoint setpoint;
  Setpoint led;                  // the setpoint as axes see it that follow
  double actual_velocity = 0.0;  // [u/s]
  bool enabled = false;
  bool controlled = true;
  bool clamped = false;
  bool homed = false;
  bool inside = false;  // of the software limit switches, with no alarm about them
  double limit = kVelocity;
};

/// What has come up, to know that the sequences are about something.
struct Counts {
  std::uint64_t ticks = 0;
  std::uint64_t clampings = 0;
  std::uint64_t alarms = 0;
  std::uint64_t done = 0;
};

class OneAxis {
 public:
  OneAxis(std::uint64_t seed, bool told, Counts& counts)
      : random_(seed), told_(told), counts_(counts), axis_(make_axis(chance(0.5))) {
    controller_.clock = {kPeriod, 1};
    controller_.finish();
    power_.Axis = &axis_;
    for (const BlockType& type : block_types())
      if (fits(type)) add(type);
  }

  /// What went wrong first; empty if nothing did.
  std::string run() {
    for (int i = 0; i < kSequencesOfASeed && fault_.empty(); ++i) sequence();
    return fault_;
  }

 private:
  /// Setpoints that are given may jump, and others need more than one axis.
  static bool fits(const BlockType& type) {
    const Pin* axis = type.find_pin("Axis");
    return axis != nullptr && among(ObjectKind::TO_SynchronousAxis, axis->objects) &&
           type.name != "MC_Power" && type.name != "MC_LeadingValueAdditive" &&
           !type.name.starts_with("MC_MotionIn") && Subject(type).start_pin() != nullptr;
  }

  void add(const BlockType& type) {
    for (int instance = 0; instance < 2; ++instance)
      subjects_.emplace_back(type).wire(*type.find_pin("Axis"), &axis_);
    quiet_.resize(subjects_.size());
  }

  Axis& make_axis(bool driven) {
    Axis& axis = controller_.add_axis(ObjectKind::TO_PositioningAxis, "Axis");
    axis.data.VirtualAxis.Mode = driven ? 0 : 1;
    axis.data.Modulo.Enable = chance(0.3);
    axis.data.DynamicLimits = {kVelocity, kVelocity, kAcceleration, kAcceleration, kJerk};
    axis.data.DynamicDefaults.Jerk = 20000.0;
    axis.data.DynamicDefaults.EmergencyDeceleration = kEmergency;
    axis.data.PositionLimits_SW.MinPosition = -150.0;
    axis.data.PositionLimits_SW.MaxPosition = 180.0;
    axis.data.PositioningMonitoring = {0.05, 0.008, 2.0};
    axis.data.Clamping = {1.5, 0.5};
    axis.data.Actor.Interface.EnableTorqueData = true;
    axis.data.PositionControl.Kv = 40.0;
    DriveSettings& drive = axis.drive_settings;
    drive.time_constant = 0.005;
    drive.quick_stop = 10000.0;
    drive.faults = {&faults_[0], &faults_[1], &faults_[2], &faults_[3]};
    drive.signals.zero_marks = ZeroMarks{7.0, 40.0};
    if (chance(0.8)) drive.plant = {.inertia = 0.001, .friction = 0.2, .maximum_torque = 15.0};
    if (chance(0.5)) {
      drive.plant.has_stop = true;
      drive.plant.stop = {uniform(5.0, 60.0), 1, 500.0};
    }
    return axis;
  }

  // ---- Randomness
  // -----------------------------------------------------------------------------------------------

  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  int pick(int count) { return static_cast<int>(random_() % static_cast<std::uint64_t>(count)); }
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
  }

  void sequence() {
    make_ready();
    const int actions = 1 + pick(kMaximumActions);
    for (int i = 0; i < actions && fault_.empty(); ++i) {
      act();
      const int maximum_wait = chance(0.1) ? kLongWait : kMaximumWait;
      for (int wait = pick(maximum_wait); wait >= 0; --wait) tick();
    }
    finish();
  }

  void act() {
    const int kind = pick(100);
    AxisData& data = axis_.data;
    if (kind < 5) return set_fault(pick(4), !faults_[pick(4)]);
    if (kind < 10) {
      constexpr double kOverrides[] = {0.0, 10.0, 50.0, 100.0, 100.0, 150.0, 200.0};
      data.Override.Velocity = kOverrides[pick(7)];
    } else if (kind < 14) {
      data.DynamicLimits.Velocity = chance(0.5) ? kVelocity : uniform(20.0, kVelocity);
    } else if (kind < 18) {
      data.PositionLimits_SW.Active = !data.PositionLimits_SW.Active;
    } else if (kind < 24) {
      power_.Enable = !power_.Enable;
      power_.StopMode = static_cast<INT>(pick(4));
      power_.StartMode = chance(0.8) ? 1 : 0;
    } else {
      return use(subjects_[static_cast<std::size_t>(pick(static_cast<int>(subjects_.size())))]);
    }
    if (told_) std::printf("%.3f s action %d\n", now(), kind);
  }

  void set_fault(int index, bool value) {
    faults_[index] = value;
    if (told_) std::printf("%.3f s fault %d %d\n", now(), index, value);
  }

  /// Starts a block with inputs at random, starts it anew in mid-job, or drops its request.
  void use(Subject& subject) {
    if (subject.on_start()) {
      subject.start(false);
      if (chance(0.5)) return;
      tick();
    }
    for (const Pin& pin : subject.type().pins)
      if (pin.pin_class == PinClass::input && pin.type != Type::AXIS) set_at_random(subject, pin);
    const std::string_view name = subject.type().name;
    if (name == "MC_Home" || name == "MC_Reset") positions_may_step_ = 600;  // homing ends later
    subject.start(true);
    if (told_) tell(subject);
  }

  void set_at_random(Subject& subject, const Pin& pin) {
    if (pin.type == Type::BOOL)
      return subject.store(pin, chance(pin.name == "PositionControlled" ? 0.8 : 0.2) ? 1.0 : 0.0);
    if (!pin.choices.empty())
      return subject.store(
          pin, static_cast<double>(
                   pin.choices[static_cast<std::size_t>(pick(static_cast<int>(pin.choices.size())))].value));
    if (is_integer(pin.type)) return subject.store(pin, pick(6));
    subject.store(pin, number_for(pin));
  }

  double number_for(const Pin& pin) {
    if (chance(0.01)) return NAN;
    switch (pin.unit) {
      case Unit::kVelocity:
        return chance(0.3) ? -1.0 : uniform(-600.0, 600.0);
      case Unit::kAcceleration:
        return chance(0.3) ? -1.0 : uniform(50.0, 6000.0);
      case Unit::kJerk:
        return chance(0.3) ? -1.0 : chance(0.2) ? 0.0 : uniform(500.0, 150000.0);
      case Unit::kTorque:
        if (pin.name == "LowerLimit") return uniform(-15.0, 0.0);  // or the motor could but run away
        return uniform(pin.name == "UpperLimit" ? 0.0 : -3.0, 15.0);
      default:
        return uniform(-200.0, 200.0);
    }
  }

  // ---- From one sequence to the next
  // ----------------------------------------------------------------------------

  void make_ready() {
    axis_.data.Override.Velocity = 100.0;
    axis_.data.DynamicLimits.Velocity = kVelocity;
    axis_.data.PositionLimits_SW.Active = false;
    if (Subject* reset = find("MC_Reset")) {
      reset->set("Restart", 0.0);
      reset->start(true);
      for (int i = 0; i < 3; ++i) tick();
      reset->start(false);
    }
    if (axis_.pending_alarm() != 0)
      note("alarm " + std::to_string(axis_.pending_alarm()) + " cannot be acknowledged");
    power_.StartMode = 1;
    power_.Enable = true;
    for (int i = 0; i < kStoppingTicks && !power_.Status; ++i) tick();  // a drive may still stop by itself
    if (!power_.Status) note("the axis cannot be enabled again");
  }

  /// Disabled and without requests, the axis comes to rest and no block is left with a job.
  void finish() {
    for (bool& fault : faults_) fault = false;
    for (Subject& subject : subjects_) subject.start(false);
    power_.Enable = false;
    for (int i = 0; i < 4; ++i) tick();  // what is under way, such as an MC_Reset, comes to its end
    for (int i = 0; i < kStoppingTicks && !axis_.off(); ++i) tick();
    tick();
    if (!axis_.off()) return note("the axis does not stop");
    for (Subject& subject : subjects_)
      if (subject.busy()) note(subject.name() + " is Busy on a disabled axis");
    positions_may_step_ = 0;
  }

  Subject* find(std::string_view name) {
    for (Subject& subject : subjects_)
      if (subject.type().name == name) return &subject;
    return nullptr;
  }

  // ---- One tick
  // -------------------------------------------------------------------------------------------------

  void tick() {
    controller_.tick();
    const std::int64_t t = controller_.now() - kPeriod;
    power_.call(t);
    for (std::size_t i = 0; i < subjects_.size(); ++i) call(subjects_[i], quiet_[i], t);
    count();
    watch();
    if (positions_may_step_ > 0) --positions_may_step_;
    if (lowered_ticks_ > 0) --lowered_ticks_;
  }

  /// A block without a request that has shown its end has nothing to say until the next request.
  void call(Subject& subject, bool& quiet, std::int64_t t) {
    if (quiet && !subject.on_start()) return;
    if (const char* wrong = subject.call(t)) note(subject.name() + ": " + wrong);
    quiet = !subject.on_start() && !subject.busy() && !subject.ended() && subject.type().name != "MC_MoveJog";
  }

  void count() {
    ++counts_.ticks;
    const int alarm_now = axis_.pending_alarm();
    if (alarm_now != 0 && !alarmed_) ++counts_.alarms;
    alarmed_ = alarm_now != 0;
    const bool clamped = axis_.clamping().holds();
    if (clamped && !last_.clamped) ++counts_.clampings;
    if (find("MC_MoveRelative")->done()) ++counts_.done;
  }

  void watch() {
    const Seen before = last_;
    last_.setpoint = axis_.setpoint();
    last_.led = axis_.position_controlled() ? axis_.led_setpoint() : axis_.setpoint();
    last_.actual_velocity = axis_.data.ActualVelocity;
    last_.enabled =
        has_bit(axis_.data.StatusWord, StatusBit::Enable) || (axis_.stopping() && follows_setpoint());
    last_.controlled = axis_.position_controlled();
    last_.clamped = has_bit(axis_.data.StatusWord, StatusBit::InClamping);
    last_.homed = has_bit(axis_.data.StatusWord, StatusBit::HomingDone);
    last_.limit = axis_.data.DynamicLimits.Velocity;
    last_.inside = false;
    watch_lowering(before);
    const Setpoint& s = last_.setpoint;
    if (!std::isfinite(s.position.value) || !std::isfinite(s.velocity) || !std::isfinite(s.acceleration))
      return note("setpoint not finite");
    // A drive that is off leads its setpoint; position control is taken up where the axis is; and a fixed
    // stop freezes the setpoint.
    const bool driven = !axis_.is_virtual();
    if (driven && (!before.enabled || !last_.enabled || before.controlled != last_.controlled))
      return watch_hand_over(before);
    if (axis_.clamping().found() || before.clamped) return;
    watch_limits(before);
    watch_steps(before);
  }

  /// While it brakes a disabled axis still has a setpoint of its own.
  bool follows_setpoint() const {
    return axis_.is_virtual() || bit_of(axis_.drive().words().zsw1, zsw1::kOperationEnabled);
  }

  /// In every tick, also in one whose setpoint is not looked at: the motion may come down from the limit of
  /// before long after the tick in which it was lowered.
  void watch_lowering(const Seen& before) {
    if (last_.limit >= before.limit) return;
    lowered_from_ = std::max(before.limit, lowered_ticks_ > 0 ? lowered_from_ : 0.0);
    lowered_ticks_ = kRunDown;
  }

  void watch_limits(const Seen& before) {
    const Setpoint& s = last_.setpoint;
    const double lowered = lowered_ticks_ > 0 ? lowered_from_ : 0.0;
    const double maximum_v = std::max({last_.limit, lowered, std::abs(before.setpoint.velocity)});
    if (std::abs(s.velocity) > maximum_v * (1 + kSlack) && !lands_on_actual(before) && !brakes_from_actual())
      note("velocity " + std::to_string(s.velocity) + " beyond its limit");
    const bool speeding_up = s.velocity * s.acceleration > 0.0;
    const double maximum_a =
        std::max(speeding_up ? kAcceleration : kEmergency, std::abs(before.setpoint.acceleration));
    // Two motions, one on top of the other, may each have the acceleration that is left to it.
    if (std::abs(s.acceleration) > maximum_a * (1 + kSlack))
      note("acceleration " + std::to_string(s.acceleration) + " beyond its limit");
    watch_position_limits(before.inside);
  }

  /// An axis that was within its software limit switches stays there, or says that it could not.
  void watch_position_limits(bool was_inside) {
    const auto& limits = axis_.data.PositionLimits_SW;
    const double place = last_.setpoint.position.value;
    const bool inside = limits.Active && last_.homed && !axis_.data.Modulo.Enable &&
                        place >= limits.MinPosition - 1e-6 && place <= limits.MaxPosition + 1e-6;
    const bool told = has_bit(axis_.data.ErrorWord, ErrorBit::SWLimit);
    if (was_inside && limits.Active && last_.homed && positions_may_step_ == 0 && !inside && !told)
      note("beyond a software limit switch at " + std::to_string(place));
    last_.inside = inside;
  }

  /// Whether the setpoint has stepped towards the actual velocity: there, or where a drive that brakes
  /// already has been told to be, the emergency ramp of a driven axis begins.
  bool lands_on_actual(const Seen& before) const {
    constexpr double kOfATick = kEmergency * kSeconds * (1 + kSlack) + kSlack;
    const double v = last_.setpoint.velocity, actual = last_.actual_velocity;
    return !axis_.is_virtual() && std::abs(v - before.setpoint.velocity) > kOfATick &&
           v >= std::min(actual, 0.0) - kOfATick && v <= std::max(actual, 0.0) + kOfATick;
  }

  /// Whether the emergency ramp of a driven axis is no faster than that already is: it begins with the actual
  /// velocity, which is beyond the limit where a drive that was held back comes after its setpoint.
  bool brakes_from_actual() const {
    const Setpoint& s = last_.setpoint;
    return !axis_.is_virtual() && s.velocity * s.acceleration < 0.0 &&
           std::abs(s.acceleration) == kEmergency && s.velocity * last_.actual_velocity > 0.0 &&
           std::abs(s.velocity) <= std::abs(last_.actual_velocity);
  }

  /// Such a step is none for axes that follow; without position control nobody follows.
  void watch_steps(const Seen& before) {
    if (!last_.controlled && lands_on_actual(before)) return;
    const Setpoint& s = last_.led;
    const double at_ticks = std::max(std::abs(before.led.acceleration), std::abs(s.acceleration));
    // A motion on top of the ramp, which may be over within the tick.
    const bool handed_over = s.position != last_.setpoint.position ||
                             before.led.position != before.setpoint.position || lands_on_actual(before);
    const double maximum =
        std::max(handed_over ? kEmergency + kAcceleration : kEmergency, at_ticks) * kSeconds;
    if (std::abs(s.velocity - before.led.velocity) > maximum * (1 + kSlack) + kSlack)
      note("step of the velocity from " + std::to_string(before.led.velocity) + " to " +
           std::to_string(s.velocity));
    if (positions_may_step_ > 0) return;
    const double distance = difference(s.position, before.led.position, axis_.modulo()).rounded();
    const double mean = 0.5 * (s.velocity + before.led.velocity) * kSeconds;
    if (std::abs(distance - mean) > maximum * kSeconds + kSlack)
      note("step of the position by " + std::to_string(distance));
  }

  /// Where the setpoint goes over to the actual value and back, axes that follow see no step. A machine that
  /// is blocked stands at once, one that is heard of again moves at once: half of its way within a tick.
  void watch_hand_over(const Seen& before) {
    if (!before.controlled || !last_.controlled || positions_may_step_ > 0) return;
    const double distance = difference(last_.led.position, before.led.position, axis_.modulo()).rounded();
    const double mean = 0.5 * (last_.led.velocity + before.led.velocity) * kSeconds;
    const double fastest =
        std::max({kVelocity, std::abs(last_.setpoint.velocity), std::abs(before.setpoint.velocity)});
    constexpr double kOfJerk = kJerk * kSeconds * kSeconds * kSeconds / 12.0;  // of the way back from before
    if (std::abs(distance - mean) > 0.5 * fastest * kSeconds * (1 + kSlack) + kOfJerk)
      note("step of the leading position by " + std::to_string(distance - mean));
  }

  double now() const { return static_cast<double>(controller_.now()) * 1e-9; }

  void note(const std::string& text) {
    if (!fault_.empty()) return;
    std::ostringstream told;
    told << text << " (at " << now() << " s, " << (axis_.is_virtual() ? "virtual" : "driven") << ")";
    fault_ = told.str();
  }

  void tell(Subject& subject) {
    std::printf("%.3f s %s, v %.17g a %.17g:", now(), subject.name().c_str(), axis_.setpoint().velocity,
                axis_.setpoint().acceleration);
    for (const Pin& pin : subject.type().pins)
      if (pin.pin_class == PinClass::input && pin.type != Type::AXIS)
        std::printf(" %s=%.17g", std::string(pin.name).c_str(), subject.number(pin));
    std::printf("\n");
  }

  std::mt19937_64 random_;
  bool told_;
  Counts& counts_;
  bool faults_[4] = {};
  Controller controller_;
  Axis& axis_;
  MC_Power power_;
  std::deque<Subject> subjects_;
  std::deque<bool> quiet_;
  Seen last_;
  bool alarmed_ = false;
  int positions_may_step_ = 0;  // [ticks]
  double lowered_from_ = 0.0;   // limit of the velocity, before it was lowered
  int lowered_ticks_ = 0;       // in which the acceleration of before is still run down
  std::string fault_;
};

TEST(OneAxisSequences, OfJobsFaultsAndLimitsKeepTheSetpointInOrder) {
  Counts counts;
  const Cases ran = for_each_seed(kFirstSeed, cases(kSeeds, kSoakSeeds), [&](const Case& one) {
    EXPECT_EQ(OneAxis(one.seed, one.alone, counts).run(), "");
  });
  if (ran.alone) return;
  EXPECT_GT(counts.clampings, static_cast<std::uint64_t>(ran.count) / 20);
  EXPECT_GT(counts.alarms, static_cast<std::uint64_t>(ran.count));
  EXPECT_GT(counts.done, static_cast<std::uint64_t>(ran.count));
  std::printf("%d sequences: %llu ticks, %llu alarms, %llu clampings\n", ran.count * kSequencesOfASeed,
              static_cast<unsigned long long>(counts.ticks), static_cast<unsigned long long>(counts.alarms),
              static_cast<unsigned long long>(counts.clampings));
}

}  // namespace
}  // namespace lockstep::test::one_axis_test
