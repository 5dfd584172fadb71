/// The contract of blocks whose job runs while Enable is TRUE and takes its inputs over in every call.
/// @source S7-1500T programming, function-block contract
#pragma once

#include "fb/block.hpp"
#include "fb/execute_block.hpp"
#include "tech_objects/axis.hpp"

namespace lockstep {

/// A rising edge of Enable starts a job, whose inputs count in every call; the falling edge ends it.
/// CommandAborted and Error last while Enable is TRUE and at least for one call; a new start needs a new
/// edge. Inputs that are not permitted end the job with Error.
class EnableBlock : public Block {
 public:
  BOOL Enable{};
  BOOL Busy{};
  BOOL CommandAborted{};
  BOOL Error{};
  WORD ErrorID{};

  void call(std::int64_t now) noexcept final;

 protected:
  /// The block's own table of pins, from which the inputs are checked.
  virtual std::span<const Pin> pin_table() const noexcept = 0;
  /// Writes the inputs, which are permitted, into the job.
  virtual void request(Job& job) const noexcept = 0;
  /// The axis that gets the job; nullptr if the pin is not wired.
  virtual Axis* target() const noexcept = 0;

 private:
  void start() noexcept;
  void go_on() noexcept;
  ErrorId check_inputs() const noexcept;

  Job job_;
  JobPhase phase_ = JobPhase::idle;
  ErrorId error_ = ErrorId::none;
  bool last_enable_ = false;
};

/// Setpoints that act without a profile keep to the range of the data block [u, u/s, u/s²].
inline constexpr Range kGiven{-1e12, 1e12};

/// Pins that these blocks share, spelled once.
namespace pin {

inline constexpr Pin kEnable = in<&EnableBlock::Enable>("Enable", Unit::kNone, kAny,
                                                        "TRUE: the job runs; its inputs count in every call");
inline constexpr Pin kEnabledBusy = out<&EnableBlock::Busy>("Busy", "the job is in process");
inline constexpr Pin kEnabledCommandAborted =
    out<&EnableBlock::CommandAborted>("CommandAborted", "another job or disabling has ended the job");
inline constexpr Pin kEnabledError =
    out<&EnableBlock::Error>("Error", "the job was rejected or has failed; ErrorID tells why");
inline constexpr Pin kEnabledErrorID = out<&EnableBlock::ErrorID>("ErrorID", "identifier of the error");

}  // namespace pin

}  // namespace lockstep
