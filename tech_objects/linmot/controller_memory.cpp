// The memory that ASCII commands read and write by address: the parameters, a word each.
#include "tech_objects/linmot/controller.hpp"
#include "tech_objects/linmot_catalogue/increments.hpp"

namespace lockstep {

using namespace linmot;

namespace {

/// The parameter at an address, nullptr where none is; those of other types of motors are nowhere.
const Parameter* parameter_at(std::uint32_t address, bool& of_motor) noexcept {
  std::size_t number = address / 2;
  of_motor = number >= system_parameters().size();
  if (of_motor) number -= system_parameters().size();
  const auto list = of_motor ? motor_parameters() : system_parameters();
  if (number >= list.size()) return nullptr;
  const Parameter& parameter = list[number];
  return parameter.effective() && parameter.scope <= Scope::linear_motor ? &parameter : nullptr;
}

}  // namespace

std::uint16_t LinMotController::read_memory(std::size_t index) const noexcept {
  bool of_motor = false;
  const Parameter* const parameter = parameter_at(address_[index], of_motor);
  if (parameter == nullptr) return 0;
  const void* const values = of_motor ? static_cast<const void*>(&data.Motors[index].Parameters)
                                      : static_cast<const void*>(&data.Parameters);
  const std::int32_t number = increments(parameter_value(*parameter, values), increment_of(*parameter));
  return static_cast<std::uint16_t>(number & 0xFFFF);
}

bool LinMotController::write_memory(std::size_t index, std::uint16_t word) noexcept {
  bool of_motor = false;
  const Parameter* const parameter = parameter_at(address_[index], of_motor);
  if (parameter == nullptr || !of_motor || !parameter->live()) return false;
  if (parameter->kind == Kind::on_off && word > 1) return false;
  if (parameter->kind == Kind::choice && word >= parameter->options.size()) return false;
  const bool has_sign = parameter->kind == Kind::value && parameter->range.lowest < 0.0;
  const std::int32_t number = has_sign ? static_cast<std::int16_t>(word) : word;
  set_parameter(*parameter, &data.Motors[index].Parameters, number * increment_of(*parameter));
  return take_parameters(index);
}

}  // namespace lockstep
