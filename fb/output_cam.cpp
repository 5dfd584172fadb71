#include "fb/output_cam.hpp"

namespace lockstep {
namespace {

/// Of another instance that is in charge.
template <class Request>
bool taken(const Request& request, const void* by) noexcept {
  return request.owner != nullptr && request.owner != by;
}

}  // namespace

// ---- MC_OutputCam
// -----------------------------------------------------------------------------------------------

void MC_OutputCam::call(std::int64_t /*now*/) noexcept {
  error_ = take_over();
  const bool in_charge = OutputCam != nullptr && OutputCam->request.owner == this;
  Busy = in_charge;
  CamOutput = in_charge && OutputCam->data.CamOutput;
  Error = error_ != ErrorId::none;
  ErrorID = static_cast<WORD>(error_);
}

ErrorId MC_OutputCam::check() const noexcept {
  if (const ErrorId error = first_error(kPins, *this); error != ErrorId::none) return error;
  if (OutputCam == nullptr) return ErrorId::no_technology_object;
  if (taken(OutputCam->request, this)) return ErrorId::one_instance_only;
  OutputCamRequest wanted;
  wanted.duration = Duration;
  return OutputCam->refused(wanted);
}

ErrorId MC_OutputCam::take_over() noexcept {
  const bool in_charge = OutputCam != nullptr && OutputCam->request.owner == this;
  if (!Enable) {
    refused_ = false;
    if (in_charge) OutputCam->request = {};
    return ErrorId::none;
  }
  if (refused_) return error_;
  const ErrorId error = check();
  if (error != ErrorId::none) {
    refused_ = !in_charge;
    return error;
  }
  OutputCam->request = {.owner = this,
                        .enable = true,
                        .on_position = OnPosition,
                        .off_position = OffPosition,
                        .duration = Duration,
                        .mode = Mode,
                        .direction = Direction};
  return OutputCam->faulty() ? ErrorId::technology_alarm : ErrorId::none;
}

// ---- MC_CamTrack
// ------------------------------------------------------------------------------------------------

void MC_CamTrack::call(std::int64_t /*now*/) noexcept {
  error_ = take_over();
  const bool in_charge = CamTrack != nullptr && CamTrack->request.owner == this;
  Busy = in_charge;
  TrackOutput = in_charge && CamTrack->data.TrackOutput;
  Error = error_ != ErrorId::none;
  ErrorID = static_cast<WORD>(error_);
}

ErrorId MC_CamTrack::check() const noexcept {
  if (const ErrorId error = first_error(kPins, *this); error != ErrorId::none) return error;
  if (CamTrack == nullptr) return ErrorId::no_technology_object;
  return taken(CamTrack->request, this) ? ErrorId::one_instance_only : ErrorId::none;
}

/// Let go, a track of Mode 1 runs to its end, and this instance stays in charge until then.
ErrorId MC_CamTrack::take_over() noexcept {
  const bool in_charge = CamTrack != nullptr && CamTrack->request.owner == this;
  if (!Enable) {
    refused_ = false;
    if (!in_charge) return ErrorId::none;
    CamTrack->request.enable = false;
    if (Mode >= 0 && Mode <= 2) CamTrack->request.mode = Mode;
    if (CamTrack->request.mode != 1 || !CamTrack->active()) CamTrack->request = {};
    return ErrorId::none;
  }
  if (refused_) return error_;
  const ErrorId error = check();
  if (error != ErrorId::none) {
    refused_ = !in_charge;
    return error;
  }
  CamTrack->request = {.owner = this, .enable = true, .mode = Mode, .invert = InvertOutput, .called = true};
  return CamTrack->faulty() ? ErrorId::technology_alarm : ErrorId::none;
}

}  // namespace lockstep
