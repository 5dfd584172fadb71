// The cycle, from top to bottom as section 4 of the contract has it. Nothing here allocates, locks or blocks.
#include <algorithm>
#include <cmath>
#include <utility>

#include "scheduler/controller.hpp"

namespace lockstep {
namespace {

/// Events that nobody has read yet, behind which those of programs wait: half of a queue of the usual size,
/// so that alarms find space.
constexpr std::size_t kNotesWait = 2048;

constexpr std::int64_t kLatestTick =
    1'000'000'000;  // [ns] by which one may be late for telegrams to wait for it
constexpr std::int64_t kLateFor = 1'000'000'000;  // [ns] after missed ticks, for what may have come of them

}  // namespace

void Controller::tick() noexcept {
  const std::int64_t t = now();
  const bool interpolator_tick = interpolator_is_due();

  if (interpolator_tick) fetch_rows();
  take_inputs(t);

  run_programs(Ob::MC_PreServo, t);
  servo(t);
  run_programs(Ob::MC_PostServo, t);

  if (interpolator_tick) {
    // They get up while the programs run, so that none is late at the axes.
    if (crew_ != nullptr) crew_->wake();
    run_programs(Ob::MC_PreInterpolator, t);
    interpolate();
    if (crew_ != nullptr) crew_->rest();
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
  if (tap != nullptr) tap->writes.apply(next_tick_);
  for (const TelegramInput& input : telegram_inputs)
    input.ring->take_while([&](LeadingValueTelegram telegram) {
      telegram.time -= shared_time_at_start;
      // A tick that is late leaves to later ones what is theirs; what no tick can be late for, the proxy
      // refuses.
      const std::int64_t ahead = telegram.time - t;
      if (ahead > telegram.cycle && ahead <= kLatestTick) return false;
      input.proxy->take(telegram, t);
      return true;
    });
  for (const ShownCount& one : shown_counts) one.show();
  encoder_saving.step();
  if (apply_stimuli)
    for (; next_stimulus_ < stimuli.size() && stimuli[next_stimulus_].at <= t; ++next_stimulus_)
      stimuli[next_stimulus_].place.store(stimuli[next_stimulus_].value);
  for (Watchdog& watchdog : watchdogs) watchdog.look(next_tick_);
}

namespace {

/// Axes that a crew takes portions of.
void serve_portion(void* axes, std::size_t begin, std::size_t end) noexcept {
  Axis* const* const first = static_cast<Axis* const*>(axes);
  for (std::size_t i = begin; i < end; ++i) first[i]->servo();
}

}  // namespace

/// Drives and position control of the axes: none knows another's.
void Controller::serve_drives() noexcept {
  if (crew_ == nullptr || driven_.size() < kWorthSharing) {
    for (Axis* axis : driven_) axis->servo();
    return;
  }
  crew_->wake();
  crew_->share(driven_.size(), serve_portion, driven_.data());
  crew_->rest();
}

/// Axes, what measures them, and what switches outputs by their positions.
void Controller::servo(std::int64_t t) noexcept {
  serve_drives();
  for (TechnologyObject* object : servo_) object->servo(t);
  for (const SwitchedOutput& output : outputs_) output.write();
}

/// What depends on no axis; then start_jobs → step (leading before following), guarded → publish.
void Controller::interpolate() noexcept {
  for (LeadingObject* object : providing_) object->tick_time = now();
  for (TechnologyObject* object : before_axes_) object->before_axes();
  bool changed = false;
  for (LeadingObject* source : sources_) changed |= std::exchange(source->lost, false);
  changed |= start_jobs();
  if (changed) rebuild_order();
  step_axes();
  send_telegrams();
  for (TechnologyObject* object : behind_axes_) object->behind_axes();
  ++counters_.interpolator_ticks;
}

/// Of axes that ask for attention; what they raise meanwhile counts in the next tick.
/// @return whether a coupling has changed
bool Controller::start_jobs() noexcept {
  if (!attention_.load(std::memory_order_relaxed) && !shutting_down_) return false;
  attention_.store(false, std::memory_order_relaxed);
  bool changed = false;
  for (Axis* axis : order_.axes()) {
    if (shutting_down_) axis->power.enable = false;
    if (axis->has_new_jobs()) axis->start_jobs();
    changed |= axis->attention.take_coupling_change();
  }
  return changed;
}

/// The leading values of this tick, to other controllers.
void Controller::send_telegrams() noexcept {
  for (const TelegramOutput& output : telegram_outputs) {
    LeadingValueTelegram telegram = output.source->telegram();
    telegram.time += shared_time_at_start;
    output.ring->put(telegram);
  }
}

/// Couplings have changed, or what they lead back to.
void Controller::rebuild_order() noexcept {
  for (Axis* axis : order_.axes()) axis->watch_leading_object();
  for (Axis* axis : order_.axes()) axis->restarted = false;
  for (LeadingObject* source : sources_) source->restarted = false;
  order_.rebuild();
  if (crew_ != nullptr) levels_.rebuild(order_.axes());
}

void Controller::step_axes_in_turn(std::span<Axis* const> axes) noexcept {
  std::uint64_t alarms = 0;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    Axis* const axis = axes[i];
    if (i + 1 < axes.size()) axes[i + 1]->prefetch();
    axis->cycle();
    if (axis->data.ErrorDetail.Number != 0) ++alarms;
  }
  if (alarms != 0) alarms_now_.fetch_add(alarms, std::memory_order_relaxed);
}

/// Leading before following: in their order, or level by level with a crew.
void Controller::step_axes() noexcept {
  alarms_now_.store(0, std::memory_order_relaxed);
  if (crew_ == nullptr)
    step_axes_in_turn(order_.axes());
  else
    for (std::size_t level = 0; level < levels_.count(); ++level) step_level(levels_[level]);
  counters_.alarms = alarms_now_.load(std::memory_order_relaxed);
}

void Controller::step_level(std::span<Axis* const> axes) noexcept {
  if (axes.size() < kWorthSharing) return step_axes_in_turn(axes);
  struct Share {
    Controller& controller;
    std::span<Axis* const> axes;
  } share{*this, axes};
  const Crew::Work work = [](void* context, std::size_t begin, std::size_t end) noexcept {
    const Share& all = *static_cast<const Share*>(context);
    all.controller.step_axes_in_turn(all.axes.subspan(begin, end - begin));
  };
  crew_->share(axes.size(), work, &share);
}

void Controller::run_programs(Ob ob, std::int64_t t) noexcept {
  if (shutting_down_) return;
  for (const Program* program : schedule_)
    if (program->ob() == ob) program->run(t, counters_.evaluation);
}

/// Cyclic programs and those of objects by priority, then Main. Objects go on while they come to rest.
void Controller::run_due_programs(std::int64_t t) noexcept {
  for (const Due& one : due_)
    if (one.object != nullptr)
      one.object->run_program(t);
    else if (!shutting_down_ && due(one.program->cycle(), t))
      one.program->run(t, counters_.evaluation);
}

/// Alarms and jobs of this tick.
void Controller::tell_events(std::int64_t t) noexcept {
  for (const auto& object : objects) {
    if (!object->alarm_notes.any()) continue;
    const auto source = static_cast<std::size_t>(object->number) - 1;
    object->alarm_notes.take([&](const AlarmNote& note) {
      const bool raised = note.number != 0;
      tell({.kind = raised ? EventKind::alarm : EventKind::acknowledged,
            .reaction = note.reaction,
            .source = static_cast<std::uint32_t>(source),
            .number = note.number,
            .detail = note.detail},
           t);
      if (raised) note_newest(note, source + 1, t);
    });
  }
  for (TechnologyObject* object : with_programs_) tell_notes(*object, t);
  for (JobWatch& watch : job_watches_)
    watch.look(jobs_told_, [&](EventKind kind, int number) { tell_job(watch, kind, number, t); });
}

/// What an object's own program prints, and its errors. Behind too many events they stay with the object,
/// which counts what it cannot keep: a line whose event were lost would be told with the next one.
void Controller::tell_notes(TechnologyObject& object, std::int64_t t) noexcept {
  ProgramNote note;
  while (events->readable() < kNotesWait && object.take_note(note))
    tell({.kind = note.printed ? EventKind::printed : EventKind::program_error,
          .reaction = static_cast<std::int16_t>(note.program),
          .source = static_cast<std::uint32_t>(object.number) - 1,
          .number = note.error,
          .line = note.line},
         t);
}

void Controller::tell_job(const JobWatch& watch, EventKind kind, int number, std::int64_t t) noexcept {
  Event event{.kind = kind, .source = watch.instance(), .number = number, .object = watch.object()};
  const Job* const job = kind == EventKind::job_aborted ? watch.job() : nullptr;
  if (job != nullptr) {
    event.aborted_by = job->aborted_by;
    event.aborted_by_job = job->aborted_by_job;
  }
  tell(event, t);
}

void Controller::note_newest(const AlarmNote& note, std::size_t object, std::int64_t t) noexcept {
  const auto known = [](double value) { return std::isfinite(value) ? value : 0.0; };
  const AlarmDetail& detail = note.detail;
  newest_alarm_ = {.count = newest_alarm_.count + 1,
                   .number = static_cast<std::uint64_t>(note.number),
                   .object = object,
                   .cause = static_cast<std::uint64_t>(detail.cause),
                   .address = std::uint64_t{std::max<std::uint16_t>(detail.object, detail.sensor)},
                   .tick = static_cast<std::uint64_t>(next_tick_),
                   .time = t,
                   .clock = epoch + t / 1000,
                   .value = known(detail.value),
                   .limit = known(detail.limit)};
}

void Controller::tell(Event event, std::int64_t t) noexcept {
  event.t = t;
  event.tick = static_cast<std::uint64_t>(next_tick_);
  event.late = last_missed_ >= 0 && t - last_missed_ <= kLateFor;
  events->push(event);
}

void Controller::count_overrun() noexcept {
  ++counters_.overruns;
  if (events != nullptr) tell({.kind = EventKind::overrun}, last_time_);
}

/// What `show` will write and nobody has touched since, with what leads there.
void Controller::fetch_rows() const noexcept {
  if (tap != nullptr) tap->fetch();
  trace_row_.fetch();
  tap_row_.fetch();
}

/// The image for Modbus, and on interpolator ticks the rows of the trace and of the tap.
void Controller::show(std::int64_t t, bool interpolator_tick) noexcept {
  for (Watchdog& watchdog : watchdogs) watchdog.remember();
  for (ProcessImage* image : images) image->publish(next_tick_);
  if (!interpolator_tick) return;
  if (trace != nullptr) {
    trace->push(t, static_cast<std::uint64_t>(next_tick_));
    trace_row_ = trace->ahead();
  }
  if (tap != nullptr) {
    tap->exchange();
    tap->push(t, static_cast<std::uint64_t>(next_tick_));
    tap_row_ = tap->ahead();
  }
}

}  // namespace lockstep
