/// What the instructions of a family ask for, and what the object that carries them out tells of them: one
/// plain struct per family. What all jobs have stands in `Job`.
#pragma once

#include "tech_objects/alarms/alarms.hpp"
#include "tech_objects/arithmetic/double_double.hpp"
#include "tech_objects/jobs/modes.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

class Cam;
class LeadingObject;
struct CamCopy;

// ---- Of every object

/// MC_Reset.
struct ResetJob {
  bool restart = false;  ///< takes over the start values, besides acknowledging
};

// ---- Of what has a position

/// MC_Home.
struct HomingJob {
  HomeMode mode{};
  LREAL position{};  ///< home position, or by what the position is shifted [u]
  DINT sensor{};     ///< encoder to adjust, 1 to 4; 0: the operative one

  // Written by the object.
  int direction{};        ///< in which an active homing heads
  LREAL mark_position{};  ///< position assigned to the homing mark [u]
};

// ---- Settings of axes

/// MC_SetSensor.
struct SensorJob {
  DINT sensor = 1;  ///< 1 to 4
  SetSensorMode mode{};
  DINT reference = 1;  ///< 1 to 4; copy_from_reference: whose position is taken
};

/// MC_SetAxisSTW: bits of both control words, those that the masks have.
struct ControlBitsJob {
  WORD stw1{};
  WORD stw1_mask{};
  WORD stw2{};
  WORD stw2_mask{};
};

/// MC_WriteParameter, of PositionLimits_HW.Active.
struct LimitSwitchesJob {
  bool active = false;
};

// ---- Motion of axes of their own

/// MC_MoveAbsolute.
struct MoveAbsoluteJob {
  LREAL position{};  ///< [u]
  Direction direction{};
};

/// MC_MoveRelative, MC_MoveSuperimposed.
struct DistanceJob {
  LREAL distance{};  ///< [u]
};

/// MC_MoveVelocity, whose velocity has the sign of its direction.
struct VelocityJob {
  bool current = false;  ///< keep the present velocity
};

/// MC_MoveJog, whose inputs count in every cycle.
struct JogJob {
  int direction{};  ///< 1, -1; 0: it brakes
};

/// MC_Halt, MC_Stop, MC_HaltSuperimposed.
struct StopJob {
  StopMode mode = StopMode::given_dynamics;  ///< MC_Stop
  bool abort_acceleration = false;           ///< drop a present acceleration at once
  bool hold = false;  ///< MC_Stop: Execute is still TRUE, so the axis stays locked after the stop
};

/// MC_MotionInVelocity, MC_MotionInPosition, MC_MotionInSuperimposed, whose values are setpoints and count in
/// every cycle.
struct MotionInJob {
  LREAL position{};               ///< MC_MotionInSuperimposed: the distance [u]
  LREAL velocity{};               ///< [u/s]
  LREAL acceleration{};           ///< [u/s²]
  bool hold = true;               ///< Enable is still TRUE
  ErrorId error = ErrorId::none;  ///< of an input of this call that is not permitted
};

// ---- Synchronous operation of axes

/// MC_GearIn, MC_GearInVelocity, MC_GearInPos.
struct GearJob {
  LeadingObject* master = nullptr;
  DINT numerator = 1;
  DINT denominator = 1;
  bool update = false;  ///< MC_GearInVelocity: the ratio counts in every cycle

  // MC_GearInPos.
  SyncProfileReference profile{};
  PublishedDirection direction = PublishedDirection::either;
  LREAL master_sync_position{};   ///< [u] of the leading axis
  LREAL slave_sync_position{};    ///< [u]
  LREAL master_start_distance{};  ///< [u] of the leading axis
};

/// MC_CamIn.
struct CamJob {
  LeadingObject* master = nullptr;
  Cam* cam = nullptr;
  SyncProfileReference profile{};
  CamApplicationMode application_mode{};
  PublishedDirection direction = PublishedDirection::either;
  LREAL master_offset{};  ///< of the cam [u] of the leading axis
  LREAL slave_offset{};   ///< of the cam [u]
  LREAL master_scaling = 1.0;
  LREAL slave_scaling = 1.0;
  LREAL master_sync_position{};   ///< from the start of the cam [u] of the leading axis
  LREAL master_start_distance{};  ///< [u] of the leading axis

  // Written by the axis.
  UDINT ends{};                 ///< ends of the cam reached so far
  bool end_of_profile = false;  ///< the job has ended at the end of its cam
};

/// MC_GearOut, MC_CamOut.
struct LeavingJob {
  LREAL position{};  ///< where the axis rests [u]
  SyncOutProfileReference profile{};
  PublishedDirection direction = PublishedDirection::either;
  LREAL master_stop_distance{};  ///< [u] of the leading axis
};

/// MC_PhasingAbsolute, MC_PhasingRelative, MC_OffsetAbsolute, MC_OffsetRelative.
struct ShiftJob {
  LeadingObject* master = nullptr;  ///< MC_Phasing…
  LREAL shift{};                    ///< [u], of a phase shift those of the leading axis
  ShiftProfileReference profile{};
  PublishedDirection direction = PublishedDirection::either;
  LREAL distance{};        ///< over which it is made [u] of the leading axis
  LREAL start_position{};  ///< from which it is made [u] of the leading axis

  // Written by the axis.
  LREAL covered{};      ///< share made so far [u]
  DoubleDouble base{};  ///< from which that share counts [u]
};

// ---- Of measuring inputs

/// What a measuring job has measured: first and second values.
struct MeasuredEdges {
  LREAL value[2]{};    ///< [u]
  UDINT counter[2]{};  ///< of cyclic measuring, from 0
  UDINT lost[2]{};     ///< edges lost in the servo cycle of the value, 0 to 7
};

/// MC_MeasuringInput, MC_MeasuringInputCyclic.
struct MeasuringJob {
  MeasuringMode mode{};
  bool limited = false;    ///< only between these positions
  LREAL start_position{};  ///< [u]
  LREAL end_position{};    ///< [u]

  // Written by the object.
  MeasuredEdges measured{};
};

// ---- Of cams

/// MC_CopyCamData.
struct CamCopyJob {
  const CamCopy* copy = nullptr;  ///< what is copied; read when the job is handed over
};

}  // namespace lockstep
