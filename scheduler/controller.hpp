/// The controller: technology objects, tags and programs of one project, and the cycle that runs them.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "fb/block.hpp"
#include "scheduler/crew.hpp"
#include "scheduler/events.hpp"
#include "scheduler/levels.hpp"
#include "scheduler/process_image.hpp"
#include "scheduler/program.hpp"
#include "scheduler/shown_count.hpp"
#include "scheduler/signal_tap.hpp"
#include "scheduler/telegram_ring.hpp"
#include "scheduler/text.hpp"
#include "scheduler/trace_ring.hpp"
#include "scheduler/watchdog.hpp"
#include "tech_objects/axis/axis.hpp"
#include "tech_objects/axis/coupling_order.hpp"
#include "tech_objects/cam_object/cam.hpp"
#include "tech_objects/cross_controller/leading_axis_proxy.hpp"
#include "tech_objects/data_blocks/array.hpp"
#include "tech_objects/jobs/encoder_saving.hpp"
#include "tech_objects/switching/switched_output.hpp"

namespace lockstep {

/// The two periods of motion control.
/// @source S7-1500T: MC_Servo [OB91], MC_Interpolator [OB92]
struct Clock {
  std::int64_t servo_cycle = 1'000'000;  ///< period of MC_Servo [ns]
  int interpolator_ratio = 1;  ///< MC_Interpolator runs on every so many executed servo ticks, 1 to 32
  int processors = 1;          ///< that a tick may use for the axes, 1 to `kMaximumProcessors`

  std::int64_t interpolator_cycle() const noexcept { return servo_cycle * interpolator_ratio; }  ///< [ns]

  static constexpr int kMaximumProcessors = 64;
};

/// A tag: a named value of the project.
struct Tag {
  std::string name;
  Type type = Type::BOOL;
  Value initial{};
  bool retain = false;
  std::string comment;
  Signal signal{};  ///< where it lives, set by `Controller::add_tag`
};

/// A named array of the project.
struct ArrayTag {
  std::string name;
  std::string comment;
  Array array;
  std::vector<std::uint64_t> memory;  ///< of the array, aligned for any element
};

/// A tag of type STRING[n].
struct StringTag {
  std::string name;
  std::string comment;
  bool retain = false;
  std::string initial;       ///< as the tag holds it
  std::vector<char> memory;  ///< of the text
  Text text{};               ///< set by `Controller::add_string`
};

/// An instance of a function block with its name.
struct Instance {
  std::string name;
  const BlockType* type = nullptr;
  std::unique_ptr<Block> block;
};

/// A change of a tag at a time of the simulation.
struct Stimulus {
  std::int64_t at = 0;  ///< [ns]
  Signal place;
  Value value{};
};

/// What a run has counted. Written by the cycle, read after the run or through signals.
struct CycleCounters {
  std::uint64_t ticks = 0;               ///< servo ticks executed
  std::uint64_t interpolator_ticks = 0;  ///< interpolator ticks executed
  std::uint64_t missed_ticks = 0;        ///< ticks of the grid that were left out
  std::uint64_t overruns = 0;            ///< interpolator cycles that were not over in time
  std::uint64_t alarms = 0;              ///< axes with an alarm, now
  EvaluationCounters evaluation;         ///< of all expressions
};

/// The alarm that has come last, of all objects, for panels. Written by the cycle.
struct NewestAlarm {
  std::uint64_t count = 0;    ///< alarms since the start of the run
  std::uint64_t number = 0;   ///< 0: none has come yet
  std::uint64_t object = 0;   ///< number of the object, from 1, in the order of `technology_objects`
  std::uint64_t cause = 0;    ///< AlarmCause
  std::uint64_t address = 0;  ///< number of the sensor, or of another object that it concerns
  std::uint64_t tick = 0;     ///< number of the servo tick
  std::int64_t time = 0;      ///< [ns] since the start of the run
  std::int64_t clock = 0;     ///< [µs] wall clock, since 1970-01-01 UTC; in virtual time since the start
  double value = 0.0;         ///< measured, in the unit of the alarm; 0: not known
  double limit = 0.0;         ///< what it was held against; 0: not known
};

/// A leading object whose telegrams go to other controllers by one of its transfer areas.
struct TelegramOutput {
  const LeadingObject* source = nullptr;
  TelegramRing* ring = nullptr;
};

/// A proxy and the telegrams that come for it.
struct TelegramInput {
  LeadingAxisProxy* proxy = nullptr;
  TelegramRing* ring = nullptr;
};

/// How an axis stood when its run ended, for the summary.
struct AxisSummary {
  DWORD status_word{};
  DINT function_state{};      ///< StatusSynchronizedMotion.FunctionState
  UDINT alarm{};              ///< ErrorDetail.Number
  LREAL position{};           ///< [u]; of a speed axis, which has none, its velocity
  LREAL largest_deviation{};  ///< largest distance from the synchronous function while synchronous [u]
};

/// Built at load time through its public lists and `add_…`; after `finish` only `tick` touches it, in the
/// thread of the cycle.
class Controller {
 public:
  Clock clock;
  std::vector<std::unique_ptr<TechnologyObject>> objects;  ///< in the order of `technology_objects`
  std::vector<Axis*> axes;                                 ///< those of them that are axes, in this order
  std::deque<Tag> tags;
  std::deque<ArrayTag> arrays;
  std::deque<StringTag> strings;
  std::deque<Instance> instances;
  std::deque<Program> programs;
  EncoderSaving encoder_saving;  ///< what programs ask to be kept at once
  std::vector<Stimulus> stimuli;
  bool apply_stimuli = false;
  std::vector<Watchdog> watchdogs;               ///< of those who have to give signs of life, such as panels
  std::vector<ProcessImage*> images;             ///< crossings to Modbus and to the display of a run
  TraceRing* trace = nullptr;                    ///< crossing to the recorder; nullptr: none
  SignalTap* tap = nullptr;                      ///< crossing of signals chosen while it runs; nullptr: none
  std::vector<TelegramOutput> telegram_outputs;  ///< crossings to other controllers
  std::vector<TelegramInput> telegram_inputs;    ///< crossings from other controllers
  std::vector<ShownCount> shown_counts;          ///< of threads that carry something, in tags
  /// [ns] What the clock that all controllers share shows when the time of this one is 0.
  std::int64_t shared_time_at_start = 0;

