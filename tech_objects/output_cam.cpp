#include "tech_objects/output_cam.hpp"

#include <cmath>
#include <utility>

#include "tech_objects/object_alarms.hpp"
#include "tech_objects/object_bits.hpp"

namespace lockstep {
namespace {

/// Values of Parameter.OutputCamType.
constexpr DINT kTimeCam = 1;
constexpr DINT kSwitchingCam = 2;
/// Values of Mode.
constexpr DINT kInverted = 2;
constexpr DINT kAlwaysOn = 3;

constexpr double kMillisecond = 1e-3;  // [s]

}  // namespace

OutputCam::OutputCam(std::string object_name, DB_ANY object_number)
    : TechnologyObject(ObjectKind::TO_OutputCam, std::move(object_name), object_number) {}

void OutputCam::configure(double servo_period, int ratio) {
  servo_period_ = servo_period;
  ratio_ = ratio;
  start_values_ = data;
  if (assigned == nullptr) return;
  watch();
  publish();
}

/// An external encoder has no setpoint.
void OutputCam::watch() noexcept {
  const bool actual = data.Parameter.PositionType == 1 || assigned->kind == ObjectKind::TO_ExternalEncoder;
  path_.watch(*assigned, actual, servo_period_, ratio_);
  restarts_ = assigned->restarts();
}

ErrorId OutputCam::refused(const OutputCamRequest& wanted) const noexcept {
  if (data.Parameter.OutputCamType == kSwitchingCam) return ErrorId::unspecified;
  if (data.Parameter.OutputCamType == kTimeCam && !(wanted.duration > 0.0)) return ErrorId::cam_duration;
  return ErrorId::none;
}

/// Places on a ring are brought onto it.
SwitchingShape OutputCam::shape() const noexcept {
  const Modulo ring = assigned->modulo();
  const auto& parameter = data.Parameter;
  SwitchingShape shape{.timed = parameter.OutputCamType == kTimeCam,
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
  if (!assigned->actual_values_valid() || restarts_ != assigned->restarts()) return alarm::kPositionInvalid;
  if (request.mode == kAlwaysOn) return 0;
  if (shape.timed ? shape.duration + shape.on_lead <= shape.off_lead : shape.on == shape.off)
    return alarm::kOutputCamData;
  const Stretch& way = path_.stretch();
  const double lead = std::max(shape.on_lead, shape.off_lead);
  const double furthest = std::max(std::abs(way.from_velocity), std::abs(way.to_velocity)) * lead;
  return furthest <= kPositionRange ? 0 : alarm::kSwitchingPosition;
}

// ---- MC_Servo
// ---------------------------------------------------------------------------------------------------

void OutputCam::servo(std::int64_t now) noexcept {
  if (assigned == nullptr) return;
  path_.servo(now, data.Parameter.Hysteresis);
  SwitchingEdges edges;
  const bool wanted = request.enable && !faulty();
  if (wanted) {
    const SwitchingShape shape = this->shape();
    const int alarm_number = alarm_of(shape);
    if (alarm_number != 0) {
      raise_alarm(alarm_number, ProcessingEnd::output_cam, *this, data);
      restarts_ = assigned->restarts();
      path_.begin_anew();
    } else {
      process(shape, edges);
    }
  }
  if (!wanted || faulty()) {
    cam_.end(path_.time(), edges);
    active_ = false;
  }
  inverted_ = active_ && request.mode == kInverted;
  show(active_ && (request.mode == kAlwaysOn || cam_.on() != inverted_), edges);
  new_jobs_.take([this](Job& job) { start(job); });
  publish();
}

void OutputCam::process(const SwitchingShape& shape, SwitchingEdges& edges) noexcept {
  const bool setpoint = data.Parameter.PositionType == 0 && assigned->kind != ObjectKind::TO_ExternalEncoder;
  if (setpoint && !assigned->position_controlled()) {
    cam_.end(path_.time(), edges);  // there is no setpoint that would switch
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
  const Stretch& way = path_.stretch();
  cam_.rename(way.from - path_.renamed(), way.from);
  if (path_.free_from() > 1.0) return cam_.hold(way.to_time, edges);
  if (path_.free_from() > 0.0) {
    const Stretch free = way.part(path_.free_from(), 1.0);
    cam_.hold(free.from_time, edges);
    return cam_.step(shape, free, path_.direction(), edges);
  }
  cam_.step(shape, way, path_.direction(), edges);
}

/// The state of the output at this tick, and when it has changed since the one before.
void OutputCam::show(bool on, const SwitchingEdges& edges) noexcept {
  const auto note = [this](double time, bool to) {
    double* const place = to ? switching_times.on : switching_times.off;
    if (place != nullptr) *place = time;
  };
  const bool by_cam = active_ && request.mode != kAlwaysOn;
  bool shown = data.CamOutput;
  for (std::size_t i = 0; by_cam && i < edges.count; ++i) {
    const bool to = edges.list[i].on != inverted_;
    if (to != shown) note(edges.list[i].time, to);
    shown = to;
  }
  if (shown != on) note(path_.time(), on);
  data.CamOutput = on;
}

void OutputCam::start(Job& job) noexcept {
  if (job.kind != JobKind::MC_Reset) return job.fail(ErrorId::no_technology_object);
  clear_alarms(*this, data);
  job.phase = JobPhase::done;
  if (job.mode != 1) return;
  const BOOL output = data.CamOutput;
  data = start_values_;
  data.CamOutput = output;  // until the next tick
  start_values_changed = false;
  active_ = false;
  watch();
}

void OutputCam::publish() noexcept {
  set_bit(data.StatusWord, InputOutputBit::Control, active_);
  set_bit(data.StatusWord, InputOutputBit::Error, data.ErrorDetail.Number != 0);
  set_bit(data.StatusWord, InputOutputBit::OnlineStartValuesChanged, start_values_changed);
  set_bit(data.StatusWord, InputOutputBit::OutputInverted, inverted_);
  set_bit(data.StatusWord, InputOutputBit::CommunicationOK, true);
}

}  // namespace lockstep
