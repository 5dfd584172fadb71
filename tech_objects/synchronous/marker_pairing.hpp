/// Which marker of what follows belongs to which of what leads, and by how much they are apart.
/// Nothing here allocates or throws.
/// @source MCO 305 Design Guide, 33-23 start behaviour; SYNCM
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

namespace lockstep {

/// How the first pair is found.
enum class FirstPair : std::uint8_t {
  leading_first,    ///< the first of what leads, then the next of what follows
  following_first,  ///< the first of what follows, then the next of what leads
  first_two,        ///< the first of either
  forward,   ///< one of what follows with that in front of it: it catches up, in its direction of travel
  backward,  ///< one of what follows with that behind it: it brakes
  nearest    ///< one of what follows with the nearer one
};

class MarkerPairing {
 public:
  void begin(FirstPair rule) noexcept {
    rule_ = rule;
    paired_ = false;
    drop();
  }
  /// In which direction what follows travels, until this is called again.
  void travel(bool backwards) noexcept { backwards_ = backwards; }
  /// A marker of what leads. @param place where that one of what follows belongs, without offset [u]
  /// @param offset that counts now [u]  @param distance of two markers [u] ≥ 0; 0: not known
  /// @return if it completes a pair, by how much what follows is behind [u]
  std::optional<double> leading(double place, double offset, double distance) noexcept {
    if (!paired_ && rule_ == FirstPair::following_first && !following_) return std::nullopt;
    if (paired_ || !leading_ || any_will_do()) leading_ = place;
    return pair(offset, distance, following_);
  }
  /// A marker of what follows. @param place of it [u]
  std::optional<double> following(double place, double offset, double distance) noexcept {
    if (!paired_ && rule_ == FirstPair::leading_first && !leading_) return std::nullopt;
    if (paired_ || !following_ || any_will_do()) following_ = place;
    return pair(offset, distance, leading_);
  }
  /// One has been missed: its partner is not used.
  void drop() noexcept {
    leading_.reset();
    following_.reset();
  }
  /// Whether there has been a first pair.
  bool paired() const noexcept { return paired_; }

 private:
  bool any_will_do() const noexcept { return rule_ >= FirstPair::forward; }
  /// @param older the partner that has come before
  std::optional<double> pair(double offset, double distance, std::optional<double>& older) noexcept {
    if (!leading_ || !following_) return std::nullopt;
    double apart = *following_ - (*leading_ + offset);
    if (distance > 0.0) {
      const double turns = apart / distance;
      if (paired_) {
        if (std::abs(turns) > 0.5) {  // what it belongs to is still to come
          older.reset();
          return std::nullopt;
        }
      } else if (rule_ == FirstPair::forward || rule_ == FirstPair::backward) {
        const bool upwards = (rule_ == FirstPair::forward) != backwards_;
        apart -= (upwards ? std::floor(turns) : std::ceil(turns)) * distance;
      } else if (rule_ == FirstPair::nearest) {
        apart -= std::floor(turns + 0.5) * distance;
      }
    }
    paired_ = true;
    drop();
    return apart;
  }

  FirstPair rule_ = FirstPair::first_two;
  bool paired_ = false, backwards_ = false;
  std::optional<double> leading_, following_;
};

}  // namespace lockstep
