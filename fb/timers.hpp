/// Timers. Time is that of the tick in which the instance is called, so Q and ET keep still between calls and
/// a duration is met in the first call at or after its end. PT is taken over with the edge that starts the
/// timing; a change while it runs counts from the next start (the standard leaves this to the implementation,
/// the S7-1500 does it so). PT ≤ 0 counts as 0. A start is an edge against the previous call of the instance;
/// before the first call, IN counts as FALSE.
/// @source IEC 61131-3:2013, 6.6.3.5.5, table 46
#pragma once

#include "fb/block.hpp"

namespace lockstep {

/// On-delay. PT = 0: Q is TRUE in the call of the rising edge.
struct TON final : Block {
  BOOL IN{};
  TIME PT{};
  BOOL Q{};
  TIME ET{};
  void call(std::int64_t now) noexcept override;

  static constexpr std::string_view kName = "TON";
  static constexpr std::string_view kText = "Delays a rising edge.";
  static constexpr std::string_view kSource = "IEC 61131-3:2013, 6.6.3.5.5";
  static constexpr auto kPins =
      pins(in<&TON::IN>("IN", Unit::kNone, kAny, "TRUE starts the delay, FALSE ends it at once"),
           in<&TON::PT>("PT", Unit::kNone, kAny, "delay, from the rising edge of IN; below 0 counts as 0"),
           out<&TON::Q>("Q", "IN has been TRUE for the delay"),
           out<&TON::ET>("ET", "time for which IN has been TRUE, up to the delay"));

 private:
  bool memory_ = false;
  std::int64_t start_ = 0;   // [ns]
  std::int64_t preset_ = 0;  // [ns]
};

/// Off-delay. PT = 0: Q follows IN. Q is FALSE until IN has been TRUE once.
struct TOF final : Block {
  BOOL IN{};
  TIME PT{};
  BOOL Q{};
  TIME ET{};
  void call(std::int64_t now) noexcept override;

  static constexpr std::string_view kName = "TOF";
  static constexpr std::string_view kText = "Delays a falling edge.";
  static constexpr std::string_view kSource = "IEC 61131-3:2013, 6.6.3.5.5";
  static constexpr auto kPins =
      pins(in<&TOF::IN>("IN", Unit::kNone, kAny, "TRUE sets Q at once, its falling edge starts the delay"),
           in<&TOF::PT>("PT", Unit::kNone, kAny, "delay, from the falling edge of IN; below 0 counts as 0"),
           out<&TOF::Q>("Q", "IN is TRUE or was so less than the delay ago"),
           out<&TOF::ET>("ET", "time since IN fell, up to the delay, at which it stays until IN rises"));

 private:
  bool memory_ = false;
  bool running_ = false;
  std::int64_t start_ = 0;   // [ns]
  std::int64_t preset_ = 0;  // [ns]
};

/// Pulse. A rising edge during the pulse does nothing; in the call that finds the pulse over it starts the
/// next one. PT = 0: no pulse.
struct TP final : Block {
  BOOL IN{};
  TIME PT{};
  BOOL Q{};
  TIME ET{};
  void call(std::int64_t now) noexcept override;

  static constexpr std::string_view kName = "TP";
  static constexpr std::string_view kText = "Makes a pulse of a given length.";
  static constexpr std::string_view kSource = "IEC 61131-3:2013, 6.6.3.5.5";
  static constexpr auto kPins = pins(
      in<&TP::IN>("IN", Unit::kNone, kAny, "its rising edge starts the pulse"),
      in<&TP::PT>("PT", Unit::kNone, kAny, "length of the pulse; 0 or less: no pulse"),
      out<&TP::Q>("Q", "the pulse"),
      out<&TP::ET>("ET", "time since the pulse began, up to its length, at which it stays while IN is TRUE"));

 private:
  bool memory_ = false;
  bool running_ = false;
  std::int64_t start_ = 0;   // [ns]
  std::int64_t preset_ = 0;  // [ns]
};

}  // namespace lockstep