  std::int64_t epoch = 0;        ///< wall clock at the start of the run [µs] since 1970; 0: virtual time
  EventQueue* events = nullptr;  ///< crossing of alarms, jobs and overruns; nullptr: none
  /// Has jobs told as well, which costs a look at each instance in every tick. After all instances.
  void tell_jobs(JobsTold told = JobsTold::all);

  Tag& add_tag(Tag tag);
  /// An array tag whose elements are 0. `array.memory` is set here.
  ArrayTag& add_array(std::string name, Array array);
  /// A tag of type STRING[capacity] with its initial text; its memory is made here.
  StringTag& add_string(StringTag tag, std::size_t capacity);
  /// Adds an object of any kind; its number is its index among all.
  TechnologyObject& add_object(ObjectKind kind, std::string name);
  Axis& add_axis(ObjectKind kind, std::string name);
  Instance& add_instance(const BlockType& type, std::string name);

  /// Call once when all is loaded: sorts programs and stimuli and readies the axes for the clock.
  void finish();

  /// Has ticks use `clock.processors` processors, but no more than there are, by starting threads that help
  /// with the axes; nothing if that is 1, or if there are too few axes to gain by it. The bits of what is
  /// computed stay the same. Between two ticks, after `finish`.
  /// @param there processors of the machine
  /// @throws std::system_error if a thread cannot be started
  void employ_processors(int there);
  /// The threads that help, to give them a priority; none without them.
  std::vector<pthread_t> helping_threads();

  /// One servo tick, run to completion. Nothing in it allocates, locks, blocks or throws.
  void tick() noexcept;

  /// Leaves ticks out that the wall clock has passed: time goes on, motion does not. Programs that were due
  /// in them run in the next tick; the interpolator runs after as many executed ticks as ever, so that
  /// setpoint, fine interpolation, position control and simulated drives pass the same time.
  void skip(std::int64_t ticks) noexcept;

  /// Whether the next tick is one of the interpolator.
  bool interpolator_is_due() const noexcept {
    return counters_.ticks % static_cast<std::uint64_t>(clock.interpolator_ratio) == 0;
  }

  bool has_cams() const noexcept { return !cams_.empty(); }
  /// Whether another thread calls `interpolate_cams`; if not, as at first, a tick does it itself. Between two
  /// ticks.
  void interpolate_cams_elsewhere(bool elsewhere) noexcept;
  /// Makes the curves that are wanted by MC_InterpolateCam; false if none is. Some milliseconds for 10,000
  /// points. One thread at a time, while `tick` goes on in its own.
  bool interpolate_cams() noexcept;

