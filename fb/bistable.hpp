/// Bistable elements.
/// The published blocks of IEC 61131-3; the boxes of the same name in S7 ladder diagrams have the opposite
/// dominance.
/// @source IEC 61131-3:2013, 6.6.3.5.2, table 43
#pragma once

#include "fb/block.hpp"

namespace lockstep {

/// Q1 := S1 OR (NOT R AND Q1). FALSE until the first call.
struct SR final : Block {
  BOOL S1{};
  BOOL R{};
  BOOL Q1{};
  void call(std::int64_t now) noexcept override;

  static constexpr std::string_view kName = "SR";
  static constexpr std::string_view kText = "Holds a state; setting wins over resetting.";
  static constexpr std::string_view kSource = "IEC 61131-3:2013, 6.6.3.5.2";
  static constexpr auto kPins =
      pins(in<&SR::S1>("S1", Unit::kNone, kAny, "sets the state, whatever R says"),
           in<&SR::R>("R", Unit::kNone, kAny, "resets the state"), out<&SR::Q1>("Q1", "the state"));
};

/// Q1 := NOT R1 AND (S OR Q1). FALSE until the first call.
struct RS final : Block {
  BOOL S{};
  BOOL R1{};
  BOOL Q1{};
  void call(std::int64_t now) noexcept override;

  static constexpr std::string_view kName = "RS";
  static constexpr std::string_view kText = "Holds a state; resetting wins over setting.";
  static constexpr std::string_view kSource = "IEC 61131-3:2013, 6.6.3.5.2";
  static constexpr auto kPins =
      pins(in<&RS::S>("S", Unit::kNone, kAny, "sets the state"),
           in<&RS::R1>("R1", Unit::kNone, kAny, "resets the state, whatever S says"),
           out<&RS::Q1>("Q1", "the state"));
};

}  // namespace lockstep
