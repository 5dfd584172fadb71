// Assignments, commands and their code.
#include <algorithm>

#include "projects/aposs/parser.hpp"
#include "projects/json/problem.hpp"

namespace lockstep::aposs {
namespace {

constexpr std::uint32_t kLargestArray = 1'000'000;

Operation put(Operation part) {
  return part == Operation::kBit    ? Operation::kPutBit
         : part == Operation::kByte ? Operation::kPutByte
                                    : Operation::kPutWord;
}

}  // namespace

void Parser::dim_statement() {
  const Token& begin = take();
  if (dim_is_over_)
    messages_.error(begin.place,
                    "DIM behind another statement; allowed: DIM at the beginning of the program");
  do {
    const Token& name = peek();
    if (name.kind != Token::Kind::kName) fail_here("the name of an array");
    if (is_reserved(name.folded))
      fail(name.place, quote(name.text) + " is a word of the language and no array");
    take();
    expect_symbol("[", "and the number of elements behind the name of an array");
    const Token& size = peek();
    if (size.kind != Token::Kind::kNumber || size.number < 1 ||
        static_cast<std::uint32_t>(size.number) > kLargestArray)
      fail_here("a number of elements from 1 to " + std::to_string(kLargestArray));
    take();
    expect_symbol("]", "behind the number of elements");
    if (at_symbol("["))
      fail(peek().place, "arrays of two dimensions are of the later edition and not built yet");
    const auto number = static_cast<std::uint16_t>(arrays_.size());
    const bool fresh = array_numbers_.try_emplace(name.folded, number).second;
    if (!fresh || assigned_.contains(name.folded))
      messages_.error(name.place, quote(name.text) + (fresh ? " is a variable too" : " is declared twice"));
    if (fresh) arrays_.push_back({name.text, static_cast<std::uint32_t>(size.number)});
    if (arrays_.size() > 1000) fail(name.place, "too many arrays");
  } while (accept_symbol(","));
}

void Parser::assignment() {
  const Token& name = peek();
  const bool is_target = at_symbol("=", 1) || at_symbol(".", 1) || at_symbol("[", 1);
  if (is_reserved(name.folded))
    fail(name.place, quote(name.text) + " cannot begin a statement; allowed: a command, a label, a variable");
  if (at_symbol("++", 1) || at_symbol("--", 1))
    fail(peek(1).place, quote(peek(1).text) + " is of the later edition and not built yet; allowed: " +
                            name.text + " = " + name.text + " + 1");
  if (const std::string two = commands_of_first_word(name.folded); !is_target && !two.empty())
    fail(name.place, "there is no command " + quote(name.text) + " alone; allowed: " + two + ", " +
                         name.text + ": as a label, " + name.text + " = as a variable");
  if (!is_target)
    fail(name.place, "there is no command " + quote(name.text) + nearest_name(name.folded, {}) +
                         "; allowed: a command, " + name.text + ": as a label, " + name.text +
                         " = as a variable");
  take();
  if (array_numbers_.contains(name.folded)) return assign_element(name);
  if (at_symbol("["))
    fail(name.place, "there is no array " + quote(name.text) + "; arrays stand in DIM at the beginning");
  assign_variable(name);
}

void Parser::assign_variable(const Token& name) {
  const Cell cell = emitter_.variable(name.folded, name.text);
  if (accept_symbol(".")) {
    auto [part, number] = selector();
    expect_symbol("=", "behind what is assigned to");
    const ExpressionPointer right = expression();
    if (part == Operation::kMove) return into(cell, *right);
    const Cell which = value(*number);
    emitter_.emit(name.place, put(part), cell, which, value(*right));
    return;
  }
  expect_symbol("=", "behind what is assigned to");
  into(cell, *expression());
}

void Parser::assign_element(const Token& name) {
  const std::uint32_t array = array_numbers_.at(name.folded);
  const ExpressionPointer index = bracketed_index(name.text);
  if (accept_symbol(".")) {
    auto [part, number] = selector();
    expect_symbol("=", "behind what is assigned to");
    const ExpressionPointer right = expression();
    const Cell at = value(*index), which = value(*number), what = value(*right),
               element = emitter_.temporary();
    emitter_.emit(name.place, Operation::kLoadElement, element, array, at);
    if (part == Operation::kMove)
      emitter_.emit(name.place, Operation::kMove, element, what);
    else
      emitter_.emit(name.place, put(part), element, which, what);
    emitter_.emit(name.place, Operation::kStoreElement, array, at, element);
    return;
  }
  expect_symbol("=", "behind what is assigned to");
  const ExpressionPointer right = expression();
  const Cell at = value(*index);
  emitter_.emit(name.place, Operation::kStoreElement, array, at, value(*right));
}

// SYSVAR[n] = …, PCD[n] = …, PCD[n].3 = …
void Parser::assign_pseudo_array(Command read, Command write) {
  const Token& name = take();
  std::vector<ExpressionPointer> operands;
  operands.push_back(bracketed_index(name.text));
  if (accept_symbol(".")) {
    check(write, {operands[0].get()});
    auto [part, number] = selector();
    expect_symbol("=", "behind what is assigned to");
    const ExpressionPointer right = expression();
    const Cell both = emitter_.temporary(2);
    into(both, *operands[0]);
    const Cell which = value(*number), what = value(*right);
    emitter_.emit(name.place, Operation::kCommand, static_cast<std::uint32_t>(read), both, both.behind(1));
    if (part == Operation::kMove)
      emitter_.emit(name.place, Operation::kMove, both.behind(1), what);
    else
      emitter_.emit(name.place, put(part), both.behind(1), which, what);
    emitter_.emit(name.place, Operation::kCommand, static_cast<std::uint32_t>(write), both, Cell{});
    return;
  }
  expect_symbol("=", "behind what is assigned to");
  operands.push_back(expression());
  emit_command(name.place, write, operands);
}

/// Returns if there is nothing to refuse.
void Parser::refuse(const CommandRow& row, const Place& place) {
  const std::string name(row.name);
  if (row.later_edition && !later_edition_)
    fail(place, name + " is of the later edition; allowed with firmware 5.00");
  switch (row.refusal) {
    case Refusal::kLaterEdition:
      fail(place, name + " is of the later edition (firmware from 5.00) and not built yet");
    case Refusal::kNoCan:
      fail(place, name + " needs a CAN bus, which Lockstep does not have");
    case Refusal::kNoTelegrams:
      fail(place, name + " speaks to an encoder in telegrams that are not published");
    case Refusal::kNoSerialLine:
      fail(place, name + " reads the serial line, which Lockstep does not have");
    case Refusal::kNone:
      break;
  }
}

void Parser::after_argument(const CommandRow& row) {
  if (!on_same_line() || peek().kind != Token::Kind::kSymbol || at_symbol("}")) return;
  static constexpr std::string_view kOperators = "+-*%^&|<>=.";
  if (kOperators.find(peek().text[0]) != kOperators.npos)
    fail(peek().place, std::string(row.name) +
                           ": an expression as an argument stands in parentheses, as in " +
                           std::string(row.name) + " (a " + peek().text + " b)");
  fail(peek().place, shown() + " behind " + std::string(row.name) + " cannot be read");
}

void Parser::command_statement(const NamedCommand& named, const Token& at) {
  const CommandRow& row = row_of(named.command);
  refuse(row, at.place);
  if (!named.unusual.empty() && row.kind != CommandKind::kLanguage)
    messages_.warn(at.place, quote(named.unusual) + ": the usual form is " + std::string(row.name));
  if (named.command == Command::kSysvar && at_symbol("[", 1))
    return assign_pseudo_array(Command::kSysvar, Command::kSetSysvar);
  if (named.command == Command::kPcd && at_symbol("[", 1))
    return assign_pseudo_array(Command::kSentPcd, Command::kSetPcd);
  if (at_symbol("=", named.words)) fail(at.place, quote(at.text) + " is a command and cannot be assigned to");
  if (row.kind == CommandKind::kLanguage) return language_statement(named.command, at);
  const bool alone = named.command == Command::kInkey || named.command == Command::kGetvel;
  if (row.kind == CommandKind::kFunction && !alone)
    fail(at.place, quote(at.text) + " gives a value; allowed: name = " + std::string(row.name));
  for (std::size_t i = 0; i < named.words; ++i) take();
  if (named.command == Command::kSet && accept_word("PID")) {
    const CommandRow& form = row_of(Command::kSetPid);
    std::vector<ExpressionPointer> operands = arguments(form);
    after_argument(form);
    return emit_command(at.place, Command::kSetPid, operands);
  }
  const Token& first = peek();
  std::vector<ExpressionPointer> operands;
  if (named.command == Command::kOut) {
    operands.push_back(output());
    if (!on_same_line() || !(argument_follows() || at_word("ON") || at_word("OFF"))) {
      const std::string n = first.text;
      std::string meant = n.size() == 2 ? "OUT " + n.substr(0, 1) + " " + n.substr(1) + ", " : "";
      fail(at.place, "OUT " + n + " is read as output " + n + " without a state; allowed: " + meant + "OUT " +
                         n + " 0, OUT " + n + " 1 (outputs: 1 to 8, 21, 22, 27, 29, X34/1, X34/5, X34/10)");
    }
    operands.push_back(state("OUT", false));
  } else {
    operands = arguments(row);
  }
  after_argument(row);
  emit_command(at.place, named.command, operands);
}

void Parser::language_statement(Command command, const Token& at) {
  const auto words = command_at(tokens_.subspan(at_))->words;
  const auto plain = [&](Operation operation) {
    for (std::size_t i = 0; i < words; ++i) take();
    emitter_.emit(at.place, operation);
    after_argument(row_of(command));
  };
  switch (command) {
    case Command::kDim:
      return dim_statement();
    case Command::kErrclr:
      return plain(Operation::kClearError);
    case Command::kExit:
      return plain(Operation::kExit);
    case Command::kDeleteArrays:
      return plain(Operation::kDeleteArrays);
    case Command::kGoto:
      return goto_statement();
    case Command::kGosub:
      return gosub_statement();
    case Command::kLoop:
      return loop_statement();
    case Command::kPrint:
      return print_statement();
    case Command::kDelay:
      return time_statement(Operation::kDelay, at);
    case Command::kWaitt:
      return time_statement(Operation::kWaitTime, at);
    case Command::kWaiti:
      return wait_for_input(at);
    case Command::kDisable:
    case Command::kEnable:
      take();
      return disable_statement(command == Command::kDisable ? Operation::kDisable : Operation::kEnable,
                               at.place);
    case Command::kNowait: {
      take();
      const ExpressionPointer on = state("NOWAIT", false);
      check(command, {on.get()});
      emitter_.emit(at.place, Operation::kNoWait, value(*on));
      return after_argument(row_of(command));
    }
    default:
      fail(at.place, quote(at.text) + " cannot begin a statement");
  }
}

// DELAY, WAITT, WAIT T, and WAIT alone.
void Parser::time_statement(Operation operation, const Token& at) {
  const NamedCommand named = *command_at(tokens_.subspan(at_));
  const CommandRow& row = row_of(named.command);
  if (!named.unusual.empty() && glued_input(peek(1))) return wait_for_input(at);  // WAIT IN1 OFF
  if (!named.unusual.empty())
    messages_.warn(at.place, quote(named.unusual) + ": the usual form is " + std::string(row.name));
  for (std::size_t i = 0; i < named.words; ++i) take();
  const ExpressionPointer time = argument(row.name);
  after_argument(row);
  check(row.command, {time.get()});
  emitter_.emit(at.place, operation, value(*time));
}

void Parser::wait_for_input(const Token& at) {
  const NamedCommand named = *command_at(tokens_.subspan(at_));
  ExpressionPointer input;
  bool usual = named.unusual.empty();
  if (named.command == Command::kWaitt) {
    take();
    const Token& glued = take();
    input = constant(glued.place, *glued_input(glued));
  } else {
    for (std::size_t i = 0; i < named.words; ++i) take();
    input = argument("WAITI");
  }
  use_input(*input);
  const bool has_state = on_same_line() && (at_word("ON") || at_word("OFF") || argument_follows());
  const ExpressionPointer level = state("WAITI", true);
  if (!usual || !has_state) messages_.warn(at.place, "the usual form is WAITI n ON or WAITI n OFF");
  after_argument(row_of(Command::kWaiti));
  check(Command::kWaiti, {input.get(), level.get()});
  const Cell number = value(*input);
  emitter_.emit(at.place, Operation::kWaitInput, number, value(*level));
}

void Parser::jump_to(const Place& place, Operation operation, EmittedOperand second) {
  const Token& label = peek();
  if (label.kind != Token::Kind::kName || is_no_label(label.folded)) fail_here("the name of a label");
  take();
  jumps_.push_back({emitter_.emit(place, operation, std::uint32_t{0}, second), label.folded, label.text,
                    routine_, label.place});
}

void Parser::goto_statement() {
  const Place place = take().place;
  jump_to(place, Operation::kJump);
}

void Parser::loop_statement() {
  const Place place = take().place;
  const ExpressionPointer count = argument("LOOP");
  check(Command::kLoop, {count.get()});
  const Cell cell = value(*count);
  jump_to(place, Operation::kLoop, cell);
}

void Parser::subprogram_reference(std::uint32_t instruction) {
  const Token& name = peek();
  if (name.kind != Token::Kind::kName || !on_same_line()) fail_here("the name of a SUBPROG");
  take();
  calls_.push_back({instruction, name.folded, name.text, routine_, name.place});
}

void Parser::gosub_statement() {
  const Place place = take().place;
  const Token& name = peek();
  if (name.kind != Token::Kind::kName || !on_same_line()) fail_here("the name of a SUBPROG");
  subprogram_reference(emitter_.emit(place, Operation::kGosub));
}

// Between two items stands a blank, unless one of them is a character or a text that brings its own.
void Parser::print_items(PrintList& list, std::vector<ExpressionPointer>& values) {
  bool blank_before = false;
  do {
    const Token& item = peek();
    using Kind = PrintItem::Kind;
    if (item.kind == Token::Kind::kText) {
      take();
      const bool brings_one = item.text.starts_with(' ');
      list.items.push_back(
          {Kind::kText, emitter_.text((blank_before && !brings_one ? " " : "") + item.text)});
      blank_before = !item.text.ends_with(' ');
    } else if (at_word("CHR")) {
      take();
      expect_symbol("(", "behind CHR");
      values.push_back(expression());
      expect_symbol(")", "behind the number of the character");
      list.items.push_back({Kind::kCharacter, 0});
      blank_before = false;
    } else {
      if (blank_before) list.items.push_back({Kind::kText, emitter_.text(" ")});
      values.push_back(expression());
      list.items.push_back({Kind::kNumber, 0});
      blank_before = true;
    }
    if (list.items.size() > 200) fail(item.place, "PRINT: too many items; allowed: 100");
  } while (accept_symbol(","));
}

void Parser::print_statement() {
  const Place place = take().place;
  if (accept_word("DEV")) {
    const ExpressionPointer device = argument("PRINT DEV");
    check(Command::kPrintDev, {device.get()});
    emitter_.emit(place, Operation::kPrintDevice, value(*device));
  }
  PrintList list;
  std::vector<ExpressionPointer> values;
  if (on_same_line() && !at_symbol(";")) print_items(list, values);
  if (on_same_line() && accept_symbol(";")) list.ends_line = false;
  after_argument(row_of(Command::kPrint));
  const Cell cells = gathered(values);
  const EmittedOperand first = values.empty() ? EmittedOperand(std::uint32_t{0}) : EmittedOperand(cells);
  const std::uint32_t number = emitter_.print_list(std::move(list));
  emitter_.emit(place, Operation::kPrint, number, first);
}

Cell Parser::value(const Expression& expression) {
  if (expression.kind == Expression::Kind::kConstant) return emitter_.constant(expression.value);
  if (expression.kind == Expression::Kind::kVariable)
    return emitter_.variable(expression.name, expression.written);
  const Cell cell = emitter_.temporary();
  into(cell, expression);
  return cell;
}

void Parser::into(Cell cell, const Expression& expression) {
  switch (expression.kind) {
    case Expression::Kind::kConstant:
    case Expression::Kind::kVariable:
      emitter_.emit(expression.place, Operation::kMove, cell, value(expression));
      return;
    case Expression::Kind::kElement: {
      const Cell index = value(*expression.operands[0]);
      emitter_.emit(expression.place, Operation::kLoadElement, cell, std::uint32_t{expression.number}, index);
      return;
    }
    case Expression::Kind::kCommand: {
      const std::uint32_t mark = emitter_.mark();
      emit_command(expression.place, expression.command, expression.operands, cell);
      emitter_.release(mark);
      return;
    }
    case Expression::Kind::kOperation:
      break;
  }
  const std::uint32_t mark = emitter_.mark();
  EmittedOperand operands[2] = {std::uint32_t{0}, std::uint32_t{0}};
  for (std::size_t i = 0; i < expression.operands.size(); ++i) operands[i] = value(*expression.operands[i]);
  emitter_.emit(expression.place, expression.operation, cell, operands[0], operands[1]);
  emitter_.release(mark);
}

// The arguments in cells one behind the other.
Cell Parser::gathered(const std::vector<ExpressionPointer>& arguments) {
  if (arguments.empty()) return {};
  if (arguments.size() == 1) return value(*arguments[0]);
  std::vector<std::int32_t> constants;
  for (const ExpressionPointer& argument : arguments)
    if (argument->kind == Expression::Kind::kConstant) constants.push_back(argument->value);
  if (constants.size() == arguments.size()) return emitter_.constants(constants);
  const Cell cells = emitter_.temporary(static_cast<std::uint32_t>(arguments.size()));
  for (std::size_t i = 0; i < arguments.size(); ++i)
    into(cells.behind(static_cast<std::uint32_t>(i)), *arguments[i]);
  return cells;
}

void Parser::emit_command(const Place& place, Command command,
                          const std::vector<ExpressionPointer>& arguments, Cell result) {
  check(command, arguments);
  const Cell cells = gathered(arguments);
  const EmittedOperand first = arguments.empty() ? EmittedOperand(std::uint32_t{0}) : EmittedOperand(cells);
  emitter_.emit(place, Operation::kCommand, static_cast<std::uint32_t>(command), first, result);
}

}  // namespace lockstep::aposs
