/// What is to be told of the MC_CamIn of a program, as far as their inputs are constant.
#pragma once

#include <vector>

#include "fb/cam_in.hpp"
#include "projects/json/document.hpp"
#include "projects/json/problem.hpp"

namespace lockstep {

/// Collects the calls of a program, and looks at pairs of them.
class CamCalls {
 public:
  /// @param in its inputs, without one that is computed among SyncProfileReference, MasterScaling,
  /// SlaveScaling
  void add(const JsonValue& in, const MC_CamIn& block) { calls_.push_back({&in, &block}); }

  /// Warns where a cam takes over from another at its end (SyncProfileReference 5) with another velocity.
  void warn_of_exchanges(Problems& problems) const;

 private:
  struct Call {
    const JsonValue* in;
    const MC_CamIn* block;
  };
  std::vector<Call> calls_;
};

}  // namespace lockstep
