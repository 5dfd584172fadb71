#include "tech_objects/switching/output_cam.hpp"

#include <cmath>
#include <utility>

#include "tech_objects/types/published.hpp"

namespace lockstep {

OutputCam::OutputCam(std::string object_name, DB_ANY object_number)
    : SwitchingObject(ObjectKind::TO_OutputCam, std::move(object_name), object_number) {}

ErrorId OutputCam::refused(const OutputCamRequest& wanted) const noexcept {
  if (data.Parameter.OutputCamType == OutputCamType::switching) return ErrorId::unspecified;
  if (data.Parameter.OutputCamType == OutputCamType::time && !(wanted.duration > 0.0))
    return ErrorId::cam_duration;
  return ErrorId::none;
}

/// Places on a ring are brought onto it.
SwitchingShape OutputCam::shape() const noexcept {
  const Modulo ring = assigned->modulo();
  const auto& parameter = data.Parameter;
  SwitchingShape shape{.timed = parameter.OutputCamType == OutputCamType::time,
                       .on = request.on_position,
                       .off = request.off_position,
                       .duration = request.duration * kMillisecond,
                       .directions = static_cast<int>(request.direction),
                       .on_lead = parameter.OnCompensation * kMillisecond,
                       .off_lead = parameter.OffCompensation * kMillisecond};
  if (!ring.enabled) return shape;
  shape.period = ring.length;
  shape.on = normalised({0, shape.on}, ring).value;
  shape.off = shape.on + positive_distance(shape.on, request.off_position, ring);
  return shape;
}

/// Why these data cannot be processed; 0: they can.
int OutputCam::alarm_of(const SwitchingShape& shape) const noexcept {
  if (!position_valid()) return alarm::kPositionInvalid;
  if (request.mode == OutputCamMode::always_on) return 0;
  if (shape.timed ? shape.duration + shape.on_lead <= shape.off_lead : shape.on == shape.off)
    return alarm::kOutputCamData;
  return leads_within_range(std::max(shape.on_lead, shape.off_lead)) ? 0 : alarm::kSwitchingPosition;
}

// ---- MC_Servo
// ---------------------------------------------------------------------------------------------------

void OutputCam::servo(std::int64_t now) noexcept {
  if (assigned == nullptr) return;
  if (assigned_restarted()) request = {};
  path_.servo(now, data.Parameter.Hysteresis);
  SwitchingEdges edges;
  const bool wanted = request.enable && !faulty();
  if (wanted) {
    const SwitchingShape shape = this->shape();
    const int alarm_number = alarm_of(shape);
    if (alarm_number != 0)
      raise(alarm_number);
    else
      process(shape, edges);
  }
  if (!wanted || faulty()) {
    cam_.end(path_.time(), edges);
    active_ = false;
  }
  inverted_ = active_ && request.mode == OutputCamMode::inverted;
  show(active_ && (request.mode == OutputCamMode::always_on || cam_.on() != inverted_), edges);
  finish();
}

void OutputCam::process(const SwitchingShape& shape, SwitchingEdges& edges) noexcept {
  if (!has_position()) {
    cam_.end(path_.time(), edges);
    active_ = false;
    return;
  }
  if (!active_ || !path_.moved()) {
    active_ = true;
    cam_.begin(shape, path_.stretch(), path_.direction(), false, edges);
    return;
  }
  step_cam(shape, edges);
}

void OutputCam::step_cam(const SwitchingShape& shape, SwitchingEdges& edges) noexcept {
  const Stretch& distance = path_.stretch();
  cam_.rename(distance.from - path_.renamed(), distance.from);
  if (path_.free_from() > 1.0) return cam_.hold(distance.to_time, edges);
  if (path_.free_from() > 0.0) {
    const Stretch free = distance.part(path_.free_from(), 1.0);
    cam_.hold(free.from_time, edges);
    return cam_.step(shape, free, path_.direction(), edges);
  }
  cam_.step(shape, distance, path_.direction(), edges);
}

/// The state of the output at this tick, and when it has changed since the one before.
void OutputCam::show(bool on, const SwitchingEdges& edges) noexcept {
  const bool by_cam = active_ && request.mode != OutputCamMode::always_on;
  bool shown = output();
  for (std::size_t i = 0; by_cam && i < edges.count; ++i) {
    const bool to = edges.list[i].on != inverted_;
    if (to != shown) note(edges.list[i].time, to);
    shown = to;
  }
  switch_output(on, shown);
}

}  // namespace lockstep
