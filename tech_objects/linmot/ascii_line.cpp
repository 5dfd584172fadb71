#include "tech_objects/linmot/ascii_line.hpp"

#include <algorithm>
#include <cmath>

#include "tech_objects/linmot/controller.hpp"
#include "tech_objects/linmot_catalogue/errors.hpp"
#include "tech_objects/linmot_catalogue/increments.hpp"

namespace lockstep::linmot {
namespace {

constexpr int kNotInWait = 50, kNotInDisable = 51, kNotInInit = 52, kNotInError = 53, kNotInRun = 54,
              kWrongAddress = 56, kNoMotor = 57, kOwned = 61, kNoCurve = 62, kRange = 64, kNotSerial = 66;

AsciiAnswer refusal(int code) noexcept {
  return {AsciiAnswer::Kind::error, code};
}
AsciiAnswer told(std::int64_t value) noexcept {
  return {AsciiAnswer::Kind::number, static_cast<std::int32_t>(value)};
}
/// Whoever reads it takes a word of ±32256.
AsciiAnswer told_position(double position) noexcept {
  return told(std::clamp(increments(position, kPositionIncrement), -kPositionReach, kPositionReach));
}

bool reaches(double position) noexcept {
  return std::abs(position) <= kPositionReach * kPositionIncrement;
}

constexpr int id(char first, char second) noexcept {
  return first * 256 + second;
}
int id_of(const AsciiCommand& command) noexcept {
  return id(command.name[0], command.name[1]);
}

/// One command for one controller.
class Execution {
 public:
  Execution(const AsciiRequest& request, LinMotController& controller, std::size_t index)
      : request_(request),
        command_(*request.command),
        controller_(controller),
        index_(index),
        motor_(controller.motor(index)),
        parameters_(controller.data.Motors[index].Parameters) {}

  AsciiAnswer of_controller() noexcept;
  AsciiAnswer of_motor() noexcept;

 private:
  int state_refusal() const noexcept;
  AsciiAnswer status() const noexcept;
  AsciiAnswer flag(bool for_motor) noexcept;
  AsciiAnswer read() const noexcept;
  AsciiAnswer move() noexcept;
  AsciiAnswer run_curve() noexcept;
  AsciiAnswer rename() noexcept;
  AsciiAnswer set() noexcept;
  AsciiAnswer write() noexcept;
  AsciiAnswer hand_over(const Order& order) noexcept;
  AsciiAnswer taken() noexcept {
    return controller_.take_parameters(index_) ? AsciiAnswer{} : refusal(kRange);
  }
  double length() const noexcept { return static_cast<double>(request_.number) * kPositionIncrement; }

