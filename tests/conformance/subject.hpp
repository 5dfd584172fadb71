/// A block instance under test, handled through its declared pins alone.
#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include "fb/block.hpp"
#include "tech_objects/axis/axis.hpp"

namespace lockstep::test {

/// A number as the value of a type.
inline Value value_of(Type type, double number) noexcept {
  Value value{};
  if (is_real(type))
    value.r = number;
  else if (is_signed_integer(type) || type == Type::TIME)
    value.i = static_cast<std::int64_t>(number);
  else
    value.u = number < 0.0 ? 0 : static_cast<std::uint64_t>(number);
  return value;
}

class Subject {
 public:
  explicit Subject(const BlockType& type)
      : type_(&type),
        block_(type.create()),
        done_(output("Done")),
        busy_(output("Busy")),
        aborted_(output("CommandAborted")),
        end_of_profile_(output("EndOfProfile")),
        error_(output("Error")),
        error_id_(output("ErrorID")) {
    for (const char* name : {"Execute", "Enable", "JogForward"})
      if (start_ == nullptr) start_ = type.find_pin(name);
  }

  const BlockType& type() const noexcept { return *type_; }
  Block& block() noexcept { return *block_; }
  std::string name() const { return std::string(type_->name); }

  /// Whether the block moves or manages a technology object.
  bool uses_objects() const noexcept {
    return std::any_of(type_->pins.begin(), type_->pins.end(),
                       [](const Pin& pin) { return pin.type == Type::AXIS; });
  }
  /// Whether its jobs are those of an axis, which disabling it ends.
  bool acts_on_axis() const noexcept {
    return std::any_of(type_->pins.begin(), type_->pins.end(),
                       [](const Pin& pin) { return among(ObjectKind::TO_SynchronousAxis, pin.objects); });
  }
  /// Whether a rising edge starts a job, so that its end is shown by Done, CommandAborted or Error.
  bool starts_by_edge() const noexcept { return start_ != nullptr && start_->name == "Execute"; }
  /// Whether the block runs jobs, which another job or disabling can end.
  bool has_jobs() const noexcept { return aborted_ != nullptr; }
  /// Whether an output tells that the aim of a job is met.
  bool has_aim() const noexcept {
    return done_ != nullptr || std::any_of(type_->pins.begin(), type_->pins.end(), [](const Pin& pin) {
             return pin.pin_class == PinClass::output && pin.name.starts_with("In");
           });
  }
  /// Whether the block enables the axis itself.
  bool powers() const noexcept { return type_->name == "MC_Power"; }

  /// One call of the block; tells what the outputs do that they must not, nullptr if nothing.
  const char* call(std::int64_t now) noexcept {
    const bool execute = on(start_);
    const bool rising = execute && !last_execute_;
    const bool was_busy = busy(), was_done = done(), was_aborted = aborted(), was_error = error();
    last_execute_ = execute;
    block_->call(now);
    if (const char* wrong = wrong_outputs()) return wrong;
    if (!starts_by_edge()) return nullptr;
    if (rising) return busy() || ended() ? nullptr : "a request is not answered";
    const bool was_ended = was_done || was_aborted || was_error;
    if (was_busy) return busy() || ended() ? nullptr : "a job vanishes without an end";
    if (busy()) return "Busy without a request";
    if (!was_ended) return ended() ? "an end without a job" : nullptr;
    if (!execute) return ended() ? "an end outlasts its request and its call" : nullptr;
    const bool same = was_done == done() && was_aborted == aborted() && was_error == error();
    return same ? nullptr : "an end changes while Execute is TRUE";
  }

  /// Sets the pin that starts the block.
  void start(bool on) noexcept { store(*start_, on ? 1.0 : 0.0); }
  const Pin* start_pin() const noexcept { return start_; }
  bool on_start() noexcept { return on(start_); }

  void set(std::string_view pin, double number) noexcept { store(*type_->find_pin(pin), number); }
  void store(const Pin& pin, double number) noexcept {
    pin.signal(*block_).store(value_of(pin.type, number));
  }
  double number(const Pin& pin) noexcept { return as_double(pin.signal(*block_).load(), pin.type); }
  /// A pin holds the address of an object, which is that of its base as well.
  void wire(const Pin& pin, TechnologyObject* object) noexcept { point(pin, object); }
  void wire_array(const Pin& pin, const Array* array) noexcept { point(pin, array); }

  bool busy() noexcept { return on(busy_); }
  /// MC_CamIn has no Done: it ends without an error at the end of a cam that is passed once.
  bool done() noexcept { return on(done_) || (on(end_of_profile_) && !busy() && !aborted() && !error()); }
  bool aborted() noexcept { return on(aborted_); }
  bool error() noexcept { return on(error_); }
  WORD error_id() noexcept {
    return error_id_ == nullptr ? WORD{} : static_cast<WORD>(error_id_->signal(*block_).load().u);
  }
  bool ended() noexcept { return done() || aborted() || error(); }

  /// Whether an output such as InVelocity, InGear or Status tells that the aim of the block is met.
  bool in_effect() noexcept {
    for (const Pin& pin : type_->pins)
      if (pin.pin_class == PinClass::output && pin.type == Type::BOOL &&
          (pin.name.starts_with("In") || pin.name == "Status") && on(&pin))
        return true;
    return false;
  }

  /// What is wrong with the outputs as they stand; nullptr if nothing is.
  const char* wrong_outputs() noexcept {
    if (error_ == nullptr) return nullptr;
    if (error() != (error_id() != WORD{})) return "ErrorID differs from 0 if and only if Error";
    if (done_ == nullptr && aborted_ == nullptr) return nullptr;  // Busy while enabled, even with an error
    if (busy() + done() + aborted() + error() > 1)
      return "Busy, Done, CommandAborted and Error exclude each other";
    if ((in_effect() || on(output("StartSync"))) && !busy())
      return "an output that tells of a running job while the block is not Busy";
    return nullptr;
  }

 private:
  const Pin* output(std::string_view name) const noexcept {
    const Pin* pin = type_->find_pin(name);
    return pin != nullptr && pin->pin_class == PinClass::output ? pin : nullptr;
  }
  void point(const Pin& pin, const void* address) noexcept {
    std::memcpy(pin.address(*block_), &address, sizeof address);
  }
  bool on(const Pin* pin) noexcept { return pin != nullptr && pin->signal(*block_).load().u != 0; }

  const BlockType* type_;
  std::unique_ptr<Block> block_;
  const Pin* start_ = nullptr;
  bool last_execute_ = false;
  const Pin *done_, *busy_, *aborted_, *end_of_profile_, *error_, *error_id_;
};

}  // namespace lockstep::test
