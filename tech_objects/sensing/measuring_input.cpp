#include "tech_objects/sensing/measuring_input.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tech_objects/data_blocks/object_bits.hpp"
#include "tech_objects/objects/object_alarms.hpp"
#include "tech_objects/sensing/external_encoder.hpp"
#include "tech_objects/types/bool_tag.hpp"

namespace lockstep {
namespace {

/// Values of Status.
constexpr DINT kNoMeasurement = 0;
constexpr DINT kWaits = 1;
constexpr DINT kCaptured = 2;
constexpr DINT kError = 3;

constexpr double kMilliseconds = 1e-3;  // [s]
constexpr UDINT kHighestCount = 2147483647;
constexpr std::int64_t kMaximumLost = 7;

bool cyclic(const Job& job) noexcept {
  return job.kind == JobKind::MC_MeasuringInputCyclic;
}

/// Edges that one-time measuring takes.
int values_of(MeasuringMode mode) noexcept {
  return mode >= MeasuringMode::both ? 2 : 1;
}

/// Servo cycles that one-time measuring by telegram takes at least, for one edge and for two.
constexpr std::size_t kTelegramOneEdge = 7;
constexpr std::size_t kTelegramTwoEdges = 13;

}  // namespace

MeasuringInput::MeasuringInput(std::string object_name, DB_ANY object_number)
    : TechnologyObject(ObjectKind::TO_MeasuringInput, std::move(object_name), object_number) {}

double MeasuringInput::longest_correction(double servo_period) noexcept {
  return static_cast<double>(kHistory - 2) * servo_period / kMilliseconds;
}

void MeasuringInput::configure(double servo_period, int ratio) {
  servo_period_ = servo_period;
  start_values_ = data;
  if (measured == nullptr) return;
  load_.watch(*measured, servo_period, ratio);
  if (measured->kind == ObjectKind::TO_ExternalEncoder)
    encoder_ = static_cast<const ExternalEncoder*>(measured);
  publish();
}

// ---- MC_Servo
// ---------------------------------------------------------------------------------------------------

void MeasuringInput::servo(std::int64_t /*now*/) noexcept {
  if (measured == nullptr) return;
  modulo_ = measured->modulo();
  if (job_ != nullptr && restarts_ != measured->restarts()) end_in_error(ErrorId::restarting);
  restarts_ = measured->restarts();
  const Edges seen = edges();
  remember();
  if (job_ != nullptr && !measured->actual_values_valid()) {
    raise_alarm(alarm::kPositionInvalid, ProcessingEnd::measuring_input, *this, data,
                {.object = static_cast<std::uint16_t>(measured->number)});
    end_in_error(ErrorId::technology_alarm);
  }
  if (job_ != nullptr && homings_ != measured->homings()) abort();
  homings_ = measured->homings();
  if (job_ != nullptr) {
    if (cyclic(*job_))
      measure_cyclically(seen);
    else
      measure_once(seen);
  }
  last_position_ = load_.position().value;
  new_jobs_.take([this](Job& job) { start(job); });
  publish();
}

/// What the probe has seen since the servo tick before. The material is where the encoder truly is.
Edges MeasuringInput::edges() noexcept {
  const bool begun = load_.begun();
  const DoubleDouble from = encoder_ != nullptr ? encoder_->last_true_line() : load_.line();
  load_.servo();
  const DoubleDouble to = encoder_ != nullptr ? encoder_->true_line() : load_.line();
  Edges seen;
  if (!marks) {
    const bool level = is_on(data.Interface.Address);
    if (begun)
      probe_.sample(level, seen);
    else
      probe_.begin(level);
  } else if (begun) {
    probe_.move(*marks, from, to, seen);
  } else {
    probe_.begin(ProbeSignal::on_mark(*marks, to));
    history_.fill(load_.line());
    last_position_ = load_.position().value;
  }
  return seen;
}

void MeasuringInput::remember() noexcept {
  ++tick_;
  history_[tick_ % kHistory] = load_.line();
}

/// The position some servo cycles ago, between two of them on a straight line [u].
/// @param age [servo cycles] ≥ 0
double MeasuringInput::position_at(double age) const noexcept {
  const double whole = std::min(std::floor(age), static_cast<double>(kHistory - 2));
  const double part = std::min(age - whole, 1.0);
  const std::size_t newer = tick_ + kHistory - static_cast<std::size_t>(whole);
  const DoubleDouble from = history_[newer % kHistory];
  const DoubleDouble distance = (history_[(newer - 1) % kHistory] - from) * part;
  return advanced(load_.position(), from + distance - load_.line(), modulo_).value;
}

// ---- Measuring range
// --------------------------------------------------------------------------------------------

ErrorId MeasuringInput::take_range(const Job& job) noexcept {
  range_ = {};
  const auto& asked = job.as<MeasuringJob>();
  if (!asked.limited) return ErrorId::none;
  range_.limited = true;
  if (!modulo_.enabled) {
    range_.start = std::min(asked.start_position, asked.end_position);
    range_.length = std::abs(asked.end_position - asked.start_position);
    return ErrorId::none;
  }
  const double distance = std::abs(asked.end_position - asked.start_position);
  if (distance > modulo_.length) return ErrorId::measuring_range;
  range_.limited = distance < modulo_.length;  // no position lies outside of the whole ring
  range_.start = normalised({0, asked.start_position}, modulo_).value;
  range_.length = positive_distance(asked.start_position, asked.end_position, modulo_);
  return ErrorId::none;
}

double MeasuringInput::place_in_range(double position) const noexcept {
  return positive_distance(range_.start, position, modulo_);
}

bool MeasuringInput::in_range(double position) const noexcept {
  if (!range_.limited) return true;
  const double place = place_in_range(position);
  return place >= 0.0 && place <= range_.length;
}

/// Whether a position lies ahead of the range, where measuring is active already.
bool MeasuringInput::in_lead_in(double position) const noexcept {
  const auto& parameter = data.Parameter;
  const double time =
      (parameter.MeasuringRangeActivationTime + parameter.MeasuringRangeAdditionalActivationTime) *
      kMilliseconds;
  const double distance = load_.distance().rounded() / servo_period_ * time;
  double place = place_in_range(position);
  if (distance < 0.0) return place > range_.length && place - range_.length <= -distance;
  if (modulo_.enabled) place -= modulo_.length;
  return place < 0.0 && -place <= distance;
}

/// Whether the distance of this servo cycle has left the range.
bool MeasuringInput::range_passed() const noexcept {
  if (!range_.limited) return false;
  const double distance = load_.distance().rounded();
  const double place = place_in_range(last_position_);
  if (distance < 0.0) return place >= 0.0 && place + distance < 0.0;
  if (place <= range_.length) return place + distance > range_.length;
  return modulo_.enabled && place + distance > modulo_.length + range_.length;
}

// ---- Measuring
// --------------------------------------------------------------------------------------------------

void MeasuringInput::measure_once(const Edges& seen) noexcept {
  const double correction = data.Parameter.CorrectionTime * kMilliseconds / servo_period_;
  auto& job = job_->as<MeasuringJob>();
  const int wanted = values_of(job.mode);
  for (std::size_t i = 0; i < seen.count && captured_ < wanted; ++i) {
    const Edge& edge = seen.list[i];
    if (!wanted_once(edge.rising)) continue;
    const double position = position_at(1.0 - edge.part + correction);
    if (!in_range(position)) {
      if (in_lead_in(position)) return end_in_error(ErrorId::outside_measuring_range);
      continue;
    }
    show_value(captured_, position);
    job.measured.value[captured_] = position;
    if (captured_ == 0) first_rising_ = edge.rising;
    data.Status = kCaptured;
    ++captured_;
  }
  if (captured_ == wanted) {
    if (may_tell()) end(JobPhase::done, ErrorId::none);
    return;
  }
  // An edge that belongs to the range may be seen as late as the correction says.
  const auto now = static_cast<std::int64_t>(tick_);
  if (range_left_ < 0 && range_passed()) range_left_ = now;
  if (range_left_ < 0 || static_cast<double>(now - range_left_) < correction) return;
  raise_alarm(alarm::kMeasuringRangePassed, ProcessingEnd::measuring_input, *this, data);
  end_in_error(ErrorId::measuring_range);
}

bool MeasuringInput::wanted_once(bool rising) const noexcept {
  switch (job_->as<MeasuringJob>().mode) {
    case MeasuringMode::rising:
      return rising;
    case MeasuringMode::falling:
      return !rising;
    case MeasuringMode::rising_then_falling:
      return rising == (captured_ == 0);
    case MeasuringMode::falling_then_rising:
      return rising == (captured_ == 1);
    default:
      return true;
  }
}

/// Two values of each servo cycle: of modes 0 and 1 the first two edges, of mode 2 the first of each kind.
void MeasuringInput::measure_cyclically(const Edges& seen) noexcept {
  const double correction = data.Parameter.CorrectionTime * kMilliseconds / servo_period_;
  auto& job = job_->as<MeasuringJob>();
  const bool both = job.mode == MeasuringMode::both;
  const bool rising = both || job.mode == MeasuringMode::rising;
  const bool falling = both || job.mode == MeasuringMode::falling;
  const std::int64_t all = (rising ? seen.rising : 0) + (falling ? seen.falling : 0);
  bool acquired[2] = {false, false};
  std::int64_t dropped = 0;
  for (std::size_t i = 0; i < seen.count; ++i) {
    const Edge& edge = seen.list[i];
    if (edge.rising ? !rising : !falling) continue;
    const double position = position_at(1.0 - edge.part + correction);
    if (!in_range(position)) {
      ++dropped;
      continue;
    }
    const int index = both ? (edge.rising ? 0 : 1) : (acquired[0] ? 1 : 0);
    if (acquired[index]) continue;
    acquired[index] = true;
    show_value(index, position);
    job.measured.value[index] = position;
    ++job.measured.counter[index];
    data.Status = kCaptured;
  }
  const std::int64_t lost =
      std::clamp<std::int64_t>(all - dropped - acquired[0] - acquired[1], 0, kMaximumLost);
  auto& values = data.MeasuredValues;
  UDINT* const counters[2] = {&values.LostEdgeCounter1, &values.LostEdgeCounter2};
  for (int index = 0; index < 2; ++index) {
    if (!acquired[index]) continue;
    *counters[index] = acquired[1 - index] ? static_cast<UDINT>(lost) : 0;
    job.measured.lost[index] = *counters[index];
  }
}

void MeasuringInput::show_value(int index, double position) noexcept {
  auto& values = data.MeasuredValues;
  (index == 0 ? values.MeasuredValue1 : values.MeasuredValue2) = position;
  UDINT& counter = index == 0 ? values.MeasuredValue1Counter : values.MeasuredValue2Counter;
  counter = counter == kHighestCount ? 0 : counter + 1;
}

// ---- Jobs
// -------------------------------------------------------------------------------------------------------

void MeasuringInput::start(Job& job) noexcept {
  if (job.kind == JobKind::MC_Reset) {
    reset(job.as<ResetJob>().restart);
    job.phase = JobPhase::done;
    return;
  }
  if (job.kind == JobKind::MC_AbortMeasuringInput) {
    abort();
    job.phase = JobPhase::done;
    return;
  }
  if (const ErrorId error = begin(job); error != ErrorId::none) job.fail(error);
}

ErrorId MeasuringInput::begin(Job& job) noexcept {
  if (data.ErrorDetail.Reaction != 0) return ErrorId::technology_alarm;
  if (!measured->actual_values_valid()) return ErrorId::actual_values_invalid;
  const MeasuringRange running = range_;
  ErrorId error = take_range(job);
  if (error == ErrorId::none && by_telegram()) error = take_telegram(job);
  if (error != ErrorId::none) {
    range_ = running;
    return error;
  }
  end(JobPhase::aborted, ErrorId::none);
  job_ = &job;
  started_ = tick_;
  if (by_telegram()) measured->telegram_probe = this;
  job.phase = JobPhase::active;
  captured_ = 0;
  range_left_ = -1;
  data.Status = kWaits;
  if (!cyclic(job)) data.MeasuredValues.LostEdgeCounter1 = data.MeasuredValues.LostEdgeCounter2 = 0;
  return ErrorId::none;
}

// ---- Measuring by the telegram of the encoder
// ------------------------------------------------------------------------------

/// One job at a time; the zero mark of a homing needs the same words of the telegram.
ErrorId MeasuringInput::take_telegram(const Job& job) noexcept {
  if (!measured->measured_in_servo()) return refuse(alarm::kProbeConfiguration);
  if (cyclic(job)) return refuse(alarm::kMeasuringNotPossible);
  if (measured->homing()) {
    refuse(alarm::kMeasuringWhileHoming);
    return ErrorId::measuring_while_homing;
  }
  const void* const in_use = measured->telegram_probe;
  if (in_use != nullptr && in_use != this) return refuse(alarm::kProbeInUse);
  return ErrorId::none;
}

ErrorId MeasuringInput::refuse(int alarm_number) noexcept {
  raise_alarm(alarm_number, ProcessingEnd::measuring_input, *this, data);
  end_in_error(ErrorId::technology_alarm);
  return ErrorId::technology_alarm;
}

/// Values come over the telegram, which takes its time.
bool MeasuringInput::may_tell() const noexcept {
  if (!by_telegram()) return true;
  return tick_ - started_ >=
         (values_of(job_->as<MeasuringJob>().mode) == 1 ? kTelegramOneEdge : kTelegramTwoEdges);
}

void MeasuringInput::end(JobPhase phase, ErrorId error) noexcept {
  if (job_ == nullptr) return;
  job_->phase = phase;
  job_->error = error;
  job_ = nullptr;
  if (measured->telegram_probe == this) measured->telegram_probe = nullptr;
}

/// By MC_AbortMeasuringInput, or a homing.
void MeasuringInput::abort() noexcept {
  end(JobPhase::aborted, ErrorId::none);
  data.Status = kNoMeasurement;
}

void MeasuringInput::end_in_error(ErrorId error) noexcept {
  end(JobPhase::failed, error);
  data.Status = kError;
}

void MeasuringInput::reset(bool restart) noexcept {
  clear_alarms(*this, data);
  if (!restart) return;
  end(JobPhase::aborted, ErrorId::none);
  data = start_values_;
  start_values_changed = false;
}

void MeasuringInput::publish() noexcept {
  data.InputState = probe_.level();
  set_bit(data.StatusWord, InputOutputBit::Control, job_ != nullptr);
  set_bit(data.StatusWord, InputOutputBit::Error, data.ErrorDetail.Number != 0);
  set_bit(data.StatusWord, InputOutputBit::OnlineStartValuesChanged, start_values_changed);
  set_bit(data.StatusWord, InputOutputBit::CommunicationOK, true);
}

}  // namespace lockstep
