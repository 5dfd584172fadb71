/// What the instructions of a family ask for, and what the object that carries them out tells of them: one
/// plain struct per family. What all jobs have stands in `Job`.
#pragma once

#include "tech_objects/jobs/modes.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

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
