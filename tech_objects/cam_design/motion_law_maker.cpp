/// How each law is made: of two halves, from each end to the inflection point, or of polynomials.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tech_objects/cam_design/motion_law.hpp"
#include "tech_objects/cam_design/motion_law_polynomial.hpp"

namespace lockstep {
namespace {

using std::numbers::pi;

/// Course of the acceleration over a stretch: 1; sin from 0 to 1; cos from 1 to 0; sin from 0 over 1 to 0; 0.
enum class Wave { constant, rising, falling, arch, none };

constexpr double kMean[] = {1.0, 2.0 / pi, 2.0 / pi, 2.0 / pi, 0.0};  // of the wave
/// What a wave of unit length and height adds to the position.
constexpr double kDistance[] = {0.5, 2.0 / pi - 4.0 / (pi * pi), 4.0 / (pi * pi), 1.0 / pi, 0.0};

/// Acceleration from one end of a law to its inflection point, as stretches of parts of that distance.
struct Half {
  struct Stretch {
    Wave wave;
    double part;
  } stretches[3];
  int count;

  double mean() const noexcept {
    double sum = 0.0;
    for (int i = 0; i < count; ++i) sum += stretches[i].part * kMean[static_cast<int>(stretches[i].wave)];
    return sum;
  }

  /// Share of the distance that the rise of the velocity from 0 covers of that at full velocity.
  double distance() const noexcept {
    double velocity = 0.0;
    double distance = 0.0;
    for (int i = 0; i < count; ++i) {
      const auto [wave, part] = stretches[i];
      distance += velocity * part + part * part * kDistance[static_cast<int>(wave)];
      velocity += part * kMean[static_cast<int>(wave)];
    }
    return distance / mean();
  }
};

constexpr Half kParabola{{{Wave::constant, 1.0}}, 1};
constexpr Half kSine{{{Wave::falling, 1.0}}, 1};
constexpr Half kInclinedSine{{{Wave::arch, 1.0}}, 1};
constexpr Half kModifiedSine{{{Wave::rising, 0.25}, {Wave::falling, 0.75}}, 2};
constexpr Half kTrapezoid{{{Wave::rising, 0.25}, {Wave::constant, 0.5}, {Wave::falling, 0.25}}, 3};
constexpr Half kTrapezoidFromReversal{{{Wave::constant, 0.75}, {Wave::falling, 0.25}}, 2};

constexpr Half sine_line(double ramp) {
  return {{{Wave::falling, ramp}, {Wave::none, 1.0 - ramp}}, 2};
}

bool has_acceleration(MotionTask task) noexcept {
  return task == MotionTask::reversal || task == MotionTask::motion;
}

Half half_of(MotionLawKind law, MotionTask task) noexcept {
  switch (law) {
    case MotionLawKind::quadratic_parabola:
      return kParabola;
    case MotionLawKind::sine:
      return kSine;
    case MotionLawKind::inclined_sine:
      return kInclinedSine;
    case MotionLawKind::modified_sine:
      return kModifiedSine;
    case MotionLawKind::modified_acceleration_trapezoid:
      return has_acceleration(task) ? kTrapezoidFromReversal : kTrapezoid;
    case MotionLawKind::harmonic_combination:
      return has_acceleration(task) ? kSine : kModifiedSine;
    default:
      return sine_line(0.5);
  }
}

/// Where a function that changes its sign between low and high is zero; none if it does not.
template <class Function>
std::optional<double> zero_between(const Function& f, double low, double high) noexcept {
  const bool rising = f(low) < 0.0;
  if ((f(high) < 0.0) == rising) return std::nullopt;
  for (int step = 0; step < 100; ++step) {
    const double middle = 0.5 * (low + high);
    ((f(middle) < 0.0) == rising ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

bool is_finite(const MotionBoundary& b) noexcept {
  return std::isfinite(b.x) && std::isfinite(b.y) && std::isfinite(b.velocity.value_or(0.0)) &&
         std::isfinite(b.acceleration.value_or(0.0)) && std::isfinite(b.jerk.value_or(0.0));
}

MotionTask task_of(const MotionBoundary& b) noexcept {
  return motion_task(b.velocity.value_or(0.0), b.acceleration.value_or(0.0));
}

bool positive(const std::optional<double>& value) noexcept {
  return !value || (*value > 0.0 && std::isfinite(*value));
}

}  // namespace

/// One transition in the making.
class MotionLawMaker {
 public:
  MotionLawMaker(const MotionLawRequest& request, MotionLaw& law) noexcept
      : request_(request),
        law_(law),
        length_(request.end.x - request.start.x),
        stroke_(request.end.y - request.start.y),
        start_velocity_(request.start.velocity.value_or(0.0)),
        end_velocity_(request.end.velocity.value_or(0.0)) {
    law_.end_ = request.end.x;
    law_.length_ = length_;
    law_.stroke_ = stroke_;
    law_.tasks_[0] = task_of(request.start);
    law_.tasks_[1] = task_of(request.end);
  }

  MotionLawError make() noexcept {
    switch (request_.law) {
      case MotionLawKind::line:
        return make_line();
      case MotionLawKind::polynomial:
        return make_polynomial();
      case MotionLawKind::double_harmonic_transition:
        return make_double_harmonic();
      case MotionLawKind::sine_line_combination:
        if (request_.ca || request_.ca_star) return make_sine_line_with_accelerations();
        [[fallthrough]];
      default:
        return make_halves();
    }
  }

 private:
  bool has_parameter() const noexcept { return request_.lambda || request_.ca || request_.ca_star; }

  MotionPiece& add_piece(double start, double length) noexcept {
    MotionPiece& piece = law_.pieces_[law_.count_++];
    piece = {};
    piece.start = start;
    piece.length = length;
    return piece;
  }

  MotionLawError make_line() noexcept {
    if (has_parameter()) return MotionLawError::parameter;
    const double slope = stroke_ / length_;
    if (law_.tasks_[0] == MotionTask::constant_velocity && law_.tasks_[1] == MotionTask::constant_velocity)
      for (const double given : {start_velocity_, end_velocity_})
        if (!(std::abs(given - slope) <= 1.0e-9 * std::abs(slope))) return MotionLawError::boundary;
    MotionPiece& piece = add_piece(request_.start.x, length_);
    piece.coefficient[0] = request_.start.y;
    piece.coefficient[1] = slope;
    return MotionLawError::none;
  }

  /// What an end gives, with its derivatives taken over a distance of 0 … 1.
  static EndConditions conditions(const MotionBoundary& end, double distance) noexcept {
    EndConditions result;
    result.derivative[0] = end.y;
    if (end.velocity) result.derivative[1] = *end.velocity * distance;
    if (end.acceleration) result.derivative[2] = *end.acceleration * distance * distance;
    if (end.jerk) result.derivative[3] = *end.jerk * distance * distance * distance;
    return result;
  }

  void add_polynomial(double start, double length, const double (&c)[8]) noexcept {
    MotionPiece& piece = add_piece(start, length);
    double scale = 1.0;
    for (int k = 0; k < 8; ++k) {
      piece.coefficient[k] = c[k] * scale;
      scale /= length;
    }
  }

  /// Whether the polynomial, of a degree that one segment holds, has its inflection point in the middle.
  bool turns_in_the_middle() const noexcept {
    const MotionBoundary& start = request_.start;
    const MotionBoundary& end = request_.end;
    return start.velocity && end.velocity && start_velocity_ == end_velocity_ &&
           start.acceleration.has_value() == end.acceleration.has_value() &&
           start.acceleration.value_or(0.0) == -end.acceleration.value_or(0.0) && !start.jerk && !end.jerk;
  }

  /// A lambda of 0.5 asks for nothing where the inflection point is in the middle anyway: one segment.
  MotionLawError make_polynomial() noexcept {
    if (request_.lambda && !(*request_.lambda == 0.5 && turns_in_the_middle())) return make_two_polynomials();
    if (request_.ca || request_.ca_star) return MotionLawError::parameter;
    double c[8];
    if (!polynomial_between(conditions(request_.start, length_), conditions(request_.end, length_), c))
      return MotionLawError::boundary;
    add_polynomial(request_.start.x, length_, c);
    return MotionLawError::none;
  }

  /// Two polynomials that meet in the inflection point with acceleration 0. Its position and velocity are
  /// those of the polynomial between rests, each half stretched to its distance; so the acceleration changes
  /// its sign there alone, which a smoother joint would not keep. The jerk steps unless lambda is in the
  /// middle.
  MotionLawError make_two_polynomials() noexcept {
    if (request_.ca || request_.ca_star || !request_.start.velocity || !request_.end.velocity)
      return MotionLawError::parameter;
    const double lambda = *request_.lambda;
    const double k = distance_of_polynomial(request_.start);
    const double velocity = inflection_velocity(k, distance_of_polynomial(request_.end), lambda);
    const double distances[2] = {lambda * length_, request_.end.x - (request_.start.x + lambda * length_)};
    MotionBoundary inflection;
    inflection.x = request_.start.x + distances[0];
    inflection.y = request_.start.y + distances[0] * (start_velocity_ + (velocity - start_velocity_) * k);
    inflection.velocity = velocity;
    inflection.acceleration = 0.0;
    double c[8];
    if (!polynomial_between(conditions(request_.start, distances[0]), conditions(inflection, distances[0]),
                            c))
      return MotionLawError::boundary;
    add_polynomial(request_.start.x, distances[0], c);
    if (!polynomial_between(conditions(inflection, distances[1]), conditions(request_.end, distances[1]), c))
      return MotionLawError::boundary;
    add_polynomial(inflection.x, distances[1], c);
    return MotionLawError::none;
  }

  /// Distance of a half (Half::mean) for the polynomials 2-3, 3-4-5 and 4-5-6-7: the inverse of their maximum
  /// velocity.
  static double distance_of_polynomial(const MotionBoundary& end) noexcept {
    if (end.jerk) return 16.0 / 35.0;
    return end.acceleration ? 8.0 / 15.0 : 2.0 / 3.0;
  }

  MotionLawError make_double_harmonic() noexcept {
    if (has_parameter()) return MotionLawError::parameter;
    const bool from_rest = law_.tasks_[0] == MotionTask::rest;
    MotionPiece& piece = add_piece(request_.start.x, length_);
    piece.coefficient[0] = request_.start.y + stroke_ * (from_rest ? 0.375 : 0.625);
    piece.sine[0] = {-0.5 * stroke_, pi / length_, 0.5 * pi};
    piece.sine[1] = {(from_rest ? 0.125 : -0.125) * stroke_, 2.0 * pi / length_, 0.5 * pi};
    return MotionLawError::none;
  }

  /// Velocity at the inflection point: with it both halves together cover the stroke.
  double inflection_velocity(double k1, double k2, double lambda) const noexcept {
    return (stroke_ / length_ - lambda * start_velocity_ * (1.0 - k1) -
            (1.0 - lambda) * end_velocity_ * (1.0 - k2)) /
           (lambda * k1 + (1.0 - lambda) * k2);
  }

  MotionLawError make_halves() noexcept {
    const Half first = half_of(request_.law, law_.tasks_[0]);
    const Half second = half_of(request_.law, law_.tasks_[1]);
    // Without a wish, acceleration and deceleration are equally large between ends of equal velocity.
    double lambda = second.mean() / (first.mean() + second.mean());
    if (request_.lambda) lambda = *request_.lambda;
    if (request_.ca || request_.ca_star) {
      if (request_.lambda || (request_.ca && request_.ca_star) || stroke_ == 0.0)
        return MotionLawError::parameter;
      const auto found = lambda_of_acceleration(first, second);
      if (!found) return MotionLawError::parameter;
      lambda = *found;
    }
    add_halves(first, second, lambda);
    return MotionLawError::none;
  }

  std::optional<double> lambda_of_acceleration(const Half& first, const Half& second) const noexcept {
    const double unit = stroke_ / (length_ * length_);
    const auto excess = [&](double lambda) {
      const double velocity = inflection_velocity(first.distance(), second.distance(), lambda);
      if (request_.ca)
        return (velocity - start_velocity_) / (lambda * length_ * first.mean()) / unit - *request_.ca;
      return (velocity - end_velocity_) / ((1.0 - lambda) * length_ * second.mean()) / unit -
             *request_.ca_star;
    };
    return zero_between(excess, 1.0e-9, 1.0 - 1.0e-9);
  }

  /// Ramps as long as the accelerations ask for, and a line between them.
  MotionLawError make_sine_line_with_accelerations() noexcept {
    if (!request_.ca || !request_.ca_star || request_.lambda || stroke_ == 0.0)
      return MotionLawError::parameter;
    // Normalised: a ramp from v to u takes π/2 (u - v)/C of the length and lags (1 - 2/π)(u - v) times that.
    const double v0 = start_velocity_ * length_ / stroke_;
    const double v1 = end_velocity_ * length_ / stroke_;
    const double lag = 0.5 * pi - 1.0;
    const double curvature = lag / *request_.ca + lag / *request_.ca_star;
    const double slope = lag * v0 / *request_.ca + lag * v1 / *request_.ca_star;
    const double maximum = (0.5 + slope) / curvature;  // beyond it the ramps lose more than the line gains
    const auto distance = [&](double u) {
      return u - lag * (u - v0) * (u - v0) / *request_.ca - lag * (u - v1) * (u - v1) / *request_.ca_star -
             1.0;
    };
    const auto velocity = zero_between(distance, std::max(v0, v1), maximum);
    if (!velocity) return MotionLawError::parameter;
    const double first = 0.5 * pi * (*velocity - v0) / *request_.ca;
    const double second = 0.5 * pi * (*velocity - v1) / *request_.ca_star;
    if (!(first > 0.0 && second > 0.0 && first + second <= 1.0)) return MotionLawError::parameter;
    const double lambda = 0.5 * (1.0 + first - second);  // the middle of the line
    add_halves(sine_line(first / lambda), sine_line(second / (1.0 - lambda)), lambda);
    return MotionLawError::none;
  }

  /// One stretch with an acceleration of a height, from where the last one ended.
  void add_stretch(Wave wave, double length, double height) noexcept {
    MotionPiece& piece = add_piece(x_, length);
    piece.coefficient[0] = y_;
    piece.coefficient[1] = velocity_;
    if (wave == Wave::constant) {
      piece.coefficient[2] = 0.5 * height;
    } else if (wave != Wave::none) {
      const double w = (wave == Wave::arch ? pi : 0.5 * pi) / length;
      set_wave(piece, height, w, wave == Wave::falling);
    }
    advance(piece);
  }

  /// Acceleration height · sin(w d), or cos(w d), on top of the position and velocity the piece begins with.
  static void set_wave(MotionPiece& piece, double height, double w, bool cosine) noexcept {
    const double amplitude = height / (w * w);
    if (cosine)
      piece.coefficient[0] += amplitude;
    else
      piece.coefficient[1] += height / w;
    piece.sine[0] = {-amplitude, w, cosine ? 0.5 * pi : 0.0};
  }

  void advance(const MotionPiece& piece) noexcept {
    const MotionValue value = piece.value(piece.length);
    x_ = piece.start + piece.length;
    y_ = value.position;
    velocity_ = value.velocity;
  }

  void add_halves(const Half& first, const Half& second, double lambda) noexcept {
    x_ = request_.start.x;
    y_ = request_.start.y;
    velocity_ = start_velocity_;
    const double distances[2] = {lambda * length_, (1.0 - lambda) * length_};
    const double velocity = inflection_velocity(first.distance(), second.distance(), lambda);
    const double heights[2] = {(velocity - start_velocity_) / (distances[0] * first.mean()),
                               (end_velocity_ - velocity) / (distances[1] * second.mean())};
    for (int i = 0; i < first.count; ++i) {
      if (i + 1 == first.count &&
          add_joined(first.stretches[i].wave, second.stretches[second.count - 1].wave,
                     first.stretches[i].part * distances[0],
                     second.stretches[second.count - 1].part * distances[1], heights)) {
        joined_ = true;
        break;
      }
      add_stretch(first.stretches[i].wave, first.stretches[i].part * distances[0], heights[0]);
    }
    for (int i = second.count - 1 - (joined_ ? 1 : 0); i >= 0;
         --i) {  // towards the end the waves run backwards
      Wave wave = second.stretches[i].wave;
      if (wave == Wave::rising)
        wave = Wave::falling;
      else if (wave == Wave::falling)
        wave = Wave::rising;
      add_stretch(wave, second.stretches[i].part * distances[1], heights[1]);
    }
    MotionPiece& last = law_.pieces_[law_.count_ - 1];
    last.length = request_.end.x - last.start;
  }

  /// The published numbers of segments: the trapezoid never joins, the modified sine between rests alone.
  bool may_join() const noexcept {
    if (request_.law == MotionLawKind::modified_sine)
      return law_.tasks_[0] == MotionTask::rest && law_.tasks_[1] == MotionTask::rest;
    return request_.law != MotionLawKind::modified_acceleration_trapezoid;
  }

  /// One piece for the stretches on both sides of the inflection point, where one formula has both.
  bool add_joined(Wave before, Wave after, double length_before, double length_after,
                  const double (&heights)[2]) noexcept {
    if (before != after || !may_join()) return false;
    const double length = length_before + length_after;
    if (before == Wave::none) {
      add_stretch(Wave::none, length, 0.0);
      return true;
    }
    const bool even = length_before == length_after && heights[0] == -heights[1];
    if (!even || (before != Wave::falling && before != Wave::arch)) return false;
    MotionPiece& piece = add_piece(x_, length);
    piece.coefficient[0] = y_;
    piece.coefficient[1] = velocity_;
    set_wave(piece, heights[0], (before == Wave::arch ? 2.0 : 1.0) * pi / length, before == Wave::falling);
    advance(piece);
    return true;
  }

  const MotionLawRequest& request_;
  MotionLaw& law_;
  double length_;
  double stroke_;
  double start_velocity_;
  double end_velocity_;
  // Where the next stretch begins.
  double x_ = 0.0;
  double y_ = 0.0;
  double velocity_ = 0.0;
  bool joined_ = false;
};

MotionLawError MotionLaw::make(const MotionLawRequest& request, MotionLaw& law) noexcept {
  if (!is_finite(request.start) || !is_finite(request.end) || !(request.start.x < request.end.x) ||
      !std::isfinite(request.end.x - request.start.x) || !std::isfinite(request.end.y - request.start.y))
    return MotionLawError::not_finite;
  const bool lambda_fits = !request.lambda || (*request.lambda > 0.0 && *request.lambda < 1.0);
  if (!lambda_fits || !positive(request.ca) || !positive(request.ca_star)) return MotionLawError::parameter;
  if (static_cast<std::size_t>(request.law) >= kMotionLaws ||
      applicability(request.law, task_of(request.start), task_of(request.end)).start ==
          Continuity::not_applicable)
    return MotionLawError::not_applicable;
  MotionLaw made;
  const MotionLawError error = MotionLawMaker(request, made).make();
  if (error != MotionLawError::none) return error;
  for (const MotionPiece& piece : made.pieces()) {
    const MotionValue end = piece.value(piece.length);
    if (!std::isfinite(end.position + end.velocity + end.acceleration + end.jerk) || !(piece.length > 0.0))
      return MotionLawError::not_finite;
  }
  law = made;
  return MotionLawError::none;
}

}  // namespace lockstep
