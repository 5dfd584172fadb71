/// The master input of a device: what its master encoder counts, or its own virtual master.
/// @source MCO 305 Design Guide, MAPOS, MAVEL, MIPOS, DEFMORIGIN, SETMORIGIN; 32-30, 32-31, 33-19
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "tech_objects/arithmetic/cache_line.hpp"
#include "tech_objects/mco305/absolute_encoder.hpp"
#include "tech_objects/mco305/marker_track.hpp"
#include "tech_objects/mco305/units.hpp"
#include "tech_objects/mco305/virtual_master.hpp"
#include "tech_objects/mco305_catalogue/parameters.hpp"

namespace lockstep::mco305 {

/// Thread: that of the cycle, but for `configure`.
class MasterInput {
 public:
  /// @param wired whether there is an encoder, signal or device to count  @param disturbed added to what an
  /// absolute encoder tells [qc]; nullptr: nothing
  void configure(bool wired, const MarkerTrackSettings& markers,
                 const std::int32_t* disturbed = nullptr) noexcept {
    wired_ = wired;
    disturbed_ = disturbed;
    track_.configure(markers);
  }
  /// What it is, until the next time.
  void power_up(const ParameterValues& parameters) noexcept;
  void refresh(const ParameterValues& parameters, bool later_edition) noexcept;
  /// The input that has to be on for external markers to count; 0: none.
  std::int32_t enabling_input() const noexcept { return enabling_input_; }

  // ---- Steps

  /// What the encoder shows in a servo tick [qc], |encoder| < 2⁵³; before `step` of the same tick.
  void turn(double encoder) noexcept;
  /// The level of input 5 in a step, and whether external markers count.
  void look_at_marker(bool level, bool enabled) noexcept {
    enabled_ = enabled;
    if (level == last_level_) return;
    last_level_ = level;
    if (marker_type_ >= 2 && level == (marker_type_ == 2)) latch(static_cast<double>(position_));
  }
  /// An external marker at a place of the counter [qc].
  void mark(double place) noexcept;
  /// SWAPMENC: the counter and its zero change places with those.
  void exchange(std::int64_t& position, std::int64_t& origin) noexcept;
  /// One millisecond.
  void step() noexcept;
  /// Whether anything turns here, or has.
  bool present() const noexcept { return wired_ || begun_; }

  // ---- What a program asks

  void set_acceleration(std::int32_t value) noexcept { own_.set_acceleration(value); }  ///< PULSACC
  void set_velocity(std::int32_t value) noexcept;                                       ///< PULSVEL
  void stop() noexcept { own_.stop(); }                                                 ///< [Esc]
  /// DEFMORIGIN, SETMORIGIN: the position is this from now on [qc].
  void set_origin(std::int32_t value) noexcept { origin_ = position_ - value; }
  /// SYSVAR[4105] while MENCODERTYPE is 5, or MENCODERABSTYPE without an encoder. @return false: it is not
  bool move_to(std::int32_t value) noexcept;

  // ---- Read-outs

  std::int64_t position() const noexcept { return position_; }                         ///< [qc] counter
  std::int64_t moved() const noexcept { return moved_; }                               ///< [qc] in this step
  std::int32_t shown() const noexcept { return shown_position(position_ - origin_); }  ///< MAPOS
  std::int32_t shown_latch() const noexcept { return shown_position(latched_ - origin_); }  ///< MIPOS
  std::int64_t origin() const noexcept { return origin_; }
  /// How many of so many milliseconds there have been.
  std::int64_t known(std::int64_t milliseconds) const noexcept { return std::min(milliseconds, now_); }
  std::int64_t moved_in(std::int64_t milliseconds) const noexcept;        ///< [qc], up to 255 ms
  std::int32_t real_velocity() const noexcept { return real_velocity_; }  ///< SYSVAR 4128 [qc/s]
  bool is_absolute() const noexcept { return absolute_.present(); }
  const AbsoluteEncoder& absolute() const noexcept { return absolute_; }
  const VirtualMaster& own() const noexcept { return own_; }
  /// Markers of this step, in their order [qc].
  std::size_t mark_count() const noexcept { return mark_count_; }
  double mark(std::size_t index) const noexcept { return marks_[index]; }
  std::uint32_t latches() const noexcept { return latches_; }

