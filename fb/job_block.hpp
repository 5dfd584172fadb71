/// What all blocks that hand jobs to technology objects have in common: the check of their inputs, and
/// outputs that derive from the phase of the job.
/// @source S7-1500T programming, function-block contract
#pragma once

#include "fb/block.hpp"
#include "tech_objects/axis/axis.hpp"

namespace lockstep {

/// The outputs derive from one stored phase, so that Busy, CommandAborted and Error (and Done, where a block
/// has it) exclude each other.
class JobBlock : public Block {
 public:
  BOOL Busy{};
  BOOL CommandAborted{};
  BOOL Error{};
  WORD ErrorID{};

 protected:
  /// The block's own table of pins, from which the inputs are checked.
  virtual std::span<const Pin> pin_table() const noexcept = 0;
  /// Writes the inputs, which are permitted, into the job.
  virtual void request(Job& job) const noexcept = 0;
  /// The object that gets the job; nullptr if the pin is not wired.
  virtual TechnologyObject* target() const noexcept = 0;
  /// Whether the technology object that gets the job is wired.
  virtual bool wired() const noexcept { return target() != nullptr; }

  /// The error of the first input that is not permitted.
  ErrorId check_inputs() const noexcept;
  JobPhase phase() const noexcept { return phase_; }
  /// From now on the outputs show this phase.
  void set_phase(JobPhase phase, ErrorId error) noexcept;

 private:
  JobPhase phase_ = JobPhase::idle;
};

/// Positions and distances that an axis can represent [u].
inline constexpr Range kPositions{-kPositionRange, kPositionRange};

/// Pins that many blocks share, spelled once.
namespace pin {

inline constexpr Pin kBusy = out<&JobBlock::Busy>("Busy", "the job is in process");
inline constexpr Pin kCommandAborted =
    out<&JobBlock::CommandAborted>("CommandAborted", "another job or disabling has ended the job");
inline constexpr Pin kError =
    out<&JobBlock::Error>("Error", "the job was rejected or has failed; ErrorID tells why");
inline constexpr Pin kErrorID = out<&JobBlock::ErrorID>("ErrorID", "identifier of the error");

template <class T>
constexpr Pin axis() {
  return object<&T::Axis>("Axis", kAnyAxis, "axis that carries out the job");
}
/// Of a job that needs no position.
template <class T>
constexpr Pin any_axis() {
  return object<&T::Axis>("Axis", kAnyDrivenAxis, "axis that carries out the job");
}
template <class T>
constexpr Pin position_controlled() {
  return in<&T::PositionControlled>("PositionControlled", Unit::kNone, kAny,
                                    "whether the axis is position-controlled from now on");
}

}  // namespace pin

}  // namespace lockstep