  /// Time of the next tick [ns]: its number times the servo cycle.
  std::int64_t now() const noexcept { return next_tick_ * clock.servo_cycle; }
  const CycleCounters& counters() const noexcept { return counters_; }
  const NewestAlarm& newest_alarm() const noexcept { return newest_alarm_; }
  /// Where a part of it lives, for snapshots. @param type of the part
  template <class Part>
  Signal newest_alarm(Part NewestAlarm::*part, Type type) noexcept {
    return {&(newest_alarm_.*part), type, -1};
  }
  /// Where a counter lives, for snapshots, which read it and never write.
  Signal counter(std::uint64_t CycleCounters::*member) noexcept {
    return {&(counters_.*member), Type::ULINT, -1};
  }
  /// Notes that an interpolator cycle was not over in time. Thread: the cycle.
  void count_overrun() noexcept;

  /// Brings every axis to rest with maximum dynamics and then off, as at the end of a run; whether all are at
  /// rest is told by `at_rest`. Programs no longer run.
  void shut_down() noexcept;
  bool at_rest() const noexcept;

  /// Notes how the axes stand; `shut_down` does so as well.
  void take_summary() noexcept;
  const std::vector<AxisSummary>& summary() const noexcept { return summary_; }

 private:
  using Part = std::vector<TechnologyObject*>;  // the objects that take part in a phase, in their order

  void take_inputs(std::int64_t now) noexcept;
  void run_programs(Ob ob, std::int64_t now) noexcept;
  void run_due_programs(std::int64_t now) noexcept;
  bool due(std::int64_t cycle, std::int64_t now) const noexcept;
  void servo(std::int64_t now) noexcept;
  void assign_parts();
  void order_due_programs();
  void wire_outputs();
  void lay_objects_into_large_pages() const;
  void interpolate() noexcept;
  bool start_jobs() noexcept;
  void serve_drives() noexcept;
  void step_axes() noexcept;
  void step_level(std::span<Axis* const> axes) noexcept;
  void step_axes_in_turn(std::span<Axis* const> axes) noexcept;
  void send_telegrams() noexcept;
  void rebuild_order() noexcept;
  void tell_events(std::int64_t now) noexcept;
  void tell(Event event, std::int64_t now) noexcept;
  void tell_job(const JobWatch& watch, EventKind kind, int number, std::int64_t now) noexcept;
  void note_newest(const AlarmNote& note, std::size_t object, std::int64_t now) noexcept;
  void tell_notes(TechnologyObject& object, std::int64_t now) noexcept;
  void fetch_rows() const noexcept;
  void show(std::int64_t now, bool interpolator_tick) noexcept;

  /// Axes of a level from which on it is shared: below, one processor is done before another has come.
  static constexpr std::size_t kWorthSharing = 2 * Crew::kPortion;

  std::deque<Value> tag_memory_;
  /// What runs when its time has come: a program of the project, or that of an object.
  struct Due {
    const Program* program = nullptr;
    TechnologyObject* object = nullptr;
  };

  std::vector<Program*> schedule_;  // sorted by organization block, then priority
  std::vector<Due> due_;            // of Cyclic and Main, in their order, with those of objects
  std::vector<Axis*> driven_;       // axes with a drive, which come first in MC_Servo
  Part servo_;                      // the others
  Part before_axes_;
  Part behind_axes_;
  Part with_programs_;
  std::vector<LeadingObject*> providing_;  // for other controllers, or behind a delay
  std::vector<LeadingObject*> sources_;    // that lead axes and are none
  std::vector<Cam*> cams_;
  bool cams_interpolated_elsewhere_ = false;
  std::vector<SwitchedOutput> outputs_;  // that cams switch
  std::vector<JobWatch> job_watches_;    // none unless jobs are told
  JobsTold jobs_told_{};
  CouplingOrder order_;
  Levels levels_;                                  // of that order, where a crew steps the axes
  std::unique_ptr<Crew> crew_;                     // none where one processor steps them
  std::atomic<std::uint64_t> alarms_now_{0};       // counted by whoever steps an axis
  std::atomic<bool> attention_{true};              // some axis has new jobs or another coupling
  std::unique_ptr<CamInterpolator> interpolator_;  // for the largest cam; none without cams
  alignas(kCacheLine) RowAhead trace_row_;         // of the next interpolator tick, as the one of the tap
  RowAhead tap_row_;
  std::size_t next_stimulus_ = 0;
  std::int64_t next_tick_ = 0;
  std::int64_t last_time_ = -1;    // of the last executed tick [ns]; -1: none yet
  std::int64_t last_missed_ = -1;  // of the tick after those missed last [ns]; -1: none was
  bool shutting_down_ = false;
  CycleCounters counters_;
  NewestAlarm newest_alarm_;
  std::vector<AxisSummary> summary_;  // of the axes
};

}  // namespace lockstep
