// How calls of the standard functions are typed.
#include "projects/expressions/functions.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fb/block.hpp"
#include "projects/expressions/habits.hpp"
#include "projects/expressions/typing.hpp"
#include "projects/json/problem.hpp"
#include "projects/literals/types.hpp"

namespace lockstep {
namespace {

std::vector<std::string_view> split(std::string_view list) {
  std::vector<std::string_view> parts;
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    parts.push_back(list.substr(0, comma));
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  return parts;
}

/// What is said of a name that is called as a function and is none: what is written in its place, or what is
/// there. @param name in capital letters
std::string unknown_function(std::string_view name) {
  const std::string begin = "the function " + quoted(name) + " is unknown";
  if (const Habit* const habit = habit_of(name)) return begin + "; here: " + std::string(habit->here);
  if (const BlockType* const block = find_block_type(name))
    return quoted(name) + " is no function but a block, called by an entry of its own, { \"fb\": \"" +
           std::string(block->name) + "\", \"name\": \"x\", \"in\": { … } }; its outputs are read as x.Pin";
  if (tag_type(name)) return begin + "; a value of a type is made by TO_" + std::string(name) + "(IN)";
  std::string all;
  std::vector<std::string_view> names;
  for (const StandardFunction& function : standard_functions()) {
    all += " " + std::string(function.name);
    names.push_back(function.name);
  }
  return begin + did_you_mean(name, names) + "; there are" + all + ", TO_type and type_TO_type";
}

}  // namespace

const StandardFunction* find_function(std::string_view name) noexcept {
  const auto functions = standard_functions();
  const auto found = std::ranges::find(functions, name, &StandardFunction::name);
  return found == functions.end() ? nullptr : &*found;
}

std::string signature(const StandardFunction& function) {
  std::string text = std::string(function.name) + "(";
  for (const std::string_view input : split(function.inputs))
    text += (text.ends_with('(') ? "" : ", ") + std::string(input);
  return text + (function.more ? ", …)" : ")");
}

std::optional<Conversion> conversion_named(std::string_view name) noexcept {
  const bool any = name.starts_with("TO_");
  const std::size_t middle = any ? 0 : name.find("_TO_");
  if (middle == std::string_view::npos) return std::nullopt;
  const auto from = tag_type(name.substr(0, middle));
  const auto to = tag_type(name.substr(middle + (any ? 3 : 4)));
  if (!to || (!any && !from)) return std::nullopt;
  return Conversion{any ? std::nullopt : from, *to};
}

/// Types the inputs in the order of the declaration; none, with an error, if they do not match it.
std::optional<std::vector<Term>> Typing::inputs_in_order(const Syntax& syntax, std::string_view names,
                                                         bool more) {
  const std::vector<std::string_view> declared = split(names);
  const std::size_t count = syntax.operands.size();
  if (count < declared.size() || count > (more ? kMaximumInputs : declared.size())) {
    settling_.error(syntax.column, syntax.text + " takes " + std::to_string(declared.size()) +
                                       (more ? " to " + std::to_string(kMaximumInputs) : "") + " input" +
                                       (declared.size() == 1 ? "" : "s") + " (" + std::string(names) +
                                       "), not " + std::to_string(count));
    return std::nullopt;
  }
  const auto name_at = [&](std::size_t i) {
    if (i < declared.size()) return std::string(declared[i]);
    const int last = declared.back().back() - '0';
    return "IN" + std::to_string(last + static_cast<int>(i + 1 - declared.size()));
  };
  std::vector<Term> inputs;
  bool good = true;
  for (std::size_t i = 0; i < count; ++i) {
    const Syntax* input = &syntax.operands[i];
    if (!syntax.names.empty()) {
      const auto found = std::ranges::find(syntax.names, name_at(i));
      if (found == syntax.names.end()) {
        settling_.error(syntax.column, syntax.text + " needs its input " + name_at(i) + "; its inputs are " +
                                           std::string(names) + (more ? ", …" : ""));
        return std::nullopt;
      }
      input = &syntax.operands[static_cast<std::size_t>(found - syntax.names.begin())];
    }
    inputs.push_back(type(*input));
    good = good && !inputs.back().faulty;
  }
  return good ? std::optional(std::move(inputs)) : std::nullopt;
}

Term Typing::call(const Syntax& syntax) {
  if (const auto found = conversion_named(syntax.text)) {
    auto inputs = inputs_in_order(syntax, "IN", false);
    return inputs ? conversion(syntax, std::move(inputs->front()), found->from, found->to)
                  : faulty(syntax.column);
  }
  const StandardFunction* const function = find_function(syntax.text);
  if (function == nullptr) {
    settling_.error(syntax.column, unknown_function(syntax.text));
    return faulty(syntax.column);
  }
  auto found = inputs_in_order(syntax, function->inputs, function->more);
  if (!found) return faulty(syntax.column);
  std::vector<Term>& inputs = *found;
  const int column = syntax.column;
  switch (function->kind) {
    case FunctionKind::real:
      return real_operation(function->operation, syntax.text, column, std::move(inputs));
    case FunctionKind::extremum:
      return extremum(function->operation, syntax, std::move(inputs));
    case FunctionKind::limit: {
      // MIN(MAX(IN, MN), MX): with MN > MX the upper limit holds.
      std::vector<Term> ordered;
      for (const std::size_t i : {1u, 0u, 2u}) ordered.push_back(std::move(inputs[i]));
      return extremum(Operation::kMinimum, syntax, std::move(ordered));
    }
    case FunctionKind::select:
    case FunctionKind::multiplex:
      return choice(syntax, std::move(inputs), function->kind == FunctionKind::select);
    case FunctionKind::shift:
      return shift(function->operation, syntax, std::move(inputs));
    case FunctionKind::rounding:
      return rounding(function->operation, syntax, std::move(inputs.front()));
    case FunctionKind::move:
      return std::move(inputs.front());
    case FunctionKind::absolute:
      return absolute(syntax, std::move(inputs));
    case FunctionKind::arithmetic:
      break;
  }
  Term result = std::move(inputs.front());
  for (std::size_t i = 1; i < inputs.size(); ++i)
    result = binary(function->operation, syntax.text, column, std::move(result), std::move(inputs[i]));
  return result;
}

Term Typing::conversion(const Syntax& syntax, Term input, std::optional<Type> from, Type to) {
  const bool literal =
      input.shape == Shape::kInteger && input.form == Term::Form::kRounding && is_numeric(to);
  if (from)
    settling_.settle(input, *from);
  else if (literal)
    settling_.settle(input, to);  // TO_LINT(TRUNC(x)) is not limited to DINT on its way
  else
    settling_.settle(input);
  if (input.faulty) return input;
  if (!convertible(input.type, to)) {
    std::vector<Term> inputs;
    inputs.push_back(std::move(input));
    return no_meaning(syntax.text, syntax.column, inputs, "there is no such conversion");
  }
  const Type source = input.type;
  Term term = converted(std::move(input), source, to);
  term.column = syntax.column;
  return term;
}

Term Typing::extremum(Operation operation, const Syntax& syntax, std::vector<Term> inputs) {
  const auto common = join_all(inputs.data(), inputs.size());
  if (!common || (common->shape == Shape::kTyped && common->type == Type::BOOL))
    return no_meaning(syntax.text, syntax.column, inputs,
                      "allowed are numbers, TIME and bit strings of a common type");
  if (syntax.text != "LIMIT") return this->operation(operation, syntax.column, *common, std::move(inputs));
  std::vector<Term> lower;
  lower.push_back(std::move(inputs[0]));
  lower.push_back(std::move(inputs[1]));
  std::vector<Term> upper;
  upper.push_back(this->operation(Operation::kMaximum, syntax.column, *common, std::move(lower)));
  upper.push_back(std::move(inputs[2]));
  return this->operation(operation, syntax.column, *common, std::move(upper));
}

Term Typing::absolute(const Syntax& syntax, std::vector<Term> inputs) {
  Term& input = inputs.front();
  if (input.shape == Shape::kInteger && input.form == Term::Form::kLiteral)
    return unary(input.integer < 0 ? "-" : "+", syntax.column, std::move(input));
  const Common common = common_of(input);
  if (common.shape == Shape::kTyped ? !is_numeric(common.type)
                                    : common.shape == Shape::kBits || common.shape == Shape::kText)
    return no_meaning(syntax.text, syntax.column, inputs, "allowed are numbers");
  return operation(Operation::kAbsolute, syntax.column, common, std::move(inputs));
}

/// SEL and MUX: the chooser comes first in the text and last in the code.
Term Typing::choice(const Syntax& syntax, std::vector<Term> inputs, bool binary_choice) {
  Term chooser = std::move(inputs.front());
  inputs.erase(inputs.begin());
  const auto is_text = [](const Term& input) { return input.shape == Shape::kText; };
  if (std::ranges::all_of(inputs, is_text)) {
    settling_.settle(chooser, binary_choice ? Type::BOOL : Type::LINT);
    if (chooser.faulty) return faulty(syntax.column);
    Term term = text_term(syntax.column, {});
    term.form = Term::Form::kTextChoice;
    term.operands = std::move(inputs);
    term.operands.push_back(std::move(chooser));
    return term;
  }
  const auto common = join_all(inputs.data(), inputs.size());
  if (!common)
    return no_meaning(syntax.text, syntax.column, inputs, "the inputs to choose from need a common type");
  settling_.settle(chooser, binary_choice ? Type::BOOL : Type::LINT);
  Term term = operation(Operation::kAnd, syntax.column, *common, std::move(inputs));
  term.form = binary_choice ? Term::Form::kSelection : Term::Form::kMultiplexer;
  term.faulty = term.faulty || chooser.faulty;
  term.operands.push_back(std::move(chooser));
  return term;
}

Term Typing::shift(Operation operation, const Syntax& syntax, std::vector<Term> inputs) {
  Term count = std::move(inputs.back());
  inputs.pop_back();
  if (inputs.front().shape == Shape::kTyped && inputs.front().type == Type::BOOL)
    return no_meaning(syntax.text, syntax.column, inputs,
                      "allowed are bit strings (BYTE, WORD, DWORD, LWORD)");
  settling_.settle(count, Type::LINT);
  Term term = logic(operation, syntax.text, syntax.column, std::move(inputs));
  if (term.faulty || count.faulty) return faulty(syntax.column);
  term.operands.push_back(std::move(count));
  return term;
}

Term Typing::rounding(Operation operation, const Syntax& syntax, Term input) {
  std::vector<Term> inputs;
  inputs.push_back(std::move(input));
  Term term = real_operation(operation, syntax.text, syntax.column, std::move(inputs));
  if (term.faulty) return term;
  term.form = Term::Form::kRounding;
  term.shape = Shape::kInteger;
  return term;
}

}  // namespace lockstep
