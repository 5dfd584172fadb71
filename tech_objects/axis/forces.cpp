#include "tech_objects/axis/forces.hpp"

#include <cmath>
#include <limits>

#include "tech_objects/data_blocks/status_bits.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {
namespace {

/// Part of the limit from which on the drive counts as limited.
constexpr double kInLimitation = 0.9;
constexpr double kTwoPi = 6.283185307179586;

struct Factor {
  UDINT unit;
  double factor;
};
constexpr Factor kMetres[] = {{1010, 1.0},  {1013, 1e-3},   {1536, 1e-3},   {1011, 1e3},     {1014, 1e-6},
                              {1015, 1e-9}, {1019, 0.0254}, {1018, 0.3048}, {1021, 1609.344}};
constexpr Factor kNewtons[] = {
    {1120, 1.0}, {1122, 1e3}, {1094, 4.4482216152605}, {1093, 0.278013850953781}, {1535, 0.138254954376}};
constexpr Factor kNewtonMetres[] = {{1126, 1.0},
                                    {1128, 1e3},
                                    {1529, 0.1129848290276167},
                                    {1530, 1.3558179483314004},
                                    {1531, 0.00706155181422604},
                                    {1532, 0.0847386217707125},
                                    {1533, 0.0035116758411504},
                                    {1534, 0.0421401100938048}};

template <std::size_t N>
double factor_of(const Factor (&table)[N], UDINT unit) noexcept {
  for (const Factor& row : table)
    if (row.unit == unit) return row.factor;
  return 1.0;
}

}  // namespace

ErrorId AxisForces::limiting_refusal(TorqueLimitingMode mode, bool enabled) const noexcept {
  if (range.owner != nullptr) return ErrorId::torque_limits_exclude;
  return mode == TorqueLimitingMode::fixed_stop_detection && !enabled ? ErrorId::locked : ErrorId::none;
}

ErrorId AxisForces::range_refusal() const noexcept {
  return limiting.owner != nullptr ? ErrorId::torque_limits_exclude : ErrorId::none;
}

bool AxisForces::position_monitoring_off(const AxisData& settings) const noexcept {
  return limited() && settings.TorqueLimiting.PositionBasedMonitors == PositionBasedMonitors::deactivated;
}

bool AxisForces::detects_fixed_stop() const noexcept {
  return limiting.owner != nullptr && limiting.mode == TorqueLimitingMode::fixed_stop_detection;
}

/// Limit of MC_TorqueLimiting as torque (force) at the motor.
double AxisForces::limit_at_motor(const AxisData& settings) const noexcept {
  const bool linear_motor = settings.Actor.MotorType == MotorType::linear;
  const bool at_load = settings.TorqueLimiting.LimitBase == LimitBase::load_side && !linear_motor;
  const bool force = linear_motor || (at_load && settings.Properties.MotionType == MotionType::linear);
  const auto& defaults = settings.TorqueLimiting.LimitDefaults;
  const double given = limiting.limit;
  const double limit = given >= 0.0 ? given : force ? defaults.Force : defaults.Torque;
  if (!at_load) return limit;
  const double ratio = static_cast<double>(settings.LoadGear.Numerator) / settings.LoadGear.Denominator;
  const double through = ratio * settings.Actor.Efficiency;
  if (through <= 0.0) return std::numeric_limits<double>::infinity();
  if (!force) return limit / through;
  const double screw = settings.Mechanics.LeadScrew * factor_of(kMetres, settings.Units.LengthUnit) / kTwoPi;
  const double units =
      factor_of(kNewtons, settings.Units.ForceUnit) / factor_of(kNewtonMetres, settings.Units.TorqueUnit);
  return limit * units * screw / through;
}

/// What the motor may make, in the direction of the axis.
TorqueBand AxisForces::band(const AxisData& settings) const noexcept {
  if (limiting.owner != nullptr) {
    const double limit = limit_at_motor(settings);
    return {-limit, limit};
  }
  if (range.owner != nullptr) return {range.lower, range.upper};
  return {};
}

TorqueCommand AxisForces::command(const AxisData& settings, bool enabled) noexcept {
  const TorqueBand permitted = band(settings);
  upper_ = permitted.upper;
  told_ = active();
  return {permitted, additive.owner != nullptr && enabled ? additive.value : 0.0};
}

void AxisForces::watch_limitation(double torque, bool known) noexcept {
  in_limitation_ = limiting.owner != nullptr && known && std::abs(torque) >= kInLimitation * upper_;
}

void AxisForces::show(AxisData& data, bool clamped) const noexcept {
  set_bit(data.StatusWord, StatusBit::TorqueLimitingCommand, limiting.owner != nullptr);
  set_bit(data.StatusWord, StatusBit::InLimitation, in_limitation_);
  set_bit(data.StatusWord, StatusBit::InClamping, clamped);
  data.StatusTorqueData.CommandAdditiveTorqueActive = additive.owner != nullptr ? 1 : 0;
  data.StatusTorqueData.CommandTorqueRangeActive = range.owner != nullptr ? 1 : 0;
}

}  // namespace lockstep
