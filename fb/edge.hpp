/// Edge detection.
/// @source IEC 61131-3:2013, 6.6.3.5.3
#pragma once

#include "fb/block.hpp"

namespace lockstep {

/// Q is TRUE for one call after CLK has risen.
struct R_TRIG final : Block {
  BOOL CLK{};
  BOOL Q{};
  void call(std::int64_t now) noexcept override;

  static constexpr std::string_view kName = "R_TRIG";
  static constexpr std::string_view kText = "Detects the rising edge of a signal.";
  static constexpr std::string_view kSource = "IEC 61131-3:2013, 6.6.3.5.3";
  static constexpr auto kPins = pins(in<&R_TRIG::CLK>("CLK", Unit::kNone, kAny, "signal to watch"),
                                     out<&R_TRIG::Q>("Q", "the signal has risen since the last call"));

 private:
  bool memory_ = false;
};

/// Q is TRUE for one call after CLK has fallen; a first call with CLK FALSE counts as a fall, as the
/// standard's body says.
struct F_TRIG final : Block {
  BOOL CLK{};
  BOOL Q{};
  void call(std::int64_t now) noexcept override;

  static constexpr std::string_view kName = "F_TRIG";
  static constexpr std::string_view kText = "Detects the falling edge of a signal.";
  static constexpr std::string_view kSource = "IEC 61131-3:2013, 6.6.3.5.3";
  static constexpr auto kPins = pins(in<&F_TRIG::CLK>("CLK", Unit::kNone, kAny, "signal to watch"),
                                     out<&F_TRIG::Q>("Q", "the signal has fallen since the last call"));

 private:
  bool memory_ = false;
};

}  // namespace lockstep
