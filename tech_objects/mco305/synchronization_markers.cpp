// Following by markers.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "tech_objects/mco305/synchronization.hpp"

namespace lockstep::mco305 {
namespace {

constexpr std::int32_t kStarts = 1000;  // SYNCMSTART: 1000 to 1007 begin like 0 to 7
constexpr std::int32_t kByPath = 7;

enum FilterBit : std::int32_t { kFixedConstant = 1, kNoTrim = 2, kByFilterTime = 4, kOnlySmoothing = 16 };

FirstPair first_pair(std::int32_t start) noexcept {
  constexpr FirstPair kRules[] = {FirstPair::leading_first, FirstPair::following_first, FirstPair::first_two,
                                  FirstPair::forward,       FirstPair::backward,        FirstPair::nearest,
                                  FirstPair::first_two,     FirstPair::nearest};
  return kRules[std::clamp(start % kStarts, 0, kByPath)];
}

/// Starts 2 to 5 and 7 wait until the velocity of the master has been reached.
bool waits_for_velocity(std::int32_t start) noexcept {
  const std::int32_t one = start % kStarts;
  return (one >= 2 && one <= 5) || one == kByPath;
}

}  // namespace

void Synchronization::begin_markers() noexcept {
  hits_ = 0;
  late_ = corrected_ = false;
  master_marks_ = slave_marks_ = 0;
  master_window_.begin();
  slave_window_.begin();
  pairing_.begin(first_pair(start_));
  awaits_path_ = start_ % kStarts == kByPath;
}

/// What markers have moved the slave by stays.
void Synchronization::restart_markers(bool whole) noexcept {
  if (!following_ || mode_ != SyncMode::kMarkers) return;
  late_ = false;
  master_marks_ = slave_marks_ = 0;
  master_window_.begin();
  slave_window_.begin();
  pairing_.drop();
  if (!whole) return;
  hits_ = 0;
  corrected_ = false;
  quality_.clear();
  filter_.begin(master_tolerance_.distance);
  pairing_.begin(first_pair(start_));
  offset_.want(wanted_offset());
}

/// From pair to pair, on the side of the slave [qc].
double Synchronization::pair_distance() const noexcept {
  return std::abs(gear_.ratio()) * master_tolerance_.distance * static_cast<double>(marks_per_pair_master_);
}

MarkerFilterSettings Synchronization::filter_settings() const noexcept {
  constexpr double kMeanOf = 100.0;
  return {.time = marker_filter_time_,
          .offset_time = offset_time_,
          .distance = std::max(master_tolerance_.distance, 1.0),
          .minimum_markers = later_edition_ ? kMeanOf : 1.0,
          .fixed = (filter_bits_ & kFixedConstant) != 0,
          .trims_gear = (filter_bits_ & kNoTrim) == 0,
          .by_time = (filter_bits_ & kByFilterTime) != 0 || (filter_bits_ & kOnlySmoothing) != 0,
          .looks_at_distance = (filter_bits_ & kOnlySmoothing) == 0};
}

/// What is missing is told by the marker behind it, while SYNCM does not tell it itself.
void Synchronization::average_markers(const MasterInput& master) noexcept {
  if (!(averaged_.distance() > 0.0)) averaged_.begin(master_tolerance_.distance);
  constexpr int kInARow = 64;
  int missed = 0;
  while (averaged_window_.missed(static_cast<double>(master.position()), master_tolerance_))
    if (++missed == kInARow) averaged_window_.begin();
  if (!by_markers()) hits_ = missed > 0 ? hits_ | kMasterMissed : hits_ & ~kMasterMissed;
  for (std::size_t i = 0; i < master.mark_count(); ++i) {
    if (averaged_window_.take(master.mark(i), master_tolerance_) == MarkerWindow::Verdict::ignored) continue;
    averaged_.take_spacing(std::abs(averaged_window_.spacing()), static_cast<double>(master.moved()),
                           filter_settings());
  }
}

void Synchronization::take_master_marks(const MasterInput& master) noexcept {
  for (std::size_t i = 0; i < master.mark_count(); ++i) take_master_mark(master.mark(i));
}

void Synchronization::take_master_mark(double place) noexcept {
  const MarkerWindow::Verdict verdict = master_window_.take(place, master_tolerance_);
  if (verdict == MarkerWindow::Verdict::ignored) return;
  if (verdict == MarkerWindow::Verdict::late) {
    hits_ |= kMasterMissed;
    late_ = true;
  }
  if (marker_filter_time_ > 0.0)
    filter_.take_spacing(std::abs(master_window_.spacing()), velocity_, filter_settings());
  if (++master_marks_ % marks_per_pair_master_ != 0) return;
  hits_ |= kMasterHit;
  if (awaits_path_) meet_at_a_marker(place);
  if (waits_for_velocity(start_) && !reached_) return;
  pairing_.travel(velocity_ * gear_.ratio() < 0.0);
  const double since = static_cast<double>(master_position_) - place;
  const auto apart =
      pairing_.leading(gear_.position() - since * gear_.ratio(), pair_offset(), pair_distance());
  if (apart) pair(*apart);
}

/// Start 7: from one marker of the master to a later one, as soon as its limits allow. Where the slave is
/// marked is known from its last marker; without one the distance is half of that of the gear, and the first
/// pair tells the rest.
void Synchronization::meet_at_a_marker(double place) noexcept {
  if (velocity_ == 0.0) return;
  constexpr int kMaximumMarkers = 1000;  // distances of markers; beyond that it is pursued like any target
  const double distance =
      std::copysign(master_tolerance_.distance * static_cast<double>(marks_per_pair_master_), velocity_);
  const double ratio = gear_.ratio();
  const double from = pursuit_.position(), moves = pursuit_.velocity() / velocity_;
  const double offset = total_offset();
  const double since = static_cast<double>(master_position_) - place;
  const double slave_distance = std::abs(ratio * distance);
  const MeetingPath::Limits limits{limits_.velocity, std::min(limits_.acceleration, limits_.deceleration),
                                   velocity_, ratio};
  awaits_path_ = false;
  for (int i = 1; i <= kMaximumMarkers && distance != 0.0; ++i) {
    const double length = distance * i - since;
    double end = from + length * (ratio + moves) / 2.0;
    if (slave_mark_known_ && slave_distance > 0.0) {
      const double mark = slave_mark_ + offset;
      end = mark + std::floor((end - mark) / slave_distance + 0.5) * slave_distance;
    }
    path_.begin(static_cast<double>(master_position_), length, from - (end - length * ratio), moves - ratio);
    if (path_.within(limits)) {
      gear_.begin(end - length * ratio - offset);
      offset_.begin(wanted_offset());
      return;
    }
  }
  path_.clear();
}

void Synchronization::follow_path() noexcept {
  const auto at = static_cast<double>(master_position_);
  target_.position += path_.offset(at);
  target_.velocity += path_.slope(at) * velocity_;
  if (path_.over(at)) path_.clear();
}

void Synchronization::take_slave_mark(double place) noexcept {
  if (!following_) return;
  if (mode_ == SyncMode::kPosition) return quality_.evaluate(ready_count_, fault_count_);
  if (mode_ != SyncMode::kMarkers) return;
  const MarkerWindow::Verdict verdict = slave_window_.take(place, slave_tolerance_);
  if (verdict == MarkerWindow::Verdict::ignored) return;
  if (verdict == MarkerWindow::Verdict::late) {
    hits_ |= kSlaveMissed;
    late_ = true;
  }
  if (++slave_marks_ % marks_per_pair_slave_ != 0) return;
  hits_ |= kSlaveHit;
  if (waits_for_velocity(start_) && !reached_) return;
  pairing_.travel(velocity_ * gear_.ratio() < 0.0);
  if (const auto apart = pairing_.following(place, pair_offset(), pair_distance())) pair(*apart);
}

/// Where one has been missed, its partner is not used.
void Synchronization::miss_master_mark() noexcept {
  hits_ |= kMasterMissed;
  if (++master_marks_ % marks_per_pair_master_ == 0) pairing_.drop();
}

void Synchronization::miss_slave_mark() noexcept {
  hits_ |= kSlaveMissed;
  if (++slave_marks_ % marks_per_pair_slave_ == 0) pairing_.drop();
}

/// By how much the slave is behind is a new offset.
void Synchronization::pair(double apart) noexcept {
  const bool first = !std::exchange(corrected_, true);
  quality_.evaluate(ready_count_, fault_count_);
  if (!std::exchange(late_, false)) hits_ &= ~(kMasterMissed | kSlaveMissed);
  const bool filters = marker_filter_time_ > 0.0;
  if (!filters) filter_.note_pair(apart, first);
  double correction = filters ? filter_.take_pair(apart, first, gear_.ratio(), filter_settings()) : apart;
  if (maximum_correction_ < 0.0) correction = 0.0;
  if (maximum_correction_ > 0.0)
    correction = std::clamp(correction, -maximum_correction_, maximum_correction_);
  const double wanted = correction_.wanted() + correction;
  constexpr double kBalanced = 100.0;  // SYNCVFTIME [µs] of a ms
  if (filters) {
    correction_.want_within(wanted, master_tolerance_.distance / std::max(std::abs(velocity_), 1e-3));
  } else if (filter_parameter_ < 0) {
    correction_.want_within(wanted, -static_cast<double>(filter_parameter_) / kBalanced);
  } else {
    correction_.set(pair_distance(), later_edition_ ? offset_time_ : 0.0, true);
    correction_.want(wanted);
  }
  offset_.want(wanted_offset());
}

}  // namespace lockstep::mco305
