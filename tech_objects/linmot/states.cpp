#include "tech_objects/linmot/states.hpp"

namespace lockstep::linmot {
namespace {

struct Transition {
  bool (*from)(State state);
  State to;
  bool (*when)(const StateFacts& facts);
};

template <State... states>
constexpr bool one_of(State state) {
  return ((state == states) || ...);
}

constexpr Transition kTransitions[] = {
    {[](State state) { return state != State::error; }, State::error,
     [](const StateFacts& f) { return f.error; }},
    {one_of<State::error>, State::disable,
     [](const StateFacts& f) { return f.none_requested() && !f.cause; }},
    {one_of<State::run, State::init>, State::stop, [](const StateFacts& f) { return f.stop; }},
    {one_of<State::stop, State::wait_for_disable>, State::disable,
     [](const StateFacts& f) { return f.none_requested(); }},
    {one_of<State::disable>, State::init, [](const StateFacts& f) { return f.init && !f.stop; }},
    {one_of<State::disable>, State::run, [](const StateFacts& f) { return f.run && !f.stop && f.homed; }},
    {one_of<State::init>, State::run,
     [](const StateFacts& f) {
       const bool by_itself = f.automatic && f.none_requested() && !f.warning;
       return f.homing_over && f.homed && ((f.run && !f.init) || by_itself);
     }},
    {one_of<State::init>, State::disable,
     [](const StateFacts& f) { return !f.init && !f.run && !f.automatic; }},
    {one_of<State::run>, State::disable, [](const StateFacts& f) { return !f.run && !f.automatic; }},
};

}  // namespace

State first_state(const StateFacts& facts) noexcept {
  if (facts.automatic) return State::init;
  return facts.none_requested() ? State::disable : State::wait_for_disable;
}

State next_state(State state, const StateFacts& facts) noexcept {
  for (const Transition& transition : kTransitions)
    if (transition.from(state) && transition.when(facts)) return transition.to;
  return state;
}

}  // namespace lockstep::linmot
