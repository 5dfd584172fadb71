/// An absolute encoder: what it tells in so many data bits, as counts on a line; with the filter that bridges
/// what cannot be. Nothing here allocates or throws.
/// @source MCO 305 Design Guide, 32-02, 32-03, 32-05, 32-32; SYSVAR 16, 4102, 4103
#pragma once

#include <algorithm>
#include <cstdint>

namespace lockstep::mco305 {

/// Thread: that of the cycle, but for `configure`.
class AbsoluteEncoder {
 public:
  /// From where it stands at power-up. @param type ENCODERABSTYPE: 4: SSI, 5: with filter; others: none
  /// @param bits 8 to 37  @param place of what it is fixed to [qc]
  void configure(std::int32_t type, std::int32_t bits, std::int64_t place) noexcept {
    constexpr std::int32_t kPlain = 4, kFiltered = 5;
    present_ = type == kPlain || type == kFiltered;
    filters_ = type == kFiltered;
    constexpr std::int32_t kMinimumBits = 1, kMaximumBits = 37;
    range_ = std::int64_t{1} << std::clamp(bits, kMinimumBits, kMaximumBits);
    told_ = place & (range_ - 1);
    position_ = present_ ? told_ : 0;
  }
  bool present() const noexcept { return present_; }

  /// One of its read-outs, each millisecond. @param place of what it is fixed to [qc]  @param disturbed what
  /// the line adds to it  @param resolution positions of a turn  @return false: with filter, after 100 that
  /// could not be another one came, which has been taken
  bool read(std::int64_t place, std::int64_t disturbed, std::int64_t resolution) noexcept {
    constexpr int kBridged = 100;
    const std::int64_t told = (place + disturbed) & (range_ - 1);
    const std::int64_t leap = nearest(told - told_);
    const bool possible = !filters_ || (leap <= resolution / 2 && leap >= -(resolution / 2));
    if (!possible) ++errors_;
    if (!possible && bridged_ < kBridged) {
      ++bridged_;
      told_ = (told_ + velocity_) & (range_ - 1);
      position_ += velocity_;
      return true;
    }
    const bool lost = !possible;
    bridged_ = 0;
    told_ = told;
    position_ += leap;
    if (!lost) velocity_ = leap;
    return !lost;
  }

  std::int64_t position() const noexcept { return position_; }  ///< on a line [qc]
  std::int32_t errors() const noexcept { return errors_; }      ///< read-outs that could not be
  /// Whole turns since it left its range, of so many counts each; 0: it has not.
  std::int64_t turns(std::int64_t graduation) const noexcept {
    if (!present_ || graduation <= 0) return 0;
    const std::int64_t beyond = position_ >= range_ ? position_ - range_ : position_ < 0 ? position_ : 0;
    return beyond / graduation;
  }

 private:
  /// The shorter way round.
  std::int64_t nearest(std::int64_t leap) const noexcept {
    const std::int64_t up = leap & (range_ - 1);
    return up >= range_ / 2 ? up - range_ : up;
  }

  bool present_ = false, filters_ = false;
  std::int64_t range_ = 1;                // [qc]
  std::int64_t told_ = 0, position_ = 0;  // last read-out or what is taken for it; on a line [qc]
  std::int64_t velocity_ = 0;             // of the last one that could be [qc/ms]
  int bridged_ = 0;
  std::int32_t errors_ = 0;
};

}  // namespace lockstep::mco305
