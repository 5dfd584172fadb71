#include "fb/output_cam.hpp"

namespace lockstep {

void SwitchingBlock::call(std::int64_t /*now*/) noexcept {
  error_ = take_over();
  Busy = in_charge();
  Error = error_ != ErrorId::none;
  ErrorID = static_cast<WORD>(error_);
  show(Busy);
}

ErrorId SwitchingBlock::check() const noexcept {
  if (const ErrorId error = first_error(pin_table(), *this); error != ErrorId::none) return error;
  if (!wired()) return ErrorId::no_technology_object;
  if (owner() != nullptr && owner() != this) return ErrorId::one_instance_only;
  return refusal();
}

ErrorId SwitchingBlock::take_over() noexcept {
  if (!Enable) {
    refused_ = false;
    if (in_charge()) let_go();
    return ErrorId::none;
  }
  if (refused_) return error_;
  if (Busy && wired() && owner() != this) {  // the object itself has ended the job
    refused_ = true;
    return ErrorId::restarting;
  }
  if (const ErrorId error = check(); error != ErrorId::none) {
    refused_ = !in_charge();
    return error;
  }
  request();
  return faulty() ? ErrorId::technology_alarm : ErrorId::none;
}

OutputCamRequest MC_OutputCam::wanted() const noexcept {
  return {.owner = this,
          .enable = true,
          .on_position = OnPosition,
          .off_position = OffPosition,
          .duration = Duration,
          .mode = static_cast<OutputCamMode>(Mode),
          .direction = static_cast<PublishedDirection>(Direction)};
}

void MC_CamTrack::request() const noexcept {
  CamTrack->request = {.owner = this,
                       .enable = true,
                       .mode = static_cast<CamTrackMode>(Mode),
                       .invert = InvertOutput,
                       .called = true};
}

/// A track of Mode 1 runs to its end, and this instance stays in charge until then.
void MC_CamTrack::let_go() const noexcept {
  CamTrack->request.enable = false;
  if (Mode >= 0 && Mode <= 2) CamTrack->request.mode = static_cast<CamTrackMode>(Mode);
  if (CamTrack->request.mode != CamTrackMode::next_track || !CamTrack->active()) CamTrack->request = {};
}

}  // namespace lockstep
