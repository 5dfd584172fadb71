/// Tells what the checks of blocks find in the calls of a program.
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "fb/checks/block_checks.hpp"
#include "projects/json/document.hpp"
#include "projects/json/problem.hpp"
#include "scheduler/controller.hpp"

namespace lockstep {

/// Collects the calls of one program as far as their blocks have checks.
class CallChecks {
 public:
  explicit CallChecks(Problems& problems) : problems_(problems) {}

  /// Takes a call whose inputs have been loaded, and looks at it alone.
  /// @param in its inputs @param constants those that are constant
  void add(const JsonValue& in, const Instance& instance,
           std::span<const std::pair<const Pin*, const JsonValue*>> constants);

  /// Behind all calls: looks at those of one type together.
  void look_at_all() const;

 private:
  struct Calls {
    std::vector<WrittenCall> calls;
    std::vector<const JsonValue*> inputs;  // of each
  };

  void tell(const CallWarnings& warnings, std::span<const JsonValue* const> inputs) const;

  Problems& problems_;
  std::map<const BlockChecks*, Calls> calls_;
};

}  // namespace lockstep
