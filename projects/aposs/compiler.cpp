#include "projects/aposs/compiler.hpp"

#include <filesystem>

#include "projects/json/named_file.hpp"
#include "projects/json/text_file.hpp"

namespace lockstep::aposs {
CompiledProgram compile_program(std::string name, std::string_view text, const ReadIncluded& read,
                                const CompilerSettings& settings) {
  Messages messages;
  CompiledProgram result;
  Tokens tokens = cut(std::move(name), text, read, messages);
  Parser parser(tokens.list, messages, settings.later_edition, settings.variables_of_others);
  parser.program();
  Image image = parser.finish(settings.maximum_variables);
  image.files = result.files = std::move(tokens.files);
  result.uses = parser.take_uses();
  if (messages.errors_found() == 0) result.image = std::move(image);
  result.errors_found = messages.errors_found();
  result.errors = messages.take_errors();
  result.warnings = messages.take_warnings();
  return result;
}

std::string_view why_not_readable(const std::string& path) {
  std::string end = std::filesystem::path(path).extension().string();
  for (char& c : end) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (end != ".cnf" && end != ".zbc") return {};
  return "files .cnf and .zbc of the vendor are not described in its documents and cannot be read; allowed: "
         "programs as text (.m), parameters as a JSON file";
}

CompiledProgram compile_file(const std::string& path, const CompilerSettings& settings,
                             const std::optional<std::string>& top) {
  if (const std::string_view reason = why_not_readable(path); !reason.empty()) {
    CompiledProgram refused;
    refused.files = {path};
    refused.errors.push_back({{}, std::string(reason)});
    refused.errors_found = 1;
    return refused;
  }
  const std::string text = read_text_file(path, kLargestFile);
  const ReadIncluded read = [&](const std::string& name) -> std::optional<std::string> {
    const std::string beside = (std::filesystem::path(path).parent_path() / name).string();
    if (top && !stays_within(beside, *top)) return std::nullopt;
    try {
      return read_text_file(beside, kLargestFile);
    } catch (const UnreadableFile&) {
      return std::nullopt;
    }
  };
  return compile_program(path, text, read, settings);
}

std::string to_string(const std::vector<std::string>& files, const Message& message) {
  const std::string file = message.place.file < files.size() ? files[message.place.file] : "";
  if (message.place.line == 0) return file + ": " + message.text;
  return file + ":" + std::to_string(message.place.line) + ":" + std::to_string(message.place.column) + ": " +
         message.text;
}

}  // namespace lockstep::aposs
