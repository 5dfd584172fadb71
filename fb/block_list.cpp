// The one list of function blocks: a new block is its file pair, its test and one line here.
#include "fb/bistable.hpp"
#include "fb/block.hpp"
#include "fb/cam_in.hpp"
#include "fb/cam_value.hpp"
#include "fb/copy_cam_data.hpp"
#include "fb/counters.hpp"
#include "fb/drive_words.hpp"
#include "fb/edge.hpp"
#include "fb/gear_in.hpp"
#include "fb/gear_in_velocity.hpp"
#include "fb/home.hpp"
#include "fb/interpolate_cam.hpp"
#include "fb/jog.hpp"
#include "fb/leading_value.hpp"
#include "fb/long_counters.hpp"
#include "fb/measuring_input.hpp"
#include "fb/motion_in.hpp"
#include "fb/move.hpp"
#include "fb/offset.hpp"
#include "fb/output_cam.hpp"
#include "fb/parameter.hpp"
#include "fb/phasing.hpp"
#include "fb/power.hpp"
#include "fb/save_encoder_data.hpp"
#include "fb/stop.hpp"
#include "fb/superimposed.hpp"
#include "fb/sync_out.hpp"
#include "fb/timers.hpp"
#include "fb/torque.hpp"

namespace lockstep {
namespace {

// One block a line:
// clang-format off
constexpr BlockType kTypes[] = {
    block_type<MC_Power>(),
    block_type<MC_Reset>(),
    block_type<MC_Home>(),
    block_type<MC_MoveAbsolute>(),
    block_type<MC_MoveRelative>(),
    block_type<MC_MoveVelocity>(),
    block_type<MC_MoveJog>(),
    block_type<MC_Halt>(),
    block_type<MC_Stop>(),
    block_type<MC_MoveSuperimposed>(),
    block_type<MC_HaltSuperimposed>(),
    block_type<MC_MotionInSuperimposed>(),
    block_type<MC_MotionInVelocity>(),
    block_type<MC_MotionInPosition>(),
    block_type<MC_GearIn>(),
    block_type<MC_GearInPos>(),
    block_type<MC_GearInVelocity>(),
    block_type<MC_PhasingRelative>(),
    block_type<MC_PhasingAbsolute>(),
    block_type<MC_OffsetRelative>(),
    block_type<MC_OffsetAbsolute>(),
    block_type<MC_CamIn>(),
    block_type<MC_SynchronizedMotionSimulation>(),
    block_type<MC_GearOut>(),
    block_type<MC_CamOut>(),
    block_type<MC_LeadingValueAdditive>(),
    block_type<MC_MeasuringInput>(),
    block_type<MC_MeasuringInputCyclic>(),
    block_type<MC_AbortMeasuringInput>(),
    block_type<MC_OutputCam>(),
    block_type<MC_CamTrack>(),
    block_type<MC_InterpolateCam>(),
    block_type<MC_GetCamLeadingValue>(),
    block_type<MC_GetCamFollowingValue>(),
    block_type<MC_CopyCamData>(),
    block_type<MC_SetSensor>(),
    block_type<MC_SetAxisSTW>(),
    block_type<MC_WriteParameter>(),
    block_type<MC_SaveAbsoluteEncoderData>(),
    block_type<MC_TorqueLimiting>(),
    block_type<MC_TorqueRange>(),
    block_type<MC_TorqueAdditive>(),
    block_type<R_TRIG>(),
    block_type<F_TRIG>(),
    block_type<SR>(),
    block_type<RS>(),
    block_type<TON>(),
    block_type<TOF>(),
    block_type<TP>(),
    block_type<CTU>(),
    block_type<CTD>(),
    block_type<CTUD>(),
    block_type<CTU_DINT>(),
    block_type<CTD_DINT>(),
    block_type<CTUD_DINT>(),
};
// clang-format on

}  // namespace

std::span<const BlockType> block_types() noexcept {
  return kTypes;
}

}  // namespace lockstep
