/// The input of a measuring probe: edges and their times within a servo cycle.
#pragma once

#include <array>
#include <cstdint>

#include "tech_objects/arithmetic/double_double.hpp"

namespace lockstep {

/// Marks on the material: the probe sees one from `offset + n · period` on over `width`, whichever way the
/// material moves. Homing does not move them.
struct PrintMarks {
  double period = 100.0;  ///< [u] ≥ 0.001
  double offset = 0.0;    ///< [u] beginning of a mark, as positions are counted at the start
  double width = 1.0;     ///< [u] greater than 0 and less than the period
};

/// An edge in the servo cycle that has just passed.
struct Edge {
  bool rising = false;
  double part = 1.0;  ///< of the cycle after which it came: 0 … 1
};

/// The edges of a servo cycle in their order. Of more than can be told apart the number counts.
struct Edges {
  static constexpr std::size_t kMaximum = 32;
  std::array<Edge, kMaximum> list{};
  std::size_t count = 0;     ///< of the list
  std::int64_t rising = 0;   ///< all in the cycle
  std::int64_t falling = 0;  ///< all in the cycle

  void add(Edge edge) noexcept {
    if (count < kMaximum) list[count++] = edge;
  }
};

/// Thread: the cycle.
class ProbeSignal {
 public:
  /// The level from now on, without an edge.
  void begin(bool level) noexcept { level_ = level; }
  bool level() const noexcept { return level_; }

  /// An input that is read once in each cycle: an edge is where it is seen.
  void sample(bool level, Edges& edges) noexcept;

  /// Marks that have come past while the material moved from one place of its line to another [u].
  void move(const PrintMarks& marks, DoubleDouble from, DoubleDouble to, Edges& edges) noexcept;
  static bool on_mark(const PrintMarks& marks, DoubleDouble place) noexcept;

 private:
  bool level_ = false;
};

}  // namespace lockstep
