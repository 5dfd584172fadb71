#include "tech_objects/mco305/inputs_outputs.hpp"

namespace lockstep::mco305 {
namespace {

std::int32_t function_parameter(std::size_t input) noexcept {
  const auto number = static_cast<std::int32_t>(input);
  return number <= 10 ? kFirstInputFunction + number - 1 : kFirstInputFunction + number;
}

}  // namespace

std::int32_t InputsOutputs::input_byte(std::int32_t number) const noexcept {
  constexpr std::array<std::size_t, 8> kBytes[] = {
      {1, 2, 3, 4, 5, 6, 7, 8}, {33, 32, 29, 27, 19, 18, 0, 0}, {9, 10, 11, 12, 0, 0, 0, 0}};
  if (number < 0 || number > 2) return 0;
  std::int32_t byte = 0;
  for (std::size_t bit = 0; bit < 8; ++bit) {
    const std::size_t input = kBytes[number][bit];
    if (input != 0 && inputs_[input - 1]) byte |= 1 << bit;
  }
  return byte;
}

bool InputsOutputs::switch_output(std::int32_t number, bool on) noexcept {
  constexpr std::int32_t kRelays[] = {3401, 3405, 3410};  // X34/1, X34/5, X34/10
  for (std::int32_t i = 0; i < 3; ++i)
    if (number == kRelays[i]) number = 30 + i;
  if (number < 1 || number > static_cast<std::int32_t>(kOutputs)) return false;
  switch_one(static_cast<std::size_t>(number - 1), on);
  return true;
}

void InputsOutputs::switch_one(std::size_t index, bool on) noexcept {
  if (shared_are_inputs_ && is_shared_output(index + 1)) return;
  outputs_[index] = on;
  if (index >= kFunctionOutputs) return;
  const std::int32_t bit = 1 << index;
  output_byte_ = on ? output_byte_ | bit : output_byte_ & ~bit;
}

void InputsOutputs::switch_all(bool on) noexcept {
  for (const std::int32_t output : {1, 2, 3, 4, 5, 6, 7, 8, 21, 22, 27, 29, 30, 31, 32})
    switch_output(output, on);
}

void InputsOutputs::assign(const ParameterValues& parameters) noexcept {
  input_of_.fill(0);
  closed_.fill(false);
  any_input_function_ = false;
  for (std::size_t input = kFunctionInputs; input >= 1; --input) {
    const std::int32_t function = parameters[function_parameter(input)];
    if (function < 1 || function > 15 || (is_shared_input(input) && !shared_are_inputs_)) continue;
    any_input_function_ = true;
    const auto open = static_cast<std::size_t>(function - (function % 2 == 0 ? 1 : 0));
    input_of_[open] = static_cast<std::uint8_t>(input);
    closed_[open] = function % 2 == 0;
  }
  for (std::size_t i = 0; i < kFunctionOutputs; ++i) {
    const std::int32_t function = parameters[kFirstOutputFunction + static_cast<std::int32_t>(i)];
    const auto wanted = static_cast<std::uint8_t>(function >= 1 && function <= 6 ? function : 0);
    if (wanted != functions_[i]) shown_[i] = 0;
    functions_[i] = wanted;
    any_function_ = any_function_ || wanted != 0;
  }
}

void InputsOutputs::show(const Shown& now) noexcept {
  if (!any_function_) return;
  for (std::size_t i = 0; i < kFunctionOutputs; ++i) {
    const std::uint8_t function = functions_[i];
    if (function == 0) continue;
    const bool is = function <= 2 ? now.moving : function <= 4 ? now.error : now.brake;
    const auto shown = static_cast<std::uint8_t>(is ? 2 : 1);
    if (shown == shown_[i]) continue;
    const bool first = shown_[i] == 0;
    shown_[i] = shown;
    // A brake is released by OUT alone.
    if (function >= 5 && !is && !first) continue;
    switch_one(i, is == (function % 2 == 1));
  }
}

}  // namespace lockstep::mco305
