/// Digital inputs and outputs of the option and what they are for.
/// @source MCO 305 Design Guide, 33-5*, 33-6*; IN, INB, OUT, OUTB
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "tech_objects/mco305_catalogue/parameters.hpp"

namespace lockstep::mco305 {

/// Of an input, where it is normally open; one more where it is normally closed.
enum class InputFunction : std::uint8_t {
  kHomeSwitch = 1,
  kNegativeEnd = 3,
  kPositiveEnd = 5,
  kErrorClear = 7,
  kBreak = 9,
  kContinue = 11,
  kStart = 13,
  kSelect = 15
};

/// What the functions of outputs show.
struct Shown {
  bool moving = false, error = false;
  bool brake = false;  ///< it goes on with this, and off by OUT alone
};

class InputsOutputs {
 public:
  static constexpr std::size_t kInputs = 33;
  static constexpr std::size_t kOutputs = 32;  ///< 30, 31, 32: the relays X34/1, X34/5, X34/10
  static constexpr std::size_t kFunctionInputs = 12, kFunctionOutputs = 8;

  /// IOMODE, until the next time: terminals X59/1 and X59/2 are inputs 11 and 12, or outputs 1 and 2.
  void power_up(const ParameterValues& parameters) noexcept { shared_are_inputs_ = parameters[kIoMode] == 0; }
  static constexpr bool is_shared_input(std::size_t number) noexcept { return number == 11 || number == 12; }
  static constexpr bool is_shared_output(std::size_t number) noexcept { return number == 1 || number == 2; }

  /// One whose terminal is an output has no level.
  void set_input(std::size_t number, bool level) noexcept {
    if (number < 1 || number > kInputs || inputs_[number - 1] == level) return;
    if (is_shared_input(number) && !shared_are_inputs_) return;
    inputs_[number - 1] = level;
    ++changes_;
    input_word_ = input_byte(0) | input_byte(1) << 8 | input_byte(2) << 16;
  }
  /// Counts every change of an input.
  std::uint32_t changes() const noexcept { return changes_; }
  const std::array<bool, kInputs>& inputs() const noexcept { return inputs_; }
  const std::array<bool, kOutputs>& outputs() const noexcept { return outputs_; }
  /// False for a number that is not there.
  bool input(std::int32_t number) const noexcept {
    return number >= 1 && number <= static_cast<std::int32_t>(kInputs) &&
           inputs_[static_cast<std::size_t>(number - 1)];
  }
  /// INB. Byte 0: inputs 1 to 8, the lowest first; 1: 33 (lowest), 32, 29, 27, 19, 18; 2: 9 to 12.
  std::int32_t input_byte(std::int32_t number) const noexcept;
  /// 34-40: the three bytes.
  std::int32_t input_word() const noexcept { return input_word_; }
  bool output(std::size_t number) const noexcept {
    return number >= 1 && number <= kOutputs && outputs_[number - 1];
  }
  /// OUT. False if there is no such output; one whose terminal is an input stays off.
  bool switch_output(std::int32_t number, bool on) noexcept;
  /// Those of the option and of the drive.
  void switch_all(bool on) noexcept;
  std::int32_t output_byte() const noexcept { return output_byte_; }

  /// Looks which input and output is for what; when parameters have changed.
  void assign(const ParameterValues& parameters) noexcept;
  /// Whether any input has a function.
  bool any_input_function() const noexcept { return any_input_function_; }
  /// The input that has a function, the lowest if there are several; 0: none.
  std::size_t input_of(InputFunction function) const noexcept {
    return input_of_[static_cast<std::size_t>(function)];
  }
  /// Whether what the function stands for is the case; false without an input for it.
  bool active(InputFunction function) const noexcept {
    const std::size_t number = input_of(function);
    return number != 0 && inputs_[number - 1] != closed_[static_cast<std::size_t>(function)];
  }
  /// Whether any output has had one.
  bool any_output_function() const noexcept { return any_function_; }
  /// Switches the outputs that have a function, when what they show changes.
  void show(const Shown& now) noexcept {
    if (any_function_) show_functions(now);
  }

 private:
  void show_functions(const Shown& now) noexcept;
  void switch_one(std::size_t index, bool on) noexcept;

  bool shared_are_inputs_ = false;
  std::uint32_t changes_ = 0;
  std::int32_t input_word_ = 0, output_byte_ = 0;
  std::array<bool, kInputs> inputs_{};
  std::array<bool, kOutputs> outputs_{};
  std::array<std::uint8_t, 16> input_of_{};
  std::array<bool, 16> closed_{};
  std::array<std::uint8_t, kFunctionOutputs> functions_{};
  bool any_input_function_ = false;
  bool any_function_ = false;                           // of an output
  std::array<std::uint8_t, kFunctionOutputs> shown_{};  // 0: nothing yet; 1: off; 2: on
};

}  // namespace lockstep::mco305
