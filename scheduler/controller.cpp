#include "scheduler/controller.hpp"

#include <algorithm>
#include <utility>

#include "scheduler/large_pages.hpp"
#include "scheduler/object_kinds.hpp"

namespace lockstep {

Tag& Controller::add_tag(Tag tag) {
  tag_memory_.push_back(Value{});
  tag.signal = {&tag_memory_.back(), tag.type, -1};
  tag.signal.store(tag.initial);
  tags.push_back(std::move(tag));
  return tags.back();
}

ArrayTag& Controller::add_array(std::string name, Array array) {
  constexpr std::size_t kWord = sizeof(std::uint64_t);
  ArrayTag& tag = arrays.emplace_back();
  tag.name = std::move(name);
  tag.memory.resize((array.count() * array.element->size + kWord - 1) / kWord);
  array.memory = tag.memory.data();
  tag.array = array;
  return tag;
}

StringTag& Controller::add_string(StringTag tag, std::size_t capacity) {
  StringTag& added = strings.emplace_back(std::move(tag));
  added.memory.resize(capacity);
  added.text = {added.memory.data(), capacity};
  added.text.assign(added.initial);
  return added;
}

TechnologyObject& Controller::add_object(ObjectKind kind, std::string name) {
  objects.push_back(make_object(kind, std::move(name), static_cast<DB_ANY>(objects.size() + 1)));
  TechnologyObject& object = *objects.back();
  if (among(kind, kAnyDrivenAxis)) axes.push_back(static_cast<Axis*>(&object));
  if (among(kind, kAnyCam)) cams_.push_back(static_cast<Cam*>(&object));
  if (among(kind, kLeading) && !among(kind, kAnyAxis))
    sources_.push_back(static_cast<LeadingObject*>(&object));
  return object;
}

Axis& Controller::add_axis(ObjectKind kind, std::string name) {
  return static_cast<Axis&>(add_object(kind, std::move(name)));
}

Instance& Controller::add_instance(const BlockType& type, std::string name) {
  instances.push_back({std::move(name), &type, type.create()});
  instances.back().block->connect(encoder_saving);
  return instances.back();
}

/// Objects that switch the same tag switch one output.
void Controller::wire_outputs() {
  for (const auto& object : objects) {
    const SwitchedBy by = object->switches();
    if (by.state == nullptr) continue;
    auto* const address =
        const_cast<bool*>(by.address);  // variables hold addresses for reading; a tag is written
    const auto same = [&](const SwitchedOutput& output) { return output.address == address; };
    auto found = std::find_if(outputs_.begin(), outputs_.end(), same);
    if (found == outputs_.end()) found = outputs_.insert(found, SwitchedOutput{address, by.all, {}});
    found->states.push_back(by.state);
  }
}

/// The objects by phases, each in its order.
void Controller::assign_parts() {
  Part ordered;
  for (const auto& object : objects) ordered.push_back(object.get());
  std::stable_sort(ordered.begin(), ordered.end(), [](const TechnologyObject* a, const TechnologyObject* b) {
    return index_in_phase(a->kind) < index_in_phase(b->kind);
  });
  for (TechnologyObject* object : ordered) {
    if (object->takes_part(Phase::servo)) {
      if (among(object->kind, kAnyDrivenAxis))
        driven_.push_back(static_cast<Axis*>(object));
      else
        servo_.push_back(object);
    }
    if (object->takes_part(Phase::before_axes)) before_axes_.push_back(object);
    if (object->takes_part(Phase::behind_axes)) behind_axes_.push_back(object);
    if (object->takes_part(Phase::programs)) with_programs_.push_back(object);
  }
}

/// Of the same priority an object comes first.
void Controller::order_due_programs() {
  Part objects = with_programs_;
  std::stable_sort(objects.begin(), objects.end(), [](const TechnologyObject* a, const TechnologyObject* b) {
    return a->program_priority() > b->program_priority();
  });
  auto next = objects.begin();
  for (const Program* program : schedule_) {
    if (program->ob() < Ob::Cyclic) continue;
    while (next != objects.end() &&
           (program->ob() == Ob::Main || (*next)->program_priority() >= program->priority()))
      due_.push_back({nullptr, *next++});
    due_.push_back({program, nullptr});
  }
  while (next != objects.end()) due_.push_back({nullptr, *next++});
}

void Controller::finish() {
  const double servo_period = static_cast<double>(clock.servo_cycle) * 1e-9;
  for (const Axis* axis : axes)
    for (const LeadingValue& leading : axis->leading_values)
      if (leading.coupling == Coupling::delayed && leading.source->kind != ObjectKind::TO_LeadingAxisProxy)
        leading.source->provide_leading_value();
  for (auto& object : objects) object->configure(servo_period, clock.interpolator_ratio);
  for (const auto& object : objects)
    if (among(object->kind, kPositioned) && static_cast<LeadingObject*>(object.get())->provides())
      providing_.push_back(static_cast<LeadingObject*>(object.get()));
  assign_parts();
  std::size_t maximum_points = 0;
  for (const Cam* cam : cams_) maximum_points = std::max(maximum_points, cam->point_count());
  if (maximum_points > 0) interpolator_ = std::make_unique<CamInterpolator>(maximum_points);
  interpolate_cams_elsewhere(cams_interpolated_elsewhere_);
  summary_.resize(axes.size());
  for (Watchdog& watchdog : watchdogs) watchdog.remember();
  wire_outputs();
  order_.set_axes(axes);
  order_.rebuild();
  for (Axis* axis : axes) axis->attention.raise_with(attention_);
  for (Program& program : programs) schedule_.push_back(&program);
  std::stable_sort(schedule_.begin(), schedule_.end(), [](const Program* a, const Program* b) {
    return a->ob() != b->ob() ? a->ob() < b->ob() : a->priority() > b->priority();
  });
  order_due_programs();
  std::stable_sort(stimuli.begin(), stimuli.end(),
                   [](const Stimulus& a, const Stimulus& b) { return a.at < b.at; });
  lay_objects_into_large_pages();
}

void Controller::employ_processors(int there) {
  const int processors = std::min(clock.processors, there);
  if (processors <= 1 || axes.size() < kWorthSharing || axes.size() > Crew::kMaximumItems) return;
  levels_.reserve(axes.size(), static_cast<std::uint32_t>(objects.back()->number));
  levels_.rebuild(order_.axes());
  crew_ = std::make_unique<Crew>(processors - 1);
}

std::vector<pthread_t> Controller::helping_threads() {
  return crew_ == nullptr ? std::vector<pthread_t>() : crew_->threads();
}

void Controller::lay_objects_into_large_pages() const {
  std::vector<const void*> places;
  for (const auto& object : objects) places.push_back(object.get());
  for (const auto& instance : instances) places.push_back(instance.block.get());
  if (places.empty()) return;
  const auto [lowest, highest] = std::minmax_element(places.begin(), places.end());
  lay_into_large_pages(*lowest, *highest);
}

void Controller::tell_jobs(JobsTold told) {
  jobs_told_ = told;
  job_watches_.clear();
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const JobWatch watch(*instances[i].type, *instances[i].block, static_cast<std::uint32_t>(i));
    if (watch.usable(told)) job_watches_.push_back(watch);
  }
}

