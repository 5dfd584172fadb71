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

/// What it is more than that of the telegram before, so long has the source stood between them.
std::int64_t grid_of(const LeadingValueTelegram& telegram) noexcept {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(telegram.time) -
                                   telegram.sequence * static_cast<std::uint64_t>(telegram.cycle));
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

/// From now on it is the source of this telegram that counts.
void LeadingAxisProxy::know(const LeadingValueTelegram& telegram) noexcept {
  known_ = true;
  first_ = telegram.sequence;
  newest_ = telegram.sequence - 1;
  newest_time_ = telegram.time - 1;
  source_run_ = telegram.run;
  source_restarts_ = telegram.restarts;
  source_renamed_ = telegram.renamed;
  source_cycle_ = telegram.cycle;
  modulo_ = telegram.modulo;
  recorded_.set_source(modulo_, source_cycle_);
}

/// Whether a telegram is of the source that is followed; the first one says which that is. Another one in its
/// place counts at once as long as it has led nothing.
bool LeadingAxisProxy::adopt(const LeadingValueTelegram& telegram) noexcept {
  if (replaced_ || other_ring_) return false;
  if (!known_) {
    know(telegram);
    return true;
  }
  const bool newer = telegram.time > newest_time_;
  const bool ring = same_ring(telegram.modulo, modulo_);
  const bool same = telegram.run == source_run_ && telegram.restarts == source_restarts_ &&
                    telegram.cycle == source_cycle_ && (!newer || telegram.sequence > newest_);
  if (same && ring) return true;
  if (!newer) return false;
  if (led()) {
    (ring ? replaced_ : other_ring_) = true;
    return false;
  }
  forget_source();
  know(telegram);
  return true;
}

void LeadingAxisProxy::take(const LeadingValueTelegram& telegram, std::int64_t now) noexcept {
  // A tick that is late, but not missed, finds telegrams of what is ahead of its time.
  if (senseless(telegram) || telegram.time > now + std::max(telegram.cycle, cycle_) || !adopt(telegram)) {
    ++counters_.refused;
    return;
  }
  const bool newest = telegram.sequence > newest_;
  if (newest) {
    counters_.missing += telegram.sequence - newest_ - 1;
    newest_ = telegram.sequence;
    newest_time_ = telegram.time;
    source_valid_ = telegram.valid;
    source_led_ = telegram.position_led;
    delay_ = telegram.delay;
    rename_to(telegram.renamed);
  }
  record(telegram, newest);
}

/// Takes its value over, and counts it.
void LeadingAxisProxy::record(const LeadingValueTelegram& telegram, bool newest) noexcept {
  Setpoint value = telegram.value;
  const DoubleDouble behind = source_renamed_ - telegram.renamed;
  if (behind.hi != 0.0) value.position = advanced(value.position, behind, modulo_);
  const bool repeated = telegram.valid ? !recorded_.add(telegram.time, value, grid_of(telegram))
                                       : !newest && telegram.sequence == newest_;
  if (repeated) {
    ++counters_.doubled;
    return;
  }
  ++counters_.received;
  if (newest) return;
  ++counters_.late;
  if (telegram.sequence > first_ && counters_.missing > 0) --counters_.missing;
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
  local_delay_ =
      std::min(nanoseconds(data.Parameter.LocalLeadingValueDelayTime), kLongestLeadingDelay * cycle_);
  restarting_ = false;
  new_jobs_.take([this](Job& job) { start(job); });
  if (!faulty()) watch();
  if (!faulty() && (led() || valid()))
    lead();
  else
    setpoint_.velocity = setpoint_.acceleration = delayed_.velocity = delayed_.acceleration = 0.0;
  publish();
}

/// How old the newest value may be: as long as published, and longer where it is interpolated even so.
std::int64_t LeadingAxisProxy::longest_age() const noexcept {
  return std::max(kSourceCycles * source_cycle_ + kOwnCycles * cycle_, delay_ - local_delay_);
}

bool LeadingAxisProxy::valid() const noexcept {
  if (!known_ || replaced_ || other_ring_ || !source_valid_ || recorded_.empty()) return false;
  return now_ - recorded_.newest_time() <= longest_age() &&
         recorded_.reaches_back_to(std::min(time_asked(), now_ - delay_));
}

/// What has begun to lead has to stay valid, but for the tolerance time. Ticks that are left out do not
/// count: in them nobody has looked.
void LeadingAxisProxy::watch() noexcept {
  if (other_ring_) return fault(alarm::kLeadingModuloChanged);
  if (valid() || !led()) {
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
  const bool begins = !led();
  last_setpoint_ = setpoint_;
  last_delayed_ = delayed_;
  // What has not been brought forward so far is, behind the delay, as it has been given.
  if (local_delay_ != 0 && !undelayed_.begun()) undelayed_ = adapted_;
  setpoint_ = adapted_.step(recorded_, now_, time_asked(), longer_cycle());
  delayed_ = !undelayed_.begun() && local_delay_ == 0
                 ? setpoint_
                 : undelayed_.step(recorded_, now_, now_ - delay_, longer_cycle());
  recorded_.mark_unchanged();
  if (!within_limits(setpoint_) || !within_limits(delayed_)) return lose_range();
  if (!begins) return;
  last_setpoint_ = setpoint_;
  last_delayed_ = delayed_;
}

/// Extrapolated without end, a value leaves every range: it stays where it was.
void LeadingAxisProxy::lose_range() noexcept {
  setpoint_.position = last_setpoint_.position;
  delayed_.position = last_delayed_.position;
  setpoint_.velocity = setpoint_.acceleration = delayed_.velocity = delayed_.acceleration = 0.0;
  fault(alarm::kLeadingValuesInvalid,
        {.value = seconds(invalid_for_), .limit = data.Parameter.ToleranceTimeExternalLeadingValueInvalid});
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
