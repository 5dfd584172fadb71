/// Compiles APOSS programs and runs them against a device that writes down what it is asked for.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "projects/aposs/compiler.hpp"
#include "projects/aposs/listing.hpp"
#include "scheduler/aposs/machine.hpp"
#include "scheduler/aposs/plain_device.hpp"
#include "scheduler/aposs/printed_line.hpp"

namespace lockstep::aposs {

/// Takes every command: what a plain device does not know is written down and takes `busy` milliseconds.
class RecordingDevice : public PlainDevice {
 public:
  std::vector<std::string> commands;
  std::map<Command, std::int32_t> values;  ///< of functions
  std::map<Command, std::int64_t> busy;
  std::map<Command, int> failures;
  std::array<PositionReading, 3> positions{};
  std::array<std::uint32_t, 3> bits{};  ///< by EdgeSource; inputs are those of the plain device
  int asynchronous_error = 0;
  std::vector<int> raised;
  int cleared = 0;
  std::vector<Command> given_up;

  Reply begin(Command command, const std::int32_t* arguments, Arrays& arrays) noexcept override {
    if (const auto failure = failures.find(command); failure != failures.end())
      return Reply::failed(failure->second);
    if (const auto value = values.find(command); value != values.end()) return Reply::done(value->second);
    const Reply plain = PlainDevice::begin(command, arguments, arrays);
    if (plain.kind != Reply::Kind::kRefused && command != Command::kOut) return plain;
    std::string text(row_of(command).name);
    for (std::size_t i = 0; i < row_of(command).arity(); ++i) text += " " + std::to_string(arguments[i]);
    commands.push_back(std::to_string(milliseconds()) + " " + text);
    return busy.contains(command) ? Reply::busy() : Reply::done();
  }
  Reply proceed(Command command, const std::int32_t* arguments, std::int64_t elapsed) noexcept override {
    const auto time = busy.find(command);
    if (time == busy.end()) return PlainDevice::proceed(command, arguments, elapsed);
    return elapsed >= time->second ? Reply::done() : Reply::busy();
  }
  void give_up(Command command) noexcept override { given_up.push_back(command); }
  bool level(EdgeSource source, std::int32_t number) noexcept override {
    if (source == EdgeSource::kInput) return PlainDevice::level(source, number);
    return number >= 1 && number <= 32 && ((bits[static_cast<std::size_t>(source)] >> (number - 1)) & 1) != 0;
  }
  PositionReading position(PositionSource source) noexcept override {
    return positions[static_cast<std::size_t>(source)];
  }
  int take_error() noexcept override { return std::exchange(asynchronous_error, 0); }
  void error_raised(int error) noexcept override { raised.push_back(error); }
  void error_cleared() noexcept override { ++cleared; }
};

/// A program that has been compiled, with its device.
class Running {
 public:
  explicit Running(const std::string& text, std::int32_t time_interrupts = 1)
      : compiled_(compile_program("x.m", text)), machine_(device, arrays, time_interrupts) {
    for (const Message& error : compiled_.errors) ADD_FAILURE() << to_string(compiled_.files, error);
    if (!compiled_.image) return;
    EXPECT_EQ(compiled_.image->fault(), 0);
    EXPECT_EQ(machine_.load(*compiled_.image), 0);
  }

  /// Steps of 1 ms.
  Running& run(int steps, std::int32_t budget = 200) {
    for (int i = 0; i < steps && !machine_.over(); ++i) step(budget);
    return *this;
  }
  void step(std::int32_t budget = 200) {
    if (!compiled_.image) return;
    const std::uint64_t before = machine_.counters().commands;
    machine_.step(budget);
    EXPECT_LE(machine_.counters().commands - before, static_cast<std::uint64_t>(budget));
    Printed item;
    while (machine_.prints().take(item))
      if (append_printed(line_, compiled_.image->texts, item)) lines.push_back(std::exchange(line_, ""));
    device.advance(1);
  }

  std::int32_t operator[](const std::string& name) const {
    for (std::size_t i = 0; compiled_.image && i < compiled_.image->variables.size(); ++i)
      if (folded(compiled_.image->variables[i]) == folded(name)) return machine_.variable(i);
    ADD_FAILURE() << "no variable " << name;
    return 0;
  }
  std::map<std::string, std::int32_t> variables() const {
    std::map<std::string, std::int32_t> all;
    for (std::size_t i = 0; i < compiled_.image->variables.size(); ++i)
      all[compiled_.image->variables[i]] = machine_.variable(i);
    return all;
  }
  const CompiledProgram& compiled() const { return compiled_; }
  Machine& machine() { return machine_; }

  RecordingDevice device;
  Arrays arrays;
  std::vector<std::string> lines;

 private:
  CompiledProgram compiled_;
  Machine machine_;
  std::string line_;
};

/// The value of an expression, by way of a program; `folded` by the compiler if it is constant.
inline std::int32_t value_of(const std::string& expression, const std::string& before = "") {
  return Running(before + "\nresult = " + expression + "\n").run(10)["result"];
}

using Lines = std::vector<std::string>;

/// What the compiler says, one line each; warnings begin with "warning: ".
inline Lines said_of(const std::string& text, const ReadIncluded& read = {}) {
  const CompiledProgram compiled = compile_program("x.m", text, read);
  Lines result;
  for (const Message& error : compiled.errors) result.push_back(to_string(compiled.files, error));
  for (const Message& warning : compiled.warnings)
    result.push_back("warning: " + to_string(compiled.files, warning));
  EXPECT_EQ(compiled.image.has_value(), compiled.errors.empty());
  return result;
}

}  // namespace lockstep::aposs
