/// MC_SetAxisSTW: control bits of a drive that its axis does not use.
#pragma once

#include "fb/execute_block.hpp"

namespace lockstep {

/// Drives bits of the control words 1 and 2 of a PROFIdrive telegram. They stay until the next job or a
/// restart of the axis.
/// @source S7-1500T axis functions, MC_SetAxisSTW
/// @errors 16#8055 a mask selects a bit that the axis uses itself; 16#8FFF no drive
struct MC_SetAxisSTW final : ExecuteBlock {
  lockstep::Axis* Axis{};
  WORD STW1{};
  WORD STW1BitMask{};
  WORD STW2{};
  WORD STW2BitMask{};

  static constexpr std::string_view kName = "MC_SetAxisSTW";
  static constexpr std::string_view kText = "Drives bits of the control words that the axis does not use.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_SetAxisSTW";
  static constexpr auto kPins =
      pins(object<&MC_SetAxisSTW::Axis>("Axis", kAnyDrivenAxis, "axis whose drive gets them"), pin::kExecute,
           in<&MC_SetAxisSTW::STW1>("STW1", Unit::kNone, kAny, "values for control word 1"),
           in<&MC_SetAxisSTW::STW1BitMask>("STW1BitMask", Unit::kNone, kAny,
                                           "which bits of it to drive, of 8, 9 and 11 to 15",
                                           {.error = ErrorId::control_bits}),
           in<&MC_SetAxisSTW::STW2>("STW2", Unit::kNone, kAny, "values for control word 2"),
           in<&MC_SetAxisSTW::STW2BitMask>("STW2BitMask", Unit::kNone, kAny,
                                           "which bits of it to drive, of 0 to 11",
                                           {.error = ErrorId::control_bits}),
           pin::kDone, pin::kBusy, pin::kCommandAborted, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  TechnologyObject* target() const noexcept override { return Axis; }
};

}  // namespace lockstep
