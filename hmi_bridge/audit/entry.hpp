/// What the audit log holds of an access.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "tech_objects/types/types.hpp"

namespace lockstep {

/// An access of somebody outside to the machine: a write, a command, or the attempt. Texts may be a
/// stranger's.
struct AuditEntry {
  std::chrono::system_clock::time_point time = std::chrono::system_clock::now();
  std::int64_t tick =
      -1;              ///< whose end the bridge had seen last; what is accepted enters behind it; -1: none
  std::string via;     ///< "modbus" or "lcm"
  std::string from;    ///< address and port, or the serial line
  std::string who;     ///< as it names itself: unit id, number of a panel; may be empty
  std::string target;  ///< tag, axis or address
  std::string action;  ///< such as "write", "jog forward"
  std::string before, after;  ///< values as JSON; empty: there is none
  bool accepted = false;
  std::string why;  ///< of a refusal
  /// What repeats is told together by these two, which have few values: the source, such as an address
  /// without its port, and the subject, such as the tag.
  std::string source, subject;
};

/// A value as JSON: what is no finite number is a string.
std::string audit_value(Value value, Type type);

/// An entry as a line of the log, with its end of line. @param folded entries that it stands for, with itself
std::string audit_line(const AuditEntry& entry, std::uint64_t folded = 1);

/// A time as RFC 3339 has it, in UTC with microseconds.
std::string audit_time(std::chrono::system_clock::time_point time);

}  // namespace lockstep
