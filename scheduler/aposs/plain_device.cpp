#include "scheduler/aposs/plain_device.hpp"

#include <algorithm>
#include <span>

#include "scheduler/aposs/output_bytes.hpp"

namespace lockstep::aposs {
namespace {

enum DeviceError : int { kUnknownParameter = 112, kLinkFailed = 155 };

}  // namespace

void PlainDevice::set_parameter(std::int32_t number, std::int32_t value) noexcept {
  if (!has(number)) return;
  of(number).value = value;
  ++of(number).changes;
}

std::int32_t PlainDevice::parameter(std::int32_t number) const noexcept {
  return has(number) ? parameters_[static_cast<std::size_t>(number - kFirstParameter)].value : 0;
}

bool PlainDevice::level(EdgeSource source, std::int32_t number) noexcept {
  if (source != EdgeSource::kInput || number < 1 || number > static_cast<std::int32_t>(kInputs)) return false;
  return inputs_[static_cast<std::size_t>(number - 1)];
}

std::uint32_t PlainDevice::changes(std::int32_t parameter) noexcept {
  return has(parameter) ? of(parameter).changes : 0;
}

// Byte 0: inputs 1 to 8, the lowest first; 1: 33 (lowest), 32, 29, 27, 19, 18; 2: 9 to 12.
std::int32_t PlainDevice::input_byte(std::int32_t number) const noexcept {
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

Reply PlainDevice::switch_output(std::int32_t number, bool on) noexcept {
  constexpr std::int32_t kRelays[] = {3401, 3405, 3410};  // X34/1, X34/5, X34/10
  for (std::int32_t i = 0; i < 3; ++i)
    if (number == kRelays[i]) number = 30 + i;
  if (number < 1 || number > static_cast<std::int32_t>(kOutputs)) return Reply::failed(171);
  outputs_[static_cast<std::size_t>(number - 1)] = on;
  return Reply::done();
}

Reply PlainDevice::switch_byte(std::int32_t number, std::int32_t bits) noexcept {
  const std::span<const std::int32_t> outputs = outputs_of_byte(number);
  for (const std::int32_t output : outputs) {
    switch_output(output, (bits & 1) != 0);
    bits >>= 1;
  }
  return outputs.empty() ? Reply::failed(171) : Reply::done();
}

// LINKGPAR: the stored value is brought into the limits.
Reply PlainDevice::link(const std::int32_t* arguments) noexcept {
  if (!has(arguments[0]) || arguments[2] > arguments[3]) return Reply::failed(kLinkFailed);
  std::int32_t& value = of(arguments[0]).value;
  value = std::clamp(value, arguments[2], arguments[3]);
  return Reply::done();
}

Reply PlainDevice::begin(Command command, const std::int32_t* arguments, Arrays&) noexcept {
  switch (command) {
    case Command::kIn:
      return Reply::done(level(EdgeSource::kInput, arguments[0]) ? 1 : 0);
    case Command::kInb:
      return Reply::done(input_byte(arguments[0]));
    case Command::kOut:
      return switch_output(arguments[0], arguments[1] != 0);
    case Command::kOutb:
      return switch_byte(arguments[0], arguments[1]);
    case Command::kGet:
      if (has(arguments[0])) return Reply::done(of(arguments[0]).value);
      return arguments[0] < 1000 ? Reply::failed(kUnknownParameter) : Reply::refused();
    case Command::kSet:
      if (!has(arguments[0]))
        return arguments[0] < 1000 ? Reply::failed(kUnknownParameter) : Reply::refused();
      of(arguments[0]).value = arguments[1];
      return Reply::done();
    case Command::kLinkgpar:
      return link(arguments);
    case Command::kInkey:
      return arguments[0] < 0 ? Reply::done() : Reply::busy();
    case Command::kGetvel:
      return Reply::busy();
    case Command::kSave:
    case Command::kSaveprom:
      return Reply::done();
    default:
      return Reply::refused();
  }
}

Reply PlainDevice::proceed(Command command, const std::int32_t* arguments, std::int64_t elapsed) noexcept {
  // There are no keys: INKEY waits for its time, and for ever without one.
  const bool for_ever = command == Command::kInkey && arguments[0] == 0;
  return !for_ever && elapsed >= arguments[0] ? Reply::done() : Reply::busy();
}

}  // namespace lockstep::aposs
