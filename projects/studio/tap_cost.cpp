#include "projects/studio/tap_cost.hpp"

namespace lockstep {

void TapCost::add(std::uint64_t ticks, double busy, std::size_t signals) {
  if (before_ && before_->signals == signals && ticks > before_->ticks) {
    tick_ = (busy - before_->busy) / static_cast<double>(ticks - before_->ticks);
    if (signals == 0) without_ = tick_;
  }
  before_ = Look{ticks, busy, signals};
}

studio_api::Json TapCost::told() const {
  if (!tick_) return nullptr;
  studio_api::Json json = {{"tick_us", *tick_}, {"tick_without_us", nullptr}};
  if (without_) json["tick_without_us"] = *without_;
  return json;
}

}  // namespace lockstep
