#include "scheduler/mco305/device_commands.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "scheduler/aposs/output_bytes.hpp"

namespace lockstep {
namespace {

using aposs::Command;
using aposs::Reply;

/// Of a command that may be refused with an error, and that is over when the axis rests.
Reply begun(int error) noexcept {
  return error == 0 ? Reply::busy() : Reply::failed(error);
}
Reply done(int error) noexcept {
  return error == 0 ? Reply::done() : Reply::failed(error);
}

/// I_FUNCTION_n_m is 1'000'000 + 100 · n + m; an old name such as I_BREAK has m = 0, and the input as its
/// value.
constexpr std::int32_t kInputFunction = 1'000'000;

constexpr std::int32_t kNoKey = -1;  // of INKEY

constexpr std::int32_t kWordBits = 16, kWordMask = 0xFFFF;
constexpr std::int64_t kLinkPeriod = 40;  // [ms]
constexpr std::int32_t kFirstWordIn = 3401, kFirstWordOut = 3421;

std::int32_t word_of(WORD word) noexcept {
  return static_cast<std::int32_t>(word);
}
/// Of the words from a number on the one that a number stands for; nullptr: none.
template <class Words>
auto* word_at(Words& words, std::int32_t number, std::int32_t first) noexcept {
  const auto index = static_cast<std::size_t>(static_cast<std::int64_t>(number) - first);
  return index < words.size() ? &words[index] : nullptr;
}

std::int32_t function_parameter(std::int32_t input) noexcept {
  return input <= 10 ? mco305::kFirstInputFunction + input - 1 : mco305::kFirstInputFunction + input;
}

}  // namespace

Reply DeviceCommands::begin(Command command, const std::int32_t* arguments, aposs::Arrays& arrays) noexcept {
  Reply reply = motion(command, arguments);
  if (reply.kind == Reply::Kind::kRefused) reply = following(command, arguments);
  if (reply.kind == Reply::Kind::kRefused) reply = reading(command, arguments);
  if (reply.kind == Reply::Kind::kRefused) reply = communication(command, arguments, arrays);
  if (reply.kind == Reply::Kind::kRefused) reply = drive(command, arguments);
  return reply.kind == Reply::Kind::kRefused ? keeping(command, arguments, arrays) : reply;
}

Reply DeviceCommands::motion(Command command, const std::int32_t* arguments) noexcept {
  switch (command) {
    case Command::kVel:
      device_.set_velocity(arguments[0]);
      return Reply::done();
    case Command::kAcc:
      device_.set_acceleration(arguments[0]);
      return Reply::done();
    case Command::kDec:
      device_.set_deceleration(arguments[0]);
      return Reply::done();
    case Command::kPosa:
      return begun(device_.position_to(arguments[0], false));
    case Command::kPosr:
      return begun(device_.position_to(arguments[0], true));
    case Command::kCvel:
      device_.set_speed(arguments[0]);
      return Reply::done();
    case Command::kCstart:
      return done(device_.start_speed());
    case Command::kCstop:
      device_.stop_speed();
      return Reply::done();
    case Command::kMotorOn:
      device_.motor_on();
      return Reply::done();
    case Command::kMotorOff:
      device_.motor_off();
      return Reply::done();
    case Command::kMotorStop:
      device_.motor_stop();
      return device_.arrived() ? Reply::done() : Reply::busy();
    case Command::kContinue:
      return done(device_.go_on());
    case Command::kDefOrigin:
      return done(device_.define_origin());
    case Command::kSetOrigin:
      device_.set_origin(arguments[0]);
      return Reply::done();
    case Command::kRstOrigin:
      device_.reset_origin();
      return Reply::done();
    case Command::kHome:
      return begun(device_.begin_home(false));
    case Command::kIndex:
      return begun(device_.begin_home(true));
    case Command::kWaitax:
      return device_.arrived() ? Reply::done() : Reply::busy();
    case Command::kWaitndx:
      if (device_.is_absolute()) return Reply::failed(mco305::kUnknownCommand);
      latches_ = device_.latches();
      return Reply::busy();
    case Command::kWaitp:
      return device_.actual_units() == arguments[0] ? Reply::done() : Reply::busy();
    default:
      return Reply::refused();
  }
}

/// What has to do with the master.
Reply DeviceCommands::following(Command command, const std::int32_t* arguments) noexcept {
  switch (command) {
    case Command::kSyncv:
      return done(device_.follow(mco305::SyncMode::kVelocity));
    case Command::kSyncp:
      return done(device_.follow(mco305::SyncMode::kPosition));
    case Command::kSyncm:
      return synchronize_by_markers();
    case Command::kDefSyncorigin:
      device_.define_sync_origin(arguments[0], arguments[1]);
      return Reply::done();
    case Command::kMovesyncorigin:
      device_.move_sync_origin(arguments[0]);
      return Reply::done();
    case Command::kSyncstatclr:
      device_.clear_sync_status(arguments[0]);
      return Reply::done();
    case Command::kSyncmarkerstart:
      if (arguments[0] != 0 && arguments[0] != 1) return Reply::failed(mco305::kUnknownParameter);
      device_.restart_markers(arguments[0] == 1);
      return Reply::done();
    case Command::kDefmorigin:
      return done(device_.define_master_origin());
    case Command::kSetmorigin:
      device_.master().set_origin(arguments[0]);
      return Reply::done();
    case Command::kPulsacc:
      device_.master().set_acceleration(arguments[0]);
      return Reply::done();
    case Command::kPulsvel:
      device_.turn_own_master(arguments[0]);
      return Reply::done();
    case Command::kSetSysvar:
      return device_.set_system_variable(arguments[0], arguments[1]) ? Reply::done() : unknown(arguments[0]);
    case Command::kMapos:
      return Reply::done(device_.master().shown());
    case Command::kMipos:
      return Reply::done(device_.master().shown_latch());
    case Command::kMavel:
      return Reply::done(device_.master_velocity());
    case Command::kSyncerr:
      return Reply::done(device_.sync_error());
    case Command::kSyncstat:
      return Reply::done(device_.sync_status());
    default:
      return Reply::refused();
  }
}

/// 2000 is for curves alone, and 7 is of the later edition.
Reply DeviceCommands::synchronize_by_markers() noexcept {
  const std::int32_t start = device_.parameters()[mco305::kSyncMStart];
  const std::int32_t last = device_.later_edition() ? 7 : 6;
  constexpr std::int32_t kLater = 1000;
  const bool known = (start >= 0 && start <= last) || (start >= kLater && start <= kLater + last);
  return known ? done(device_.follow(mco305::SyncMode::kMarkers)) : Reply::refused();
}

Reply DeviceCommands::reading(Command command, const std::int32_t* arguments) noexcept {
  std::int32_t value = 0;
  switch (command) {
    case Command::kApos:
      return Reply::done(device_.actual_units());
    case Command::kCpos:
      return Reply::done(device_.set_units());
    case Command::kIpos:
      return Reply::done(device_.latched_units());
    case Command::kAvel:
      return Reply::done(device_.velocity_units());
    case Command::kTrackerr:
      return Reply::done(device_.following_error());
    case Command::kAxend:
      return Reply::done(device_.axis_end());
    case Command::kStat:
      return Reply::done(device_.status());
    case Command::kSysvar:
      if (machine_ != nullptr) device_.set_program_line(static_cast<std::int32_t>(machine_->place().line));
      if (device_.system_variable(arguments[0], value)) return Reply::done(value);
      return unknown(arguments[0]);
    case Command::kGet:
      return get(arguments[0]);
    case Command::kSet:
      return set(arguments[0], arguments[1]);
    case Command::kLinkgpar:
      return link(arguments);
    case Command::kIn:
      return Reply::done(device_.io().input(arguments[0]) ? 1 : 0);
    case Command::kInb:
      return Reply::done(device_.io().input_byte(arguments[0]));
    case Command::kOut:
      return device_.io().switch_output(arguments[0], arguments[1] != 0) ? Reply::done()
                                                                         : Reply::failed(mco305::kArrayBound);
    case Command::kOutb:
      return output_byte(arguments);
    case Command::kInkey:
      return arguments[0] < 0 || keys() != kNoKey ? Reply::done(keys()) : Reply::busy();
    case Command::kGetvel:
      device_.set_velocity_window(arguments[0]);
      return Reply::busy();
    case Command::kOutan:
      device_.set_reference(arguments[0]);
      return Reply::done();
    default:
      return Reply::refused();
  }
}

/// GET: process data stand here, all else in the device.
Reply DeviceCommands::get(std::int32_t number) noexcept {
  if (const WORD* const word = word_at(outside_.PcdIn, number, kFirstWordIn))
    return Reply::done(word_of(*word));
  if (const WORD* const word = word_at(outside_.PcdOut, number, kFirstWordOut))
    return Reply::done(word_of(*word));
  std::int32_t value = 0;
  if (device_.get_parameter(number, value)) return Reply::done(value);
  return unknown(number);
}

Reply DeviceCommands::unknown(std::int32_t number) noexcept {
  unknown_ = number;
  return Reply::failed(mco305::kUnknownParameter);
}

/// One state of the keys for each call.
std::int32_t DeviceCommands::keys() const noexcept {
  return outside_.Keys == 0 ? kNoKey : outside_.Keys;
}

/// Words of a field bus: what comes and what goes are apart.
Reply DeviceCommands::communication(Command command, const std::int32_t* arguments,
                                    aposs::Arrays& arrays) noexcept {
  switch (command) {
    case Command::kPcd:
    case Command::kSentPcd: {
      const auto& words = command == Command::kPcd ? outside_.PcdIn : outside_.PcdOut;
      const WORD* const word = word_at(words, arguments[0], 1);
      return word == nullptr ? Reply::failed(mco305::kArrayBound) : Reply::done(word_of(*word));
    }
    case Command::kSetPcd: {
      WORD* const word = word_at(outside_.PcdOut, arguments[0], 1);
      if (word == nullptr) return Reply::failed(mco305::kArrayBound);
      *word = static_cast<WORD>(arguments[1] & kWordMask);
      return Reply::done();
    }
    case Command::kComoptget:
    case Command::kComoptsend:
      return copy_words(command, arguments, arrays);
    case Command::kLinksysvar:
      return link_system_variable(arguments);
    default:
      return Reply::refused();
  }
}

Reply DeviceCommands::copy_words(Command command, const std::int32_t* arguments,
                                 aposs::Arrays& arrays) noexcept {
  const auto array = arrays.of(static_cast<std::uint32_t>(arguments[1]));
  const auto count = static_cast<std::size_t>(std::max(arguments[0], 0));
  if (arguments[0] < 0 || count > array.size() || count > Mco305Outside::kWords)
    return Reply::failed(mco305::kArrayBound);
  for (std::size_t i = 0; i < count; ++i) {
    if (command == Command::kComoptget)
      array[i] = word_of(outside_.PcdIn[i]);
    else
      outside_.PcdOut[i] = static_cast<WORD>(array[i] & kWordMask);
  }
  return Reply::done();
}

/// What the drive has in which the option sits.
Reply DeviceCommands::drive(Command command, const std::int32_t* arguments) noexcept {
  std::int32_t value = 0;
  switch (command) {
    case Command::kGetvlt:
      return device_.drive_parameter(arguments[0], value) ? Reply::done(value) : unknown(arguments[0]);
    case Command::kSetvlt:
      return done(device_.set_drive_parameter(arguments[0], arguments[1]));
    case Command::kGetvltsub:  // none of those that are there has indices
    case Command::kSetvltsub:
      return Reply::failed(mco305::kUnknownParameter);
    case Command::kInad:
      return device_.analog_input(arguments[0], value) ? Reply::done(value)
                                                       : Reply::failed(mco305::kArrayBound);
    case Command::kOutda:
      return device_.set_analog_output(arguments[0], arguments[1]) ? Reply::done()
                                                                   : Reply::failed(mco305::kArrayBound);
    case Command::kSwapmenc:
      return device_.swap_encoders(arguments[0] != 0) ? Reply::done() : Reply::refused();
    default:
      return Reply::refused();
  }
}

/// A parameter shows one variable: the link that was made last counts.
Reply DeviceCommands::link_system_variable(const std::int32_t* arguments) noexcept {
  std::int32_t value = 0;
  if (!mco305::is_application_parameter(arguments[1]) || !device_.system_variable(arguments[0], value))
    return Reply::failed(mco305::kLinkFailed);
  std::size_t at = 0;
  while (at < link_count_ && links_[at].parameter != arguments[1]) ++at;
  links_[at] = {arguments[0], arguments[1]};
  link_count_ = std::max(link_count_, at + 1);
  return done(device_.set_parameter(arguments[1], value));
}

void DeviceCommands::refresh_links() noexcept {
  if (link_count_ == 0 || device_.milliseconds() % kLinkPeriod != 0) return;
  next_link_ = next_link_ + 1 < link_count_ ? next_link_ + 1 : 0;
  std::int32_t value = 0;
  if (device_.system_variable(links_[next_link_].variable, value))
    device_.set_parameter(links_[next_link_].parameter, value);
}

/// What has to do with arrays and with what is kept. Curves are not built, so that none is one; what has
/// their mark is refused.
Reply DeviceCommands::keeping(Command command, const std::int32_t* arguments,
                              aposs::Arrays& arrays) noexcept {
  constexpr std::int32_t kCurve = 999'000'001;
  switch (command) {
    case Command::kSave:
      return eeprom_.save(arguments[0], device_.parameters(), arrays);
    case Command::kSaveprom:
      return eeprom_.save_all(arrays);
    case Command::kSetcurve: {
      const auto array = arrays.of(static_cast<std::uint32_t>(arguments[0]));
      const bool curve = !array.empty() && array.front() == kCurve;
      return curve ? Reply::refused() : Reply::failed(mco305::kCurveArrayWrong);
    }
    default:
      return Reply::refused();
  }
}

/// SET: an input function by its own name is that of an input.
Reply DeviceCommands::set(std::int32_t number, std::int32_t value) noexcept {
  if (number < kInputFunction) {
    const int error = device_.set_parameter(number, value);
    return error == mco305::kUnknownParameter ? unknown(number) : done(error);
  }
  const std::int32_t function = (number - kInputFunction) / 100;
  const std::int32_t input = (number - kInputFunction) % 100;
  if (input != 0) return done(device_.set_parameter(function_parameter(input), value != 0 ? function : 0));
  // The old names: the value is the input, negative where it is normally closed, 0 for none.
  const std::int32_t which = value < 0 ? -value : value;
  if (which == 0) return Reply::done();
  if (which > static_cast<std::int32_t>(mco305::InputsOutputs::kFunctionInputs))
    return Reply::failed(mco305::kUnknownParameter);
  return done(device_.set_parameter(function_parameter(which), value < 0 ? function + 1 : function));
}

/// LINKGPAR: the stored value is brought into the limits.
Reply DeviceCommands::link(const std::int32_t* arguments) noexcept {
  if (!mco305::is_application_parameter(arguments[0]) || arguments[2] > arguments[3])
    return Reply::failed(mco305::kLinkFailed);
  const std::int32_t value = device_.parameters()[arguments[0]];
  return done(device_.set_parameter(arguments[0], std::clamp(value, arguments[2], arguments[3])));
}

Reply DeviceCommands::output_byte(const std::int32_t* arguments) noexcept {
  const std::span<const std::int32_t> outputs = aposs::outputs_of_byte(arguments[0]);
  std::int32_t bits = arguments[1];
  for (const std::int32_t output : outputs) {
    device_.io().switch_output(output, (bits & 1) != 0);
    bits >>= 1;
  }
  return outputs.empty() ? Reply::failed(mco305::kArrayBound) : Reply::done();
}

Reply DeviceCommands::proceed(Command command, const std::int32_t* arguments, std::int64_t elapsed) noexcept {
  switch (command) {
    case Command::kPosa:
    case Command::kPosr:
    case Command::kMotorStop:
    case Command::kWaitax:
      return device_.arrived() ? Reply::done() : Reply::busy();
    case Command::kHome:
    case Command::kIndex:
      return device_.homing() ? Reply::busy() : done(device_.homing_error());
    case Command::kWaitndx:
      if (device_.latches() != latches_) return Reply::done();
      return elapsed >= arguments[0] ? Reply::failed(mco305::kWaitIndexTimeout) : Reply::busy();
    case Command::kWaitp: {
      const std::int32_t at = device_.actual_units();
      const bool up = device_.set_velocity_now() >= 0.0;
      return (up ? at >= arguments[0] : at <= arguments[0]) ? Reply::done() : Reply::busy();
    }
    case Command::kInkey:  // it waits for its time, and for ever without one
      if (keys() != kNoKey) return Reply::done(keys());
      return arguments[0] != 0 && elapsed >= arguments[0] ? Reply::done(kNoKey) : Reply::busy();
    case Command::kSave:
    case Command::kSaveprom:
      return eeprom_.proceed();
    default:
      return elapsed >= arguments[0] ? Reply::done() : Reply::busy();
  }
}

/// What the history keeps of it beside its number.
std::int32_t DeviceCommands::value_of(int error) noexcept {
  switch (error) {
    case mco305::kPositionError:
      return device_.set_counts_shown() - device_.actual_counts_shown();
    case mco305::kSoftwareLimit:
    case mco305::kFurtherOut:
      return device_.actual_counts_shown();
    case mco305::kUnknownParameter:
      return std::exchange(unknown_, 0);
    case mco305::kHardwareLimit:
      for (const auto end : {mco305::InputFunction::kNegativeEnd, mco305::InputFunction::kPositiveEnd})
        if (device_.io().active(end)) return static_cast<std::int32_t>(device_.io().input_of(end));
      return 0;
    case mco305::kEncoderError:
      return device_.encoder_failed() ? 2 : 1;
    default:
      return 0;
  }
}

void DeviceCommands::error_raised(int error) noexcept {
  std::copy_backward(history_.begin(), history_.end() - 1, history_.end());
  const bool runs = machine_ != nullptr && program_ >= 0;
  history_.front() = {.Number = error,
                      .Time = static_cast<DINT>(device_.milliseconds() & 0x7FFFFFFF),
                      .Program = program_,
                      .Line = runs ? static_cast<DINT>(machine_->error_place().line) : -1,
                      .Value = value_of(error)};
  if (raised_count_ < raised_.size())
    raised_[raised_count_++] = {error, program_, static_cast<int>(runs ? machine_->error_place().line : 0)};
  else
    ++unheard_;
  device_.react(error);
}

RaisedError DeviceCommands::take_raised() noexcept {
  if (raised_count_ == 0) return {};
  const RaisedError error = raised_[0];
  std::copy(raised_.begin() + 1, raised_.end(), raised_.begin());
  --raised_count_;
  return error;
}

void DeviceCommands::give_up(Command) noexcept {
  device_.give_up_home();
}

bool DeviceCommands::level(aposs::EdgeSource source, std::int32_t number) noexcept {
  switch (source) {
    case aposs::EdgeSource::kInput:
      return device_.io().input(number);
    case aposs::EdgeSource::kStatbit:
      return (static_cast<std::uint32_t>(device_.flags()) >> (number - 1) & 1U) != 0;
    case aposs::EdgeSource::kCombit: {
      if (number < 1 || number > 2 * kWordBits) return false;
      const std::int32_t bit = number - 1;
      return (word_of(outside_.PcdIn[static_cast<std::size_t>(bit / kWordBits)]) >> bit % kWordBits & 1) != 0;
    }
  }
  return false;
}

aposs::PositionReading DeviceCommands::position(aposs::PositionSource source) noexcept {
  constexpr std::int64_t kTurn = std::int64_t{1} << 31;
  if (source == aposs::PositionSource::kMapos) return {device_.master().shown(), kTurn};
  if (source != aposs::PositionSource::kApos) return {};
  return {device_.actual_units(), kTurn};
}

}  // namespace lockstep
