#include "scheduler/mco305/mco305.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>

#include "scheduler/aposs/printed_line.hpp"
#include "tech_objects/profile/fine_interpolation.hpp"

namespace lockstep {
namespace {

constexpr double kStep = 1e-3;                              // [s]
constexpr int kOtherArrays = 170, kOtherArraysLater = 176;  // the later edition has another number
constexpr std::int32_t kAsThereIs = -2;                     // of PRGPAR: the program has not set it

}  // namespace

Mco305::Mco305(std::string object_name, DB_ANY object_number)
    : LeadingObject(ObjectKind::MCO_305, std::move(object_name), object_number) {
  commands_.watch(machine_);
}

/// May allocate: afterwards no start of a program does.
void Mco305::configure(double servo_period, int ratio) {
  ticks_per_step_ = std::max(1, static_cast<int>(std::lround(kStep / servo_period)));
  tick_ = ticks_per_step_ - 1;
  if (master.follows != nullptr) load_.watch(*master.follows, servo_period, ratio);
  settings.has_master =
      master.follows != nullptr || master.signal != nullptr || master.encoder_output_of != nullptr;
  device_.configure(settings, servo_period);
  modulo_ = {};
  last_led_ = device_.led_position();
  last_counts_ = device_.actual_position();
  set_line_.take(device_.unit(), {});
  actual_line_.take(device_.unit(), {});
  configure_leading(servo_period * ratio, extrapolation_);
  reset_leading(actual_position());
  setpoint_ = last_setpoint_ = step_ = last_step_ = {actual_position(), 0.0, 0.0};
  actual_ = last_actual_ = actual_position().value;
  machine_.set_time_interrupts(time_interrupts);
  share_texts();
  for (DeviceProgram& program : programs) {
    program.fault = machine_.load(program.image);
    machine_.stop();
    arrays_.reserve(program.image.arrays);
    if (program.autostart && autostart_ == nullptr) autostart_ = &program;
  }
  eeprom.restore(arrays_);
  data.Parameters = shown_parameters_ = device_.parameters().all();
  shown_version_ = device_.parameters().version();
  choosing_ = autostart_ != nullptr;
  if (choosing_) start(*autostart_);
  show();
}

void Mco305::declare_values() {
  std::vector<const aposs::Image*> images;
  for (const DeviceProgram& program : programs) images.push_back(&program.image);
  values_.declare(images, machine_, arrays_);
}

void Mco305::expect_writes_at(const void* place) noexcept {
  expect_writes();
  const auto* const first = reinterpret_cast<const std::byte*>(data.Parameters.data());
  const auto* const at = static_cast<const std::byte*>(place);
  has_panel_ = has_panel_ || (at >= first && at < first + sizeof data.Parameters);
}

void Mco305::expect_reads(const Variable& variable) noexcept {
  constexpr std::size_t kFirst = offsetof(Mco305Data, SystemVariables);
  if (variable.offset < kFirst || variable.offset >= kFirst + sizeof data.SystemVariables) return;
  const std::size_t index = (variable.offset - kFirst) / sizeof(DINT);
  looked_at_[index / 64].fetch_or(std::uint64_t{1} << index % 64, std::memory_order_relaxed);
}

/// Those that somebody looks at.
void Mco305::show_system_variables() noexcept {
  for (std::size_t word = 0; word < looked_at_.size(); ++word) {
    std::uint64_t bits = looked_at_[word].load(std::memory_order_relaxed);
    if (bits != 0) device_.set_program_line(static_cast<std::int32_t>(machine_.place().line));
    for (; bits != 0; bits &= bits - 1) {
      const std::size_t index = 64 * word + static_cast<std::size_t>(std::countr_zero(bits));
      device_.system_variable(mco305::system_variables()[index].index, data.SystemVariables[index]);
    }
  }
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
  note = {.printed = lines_ > 0, .program = current_ == nullptr ? -1 : current_->number};
  if (lines_ > 0) {
    --lines_;
    return true;
  }
  unheard_ += commands_.take_unheard();
  if (const std::uint64_t lost = machine_.prints().dropped_lines() + unheard_; lost != lost_) {
    note.printed = true;
    note.error = static_cast<int>(lost - lost_);
    lost_ = lost;
    return true;
  }
  const RaisedError raised = commands_.take_raised();
  note.error = raised.number;
  const bool refused = machine_.state() == aposs::ProgramState::kRefused && !told_refusal_;
  if (note.error == 0 && !refused) return false;
  if (note.error == 0) told_refusal_ = true;
  if (note.error == 0) {
    note.line = static_cast<int>(machine_.place().line);
    return true;
  }
  note.program = raised.program;
  note.line = raised.line;
  return true;
}

void Mco305::take_line(std::string& line) {
  aposs::Printed item;
  while (machine_.prints().take(item))
    if (aposs::append_printed(line, texts_, item)) return;
}

/// Its arrays are those that are there, or new behind them: what another program has deleted is made anew.
void Mco305::start(DeviceProgram& program) noexcept {
  commands_.begin_program(program.number);
  machine_.take(program.image);
  for (const int error : device_.pending().all()) machine_.take_standing(error);
  current_ = &program;
  running_ = true;
  if (program.fault == 0 || program.fault == kOtherArrays) program.fault = arrays_.fit(program.image.arrays);
  if (program.fault == 0) return;
  const bool later = program.fault == kOtherArrays && settings.later_edition;
  machine_.raise(later ? kOtherArraysLater : program.fault);
}

DoubleDouble Mco305::measured_line() const noexcept {
  return actual_line_.at(to_double_double(device_.actual_position()));
}

/// POSFACT, POSDRCT: from where the device has been in the last step.
void Mco305::take_unit() noexcept {
  if (device_.unit() == set_line_.unit()) return;
  set_line_.take(device_.unit(), to_double_double(last_led_));
  actual_line_.take(device_.unit(), to_double_double(last_counts_));
}

/// Another device is served first, so that its values are those of this tick.
void Mco305::turn_master(std::int64_t now) noexcept {
  const auto serve = [now](LeadingObject& object) noexcept {
    if (object.kind == ObjectKind::MCO_305) object.servo(now);
  };
  if (master.signal != nullptr) {
    signal_ += static_cast<DINT>(static_cast<UDINT>(*master.signal) - static_cast<UDINT>(last_signal_));
    last_signal_ = *master.signal;
    return device_.master().turn(static_cast<double>(signal_));
  }
  if (master.encoder_output_of != nullptr) {
    serve(*master.encoder_output_of);
    const auto& other = static_cast<const Mco305&>(*master.encoder_output_of);
    return device_.master().turn(static_cast<double>(other.device_.master().own().position()));
  }
  if (master.follows == nullptr) return;
  serve(*master.follows);
  load_.servo();
  device_.master().turn((load_.line() * master.counts / master.units).rounded());
}

void Mco305::before_axes() noexcept {
  if (master.follows != nullptr) load_.interpolated();
  if (!leads) return;
  position_controlled_ = true;
  power_state_ = device_.controlled() ? PowerState::on : PowerState::off;
  // Between two steps it goes from the last one to this.
  const double part = static_cast<double>(tick_ + 1) / ticks_per_step_;
  last_setpoint_ = setpoint_;
  setpoint_ = step_;
  if (tick_ + 1 != ticks_per_step_) {
    const FineSetpoint fine = fine_setpoint(step_.position.value - last_step_.position.value,
                                            last_step_.velocity, step_.velocity, kStep, part);
    setpoint_.position.value = last_step_.position.value + fine.distance;
    setpoint_.velocity = fine.velocity;
  }
  if (!leads_by_actual_value()) return;
  const double moved = actual_ - last_actual_;
  extrapolate({0, last_actual_ + moved * part}, moved / kStep, extrapolation_);
}

void Mco305::servo(std::int64_t now) noexcept {
  if (now == served_) return;
  served_ = now;
  turn_master(now);
  program_due_ = ++tick_ == ticks_per_step_;
  if (program_due_) tick_ = 0;
  if (program_due_ && expects_writes_) take_parameters();
  device_.servo(program_due_);
  if (!program_due_) return;
  take_unit();
  last_led_ = device_.led_position();
  last_counts_ = device_.actual_position();
  if (leads) {
    last_actual_ = actual_;
    actual_ = actual_position().value;
    last_step_ = step_;
    step_.position.value = set_line_.at(to_double_double(device_.led_position())).rounded();
    step_.velocity = set_line_.distance(device_.set_velocity_now()) / kStep;
    step_.acceleration = (step_.velocity - last_step_.velocity) / kStep;
  }
  show();
}

/// What has been written from outside since it was shown: as by a panel. What nothing can be computed with,
/// and what is no published option, is as it was.
void Mco305::take_parameters() noexcept {
  if (std::memcmp(data.Parameters.data(), shown_parameters_.data(), sizeof data.Parameters) == 0) return;
  const auto numbered = mco305::parameters();
  for (std::size_t i = 0; i < data.Parameters.size(); ++i) {
    if (data.Parameters[i] == shown_parameters_[i]) continue;
    const std::int32_t number = i < numbered.size() ? numbered[i].number
                                                    : mco305::kFirstApplicationParameter +
                                                          static_cast<std::int32_t>(i - numbered.size());
    if (mco305::is_option(number, data.Parameters[i], settings.later_edition))
      device_.change_parameter(number, data.Parameters[i]);
  }
  data.Parameters = shown_parameters_ = device_.parameters().all();
  shown_version_ = device_.parameters().version();
}

/// Without a program the device's errors are its own.
void Mco305::take_device_errors() noexcept {
  while (const int error = device_.take_error()) commands_.error_raised(error);
}

void Mco305::run_program(std::int64_t) noexcept {
  if (!program_due_) return;
  look_at_panel();
  look_at_inputs();
  if (machine_.over()) take_device_errors();
  commands_.refresh_links();
  machine_.step(steps_per_millisecond);
  if (machine_.over()) choose();
}

/// Stop is [Esc]: nothing is started any more until the panel starts a program, which takes the place of what
/// runs. With an error that has not been cleared nothing is started.
void Mco305::look_at_panel() noexcept {
  const Mco305Outside& panel = data.Outside;
  if (shutting_down_) return;
  if (std::exchange(seen_stops_, panel.Stops) != panel.Stops) {
    machine_.stop();
    device_.escape();
    choosing_ = false;
  }
  if (std::exchange(seen_resets_, panel.Resets) != panel.Resets) device_.clear_all_errors();
  if (std::exchange(seen_starts_, panel.Starts) == panel.Starts || !device_.pending().tolerated()) return;
  DeviceProgram* const next =
      panel.Program < 0.0 ? autostart_ : find(static_cast<std::int32_t>(panel.Program));
  if (next == nullptr) return;
  machine_.stop();
  end_program();
  wanted_ = kAsThereIs;
  choosing_ = autostart_ != nullptr;
  start(*next);
}

void Mco305::look_at_inputs() noexcept {
  if (!device_.io().any_input_function()) {
    clear_input_ = start_input_ = continue_input_ = start_rises_ = continue_rises_ = false;
    return;
  }
  const auto rises = [this](mco305::InputFunction function, bool& last) {
    const bool level = device_.io().active(function);
    const bool before = std::exchange(last, level);
    return level && !before;
  };
  using enum mco305::InputFunction;
  if (rises(kErrorClear, clear_input_) && machine_.over()) device_.clear_all_errors();
  start_rises_ = rises(kStart, start_input_);
  continue_rises_ = rises(kContinue, continue_input_);
}

DeviceProgram* Mco305::find(std::int32_t number) noexcept {
  for (DeviceProgram& program : programs)
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

/// What a program has set and not saved is as it was; which program it wants next is not.
void Mco305::end_program() noexcept {
  if (!std::exchange(running_, false)) return;
  wanted_ = device_.parameters()[mco305::kPrgPar];
  device_.forget_settings();
  if (wanted_ == device_.parameters()[mco305::kPrgPar]) wanted_ = kAsThereIs;
}

/// A program that an error or the break input has ended goes on, and its motion: when the error has been
/// cleared.
void Mco305::go_on() noexcept {
  if (machine_.state() != aposs::ProgramState::kError || !device_.pending().only(mco305::kUserAbort)) return;
  device_.clear_all_errors();
  device_.motor_on();
  running_ = true;
  machine_.go_on();
  if (const int error = device_.go_on(); error != 0) machine_.raise(error);
}

/// Whom the user has stopped waits for the continue input. An error that has not been cleared lets nothing
/// begin.
bool Mco305::may_start() const noexcept {
  const aposs::ProgramState state = machine_.state();
  if (!choosing_ || state == aposs::ProgramState::kRefused) return false;
  if (state == aposs::ProgramState::kError && machine_.error() == mco305::kUserAbort) return false;
  return device_.pending().tolerated();
}

/// What PRGPAR says, or by the start input the inputs; else the one that starts by itself, again and again.
DeviceProgram* Mco305::next_program() noexcept {
  const std::int32_t wanted = wanted_ == kAsThereIs ? device_.parameters()[mco305::kPrgPar] : wanted_;
  const bool by_input = device_.io().input_of(mco305::InputFunction::kStart) != 0;
  if (wanted >= 0 && (settings.later_edition || !by_input)) return find(wanted);
  if (by_input) return start_rises_ ? find(selected()) : nullptr;
  return repeats ? autostart_ : nullptr;
}

void Mco305::choose() noexcept {
  end_program();
  if (shutting_down_ || current_ == nullptr) return;
  if (continue_rises_) return go_on();
  if (!may_start()) return;
  if (DeviceProgram* const next = next_program(); next != nullptr) start(*next);
}

void Mco305::shut_down() noexcept {
  if (std::exchange(shutting_down_, true)) return;
  machine_.stop();
  device_.escape();
}

bool Mco305::at_rest() const noexcept {
  if (!device_.stands()) return false;
  if (!device_.controlled()) return !device_.open_loop();
  return !device_.moving() && device_.set_velocity_now() == 0.0;
}

void Mco305::show() noexcept {
  Mco305ReadOuts& read = data.Read;
  read.APOS = device_.actual_units();
  read.CPOS = device_.set_units();
  read.IPOS = device_.latched_units();
  if (device_.led()) {
    read.MAPOS = device_.master().shown();
    read.MIPOS = device_.master().shown_latch();
    read.MAVEL = device_.master_velocity();
    read.SYNCERR = device_.sync_error();
    read.SYNCSTAT = device_.sync_status();
  }
  read.TRACKERR = device_.following_error();
  read.AVEL = device_.velocity_units();
  read.AXEND = device_.axis_end();
  read.STAT = device_.status();
  read.ERRNO = device_.pending().first();
  read.ActualPosition = device_.actual_counts_shown();
  read.SetPosition = device_.set_counts_shown();
  read.Reference = device_.reference();
  read.JerkState = static_cast<DINT>(device_.phase());
  read.Inputs = device_.io().input_word();
  read.Outputs = device_.io().output_byte();
  read.AlarmWord1 = device_.pending().alarm_word(1);
  read.AlarmWord2 = device_.pending().alarm_word(2);
  if (const auto& parameters = device_.parameters(); parameters.version() != shown_version_) {
    shown_version_ = parameters.version();
    data.Parameters = shown_parameters_ = parameters.all();
  }
  data.Program.Number = current_ == nullptr ? -1 : current_->number;
  data.Program.State = static_cast<DINT>(machine_.state());
  data.Program.Line = current_ == nullptr ? 0 : static_cast<DINT>(machine_.place().line);
  data.Program.Steps = machine_.counters().commands;
  data.Program.Starved = machine_.counters().starved;
  show_system_variables();
  data.In = device_.io().inputs();
  data.Out = device_.io().outputs();
}

}  // namespace lockstep
