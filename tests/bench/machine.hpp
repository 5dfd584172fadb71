/// Machines to measure: projects of many equal axes, loaded as a user's project is.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "projects/loader/project.hpp"
#include "scheduler/trace_ring.hpp"

namespace lockstep::bench {

/// What the axes do while they are measured.
enum class Motion {
  gear,         ///< follow one leading axis: MC_Power and MC_GearIn each, called in every cycle
  shifted,      ///< the same while a phase shift is in effect and an offset runs: MC_PhasingRelative and
                ///< MC_OffsetRelative as well, which exclude each other while they move
  cam,          ///< follow one leading axis on one cam: MC_Power and MC_CamIn each
  positioning,  ///< move back and forth: MC_Power and two MC_MoveRelative each, called in every cycle
  idle          ///< enabled and standing: MC_Power each, called in every cycle
};
std::string_view name_of(Motion motion);

struct MachinePlan {
  Motion motion = Motion::gear;
  int axes = 1;         ///< the leading axis of a gear is not counted, though its work is measured
  bool drives = false;  ///< simulated drives under position control; else virtual axes
  int ratio = 1;        ///< servo ticks per interpolator cycle
  int signals = 0;      ///< traced, by turns: position, velocity, actual position, bit of the status word
  int processors = 1;   ///< that a tick uses
  int cam_points = 10'000;

  std::string name() const;  ///< such as "gear 128 virtual 1:1 8 signals"
};

/// The project file of a machine. Every other axis is a modulo axis; no two gear ratios next to each other
/// are alike, and no two axes that position move equally far.
std::string project_text(const MachinePlan& plan);

/// A machine that runs as its plan says.
class Machine {
 public:
  /// Loads the project and runs it until all axes do what they are to do.
  /// @throws std::runtime_error if they do not
  explicit Machine(const MachinePlan& plan);

  /// That many interpolator cycles; of a trace all rows are dropped as if they were recorded.
  void run(int cycles);
  const MachinePlan& plan() const { return plan_; }

 private:
  void check() const;

  MachinePlan plan_;
  Project project_;
  std::unique_ptr<TraceRing> trace_;
};

}  // namespace lockstep::bench
