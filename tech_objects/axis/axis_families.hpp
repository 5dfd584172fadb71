/// What is done with the parts of an axis, family by family.
#pragma once

#include <string>

#include "tech_objects/axis/arrival_orders.hpp"
#include "tech_objects/axis/axis_parts.hpp"
#include "tech_objects/axis/buffer.hpp"
#include "tech_objects/axis/desynchronizing.hpp"
#include "tech_objects/axis/direct_homing.hpp"
#include "tech_objects/axis/emergency.hpp"
#include "tech_objects/axis/homing.hpp"
#include "tech_objects/axis/job_checks.hpp"
#include "tech_objects/axis/monitoring.hpp"
#include "tech_objects/axis/motion_in.hpp"
#include "tech_objects/axis/position_range.hpp"
#include "tech_objects/axis/servo.hpp"
#include "tech_objects/axis/simulation.hpp"
#include "tech_objects/axis/superimposed.hpp"
#include "tech_objects/axis/synchronous.hpp"
#include "tech_objects/axis/torque.hpp"

namespace lockstep {

/// Each family is given the parts that it may touch, and families above it in this list; none below. So no
/// calls go in a circle: what alarms act on stands above `reactions_`, and what raises them below.
class AxisFamilies : public AxisParts {
 protected:
  AxisFamilies(ObjectKind object_kind, std::string object_name, DB_ANY object_number);

  // What ends and stops an axis, and tells nobody.
  SwitchOrders switches_;
  HandOverOrders hand_over_;
  DriveControl drive_control_;
  SensorOrders sensors_;
  JobEnds ends_;
  AxisCoupling coupling_;
  StopOrders stops_;
  PositionControlOrders position_control_;
  PowerOrders power_;

  // Alarms.
  Reactions reactions_;

  // Motion of its own.
  JobDynamics dynamics_;
  JunctionOrders junction_;
  MotionOrders motion_orders_;
  ArrivalOrders arrivals_;
  BufferOrders buffer_;
  GivenOrders given_;
  SuperimposedOrders superimposed_orders_;

  // Homing.
  PositionNames names_;
  DirectHoming direct_homing_;
  HomingOrders homing_orders_;

  // Motion led by another axis.
  FollowingOrders following_;
  ShiftOrders shifting_;
  LeavingOrders leaving_;
  SimulationOrders simulation_;

  // What is watched over.
  LimitOrders limit_orders_;
  RangeOrders range_;

  // The drive.
  EmergencyOrders emergency_;
  TorqueOrders torque_;
  DriveFaults faults_;
  ServoOrders servo_;

  // Whether a job may start.
  JobChecks checks_;
};

}  // namespace lockstep
