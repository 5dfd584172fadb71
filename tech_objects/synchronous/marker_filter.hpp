/// Markers that come irregularly, taken up smoothly: mean distance and trim of the gear, share of the first
/// correction, and corrections that are spread. Nothing here allocates or throws.
/// @source MCO 305 Design Guide, 33-28, 33-29; MG.33.L5.03: at least 100 markers
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lockstep {

struct MarkerFilterSettings {
  double time = 0.0;              ///< SYNCMFTIME [ms] > 0
  double offset_time = 0.0;       ///< SYNCOFFTIME [ms] ≥ 0
  double distance = 0.0;          ///< of the leading markers [counts] > 0
  double minimum_markers = 1.0;   ///< markers, for the mean distance
  bool fixed = false;             ///< bit 1: the constant is SYNCMFTIME / 300
  bool trims_gear = true;         ///< not bit 2
  bool by_time = false;           ///< bit 4: corrections are smoothed by SYNCMFTIME, not SYNCOFFTIME
  bool looks_at_distance = true;  ///< not bit 16
};

class MarkerFilter {
 public:
  void begin(double distance) noexcept {
    *this = {};
    distance_ = distance;
  }
  /// A leading marker. @param spacing from the last one [counts] > 0; 0: it is the first
  /// @param velocity of what leads, smoothed [counts/ms]
  void take_spacing(double spacing, double velocity, const MarkerFilterSettings& settings) noexcept {
    velocity_ = std::abs(velocity);
    if (spacing <= 0.0) return;
    last_ = spacing;
    constexpr double kFixedTime = 300.0, kTimes = 3.0;
    markers_ = settings.fixed ? settings.time / kFixedTime
                              : velocity_ * settings.time / (kTimes * settings.distance);
    const double mean = std::max(markers_, settings.minimum_markers);
    distance_ += (spacing - distance_) / std::max(mean, 1.0);
    trim_ =
        settings.trims_gear && settings.looks_at_distance ? (settings.distance - distance_) / distance_ : 0.0;
    if (!settings.looks_at_distance) return;
    errors_ += spacing - distance_;
    filtered_errors_ += (errors_ - filtered_errors_) / std::max(markers_, 1.0);
  }
  /// A pair. @param apart by how much what follows is behind [u]  @param first of all pairs
  /// @param ratio following per leading  @return what is to be corrected until the next one [u]
  double take_pair(double apart, bool first, double ratio, const MarkerFilterSettings& settings) noexcept {
    const double in_offset_time = velocity_ * settings.offset_time / settings.distance;
    if (first) {
      start_ = start_rest_ = apart;
      start_share_ = apart / std::max(in_offset_time, 1.0);
      correction_ = 0.0;
      return take_start();
    }
    unfiltered_ = apart - start_rest_;
    if (settings.looks_at_distance) unfiltered_ += (errors_ - filtered_errors_) * ratio;
    constants_ = settings.by_time ? velocity_ * settings.time / settings.distance : in_offset_time;
    correction_ += (unfiltered_ - correction_) / std::max(constants_, 1.0);
    return correction_ + take_start();
  }

  /// A pair whose correction is not filtered.
  void note_pair(double apart, bool first) noexcept { (first ? start_ : unfiltered_) = apart; }

  double trim() const noexcept { return trim_; }                ///< of the gear, a part of it
  double distance() const noexcept { return distance_; }        ///< filtered [counts]
  double last() const noexcept { return last_; }                ///< last spacing [counts]
  double start() const noexcept { return start_; }              ///< of the first pair [u]
  double start_rest() const noexcept { return start_rest_; }    ///< [u]
  double start_share() const noexcept { return start_share_; }  ///< [u]
  double correction() const noexcept { return correction_; }    ///< smoothed [u]
  double unfiltered() const noexcept { return unfiltered_; }    ///< [u]
  double markers() const noexcept { return markers_; }          ///< constant of the mean distance
  double constant() const noexcept { return constants_; }       ///< constant of the correction [markers]
  double errors() const noexcept { return errors_; }            ///< of the distances, summed [counts]
  double filtered_errors() const noexcept { return filtered_errors_; }  ///< [counts]

 private:
  double take_start() noexcept {
    const double share = std::abs(start_share_) < std::abs(start_rest_) ? start_share_ : start_rest_;
    start_rest_ -= share;
    return share;
  }

  double trim_ = 0.0;  // what every step needs
  double distance_ = 0.0, last_ = 0.0, velocity_ = 0.0, markers_ = 0.0;
  double errors_ = 0.0, filtered_errors_ = 0.0;
  double start_ = 0.0, start_rest_ = 0.0, start_share_ = 0.0, correction_ = 0.0, unfiltered_ = 0.0,
         constants_ = 0.0;
};

}  // namespace lockstep
