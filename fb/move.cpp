#include "fb/move.hpp"

#include <cmath>

namespace lockstep {
namespace {

/// Takes over the inputs that all three blocks have.
template <class B>
void take_inputs(const B& block, Job& job) noexcept {
  job.velocity = block.Velocity;
  job.acceleration = block.Acceleration;
  job.deceleration = block.Deceleration;
  job.jerk = block.Jerk;
  job.buffer_mode = static_cast<lockstep::BufferMode>(block.BufferMode);
}

}  // namespace

bool MC_MoveAbsolute::has_modulo(const Block& block) noexcept {
  const lockstep::Axis* axis = static_cast<const MC_MoveAbsolute&>(block).Axis;
  return axis != nullptr && axis->data.Modulo.Enable;
}

void MC_MoveAbsolute::request(Job& job) const noexcept {
  job.kind = JobKind::MC_MoveAbsolute;
  job.asks = MoveAbsoluteJob{.position = Position, .direction = static_cast<lockstep::Direction>(Direction)};
  take_inputs(*this, job);
}

void MC_MoveRelative::request(Job& job) const noexcept {
  job.kind = JobKind::MC_MoveRelative;
  job.asks = DistanceJob{.distance = Distance};
  take_inputs(*this, job);
}

void MC_MoveVelocity::request(Job& job) const noexcept {
  job.kind = JobKind::MC_MoveVelocity;
  take_inputs(*this, job);
  const auto direction = static_cast<lockstep::Direction>(Direction);
  if (direction == lockstep::Direction::positive) job.velocity = std::abs(Velocity);
  if (direction == lockstep::Direction::negative) job.velocity = -std::abs(Velocity);
  job.asks = VelocityJob{.current = Current};
  job.position_controlled = PositionControlled;
}

}  // namespace lockstep
