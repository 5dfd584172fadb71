/// A gear between counters: the following count is leading · following / leading factor, without any rounding
/// however long it runs. Nothing here allocates or throws.
#pragma once

#include <cmath>
#include <cstdint>

namespace lockstep {

class CountGear {
 public:
  /// The ratio of what follows to what leads. The position stays where it is, within one part of `leading`.
  /// @param leading -2³¹ … 2³¹, not 0; 0 leaves the ratio as it is  @param following -2³¹ … 2³¹
  void set(std::int64_t leading, std::int64_t following) noexcept {
    if (leading == 0) return;
    if (leading < 0) {
      leading = -leading;
      following = -following;
    }
    if (leading == leading_ && following == following_) return;
    const double part = fraction();
    leading_ = leading;
    following_ = following;
    ratio_ = static_cast<double>(following) / static_cast<double>(leading);
    begin(whole_, part);
  }
  /// Goes on from a position [qc of what follows], |position| ≤ 2⁵².
  void begin(double position) noexcept {
    const double whole = std::floor(position);
    begin(static_cast<std::int64_t>(whole), position - whole);
  }
  /// What leads has moved by so many counts, |counts| ≤ 2³¹.
  void move(std::int64_t counts) noexcept {
    if (leading_ == 1) {  // what needs no division
      whole_ += counts * following_;
      return;
    }
    rest_ += counts * following_;
    std::int64_t whole = rest_ / leading_;
    rest_ -= whole * leading_;
    if (rest_ < 0) {
      rest_ += leading_;
      --whole;
    }
    whole_ += whole;
  }

  std::int64_t whole() const noexcept { return whole_; }  ///< [qc] at or below the position
  /// [qc] beyond that, 0 … 1
  double fraction() const noexcept {
    return rest_ == 0 ? 0.0 : static_cast<double>(rest_) / static_cast<double>(leading_);
  }
  double position() const noexcept { return static_cast<double>(whole_) + fraction(); }  ///< [qc]
  double ratio() const noexcept { return ratio_; }  ///< following per leading

 private:
  void begin(std::int64_t whole, double part) noexcept {
    whole_ = whole;
    rest_ = static_cast<std::int64_t>(std::floor(part * static_cast<double>(leading_)));
  }

  std::int64_t leading_ = 1, following_ = 1;
  std::int64_t whole_ = 0, rest_ = 0;  // rest_: in parts of leading_, 0 … leading_ - 1
  double ratio_ = 1.0;
};

}  // namespace lockstep
