/// One cam: a range of positions in which an output is on, or a place from which on it is on for a time.
/// @source S7-1500/S7-1500T measuring input and output cam functions, output cam
#pragma once

#include <array>
#include <cstddef>

#include "tech_objects/switching/switching_path.hpp"

namespace lockstep {

/// What a cam is.
struct SwitchingShape {
  bool timed = false;
  double on = 0.0;        ///< [u]
  double off = 0.0;       ///< [u] of a distance cam; on a ring on < off ≤ on + period
  double period = 0.0;    ///< after which it repeats [u]; 0: it does not
  double duration = 0.0;  ///< of a time cam [s]
  int directions = 3;     ///< 1 positive, 2 negative, 3 both
  /// By which the edges lead [s] ≥ 0.
  double on_lead = 0.0;
  double off_lead = 0.0;

  /// Where it is on: from `on` upwards and from `off` downwards, for off < on on a line.
  bool outside() const noexcept { return !timed && period == 0.0 && off < on; }
  bool effective(int direction) const noexcept {
    if (direction == 0) return directions == 3;
    return (directions & (direction > 0 ? 1 : 2)) != 0;
  }
};

/// A change of an output.
struct SwitchingEdge {
  double time = 0.0;  ///< [s] since the start of the run
  bool on = false;
};

/// The edges of a cam in a servo cycle, in the order of time.
struct SwitchingEdges {
  std::array<SwitchingEdge, 4> list{};
  std::size_t count = 0;
  void add(double time, bool on) noexcept {
    if (count < list.size()) list[count++] = {time, on};
  }
};

/// State of a cam. Edges lie where the position, led by velocity · lead time, passes their places; between
/// two servo ticks it moves on a straight line. Thread: the cycle.
class SingleCam {
 public:
  bool on() const noexcept { return on_; }

  /// Begins at a place: a distance cam shows by it whether it is on, a time cam waits for its crossing.
  /// @param inclusive whether a time cam that stands at its place has it still ahead
  void begin(const SwitchingShape& shape, const Stretch& end, int direction, bool inclusive,
             SwitchingEdges& edges) noexcept;
  /// Goes off, whatever it is.
  void end(double time, SwitchingEdges& edges) noexcept;
  /// Positions are called otherwise from now on.
  void rename(double from, double to) noexcept { front_ = (front_ - from) + to; }

  /// One servo cycle or a part of it.
  void step(const SwitchingShape& shape, const Stretch& distance, int direction,
            SwitchingEdges& edges) noexcept;
  /// One in which positions do not count; time goes on.
  void hold(double to_time, SwitchingEdges& edges) noexcept;

 private:
  void set(bool on, double time, SwitchingEdges& edges) noexcept;
  void step_distance(const SwitchingShape& shape, const Stretch& distance, int direction,
                     SwitchingEdges& edges) noexcept;
  void step_time(const SwitchingShape& shape, const Stretch& distance, int direction,
                 SwitchingEdges& edges) noexcept;

  bool on_ = false;
  double off_time_ = 0.0;  // of a time cam that is on [s]
  int front_direction_ = 0;
  double front_ = 0.0;  // furthest place of the led position in the direction [u]
};

}  // namespace lockstep
