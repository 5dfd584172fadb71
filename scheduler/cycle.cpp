// The cycle, from top to bottom as section 4 of the contract has it. Nothing here allocates, locks or blocks.
#include "scheduler/controller.hpp"

namespace lockstep {

void Controller::tick() noexcept {
  const std::int64_t t = now();
  const bool interpolator_tick = interpolator_is_due();

  take_inputs(t);

  run_programs(Ob::MC_PreServo, t);
  servo(t);
  run_programs(Ob::MC_PostServo, t);

  if (interpolator_tick) {
    run_programs(Ob::MC_PreInterpolator, t);
    interpolate();
  }

  run_due_programs(t);

  if (events != nullptr) tell_events(t);
  show(t, interpolator_tick);

  last_time_ = t;
  ++next_tick_;
  ++counters_.ticks;
}

/// Whether a grid of the given cycle has a point at `t`, or one that has been left out since the last tick.
bool Controller::due(std::int64_t cycle, std::int64_t t) const noexcept {
  return last_time_ < 0 || t / cycle != last_time_ / cycle;
}

/// Writes from outside, and what they answer, and stimuli enter the tags; what has to be while somebody
/// outside is silent goes on top.
void Controller::take_inputs(std::int64_t t) noexcept {
  for (ProcessImage* image : images) image->take_writes();
  encoder_saving.step();
  if (apply_stimuli)
    for (; next_stimulus_ < stimuli.size() && stimuli[next_stimulus_].at <= t; ++next_stimulus_)
      stimuli[next_stimulus_].place.store(stimuli[next_stimulus_].value);
  for (Watchdog& watchdog : watchdogs) watchdog.look(next_tick_);
}

/// Axes, what measures them, and what switches outputs by their positions.
void Controller::servo(std::int64_t t) noexcept {
  for (Axis* axis : driven_) axis->servo();
  for (ExternalEncoder* encoder : encoders) encoder->servo();
  for (MeasuringInput* input : measuring_inputs) input->servo();
  for (OutputCam* cam : output_cams) cam->servo(t);
  for (CamTrack* track : cam_tracks) track->servo(t);
  for (const SwitchedOutput& output : outputs_) output.write();
}

/// Encoders, which depend on no axis; then start_jobs → step (leading before following), guarded → publish.
void Controller::interpolate() noexcept {
  for (Cam* cam : cams) cam->step(cams_interpolated_elsewhere ? nullptr : interpolator_.get());
  bool changed = false;
  for (ExternalEncoder* encoder : encoders) {
    encoder->step();
    changed |= encoder->lost();
  }
  for (MeasuringInput* input : measuring_inputs) input->interpolated();
  for (OutputCam* cam : output_cams) cam->interpolated();
  for (CamTrack* track : cam_tracks) track->interpolated();
  for (Axis* axis : order_.axes()) {
    if (shutting_down_) axis->power.enable = false;
    if (axis->has_new_jobs()) axis->start_jobs();
    changed |= axis->coupling_changed;
    axis->coupling_changed = false;
  }
  if (changed) {
    for (Axis* axis : order_.axes()) axis->watch_leading_object();
    for (Axis* axis : order_.axes()) axis->restarted = false;
    for (ExternalEncoder* encoder : encoders) encoder->restarted = false;
    order_.rebuild();
  }
  counters_.alarms = 0;
  const std::span<Axis* const> axes_in_order = order_.axes();
  for (std::size_t i = 0; i < axes_in_order.size(); ++i) {
    Axis* const axis = axes_in_order[i];
    if (i + 1 < axes_in_order.size()) axes_in_order[i + 1]->come_near();
    axis->step();
    axis->publish();
    if (axis->data.ErrorDetail.Number != 0) ++counters_.alarms;
  }
  for (Cam* cam : cams) cam->publish();
  ++counters_.interpolator_ticks;
}

void Controller::run_programs(Ob ob, std::int64_t t) noexcept {
  if (shutting_down_) return;
  for (const Program* program : schedule_)
    if (program->ob() == ob) program->run(t, counters_.evaluation);
}

/// Cyclic programs by priority, then Main.
void Controller::run_due_programs(std::int64_t t) noexcept {
  if (shutting_down_) return;
  for (const Program* program : schedule_)
    if (program->ob() >= Ob::Cyclic && due(program->cycle(), t)) program->run(t, counters_.evaluation);
}

/// Alarms and jobs of this tick.
void Controller::tell_events(std::int64_t t) noexcept {
  for (const auto& object : objects) {
    if (!object->alarm_notes.any()) continue;
    const auto source = static_cast<std::size_t>(object->number) - 1;
    object->alarm_notes.take([&](const AlarmNote& note) {
      tell(note.number == 0 ? EventKind::acknowledged : EventKind::alarm, source, note.number, note.reaction,
           t);
    });
  }
  for (JobWatch& watch : job_watches_)
    watch.look([&](EventKind kind, int number) { tell(kind, watch.instance(), number, 0, t); });
}

void Controller::tell(EventKind kind, std::size_t source, int number, int reaction, std::int64_t t) noexcept {
  events->push({kind, static_cast<std::int16_t>(reaction), static_cast<std::uint32_t>(source), number, t,
                static_cast<std::uint64_t>(next_tick_)});
}

void Controller::count_overrun() noexcept {
  ++counters_.overruns;
  if (events != nullptr) tell(EventKind::overrun, 0, 0, 0, last_time_);
}

/// The image for Modbus, and on interpolator ticks the trace row.
void Controller::show(std::int64_t t, bool interpolator_tick) noexcept {
  for (Watchdog& watchdog : watchdogs) watchdog.remember();
  for (ProcessImage* image : images) image->publish(next_tick_);
  if (trace != nullptr && interpolator_tick) trace->push(t, static_cast<std::uint64_t>(next_tick_));
}

}  // namespace lockstep
