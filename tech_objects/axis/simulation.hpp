/// MC_SynchronizedMotionSimulation: a coupling that goes on without its axis.
#pragma once

#include "tech_objects/axis/axis_requests.hpp"
#include "tech_objects/axis/position_control.hpp"
#include "tech_objects/axis/shifting.hpp"

namespace lockstep {

/// The request, the coupling, and the axis beside it.
struct SimulationParts {
  const AxisData& data;
  SimulationRequest& simulation_request;
  JobSlots& jobs_;
  const PowerState& power_state_;
  const Setpoint& setpoint_;
  const Modulo& modulo_;
  const AxisPosition& actual_;
  const bool& has_drive_;
  const bool& position_controlled_;
  AxisMotion& motion_;
  SingleAxisMotion& single_;
  const SuperimposedMotion& superimposed_;
  SynchronousMotion& synchronous_;
  const Coupled& coupled_;
  Job*& simulated_;
  JobEnds& ends_;
  PositionControlOrders& position_control_;
  ShiftOrders& shifting_;
};

/// Thread: the cycle.
class SimulationOrders : private SimulationParts {
 public:
  explicit SimulationOrders(const SimulationParts& parts) noexcept : SimulationParts(parts) {}

  /// Each tick since an instance has asked first.
  void watch() noexcept;

 private:
  void show_passes() noexcept;
  bool coupling_stands(const Setpoint& setpoint) const noexcept;
  void begin() noexcept;
  ErrorId refusal_of_end() const noexcept;
  void end() noexcept;

  Setpoint ghost_;  // where it would have the axis
};

}  // namespace lockstep
