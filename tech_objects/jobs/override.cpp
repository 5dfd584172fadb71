#include "tech_objects/jobs/override.hpp"

namespace lockstep {
namespace {

// A: the running job is aborted.  N: the new job is rejected.  .: no effect.
// B: aborted by the same or a stronger stop reaction.
// a: A if the axis is position-controlled, else N.  n: . if the axis is position-controlled, else N.
// Columns: home passive, home active, motion, stop, superimposed, motion in | gear in, gear in velocity,
// gear in pos waiting, active, cam in waiting, active | phasing, offset, additive | gear out waiting, active,
// cam out waiting, active | measuring. Footnote 6 (gear jobs end gear jobs, cam jobs end cam jobs) is written
// out.
constexpr std::array<OverrideRow, 23> kRows = {{
    {JobClass::home_passive, "...................A", {0, 0, 7317}},
    {JobClass::home_active, "AAA.AAAA...........A", {7214, 7255, 7317}},
    {JobClass::motion, ".AA.AAAA.A.AAA.AAAA.", {7216, 7256, 0}},
    {JobClass::stop, "AAABAAAAAAAAAA.AAAA.", {7218, 7260, 0}},
    {JobClass::superimposed, "....A..n............", {7217, 7259, 0}},
    {JobClass::motion_in, ".AA.AAAAAAAAAA.AAAA.", {7216, 7258, 0}},
    {JobClass::gear_in, ".AA.A.AAAAAAAA.AAAA.", {7219, 7261, 0}},
    {JobClass::gear_in_velocity, ".AA.A.AAAAAAAA.AAAA.", {7219, 7261, 0}},
    {JobClass::gear_in_pos_waiting, "........A.A....A.A..", {7220, 7285, 0}},
    {JobClass::gear_in_pos_active, ".AA.A.AaAAAAAA.AAAA.", {7221, 7286, 0}},
    {JobClass::cam_in_waiting, "........A.A....A.A..", {7220, 7285, 0}},
    {JobClass::cam_in_active, ".AA.A.AaAAAAAA.AAAA.", {7221, 7286, 0}},
    {JobClass::phasing, ".......N....AN......", {0, 7287, 0}},
    {JobClass::offset, ".......N....NA......", {0, 7288, 0}},
    {JobClass::leading_value_additive, "..............A.....", {7222, 7289, 0}},
    {JobClass::gear_out_waiting, ".......NA......A....", {7223, 7290, 0}},
    {JobClass::gear_out_active, "....A.ANAA..AA.A....", {7227, 7291, 0}},
    {JobClass::cam_out_waiting, ".......N..A......A..", {7223, 7290, 0}},
    {JobClass::cam_out_active, "....A..N..AAAA...A..", {7227, 7291, 0}},
    {JobClass::measuring, "...................A", {0, 0, 7319}},
    {JobClass::measuring_abort, "...................A", {0, 0, 7319}},
    {JobClass::home_cancel, "A..................A", {7215, 0, 7317}},
    {JobClass::home_direct, "....................", {0, 0, 7318}},
}};

constexpr std::string_view kOneBaseMotion =
    "an axis has one base motion, so a synchronous job ends a running MotionIn job (printed: no effect)";

constexpr std::array<OverrideException, 4> kExceptions = {{
    {JobClass::gear_in, JobClass::motion_in, OverrideEffect::abort, kOneBaseMotion},
    {JobClass::gear_in_velocity, JobClass::motion_in, OverrideEffect::abort, kOneBaseMotion},
    {JobClass::gear_in_pos_active, JobClass::motion_in, OverrideEffect::abort, kOneBaseMotion},
    {JobClass::cam_in_active, JobClass::motion_in, OverrideEffect::abort, kOneBaseMotion},
}};

JobClass class_of_homing(HomeMode mode) noexcept {
  switch (mode) {
    case HomeMode::passive:
    case HomeMode::passive_resetting:
    case HomeMode::passive_configured:
      return JobClass::home_passive;
    case HomeMode::active:
    case HomeMode::active_configured:
      return JobClass::home_active;
    case HomeMode::cancel_passive:
      return JobClass::home_cancel;
    default:
      return JobClass::home_direct;
  }
}

}  // namespace

JobClass class_of(const Job& job, bool active) noexcept {
  switch (job.kind) {
    case JobKind::MC_Home:
      return class_of_homing(job.as<HomingJob>().mode);
    case JobKind::MC_Halt:
    case JobKind::MC_MoveAbsolute:
    case JobKind::MC_MoveRelative:
    case JobKind::MC_MoveVelocity:
    case JobKind::MC_MoveJog:
      return JobClass::motion;
    case JobKind::MC_Stop:
      return JobClass::stop;
    case JobKind::MC_MoveSuperimposed:
    case JobKind::MC_MotionInSuperimposed:
    case JobKind::MC_HaltSuperimposed:
      return JobClass::superimposed;
    case JobKind::MC_MotionInVelocity:
    case JobKind::MC_MotionInPosition:
      return JobClass::motion_in;
    case JobKind::MC_GearIn:
      return JobClass::gear_in;
    case JobKind::MC_GearInVelocity:
      return JobClass::gear_in_velocity;
    case JobKind::MC_GearInPos:
      return active ? JobClass::gear_in_pos_active : JobClass::gear_in_pos_waiting;
    case JobKind::MC_CamIn:
      return active ? JobClass::cam_in_active : JobClass::cam_in_waiting;
    case JobKind::MC_PhasingAbsolute:
    case JobKind::MC_PhasingRelative:
      return JobClass::phasing;
    case JobKind::MC_OffsetAbsolute:
    case JobKind::MC_OffsetRelative:
      return JobClass::offset;
    case JobKind::MC_LeadingValueAdditive:
      return JobClass::leading_value_additive;
    case JobKind::MC_GearOut:
      return active ? JobClass::gear_out_active : JobClass::gear_out_waiting;
    case JobKind::MC_CamOut:
      return active ? JobClass::cam_out_active : JobClass::cam_out_waiting;
    case JobKind::MC_MeasuringInput:
    case JobKind::MC_MeasuringInputCyclic:
      return JobClass::measuring;
    case JobKind::MC_AbortMeasuringInput:
      return JobClass::measuring_abort;
    case JobKind::MC_Reset:
    case JobKind::MC_InterpolateCam:
    case JobKind::MC_CopyCamData:
    case JobKind::MC_SetSensor:
    case JobKind::MC_SetAxisSTW:
    case JobKind::MC_WriteParameter:
      break;  // stand beside the tables
  }
  return JobClass::home_direct;
}

OverrideEffect override_effect(JobClass new_job, JobClass running, bool position_controlled) noexcept {
  for (const OverrideException& exception : kExceptions)
    if (exception.new_job == new_job && exception.running == running) return exception.effect;
  if (static_cast<int>(running) >= kRunningClasses) return OverrideEffect::none;
  switch (kRows[static_cast<std::size_t>(new_job)].codes[static_cast<std::size_t>(running)]) {
    case 'A':
      return OverrideEffect::abort;
    case 'N':
      return OverrideEffect::reject;
    case 'B':
      return OverrideEffect::abort_by_rank;
    case 'a':
      return position_controlled ? OverrideEffect::abort : OverrideEffect::reject;
    case 'n':
      return position_controlled ? OverrideEffect::none : OverrideEffect::reject;
    default:
      return OverrideEffect::none;
  }
}

std::array<OverrideRow, 23> override_rows() noexcept {
  return kRows;
}
std::array<OverrideException, 4> override_exceptions() noexcept {
  return kExceptions;
}

}  // namespace lockstep
