/// What the compiler of APOSS says of a program.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scheduler/aposs/image.hpp"

namespace lockstep::aposs {

struct Message {
  Place place;
  std::string text;  ///< what stands there, what is allowed; one line
};

/// Collects messages in the order in which they are found; errors are counted on beyond those that are kept.
class Messages {
 public:
  static constexpr std::size_t kMaximumKept = 20;

  void error(const Place& place, std::string text) {
    ++errors_found_;
    if (errors_.size() < kMaximumKept) errors_.push_back({place, std::move(text)});
  }
  void warn(const Place& place, std::string text) {
    if (warnings_.size() < kMaximumKept) warnings_.push_back({place, std::move(text)});
  }
  std::size_t errors_found() const noexcept { return errors_found_; }
  std::vector<Message> take_errors() noexcept { return std::move(errors_); }
  std::vector<Message> take_warnings() noexcept { return std::move(warnings_); }

 private:
  std::vector<Message> errors_, warnings_;
  std::size_t errors_found_ = 0;
};

}  // namespace lockstep::aposs
