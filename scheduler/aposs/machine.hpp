/// Walks a compiled APOSS program: so many internal commands a step, and goes on in the next one wherever it
/// was.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "scheduler/aposs/device.hpp"
#include "scheduler/aposs/frame.hpp"
#include "scheduler/aposs/image.hpp"
#include "scheduler/aposs/interrupts.hpp"
#include "scheduler/aposs/pid_filter.hpp"
#include "scheduler/aposs/print_queue.hpp"

namespace lockstep::aposs {

enum class ProgramState : std::uint8_t {
  kNone,     ///< nothing is loaded
  kRuns,     ///< the main program
  kWaits,    ///< for the end of a command or a time
  kHandler,  ///< a subprogram that an interrupt has called
  kEnded,    ///< came to its end, or EXIT
  kError,    ///< ended by an error without a handler
  kRefused   ///< ended by a command that the device cannot carry out: `line` says where
};

/// Counts of what went on.
struct MachineCounters {
  std::uint64_t commands = 0;  ///< internal commands
  std::uint64_t steps = 0;
  std::uint64_t starved = 0;            ///< steps whose budget was used up
  std::uint64_t divisions_by_zero = 0;  ///< whose result was 0
};

/// One program of one device. Thread: that of the cycle, but for `load`.
class Machine {
 public:
  /// @param time_interrupts how often ON TIME and ON PERIOD are looked at [ms]; at least 1
  explicit Machine(Device& device, Arrays& arrays, std::int32_t time_interrupts = 1)
      : device_(device), arrays_(arrays), time_interrupts_(time_interrupts < 1 ? 1 : time_interrupts) {}

  /// Takes a program over and makes it ready to run from its beginning. Allocates. The image has to outlive
  /// it.
  /// @return 0; 110, 196: the image is damaged or of another version; 170, 175: its arrays do not fit
  int load(const Image& image);
  /// Memory for programs of so many cells, so that their variables stay where they are. At load.
  void reserve(std::size_t cells) { cells_.assign(std::max(cells, cells_.size()), 0); }
  /// Another one that has been loaded before, from its beginning: nothing is allocated.
  void take(const Image& image) noexcept;
  /// Ends the program, as the user does. Nothing runs until it is started.
  void stop() noexcept;
  /// How often ON TIME and ON PERIOD are looked at [ms]; at least 1.
  void set_time_interrupts(std::int32_t milliseconds) noexcept {
    time_interrupts_ = milliseconds < 1 ? 1 : milliseconds;
  }
  /// A program that an error has ended goes on behind it; its errors are forgotten.
  /// @return false if no error has ended one
  bool go_on() noexcept;
  /// From the beginning, with all variables 0. Arrays stay.
  void start() noexcept;

  /// A step of 1 ms: sources of interrupts are compared, then at most `budget` internal commands carried out.
  void step(std::int32_t budget) noexcept;
  /// An error that stood before the program began: ERRNO tells it, and its handler is called once it is said.
  void take_standing(int error) noexcept {
    if (error_count_ < errors_.size()) errors_[error_count_++] = error;
  }
  /// Raises an error: the handler begins in the next step; without one the program ends.
  void raise(int error) noexcept;

  ProgramState state() const noexcept;
  bool over() const noexcept { return ended_ != ProgramState::kRuns; }
  /// Where the program is; its last command when it is over.
  Place place() const noexcept;
  /// Where the last error came up.
  Place error_place() const noexcept;
  /// The command for which it was refused.
  std::optional<Command> refused() const noexcept { return refused_; }
  /// ERRNO: 0, or the first error that has not been cleared.
  int error() const noexcept { return error_count_ == 0 ? 0 : errors_[0]; }
  /// Of a variable by its number.
  std::int32_t variable(std::size_t number) const noexcept { return cells_[number]; }
  /// Where that stands, as long as no program needs more cells than have been reserved.
  std::int32_t* variable_address(std::size_t number) noexcept { return &cells_[number]; }

  const MachineCounters& counters() const noexcept { return counters_; }
  PrintQueue& prints() noexcept { return prints_; }

 private:
  enum class Flow : std::uint8_t { kOn, kStop };
  /// What a level waits for.
  struct Wait {
    enum class Kind : std::uint8_t { kNone, kUntil, kInput, kCommand };
    Kind kind = Kind::kNone;
    bool restarts = false;   ///< WAITT: from its beginning behind an interrupt
    std::int64_t begin = 0;  ///< [ms]
    std::int64_t until = 0;  ///< [ms]
  };
  /// Main program, interrupt, error handler.
  struct Level {
    enum class Kind : std::uint8_t { kMain, kInterrupt, kError };
    Kind kind = Kind::kMain;
    std::uint16_t instruction = 0;  ///< where it goes on
    bool no_wait = false;
    bool all_disabled = false;  ///< before it began
    bool left = false;          ///< its own subprogram, by GOTO
    Wait wait;
    Stack stack;
  };

  Level& level() noexcept { return levels_[depth_]; }
  std::int32_t* temporaries() noexcept { return cells_.data() + first_temporary_; }

  void run(std::int32_t budget) noexcept;
  Flow special(const Instruction& at) noexcept;
  Flow interrupt_command(const Instruction& at) noexcept;
  Flow begin_command(const Instruction& at) noexcept;
  Flow finish_command(const Instruction& at, const Reply& reply) noexcept;
  bool sound_arguments(const CommandRow& row, const std::int32_t* arguments) const noexcept;
  Flow begin_wait(const Instruction& at) noexcept;
  bool wait_is_over() noexcept;
  void end_wait() noexcept;
  Flow go_back() noexcept;
  void print(const Instruction& at) noexcept;
  Flow failed(int error) noexcept;

  void dispatch() noexcept;
  void enter(Level::Kind kind, std::uint16_t entry) noexcept;
  void interrupted(Level& whom, Level::Kind by) noexcept;
  void leave_level() noexcept;
  void finish(ProgramState how) noexcept;

  Device& device_;
  Arrays& arrays_;
  std::int32_t time_interrupts_;
  const Image* image_ = nullptr;
  std::vector<std::int32_t> cells_;
  std::size_t first_temporary_ = 0, temporaries_count_ = 0;
  std::vector<std::int32_t> kept_temporaries_;  ///< of the levels below
  std::array<Level, 3> levels_{};
  std::size_t depth_ = 0;
  Interrupts interrupts_;
  PidFilter pid_;
  PrintQueue prints_;
  bool printing_ = true;
  std::uint16_t culprit_ = 0;   ///< the instruction that is carried out
  std::uint16_t error_at_ = 0;  ///< that of the last error
  std::array<int, 8> errors_{};
  std::size_t error_count_ = 0;
  std::optional<std::uint16_t> error_handler_;
  std::optional<Command> refused_;
  ProgramState ended_ = ProgramState::kNone;
  std::int64_t now_ = 0;
  bool looks_at_times_ = true;
  MachineCounters counters_;
};

}  // namespace lockstep::aposs