void Controller::skip(std::int64_t ticks) noexcept {
  next_tick_ += ticks;
  last_missed_ = now();
  counters_.missed_ticks += static_cast<std::uint64_t>(ticks);
  for (const auto& object : objects) object->skip(ticks);
}

void Controller::shut_down() noexcept {
  take_summary();
  shutting_down_ = true;
  for (TechnologyObject* object : with_programs_) object->shut_down();
}

void Controller::take_summary() noexcept {
  for (std::size_t i = 0; i < summary_.size(); ++i) {
    const Axis& axis = *axes[i];
    summary_[i] = {.status_word = axis.data.StatusWord,
                   .function_state = axis.data.StatusSynchronizedMotion.FunctionState,
                   .alarm = axis.data.ErrorDetail.Number,
                   .position = axis.has_position() ? axis.data.ActualPosition : axis.data.ActualVelocity,
                   .largest_deviation = axis.largest_synchronous_deviation()};
  }
}

void Controller::interpolate_cams_elsewhere(bool elsewhere) noexcept {
  cams_interpolated_elsewhere_ = elsewhere;
  for (Cam* cam : cams_) cam->interpolate_by(elsewhere ? nullptr : interpolator_.get());
}

bool Controller::interpolate_cams() noexcept {
  bool worked = false;
  for (Cam* cam : cams_) worked |= cam->work(*interpolator_);
  return worked;
}

bool Controller::at_rest() const noexcept {
  return std::all_of(axes.begin(), axes.end(), [](const Axis* axis) { return axis->off(); }) &&
         std::all_of(with_programs_.begin(), with_programs_.end(),
                     [](const TechnologyObject* object) { return object->at_rest(); });
}

}  // namespace lockstep