 private:
  static constexpr std::size_t kRing = 256;
  static constexpr std::size_t kMarks = 8;  // of one step
  static constexpr std::int32_t kSimulated = 5;
  static constexpr std::int64_t kFastest = std::int64_t{1} << 30;  // what a gear takes in a step

  void move(std::int64_t counts) noexcept;
  void pass(double from, double to) noexcept;
  void pass_pulses(double from, double to) noexcept;
  void note_free(double turn) noexcept;
  void latch(double place) noexcept;
  void show_velocity() noexcept;
  void hand_over_marks() noexcept;

  void read_absolute() noexcept;
  void pass_absolute(double from, double to) noexcept;

  // In three lines what every step needs, with what there is of it at the begin of `own_` and `track_`.
  alignas(kCacheLine) bool wired_ = false;
  bool begun_ = false, heard_ = false, simulated_ = false, last_level_ = false, enabled_ = true;
  bool reads_absolute_ = false;  // `absolute_.present()`
  std::int32_t real_velocity_ = 0;
  std::int32_t type_ = 1, marker_type_ = 0;  // MENCODERTYPE, SYNCMTYPM
  std::uint32_t mark_count_ = 0, next_mark_count_ = 0;
  std::int64_t position_ = 0, last_ = 0, moved_ = 0, now_ = 0;
  std::int64_t turned_ = 0;  // whole counts of the encoder in this step
  VirtualMaster own_;
  double free_from_ = 0.0, free_to_ = 0.0;  // between these there is no zero pulse [qc]
  MarkerTrack track_;

  AbsoluteEncoder absolute_;
  double encoder_ = 0.0;
  std::int64_t shown_encoder_ = 0, origin_ = 0;  // shown_encoder_: whole counts of the encoder
  std::int32_t enabling_input_ = 0;
  std::array<double, kMarks> marks_{}, next_marks_{};
  std::int64_t latched_ = 0;
  std::uint32_t latches_ = 0;
  double turn_ = 4096.0;                             // [qc] of a turn of the encoder
  std::int32_t absolute_type_ = 0, data_bits_ = 25;  // MENCODERABSTYPE, MENCODERDATLEN
  std::int64_t resolution_ = 8192;                   // MENCODERABSRES
  std::int64_t read_ = 0;                            // where it was when it was read last [qc]
  const std::int32_t* disturbed_ = nullptr;
  std::array<std::int64_t, kRing> positions_{};
};

// What every step needs is inline: who calls it spares the call and what that saves.

[[gnu::always_inline]] inline void MasterInput::move(std::int64_t counts) noexcept {
  begun_ = begun_ || counts != 0;
  position_ = within_reach(position_ + counts);
}

/// The zero pulse of the encoder, or the markers that the sensor at input 5 sees.
[[gnu::always_inline]] inline void MasterInput::pass(double from, double to) noexcept {
  if (marker_type_ >= 2) return track_.pass(from, to, [this](double place) { latch(place); });
  if (from > free_from_ && from < free_to_ && to > free_from_ && to < free_to_) return;
  pass_pulses(from, to);
}

[[gnu::always_inline]] inline void MasterInput::step() noexcept {
  if (reads_absolute_) [[unlikely]]
    read_absolute();
  if (own_.active()) {
    const auto begin = static_cast<double>(position_);
    move(own_.step());
    pass(begin, static_cast<double>(position_));
  }
  const std::int64_t moved = position_ - last_;
  moved_ = moved;
  if (moved > kFastest || moved < -kFastest) [[unlikely]]
    moved_ = moved > 0 ? kFastest : -kFastest;
  last_ = position_;
  if (turned_ != 0 || real_velocity_ != 0) show_velocity();
  if (mark_count_ != 0 || next_mark_count_ != 0) [[unlikely]]
    hand_over_marks();
  ++now_;
  positions_[static_cast<std::size_t>(now_) % kRing] = position_;
}

}  // namespace lockstep::mco305
