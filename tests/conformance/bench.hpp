/// A leading and a following axis, two cams and the blocks that ready them, watched at every tick.
#pragma once

#include <cmath>
#include <deque>
#include <sstream>
#include <string>
#include <vector>

#include "fb/cam_in.hpp"
#include "fb/gear_in.hpp"
#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "fb/superimposed.hpp"
#include "scheduler/controller.hpp"
#include "tech_objects/sensing/measuring_input.hpp"
#include "tech_objects/switching/cam_track.hpp"
#include "tech_objects/switching/output_cam.hpp"
#include "tests/conformance/subject.hpp"
#include "tests/support/allocations.hpp"

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
  /// @param driven whether the following axis has a drive, with a zero mark that is far away
  explicit Bench(bool modulo = false, bool enable_following = true, bool driven = false)
      : leading(make_axis("Leading", true)),
        following(make_axis("Following", modulo)),
        cam(make_cam("Wave", {{0.0, 0.0}, {25.0, 10.0}, {50.0, 20.0}, {75.0, 10.0}, {100.0, 0.0}})),
        straight(make_cam("Straight", {{0.0, 0.0}, {50.0, 50.0}, {100.0, 100.0}})) {
    if (driven) {
      following.data.VirtualAxis.Mode = 0;
      following.data.Actor.Interface.EnableTorqueData = true;
      following.drive_settings.signals.zero_marks = ZeroMarks{1e6, 0.0};
      following.drive_settings.signals.limit_min = -1e9;
    }
    controller.clock = {BenchLimits::kPeriod, 1};
    input.measured = &leading;
    output_cam.assigned = cam_track.assigned = &leading;
    input.marks = PrintMarks{.period = 10.0, .offset = 3.0, .width = 4.0};
    following.leading_values.push_back({&leading, Coupling::setpoint});
    following.data.Modulo.Length = 360.0;
    controller.finish();
    power_leading.Axis = run_leading.Axis = &leading;
    power_following.Axis = home_following.Axis = &following;
    reset_following.Axis = relative_following.Axis = &following;
    superimposed_following.Axis = &following;
    gear_following.Master = &leading;
    gear_following.Slave = &following;
    cam_following.Master = &leading;
    cam_following.Slave = &following;
    cam_following.Cam = &straight;
    power_leading.Enable = true;
    run_leading.Velocity = BenchLimits::kLeadingVelocity;
    power_following.Enable = enable_following;
    support_ = {&power_leading, &run_leading};
    if (enable_following) support_.push_back(&power_following);
    for (Block* block : {static_cast<Block*>(&home_following), static_cast<Block*>(&reset_following),
                         static_cast<Block*>(&relative_following), static_cast<Block*>(&gear_following),
                         static_cast<Block*>(&cam_following), static_cast<Block*>(&superimposed_following)})
      support_.push_back(block);
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  /// A block on the bench: its object pins are wired, a leading axis where one is asked for.
  Subject& add(const BlockType& type) {
    Subject& subject = subjects_.emplace_back(type);
    subject.block().connect(controller.encoder_saving);
    for (const Pin& pin : type.pins) {
      if (pin.type == Type::AXIS) subject.wire(pin, object_for(pin));
      if (pin.type == Type::ARRAY) subject.wire_array(pin, array_for(pin));
    }
    return subject;
  }

  /// An object of a kind that the pin takes.
  TechnologyObject* object_for(const Pin& pin) noexcept {
    if (pin.objects == kAnyCam) return &cam;
    if (among(ObjectKind::TO_SynchronousAxis, pin.objects))
      return pin.name == "Master" ? &leading : &following;
    if (pin.objects == kOutputCam) return &output_cam;
    if (pin.objects == kCamTrack) return &cam_track;
    return &input;
  }

  /// An array of the elements that the pin takes.
  const Array* array_for(const Pin& pin) const noexcept {
    return pin.element == &kCamPointElement ? &points_array : &segments_array;
  }

  /// Leading axis running, following axis homed and at rest.
  void ready() {
    run(3);
    run_leading.Execute = home_following.Execute = true;
    run(4);
    home_following.Execute = false;
    run(2);
  }

  /// The following axis runs synchronously with the leading one.
  void couple() {
    gear_following.Execute = true;
    if (!run_until([&] { return gear_following.InGear; }, 500)) fault("the axis cannot be coupled");
    gear_following.Execute = false;
    run(1);
  }

  /// The following axis follows a straight cam that goes on for ever.
  void couple_to_cam() {
    cam_following.SyncProfileReference = 4;
    cam_following.MasterStartDistance = 20.0;
    cam_following.ApplicationMode = 2;
    cam_following.Execute = true;
    if (!run_until([&] { return cam_following.InSync; }, 2000)) fault("the axis cannot follow a cam");
    cam_following.Execute = false;
    run(1);
  }

  /// What a block needs that acts on a coupled axis.
  void couple_for(std::string_view block) { block == "MC_CamOut" ? couple_to_cam() : couple(); }

  void tick() noexcept {
    const char* wrong = nullptr;
    const Subject* culprit = nullptr;
    {
      const std::uint64_t before = allocations_counted();
      const CountAllocations count;
      controller.tick();
      for (Block* block : support_) block->call(now());
      for (Subject& subject : subjects_)
        if (const char* found = subject.call(now()); found != nullptr && wrong == nullptr) {
          wrong = found;
          culprit = &subject;
        }
      allocations += allocations_counted() - before;
    }
    if (wrong != nullptr) fault(culprit->name() + ": " + wrong);
    watch(leading, last_[0]);
    watch(following, last_[1]);
  }

  void run(int ticks) noexcept {
    for (int i = 0; i < ticks; ++i) tick();
  }

  template <class Condition>
  bool run_until(Condition condition, int maximum) {
    for (int i = 0; i < maximum; ++i) {
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

  /// Positions may be renamed in the next ticks: homing, restart.
  void allow_position_steps(std::uint64_t ticks) noexcept {
    position_steps_until_ = controller.counters().ticks + ticks;
  }

  /// Setpoints may jump, and be beyond the limits, in the next ticks: they are given.
  void allow_jumps(std::uint64_t ticks) noexcept {
    jumps_until_ = std::max(jumps_until_, controller.counters().ticks + ticks);
  }

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
  MeasuringInput& input =
      static_cast<MeasuringInput&>(controller.add_object(ObjectKind::TO_MeasuringInput, "Input"));
  OutputCam& output_cam =
      static_cast<OutputCam&>(controller.add_object(ObjectKind::TO_OutputCam, "OutputCam"));
  CamTrack& cam_track = static_cast<CamTrack&>(controller.add_object(ObjectKind::TO_CamTrack, "CamTrack"));
  Cam& cam;
  Cam& straight;
  MC_Power power_leading, power_following;
  MC_MoveVelocity run_leading;
  MC_Home home_following;
  MC_Reset reset_following;
  MC_MoveRelative relative_following;
  MC_GearIn gear_following;
  MC_CamIn cam_following;
  MC_MoveSuperimposed superimposed_following;
  std::vector<TO_Cam_Struct_PointData> points = std::vector<TO_Cam_Struct_PointData>(21);
  std::vector<TO_Cam_Struct_SegmentData> segments = std::vector<TO_Cam_Struct_SegmentData>(21);
  Array points_array{&kCamPointElement, 0, 20, points.data()};
  Array segments_array{&kCamSegmentElement, 0, 20, segments.data()};
  std::uint64_t allocations = 0;
  std::string first_fault;
  /// Whether a coupled axis is held to have no steps, too: with synchronizing distances of many cycles only.
  bool watch_coupled = false;

 private:
  struct Last {
    bool known = false;
    bool coupled = false;
    double actual_velocity = 0.0;    // [u/s]
    double function_velocity = 0.0;  // of the coupling, without what is superimposed [u/s]
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

  Cam& make_cam(const char* name, const std::vector<TO_Cam_Struct_PointData>& points) {
    Cam& made = static_cast<Cam&>(controller.add_object(ObjectKind::TO_Cam, name));
    static_cast<CamData1k*>(made.data_block())->InterpolationSettings = {1, 1};
    for (std::size_t i = 0; i < points.size(); ++i) made.define_point(i, points[i]);
    CamInterpolator interpolator(kCamPoints);
    made.interpolate(interpolator);
    return made;
  }

  /// Finite at any time. While the axis moves on its own: no step of position or velocity, and inside the
  /// limits or on the way into them.
  void watch(const Axis& axis, Last& last) noexcept {
    const Setpoint& s = axis.setpoint();
    const Last before = last;
    last.known = true;
    last.coupled = axis.coupled_leading_axis() != nullptr && !axis.simulating();
    last.setpoint = s;
    last.actual_velocity = axis.data.ActualVelocity;
    last.function_velocity = axis.data.StatusSynchronizedMotion.FunctionFollowingValue.Velocity;
    if (!std::isfinite(s.position.value) || !std::isfinite(s.velocity) || !std::isfinite(s.acceleration))
      return fault(axis.name + ": setpoint not finite");
    const bool outrun = outruns_its_profile(axis);
    if (!before.known || controller.counters().ticks <= jumps_until_) return;
    if (last.coupled || (before.coupled && axis.pending_alarm() != 0)) {
      if (watch_coupled && !positions_may_step() && !outrun)
        watch_steps(axis, before.setpoint, s, kBetweenTicks, handed_on(before));
      return;
    }
    if (axis.pending_alarm() == alarm::kPositionRangeExceeded) return;  // at the end of the numbers it stands
    const double maximum_v = std::max(BenchLimits::kVelocity, std::abs(before.setpoint.velocity));
    if (std::abs(s.velocity) > maximum_v * (1 + kSlack))
      fault(axis.name + ": velocity " + std::to_string(s.velocity) + " beyond its limit");
    const bool speeding_up = s.velocity * s.acceleration > 0.0;
    const double maximum_a = std::max(speeding_up ? BenchLimits::kAcceleration : BenchLimits::kEmergency,
                                      std::abs(before.setpoint.acceleration));
    if (std::abs(s.acceleration) > maximum_a * (1 + kSlack))
      fault(axis.name + ": acceleration " + std::to_string(s.acceleration) + " beyond its limit");
    // The emergency ramp of an axis with a drive begins with its actual velocity.
    const double lag = axis.is_virtual() ? 0.0 : std::abs(before.actual_velocity - before.setpoint.velocity);
    watch_steps(axis, before.setpoint, s, 1.0, lag);
  }

  /// What is planned over a way of the leading axis is as steep as that axis is fast: planned for a slow one
  /// that then speeds up, it may be over between two ticks. That is published; no acceleration is held to.
  /// Nor is a velocity where the leading axis stood at the start.
  bool outruns_its_profile(const Axis& axis) noexcept {
    if (&axis != &following) return false;
    const double speed = std::abs(leading.setpoint().velocity);
    const double speed_before = std::abs(leading.last_setpoint().velocity);
    const bool synchronizing =
        (static_cast<std::uint32_t>(axis.data.StatusWord) >> static_cast<unsigned>(StatusBit::Synchronizing) &
         1u) != 0;
    const bool was_outrun = outrun_;
    if (!synchronizing || !synchronizing_) slowest_ = speed_before;
    synchronizing_ = synchronizing;
    slowest_ = std::min(slowest_, speed);
    outrun_ = synchronizing && speed > 2.0 * slowest_;
    return outrun_ || was_outrun;
  }

  /// Change of velocity that the leading axis hands on: it may come to rest between two ticks, and what is a
  /// function of its position then rests as well, from any velocity.
  double handed_on(const Last& before) const noexcept {
    const double from = leading.last_setpoint().velocity;
    const double change = leading.setpoint().velocity - from;
    const double led = std::max(std::abs(before.setpoint.velocity), std::abs(before.function_velocity));
    return from == 0.0 ? 0.0 : std::abs(led / from * change);
  }

  /// @param between how much more than at the two ticks the acceleration may be between them
  /// @param handed_on change of velocity that is not the axis' own [u/s]
  void watch_steps(const Axis& axis, const Setpoint& before, const Setpoint& s, double between,
                   double handed_on) noexcept {
    constexpr double kPeriod = static_cast<double>(BenchLimits::kPeriod) * 1e-9;
    const double at_ticks = std::max(std::abs(before.acceleration), std::abs(s.acceleration));
    const double maximum_a = between * std::max(BenchLimits::kEmergency, at_ticks);
    const double maximum_change = maximum_a * kPeriod + handed_on;
    if (std::abs(s.velocity - before.velocity) > maximum_change * (1 + kSlack) + kSlack)
      fault(axis.name + ": step of the velocity from " + std::to_string(before.velocity) + " to " +
            std::to_string(s.velocity));
    if (positions_may_step()) return;
    const double distance = difference(s.position, before.position, axis.modulo()).rounded();
    const double mean = 0.5 * (s.velocity + before.velocity) * kPeriod;
    const double rounding = 1e-12 * std::abs(s.position.value);
    if (std::abs(distance - mean) > maximum_change * kPeriod + rounding + kSlack)
      fault(axis.name + ": step of the position by " + std::to_string(distance));
  }

  bool positions_may_step() const noexcept { return controller.counters().ticks <= position_steps_until_; }

  static constexpr double kSlack = 1e-9;
  /// A profile over a few cycles has its highest acceleration between them.
  static constexpr double kBetweenTicks = 2.0;

  std::vector<Block*> support_;
  std::deque<Subject> subjects_;
  Last last_[2];
  std::uint64_t position_steps_until_ = 0;
  bool synchronizing_ = false;  // the following axis, in the last tick
  bool outrun_ = false;
  double slowest_ = 0.0;  // leading velocity since it has been synchronizing [u/s]
  std::uint64_t jumps_until_ = 0;
};

}  // namespace lockstep::test
