// How following begins, and what few of its steps need.
#include "tech_objects/mco305/synchronization.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep::mco305 {
namespace {

constexpr std::int32_t kOwnFilterFrom = 1000;  // |SYNCVFTIME| [µs]; below that the table counts
constexpr std::int32_t kOffsetLater = 1000;    // SYNCMSTART: the offset waits for the first correction
constexpr double kThousand = 1000.0;

}  // namespace

void Synchronization::refresh(const ParameterValues& p, bool later_edition,
                              double velocity_maximum) noexcept {
  later_edition_ = later_edition;
  factor_master_ = p[kSyncFactM];
  factor_slave_ = p[kSyncFactS];
  gear_.set(factor_master_, factor_slave_);
  limits_.uncertainty = std::min(std::abs(gear_.ratio()), 1.0);
  position_offset_ = p.real(kSyncPosOffs);
  offset_time_ = std::max(p.real(kSyncOffTime), 0.0);
  next_accuracy_ = std::abs(std::int64_t{p[kSyncAccuracy]});
  signed_error_ = p[kSyncAccuracy] < 0;
  looks_ahead_ = p[kSyncType] == 1;
  filter_parameter_ = p[kSyncVfTime];
  smooths_ = filter_parameter_ < 0;
  filter_limit_ = later_edition ? p.real(kSyncVfLimit) : 0.0;
  filter_time_ = filter_time(p.real(kMasterEncoder));
  constexpr double kTimes = 5.0;  // of the velocity, as resolution for the table
  slave_filter_time_ = CountFilter::published_time(kTimes * velocity_maximum);
  master_tolerance_ = {p.real(kSyncMPulsM), std::max(p.real(kSyncMWinM), 0.0)};
  slave_tolerance_ = {p.real(kSyncMPulsS), std::max(p.real(kSyncMWinS), 0.0)};
  marks_per_pair_master_ = std::max(p[kSyncMarkM], 1);
  marks_per_pair_slave_ = std::max(p[kSyncMarkS], 1);
  ready_count_ = p[kSyncReadyCount];
  fault_count_ = p[kSyncFaultCount];
  start_ = p[kSyncMStart];
  filter_bits_ = p[kSyncMfPar];
  marker_filter_time_ = std::max(p.real(kSyncMfTime), 0.0);
  constexpr std::int32_t kAlways = 64;
  averages_ = marker_filter_time_ > 0.0 && (filter_bits_ & kAlways) != 0;
  maximum_correction_ = p.real(kSyncMMaxCorr);
  velocity_precontrol_ = later_edition ? p.real(kSyncFfVel) / kThousand : 0.0;
  constexpr double kPercent = 0.01;
  limits_.band = p[kSyncVelRel] > 0 ? kPercent * p.real(kSyncVelRel) : -1.0;
  limits_.reversal = static_cast<PursuitLimits::Reversal>(std::clamp(p[kRevers], 0, 2));
  offset_.set(master_tolerance_.distance, offset_time_, later_edition);
  offset_.want(wanted_offset());
  constexpr double kDither = 2.0;  // [qc of the master]
  const bool gives_back = later_edition && limits_.reversal != PursuitLimits::Reversal::free;
  const double ratio = std::abs(gear_.ratio());
  held_.set(gives_back ? master_tolerance_.distance * ratio : 0.0, offset_time_, kDither * ratio);
  gives_back_ = held_.active();
}

/// [ms]
double Synchronization::filter_time(double resolution) const noexcept {
  const std::int64_t time = std::abs(std::int64_t{filter_parameter_});
  return time < kOwnFilterFrom ? CountFilter::published_time(resolution)
                               : static_cast<double>(time) / kThousand;
}

/// [qc of the master]
double Synchronization::wanted_offset() const noexcept {
  const bool waits = mode_ == SyncMode::kMarkers && start_ >= kOffsetLater && !pairing_.paired();
  return waits ? 0.0 : position_offset_ + moved_origin_;
}

/// What counts of markers alone, for pairs [qc]: an offset is kept by them, so that the slave is marked that
/// much before or behind its master; where that is more than half a distance the partner is another one.
double Synchronization::pair_offset() const noexcept {
  const double distance = pair_distance(), whole = offset_.wanted() * gear_.ratio() / distance;
  const bool turns = distance > 0.0 && pairing_.paired();
  return correction_.wanted() + trimmed_ + (turns ? std::floor(whole + 0.5) * distance : 0.0);
}

/// All that counts from now on, beside the gear [qc].
double Synchronization::total_offset() const noexcept {
  return offset_.wanted() * gear_.ratio() + correction_.wanted() + trimmed_;
}

void Synchronization::take_limits(const FourSlopeLimits& limits) noexcept {
  limits_.velocity = limits.velocity;
  limits_.acceleration = limits.acceleration;
  limits_.deceleration = limits.deceleration;
}

