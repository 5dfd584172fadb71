/// Expressions of APOSS as a tree, before they become instructions.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "projects/aposs/message.hpp"
#include "scheduler/aposs/image.hpp"

namespace lockstep::aposs {

struct Expression;
using ExpressionPointer = std::unique_ptr<Expression>;

struct Expression {
  enum class Kind : std::uint8_t {
    kConstant,  ///< `value`
    kVariable,  ///< `name`
    kElement,   ///< of the array `number`; `operands[0]` is the index
    kCommand,   ///< `command` with its arguments
    kOperation  ///< `operation`: TIME, ERRNO; one operand; two
  };
  Kind kind = Kind::kConstant;
  Place place;
  std::int32_t value = 0;
  std::string name;     ///< in upper case
  std::string written;  ///< as it stands there
  std::uint16_t number = 0;
  Command command{};
  Operation operation{};
  bool in_parentheses = false;
  std::vector<ExpressionPointer> operands;
};

ExpressionPointer constant(const Place& place, std::int32_t value);
/// An operation on one or two operands; of constants it is their result, unless it would divide by 0.
ExpressionPointer apply(const Place& place, Operation operation, ExpressionPointer a,
                        ExpressionPointer b = nullptr);

}  // namespace lockstep::aposs
