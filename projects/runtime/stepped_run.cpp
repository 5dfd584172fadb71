#include "projects/runtime/stepped_run.hpp"

#include <utility>

namespace lockstep {
namespace {

// In the ring before they are taken: more than one saves looks, many leave the cache.
constexpr std::size_t kRowsAtOnce = 64;

TraceColumns columns_of(const std::vector<NamedSignal>& signals) {
  TraceColumns columns;
  columns.of(signals);
  return columns;
}

}  // namespace

SteppedRun::SteppedRun(Project project, const Options& options)
    : SteppedRun(std::move(project), columns_of(options.signals), options.jobs) {}

SteppedRun::SteppedRun(Project project, const TraceColumns& columns, bool jobs)
    : project_(std::move(project)),
      ring_(columns.places(), kRowsAtOnce),
      texts_(*project_.controller),
      trace_(columns.described()) {
  Controller& controller = *project_.controller;
  controller.apply_stimuli = true;
  if (ring_.columns() != 0) controller.trace = &ring_;
  controller.events = &queue_;
  if (jobs) controller.tell_jobs();
}

void SteppedRun::step(std::uint64_t ticks) {
  for (; ticks != 0; --ticks) {
    if (ring_.readable() == ring_.capacity()) take_rows();
    project_.controller->tick();
    if (queue_.readable() != 0) take_events();
  }
  take_rows();
}

void SteppedRun::take_rows() {
  while (ring_.readable() != 0) {
    trace_.add(ring_.row(0));
    ring_.pop(1);
  }
}

void SteppedRun::take_events() {
  while (queue_.readable() != 0) {
    events_.push_back(texts_.of(queue_.event(0), queue_.lost()));
    queue_.pop(1);
  }
}

}  // namespace lockstep