  const AsciiRequest& request_;
  const AsciiCommand& command_;
  LinMotController& controller_;
  std::size_t index_;
  Motor& motor_;
  MotorParameters& parameters_;
};

int Execution::state_refusal() const noexcept {
  switch (controller_.state()) {
    case State::wait_for_disable:
    case State::stop:
      return kNotInWait;
    case State::disable:
      return kNotInDisable;
    case State::init:
      return kNotInInit;
    case State::error:
      return kNotInError;
    case State::run:
      return 0;
  }
  return 0;
}

AsciiAnswer Execution::status() const noexcept {
  AsciiAnswer answer{AsciiAnswer::Kind::status};
  switch (controller_.state()) {
    case State::wait_for_disable:
    case State::stop:
      answer.letter = 'W';
      break;
    case State::disable:
      answer.letter = 'D';
      break;
    case State::init:
      answer.letter = 'I';
      break;
    case State::run:
      answer.letter = 'R';
      break;
    case State::error:
      answer.letter = 'E';
      answer.number = controller_.error_number();
      if (controller_.error_motor() >= 0) answer.motor = static_cast<char>('A' + controller_.error_motor());
      break;
  }
  return answer;
}

AsciiAnswer Execution::flag(bool for_motor) noexcept {
  using Request = LinMotController::Request;
  bool taken = false;
  switch (id_of(command_)) {
    case id('S', 'R'):
      taken = controller_.request(Request::run, request_.on);
      break;
    case id('S', 'I'):
      taken = controller_.request(Request::init, request_.on);
      break;
    case id('S', 'S'):
      taken = controller_.request(Request::stop, request_.on);
      break;
    default:
      taken = controller_.request_freeze(for_motor ? static_cast<int>(index_) : -1, request_.on);
      break;
  }
  return taken ? AsciiAnswer{} : refusal(kOwned);
}

AsciiAnswer Execution::of_controller() noexcept {
  constexpr int kVersion = 2, kCurrentResolution = 23438;
  switch (id_of(command_)) {
    case id('C', 'I'):
      return told(kCurrentResolution);
    case id('E', 'X'):
      return told(controller_.state_bits());
    case id('G', 'E'):
      return told(controller_.system_errors() & 0xFF);
    case id('G', 'W'):
      return told(controller_.system_warnings() & 0xFF);
    case id('G', 'S'):
      return status();
    case id('G', 'X'):
      return told(controller_.flags());
    case id('P', 'V'):
      return told(kVersion);
    default:
      return flag(false);
  }
}

AsciiAnswer Execution::of_motor() noexcept {
  if (command_.form == AsciiForm::sign_any) return flag(true);
  const bool motion = command_.is(AsciiCommand::kMotion);
  if (motion && static_cast<RunMode>(parameters_.run_mode) != RunMode::serial) return refusal(kNotSerial);
  if (command_.is(AsciiCommand::kInRun))
    if (const int code = state_refusal(); code != 0) return refusal(code);
  if (motion && motor_.cyclic_curve()) return refusal(kNotInRun);
  if (command_.form == AsciiForm::number_drive &&
      (request_.number < command_.lowest || request_.number > command_.highest))
    return refusal(kRange);
  if (command_.is(AsciiCommand::kReads)) return read();
  switch (id_of(command_)) {
    case id('S', 'P'):
    case id('T', 'P'):
    case id('S', 'W'):
    case id('T', 'W'):
    case id('I', 'P'):
    case id('T', 'I'):
      return move();
    case id('R', 'C'):
    case id('R', 'A'):
    case id('T', 'C'):
    case id('T', 'A'):
    case id('C', 'C'):
    case id('C', 'A'):
    case id('C', 'T'):
    case id('C', 'B'):
      return run_curve();
    case id('M', 'H'):
    case id('R', 'P'):
    case id('Z', 'D'):
      return rename();
    case id('R', 'Q'):
      motor_.demand_to_actual();
      return {};
    case id('C', 'S'):
      for (std::size_t i = 0; i < kMotors; ++i)
        if ((request_.number >> i & 1) != 0 && controller_.has_motor(i))
          controller_.motor(i).end_cyclic_curve();
      return {};
    default:
      return set();
  }
}

AsciiAnswer Execution::hand_over(const Order& order) noexcept {
  if (command_.is(AsciiCommand::kArms))
    motor_.arm(order);
  else
    motor_.execute(order);
  return {};
}

AsciiAnswer Execution::move() noexcept {
  const int what = id_of(command_);
  const bool increment = what == id('I', 'P') || what == id('T', 'I');
  Order order{.position = length(), .limits = motor_.filter(), .follows_filter = true};
  order.from_actual = what == id('S', 'W') || what == id('T', 'W');
  if (increment) {
    if (!reaches(motor_.demand() + length())) return refusal(kRange);
    order.kind = Order::Kind::increment;
  }
  // Outside of RUN the demand counts from RUN on.
  if (controller_.state() != State::run && !command_.is(AsciiCommand::kArms)) {
    motor_.set_demand(length());
    return {};
  }
  return hand_over(order);
}

AsciiAnswer Execution::run_curve() noexcept {
  const Curve* const curve = motor_.curve_of(static_cast<std::int32_t>(request_.number));
  if (request_.number != 0 && curve == nullptr) return refusal(kNoCurve);
  Order order{.kind = Order::Kind::curve, .curve = curve};
  order.cyclic = command_.name[0] == 'C';
  order.from_demand =
      command_.name == "RA" || command_.name == "TA" || command_.name == "CA" || command_.name == "CB";
  return hand_over(order);
}

/// At rest and unfrozen only.
AsciiAnswer Execution::rename() noexcept {
  double distance = -length();
  if (command_.name == "RP") distance = length() - motor_.actual();
  if (command_.name == "ZD") distance = -motor_.actual();
  if (!reaches(motor_.demand() + distance) && command_.name == "MH") return refusal(kRange);
  return controller_.move_names(index_, distance, false) ? AsciiAnswer{} : refusal(kNotInRun);
}

/// Numbers and the parameters that they are.
struct Setting {
  char set[2], get[2];
  double MotorParameters::*parameter;
  double increment;
};
constexpr Setting kSettings[] = {
    {{'S', 'V'}, {'G', 'V'}, &MotorParameters::max_speed, kVelocityIncrement},
    {{'S', 'A'}, {'G', 'A'}, &MotorParameters::max_acceleration, kAccelerationIncrement},
    {{'S', 'C'}, {'G', 'C'}, &MotorParameters::maximal_current, kCurrentIncrement},
    {{'D', 'A'}, {'E', 'A'}, &MotorParameters::ff_acceleration, kFeedForwardIncrement},
    {{'D', 'B'}, {'E', 'B'}, &MotorParameters::ff_deceleration, kFeedForwardIncrement},
    {{'D', 'C'}, {'E', 'C'}, &MotorParameters::curve_amplitude, kPercentIncrement},
    {{'D', 'D'}, {'E', 'D'}, &MotorParameters::derivative, kDerivativeIncrement},
    {{'D', 'F'}, {'E', 'F'}, &MotorParameters::ff_friction, kCurrentIncrement},
    {{'D', 'I'}, {'E', 'I'}, &MotorParameters::integral, kIntegralIncrement},
    {{'D', 'K'}, {'E', 'K'}, &MotorParameters::current_offset, kCurrentIncrement},
    {{'D', 'O'}, {'E', 'O'}, &MotorParameters::curve_pos_offset, kPositionIncrement},
    {{'D', 'P'}, {'E', 'P'}, &MotorParameters::proportional, kProportionalIncrement},
    {{'D', 'S'}, {'E', 'S'}, &MotorParameters::curve_speed, kPercentIncrement},
};

AsciiAnswer Execution::set() noexcept {
  for (const Setting& setting : kSettings) {
    if (setting.set[0] != command_.name[0] || setting.set[1] != command_.name[1]) continue;
    parameters_.*setting.parameter = static_cast<double>(request_.number) * setting.increment;
    return taken();
  }
  return write();
}

/// Into the memory of addresses, and where in it.
AsciiAnswer Execution::write() noexcept {
  const auto number = static_cast<std::uint32_t>(request_.number);
  switch (id_of(command_)) {
    case id('A', 'S'):
      controller_.set_segment(index_, number);
      return {};
    case id('A', 'O'):
      if (number % 2 != 0) return refusal(kRange);
      controller_.set_offset(index_, number);
      return {};
    default:
      if (!controller_.write_memory(index_, static_cast<std::uint16_t>(number))) return refusal(kRange);
      if (command_.name == "WS") controller_.next_word(index_);
      return {};
  }
}

AsciiAnswer Execution::read() const noexcept {
  for (const Setting& setting : kSettings)
    if (setting.get[0] == command_.name[0] && setting.get[1] == command_.name[1])
      return told(increments(parameters_.*setting.parameter, setting.increment));
  constexpr int kPositionResolution = 19531250, kVelocityResolution = 190735,
                kAccelerationResolution = 238419;
  switch (id_of(command_)) {
    case id('A', 'C'):
      return told(increments(motor_.current(), kCurrentIncrement));
    case id('P', 'I'):
      return told(kPositionResolution);
    case id('V', 'I'):
      return told(kVelocityResolution);
    case id('A', 'I'):
      return told(kAccelerationResolution);
    case id('E', 'E'):
      return told(controller_.motor_errors(index_) & 0xFF);
    case id('E', 'W'):
      return told(controller_.motor_warnings(index_));
    case id('G', 'P'):
      return told_position(motor_.actual());
    case id('G', 'D'):
      if (motor_.curve_active()) return refusal(kNotInRun);
      return told_position(motor_.demand());
    case id('R', 'E'): {
      const std::uint16_t word = controller_.read_memory(index_);
      controller_.next_word(index_);
      return told(word);
    }
    default:
      return told(controller_.read_memory(index_));
  }
}

}  // namespace

/// @return the code of a refusal, or 0
int AsciiLine::find(const AsciiRequest& request, Addressed& addressed) const noexcept {
  const char target = request.target;
  std::size_t controller = 0;
  addressed.is_motor = target >= 'A';
  if (addressed.is_motor) {
    const auto letter = static_cast<std::size_t>(target - 'A');
    controller = letter / kMotors;
    addressed.motor = letter % kMotors;
  } else {
    controller = static_cast<std::size_t>(target - '1');
  }
  if (controller >= kControllersOnLine || (mode == Mode::rs232 && controller > 0)) return kWrongAddress;
  addressed.controller = controllers[controller];
  if (addressed.controller == nullptr) return kWrongAddress;
  return addressed.is_motor && !addressed.controller->has_motor(addressed.motor) ? kNoMotor : 0;
}

AsciiAnswer AsciiLine::carry_out(const AsciiRequest& request) noexcept {
  if (request.command == nullptr) return refusal(request.error);
  Addressed addressed;
  if (const int code = find(request, addressed); code != 0) return refusal(code);
  Execution execution(request, *addressed.controller, addressed.motor);
  return addressed.is_motor ? execution.of_motor() : execution.of_controller();
}

/// [ns] With the CR behind them; ten bits each.
std::int64_t AsciiLine::time_of(std::size_t characters) const noexcept {
  constexpr std::int64_t kSecond = 1'000'000'000, kBits = 10, kBaud = 9600;
  return pace ? static_cast<std::int64_t>(characters + 1) * kBits * kSecond / kBaud : 0;
}

/// One command in a tick: its answer comes before the next one.
void AsciiLine::step(std::int64_t now) noexcept {
  if (next_ == script.size()) return;
  ScriptedCommand& command = script[next_];
  if (std::max(command.at, free_at_) + time_of(command.text.size()) > now) return;
  if (applies != nullptr && !*applies) return;
  ++next_;
  command.answer = carry_out(command.request);
  command.answered_at = free_at_ = now + time_of(ascii_length(command.answer));
}

}  // namespace lockstep::linmot
