#include "tech_objects/alarms/error_remedies.hpp"

#include <algorithm>
#include <iterator>

namespace lockstep {
namespace {

constexpr std::string_view kNotReported = "nothing in Lockstep reports it";

struct Remedy {
  ErrorId id;
  std::string_view text;
};

constexpr Remedy kRemedies[] = {
    {ErrorId{0x8001},
     "mend what the alarm of the object tells, acknowledge with MC_Reset, then start the job anew"},
    {ErrorId{0x8002},
     "connect the pin with an object of a kind that it takes, and name only leading objects of the axis' "
     "leading_values"},
    {ErrorId{0x8003},
     "give Velocity a value that is permitted (lockstep describe BLOCK.Velocity tells which); with "
     "SyncProfileReference 0, MC_GearInPos and MC_CamIn need one above the synchronous velocity (leading "
     "velocity times ratio, or slope of the cam): raise the pin Velocity, or DynamicDefaults.Velocity of the "
     "following axis where the pin is below 0 or not given, up to DynamicLimits.MaxVelocity, or synchronize "
     "over a leading distance (profile 1 or 3)"},
    {ErrorId{0x8007}, "give a direction that is permitted, or only one of JogForward and JogBackward"},
    {ErrorId{0x8008},
     "give a distance that is permitted, and that does not lead beyond the range of positions"},
    {ErrorId{0x8009}, "give a position that is permitted, and that lies within the range of positions"},
    {ErrorId{0x800A}, "give a mode that is permitted, and that fits what the axis does now"},
    {ErrorId{0x800C}, "leave the object to one instance of this block, or end what the other one does first"},
    {ErrorId{0x800D}, "wait until the restart of the object is complete"},
    {ErrorId{0x800E}, "switch Enable of MC_Power off, and wait for Status FALSE, before the restart"},
    {ErrorId{0x800F}, "enable the axis and wait for Status of MC_Power, or set Execute of MC_Stop to FALSE"},
    {ErrorId{0x8010},
     "modes 6 and 7 adjust an absolute encoder: take 13 for an incremental one, or configure the encoder as "
     "absolute (Sensor[].Type)"},
    {ErrorId{0x8011}, "mode 13 adjusts an incremental encoder: take 6 or 7 for an absolute one"},
    {ErrorId{0x8012}, kNotReported},
    {ErrorId{0x8013}, kNotReported},
    {ErrorId{0x8014}, "start fewer jobs in one tick, and buffer one job behind another only"},
    {ErrorId{0x8015}, kNotReported},
    {ErrorId{0x8016},
     "mend the fault of encoder or communication and acknowledge it, or name an encoder that the machine "
     "has"},
    {ErrorId{0x8019}, "end the coupling that leads from this axis to the one that it is to follow"},
    {ErrorId{0x8044}, "give the axis a drive that can be limited: a virtual or simulated axis has none"},
    {ErrorId{0x8045}, "leave the fixed stop before the axis leaves position control"},
    {ErrorId{0x8046}, "move away from the fixed stop, or keep Enable TRUE until then"},
    {ErrorId{0x8047}, "move away from the fixed stop first, by a motion of the axis' own"},
    {ErrorId{0x804D}, "give an UpperLimit above LowerLimit"},
    {ErrorId{0x804E}, "end the one before the other begins"},
    {ErrorId{0x804F}, "give the axis a drive with torque data (Actor.Interface.EnableTorqueData)"},
    {ErrorId{0x805B}, "configure PositionLimits_HW with its switches"},
    {ErrorId{0x805C}, "give 0.0 or 1.0 for a parameter of type BOOL"},
    {ErrorId{0x805D},
     "leave these parameters alone: no drive of this project is reached through a data block"},
    {ErrorId{0x8063}, "ask for a following value that the cam has"},
    {ErrorId{0x8064}, "ask for a leading value within the cam"},
    {ErrorId{0x8065}, kNotReported},
    {ErrorId{0x8066}, kNotReported},
    {ErrorId{0x8071},
     "bring the axis under position control: MC_Power with StartMode 1, or a job with PositionControlled "
     "TRUE"},
    {ErrorId{0x8074}, "wait until the homing is complete, or end it"},
    {ErrorId{0x8075}, "simulate only what is in gear: start MC_GearIn first, and wait for InGear"},
    {ErrorId{0x8076}, "end MC_SynchronizedMotionSimulation first"},
    {ErrorId{0x8077}, "start MC_GearIn or MC_GearInPos first"},
    {ErrorId{0x8078}, "start MC_CamIn first"},
    {ErrorId{0x8079}, "end MC_GearInVelocity first, or take MC_GearIn, which follows positions"},
    {ErrorId{0x808A}, "wait until the other shift is complete, or end it"},
    {ErrorId{0x808B}, "take another SyncProfileReference: 5 takes over from a cam that runs"},
    {ErrorId{0x808C}, "shift while the leading value moves in one direction only"},
    {ErrorId{0x80A1}, "leave the coupling first, or home before it"},
    {ErrorId{0x80A2}, "widen the range, or look for the edge; on a ring it is within the ring"},
    {ErrorId{0x80A3}, "measure when the homing of the axis is complete"},
    {ErrorId{0x80A7}, "widen the range, or look for the edge: it was beyond"},
    {ErrorId{0x80A8}, "take ProfileReference 1 or 2, over the leading distance"},
    {ErrorId{0x80A9}, "wait until the axis is synchronous (InGear, InSync)"},
    {ErrorId{0x80AA}, "define points or segments, then interpolate with MC_InterpolateCam"},
    {ErrorId{0x80AB}, "wait until no axis follows the cam, or write to a second one and change over"},
    {ErrorId{0x80AC},
     "mend points and segments: lockstep cam check tells what is wrong with them; a cyclic cam has to end "
     "where it begins"},
    {ErrorId{0x80AD}, "give synchronous positions that lie within the cam"},
    {ErrorId{0x80AE}, kNotReported},
    {ErrorId{0x80E7}, "wait until the copying is complete"},
    {ErrorId{0x80E8}, "wait until the interpolation is complete"},
    {ErrorId{0x80E9}, "give an array of TO_Cam_Struct_PointData that is long enough"},
    {ErrorId{0x80EA}, "give an array of TO_Cam_Struct_SegmentData that is long enough"},
    {ErrorId{0x80EB}, "make space where the retain file lies"},
    {ErrorId{0x80EC}, "see to the disk, and to the rights in the folder of the retain file"},
    {ErrorId{0x80ED}, "use one or two instances of the block"},
    {ErrorId{0x80EE}, "wait until the other instance is done"},
    {ErrorId{0x80EF},
     "run in real time with a retain file that may be written: --no-retain and --simulate keep nothing"},
    {ErrorId{0x8110}, kNotReported},
    {ErrorId{0x8111}, kNotReported},
    {ErrorId{0x8FFF},
     "look at the object: it lacks what the job needs, such as a drive or an encoder, or its values leave no "
     "motion that can be computed"},
};

// All others are of one input.
constexpr std::string_view kPermitted =
    "give the input a value that is permitted there: lockstep describe BLOCK.INPUT tells which";

}  // namespace

std::string_view error_remedy(ErrorId id) noexcept {
  if (id == ErrorId::none || error_text(id).empty()) return {};
  const auto* const row = std::ranges::find(kRemedies, id, &Remedy::id);
  return row == std::end(kRemedies) ? kPermitted : row->text;
}

}  // namespace lockstep
