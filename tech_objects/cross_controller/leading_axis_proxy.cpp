#include "tech_objects/cross_controller/leading_axis_proxy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tech_objects/data_blocks/object_bits.hpp"
#include "tech_objects/jobs/job.hpp"
#include "tech_objects/leading_values/seconds.hpp"
#include "tech_objects/objects/object_alarms.hpp"

namespace lockstep {
namespace {

/// A leading value is there as long as its newest telegram is no older than so many cycles of the source and
/// of the receiver: the published time of transfer, two cycles of the receiver, and three lost telegrams.
constexpr int kSourceCycles = 4;
constexpr int kOwnCycles = 2;

// What no source goes beyond, so that nothing that is computed from it does.
constexpr double kFastestLeading = 1e12;                   // [u/s]
constexpr double kSharpestLeading = 1e15;                  // [u/s²]
constexpr double kFurthestRenamed = 1e15;                  // [u]
constexpr std::int64_t kMaximumTurns = 1LL << 53;          // whole turns of a ring
constexpr std::int64_t kLongestCycle = 1'000'000'000'000;  // [ns]

/// Whether an amount is a number of at most so much.
bool within(double value, double limit) noexcept {
  return std::abs(value) <= limit;  // false for what is no number
}

bool within_limits(const Setpoint& value) noexcept {
  return within(value.position.value, kPositionRange) && within(value.velocity, kFastestLeading) &&
         within(value.acceleration, kSharpestLeading) && value.position.turns <= kMaximumTurns &&
         value.position.turns >= -kMaximumTurns;
}

/// What a source cannot have sent.
bool senseless(const LeadingValueTelegram& telegram) noexcept {
  const Modulo& modulo = telegram.modulo;
  const bool ring = !modulo.enabled || (modulo.length >= 0.001 && modulo.length <= kPositionRange &&
                                        within(modulo.start, kPositionRange));
  const bool times = telegram.cycle > 0 && telegram.cycle <= kLongestCycle && telegram.delay >= 0 &&
                     telegram.delay <= kLongestLeadingDelay * telegram.cycle;
  const bool renamed = within(telegram.renamed.hi, kFurthestRenamed) && within(telegram.renamed.lo, 1.0);
  return !ring || !times || !renamed ||
         (telegram.valid &&
          (!within_limits(telegram.value) || !modulo.contains(telegram.value.position.value)));
}

bool same_ring(const Modulo& a, const Modulo& b) noexcept {
  return a.enabled == b.enabled && (!a.enabled || (a.length == b.length && a.start == b.start));
}

}  // namespace

LeadingAxisProxy::LeadingAxisProxy(std::string object_name, DB_ANY object_number)
    : LeadingObject(ObjectKind::TO_LeadingAxisProxy, std::move(object_name), object_number) {
  led_from_elsewhere_ = true;
}

void LeadingAxisProxy::configure(double servo_period, int ratio) {
  cycle_ = nanoseconds(servo_period) * ratio;
  start_values_ = data;
  recorded_.reserve();
  power_state_ = PowerState::on;
  modulo_.enabled = false;
  publish();
}

void TelegramCountTags::show(const TelegramCounters& counters) const noexcept {
  const auto put = [](std::uint64_t* tag, std::uint64_t count) {
    if (tag != nullptr) *tag = count;
  };
  put(received, counters.received);
  put(missing, counters.missing);
  put(late, counters.late);
  put(doubled, counters.doubled);
  put(refused, counters.refused);
  if (carrier == nullptr) return;
  const auto put_count = [&](std::uint64_t* tag, const CarrierCounts::Count& count) {
    put(tag, count.load(std::memory_order_relaxed));
  };
  put_count(malformed, carrier->malformed);
  put_count(foreign, carrier->foreign);
  put_count(not_signed, carrier->not_signed);
  put_count(repeated, carrier->repeated);
  put_count(ambiguous, carrier->ambiguous);
  put_count(stale, carrier->stale);
  put_count(untrusted, carrier->untrusted);
}

// ---- Telegrams
// --------------------------------------------------------------------------------------------------------

/// Whether a telegram is of the source that is followed; the first one says which that is.
bool LeadingAxisProxy::adopt(const LeadingValueTelegram& telegram) noexcept {
  if (!known_) {
    known_ = true;
    newest_ = telegram.sequence - 1;
    source_restarts_ = telegram.restarts;
    source_renamed_ = telegram.renamed;
    source_cycle_ = telegram.cycle;
    modulo_ = telegram.modulo;
    recorded_.set_source(modulo_, source_cycle_);
    return true;
  }
  if (replaced_ || other_ring_) return false;
  const bool newer = recorded_.empty() || telegram.time > recorded_.newest_time();
  const bool same = telegram.restarts == source_restarts_ && telegram.cycle == source_cycle_ &&
                    (!newer || telegram.sequence > newest_);
  if (same && same_ring(telegram.modulo, modulo_)) return true;
  if (newer) (same_ring(telegram.modulo, modulo_) ? replaced_ : other_ring_) = true;
  return false;
}

void LeadingAxisProxy::take(const LeadingValueTelegram& telegram, std::int64_t now) noexcept {
  if (senseless(telegram) || telegram.time > now + telegram.cycle || !adopt(telegram)) {
    ++counters_.refused;
    return;
  }
  const bool newest = telegram.sequence > newest_;
  if (newest) {
    counters_.missing += telegram.sequence - newest_ - 1;
    newest_ = telegram.sequence;
    source_valid_ = telegram.valid;
    source_led_ = telegram.position_led;
    delay_ = telegram.delay;
    rename_to(telegram.renamed);
  }
  if (!telegram.valid) {
    ++counters_.received;
    return;
  }
  Setpoint value = telegram.value;
  const DoubleDouble behind = source_renamed_ - telegram.renamed;
  if (behind.hi != 0.0) value.position = advanced(value.position, behind, modulo_);
  if (!recorded_.add(telegram.time, value)) {
    ++counters_.doubled;
    return;
  }
  ++counters_.received;
  if (newest) return;
  ++counters_.late;
  if (counters_.missing > 0) --counters_.missing;
}

/// Homing at the source: what has come so far is called by the new names as well, and nothing moves.
void LeadingAxisProxy::rename_to(DoubleDouble renamed) noexcept {
  const double by = (renamed - source_renamed_).rounded();
  source_renamed_ = renamed;
  if (by == 0.0) return;
  recorded_.rename(by);
  adapted_.rename(by, modulo_);
  undelayed_.rename(by, modulo_);
  for (Setpoint* value : {&setpoint_, &last_setpoint_, &delayed_, &last_delayed_})
    value->position = advanced(value->position, by, modulo_);
  shift_leading(by);
  handing_over_ = true;  // running couplings keep the old names
}

void LeadingAxisProxy::forget_source() noexcept {
  known_ = replaced_ = other_ring_ = source_valid_ = source_led_ = false;
  recorded_.clear();
  adapted_.clear();
  undelayed_.clear();
}

// ---- MC_Interpolator
// --------------------------------------------------------------------------------------------------

void LeadingAxisProxy::before_axes() noexcept {
  local_delay_ = nanoseconds(data.Parameter.LocalLeadingValueDelayTime);
  restarting_ = false;
  new_jobs_.take([this](Job& job) { start(job); });
  if (!faulty()) watch();
  if (!faulty() && (adapted_.begun() || valid()))
    lead();
  else
    setpoint_.velocity = setpoint_.acceleration = delayed_.velocity = delayed_.acceleration = 0.0;
  publish();
}

bool LeadingAxisProxy::valid() const noexcept {
  if (!known_ || replaced_ || other_ring_ || !source_valid_ || recorded_.empty()) return false;
  const std::int64_t age = now_ - recorded_.newest_time();
  return age <= kSourceCycles * source_cycle_ + kOwnCycles * cycle_ &&
         recorded_.reaches_back_to(std::min(time_asked(), now_ - delay_));
}

/// What has begun to lead has to stay valid, but for the tolerance time. Ticks that are left out do not
/// count: in them nobody has looked.
void LeadingAxisProxy::watch() noexcept {
  if (other_ring_) return fault(alarm::kLeadingModuloChanged);
  if (valid() || !adapted_.begun()) {
    invalid_for_ = 0;
    return;
  }
  invalid_for_ += cycle_;
  const double invalid_for = seconds(invalid_for_);
  const double tolerance = data.Parameter.ToleranceTimeExternalLeadingValueInvalid;
  if (invalid_for > tolerance)
    fault(alarm::kLeadingValuesInvalid, {.value = invalid_for, .limit = tolerance});
}

void LeadingAxisProxy::lead() noexcept {
  const bool begins = !adapted_.begun();
  last_setpoint_ = setpoint_;
  last_delayed_ = delayed_;
  setpoint_ = adapted_.step(recorded_, now_, time_asked(), longer_cycle());
  delayed_ = local_delay_ == 0 && !undelayed_.begun()
                 ? setpoint_
                 : undelayed_.step(recorded_, now_, now_ - delay_, longer_cycle());
  if (!begins) return;
  last_setpoint_ = setpoint_;
  last_delayed_ = delayed_;
}

void LeadingAxisProxy::publish() noexcept {
  data.Position = setpoint_.position.value;
  data.Velocity = setpoint_.velocity;
  data.Acceleration = setpoint_.acceleration;
  auto& external = data.StatusExternalLeadingValue;
  external.ModuloLength = known_ && modulo_.enabled ? modulo_.length : 0.0;
  external.ModuloStartValue = known_ && modulo_.enabled ? modulo_.start : 0.0;
  external.AdjustmentTime = recorded_.empty() ? 0.0 : seconds(time_asked() - recorded_.newest_time());
  set_bit(data.StatusWord, ProxyBit::Control, true);
  set_bit(data.StatusWord, ProxyBit::Error, faulty());
  set_bit(data.StatusWord, ProxyBit::RestartActive, restarting_);
  set_bit(data.StatusWord, ProxyBit::OnlineStartValuesChanged, start_values_changed);
  set_bit(data.StatusWord, ProxyBit::LeadingValueValid, !faulty() && valid());
  set_bit(data.StatusWord, ProxyBit::LeadingValueModulo, known_ && modulo_.enabled);
  set_bit(data.StatusWord, ProxyBit::LeadingAxisControl, known_ && source_led_);
  count_tags.show(counters_);
}

// ---- Alarms and jobs
// --------------------------------------------------------------------------------------------------

/// The leading value is invalid: what follows it stops with 601.
void LeadingAxisProxy::fault(int alarm_number, const AlarmDetail& detail) noexcept {
  lost = true;
  raise_alarm(alarm_number, ProcessingEnd::leading_axis_proxy, *this, data, detail);
}

void LeadingAxisProxy::start(Job& job) noexcept {
  if (job.kind != JobKind::MC_Reset) return job.fail(ErrorId::no_technology_object);
  const ErrorId error = reset(job.as<ResetJob>().restart);
  if (error != ErrorId::none) return job.fail(error);
  job.phase = JobPhase::done;
}

/// Acknowledged, it begins anew with the source that is there. Another ring asks for a restart.
ErrorId LeadingAxisProxy::reset(bool restart) noexcept {
  if (!restart && data.ErrorDetail.Number == alarm::kLeadingModuloChanged) return ErrorId::technology_alarm;
  if (faulty() || restart) forget_source();
  clear_alarms(*this, data);
  if (!restart) return ErrorId::none;
  data = start_values_;
  start_values_changed = false;
  ++restarts_;
  restarted = lost = restarting_ = true;
  return ErrorId::none;
}

}  // namespace lockstep
