/// What a synchronous motion consists of: the parts of the chain, each the owner of its state.
#pragma once

#include "tech_objects/arithmetic/cache_line.hpp"
#include "tech_objects/synchronous/chain.hpp"
#include "tech_objects/synchronous/desynchronizing.hpp"
#include "tech_objects/synchronous/synchronizing.hpp"

namespace lockstep {

/// In lines of the cache: what every cycle of a coupling touches comes first. Thread: the cycle.
struct SynchronousParts {
  Chain chain() noexcept { return {leading_, function_, shifts_, period_}; }
  const Shift* phase_in_use() const noexcept {
    return shifted_ && shifts_.phase().in_use() ? &shifts_.phase() : nullptr;
  }

  alignas(kCacheLine) bool synchronous_ = false;
  bool shifted_ = false;  // shifts_ are of account
  bool leaving_ = false;
  LeadingCoupling leading_;
  SynchronousFunction function_;
  Shifts shifts_;
  double period_ = 0.001;   // [s]
  double tolerance_ = 0.0;  // [u] of the leading axis
  Synchronizing synchronizing_;
  Desynchronizing desynchronizing_;
};

}  // namespace lockstep
