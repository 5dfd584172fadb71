/// Reads the tokens of a program and puts its instructions together.
/// @source MCO 305 Design Guide, program layout, elements of the programming language, command reference
#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "projects/aposs/emitter.hpp"
#include "projects/aposs/expression.hpp"
#include "projects/aposs/lexer.hpp"
#include "projects/aposs/names.hpp"

namespace lockstep::aposs {

/// What a program uses, of what its text says itself.
struct Uses {
  std::set<std::int32_t> inputs, outputs, parameters;
};

class Parser {
 public:
  /// @param later_edition whether parameters of firmware 5.00 are there  @param first_variables names of
  /// those that have the first cells, used or not
  Parser(std::span<const Token> tokens, Messages& messages, bool later_edition,
         const std::vector<std::string>& first_variables = {});

  void program();
  Image finish(std::size_t maximum_variables);
  Uses take_uses() { return std::move(uses_); }

 private:
  /// Thrown when the rest of a line cannot be read; what is wrong has been told.
  struct Unreadable {};
  enum class Block : std::uint8_t { kIf, kWhile, kRepeat, kBrace, kSubprogram, kArea };
  struct OpenBlock {
    Block kind;
    std::uint32_t line;
  };
  struct Label {
    std::uint32_t instruction;
    std::size_t routine;
    Place place;
  };
  struct Reference {
    std::uint32_t instruction;
    std::string name, written;
    std::size_t routine;
    Place place;
  };
  struct Read {
    std::string name, written;
    Place place;
  };

  // Tokens.

  const Token& peek(std::size_t ahead = 0) const;
  const Token& take();
  bool at_symbol(std::string_view symbol, std::size_t ahead = 0) const;
  bool at_word(std::string_view word, std::size_t ahead = 0) const;
  bool accept_symbol(std::string_view symbol);
  bool accept_word(std::string_view word);
  void expect_symbol(std::string_view symbol, std::string_view where);
  void expect_word(std::string_view word, std::string_view where);
  /// Whether the next token stands in the line of the one that was taken last.
  bool on_same_line() const;
  std::string shown() const;
  [[noreturn]] void fail(const Place& place, std::string text);
  [[noreturn]] void fail_here(std::string_view allowed);
  void skip_line(const Place& place);

  // Blocks.

  void statements();
  std::optional<Block> closes() const;
  bool returns_again() const;
  void stray(Block kind);
  void missing_end(const char* begin, const char* end, std::uint32_t line);
  void statement();
  ExpressionPointer condition_of(std::string_view block, std::string_view end);
  void if_statement();
  void while_statement();
  void repeat_statement();
  void loop_statement();
  void subprogram_area();
  void subprogram();
  void area_without_subprogram();

  // Statements.

  void dim_statement();
  void label();
  void assignment();
  void assign_variable(const Token& name);
  void assign_element(const Token& name);
  void assign_pseudo_array(Command read, Command write);
  void goto_statement();
  void gosub_statement();
  void print_statement();
  void print_items(PrintList& list, std::vector<ExpressionPointer>& values);
  void command_statement(const NamedCommand& named, const Token& at);
  void language_statement(Command command, const Token& at);
  void wait_for_input(const Token& at);
  void time_statement(Operation operation, const Token& at);
  void refuse(const CommandRow& row, const Place& place);
  void after_argument(const CommandRow& row);

  // Interrupts.

  void on_statement();
  void on_position(const Place& place);
  void on_source(const Place& place, Command command, Operation operation);
  void on_parameter(const Place& place);
  void on_delete(const Place& place);
  void subprogram_reference(std::uint32_t instruction);
  std::string gosub_name();
  void disable_statement(Operation operation, const Place& place);

  // Arguments.

  std::vector<ExpressionPointer> arguments(const CommandRow& row);
  ExpressionPointer argument_of(Argument kind, const CommandRow& row);
  ExpressionPointer argument(std::string_view of);
  bool argument_follows() const;
  ExpressionPointer state(std::string_view of, bool optional);
  ExpressionPointer parameter(std::string_view of);
  void use_parameter(const Place& place, std::int32_t number);
  void use_input(const Expression& input);
  ExpressionPointer drive_parameter(std::string_view of);
  ExpressionPointer output();
  ExpressionPointer array_argument(std::string_view of);
  ExpressionPointer text_argument(std::string_view of);
  ExpressionPointer word_argument(std::span<const std::string_view> words, std::string_view of);

  // Expressions.

  ExpressionPointer expression();
  ExpressionPointer binary(int level);
  ExpressionPointer unary();
  ExpressionPointer primary();
  ExpressionPointer named_primary();
  ExpressionPointer function(const NamedCommand& named, const Token& at);
  ExpressionPointer selected(ExpressionPointer of, const Place& place);
  std::pair<Operation, ExpressionPointer> selector();
  ExpressionPointer bracketed_index(std::string_view of);
  std::optional<std::int32_t> glued_input(const Token& token) const;
  void count_operator(const Place& place);
  /// Tells of constants that are not what they may be.
  void check(Command command, const std::vector<ExpressionPointer>& arguments);
  void check(Command command, std::initializer_list<const Expression*> arguments);

  // Code.

  Cell value(const Expression& expression);
  void into(Cell cell, const Expression& expression);
  Cell gathered(const std::vector<ExpressionPointer>& arguments);
  void emit_command(const Place& place, Command command, const std::vector<ExpressionPointer>& arguments,
                    Cell result = {});
  void jump_to(const Place& place, Operation operation, EmittedOperand second = std::uint32_t{0});
  void resolve();
  void look_at_reads();

  std::span<const Token> tokens_;
  std::size_t at_ = 0;
  Messages& messages_;
  bool later_edition_ = true;
  Emitter emitter_;
  Uses uses_;
  std::set<std::string> assigned_;
  std::map<std::string, std::uint16_t> array_numbers_;
  std::vector<ArrayDeclaration> arrays_;
  std::map<std::string, Label> labels_;
  std::map<std::string, Label> subprograms_;
  std::vector<Routine> routines_;
  std::vector<Reference> jumps_, calls_;
  std::vector<Read> reads_;
  std::vector<OpenBlock> open_;
  std::size_t routine_ = 0;  ///< 0: the main program
  bool has_area_ = false, dim_is_over_ = false;
  std::uint32_t last_if_ = 0, last_endif_ = 0;
  std::size_t nested_ = 0, operators_ = 0;
};

}  // namespace lockstep::aposs
