/// Compiles a program in APOSS.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "projects/aposs/lexer.hpp"
#include "projects/aposs/message.hpp"
#include "projects/aposs/parser.hpp"
#include "scheduler/aposs/image.hpp"

namespace lockstep::aposs {

struct CompilerSettings {
  std::size_t maximum_variables = 92;  ///< with the arrays, as published
  bool later_edition = true;           ///< "5.00"; else parameters of that edition are none
  /// Variables of other programs of the same device: they stand first in its memory, so that each variable
  /// has the same cell in all of them.
  std::vector<std::string> variables_of_others{};
};

struct CompiledProgram {
  std::optional<Image> image;  ///< none if there are errors
  std::vector<std::string> files;
  std::vector<Message> errors;  ///< the first twenty
  std::vector<Message> warnings;
  std::size_t errors_found = 0;
  Uses uses;
};

/// Never throws on account of the text, whatever it is.
CompiledProgram compile_program(std::string name, std::string_view text, const ReadIncluded& read = {},
                                const CompilerSettings& settings = {});
/// Reads a file, and those that it includes from beside it. @throws UnreadableFile
/// @param top folder of the project, out of which no included file leads, not by a symbolic link either;
///     none: it is of no project
CompiledProgram compile_file(const std::string& path, const CompilerSettings& settings = {},
                             const std::optional<std::string>& top = std::nullopt);

/// Of a file of the vendor's tool, by its name; empty: it is none.
std::string_view why_not_readable(const std::string& path);

/// "teddy.m:14:9: text".
std::string to_string(const std::vector<std::string>& files, const Message& message);

}  // namespace lockstep::aposs
