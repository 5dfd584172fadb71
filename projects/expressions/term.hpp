/// Typed expressions, and the literals in them that still look for their type.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "projects/literals/types.hpp"
#include "scheduler/expression.hpp"

namespace lockstep {

/// A mistake or a warning in the text of an expression.
struct ExpressionError {
  int column = 1;  ///< from 1, in bytes
  std::string message;
};

/// What is known of the type of a value.
enum class Shape {
  kTyped,    ///< `type`, and nothing else
  kInteger,  ///< integer literals, or an operation on them alone: any number that holds them
  kReal,     ///< an operation in which a real literal has to decide: REAL or LREAL
  kBits,     ///< an operation on bits of literals: any bit string from `type` on
  kText      ///< a text, which is only compared with another one, chosen, or assigned
};

/// A node of the typed tree. A literal, and an operation on nothing but literals, keeps a shape until its
/// place asks for a type ("a literal takes the type that its place asks for, if it fits"); without such a
/// place an integer is a DINT (LINT, ULINT if need be), a real an LREAL, a bit string as narrow as its
/// literals allow.
struct Term {
  enum class Form {
    kLiteral,         ///< `integer`, or `value` (a real, or of `type`)
    kSignal,          ///< `signal`
    kElement,         ///< of `elements` from `signal` on the one with the index operands[0]
    kOperation,       ///< `operation` on `operands`
    kConversion,      ///< `operands[0]` from the representation of `from` to that of `to`
    kSelection,       ///< SEL: operands IN0, IN1, G
    kMultiplexer,     ///< MUX: operands IN0, IN1, …, K
    kText,            ///< `text`
    kTextChoice,      ///< SEL, MUX of texts: operands IN0, IN1, …, and what chooses, of type BOOL or LINT
    kTextComparison,  ///< `operation` (kEqual, kUnequal) on two texts
    kRounding  ///< `operation` (TRUNC, …) on a real: an integer, or in a real place the real without fraction
  };
  Shape shape = Shape::kTyped;
  Form form = Form::kLiteral;
  int column = 1;
  Type type = Type::BOOL;
  Type from = Type::BOOL;  ///< of a conversion; differs from the operand's type where TIME counts as LINT
  Type to = Type::BOOL;
  Value value{};
  Signal signal;
  TextSource text;
  ElementRange elements;
  Operation operation = Operation::kAdd;
  std::vector<Term> operands;
  WideInteger integer = 0;  ///< of an integer literal
  WideInteger lowest = 0;   ///< minimum and maximum integer literal within
  WideInteger highest = 0;
  int division_column = 0;    ///< where the integer division stands that gave this integer; 0: none
  int divisions_by_zero = 0;  ///< found in an integer literal when it was computed
  bool faulty = false;        ///< has been reported already; of no type
};

/// What several values have in common.
struct Common {
  Shape shape = Shape::kTyped;
  Type type = Type::BOOL;
  WideInteger lowest = 0;
  WideInteger highest = 0;
};

/// What a term may become.
Common common_of(const Term& term);
/// What both may become: the smallest common type, or the shape if both are literals; none if nothing.
std::optional<Common> join(const Common& a, const Common& b);
/// How to name a term's type in a message: "DINT", "the literal 300".
std::string describe(const Term& term);
/// How to name what is common.
std::string describe(const Common& common);

/// Gives literals their type and widens values to the types of their places. Reports what does not fit.
class Settling {
 public:
  /// Makes the term one of a type; on failure reports an error and marks the term faulty.
  void settle(Term& term, Type type);
  /// Makes the term one of the type that it has without being asked for one.
  void settle(Term& term);

  void error(int column, std::string message) { errors.push_back({column, std::move(message)}); }

  std::vector<ExpressionError> errors;
  std::vector<ExpressionError> warnings;

 private:
  void widen(Term& term, Type type);
  void settle_integer(Term& term, Type type);
  void settle_literal(Term& term, Type type);
  void settle_rounding(Term& term, Type type);
  void settle_real(Term& term, Type type);
  void settle_bits(Term& term, Type type);
  void settle_values(Term& term, Type type);
  void refuse(Term& term, Type type, const std::string& hint = "");
  void warn_of_division(const Term& term, Type type);
};

/// The type that a term has without being asked for one.
Type default_type(const Term& term);

/// Wraps a term in a conversion between two types' representations.
Term converted(Term term, Type from, Type to);

}  // namespace lockstep
