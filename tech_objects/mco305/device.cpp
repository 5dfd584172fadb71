// The steps of a device: from the drive to the drive.
#include "tech_objects/mco305/device.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "tech_objects/arithmetic/seldom_cut.hpp"
#include "tech_objects/mco305/synchronization_step.hpp"

namespace lockstep::mco305 {
namespace {

constexpr std::int64_t kMonitoringPeriod = 20;  // [ms] of following error and drive
constexpr double kFullReference = 0x4000;       // of OUTAN

}  // namespace

void Device::configure(const DeviceSettings& settings, double servo_period) {
  settings_ = settings;
  machine_start_ = settings.drive.signals.start_position;
  virtual_ = !settings.has_drive;
  const double start = settings.drive.signals.start_position;
  for (std::size_t i = 0; i < settings.inputs.size(); ++i)
    if (settings.inputs[i] != nullptr) wired_inputs_.push_back({i + 1, settings.inputs[i]});
  for (std::size_t i = 0; i < settings.outputs.size(); ++i)
    if (settings.outputs[i] != nullptr) wired_outputs_.push_back({i + 1, settings.outputs[i]});
  master_.configure(settings.has_master, settings.master_marks, settings.faults.master_encoder_counts);
  track_.configure(settings.markers);
  const DeviceFaults& faults = settings.faults;
  looks_at_faults_ = faults.supply != nullptr || faults.output != nullptr || faults.master_encoder != nullptr;
  if (!parameters_.power_up()) raise(kParametersCorrupted);
  absolute_.configure(virtual_ ? 0 : parameters_[kEncoderAbsType], parameters_[kEncoderDatLen],
                      counts_of(start));
  master_.power_up(parameters_);
  io_.power_up(parameters_);
  refresh();
  if (settings.has_drive) {
    drive_ = std::make_unique<SimulatedDrive>();
    drive_->configure(settings.drive, servo_period, 2.0 * 3.14159265358979323846 / turn_);
    machine_ = start;
    swap_offset_ = actual_ = absolute_.position();
    reads_position_alone_ =
        drive_->exact() && !absolute_.present() && settings.drive.signals.digital_inputs.empty();
  }
  profile_.stand(static_cast<double>(actual_));
  if (parameters_[kPowerUpState] != 0) motor_on();
  was_reset_ = false;
}

// What steps ask for, computed where it changes.
void Device::refresh() noexcept {
  const ParameterValues& p = parameters_;
  unit_ = {p[kPosFactZ], p[kPosFactN], p[kPosDirection] >= 3 ? -1 : 1};
  turn_ = absolute_.present() ? p.real(kEncoderAbsRes) : 4.0 * p.real(kEncoder);
  velocity_maximum_ = counts_per_millisecond(p.real(kVelMax));
  acceleration_maximum_ = velocity_maximum_ / p.real(kRampMin);
  profile_time_ = p[kProfTime];
  sampling_ = p[kTimer];
  constexpr std::int32_t kUsualInput = 6;
  const MarkerType marker = marker_type_of(p[kMarkerTypeSlave], settings_.later_edition && virtual_);
  marker_type_ = marker.type;
  meets_markers_ = marker_type_ >= 2;
  marker_input_ = marker.input != 0 ? marker.input : kUsualInput;
  const bool pulses = virtual_ && settings_.later_edition && marker.type == 0 && p[kEncoderFreq] > 0;
  virtual_pulse_ = pulses ? p.real(kEncoderFreq) : 0.0;
  no_pulse_from_ = no_pulse_until_ = 0.0;
  meets_pulses_ = settings_.drive.signals.zero_marks ? !absolute_.present() : virtual_pulse_ > 0.0;
  position_error_ = p[kPosErr];
  checks_limits_ = p[kSwNegLimAct] != 0 || p[kSwPosLimAct] != 0;
  CountControllerSettings control;
  control.proportional = p.real(kKProp);
  control.derivative = p.real(kKDer);
  control.integral = p.real(kKInt);
  control.integral_limit = std::max(p.real(kKILim), 0.0);
  control.bandwidth = std::max(p.real(kBandwidth), 0.0);
  control.velocity_precontrol = p.real(kFFVel);
  control.acceleration_precontrol = p.real(kFFAcc);
  control.active_above = p[kRegWMax];
  control.idle_below = p[kRegWMin];
  control.integral_time = std::max(p[kKILimTime], -kLargestPosition);
  control.scale = settings_.controller_scale;
  controller_.set(control);
  io_.assign(p);
  samples_ = absolute_.present() || !wired_inputs_.empty() || io_.any_input_function();
  shows_ = !wired_outputs_.empty() || io_.any_output_function();
  sampled_inputs_ = master_inputs_ = io_.changes() - 1;
  master_.refresh(p, settings_.later_edition);
  has_master_ = has_master_ || master_.present();
  sync_.refresh(p, settings_.later_edition, velocity_maximum_);
  note_what_is_watched();
  drive_sign_ = p[kPosDirection] % 2 == 0 ? -1.0 : 1.0;
  scale_drive();
}

/// ENCODERTYPE, MENCODERTYPE of two digits, in place of SWAPMENC. @errors 112 the inputs cannot change places
int Device::choose_encoder(std::int32_t number, std::int32_t value) noexcept {
  const bool own = number == kEncoderType;
  if ((!own && number != kMasterEncoderType) || !settings_.later_edition) return 0;
  const std::int32_t input = encoder_input_of(value);
  if (input == 0) return 0;
  return swap_encoders((input == 1) == own) ? 0 : kUnknownParameter;
}

int Device::set_parameter(std::int32_t number, std::int32_t value) noexcept {
  if (const int error = choose_encoder(number, value); error != 0) return error;
  const int error = parameters_.set(number, value);
  if (error == 0 && !is_application_parameter(number)) refresh();
  return error;
}

int Device::change_parameter(std::int32_t number, std::int32_t value) noexcept {
  const int error = parameters_.change(number, value);
  if (error == 0 && !is_application_parameter(number)) refresh();
  return error;
}

void Device::forget_settings() noexcept {
  parameters_.forget();
  refresh();
}

// What is called here in every step is inline: to save registers and to hand over by memory would take up to
// a seventh of its instructions.
void Device::servo(bool step) noexcept {
  if (!virtual_) [[likely]]
    read_drive();
  if (step) [[likely]] {
    ++now_;
    if (samples_ || io_.changes() != sampled_inputs_) [[unlikely]]
      sample();
    if (has_master_) [[likely]]
      step_master();
    if (mode_ == MotionMode::kHome) [[unlikely]]
      step_home();
    generate();
    if (virtual_) {
      const double before = machine_;
      machine_ = profile_.state().position;
      actual_ = counts_of(machine_ + 0.5);
      if (machine_ != before && !meets_no_pulse(before, machine_)) latch(before, machine_);
    }
    control();
    look_at_arrival();
    if (watches_ || now_ == next_monitoring_) [[unlikely]]
      monitor();
    if (has_master_) [[likely]]
      sync_.judge(actual_);
    positions_.keep(now_, actual_);
    if (shows_) [[unlikely]]
      write_outputs();
    brake_ = false;
  }
  if (!virtual_) [[likely]]
    write_drive();
}

/// A drive that does not move has nothing new to tell but its state.
inline void Device::read_drive() noexcept {
  if (!reads_position_alone_) return read_whole_drive();
  drive_enabled_ = drive_->operates();
  if (drive_->rests()) return;
  told_.velocity = drive_->velocity();
  told_.torque = drive_->torque();
  const double moved = drive_->read_distance();
  if (moved == 0.0) return;
  const double before = machine_;
  machine_ += moved;
  actual_ = counts_of(machine_ - machine_start_) + swap_offset_;
  latch(before, machine_);
}

[[gnu::noinline]] void Device::read_whole_drive() noexcept {
  const DriveActual now = drive_->read();
  drive_enabled_ = now.enabled;
  told_.velocity = now.velocity;
  told_.torque = now.torque;
  trouble_ = {now.silent, now.encoder_failed, now.fault};
  if (now.silent || now.encoder_failed) return;
  const double before = machine_;
  const double moved = rounded_difference(now.position, last_drive_position_);
  last_drive_position_ = now.position;
  machine_ += moved;
  if (!absolute_.present()) actual_ = counts_of(machine_ - machine_start_) + swap_offset_;
  if (moved != 0.0) latch(before, machine_);
  if (!settings_.drive.signals.digital_inputs.empty()) show_switches();
}

void Device::show_switches() noexcept {
  for (const DigitalInput& input : settings_.drive.signals.digital_inputs)
    *input.tag = input.range.contains(machine_, 0.0);
}

/// What a leap that was taken has added belongs to the places of markers too.
void Device::read_absolute() noexcept {
  const std::int32_t* const disturbed = settings_.faults.encoder_counts;
  const double start = settings_.drive.signals.start_position;
  const auto resolution = static_cast<std::int64_t>(turn_);
  const bool good = absolute_.read(counts_of(machine_ - start) + counts_of(start),
                                   disturbed == nullptr ? 0 : *disturbed, resolution);
  actual_ = absolute_.position();
  swap_offset_ = actual_ - counts_of(machine_ - start);
  if (!good && on_ && !pending_.has(kPositionError)) raise(kPositionError);
}

// On the counter.
std::int64_t Device::encoder_count(double place) const noexcept {
  return counts_of(place) + (virtual_ ? 0 : swap_offset_);
}

/// What most steps are: between two markers, or without any.
inline void Device::latch(double from, double to) noexcept {
  if (meets_markers_ ? !track_.stays_free(to - from) : meets_pulses_) look_for_latches(from, to);
}

/// A zero pulse is met exactly, wherever in the tick it lies.
[[gnu::noinline]] void Device::look_for_latches(double from, double to) noexcept {
  const double start = virtual_ ? 0.0 : settings_.drive.signals.start_position;
  if (marker_type_ >= 2)
    return track_.look_for_marks(from, to,
                                 [this, start](double place) { take_latch(encoder_count(place - start)); });
  const auto& marks = settings_.drive.signals.zero_marks;
  if (!marks && virtual_pulse_ > 0.0) return latch_virtual(from, to);
  if (!marks || absolute_.present()) return;
  if (const auto mark = marks->between(from, to)) take_latch(encoder_count(*mark - start + 0.5));
}

/// Most steps are between the same two of them as the one before.
inline bool Device::meets_no_pulse(double from, double to) const noexcept {
  return from > no_pulse_from_ && from < no_pulse_until_ && to > no_pulse_from_ && to < no_pulse_until_;
}

/// Those of a simulated slave: one each ENCODERFREQ, the first ones half of that from where it begins.
void Device::latch_virtual(double from, double to) noexcept {
  constexpr int kInAStep = 8;
  const bool forward = from < to;
  const double half = 0.5 * virtual_pulse_;
  double number = whole_below((from - half) / virtual_pulse_);
  if (forward || number * virtual_pulse_ + half == from) number += forward ? 1.0 : -1.0;
  for (int i = 0; i < kInAStep; ++i, number += forward ? 1.0 : -1.0) {
    const double place = number * virtual_pulse_ + half;
    if (forward ? place > to : place < to) break;
    take_latch(counts_of(place));
  }
  no_pulse_from_ = whole_below((to - half) / virtual_pulse_) * virtual_pulse_ + half;
  no_pulse_until_ = no_pulse_from_ + virtual_pulse_;
}

void Device::take_latch(std::int64_t place) noexcept {
  latched_ = place;
  ++latches_;
  sync_.note_slave_mark(static_cast<double>(place));
  if (mode_ == MotionMode::kFollow) sync_.take_slave_mark(static_cast<double>(place));
}

void Device::mark(double place) noexcept {
  if (marker_type_ >= 2) take_latch(counts_of(place));
}

/// Of the markers of this millisecond those of the slave have been taken while its drive was read.
[[gnu::always_inline]] inline void Device::step_master() noexcept {
  if (io_.changes() != master_inputs_) [[unlikely]] {
    master_inputs_ = io_.changes();
    const std::int32_t enabling = master_.enabling_input();
    master_.look_at_marker(io_.input(5), enabling == 0 || io_.input(enabling));
  }
  master_.step();
  sync_.average(master_);
  if (mode_ != MotionMode::kFollow) sync_.end();
  if (sync_.runs()) [[likely]]
    sync_.step(master_, actual_);
}

[[gnu::noinline]] void Device::sample() noexcept {
  if (absolute_.present()) read_absolute();
  if (!wired_inputs_.empty()) sample_wired_inputs();
  if (io_.any_input_function()) sample_home_switch();
  sampled_inputs_ = io_.changes();
  // The marker of the following side is input 6, of a simulated one any.
  const bool marker = io_.input(marker_input_);
  if (marker == last_marker_input_) return;
  last_marker_input_ = marker;
  if (marker_type_ >= 2 && marker == (marker_type_ == 2)) take_latch(actual_);
}

void Device::sample_wired_inputs() noexcept {
  for (const WiredInput& input : wired_inputs_) io_.set_input(input.number, *input.tag);
}

/// One that nothing is wired to is that of the machine.
void Device::sample_home_switch() noexcept {
  const auto& cam = settings_.drive.signals.reference_cam;
  const std::size_t home_switch = io_.input_of(InputFunction::kHomeSwitch);
  if (!cam || home_switch == 0 || settings_.inputs[home_switch - 1] != nullptr) return;
  const bool closed = parameters_[kFirstInputFunction + static_cast<std::int32_t>(home_switch) -
                                  (home_switch <= 10 ? 1 : 0)] == 2;
  io_.set_input(home_switch, cam->contains(machine_, 0.0) != closed);
}

inline void Device::generate() noexcept {
  if (!on_) {
    // MOTOR OFF: the set position is where the axis is.
    if (!virtual_) profile_.stand(static_cast<double>(actual_));
    last_velocity_ = 0.0;
    return;
  }
  if (mode_ == MotionMode::kFollow) [[likely]] {
    const double before = profile_.state().position;
    sync_.set_point(actual_, !virtual_);
    profile_.lead({sync_.set_position(), sync_.set_velocity(), sync_.set_acceleration()});
    if (sync_.mode() == SyncMode::kVelocity) unled_ += sync_.set_position() - before - sync_.set_velocity();
    return;
  }
  if (profile_time_ == 1 || now_ % profile_time_ == 0) profile_.step(static_cast<double>(profile_time_));
}

inline void Device::control_position() noexcept {
  if (sampling_ != 1 && now_ % sampling_ != 0) [[unlikely]]
    return;
  const FourSlopeState& set = profile_.state();
  const bool by_velocity = mode_ == MotionMode::kFollow && sync_.mode() == SyncMode::kVelocity;
  const double setpoint = by_velocity ? set.position : nearest_whole(set.position);
  const double change = set.velocity - last_velocity_;
  last_velocity_ = set.velocity;
  // A division is long.
  if (sampling_ == 1) [[likely]] {
    reference_ = controller_.step(setpoint, static_cast<double>(actual_), set.velocity, change, 1.0);
  } else {
    const auto period = static_cast<double>(sampling_);
    reference_ =
        controller_.step(setpoint, static_cast<double>(actual_), set.velocity, change / period, period);
  }
}

inline void Device::control() noexcept {
  if (on_ && !virtual_) return control_position();
  reference_ =
      virtual_ ? 0.0 : static_cast<double>(open_loop_) / kFullReference * CountController::kFullScale;
  if (!on_) controller_.reset();
  last_velocity_ = profile_.state().velocity;
}

/// TESTWIN: the profile is at its end, the axis within the window, and it hardly moves.
inline void Device::look_at_arrival() noexcept {
  const bool stands = profile_.state().velocity == 0.0;
  if (mode_ == MotionMode::kFollow) {
    moving_ = on_ && !stands;
    return;
  }
  const bool ended = stands && profile_.over();
  moving_ = on_ && !(ended && mode_ != MotionMode::kHome);
  if (!ended) {
    window_since_ = -1;
  } else if (!arrived_) {
    look_into_window();
  }
}

/// At the end of the profile.
void Device::look_into_window() noexcept {
  if (mode_ == MotionMode::kStop && brake_after_stop_) {
    brake_ = true;
    brake_after_stop_ = false;
    motor_off();
  }
  if (arrived_ || !on_) return;
  const std::int64_t window = parameters_[kTestWin];
  if (window == 0 || virtual_ || mode_ != MotionMode::kPosition) {
    arrived_ = true;
    return;
  }
  const std::int64_t distance = actual_ - target_, time = parameters_[kTestTim];
  if (window_since_ < 0 || now_ - window_since_ >= time) {
    const std::int64_t moved = actual_ - window_position_;
    const bool still = window_since_ >= 0 && std::abs(moved) < parameters_[kTestVal];
    arrived_ = still && std::abs(distance) <= window;
    window_position_ = actual_;
    window_since_ = now_;
  }
}

/// Most devices have nothing of this to look at in most of their steps.
void Device::note_what_is_watched() noexcept {
  watches_inputs_ = io_.any_input_function() || at_negative_end_ || at_positive_end_ || break_input_;
  watches_ = watches_inputs_ || checks_limits_ || looks_at_faults_;
}

void Device::monitor() noexcept {
  if (watches_inputs_ || checks_limits_) look_at_limits();
  if (now_ == next_monitoring_) {
    next_monitoring_ += kMonitoringPeriod;
    if (!virtual_ && on_) {
      look_at_position_error();
      look_at_drive();
    }
  }
  if (looks_at_faults_) look_at_faults();
  if (!watches_inputs_) return;
  const bool user_break = io_.active(InputFunction::kBreak);
  if (user_break && !break_input_) raise(kUserAbort);
  break_input_ = user_break;
  note_what_is_watched();
}

void Device::look_at_limits() noexcept {
  const bool negative = io_.active(InputFunction::kNegativeEnd),
             positive = io_.active(InputFunction::kPositiveEnd);
  const bool pressed = (negative && !at_negative_end_) || (positive && !at_positive_end_);
  at_negative_end_ = negative;
  at_positive_end_ = positive;
  const double velocity = profile_.state().velocity;
  // Once such an error has been cleared a master may lead back only.
  const bool may_be_led_out = mode_ == MotionMode::kFollow && on_ && !pending_.any();
  if (pressed)
    raise(kHardwareLimit);
  else if (may_be_led_out && settings_.later_edition &&
           ((negative && velocity < 0.0) || (positive && velocity > 0.0)))
    raise(kFurtherOut);
  if (!checks_limits_) return;
  const std::int64_t at = (virtual_ ? set_counts() : actual_) - limits_origin_;
  const bool below = parameters_[kSwNegLimAct] != 0 && at < parameters_[kNegLimit];
  const bool above = parameters_[kSwPosLimAct] != 0 && at > parameters_[kPosLimit];
  const bool moves_out = (below && velocity < 0.0) || (above && velocity > 0.0);
  const bool beyond = below || above;
  if (beyond && !beyond_ && moves_out && on_)
    raise(kSoftwareLimit);
  else if (beyond_ && moves_out && may_be_led_out)
    raise(further_out());
  beyond_ = beyond;
}

void Device::look_at_position_error() noexcept {
  const std::int64_t error = set_counts() - actual_;
  if (std::abs(error) <= position_error_) {
    over_since_ = -1;
    return;
  }
  if (over_since_ < 0) over_since_ = now_;
  if (now_ - over_since_ < parameters_[kPosErrTime] || pending_.has(kPositionError)) return;
  raise(kPositionError);
}

void Device::look_at_drive() noexcept {
  if (parameters_[kEncoderMonitoring] != 0 && trouble_.encoder_failed && !pending_.has(kEncoderError))
    raise(kEncoderError);
  if (parameters_[kStatusMonitoring] != 0 && (trouble_.fault || trouble_.silent) &&
      !pending_.has(kDriveNotReady))
    raise(kDriveNotReady);
}

void Device::look_at_faults() noexcept {
  const auto present = [](const bool* tag) noexcept { return tag != nullptr && *tag; };
  const auto report = [this](bool fault, int error) noexcept {
    if (fault && !pending_.has(error)) raise(error);
  };
  const DeviceFaults& faults = settings_.faults;
  report(parameters_[kExternalSupply] == 1 && present(faults.supply), kNoSupply);
  report(present(faults.output), kOutputOverloaded);
  report(parameters_[kMasterEncoderMonitoring] != 0 && present(faults.master_encoder), kEncoderError);
}

void Device::write_outputs() noexcept {
  io_.show({moving_, pending_.any(), brake_});
  for (const WiredOutput& output : wired_outputs_) *output.tag = io_.output(output.number);
}

inline void Device::write_drive() noexcept {
  // Of the same reference, to the bit, it is the same, and a division is long.
  const bool same =
      std::bit_cast<std::uint64_t>(reference_) == std::bit_cast<std::uint64_t>(scaled_reference_);
  if (!same) {
    scaled_reference_ = reference_;
    const double velocity = reference_ / CountController::kFullScale * full_reference_;
    drive_velocity_ = seldom_cut(velocity, speed_limit_) * kMillisecondsPerSecond;
  }
  drive_->write(drive_velocity_);
}

void Device::raise(int error) noexcept {
  if (raised_count_ < raised_.size()) raised_[raised_count_++] = error;
}

int Device::take_error() noexcept {
  if (raised_count_ == 0) return 0;
  const int error = raised_[0];
  std::copy(raised_.begin() + 1, raised_.end(), raised_.begin());
  --raised_count_;
  return error;
}

void Device::react(int error) noexcept {
  pending_.add(error);
  if (open_loop_ != 0) motor_off();
  if (!on_) return;
  std::int32_t reaction = parameters_[kErrCond];
  if (error == kHardwareLimit && parameters_[kEndSwMod] == 1 && (reaction < 2 || reaction == 5)) reaction = 2;
  if (reaction == 5) return;
  if (homing()) end_home(error);
  if (reaction == 2 || reaction == 3) {
    brake_after_stop_ = reaction == 3;
    return stop(acceleration_maximum_, MotionMode::kStop);
  }
  brake_ = reaction == 1;
  motor_off();
}

void Device::clear_error() noexcept {
  pending_.clear_first();
  over_since_ = -1;
  if (!virtual_ && trouble_.fault) {
    // A fault has switched the drive off, whatever the controller does; it is taken over where it is.
    constexpr std::uint16_t kAcknowledge = 1U << 7;
    motor_off();
    drive_->control(kControlOff | kAcknowledge, 0);
  }
  motor_on();
}

void Device::clear_all_errors() noexcept {
  while (pending_.any()) clear_error();
}

void Device::escape() noexcept {
  if (homing()) give_up_home();
  if (open_loop_ != 0) motor_off();
  stop(acceleration_maximum_, MotionMode::kStop);
  master_.stop();
  const std::int32_t condition = parameters_[kEscCond];
  if (condition == 1 || condition == 2) io_.switch_all(condition == 2);
  brake_ = true;
}

}  // namespace lockstep::mco305
