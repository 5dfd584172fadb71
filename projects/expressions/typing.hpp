/// Gives every node of a syntax tree its type, by the rules for operators and standard functions.
#pragma once

#include <string_view>
#include <vector>

#include "projects/expressions/parser.hpp"
#include "projects/expressions/scope.hpp"
#include "projects/expressions/term.hpp"

namespace lockstep {

class Typing {
 public:
  explicit Typing(const Scope& scope) : scope_(scope) {}

  /// The typed tree of a syntax tree; faulty, with errors reported, where it has no type.
  Term type(const Syntax& syntax);

  Settling& settling() { return settling_; }

 private:
  // Operators (expression_typing.cpp)
  Term reference(const Syntax& syntax);
  Term unary(std::string_view text, int column, Term operand);
  Term binary(Operation operation, std::string_view text, int column, Term left, Term right);
  Term arithmetic(Operation operation, std::string_view text, int column, Term left, Term right);
  Term time_arithmetic(Operation operation, std::string_view text, int column, Term left, Term right);
  Term scaled_time(Operation operation, int column, Term time, Term number);
  void warn_of_zero(int column);
  Term folded(Operation operation, int column, const Term& left, const Term& right);
  Term real_operation(Operation operation, std::string_view text, int column, std::vector<Term> operands);
  Term comparison(Operation operation, std::string_view text, int column, Term left, Term right);
  Term logic(Operation operation, std::string_view text, int column, std::vector<Term> operands);
  Term operation(Operation operation, int column, const Common& common, std::vector<Term> operands);
  Term no_meaning(std::string_view text, int column, const std::vector<Term>& operands,
                  std::string_view allowed);
  std::optional<Common> join_all(const Term* first, std::size_t count) const;

  // Standard functions (expression_functions.cpp)
  Term call(const Syntax& syntax);
  Term conversion(const Syntax& syntax, Term input, std::optional<Type> from, Type to);
  Term extremum(Operation operation, const Syntax& syntax, std::vector<Term> inputs);
  Term absolute(const Syntax& syntax, std::vector<Term> inputs);
  Term choice(const Syntax& syntax, std::vector<Term> inputs, bool binary_choice);
  Term shift(Operation operation, const Syntax& syntax, std::vector<Term> inputs);
  Term rounding(Operation operation, const Syntax& syntax, Term input);
  std::optional<std::vector<Term>> inputs_in_order(const Syntax& syntax, std::string_view names, bool more);

  Term faulty(int column) const;
  Term text_term(int column, TextSource source) const;

  const Scope& scope_;
  Settling settling_;
};

}  // namespace lockstep
