/// Declaration of the variables of a LinMot controller: what it tells, its process image, and its parameters
/// from their table.
/// @source LinMot release 1.3 addendum: 1.9, 3.8, 6, 8.7
#include "tech_objects/data_blocks/linmot.hpp"

#include <deque>
#include <string>
#include <vector>

#include "tech_objects/data_blocks/declaration.hpp"

namespace lockstep {
namespace {

using Data = LinMotData;

constexpr Choice kStates[] = {
    {0, "WAIT FOR DISABLE"}, {1, "DISABLE"}, {2, "INIT"}, {3, "RUN"}, {4, "STOP"}, {5, "ERROR"}};

const Variable kController[] = {
    COMPUTED(State, RON, kNone, (Range{0, 5}), "operating state", .choices = kStates),
    COMPUTED(StateNumber, RON, kNone, (Range{-1, 63}), "row of the state table; -1: none has been called"),
    COMPUTED(Code, RON, kNone, (Range{0, 15}), "code of the inputs, once it has been stable"),
    COMPUTED(Display, RON, kNone, kAny,
             "shown code of an error, version 3; of version 2 how often the lights A and B flash, such as "
             "16#0023, 16#00FF: both; 16#0000: none"),
    COMPUTED(Errors, RON, kNone, kAny,
             "errors of the controller: bits 1 to 5 supplies and electronics, 15 interface"),
    COMPUTED(Warnings, RON, kNone, kAny,
             "warnings of the controller: bits 1 to 5 as the errors, 14 emergency stop"),
    COMPUTED(
        LoggedWarnings, RON, kNone, kAny,
        "warnings since the last transition to RUN: bits 0 to 8 of motors, 9 to 14 of the controller, 15 "
        "something could not be carried out"),
    ARRAY(ProfibusOut, DIR, kNone, kAny, "words that come from the bus, in the order of the modules"),
};

/// Of each motor; the offset is that within its data.
struct MotorVariable {
  const char* name;
  Type type;
  std::size_t offset;
  Unit unit;
  const char* text;
};

#define OF_MOTOR(name_, unit_, text_)                                                                      \
  MotorVariable {                                                                                          \
#name_, type_of < decltype(LinMotMotorData{}.name_)>(), offsetof(LinMotMotorData, name_), unit_, text_ \
  }

const MotorVariable kOfMotor[] = {
    OF_MOTOR(DemandPosition, Unit::kNone, "where the motion goes to [mm]"),
    OF_MOTOR(SetPoint, Unit::kNone, "what the generator gives the position loop [mm]"),
    OF_MOTOR(SetPointVelocity, Unit::kNone, "the same [m/s]"),
    OF_MOTOR(ActualPosition, Unit::kNone, "of the slider; out of the motor is positive [mm]"),
    OF_MOTOR(ActualVelocity, Unit::kNone, "the same [m/s]"),
    OF_MOTOR(FollowingError, Unit::kNone, "set-point less actual position [mm]"),
    OF_MOTOR(DemandCurrent, Unit::kNone, "that the position loop asks for [A]"),
    OF_MOTOR(InPosition, Unit::kNone, "the motion is at its end and the slider within In Position, in RUN"),
    OF_MOTOR(PosRange, Unit::kNone, "the actual position is outside of Pos Range"),
    OF_MOTOR(CurveActive, Unit::kNone, "a curve runs"),
    OF_MOTOR(InitDone, Unit::kNone, "its position is known"),
    OF_MOTOR(Frozen, Unit::kNone, "it is frozen"),
    OF_MOTOR(Errors, Unit::kNone, "its errors, at the bits of EE"),
    OF_MOTOR(Warnings, Unit::kNone, "its warnings, at the bits of EW"),
};

Range range_of(const linmot::Parameter& parameter) {
  if (parameter.kind == linmot::Kind::choice)
    return {0.0, static_cast<double>(parameter.options.size()) - 1.0};
  return parameter.kind == linmot::Kind::on_off ? kAny : parameter.range;
}

std::string text_of(const linmot::Parameter& parameter) {
  std::string text(parameter.text);
  if (!parameter.unit.empty()) text += " [" + std::string(parameter.unit) + "]";
  for (std::size_t i = 0; i < parameter.options.size(); ++i)
    text += (i == 0 ? ": " : ", ") + std::to_string(i) + " " + std::string(parameter.options[i]);
  return text;
}

class Declared {
 public:
  Declared() {
    status_.assign(std::begin(kController), std::end(kController));
    add_array("ProfibusIn[]", type_of<WORD>(), offsetof(Data, ProfibusIn), Data::kWords, sizeof(WORD),
              "words that go to the bus");
    add_array("ProfibusOutByte[]", type_of<BYTE>(), offsetof(Data, ProfibusOutByte), 2 * Data::kWords,
              sizeof(BYTE), "the words from the bus as bytes, in the configured order");
    add_array("ProfibusInByte[]", type_of<BYTE>(), offsetof(Data, ProfibusInByte), 2 * Data::kWords,
              sizeof(BYTE), "the words to the bus as bytes, in the configured order");
    for (const linmot::Parameter& parameter : linmot::system_parameters())
      add(parameter, "", offsetof(Data, Parameters));
    for (std::size_t motor = 0; motor < linmot::kMotors; ++motor) add_motor(motor);
    block_ = {{}, status_};
  }
  const DataBlock& block() const { return block_; }

 private:
  void add_motor(std::size_t motor) {
    const std::string name(1, static_cast<char>('A' + motor));
    const std::size_t base = offsetof(Data, Motors) + motor * sizeof(LinMotMotorData);
    for (const MotorVariable& of : kOfMotor)
      status_.push_back({.path = names_.emplace_back(name + "." + of.name),
                         .type = of.type,
                         .offset = base + of.offset,
                         .effect = Effect::RON,
                         .computed = true,
                         .unit = of.unit,
                         .range = kAny,
                         .text = of.text,
                         .start = &start_value_in<Data>});
    for (const linmot::Parameter& parameter : linmot::motor_parameters())
      if (parameter.scope <= linmot::Scope::linear_motor)
        add(parameter, name + ".", base + offsetof(LinMotMotorData, Parameters));
  }
  /// What has no effect is no signal.
  void add(const linmot::Parameter& parameter, const std::string& owner, std::size_t base) {
    if (!parameter.effective()) return;
    Type type = Type::DINT;
    if (parameter.kind == linmot::Kind::value) type = Type::LREAL;
    if (parameter.kind == linmot::Kind::on_off) type = Type::BOOL;
    status_.push_back({.path = names_.emplace_back(owner + linmot::signal_path(parameter.path)),
                       .type = type,
                       .offset = base + parameter.offset,
                       .effect = parameter.live() ? Effect::DIR : Effect::RON,
                       .computed = !parameter.live(),
                       .unit = Unit::kNone,
                       .range = range_of(parameter),
                       .text = names_.emplace_back(text_of(parameter)),
                       .start = &start_value_in<Data>});
  }
  void add_array(const char* path, Type type, std::size_t offset, std::size_t count, std::size_t stride,
                 const char* text) {
    status_.push_back({.path = path,
                       .type = type,
                       .offset = offset,
                       .count = count,
                       .stride = stride,
                       .effect = Effect::RON,
                       .computed = true,
                       .unit = Unit::kNone,
                       .range = kAny,
                       .text = text,
                       .start = &start_value_in<Data>});
  }

  std::deque<std::string> names_;
  std::vector<Variable> status_;
  DataBlock block_{{}, {}};
};

}  // namespace

const DataBlock& linmot_data_block() {
  static const Declared declared;
  return declared.block();
}

}  // namespace lockstep
