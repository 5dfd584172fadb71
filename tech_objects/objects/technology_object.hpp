/// What every technology object has: a kind, a name, a number and a data block.
#pragma once

#include <climits>
#include <cstdint>
#include <string>
#include <utility>

#include "tech_objects/alarms/notes.hpp"
#include "tech_objects/types/object_kind.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

struct Job;

/// A phase of a tick in which an object may take part. Between the two of the interpolator the axes are
/// stepped, in the order of their couplings; programs of objects run among the Cyclic ones of the project.
enum class Phase : std::uint8_t { servo, before_axes, behind_axes, programs };

/// An output that an object switches.
struct SwitchedBy {
  const BOOL* state = nullptr;    ///< what it has the output be; nullptr: it switches none
  const BOOL* address = nullptr;  ///< tag of the output
  bool all = false;               ///< with others of the same output: AND, else OR
};

/// What an object with programs of its own has to tell.
struct ProgramNote {
  bool printed = false;  ///< a line, which `take_line` has; else an error
  int error = 0;         ///< 0: a command that is not there
  int program = -1;      ///< number of the program; -1: none
  int line = 0;          ///< of the program
};

/// Base of the technology objects, each of which derives from it alone: a pin holds the address of either.
class TechnologyObject {
 public:
  TechnologyObject(ObjectKind object_kind, std::string object_name, DB_ANY object_number)
      : kind(object_kind), name(std::move(object_name)), number(object_number) {}
  virtual ~TechnologyObject() = default;
  TechnologyObject(const TechnologyObject&) = delete;
  TechnologyObject& operator=(const TechnologyObject&) = delete;

  /// Address of the technology data block, whose variables `data_block_of` the kind declares.
  virtual void* data_block() noexcept = 0;
  /// Address of the start values, a data block like it: what a restart by MC_Reset takes over. They are those
  /// of the project until a program changes them.
  virtual void* start_values() noexcept = 0;
  /// Whether start values have been changed since the last restart: OnlineStartValuesChanged.
  BOOL start_values_changed{};

  /// Hands a job over; it is started at the object's next step. The job stays where it is until it has ended.
  /// An object without jobs has nothing to acknowledge: MC_Reset is done, everything else fails. Thread: the
  /// cycle.
  virtual void submit(Job& job) noexcept;

  /// Takes over the start values. Call once, after the data block is set and before the first tick.
  /// @param servo_period period of MC_Servo [s]  @param ratio servo ticks per interpolator tick, 1 to 32
  virtual void configure(double servo_period, int ratio) = 0;

  // What the cycle asks of it, besides an axis's own motion.

  /// Whether it takes part in a phase. Asked once, after `configure`.
  virtual bool takes_part(Phase) const noexcept { return false; }
  /// Its part of MC_Servo. @param now time of the tick [ns]
  virtual void servo([[maybe_unused]] std::int64_t now) noexcept {}
  /// Its parts of MC_Interpolator.
  virtual void before_axes() noexcept {}
  virtual void behind_axes() noexcept {}
  /// Its own program, before those of Main. @param now time of the tick [ns]
  virtual void run_program([[maybe_unused]] std::int64_t now) noexcept {}
  /// Where that is among the Cyclic programs: before those of this priority or a lower one. Asked once, after
  /// `configure`.
  virtual int program_priority() const noexcept { return INT_MAX; }
  /// What has come up since it was asked last; false: nothing. Thread: the cycle.
  virtual bool take_note(ProgramNote&) noexcept { return false; }
  /// The next printed line, once for each note of one. Thread: whoever tells events.
  virtual void take_line(std::string&) {}
  /// The run comes to its end: it comes to rest, and no program of its own runs any more. Of an object that
  /// is no axis.
  virtual void shut_down() noexcept {}
  virtual bool at_rest() const noexcept { return true; }
  /// Servo ticks that the wall clock has passed have been left out.
  virtual void skip([[maybe_unused]] std::int64_t ticks) noexcept {}
  /// Load time, after `configure`.
  virtual SwitchedBy switches() const noexcept { return {}; }

  const ObjectKind kind;
  const std::string name;  ///< as in the project
  const DB_ANY number;     ///< position in `technology_objects`, from 1

  /// Alarms that have come and gone, for the list of alarms; the cycle collects them.
  AlarmNotes alarm_notes;
};

}  // namespace lockstep
