#include "fb/cam_value.hpp"

namespace lockstep {

void MC_GetCamLeadingValue::hand_over(Job& job) noexcept {
  if (Cam->restarting()) return job.fail(ErrorId::restarting);
  const auto found = Cam->function().leading_value(FollowingValue, ApproachLeadingValue);
  if (!found) return job.fail(ErrorId::no_leading_value);
  Value = *found;
  job.phase = JobPhase::done;
}

void MC_GetCamFollowingValue::hand_over(Job& job) noexcept {
  if (Cam->restarting()) return job.fail(ErrorId::restarting);
  const CamFunction& cam = Cam->function();
  if (!cam.defined_at(LeadingValue)) return job.fail(ErrorId::no_following_value);
  const CamValue value = cam.value(LeadingValue);
  Value = value.position;
  FirstDerivative = value.first_derivative;
  SecondDerivative = value.second_derivative;
  job.phase = JobPhase::done;
}

}  // namespace lockstep
