/// The PID function of APOSS: a filter with a memory, apart from the position controller.
/// @source MCO 305 Design Guide, PID; SET PID
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace lockstep::aposs {

/// u(n) = (KP·e(n) + KD·(e(n) − e(n−1)) + KI·Σe) / TIMER, cut towards 0. KILIM bounds the sum; 0 switches it
/// off.
class PidFilter {
 public:
  void clear() noexcept { *this = PidFilter(); }
  /// @param coefficient its index in `kPidCoefficients`; others, and a TIMER of 0, change nothing
  void set(std::int32_t coefficient, std::int32_t value) noexcept {
    constexpr std::int32_t kTimer = 4;
    if (coefficient < 0 || coefficient > kTimer || (coefficient == kTimer && value == 0)) return;
    coefficients_[static_cast<std::size_t>(coefficient)] = value;
  }
  std::int32_t step(std::int32_t deviation) noexcept {
    const auto [proportional, derivative, integral, limit, timer] = coefficients_;
    const std::int64_t maximum = limit < 0 ? -std::int64_t{limit} : limit;
    sum_ += deviation;
    if (sum_ > maximum) sum_ = maximum;
    if (sum_ < -maximum) sum_ = -maximum;
    const Wide value = (Wide{proportional} * deviation +
                        Wide{derivative} * (std::int64_t{deviation} - last_) + Wide{integral} * sum_) /
                       timer;
    last_ = deviation;
    constexpr Wide kMaximum = std::numeric_limits<std::int32_t>::max();
    return static_cast<std::int32_t>(std::clamp<Wide>(value, -kMaximum - 1, kMaximum));
  }

 private:
  __extension__ typedef __int128 Wide;  // three products of 32 bits each, and their sum

  std::array<std::int32_t, 5> coefficients_{1, 1, 0, 0, 1};
  std::int64_t sum_ = 0;
  std::int32_t last_ = 0;
};

}  // namespace lockstep::aposs
