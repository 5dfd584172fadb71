/// What an APOSS program asks, carried out by the device of an MCO 305.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "scheduler/aposs/device.hpp"
#include "scheduler/aposs/machine.hpp"
#include "scheduler/mco305/eeprom.hpp"
#include "tech_objects/data_blocks/mco305.hpp"
#include "tech_objects/mco305/device.hpp"

namespace lockstep {

/// An error, and what the program was at.
struct RaisedError {
  int number = 0;    ///< 0: none
  int program = -1;  ///< -1: none
  int line = 0;
};

class DeviceCommands final : public aposs::Device {
 public:
  DeviceCommands(mco305::Device& device, Eeprom& eeprom, Mco305Outside& outside, Mco305ErrorHistory& history)
      : device_(device), eeprom_(eeprom), outside_(outside), history_(history) {}

  /// Whose lines SYSVAR[33] tells.
  void watch(const aposs::Machine& machine) noexcept { machine_ = &machine; }

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

  /// LINKSYSVAR, in each step: every 40 ms one of the links is renewed.
  void refresh_links() noexcept;
  /// A program begins, which has no links yet.
  void begin_program(std::int32_t number) noexcept {
    link_count_ = 0;
    program_ = number;
  }

  /// An error that has been raised, for whoever tells of it; number 0: none.
  RaisedError take_raised() noexcept;
  /// How many were raised and found no space, since it was asked last.
  std::uint32_t take_unheard() noexcept { return std::exchange(unheard_, 0); }

 private:
  aposs::Reply motion(aposs::Command command, const std::int32_t* arguments) noexcept;
  aposs::Reply following(aposs::Command command, const std::int32_t* arguments) noexcept;
  aposs::Reply synchronize_by_markers() noexcept;
  aposs::Reply reading(aposs::Command command, const std::int32_t* arguments) noexcept;
  aposs::Reply communication(aposs::Command command, const std::int32_t* arguments,
                             aposs::Arrays& arrays) noexcept;
  aposs::Reply copy_words(aposs::Command command, const std::int32_t* arguments,
                          aposs::Arrays& arrays) noexcept;
  aposs::Reply drive(aposs::Command command, const std::int32_t* arguments) noexcept;
  aposs::Reply get(std::int32_t number) noexcept;
  aposs::Reply unknown(std::int32_t number) noexcept;
  std::int32_t value_of(int error) noexcept;
  aposs::Reply link_system_variable(const std::int32_t* arguments) noexcept;
  std::int32_t keys() const noexcept;
  aposs::Reply set(std::int32_t number, std::int32_t value) noexcept;
  aposs::Reply link(const std::int32_t* arguments) noexcept;
  aposs::Reply output_byte(const std::int32_t* arguments) noexcept;
  aposs::Reply keeping(aposs::Command command, const std::int32_t* arguments, aposs::Arrays& arrays) noexcept;

  mco305::Device& device_;
  Eeprom& eeprom_;
  const aposs::Machine* machine_ = nullptr;
  std::array<RaisedError, 8> raised_{};
  std::size_t raised_count_ = 0;
  std::uint32_t unheard_ = 0;
  std::uint32_t latches_ = 0;  // when WAITNDX began
  Mco305Outside& outside_;
  Mco305ErrorHistory& history_;
  std::int32_t unknown_ = 0;  // number that is none, for the history
  std::int32_t program_ = -1;
  /// A system variable that an application parameter shows.
  struct Link {
    std::int32_t variable = 0, parameter = 0;
  };
  std::array<Link, mco305::kApplicationParameters> links_{};
  std::size_t link_count_ = 0, next_link_ = 0;
};

}  // namespace lockstep
