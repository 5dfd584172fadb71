/// The encoders of an axis: what they tell, how they lie, and which of them is operative.
/// @source S7-1500T axis functions, encoders of an axis, MC_SetSensor
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "tech_objects/arithmetic/axis_position.hpp"
#include "tech_objects/arithmetic/double_double.hpp"
#include "tech_objects/data_blocks/data_block.hpp"
#include "tech_objects/drive/drive.hpp"

namespace lockstep {

/// The encoder of the drive, number 0, and up to three at the machine itself. One is operative: it tells
/// where the axis is; the others are beside it. The play of the mechanics lies between the motor, with
/// encoder 0, and the load: `play` [u] is what the motor has made of it and the load has not. Positions are
/// those of the axis. The cycle's thread.
class Encoders {
 public:
  static constexpr std::size_t kCount = 4;

  // ---- At the start, and after a restart: `configure`, `begin`, and `begin_beside` for each of the others

  /// Takes over which encoders there are, how they lie, and which is operative. They go on counting.
  /// @param has_drive whether actual values are read at all  @param cycle of the servo [s]
  void configure(const AxisData& data, const DriveSettings& machine, bool has_drive, const Modulo& modulo,
                 double cycle) noexcept;
  /// The operative encoder shows 0 at this position, or another one.
  void begin(AxisPosition origin) noexcept { set_origin(origin); }
  void begin_beside(std::size_t encoder, AxisPosition origin, double play) noexcept;
  /// Where an encoder shows 0 that tells this position; an absolute one, adjusted by AbsEncoderOffset [u].
  AxisPosition origin_at(std::size_t encoder, AxisPosition here, double play) const noexcept;
  AxisPosition adjusted_origin(std::size_t encoder, double offset) const noexcept;
  /// By what the operative encoder would tell another position if it showed 0 there [u].
  double distance_to_origin(AxisPosition origin) const noexcept;

  std::size_t operative() const noexcept { return operative_; }
  bool exists(std::size_t encoder) const noexcept { return encoders_[encoder].exists; }
  bool absolute(std::size_t encoder) const noexcept { return encoders_[encoder].absolute; }
  bool beside(std::size_t encoder) const noexcept { return encoder != operative_ && exists(encoder); }
  /// Whether there are others than that of the drive.
  bool several() const noexcept { return several_; }

  /// Distance of the machine that the operative encoder tells as one unit; negative: it lies the other way
  /// round than the axis counts.
  double ratio() const noexcept { return encoders_[operative_].ratio * sign_; }

  // ---- Each servo cycle

  /// What the encoder of the drive has counted [u], as it lies.
  void count(const DoubleDouble& drive) noexcept { counted_ = drive; }
  const DoubleDouble& counted() const noexcept { return counted_; }
  /// Reads the encoders at the machine; what the operative one tells takes the place of what the drive has
  /// told.
  void read(DriveActual& now, Drive& drive) noexcept;
  /// Turns what the operative encoder tells into the direction of the axis.
  void orient(DriveActual& now) const noexcept;
  /// The position that the operative encoder tells. @param distance that it has counted, as the axis counts
  AxisPosition position_at(const DoubleDouble& distance) const noexcept {
    return advanced(origin_, distance, modulo_);
  }
  /// `position_at` of a servo cycle: brought onto the ring only where it leaves the turn of the last cycle.
  AxisPosition read_position(const DoubleDouble& distance) noexcept {
    const double value = rounded_sum(distance, on_turn_);
    return modulo_.contains(value) ? AxisPosition{turn_, value} : read_on_another_turn(distance);
  }
  /// One that is not operative, as it was read last: its state, and what it tells. One that fails goes on
  /// from where it was seen last, unless it is an absolute one; no alarm tells of it.
  void watch(std::size_t encoder, double play, TO_Struct_StatusSensor& status) noexcept;

  /// Whether the actual values do not count, since encoder or communication have failed.
  bool lost() const noexcept { return lost_; }
  void lose() noexcept { lost_ = true; }
  /// They count again: from where the axis was seen last; an absolute encoder knows better.
  void regain(AxisPosition here, double play) noexcept;

  /// What an encoder tells: the operative one `actual`.
  AxisPosition position(std::size_t encoder, AxisPosition actual) const noexcept {
    return encoder == operative_ ? actual : encoders_[encoder].seen;
  }
  /// Whether the values of an encoder are valid.
  bool valid(std::size_t encoder) const noexcept {
    return encoder == operative_ ? !lost_ : !encoders_[encoder].failed;
  }

  // ---- MC_SetSensor

  /// An encoder tells this position from now on, where it is.
  void place(std::size_t encoder, AxisPosition position, AxisPosition actual, double play) noexcept;
  /// Another encoder is operative from now on. What MC_SetSensor has added to the one that is left, if it is
  /// an absolute one, is given back.
  /// @return velocity that it tells [u/s]
  double switch_to(std::size_t encoder, AxisPosition actual) noexcept;

  // ---- Homing

  /// Homing renames what the operative encoder tells, all others, or one of those [u].
  void shift(double by) noexcept { set_origin(advanced(origin_, by, modulo_)); }
  void shift_beside(double by) noexcept;
  /// One that is not operative; what MC_SetSensor has added to it is left out.
  void rename(std::size_t encoder, double by) noexcept;
  /// AbsEncoderOffset of an encoder as it is: position of the axis less that of the encoder [u].
  /// @param first turn that counts as 0
  double offset(std::size_t encoder, std::int64_t first) const noexcept;
  /// Position of the machine [u from where it was at the beginning].
  AxisPosition position_of_machine(const DoubleDouble& place, double play) const noexcept;

 private:
  struct Encoder {
    AxisPosition origin;    // position where it shows 0; of the operative one: `origin_`
    AxisPosition seen;      // that it shows; of the operative one: that of the axis
    DoubleDouble reading;   // what it has counted, as it lies [u]; of the drive's own: `counted_`
    double sign = 1.0;      // -1: it lies the other way round
    double velocity = 0.0;  // as it lies [u/s]
    double lent = 0.0;      // by what MC_SetSensor has shifted an absolute one, until it is left [u]
    double ratio = 1.0;     // [u] that it tells over one unit of the machine
    double start = 0.0;     // what it tells where the machine is at the beginning, as it lies [u]
    bool exists = false, absolute = false;
    bool fails = false;   // in this cycle
    bool failed = false;  // as the data block shows it
  };

  double sign(std::size_t encoder) const noexcept {
    return encoder == operative_ ? sign_ : encoders_[encoder].sign;
  }
  DoubleDouble travel(std::size_t encoder, double play) const noexcept;
  void set_origin(AxisPosition origin) noexcept {
    origin_ = origin;
    turn_ = origin.turns;
    on_turn_ = to_double_double(origin.value);
  }
  AxisPosition read_on_another_turn(const DoubleDouble& distance) noexcept;

  // What every servo cycle touches.
  AxisPosition origin_;   // position where the operative encoder shows 0
  DoubleDouble counted_;  // by the encoder of the drive [u], as it lies
  double sign_ = 1.0;     // of the operative one
  std::size_t operative_ = 0;
  Modulo modulo_;
  std::int64_t turn_ = 0;  // on which the axis has been read last
  DoubleDouble on_turn_;   // `origin_`, seen from `turn_` [u]
  bool several_ = false, lost_ = false;

  double cycle_ = 0.001;  // of the servo [s]
  std::array<Encoder, kCount> encoders_;
};

}  // namespace lockstep
