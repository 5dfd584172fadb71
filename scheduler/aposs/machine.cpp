#include "scheduler/aposs/machine.hpp"

#include <algorithm>

#include "scheduler/aposs/arithmetic.hpp"

namespace lockstep::aposs {
namespace {

enum MachineError : int {
  kTooManyLoops = 114,
  kTooManyGosubs = 151,
  kTooManyReturns = 152,
  kArrayBound = 171,
  kUnknownCommand = 110
};

}  // namespace

int Machine::load(const Image& image) {
  ended_ = ProgramState::kNone;
  image_ = nullptr;
  if (const int fault = image.fault(); fault != 0) return fault;
  if (const int error = arrays_.fit(image.arrays); error != 0) return error;
  take(image);
  return 0;
}

void Machine::take(const Image& image) noexcept {
  image_ = &image;
  first_temporary_ = image.variables.size();
  temporaries_count_ = image.temporaries;
  cells_.assign(image.cells(), 0);
  std::copy(image.constants.begin(), image.constants.end(),
            cells_.begin() + static_cast<std::ptrdiff_t>(image.writable_cells()));
  kept_temporaries_.assign(temporaries_count_ * levels_.size(), 0);
  start();
}

void Machine::stop() noexcept {
  if (!over()) finish(ProgramState::kEnded);
}

bool Machine::go_on() noexcept {
  if (image_ == nullptr || ended_ != ProgramState::kError) return false;
  error_count_ = 0;
  ended_ = ProgramState::kRuns;
  return true;
}

void Machine::start() noexcept {
  if (image_ == nullptr) return;
  std::fill_n(cells_.begin(), image_->writable_cells(), 0);
  depth_ = 0;
  Level& main = level();
  main.kind = Level::Kind::kMain;
  main.instruction = 0;
  main.no_wait = main.all_disabled = main.left = false;
  main.wait = {};
  main.stack.clear();
  interrupts_.clear();
  pid_.clear();
  printing_ = true;
  error_count_ = 0;
  error_handler_.reset();
  refused_.reset();
  counters_ = {};
  culprit_ = error_at_ = 0;
  ended_ = ProgramState::kRuns;
}

ProgramState Machine::state() const noexcept {
  if (over()) return ended_;
  if (levels_[depth_].wait.kind != Wait::Kind::kNone) return ProgramState::kWaits;
  return depth_ == 0 ? ProgramState::kRuns : ProgramState::kHandler;
}

Place Machine::place() const noexcept {
  return image_ == nullptr ? Place{} : image_->places[levels_[depth_].instruction];
}

Place Machine::error_place() const noexcept {
  return image_ == nullptr ? Place{} : image_->places[error_at_];
}

void Machine::step(std::int32_t budget) noexcept {
  if (over()) return;
  ++counters_.steps;
  now_ = device_.milliseconds();
  looks_at_times_ = now_ % time_interrupts_ == 0;
  interrupts_.compare(device_);
  culprit_ = level().instruction;
  if (const int error = device_.take_error(); error != 0) raise(error);
  if (over()) return;
  dispatch();
  if (level().wait.kind != Wait::Kind::kNone && !wait_is_over()) return;
  if (!over() && level().wait.kind == Wait::Kind::kNone) run(budget);
}

// What is carried out most stands here; everything else is `special`.
void Machine::run(std::int32_t budget) noexcept {
  const Instruction* const code = image_->code.data();
  std::int32_t* const cells = cells_.data();
  std::int32_t left = budget;
  std::uint32_t next = level().instruction;
  while (left > 0) {
    const Instruction at = code[next];
    --left;
    ++next;
    switch (at.operation) {
      case Operation::kMove:
        cells[at.a] = cells[at.b];
        break;
      case Operation::kAdd:
        cells[at.a] = sum(cells[at.b], cells[at.c]);
        break;
      case Operation::kSubtract:
        cells[at.a] = difference(cells[at.b], cells[at.c]);
        break;
      case Operation::kMultiply:
        cells[at.a] = product(cells[at.b], cells[at.c]);
        break;
      case Operation::kDivide:
        counters_.divisions_by_zero += cells[at.c] == 0 ? 1 : 0;
        cells[at.a] = quotient(cells[at.b], cells[at.c]);
        break;
      case Operation::kRemainder:
        counters_.divisions_by_zero += cells[at.c] == 0 ? 1 : 0;
        cells[at.a] = remainder(cells[at.b], cells[at.c]);
        break;
      case Operation::kDivideRounded:
        counters_.divisions_by_zero += cells[at.c] == 0 ? 1 : 0;
        cells[at.a] = rounded_quotient(cells[at.b], cells[at.c]);
        break;
      case Operation::kAnd:
        cells[at.a] = cells[at.b] & cells[at.c];
        break;
      case Operation::kOr:
        cells[at.a] = cells[at.b] | cells[at.c];
        break;
      case Operation::kExclusiveOr:
        cells[at.a] = cells[at.b] ^ cells[at.c];
        break;
      case Operation::kShiftLeft:
        cells[at.a] = shifted_left(cells[at.b], cells[at.c]);
        break;
      case Operation::kShiftRight:
        cells[at.a] = shifted_right(cells[at.b], cells[at.c]);
        break;
      case Operation::kLess:
        cells[at.a] = cells[at.b] < cells[at.c] ? 1 : 0;
        break;
      case Operation::kGreater:
        cells[at.a] = cells[at.b] > cells[at.c] ? 1 : 0;
        break;
      case Operation::kLessOrEqual:
        cells[at.a] = cells[at.b] <= cells[at.c] ? 1 : 0;
        break;
      case Operation::kGreaterOrEqual:
        cells[at.a] = cells[at.b] >= cells[at.c] ? 1 : 0;
        break;
      case Operation::kEqual:
        cells[at.a] = cells[at.b] == cells[at.c] ? 1 : 0;
        break;
      case Operation::kUnequal:
        cells[at.a] = cells[at.b] != cells[at.c] ? 1 : 0;
        break;
      case Operation::kBothTrue:
        cells[at.a] = cells[at.b] != 0 && cells[at.c] != 0 ? 1 : 0;
        break;
      case Operation::kEitherTrue:
        cells[at.a] = cells[at.b] != 0 || cells[at.c] != 0 ? 1 : 0;
        break;
      case Operation::kNegate:
        cells[at.a] = negative(cells[at.b]);
        break;
      case Operation::kInvert:
        cells[at.a] = ~cells[at.b];
        break;
      case Operation::kNot:
        cells[at.a] = cells[at.b] == 0 ? 1 : 0;
        break;
      case Operation::kAbsolute:
        cells[at.a] = absolute(cells[at.b]);
        break;
      case Operation::kBit:
        cells[at.a] = BitOf::of(cells[at.b], cells[at.c]);
        break;
      case Operation::kByte:
        cells[at.a] = ByteOf::of(cells[at.b], cells[at.c]);
        break;
      case Operation::kWord:
        cells[at.a] = WordOf::of(cells[at.b], cells[at.c]);
        break;
      case Operation::kPutBit:
        cells[at.a] = BitOf::with(cells[at.a], cells[at.b], cells[at.c]);
        break;
      case Operation::kPutByte:
        cells[at.a] = ByteOf::with(cells[at.a], cells[at.b], cells[at.c]);
        break;
      case Operation::kPutWord:
        cells[at.a] = WordOf::with(cells[at.a], cells[at.b], cells[at.c]);
        break;
      case Operation::kLoadElement: {
        const std::int32_t* const element = arrays_.element(at.b, cells[at.c]);
        cells[at.a] = element == nullptr ? 0 : *element;
        if (element != nullptr) break;
        level().instruction = static_cast<std::uint16_t>(next);
        culprit_ = static_cast<std::uint16_t>(next - 1);
        counters_.commands += static_cast<std::uint64_t>(budget - left);
        raise(kArrayBound);
        return;
      }
      case Operation::kStoreElement: {
        std::int32_t* const element = arrays_.element(at.a, cells[at.b]);
        if (element != nullptr) {
          *element = cells[at.c];
          break;
        }
        level().instruction = static_cast<std::uint16_t>(next);
        culprit_ = static_cast<std::uint16_t>(next - 1);
        counters_.commands += static_cast<std::uint64_t>(budget - left);
        raise(kArrayBound);
        return;
      }
      case Operation::kJump:
        next = at.a;
        break;
      case Operation::kJumpIfZero:
        if (cells[at.b] == 0) next = at.a;
        break;
      default:
        // `special` finds the instruction in its level and leaves there where to go on.
        level().instruction = static_cast<std::uint16_t>(next - 1);
        if (special(at) == Flow::kStop) {
          counters_.commands += static_cast<std::uint64_t>(budget - left);
          return;
        }
        next = level().instruction;
        break;
    }
  }
  level().instruction = static_cast<std::uint16_t>(next);
  counters_.commands += static_cast<std::uint64_t>(budget - left);
  if (budget > 0) ++counters_.starved;
}

Machine::Flow Machine::failed(int error) noexcept {
  raise(error);
  return Flow::kStop;
}

Machine::Flow Machine::special(const Instruction& at) noexcept {
  Level& here = level();
  const std::uint16_t self = here.instruction;
  culprit_ = self;
  std::int32_t* const cells = cells_.data();
  ++here.instruction;
  switch (at.operation) {
    case Operation::kEnd:
    case Operation::kExit:
      here.instruction = self;
      finish(ProgramState::kEnded);
      return Flow::kStop;
    case Operation::kRest:
      here.instruction = at.a;
      return Flow::kStop;
    case Operation::kRestIfZero:
      if (cells[at.b] != 0) return Flow::kOn;
      here.instruction = at.a;
      return Flow::kStop;
    case Operation::kLoop:
      switch (here.stack.turn(self, cells[at.b])) {
        case Stack::Turn::kAgain:
          here.instruction = at.a;
          return Flow::kOn;
        case Stack::Turn::kOver:
          return Flow::kOn;
        case Stack::Turn::kTooDeep:
          break;
      }
      return failed(kTooManyLoops);
    case Operation::kGosub:
      if (!here.stack.call(self)) return failed(kTooManyGosubs);
      here.instruction = at.a;
      return Flow::kOn;
    case Operation::kReturn:
      return go_back();
    case Operation::kLeave:
      here.left = !here.stack.forget(at.b != 0) || here.left;
      here.instruction = at.a;
      return Flow::kOn;
    case Operation::kTime:
      cells[at.a] = wrapped_position(now_);
      return Flow::kOn;
    case Operation::kErrorNumber:
      cells[at.a] = error();
      return Flow::kOn;
    case Operation::kClearError:
      if (error_count_ > 0) {
        std::copy(errors_.begin() + 1, errors_.end(), errors_.begin());
        --error_count_;
      }
      device_.error_cleared();
      return Flow::kOn;
    case Operation::kDeleteArrays:
      arrays_.forget();
      return Flow::kOn;
    case Operation::kDelay:
    case Operation::kWaitTime:
    case Operation::kWaitInput:
      here.instruction = self;
      return begin_wait(at);
    case Operation::kNoWait:
      here.no_wait = cells[at.a] != 0;
      return Flow::kOn;
    case Operation::kCommand:
      here.instruction = self;
      return begin_command(at);
    case Operation::kPrint:
      print(at);
      return Flow::kOn;
    case Operation::kPrintDevice:
      printing_ = cells[at.a] >= 0;
      return Flow::kOn;
    default:
      return interrupt_command(at);
  }
}

Machine::Flow Machine::interrupt_command(const Instruction& at) noexcept {
  const std::int32_t* const cells = cells_.data();
  int error = 0;
  switch (at.operation) {
    case Operation::kOnError:
      error_handler_ = at.a;
      break;
    case Operation::kOnInput:
      error = interrupts_.define_edge(EdgeSource::kInput, cells[at.a], at.b, device_);
      break;
    case Operation::kOnPosition:
      error = interrupts_.define_position(at.a, cells[at.b], at.c, device_);
      break;
    case Operation::kOnCombit:
      error = interrupts_.define_edge(EdgeSource::kCombit, cells[at.a], at.b, device_);
      break;
    case Operation::kOnStatbit:
      error = interrupts_.define_edge(EdgeSource::kStatbit, cells[at.a], at.b, device_);
      break;
    case Operation::kOnParameter:
      error = interrupts_.define_parameter(cells[at.a], at.b, device_);
      break;
    case Operation::kOnTime:
      error = interrupts_.define_time(cells[at.a], at.b, now_);
      break;
    case Operation::kOnPeriod:
      error = interrupts_.define_period(cells[at.a], at.b, now_);
      break;
    case Operation::kOnDelete:
      interrupts_.delete_positions(at.a);
      break;
    case Operation::kDisable:
      interrupts_.disable(static_cast<InterruptClass>(at.a));
      break;
    case Operation::kEnable:
      interrupts_.enable(static_cast<InterruptClass>(at.a));
      dispatch();  // what has been remembered runs now
      break;
    default:
      error = kUnknownCommand;
      break;
  }
  return error == 0 ? Flow::kOn : failed(error);
}

bool Machine::sound_arguments(const CommandRow& row, const std::int32_t* arguments) const noexcept {
  for (std::size_t i = 0; i < row.arity(); ++i) {
    const auto number = static_cast<std::uint32_t>(arguments[i]);
    if (row.arguments[i] == Argument::kText && number >= image_->texts.size()) return false;
    if (row.arguments[i] == Argument::kArray && number >= arrays_.count()) return false;
  }
  return true;
}

Machine::Flow Machine::begin_command(const Instruction& at) noexcept {
  const auto command = static_cast<Command>(at.a);
  const CommandRow& row = row_of(command);
  const std::int32_t* const arguments = cells_.data() + at.b;
  if (!sound_arguments(row, arguments)) return finish_command(at, Reply::failed(kArrayBound));
  if (command == Command::kPid) return finish_command(at, Reply::done(pid_.step(arguments[0])));
  if (command == Command::kSetPid) {
    pid_.set(arguments[0], arguments[1]);
    return finish_command(at, Reply::done());
  }
  const Reply reply = device_.begin(command, arguments, arrays_);
  const bool waits = row.waits == Waits::kAlways || (row.waits == Waits::kMotion && !level().no_wait);
  if (reply.kind == Reply::Kind::kBusy && waits) {
    level().wait = {Wait::Kind::kCommand, false, now_, 0};
    return Flow::kStop;
  }
  return finish_command(at, reply);
}

Machine::Flow Machine::finish_command(const Instruction& at, const Reply& reply) noexcept {
  level().wait = {};
  if (reply.kind == Reply::Kind::kRefused) {
    refused_ = static_cast<Command>(at.a);
    finish(ProgramState::kRefused);
    return Flow::kStop;
  }
  if (at.c != kNoCell) cells_[at.c] = reply.value;
  ++level().instruction;
  return reply.kind == Reply::Kind::kFailed ? failed(reply.error) : Flow::kOn;
}

Machine::Flow Machine::begin_wait(const Instruction& at) noexcept {
  Wait& wait = level().wait;
  if (at.operation == Operation::kWaitInput) {
    wait = {Wait::Kind::kInput, false, now_, 0};
  } else {
    wait = {Wait::Kind::kUntil, at.operation == Operation::kWaitTime, now_, now_ + cells_[at.a]};
  }
  return wait_is_over() ? Flow::kOn : Flow::kStop;
}

// Whether the level goes on; if so its wait is over and it stands behind the command.
bool Machine::wait_is_over() noexcept {
  culprit_ = level().instruction;
  const Instruction& at = image_->code[culprit_];
  const Wait& wait = level().wait;
  bool over = false;
  switch (wait.kind) {
    case Wait::Kind::kNone:
      return true;
    case Wait::Kind::kUntil:
      over = now_ >= wait.until;
      break;
    case Wait::Kind::kInput:
      over = device_.level(EdgeSource::kInput, cells_[at.a]) == (cells_[at.b] != 0);
      break;
    case Wait::Kind::kCommand: {
      const auto command = static_cast<Command>(at.a);
      const Reply reply = device_.proceed(command, cells_.data() + at.b, now_ - wait.begin);
      return reply.kind != Reply::Kind::kBusy && finish_command(at, reply) == Flow::kOn;
    }
  }
  if (over) end_wait();
  return over;
}

void Machine::end_wait() noexcept {
  level().wait = {};
  ++level().instruction;
}

void Machine::print(const Instruction& at) noexcept {
  const PrintList& list = image_->prints[at.a];
  if (!printing_) return;
  const std::int32_t* cell = cells_.data() + at.b;
  for (const PrintItem& item : list.items) switch (item.kind) {
      case PrintItem::Kind::kText:
        prints_.push({Printed::Kind::kText, item.text});
        break;
      case PrintItem::Kind::kNumber:
        prints_.push({Printed::Kind::kNumber, *cell++});
        break;
      case PrintItem::Kind::kCharacter:
        prints_.push({Printed::Kind::kCharacter, *cell++});
        break;
    }
  if (list.ends_line) prints_.end_line();
}

void Machine::raise(int error) noexcept {
  if (over()) return;
  error_at_ = culprit_;
  if (error_count_ < errors_.size()) errors_[error_count_++] = error;  // the others wait behind the first
  device_.error_raised(error);
  if (!error_handler_) finish(ProgramState::kError);
}

void Machine::finish(ProgramState how) noexcept {
  ended_ = how;
  prints_.flush();
}

// Calls the handler whose turn it is, if there is one that may run now.
void Machine::dispatch() noexcept {
  if (over()) return;
  if (error_count_ > 0 && error_handler_ && level().kind != Level::Kind::kError)
    return enter(Level::Kind::kError, *error_handler_);
  if (depth_ > 0) return;  // no handler is interrupted but by an error
  if (const auto entry = interrupts_.take(now_, looks_at_times_)) enter(Level::Kind::kInterrupt, *entry);
}

void Machine::interrupted(Level& whom, Level::Kind by) noexcept {
  if (whom.wait.restarts) whom.wait = {};
  if (whom.wait.kind != Wait::Kind::kCommand || by == Level::Kind::kError) return;
  const auto command = static_cast<Command>(image_->code[whom.instruction].a);
  if (!row_of(command).given_up) return;
  device_.give_up(command);
  end_wait();
}

void Machine::enter(Level::Kind kind, std::uint16_t entry) noexcept {
  interrupted(level(), kind);
  std::copy_n(temporaries(), temporaries_count_,
              kept_temporaries_.begin() + static_cast<std::ptrdiff_t>(depth_ * temporaries_count_));
  ++depth_;
  Level& handler = level();
  handler.kind = kind;
  handler.instruction = entry;
  handler.no_wait = true;
  handler.left = false;
  handler.all_disabled = interrupts_.disabled(InterruptClass::kAll);
  handler.wait = {};
  handler.stack.clear();
}

// The end of a handler.
void Machine::leave_level() noexcept {
  if (level().all_disabled)
    interrupts_.disable(InterruptClass::kAll);
  else
    interrupts_.enable(InterruptClass::kAll);
  --depth_;
  std::copy_n(kept_temporaries_.begin() + static_cast<std::ptrdiff_t>(depth_ * temporaries_count_),
              temporaries_count_, temporaries());
}

Machine::Flow Machine::go_back() noexcept {
  std::uint16_t caller = 0;
  if (level().stack.leave(caller)) {
    level().instruction = static_cast<std::uint16_t>(caller + 1);
    return Flow::kOn;
  }
  if (depth_ == 0 || level().left) return failed(kTooManyReturns);
  leave_level();
  dispatch();
  if (level().wait.kind == Wait::Kind::kNone) return Flow::kOn;
  return wait_is_over() ? Flow::kOn : Flow::kStop;
}

}  // namespace lockstep::aposs
