/// Motion laws: normalised transitions between two working ranges of a cam, with given motion at both ends.
/// Not for the cycle: a law becomes segments or points of a cam. Nothing here allocates; any thread.
/// @source VDI 2143 part 1; S7-1500T synchronous operation V7, 8.1.3.11, 8.3.1, 8.3.3
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "tech_objects/data_blocks/cam_data.hpp"

namespace lockstep {

/// What the curve does at one end of a transition.
enum class MotionTask : std::uint8_t {
  rest,               ///< R: velocity and acceleration 0
  constant_velocity,  ///< G: velocity, no acceleration
  reversal,           ///< U: acceleration, no velocity
  motion              ///< B: velocity and acceleration
};

enum class MotionLawKind : std::uint8_t {
  line,
  quadratic_parabola,
  sine,
  polynomial,
  inclined_sine,
  modified_acceleration_trapezoid,
  modified_sine,
  harmonic_combination,
  double_harmonic_transition,
  sine_line_combination
};
inline constexpr std::size_t kMotionLaws = 10;

/// Up to which derivative a law takes over what is given at an end; each includes those before it.
enum class Continuity : std::uint8_t { not_applicable, position, velocity, acceleration, jerk };

/// The task with these derivatives.
MotionTask motion_task(double velocity, double acceleration) noexcept;
/// Letter of a task: R, G, U, B.
char task_letter(MotionTask task) noexcept;
/// Name of a law, such as "modified sine".
std::string_view motion_law_name(MotionLawKind law) noexcept;

/// What a law keeps at the start and the end of a transition.
struct Applicability {
  Continuity start = Continuity::not_applicable;
  Continuity end = Continuity::not_applicable;
};

/// The table of laws and pairs of tasks. The polynomial serves all 16 pairs. At a reversal or a motion the
/// laws with an acceleration of their own keep position and velocity; lambda or Ca can make the acceleration
/// fit. At a rest or constant velocity they step in acceleration.
Applicability applicability(MotionLawKind law, MotionTask start, MotionTask end) noexcept;

/// One end of a transition. For a polynomial, a derivative not given is not a condition; for every other law
/// it counts as 0.
struct MotionBoundary {
  double x = 0.0;                      ///< leading value
  double y = 0.0;                      ///< following value
  std::optional<double> velocity;      ///< first derivative [following u / leading u]
  std::optional<double> acceleration;  ///< second
  std::optional<double> jerk;          ///< third
};

/// What a transition is to be.
struct MotionLawRequest {
  MotionLawKind law = MotionLawKind::polynomial;
  MotionBoundary start;
  MotionBoundary end;
  /// Place of the inflection point, 0 … 1 exclusive, relative to the transition. None: where acceleration and
  /// deceleration are equally large between ends of equal velocity; a polynomial is then of one piece.
  std::optional<double> lambda;
  /// Maximum acceleration and deceleration, normalised by stroke and length², > 0. One of them instead of
  /// lambda (all laws with a single inflection point but the polynomial), or both for the sine-line
  /// combination.
  std::optional<double> ca;
  std::optional<double> ca_star;
};

enum class MotionLawError : std::uint8_t {
  none,
  not_finite,      ///< a number, or end.x not above start.x
  not_applicable,  ///< the pair of tasks is not in the table
  boundary,        ///< a line whose slopes are not its own, or conditions that no polynomial meets
  parameter        ///< lambda, Ca or Ca* that the law does not have or cannot meet
};

/// Following value and derivatives.
struct MotionValue {
  double position = 0.0;
  double velocity = 0.0;
  double acceleration = 0.0;
  double jerk = 0.0;
};

/// Maximum magnitudes over a transition. A jerk is infinite where the acceleration steps: inside, or at an
/// end whose task is rest or constant velocity.
struct MotionPeaks {
  double velocity = 0.0;      ///< Cv
  double acceleration = 0.0;  ///< Ca: in the direction of the stroke
  double deceleration = 0.0;  ///< Ca*: against it
  double jerk = 0.0;          ///< Cj
  double torque = 0.0;        ///< Cmdyn: velocity times acceleration
};

/// One stretch of a law: a polynomial and up to two sines in the distance from where it starts.
struct MotionPiece {
  double start = 0.0;  ///< leading value
  double length = 0.0;
  double coefficient[8] = {};
  struct Sine {
    double amplitude = 0.0;
    double frequency = 0.0;
    double phase = 0.0;
  } sine[2];

  MotionValue value(double distance) const noexcept;
};

/// A transition after a motion law.
class MotionLaw {
 public:
  static constexpr std::size_t kMaxPieces = 6;
  /// Points of a law that a cam holds as points, unless told otherwise.
  static constexpr std::size_t kDefaultPoints = 32;

  /// Makes the transition asked for; after an error `law` is as it was. An end that misses a velocity given
  /// by more than the law keeps (see the table) is no error, except for the line in G-G.
  static MotionLawError make(const MotionLawRequest& request, MotionLaw& law) noexcept;

  /// Value at a leading value, held at the ends outside.
  MotionValue value(double leading_value) const noexcept;

  /// Peaks in the units of the transition. Normalised: velocity over stroke/length, and so on; not a number
  /// for a stroke of 0.
  MotionPeaks peaks() const noexcept;
  MotionPeaks normalised_peaks() const noexcept;

  std::span<const MotionPiece> pieces() const noexcept { return {pieces_.data(), count_}; }
  double start() const noexcept { return pieces_[0].start; }
  double length() const noexcept { return length_; }
  double stroke() const noexcept { return stroke_; }

  /// Whether a cam holds the law as points: no segment has two sines.
  bool becomes_points() const noexcept;

  /// Writes the law as segments and returns how many; 0 if it becomes points or does not fit in. A polynomial
  /// of degree 7 becomes two of degree 6 that meet in the middle with its position, velocity and acceleration
  /// and have its ends up to the jerk.
  std::size_t segments(std::span<TO_Cam_Struct_SegmentData> segments) const noexcept;

  /// Writes points.size() (two at least) points of the law, evenly over the transition.
  void points(std::span<TO_Cam_Struct_PointData> points) const noexcept;

 private:
  friend class MotionLawMaker;

  std::array<MotionPiece, kMaxPieces> pieces_{};
  std::size_t count_ = 0;
  double end_ = 0.0;  // leading value
  double length_ = 0.0;
  double stroke_ = 0.0;
  MotionTask tasks_[2] = {};
};

}  // namespace lockstep
