/// Permitted values of variables that several kinds of technology objects have; for their declaration tables.
#pragma once

#include "tech_objects/types/declaration.hpp"

namespace lockstep {

inline constexpr Choice kActorInverseDirection[] = {{0, "no"}, {1, "yes"}};

inline constexpr Choice kActorDataAdaption[] = {
    {0, "no automatic transfer; values are configured by hand"},
    {1, "values configured in the drive are taken into the TO configuration automatically"}};

inline constexpr Choice kSensorType[] = {
    {0, "INCREMENTAL: incremental"}, {1, "ABSOLUTE: absolute"}, {2, "CYCLIC_ABSOLUTE: cyclic absolute"}};

inline constexpr Choice kSensorSystem[] = {{0, "LINEAR: linear encoder"}, {1, "ROTATORY: rotary encoder"}};

inline constexpr Choice kSensorMountingMode[] = {
    {0, "on the motor shaft"}, {1, "on the load side"}, {2, "external measuring system"}};

inline constexpr Choice kSensorActualVelocityMode[] = {{0, "from the differentiation of the position change"},
                                                       {1, "from the NIST (NACT) value of the telegram"}};

inline constexpr Choice kSensorParameterBehaviorGxXIST1[] = {
    {0,
     "based on the bits of the encoder resolution; the incremental value Gx_XIST1 is transferred with fewer "
     "than 32 bits (e.g. 16 bits: 0 to 65535)"},
    {1, "32-bit encoder value; Gx_XIST1 is transferred with 32 bits, 0 to 4294967295"}};

inline constexpr Choice kSensorActiveHomingMode[] = {
    {0, "use zero mark via PROFIdrive telegram"},
    {1, "use zero mark via PROFIdrive telegram and reference cam"},
    {2, "use reference mark via digital input"}};

inline constexpr Choice kSensorActiveHomingSideInput[] = {{0, "negative side"}, {1, "positive side"}};

inline constexpr Choice kSensorPassiveHomingDirection[] = {
    {0, "positive homing direction"}, {1, "negative homing direction"}, {2, "current homing direction"}};

inline constexpr Choice kSensorActiveHomingSwitchLevel[] = {{0, "lower level"}, {1, "upper level"}};

inline constexpr Choice kExtrapolationSettingsSystemDefinedExtrapolation[] = {{0, "not effective"},
                                                                              {1, "effective"}};

inline constexpr Choice kExtrapolationSettingsExtrapolatedVelocityMode[] = {
    {0, "FilteredVelocity: leading-value velocity from the filtered actual velocity"},
    {1,
     "VelocityByDifferentiation: leading-value velocity from differentiation of the extrapolated "
     "leading-value position"}};

inline constexpr Choice kPropertiesMotionType[] = {{0, "linear axis or motion"},
                                                   {1, "rotary axis or motion"}};

inline constexpr Choice kUnitsLengthUnit[] = {
    {1010, "m"},   {1013, "mm"}, {1536, "mm (higher resolution: position values with six decimal places)"},
    {1011, "km"},  {1014, "µm"}, {1015, "nm"},
    {1019, "in"},  {1018, "ft"}, {1021, "mi"},
    {1004, "rad"}, {1005, "°"},  {1537, "° (higher resolution: position values with six decimal places)"}};

inline constexpr Choice kUnitsVelocityUnit[] = {
    {1521, "°/s"},
    {1539, "°/s (higher resolution: position values with six decimal places)"},
    {1522, "°/min"},
    {1086, "rad/s"},
    {1523, "rad/min"},
    {1062, "mm/s"},
    {1538, "mm/s (higher resolution: position values with six decimal places)"},
    {1061, "m/s"},
    {1524, "mm/min"},
    {1525, "m/min"},
    {1526, "mm/h"},
    {1063, "m/h"},
    {1527, "km/min"},
    {1064, "km/h"},
    {1066, "in/s"},
    {1069, "in/min"},
    {1067, "ft/s"},
    {1070, "ft/min"},
    {1075, "mi/h"}};

inline constexpr Choice kUnitsTimeUnit[] = {{1054, "s"}};

inline constexpr Choice kModuloEnable[] = {{0, "modulo conversion deactivated"},
                                           {1, "modulo conversion activated"}};

inline constexpr Choice kStatusSensorState[] = {
    {0, "NOT_VALID: not valid"}, {1, "WAITING_FOR_VALID: waiting for status 'valid'"}, {2, "VALID: valid"}};

inline constexpr Choice kStatusSensorCommunicationOK[] = {{0, "not established"}, {1, "established"}};

inline constexpr Choice kStatusSensorError[] = {{0, "no error in the measuring system"},
                                                {1, "error in the measuring system"}};

inline constexpr Choice kStatusSensorControl[] = {{0, "encoder is not active"}, {1, "encoder is active"}};

inline constexpr Choice kStatusSensorAdjusted[] = {
    {0, "encoder not homed"},
    {1,
     "encoder homed by active homing, passive homing, absolute "
     "encoder adjustment or incremental encoder adjustment"}};

inline constexpr Choice kStatusDriveAdaptionState[] = {
    {0, "NOT_ADAPTED: data not transferred"},
    {1, "IN_ADAPTION: data transfer in progress"},
    {2, "ADAPTED: data transfer complete"},
    {3, "NOT_APPLICABLE: data transfer not selected or not possible"},
    {4, "ADAPTION_ERROR: error during data transfer"}};

inline constexpr Choice kUnitsMilliseconds[] = {{1056, "ms"}};

}  // namespace lockstep
