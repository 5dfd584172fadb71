/// A path onto a gear that ends where it is said to, with the velocity and without acceleration: a polynomial
/// of the fifth degree over what leads. Nothing here allocates or throws.
/// @source MG.33.L5.03, 33-23 [7]: the shape is named, not described
#pragma once

#include <algorithm>
#include <cmath>

namespace lockstep {

class MeetingPath {
 public:
  /// What it may ask for, at a velocity of what leads.
  struct Limits {
    double velocity = 0.0;      ///< [u/step] > 0
    double acceleration = 0.0;  ///< [u/step²] > 0
    double leading = 0.0;       ///< velocity of what leads [counts/step], not 0
    double ratio = 1.0;         ///< of the gear, following per leading
  };

  void clear() noexcept { length_ = 0.0; }
  /// @param begin of what leads [counts]  @param length over which it goes, signed as what leads moves, not 0
  /// @param behind from the gear, at the beginning [u]  @param slower than the gear, per count of what leads
  void begin(double begin, double length, double behind, double slower) noexcept {
    begin_ = begin;
    length_ = length;
    behind_ = behind;
    slower_ = slower * length;
  }
  bool active() const noexcept { return length_ != 0.0; }
  bool over(double leading) const noexcept { return part(leading) >= 1.0; }

  /// From the gear to the path [u]; 0 at its end.
  double offset(double leading) const noexcept {
    const double u = part(leading);
    return behind_ * (1.0 + u * u * u * (-10.0 + u * (15.0 - 6.0 * u))) +
           slower_ * u * (1.0 + u * u * (-6.0 + u * (8.0 - 3.0 * u)));
  }
  /// What that changes by per count of what leads.
  double slope(double leading) const noexcept {
    const double u = part(leading);
    const double by_part = behind_ * u * u * (-30.0 + u * (60.0 - 30.0 * u)) +
                           slower_ * (1.0 + u * u * (-18.0 + u * (32.0 - 15.0 * u)));
    return by_part / length_;
  }
  double curvature(double leading) const noexcept {
    const double u = part(leading);
    const double by_part =
        behind_ * u * (-60.0 + u * (180.0 - 120.0 * u)) + slower_ * u * (-36.0 + u * (96.0 - 60.0 * u));
    return by_part / (length_ * length_);
  }
  /// Whether it stays within limits, looked at in 32 places.
  bool within(const Limits& limits) const noexcept {
    constexpr int kPlaces = 32;
    for (int i = 0; i <= kPlaces; ++i) {
      const double leading = begin_ + length_ * i / kPlaces;
      if (std::abs((limits.ratio + slope(leading)) * limits.leading) > limits.velocity) return false;
      if (std::abs(curvature(leading)) * limits.leading * limits.leading > limits.acceleration) return false;
    }
    return true;
  }

 private:
  double part(double leading) const noexcept { return std::clamp((leading - begin_) / length_, 0.0, 1.0); }

  double length_ = 0.0, begin_ = 0.0;   // [counts]; first what tells whether there is a path
  double behind_ = 0.0, slower_ = 0.0;  // [u], of the whole length
};

}  // namespace lockstep
