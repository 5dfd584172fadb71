#include "tech_objects/linmot/states.hpp"

namespace lockstep::linmot {
namespace {

using namespace fact;

struct Transition {
  unsigned from;  // a bit for each state
  State to;
  StateFacts needs, excludes;
};

template <class... States>
constexpr unsigned one_of(States... states) {
  return ((1u << static_cast<unsigned>(states)) | ...);
}
constexpr unsigned any_but(State state) {
  return ~one_of(state);
}

constexpr Transition kTransitions[] = {
    {any_but(State::error), State::error, kError, 0},
    {one_of(State::error), State::disable, 0, kAnyRequest | kCause},
    {one_of(State::run, State::init), State::stop, kStop, 0},
    {one_of(State::stop, State::wait_for_disable), State::disable, 0, kAnyRequest},
    {one_of(State::disable), State::init, kInit, kStop},
    {one_of(State::disable), State::run, kRun | kHomed, kStop},
    {one_of(State::init), State::run, kHomingOver | kHomed | kRun, kInit},
    // By itself.
    {one_of(State::init), State::run, kHomingOver | kHomed | kAutomatic, kAnyRequest | kWarning},
    {one_of(State::init), State::disable, 0, kInit | kRun | kAutomatic},
    {one_of(State::run), State::disable, 0, kRun | kAutomatic},
};

}  // namespace

State first_state(StateFacts facts) noexcept {
  if ((facts & kAutomatic) != 0) return State::init;
  return (facts & kAnyRequest) == 0 ? State::disable : State::wait_for_disable;
}

State next_state(State state, StateFacts facts) noexcept {
  const unsigned now = one_of(state);
  for (const Transition& transition : kTransitions)
    if ((transition.from & now) != 0 && (facts & transition.needs) == transition.needs &&
        (facts & transition.excludes) == 0)
      return transition.to;
  return state;
}

}  // namespace lockstep::linmot
