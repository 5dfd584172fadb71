/// How a device follows its master: by velocity, by position, by markers.
/// @source MCO 305 Design Guide, SYNCV, SYNCP, SYNCM; 33-1*, 33-2*, 33-3*
#pragma once

#include <algorithm>
#include <cstdint>

#include "tech_objects/arithmetic/cache_line.hpp"
#include "tech_objects/mco305/master_input.hpp"
#include "tech_objects/mco305_catalogue/parameters.hpp"
#include "tech_objects/profile/four_slope_profile.hpp"
#include "tech_objects/synchronous/count_filter.hpp"
#include "tech_objects/synchronous/count_gear.hpp"
#include "tech_objects/synchronous/held_back.hpp"
#include "tech_objects/synchronous/marker_filter.hpp"
#include "tech_objects/synchronous/marker_pairing.hpp"
#include "tech_objects/synchronous/marker_window.hpp"
#include "tech_objects/synchronous/meeting_path.hpp"
#include "tech_objects/synchronous/offset_spread.hpp"
#include "tech_objects/synchronous/pursuit.hpp"
#include "tech_objects/synchronous/sync_quality.hpp"

namespace lockstep::mco305 {

enum class SyncMode : std::uint8_t { kNone, kVelocity, kPosition, kMarkers };

/// Bits of SYNCSTAT.
enum SyncFlag : std::int32_t {
  kReadyFlag = 1,
  kFaultFlag = 2,
  kAccuracyFlag = 4,
  kMasterHit = 8,
  kSlaveHit = 16,
  kMasterMissed = 32,
  kSlaveMissed = 64
};

/// Thread: that of the cycle. Positions are qc of the counters.
class Synchronization {
 public:
  /// Looks at the parameters; when they have changed, also while it follows. @param velocity_maximum [qc/ms]
  void refresh(const ParameterValues& parameters, bool later_edition, double velocity_maximum) noexcept;

  /// SYNCV, SYNCP, SYNCM: from a motion, which it takes over. @param actual where the slave is [qc]
  /// @param limits VEL, ACC, DEC
  void begin(SyncMode mode, const FourSlopeState& from, std::int64_t actual, const FourSlopeLimits& limits,
             const MasterInput& master) noexcept;
  /// It does not set the position any more; from 5.00 on SYNCERR goes on.
  void end() noexcept { following_ = false; }
  /// DEF SYNCORIGIN, for the next SYNCP or SYNCM: a master position and that of the slave [qc].
  void define_origin(std::int64_t master, double slave) noexcept;
  /// MOVESYNCORIGIN [qc of the master].
  void move_origin(std::int32_t by) noexcept;

  /// Where the slave is marked, while it does not follow [qc].
  void note_slave_mark(double place) noexcept {
    slave_mark_known_ = true;
    slave_mark_ = place;
  }
  /// SYNCMFPAR 64: the distance of the master's markers is averaged whatever it does. Each millisecond,
  /// behind that of the master.
  void average(const MasterInput& master) noexcept {
    if (master.mark_count() != 0 && averages_) average_markers(master);
  }
  /// A marker of the slave has been latched [qc].
  void take_slave_mark(double place) noexcept;

  // ---- Steps, in `synchronization_step.hpp`

  /// One millisecond, behind that of the master. @param actual position of the slave [qc]
  void step(const MasterInput& master, std::int64_t actual) noexcept;
  /// At the end of a step: how accurate it is. @param actual [qc]
  void judge(std::int64_t actual) noexcept;
  /// Moves the set position in this step. @param actual [qc]  @param controls_velocity a drive follows, which
  /// gets no position but in SYNCV the error of its velocity
  void set_point(std::int64_t actual, bool controls_velocity) noexcept;

  // ---- Read-outs

  double set_position() const noexcept { return pursuit_.position(); }  ///< [qc]
  double set_velocity() const noexcept { return pursuit_.velocity(); }  ///< [qc/ms]
  /// [qc/ms²] What single counts do to the velocity is no acceleration that a motion could begin with.
  double set_acceleration() const noexcept {
    const double change = std::max(limits_.acceleration, limits_.deceleration);
    return std::clamp(pursuit_.velocity() - last_velocity_, -change, change);
  }

  SyncMode mode() const noexcept { return mode_; }
  /// Whether `step` has anything to do.
  bool runs() const noexcept { return following_ || (later_edition_ && mode_ >= SyncMode::kPosition); }
  /// SYNCERR [qc]: where it should be with all that is pending, less where it is; its sign only where
  /// SYNCACCURACY is negative.
  std::int64_t error() const noexcept { return signed_error_ || error_ >= 0 ? error_ : -error_; }

  std::int32_t status() const noexcept;                                             ///< SYNCSTAT
  void clear_status(std::int32_t bits) noexcept { hits_ &= ~(bits & kClearable); }  ///< SYNCSTATCLR
  /// SYNCMARKERSTART, while SYNCM follows: the next markers are the first ones, wherever they lie. The set
  /// position does not step. @param whole the start behaviour, the filter and the flags begin anew as well
  void restart_markers(bool whole) noexcept;
  /// What it goes by, or what SYNCMFPAR 64 averages meanwhile.
  const MarkerFilter& filter() const noexcept { return averages_ && !by_markers() ? averaged_ : filter_; }
  double slave_spacing() const noexcept { return slave_window_.spacing(); }    ///< [qc]
  double master_spacing() const noexcept { return master_window_.spacing(); }  ///< [qc]
  double master_velocity() const noexcept { return velocity_; }                ///< smoothed [qc/ms]