void Synchronization::begin(SyncMode mode, const FourSlopeState& from, std::int64_t actual,
                            const FourSlopeLimits& limits, const MasterInput& master) noexcept {
  mode_ = mode;
  following_ = true;
  reached_ = false;
  take_limits(limits);
  pursuit_.begin(from.position, from.velocity);
  constexpr std::int64_t kKnown = 64;  // [ms] of the master that say how fast it is
  if (const std::int64_t known = master.known(kKnown); known > 0)
    pursuit_.expect(static_cast<double>(master.moved_in(known)) * gear_.ratio() / static_cast<double>(known),
                    static_cast<double>(known));
  last_velocity_ = from.velocity;
  velocity_filter_.begin(static_cast<double>(master.moved()));
  slave_filter_.begin(from.velocity);
  last_actual_ = actual;
  fading_.begin(velocity_filter_.velocity(), filter_time_);
  velocity_ = velocity_filter_.velocity();
  master_position_ = master.position();
  gear_.set(factor_master_, factor_slave_);
  gear_.begin(from.position);
  trimmed_ = 0.0;
  moved_origin_ = 0.0;
  quality_.clear();
  accuracy_ = next_accuracy_;
  error_ = 0;
  const bool averaged = averages_ && averaged_.distance() > 0.0;
  filter_.begin(averaged ? averaged_.distance() : master_tolerance_.distance);
  path_.clear();
  awaits_path_ = false;
  if (mode == SyncMode::kMarkers) begin_markers();
  correction_.begin(0.0);
  correction_.set(0.0, 0.0, false);
  offset_.begin(0.0);
  if (origin_defined_ && mode != SyncMode::kVelocity) begin_at_origin();
  offset_.want(wanted_offset());
  held_.begin();
  wanted_ = nearest_count(gear_.position() + offset_.reached() * gear_.ratio());
  target_ = before_ = {.position = gear_.position() + offset_.reached() * gear_.ratio(),
                       .velocity = velocity_ * gear_.ratio(),
                       .spread = 0.0};
  limits_.spread = 0.0;
}

/// Both are synchronous at the two places that have been defined, whatever SYNCPOSOFFS is: it is part of
/// them.
void Synchronization::begin_at_origin() noexcept {
  offset_.begin(wanted_offset());
  gear_.begin(origin_slave_ - wanted_offset() * gear_.ratio());
  const std::int64_t distance = master_position_ - origin_master_;
  constexpr std::int64_t kFar = std::int64_t{1} << 31;
  gear_.move(std::clamp(distance, -kFar, kFar));
  origin_defined_ = false;
}

void Synchronization::define_origin(std::int64_t master, double slave) noexcept {
  origin_defined_ = true;
  origin_master_ = master;
  origin_slave_ = slave;
}

void Synchronization::move_origin(std::int32_t by) noexcept {
  moved_origin_ += by;
  offset_.want(wanted_offset());
}

/// What SYNCVFLIMIT leaves of the filter time [ms].
double Synchronization::faded_time(double moved) noexcept {
  return fading_.step(moved, filter_time_, filter_limit_);
}

/// Along with a target that is ahead by what REVERS has held back, and not given back yet.
void Synchronization::pursue_what_holds_back() noexcept {
  const Target aim = pursued();
  limits_.spread = aim.spread;
  held_.step(aim.position, aim.velocity, pursuit_, limits_.only_forward(aim.velocity), limits_);
  limits_.spread += held_.velocity();
  pursuit_.step(aim.position + held_.by(), aim.velocity + held_.velocity(), limits_);
}

void Synchronization::follow_velocity(std::int64_t actual, bool controls_velocity) noexcept {
  pursuit_.follow(velocity_ * gear_.ratio(), limits_);
  const auto moved = static_cast<double>(actual - last_actual_);
  last_actual_ = actual;
  if (!controls_velocity) return;
  // The controller gets the error of the velocity, as a distance from where the axis is.
  const double own = slave_filter_.step(moved, slave_filter_time_);
  pursuit_.shift(static_cast<double>(actual) + pursuit_.velocity() - own - pursuit_.position());
}

void Synchronization::look_whether_reached() noexcept {
  if (awaits_path_ || path_.active()) return;
  reached_ = pursuit_.synchronous(limits_) ||
             std::abs(pursuit_.velocity() - pursued().velocity) <= limits_.acceleration;
}

std::int32_t Synchronization::status() const noexcept {
  return hits_ | (quality_.ready() ? kReadyFlag : 0) | (quality_.fault() ? kFaultFlag : 0) |
         (quality_.accurate() ? kAccuracyFlag : 0);
}

}  // namespace lockstep::mco305
