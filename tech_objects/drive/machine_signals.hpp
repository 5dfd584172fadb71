/// Marks and switches of a simulated machine, and the search for a homing mark among them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tech_objects/arithmetic/double_double.hpp"

namespace lockstep {

/// Positions from `from` to `to` [u] on the scale of the machine, both included; from ≤ to.
struct PositionRange {
  double from = 0.0;
  double to = 0.0;

  /// @param turn [u] after which the machine is where it was; 0: never, as on a line
  bool contains(double position, double turn) const noexcept;
};

/// Zero marks of the encoder: at `position`, and every `period` from there [u]; 0: this one only.
struct ZeroMarks {
  double position = 0.0;
  double period = 0.0;

  /// The first mark met on the way from one position to another [u]; one where the distance begins is none,
  /// one where it ends is. None if there is no such mark.
  std::optional<double> between(double from, double to) const noexcept;
};

/// A switch that is a BOOL tag: TRUE within a range of positions.
struct DigitalInput {
  bool* tag = nullptr;
  PositionRange range;
};

/// What stands along the path of a simulated machine, on a scale of its own: where it is at the beginning is
/// `start_position`, and homing moves no mark. Written while loading.
struct MachineSignals {
  double start_position = 0.0;  ///< [u]
  std::optional<ZeroMarks> zero_marks;
  std::optional<PositionRange> reference_cam;
  std::optional<double> limit_min;  ///< [u] the negative limit switch is pressed from here downwards
  std::optional<double> limit_max;  ///< [u] the positive one is pressed from here upwards
  std::vector<DigitalInput> digital_inputs;
};

/// What is a homing mark. Values of Sensor[].ActiveHoming.Mode and PassiveHoming.Mode.
/// @source S7-1500T synchronous operation V7, 13.1.12
enum class HomingMark : std::uint8_t {
  zero_mark = 0,
  zero_mark_after_cam = 1,  ///< the first zero mark after the reference cam has been left
  switch_edge = 2           ///< one of the two edges of a switch
};

/// Looks for a homing mark, one servo cycle after another. The cycle's thread.
class MarkSearch {
 public:
  /// @param direction 1, -1: in which the mark has to be passed; 0: any
  /// @param side -1, 1: the negative or positive edge of the switch
  void begin(HomingMark mark, int direction, int side) noexcept;
  void end() noexcept { active_ = false; }

  /// One servo cycle: position of the machine [u], and whether its reference cam or switch is active.
  void step(double position, bool on_switch, const std::optional<ZeroMarks>& zero_marks) noexcept;

  bool active() const noexcept { return active_; }
  bool found() const noexcept { return active_ && found_; }
  /// Where the mark is [u] on the scale of the machine: a zero mark exactly, an edge within a servo cycle.
  double place() const noexcept { return place_; }

 private:
  bool fits(int heading) const noexcept { return direction_ == 0 || heading == direction_; }
  void find(double place) noexcept {
    found_ = true;
    place_ = place;
  }
  void watch_cam(bool on_cam) noexcept;

  HomingMark mark_{};
  int direction_ = 0;
  int side_ = 0;
  bool active_ = false;
  bool found_ = false;
  bool begun_ = false;  // a position is known
  double last_position_ = 0.0;
  bool last_on_switch_ = false;
  int heading_ = 0;   // direction of the last distance
  int left_cam_ = 0;  // direction in which the cam has been left; 0: not yet
  double place_ = 0.0;
};

}  // namespace lockstep
