#include "tech_objects/profile/superimposed.hpp"

#include <cmath>
#include <limits>

namespace lockstep {
namespace {

/// By what distances may differ by rounding, relative to their size.
constexpr double kRounding = 1e-12;

bool usable(const Dynamics& margin) noexcept {
  return margin.acceleration > 0.0 && margin.deceleration > 0.0;
}

}  // namespace

void Superimposed::begin() noexcept {
  reset();
  in_use_ = true;
}

void Superimposed::reset() noexcept {
  in_use_ = waits_ = given_ = false;
  anchor_ = {};
  local_ = {};
  margin_ = {};
  motion_.stand(local_);
}

/// From here on positions count from where the part is.
void Superimposed::settle() noexcept {
  anchor_ = value();
  local_.position = {};
  waits_ = given_ = false;
}

PlanResult Superimposed::move_by(double distance, const Dynamics& margin) noexcept {
  settle();
  margin_ = margin;
  if (resting() && (!usable(margin) || margin.velocity <= 0.0)) {
    waits_ = true;
    distance_ = distance;
    motion_.stand(local_);
    return PlanResult::ok;
  }
  if (margin.velocity > 0.0) return motion_.move_to(local_, {0, distance}, distance, margin);
  Dynamics crawl = margin;  // no velocity is left: plan with the present one, then come to rest
  crawl.velocity = std::abs(local_.velocity) + 1.0;
  const PlanResult result = motion_.move_to(local_, {0, distance}, distance, crawl);
  return result == PlanResult::ok ? motion_.replan(local_, margin) : result;
}

PlanResult Superimposed::make_room(const Dynamics& margin) noexcept {
  if (margin == margin_) return PlanResult::ok;
  if (waits_) return move_by(distance_, margin);
  Dynamics next = margin;
  if (!usable(margin)) {
    next = margin_;
    next.velocity = margin.velocity;
    if (next == margin_) return PlanResult::ok;
  }
  const PlanResult result = motion_.replan(local_, next);
  if (result == PlanResult::ok) margin_ = next;
  return result;
}

PlanResult Superimposed::stop(const Dynamics& dynamics, bool abort_acceleration) noexcept {
  settle();
  margin_ = dynamics;
  return motion_.stop(local_, dynamics, abort_acceleration);
}

void Superimposed::begin_giving() noexcept {
  settle();
  motion_.stand(local_);
  given_ = true;
}

void Superimposed::give(double distance, double velocity, double acceleration) noexcept {
  local_ = {{0, distance}, velocity, acceleration};
}

void Superimposed::rest() noexcept {
  settle();
  local_ = {};
  motion_.stand(local_);
}

void Superimposed::advance() noexcept {
  if (!given_) motion_.advance(local_);
}

double Superimposed::distance_left(int direction) const noexcept {
  if (!given_) return motion_.distance_left(direction);
  return direction * local_.velocity > 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
}

int Superimposed::direction() const noexcept {
  if (given_ || (!waits_ && motion_.aim() != SingleAxisMotion::Aim::position)) return 0;
  const double left = waits_ ? distance_ : motion_.target().value - local_.position.value;
  const int side = left > 0.0 ? 1 : -1;
  return left != 0.0 && distance_left(-side) <= kRounding * (1.0 + std::abs(left)) ? side : 0;
}

}  // namespace lockstep
