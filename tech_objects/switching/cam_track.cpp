#include "tech_objects/switching/cam_track.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tech_objects/types/published.hpp"

namespace lockstep {
namespace {

/// Values of Status.
constexpr DINT kInactive = 0;
constexpr DINT kActive = 1;
constexpr DINT kWaitsForNextCycle = 2;

}  // namespace

CamTrack::CamTrack(std::string object_name, DB_ANY object_number)
    : SwitchingObject(ObjectKind::TO_CamTrack, std::move(object_name), object_number) {}

// ---- Data
// -------------------------------------------------------------------------------------------------------

/// Whether a cam is used.
bool CamTrack::counts(const TO_Struct_CamTrack_Parameter& parameter, std::size_t cam) const noexcept {
  const bool masked = (static_cast<std::uint32_t>(parameter.CamMasking) >> cam & 1u) == 0;
  const auto& data_of_cam = parameter.Cam[cam];
  return data_of_cam.Existent && !masked && data_of_cam.OnPosition >= 0.0 &&
         data_of_cam.OnPosition < parameter.CamTrackLength;
}

bool CamTrack::data_fit(const TO_Struct_CamTrack_Parameter& parameter) const noexcept {
  for (std::size_t i = 0; i < kCams; ++i) {
    if (!counts(parameter, i)) continue;
    const auto& cam = parameter.Cam[i];
    const bool fits = parameter.CamTrackType == CamTrackType::time
                          ? cam.Duration + parameter.OnCompensation > parameter.OffCompensation
                          : cam.OnPosition < cam.OffPosition;
    if (!fits) return false;
  }
  return parameter.CamTrackLength > 0.0;
}

/// A distance cam ends with its track.
SwitchingShape CamTrack::shape(std::size_t cam) const noexcept {
  const auto& parameter = active_data_;
  return {.timed = parameter.CamTrackType == CamTrackType::time,
          .on = parameter.Cam[cam].OnPosition,
          .off = std::min(parameter.Cam[cam].OffPosition, parameter.CamTrackLength),
          .period = parameter.CamTrackLength,
          .duration = parameter.Cam[cam].Duration * kMillisecond,
          .directions = 3,
          .on_lead = parameter.OnCompensation * kMillisecond,
          .off_lead = parameter.OffCompensation * kMillisecond};
}

/// Why the track cannot be processed; 0: it can.
int CamTrack::alarm_of() const noexcept {
  if (!position_valid()) return alarm::kPositionInvalid;
  if (!data_fit(active_data_) || (waiting_ && !data_fit(waiting_data_))) return alarm::kCamTrackData;
  const double lead = std::max(active_data_.OnCompensation, active_data_.OffCompensation) * kMillisecond;
  return leads_within_range(lead) ? 0 : alarm::kSwitchingPosition;
}

/// What the last calls have asked for. Data count when they differ from those by which the track runs.
void CamTrack::take_data() noexcept {
  if (!request.called) return;
  request.called = false;
  if (!request.enable || !active_) return;
  waiting_ = !(data.Parameter == active_data_);
  if (waiting_) waiting_data_ = data.Parameter;
}

// ---- MC_Servo
// ---------------------------------------------------------------------------------------------------

void CamTrack::servo(std::int64_t now) noexcept {
  if (assigned == nullptr) return;
  if (assigned_restarted()) request = {};
  path_.servo(now, data.Parameter.Hysteresis);
  Edges edges;
  if (request.enable && !faulty() && !active_ && request.called) {
    active_data_ = data.Parameter;
    waiting_ = false;
  }
  const bool goes_on = active_ && request.owner != nullptr && request.mode == CamTrackMode::next_track;
  if (!faulty() && (request.enable || goes_on)) {
    take_data();
    const int alarm_number = alarm_of();
    if (alarm_number == 0)
      process(edges);
    else
      raise(alarm_number);
  } else if (active_) {
    stop(path_.time(), edges);
  }
  if (faulty()) stop(path_.time(), edges);
  inverted_ = active_ && request.invert;
  show(edges);
  finish();
}

void CamTrack::end() noexcept {
  Edges edges;
  stop(path_.time(), edges);
}

void CamTrack::stop(double time, Edges& edges) noexcept {
  for (std::size_t i = 0; i < kCams; ++i) {
    SwitchingEdges of_cam;
    cams_[i].end(time, of_cam);
    edges.add(i, of_cam);
  }
  active_ = waiting_ = false;
}

/// Where a position lies in its track, as if it had been reached upwards from the reference position.
double CamTrack::place_of(double position) const noexcept {
  const double length = active_data_.CamTrackLength;
  const double distance = positive_distance(active_data_.ReferencePosition, position, path_.modulo());
  const double place = distance - length * std::floor(distance / length);
  return place < length ? std::max(place, 0.0) : 0.0;
}

void CamTrack::process(Edges& edges) noexcept {
  if (!has_position()) return stop(path_.time(), edges);
  const Stretch& distance = path_.stretch();
  const bool at_once = waiting_ && request.mode != CamTrackMode::next_track;
  if (!active_ || !path_.moved() || at_once) {
    if (at_once) {
      stop(distance.to_time, edges);  // time cams that run are ended
      active_data_ = waiting_data_;
    }
    active_ = true;
    waiting_ = false;
    place_ = place_of(path_.position());
    return begin(edges, distance.shifted(place_ - distance.to), false);
  }
  // Homing is a step of the position; the wrap of a ring is none.
  const double before = place_;
  const double from = path_.jumped() == 0.0 ? before : place_of(distance.from);
  if (from != before)
    for (SingleCam& cam : cams_) cam.rename(before, from);
  place_ = from + (distance.to - distance.from);
  const double held = path_.free_from();
  Stretch counted = distance.shifted(from - distance.from);
  if (held > 1.0) {
    for (std::size_t i = 0; i < kCams; ++i) {
      SwitchingEdges of_cam;
      cams_[i].hold(distance.to_time, of_cam);
      edges.add(i, of_cam);
    }
  } else {
    step_to_border(edges, held > 0.0 ? counted.part(held, 1.0) : counted);
  }
  if (!active_) return;
  // The next tick counts from the track in which it is.
  const double length = active_data_.CamTrackLength;
  const double tracks = std::floor(place_ / length);
  if (tracks == 0.0) return;
  const double reduced = place_ - tracks * length;
  for (SingleCam& cam : cams_) cam.rename(place_, reduced);
  place_ = reduced;
}

/// Up to the end of the track what ran goes on; there new data begin, or the track ends.
void CamTrack::step_to_border(Edges& edges, const Stretch& distance) noexcept {
  const double length = active_data_.CamTrackLength;
  const bool ends = !request.enable;
  const bool leaves = distance.to >= length || distance.to < 0.0;
  if (!(waiting_ || ends) || !leaves) return step(edges, distance);
  const double border = distance.to >= length ? length : 0.0;
  const double part = std::clamp((border - distance.from) / (distance.to - distance.from), 0.0, 1.0);
  step(edges, distance.part(0.0, part));
  if (ends) return stop(distance.part(part, 1.0).from_time, edges);
  const double reference = waiting_data_.ReferencePosition;
  const bool moved = reference != active_data_.ReferencePosition ||
                     waiting_data_.CamTrackLength != active_data_.CamTrackLength;
  for (std::size_t i = 0; i < kCams; ++i) {  // running distance cams end with the track
    if (active_data_.CamTrackType == CamTrackType::time) continue;
    SwitchingEdges of_cam;
    cams_[i].end(distance.part(part, 1.0).from_time, of_cam);
    edges.add(i, of_cam);
  }
  active_data_ = waiting_data_;
  waiting_ = false;
  Stretch rest = distance.part(part, 1.0);
  // The new track begins at its border, unless it lies elsewhere.
  const double new_end = moved ? place_of(path_.position()) : place_ - (border == 0.0 ? 0.0 : length);
  rest = rest.shifted(new_end - rest.to);
  place_ = new_end;
  Stretch begin_at = rest.part(0.0, 0.0);
  begin(edges, begin_at, true);
  step(edges, rest);
}

void CamTrack::begin(Edges& edges, const Stretch& at, bool inclusive) noexcept {
  for (std::size_t i = 0; i < kCams; ++i) {
    SwitchingEdges of_cam;
    if (counts(active_data_, i)) cams_[i].begin(shape(i), at, path_.direction(), inclusive, of_cam);
    edges.add(i, of_cam);
  }
}

void CamTrack::step(Edges& edges, const Stretch& distance) noexcept {
  for (std::size_t i = 0; i < kCams; ++i) {
    SwitchingEdges of_cam;
    if (counts(active_data_, i))
      cams_[i].step(shape(i), distance, path_.direction(), of_cam);
    else if (active_data_.CamTrackType == CamTrackType::time)
      cams_[i].hold(distance.to_time, of_cam);  // of the data before, it runs out
    else
      cams_[i].end(distance.from_time, of_cam);
    edges.add(i, of_cam);
  }
}

void CamTrack::Edges::add(std::size_t cam, const SwitchingEdges& edges) noexcept {
  for (std::size_t i = 0; i < edges.count && count < list.size(); ++i) {
    std::size_t at = count++;
    for (; at > 0 && list[at - 1].time > edges.list[i].time; --at) list[at] = list[at - 1];
    list[at] = {edges.list[i].time, static_cast<std::uint8_t>(cam), edges.list[i].on};
  }
}

/// The state of the output at this tick, and when it has changed since the one before.
void CamTrack::show(const Edges& edges) noexcept {
  const bool always = active_ && request.mode == CamTrackMode::always_on;
  bool last = output();
  for (std::size_t i = 0; i < edges.count; ++i) {
    const Edges::Edge& edge = edges.list[i];
    const std::uint32_t bit = std::uint32_t{1} << edge.cam;
    shown_ = edge.on ? shown_ | bit : shown_ & ~bit;
    const bool to = active_ && (always || (shown_ != 0) != inverted_);
    if (to != last) note(edge.time, to);
    last = to;
  }
  shown_ = 0;
  for (std::size_t i = 0; i < kCams; ++i) shown_ |= cams_[i].on() ? std::uint32_t{1} << i : 0u;
  switch_output(active_ && (always || (shown_ != 0) != inverted_), last);
}

void CamTrack::show_processing() noexcept {
  data.Status = !active_ ? kInactive : waiting_ ? kWaitsForNextCycle : kActive;
  data.SingleCamState = static_cast<DWORD>(shown_);
  data.TrackPosition = active_ ? place_ : 0.0;
  data.MatchPosition = 0.0;
  if (active_) data.MatchPosition = advanced({0, path_.position()}, -place_, path_.modulo()).value;
}

}  // namespace lockstep
