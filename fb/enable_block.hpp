/// The contract of blocks whose job runs while Enable is TRUE and takes its inputs over in every call.
/// @source S7-1500T programming, function-block contract
#pragma once

#include "fb/job_block.hpp"

namespace lockstep {

/// A rising edge of Enable starts a job, whose inputs count in every call; the falling edge ends it.
/// CommandAborted and Error last while Enable is TRUE and at least for one call; a new start needs a new
/// edge. Inputs that are not permitted end the job with Error.
class EnableBlock : public JobBlock {
 public:
  BOOL Enable{};

  void call(std::int64_t now) noexcept final;

 private:
  void start() noexcept;
  void go_on() noexcept;

  Job job_;  // of the family MotionInJob
  bool last_enable_ = false;
};

/// Setpoints that act without a profile keep to the range of the data block [u, u/s, u/s²].
inline constexpr Range kGiven{-1e12, 1e12};

namespace pin {

inline constexpr Pin kEnable = in<&EnableBlock::Enable>("Enable", Unit::kNone, kAny,
                                                        "TRUE: the job runs; its inputs count in every call");

}  // namespace pin

}  // namespace lockstep