 private:
  struct Target {
    double position = 0.0, velocity = 0.0;
    double spread = 0.0;  // of that velocity what spreads offsets and corrections
  };

  static constexpr std::int32_t kClearable = kMasterHit | kSlaveHit | kMasterMissed | kSlaveMissed;

  bool by_markers() const noexcept { return following_ && mode_ == SyncMode::kMarkers; }
  double filter_time(double resolution) const noexcept;
  double wanted_offset() const noexcept;
  double pair_offset() const noexcept;
  double total_offset() const noexcept;
  double pair_distance() const noexcept;
  void take_limits(const FourSlopeLimits& limits) noexcept;
  void begin_markers() noexcept;
  void begin_at_origin() noexcept;
  void average_markers(const MasterInput& master) noexcept;
  void look_for_markers(const MasterInput& master, std::int64_t actual) noexcept;
  void take_master_marks(const MasterInput& master) noexcept;
  void take_master_mark(double place) noexcept;
  void miss_master_mark() noexcept;
  void miss_slave_mark() noexcept;
  void pair(double apart) noexcept;
  void meet_at_a_marker(double place) noexcept;
  void follow_path() noexcept;
  void follow_velocity(std::int64_t actual, bool controls_velocity) noexcept;
  double faded_time(double moved) noexcept;
  void pursue_what_holds_back() noexcept;
  void look_whether_reached() noexcept;
  /// Which target it pursues: by SYNCTYPE that of this step, or of the one before.
  const Target& pursued() const noexcept { return looks_ahead_ ? target_ : before_; }
  MarkerFilterSettings filter_settings() const noexcept;

  // In the order of need, so that a step touches few lines of the cache. First what steps of SYNCM need
  // alone.
  alignas(kCacheLine) MarkerTolerance master_tolerance_;
  MarkerTolerance slave_tolerance_;
  MarkerWindow master_window_, slave_window_;
  CountFilter velocity_filter_;
  double filter_time_ = 1.0, filter_limit_ = 0.0;
  std::int64_t master_marks_ = 0, slave_marks_ = 0;

  HeldBack held_;  // by REVERS [qc]
  double moved_origin_ = 0.0;
  double slave_filter_time_ = 1.0;  // [ms]
  CountFilter slave_filter_;
  std::int64_t last_actual_ = 0;

  // What all steps of following need, in seven lines: from the flags of `quality_`, at its end, to the trim
  // of `filter_`, at its begin.
  SyncQuality quality_;
  SyncMode mode_ = SyncMode::kNone;
  bool following_ = false, later_edition_ = true, looks_ahead_ = false;
  bool reached_ = false;                        // the velocity of the master, since the start
  bool awaits_path_ = false, smooths_ = false;  // smooths_: the velocity of the master, SYNCVFTIME
  bool gives_back_ = false;                     // `held_.active()`
  CountGear gear_;
  double velocity_precontrol_ = 0.0;
  double trimmed_ = 0.0;  // by the trim of the gear [qc]
  std::int64_t master_position_ = 0;
  double velocity_ = 0.0;   // of the master, smoothed [qc/ms]
  Target target_, before_;  // of this step, and of the one before
  Pursuit pursuit_;
  PursuitLimits limits_;
  double last_velocity_ = 0.0;  // [qc/ms] of the set position
  std::int64_t error_ = 0, wanted_ = 0, accuracy_ = 1000;
  OffsetSpread offset_;      // [qc of the master]
  OffsetSpread correction_;  // by markers [qc]
  MeetingPath path_;         // start 7
  MarkerFilter filter_;

  std::int32_t filter_parameter_ = 0, hits_ = 0;
  bool averages_ = false, signed_error_ = false;
  FadingTime fading_;
  bool origin_defined_ = false;
  std::int64_t origin_master_ = 0;
  double origin_slave_ = 0.0;
  MarkerPairing pairing_;
  MarkerWindow averaged_window_;
  MarkerFilter averaged_;
  bool corrected_ = false;  // there has been a pair
  bool late_ = false;       // the marker at hand came behind a missed one
  bool slave_mark_known_ = false;
  double slave_mark_ = 0.0;  // the last one there was, also before the start [qc]

  // Parameters.
  std::int64_t factor_master_ = 1, factor_slave_ = 1;
  double position_offset_ = 0.0, offset_time_ = 0.0;
  std::int64_t marks_per_pair_master_ = 1, marks_per_pair_slave_ = 1;
  std::int64_t ready_count_ = 1, fault_count_ = 10;
  std::int64_t next_accuracy_ = 1000;  // from the next begin on
  std::int32_t start_ = 0, filter_bits_ = 0;
  double marker_filter_time_ = 0.0, maximum_correction_ = 0.0;
};

}  // namespace lockstep::mco305
