#include "scheduler/controller.hpp"

#include <algorithm>
#include <utility>

#include "scheduler/large_pages.hpp"

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

StringTag& Controller::add_string(StringTag tag, std::size_t room) {
  StringTag& added = strings.emplace_back(std::move(tag));
  added.memory.resize(room);
  added.text = {added.memory.data(), room};
  added.text.assign(added.initial);
  return added;
}

TechnologyObject& Controller::add_object(ObjectKind kind, std::string name) {
  const auto number = static_cast<DB_ANY>(objects.size() + 1);
  switch (kind) {
    case ObjectKind::TO_SpeedAxis:
    case ObjectKind::TO_PositioningAxis:
    case ObjectKind::TO_SynchronousAxis:
      objects.push_back(std::make_unique<Axis>(kind, std::move(name), number));
      axes.push_back(static_cast<Axis*>(objects.back().get()));
      break;
    case ObjectKind::TO_ExternalEncoder:
      encoders.push_back(add<ExternalEncoder>(std::move(name), number));
      break;
    case ObjectKind::TO_MeasuringInput:
      measuring_inputs.push_back(add<MeasuringInput>(std::move(name), number));
      break;
    case ObjectKind::TO_OutputCam:
      output_cams.push_back(add<OutputCam>(std::move(name), number));
      break;
    case ObjectKind::TO_CamTrack:
      cam_tracks.push_back(add<CamTrack>(std::move(name), number));
      break;
    case ObjectKind::TO_Cam:
    case ObjectKind::TO_Cam_10k:
      objects.push_back(std::make_unique<Cam>(kind, std::move(name), number));
      cams.push_back(static_cast<Cam*>(objects.back().get()));
      break;
  }
  return *objects.back();
}

Axis& Controller::add_axis(ObjectKind kind, std::string name) {
  return static_cast<Axis&>(add_object(kind, std::move(name)));
}

Instance& Controller::add_instance(const BlockType& type, std::string name) {
  instances.push_back({std::move(name), &type, type.create()});
  instances.back().block->connect(encoder_saving);
  return instances.back();
}

/// Cams with the same address switch one output.
void Controller::wire_outputs() {
  const auto wire = [this](const bool* tag, bool all, const BOOL& state) {
    auto* const address = const_cast<bool*>(tag);  // variables hold addresses for reading; a tag is written
    const auto same = [&](const SwitchedOutput& output) { return output.address == address; };
    auto found = std::find_if(outputs_.begin(), outputs_.end(), same);
    if (found == outputs_.end()) found = outputs_.insert(found, SwitchedOutput{address, all, {}});
    found->states.push_back(&state);
  };
  for (const OutputCam* cam : output_cams) {
    const auto& interface = cam->data.Interface;
    if (interface.EnableOutput && interface.Address != nullptr)
      wire(interface.Address, interface.LogicOperation == 1, cam->data.CamOutput);
  }
  for (const CamTrack* track : cam_tracks) {
    const auto& interface = track->data.Interface;
    if (interface.EnableOutput && interface.Address != nullptr)
      wire(interface.Address, false, track->data.TrackOutput);
  }
}

void Controller::finish() {
  const double servo_period = static_cast<double>(clock.servo_cycle) * 1e-9;
  for (auto& object : objects) object->configure(servo_period, clock.interpolator_ratio);
  for (Axis* axis : axes)
    if (!axis->is_virtual()) driven_.push_back(axis);
  std::size_t most_points = 0;
  for (const Cam* cam : cams) most_points = std::max(most_points, cam->point_count());
  if (most_points > 0) interpolator_ = std::make_unique<CamInterpolator>(most_points);
  summary_.resize(axes.size());
  for (Watchdog& watchdog : watchdogs) watchdog.remember();
  wire_outputs();
  order_.set_axes(axes);
  order_.rebuild();
  for (Program& program : programs) schedule_.push_back(&program);
  std::stable_sort(schedule_.begin(), schedule_.end(), [](const Program* a, const Program* b) {
    return a->ob() != b->ob() ? a->ob() < b->ob() : a->priority() > b->priority();
  });
  std::stable_sort(stimuli.begin(), stimuli.end(),
                   [](const Stimulus& a, const Stimulus& b) { return a.at < b.at; });
  lay_objects_into_large_pages();
}

void Controller::lay_objects_into_large_pages() const {
  std::vector<const void*> places;
  for (const auto& object : objects) places.push_back(object.get());
  for (const auto& instance : instances) places.push_back(instance.block.get());
  if (places.empty()) return;
  const auto [lowest, highest] = std::minmax_element(places.begin(), places.end());
  lay_into_large_pages(*lowest, *highest);
}

void Controller::tell_jobs() {
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const JobWatch watch(*instances[i].type, *instances[i].block, static_cast<std::uint32_t>(i));
    if (watch.usable()) job_watches_.push_back(watch);
  }
}

void Controller::skip(std::int64_t ticks) noexcept {
  next_tick_ += ticks;
  counters_.missed_ticks += static_cast<std::uint64_t>(ticks);
  for (ExternalEncoder* encoder : encoders) encoder->skip_servo(ticks);
}

void Controller::shut_down() noexcept {
  take_summary();
  shutting_down_ = true;
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

bool Controller::interpolate_cams() noexcept {
  bool worked = false;
  for (Cam* cam : cams) worked |= cam->work(*interpolator_);
  return worked;
}

bool Controller::at_rest() const noexcept {
  return std::all_of(axes.begin(), axes.end(), [](const Axis* axis) { return axis->off(); });
}

}  // namespace lockstep
