/// What is left of a distance, as a quintic over a distance that ends at zero.
#pragma once

namespace lockstep {

/// A quantity over a distance λ [leading u] with its derivatives, such as what a following axis is ahead of
/// its synchronous function at a place of a profile.
struct SyncOffset {
  double position = 0.0;   ///< [u] y
  double slope = 0.0;      ///< [u / leading u] dy/dλ
  double curvature = 0.0;  ///< [u / leading u²] d²y/dλ²

  /// [u/s] dy/dt; `distance_velocity` = dλ/dt [leading u/s].
  double velocity(double distance_velocity) const noexcept { return slope * distance_velocity; }
  /// [u/s²] d²y/dt².
  double acceleration(double distance_velocity, double distance_acceleration) const noexcept {
    return slope * distance_acceleration + curvature * distance_velocity * distance_velocity;
  }
};

/// The quintic y(λ) with given value, slope and curvature at λ = 0 that is zero, with zero slope and
/// curvature, at λ = D. It is held with the factor (D - λ)³, so that it ends there to the last bit. Any
/// thread.
class Remainder {
 public:
  /// @param start at λ = 0  @param distance D > 0 [leading u]
  void set(const SyncOffset& start, double distance) noexcept {
    distance_ = distance;
    per_distance_ = 1.0 / distance;
    a_ = start.position;
    b_ = start.slope * distance + 3.0 * a_;
    c_ = 0.5 * start.curvature * distance * distance + 3.0 * b_ - 3.0 * a_;
  }

  double distance() const noexcept { return distance_; }
  bool complete(double distance) const noexcept { return !(distance < distance_); }

  /// y and its derivatives; exactly 0 from λ = D on; λ < 0 continues the quintic.
  SyncOffset value(double distance) const noexcept {
    if (complete(distance)) return {};
    const double u = distance * per_distance_;
    // Exact at both ends, without a division.
    const double v = u < 0.5 ? 1.0 - u : (distance_ - distance) * per_distance_;
    const double q = a_ + u * (b_ + u * c_);
    const double dq = b_ + 2.0 * u * c_;
    return {.position = v * v * v * q,
            .slope = v * v * (v * dq - 3.0 * q) * per_distance_,
            .curvature = 2.0 * v * (v * (v * c_ - 3.0 * dq) + 3.0 * q) * per_distance_ * per_distance_};
  }

 private:
  double distance_ = 0.0;
  double per_distance_ = 0.0;
  double a_ = 0.0;  // y = (1 - u)³ (a + b u + c u²), u = λ / D
  double b_ = 0.0;
  double c_ = 0.0;
};

}  // namespace lockstep
