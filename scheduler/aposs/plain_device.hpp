/// A device without a machine: time, inputs, outputs, application parameters. Commands that need a machine
/// are refused.
#pragma once

#include <array>
#include <cstdint>

#include "scheduler/aposs/device.hpp"

namespace lockstep::aposs {

class PlainDevice : public Device {
 public:
  static constexpr std::size_t kInputs = 33;
  static constexpr std::size_t kOutputs = 32;  ///< 30, 31, 32: the relays X34/1, X34/5, X34/10
  static constexpr std::int32_t kFirstParameter = 1900, kLastParameter = 1999;

  void advance(std::int64_t milliseconds) noexcept { now_ += milliseconds; }
  void set_input(std::size_t number, bool level) noexcept {
    if (number >= 1 && number <= kInputs) inputs_[number - 1] = level;
  }
  bool output(std::size_t number) const noexcept {
    return number >= 1 && number <= kOutputs && outputs_[number - 1];
  }
  /// As from a panel: ON PARAM sees it.
  void set_parameter(std::int32_t number, std::int32_t value) noexcept;
  std::int32_t parameter(std::int32_t number) const noexcept;

  std::int64_t milliseconds() noexcept override { return now_; }
  Reply begin(Command command, const std::int32_t* arguments, Arrays& arrays) noexcept override;
  Reply proceed(Command command, const std::int32_t* arguments, std::int64_t elapsed) noexcept override;
  void give_up(Command) noexcept override {}
  bool level(EdgeSource source, std::int32_t number) noexcept override;
  PositionReading position(PositionSource) noexcept override { return {}; }
  std::uint32_t changes(std::int32_t parameter) noexcept override;
  int take_error() noexcept override { return 0; }
  void error_raised(int) noexcept override {}
  void error_cleared() noexcept override {}

 private:
  struct Parameter {
    std::int32_t value = 0;
    std::uint32_t changes = 0;
  };
  static bool has(std::int32_t parameter) noexcept {
    return parameter >= kFirstParameter && parameter <= kLastParameter;
  }
  Parameter& of(std::int32_t number) noexcept {
    return parameters_[static_cast<std::size_t>(number - kFirstParameter)];
  }
  std::int32_t input_byte(std::int32_t number) const noexcept;
  Reply switch_output(std::int32_t number, bool on) noexcept;
  Reply switch_byte(std::int32_t number, std::int32_t bits) noexcept;
  Reply link(const std::int32_t* arguments) noexcept;

  std::int64_t now_ = 0;
  std::array<bool, kInputs> inputs_{};
  std::array<bool, kOutputs> outputs_{};
  std::array<Parameter, 100> parameters_{};
};

}  // namespace lockstep::aposs
