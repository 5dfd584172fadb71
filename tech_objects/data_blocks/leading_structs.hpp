/// Of the technology data block of an axis: how it leads others, here and on other controllers.
/// @source S7-1500T synchronous operation V7, 13.1
#pragma once

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// Leading-value output interfaces.
struct TO_Struct_CrossPlcLeadingValueInterface {
  BOOL EnableLeadingValueOutput{};
  const bool* AddressOut{};
};

/// Cross-PLC synchronous operation.
struct TO_Struct_CrossPlcSynchronousOperation {
  TO_Struct_CrossPlcLeadingValueInterface Interface[8]{};
  LREAL LocalLeadingValueDelayTime{};
};

/// Extrapolation settings.
struct TO_Struct_ExtrapolationSettings {
  DINT SystemDefinedExtrapolation = 1;
  DINT ExtrapolatedVelocityMode{};
};

/// Position filter (PT2).
struct TO_Struct_ExtrapolationPositionFilter {
  LREAL T1{};
  LREAL T2{};
};

/// Velocity filter (PT2).
struct TO_Struct_ExtrapolationVelocityFilter {
  LREAL T1{};
  LREAL T2{};
};

/// Velocity tolerance band.
struct TO_Struct_ExtrapolationVelocityTolerance {
  LREAL Range{};
};

/// Hysteresis.
struct TO_Struct_ExtrapolationHysteresis {
  LREAL Value{};
};

/// Actual-value extrapolation.
struct TO_Struct_Extrapolation {
  LREAL LeadingAxisDependentTime{};
  LREAL FollowingAxisDependentTime{};
  TO_Struct_ExtrapolationSettings Settings{};
  TO_Struct_ExtrapolationPositionFilter PositionFilter{};
  TO_Struct_ExtrapolationVelocityFilter VelocityFilter{};
  TO_Struct_ExtrapolationVelocityTolerance VelocityTolerance{};
  TO_Struct_ExtrapolationHysteresis Hysteresis{};
};

}  // namespace lockstep
