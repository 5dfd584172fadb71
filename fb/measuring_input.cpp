#include "fb/measuring_input.hpp"

namespace lockstep {
namespace {

template <class Block>
void take_range(const Block& block, Job& job) noexcept {
  job.asks = MeasuringJob{.mode = static_cast<MeasuringMode>(block.Mode),
                          .limited = block.MeasuringRange,
                          .start_position = block.StartPosition,
                          .end_position = block.EndPosition};
}

}  // namespace

void MC_MeasuringInput::request(Job& job) const noexcept {
  job.kind = JobKind::MC_MeasuringInput;
  take_range(*this, job);
}

void MC_MeasuringInput::show(JobPhase /*phase*/) noexcept {
  if (job() == nullptr) return;
  const MeasuredEdges& measured = job()->as<MeasuringJob>().measured;
  MeasuredValue1 = measured.value[0];
  MeasuredValue2 = measured.value[1];
}

void MC_MeasuringInputCyclic::request(Job& job) const noexcept {
  job.kind = JobKind::MC_MeasuringInputCyclic;
  take_range(*this, job);
}

void MC_MeasuringInputCyclic::show(JobPhase /*phase*/) noexcept {
  if (job() == nullptr) return;
  const MeasuredEdges& measured = job()->as<MeasuringJob>().measured;
  MeasuredValue1 = measured.value[0];
  MeasuredValue2 = measured.value[1];
  MeasuredValue1Counter = measured.counter[0];
  MeasuredValue2Counter = measured.counter[1];
  LostEdgeCounter1 = measured.lost[0];
  LostEdgeCounter2 = measured.lost[1];
}

}  // namespace lockstep
