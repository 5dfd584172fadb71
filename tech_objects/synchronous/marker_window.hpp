/// Which markers count: those where one is expected. Nothing here allocates or throws.
/// @source MCO 305 Design Guide, 33-17, 33-18, 33-21, 33-22; SYNCSTAT
#pragma once

#include <cmath>
#include <cstdint>

namespace lockstep {

/// Distance of markers, and by how much one may differ; both [u] ≥ 0.
struct MarkerTolerance {
  double distance = 0.0;
  double window = 0.0;  ///< 0: every marker counts
};

class MarkerWindow {
 public:
  /// What a marker or the want of one means.
  enum class Verdict : std::uint8_t {
    ignored,   ///< it lies where none is expected
    accepted,  ///< it counts
    late       ///< it counts, but one in front of it has been missed: there is no window
  };

  /// The next marker is the first one.
  void begin() noexcept { begun_ = false; }
  /// A marker. @param position of it [u]
  Verdict take(double position, const MarkerTolerance& allowed) noexcept {
    constexpr double kMissed = 1.8;  // of the distance
    const double distance = std::abs(position - last_);
    const bool first = !begun_;
    if (!first && allowed.window > 0.0 && std::abs(distance - allowed.distance) > allowed.window)
      return Verdict::ignored;
    spacing_ = first ? 0.0 : position - last_;
    begun_ = true;
    last_ = position;
    const bool late =
        !first && !(allowed.window > 0.0) && allowed.distance > 0.0 && distance >= kMissed * allowed.distance;
    return late ? Verdict::late : Verdict::accepted;
  }
  /// Whether a marker has just been missed; the next one is expected from where it should have been.
  bool missed(double position, const MarkerTolerance& allowed) noexcept {
    const double moved = position - last_;
    // First what most steps end with.
    if (std::abs(moved) <= allowed.distance + allowed.window) [[likely]]
      return false;
    if (!begun_ || !(allowed.window > 0.0) || !(allowed.distance > 0.0)) return false;
    last_ += moved < 0.0 ? -allowed.distance : allowed.distance;
    return true;
  }

  bool begun() const noexcept { return begun_; }
  double last() const noexcept { return last_; }        ///< last accepted, or last expected [u]
  double spacing() const noexcept { return spacing_; }  ///< between the last two, signed; 0: there is one [u]

 private:
  bool begun_ = false;
  double last_ = 0.0, spacing_ = 0.0;
};

}  // namespace lockstep
