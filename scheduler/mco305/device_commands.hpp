/// What an APOSS program asks, carried out by the device of an MCO 305.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "scheduler/aposs/device.hpp"
#include "tech_objects/mco305/device.hpp"

namespace lockstep {

class DeviceCommands final : public aposs::Device {
 public:
  explicit DeviceCommands(mco305::Device& device) : device_(device) {}

  std::int64_t milliseconds() noexcept override { return device_.milliseconds(); }
  aposs::Reply begin(aposs::Command command, const std::int32_t* arguments,
                     aposs::Arrays& arrays) noexcept override;
  aposs::Reply proceed(aposs::Command command, const std::int32_t* arguments,
                       std::int64_t elapsed) noexcept override;
  void give_up(aposs::Command command) noexcept override;
  bool level(aposs::EdgeSource source, std::int32_t number) noexcept override;
  aposs::PositionReading position(aposs::PositionSource source) noexcept override;
  std::uint32_t changes(std::int32_t parameter) noexcept override {
    return device_.parameters().changes(parameter);
  }
  int take_error() noexcept override { return device_.take_error(); }
  void error_raised(int error) noexcept override;
  void error_cleared() noexcept override { device_.clear_error(); }

  /// An error that has been raised, for whoever tells of it; 0: none.
  int take_raised() noexcept;

 private:
  aposs::Reply motion(aposs::Command command, const std::int32_t* arguments) noexcept;
  aposs::Reply reading(aposs::Command command, const std::int32_t* arguments) noexcept;
  aposs::Reply set(std::int32_t number, std::int32_t value) noexcept;
  aposs::Reply link(const std::int32_t* arguments) noexcept;
  aposs::Reply output_byte(const std::int32_t* arguments) noexcept;

  mco305::Device& device_;
  std::array<int, 8> raised_{};
  std::size_t raised_count_ = 0;
  std::uint32_t latches_ = 0;  // when WAITNDX began
};

}  // namespace lockstep
