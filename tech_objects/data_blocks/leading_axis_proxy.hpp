/// The technology data block of a leading axis proxy. The declaration beside it tells of each variable its
/// path, effect class, unit, range and meaning.
/// @source S7-1500T synchronous operation V7, 13.3
#pragma once

#include "tech_objects/data_blocks/data_block.hpp"

namespace lockstep {

/// Telegram interface.
struct TO_Struct_LeadingAxisProxy_Interface {
  const bool* AddressIn{};
};

/// Leading-value adaptation.
struct TO_Struct_LeadingAxisProxy_Parameter {
  LREAL LocalLeadingValueDelayTime{};
  LREAL ToleranceTimeExternalLeadingValueInvalid{};
};

/// External leading value.
struct TO_Struct_LeadingAxisProxy_StatusData {
  LREAL ModuloLength{};
  LREAL ModuloStartValue{};
  LREAL AdjustmentTime{};
};

/// The whole technology data block of a leading axis proxy.
struct LeadingAxisProxyData {
  LREAL Position{};
  LREAL Velocity{};
  LREAL Acceleration{};
  TO_Struct_LeadingAxisProxy_Interface Interface{};
  TO_Struct_LeadingAxisProxy_Parameter Parameter{};
  TO_Struct_LeadingAxisProxy_StatusData StatusExternalLeadingValue{};
  DWORD StatusWord{};
  DWORD ErrorWord{};
  TO_Struct_ErrorDetail ErrorDetail{};
  DWORD WarningWord{};
};

}  // namespace lockstep
