/// What the names of a program stand for, as far as a first look at its tokens tells.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "projects/aposs/lexer.hpp"
#include "scheduler/aposs/commands.hpp"

namespace lockstep::aposs {

/// A command as it stands in the text.
struct NamedCommand {
  Command command;
  std::size_t words = 1;     ///< tokens that name it
  std::string_view unusual;  ///< the spelling, if the usual one is another
};

/// The command whose name begins at a token; a name of two words counts before one of one word.
std::optional<NamedCommand> command_at(std::span<const Token> tokens);
/// Words that belong to commands and expressions, which no variable, array or label may be.
bool is_reserved(std::string_view folded_name);
/// Words that no label may be, those of `is_reserved` but one: WAIT alone is an unusual form of WAITT, and a
/// label may have its name.
bool is_no_label(std::string_view folded_name);
/// "MOTOR OFF, MOTOR ON, MOTOR STOP": the commands of two words of which this is the first; empty: none.
std::string commands_of_first_word(std::string_view folded_name);
/// " (did you mean …?)" among commands and other names.
std::string nearest_name(std::string_view name, const std::set<std::string>& others);

/// Names that are assigned to somewhere, so that IN4 is a variable where the program makes it one.
std::set<std::string> assigned_names(std::span<const Token> tokens);

}  // namespace lockstep::aposs
