#include "scheduler/mco305/mco305.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "scheduler/aposs/printed_line.hpp"

namespace lockstep {

Mco305::Mco305(std::string object_name, DB_ANY object_number)
    : TechnologyObject(ObjectKind::MCO_305, std::move(object_name), object_number) {}

/// May allocate: the first start of each program fits its arrays.
void Mco305::configure(double servo_period, int) {
  device_.configure(settings, servo_period);
  machine_.set_time_interrupts(time_interrupts);
  share_texts();
  for (DeviceProgram& program : programs) {
    program.fault = machine_.load(program.image);
    machine_.stop();
  }
  const auto first =
      std::find_if(programs.begin(), programs.end(), [](const DeviceProgram& p) { return p.autostart; });
  data.Parameters = device_.parameters().all();
  choosing_ = first != programs.end();
  if (choosing_) start(*first);
  show();
}

/// One list of texts for all programs, so that a printed line is read right whichever runs by then.
void Mco305::share_texts() {
  for (DeviceProgram& program : programs) {
    const auto offset = static_cast<std::uint16_t>(texts_.size());
    texts_.insert(texts_.end(), program.image.texts.begin(), program.image.texts.end());
    for (aposs::PrintList& list : program.image.prints)
      for (aposs::PrintItem& item : list.items) item.text = static_cast<std::uint16_t>(item.text + offset);
  }
  for (DeviceProgram& program : programs) program.image.texts = texts_;
}

bool Mco305::take_note(ProgramNote& note) noexcept {
  lines_ += machine_.prints().take_line_count();
  note = {lines_ > 0, 0, current_ == nullptr ? -1 : current_->number, 0};
  if (lines_ > 0) {
    --lines_;
    return true;
  }
  note.error = commands_.take_raised();
  const bool refused = machine_.state() == aposs::ProgramState::kRefused && !told_refusal_;
  if (note.error == 0 && !refused) return false;
  if (note.error == 0) told_refusal_ = true;
  const aposs::Place place = note.error == 0 ? machine_.place() : machine_.error_place();
  note.line = static_cast<int>(place.line);
  return true;
}

void Mco305::take_line(std::string& line) {
  aposs::Printed item;
  while (machine_.prints().take(item))
    if (aposs::append_printed(line, texts_, item)) return;
}

void Mco305::start(const DeviceProgram& program) noexcept {
  machine_.take(program.image);
  current_ = &program;
  if (program.fault != 0) machine_.raise(program.fault);
}

void Mco305::servo(std::int64_t now) noexcept {
  program_due_ = now % kStep == 0;
  device_.servo(program_due_);
  if (program_due_) show();
}

/// Without a program the device's errors are its own.
void Mco305::take_device_errors() noexcept {
  while (const int error = device_.take_error()) commands_.error_raised(error);
}

void Mco305::run_program(std::int64_t) noexcept {
  if (!program_due_) return;
  if (machine_.over()) take_device_errors();
  const bool clear = device_.io().active(mco305::InputFunction::kErrorClear);
  if (clear && !clear_input_ && machine_.over()) device_.clear_all_errors();
  clear_input_ = clear;
  machine_.step(steps_per_millisecond);
  if (machine_.over()) choose();
}

const DeviceProgram* Mco305::find(std::int32_t number) const noexcept {
  for (const DeviceProgram& program : programs)
    if (program.number == number) return &program;
  return nullptr;
}

/// Of the inputs from the first select input up to the one before the start input, the lowest bit first.
std::int32_t Mco305::selected() const noexcept {
  const auto& io = device_.io();
  const std::size_t first = io.input_of(mco305::InputFunction::kSelect);
  const std::size_t start = io.input_of(mco305::InputFunction::kStart);
  std::int32_t number = 0;
  if (first == 0) return number;
  for (std::size_t input = first; input < start; ++input)
    if (io.input(static_cast<std::int32_t>(input))) number |= 1 << (input - first);
  return number;
}

/// What runs when a program is over: PRGPAR, else by the start input, else the one that starts by itself.
/// After an error of the program nothing does.
void Mco305::choose() noexcept {
  const bool level = device_.io().active(mco305::InputFunction::kStart);
  const bool rises = level && !start_input_;
  start_input_ = level;
  const aposs::ProgramState state = machine_.state();
  if (!choosing_ || current_ == nullptr || state != aposs::ProgramState::kEnded || shutting_down_) return;
  const std::int32_t wanted = device_.parameters()[mco305::kPrgPar];
  const DeviceProgram* next = nullptr;
  if (wanted >= 0)
    next = find(wanted);
  else if (device_.io().input_of(mco305::InputFunction::kStart) == 0)
    return;  // the one that starts by itself has ended
  else if (rises)
    next = find(selected());
  if (next != nullptr && (next != current_ || rises)) start(*next);
}

void Mco305::shut_down() noexcept {
  if (std::exchange(shutting_down_, true)) return;
  machine_.stop();
  device_.escape();
}

bool Mco305::at_rest() const noexcept {
  return !device_.controlled() || (!device_.moving() && device_.set_velocity_now() == 0.0);
}

void Mco305::show() noexcept {
  Mco305ReadOuts& read = data.Read;
  read.APOS = device_.actual_units();
  read.CPOS = device_.set_units();
  read.IPOS = device_.latched_units();
  read.TRACKERR = device_.following_error();
  read.AVEL = device_.velocity_units();
  read.AXEND = device_.axis_end();
  read.STAT = device_.status();
  read.ERRNO = device_.pending().first();
  device_.system_variable(4096, read.ActualPosition);
  device_.system_variable(4097, read.SetPosition);
  device_.system_variable(4111, read.Reference);
  device_.system_variable(4275, read.JerkState);
  if (const auto& parameters = device_.parameters(); parameters.version() != shown_version_) {
    shown_version_ = parameters.version();
    data.Parameters = parameters.all();
  }
  data.Program.Number = current_ == nullptr ? -1 : current_->number;
  data.Program.State = static_cast<DINT>(machine_.state());
  data.Program.Line = current_ == nullptr ? 0 : static_cast<DINT>(machine_.place().line);
  data.Program.Steps = machine_.counters().commands;
  data.Program.Starved = machine_.counters().starved;
  for (std::size_t i = 0; i < data.In.size(); ++i)
    data.In[i] = device_.io().input(static_cast<std::int32_t>(i + 1));
  for (std::size_t i = 0; i < data.Out.size(); ++i) data.Out[i] = device_.io().output(i + 1);
}

}  // namespace lockstep
