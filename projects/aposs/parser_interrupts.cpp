// ON …, DISABLE, ENABLE.
#include "projects/aposs/interrupt_classes.hpp"
#include "projects/aposs/parameter_names.hpp"
#include "projects/aposs/parser.hpp"
#include "projects/json/problem.hpp"
#include "scheduler/aposs/arithmetic.hpp"

namespace lockstep::aposs {
namespace {

constexpr std::string_view kKinds[] = {"ERROR",   "INT",   "APOS", "MAPOS",  "MCPOS", "COMBIT",
                                       "STATBIT", "PARAM", "TIME", "PERIOD", "DELETE"};

}  // namespace

void Parser::on_statement() {
  const Place place = take().place;
  const bool is_signed = at_symbol("+") || at_symbol("-");
  const std::string word = peek(is_signed ? 1 : 0).folded;
  if (word == "APOS" || word == "MAPOS" || word == "MCPOS") return on_position(place);
  for (const CommandRow& row : commands())
    if (row.refusal != Refusal::kNone && row.name == "ON " + word) refuse(row, place);
  if (accept_word("ERROR")) {
    expect_word("GOSUB", "behind ON ERROR");
    return subprogram_reference(emitter_.emit(place, Operation::kOnError));
  }
  if (accept_word("INT")) return on_source(place, Command::kOnInt, Operation::kOnInput);
  if (accept_word("COMBIT")) return on_source(place, Command::kOnCombit, Operation::kOnCombit);
  if (accept_word("STATBIT")) return on_source(place, Command::kOnStatbit, Operation::kOnStatbit);
  if (accept_word("TIME")) return on_source(place, Command::kOnTime, Operation::kOnTime);
  if (accept_word("PERIOD")) return on_source(place, Command::kOnPeriod, Operation::kOnPeriod);
  if (accept_word("PARAM")) return on_parameter(place);
  if (accept_word("DELETE")) return on_delete(place);
  fail(peek().place, "ON " + peek().text + ": " + shown() + " is no interrupt" + did_you_mean(word, kKinds) +
                         "; allowed: " + list_of(kKinds));
}

void Parser::on_source(const Place& place, Command command, Operation operation) {
  const ExpressionPointer number = argument("ON");
  check(command, {number.get()});
  if (command == Command::kOnInt && number->kind == Expression::Kind::kConstant)
    uses_.inputs.insert(absolute(number->value));
  const Cell cell = value(*number);
  expect_word("GOSUB", "behind what the interrupt watches");
  subprogram_reference(emitter_.emit(place, operation, cell));
}

void Parser::on_position(const Place& place) {
  const bool has_sign = at_symbol("+") || at_symbol("-");
  const bool negative = at_symbol("-");
  if (has_sign) take();
  const Token& source = take();
  const std::string name = folded(source.text);
  if (!has_sign && name == "MCPOS")
    messages_.warn(source.place, "ON MCPOS without a sign is taken for ON +MCPOS");
  else if (!has_sign)
    fail(source.place,
         "ON " + name + ": the sign says in which direction; allowed: ON +" + name + ", ON -" + name);
  const std::uint32_t kind = name == "APOS" ? 0 : name == "MAPOS" ? 1 : 2;
  const ExpressionPointer position = argument("ON " + name);
  if (at_word("SETOUT")) refuse(row_of(Command::kOnPosintSetout), peek().place);
  const Cell cell = value(*position);
  expect_word("GOSUB", "behind the position");
  subprogram_reference(emitter_.emit(place, Operation::kOnPosition, kind * 2 + (negative ? 1 : 0), cell));
}

void Parser::on_parameter(const Place& place) {
  const bool by_name = peek().kind == Token::Kind::kName;
  // Those of the drive count as well, so a number is taken as it is.
  const ExpressionPointer number = by_name ? parameter("ON PARAM") : drive_parameter("ON PARAM");
  check(Command::kOnParam, {number.get()});
  const Cell cell = value(*number);
  expect_word("GOSUB", "behind the parameter");
  subprogram_reference(emitter_.emit(place, Operation::kOnParameter, cell));
}

// The position is published as without meaning.
void Parser::on_delete(const Place& place) {
  argument("ON DELETE");
  expect_word("GOSUB", "behind ON DELETE and a number");
  subprogram_reference(emitter_.emit(place, Operation::kOnDelete));
}

void Parser::disable_statement(Operation operation, const Place& place) {
  const ExpressionPointer which =
      word_argument(kInterruptClassNames, operation == Operation::kDisable ? "DISABLE" : "ENABLE");
  emitter_.emit(place, operation, static_cast<std::uint32_t>(which->value));
}

}  // namespace lockstep::aposs
