// lockstep write: values of a running project by their names, over Modbus.
#include <CLI/App.hpp>

#include "cli/command/command.hpp"
#include "cli/panel/modbus_panel.hpp"
#include "hmi_bridge/traces/text_literal.hpp"
#include "projects/expressions/constant.hpp"

namespace lockstep::cli {
namespace {

/// What is to be written where.
struct Assignment {
  PanelName name;
  std::vector<Value> values;
};

/// The parts of "[1.0, MAX(2, 3)]"; of anything else itself.
std::vector<std::string> parts_of(const std::string& text, bool is_list) {
  if (!is_list || !text.starts_with('[') || !text.ends_with(']')) return {text};
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : text.substr(1, text.size() - 2)) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == ',' && depth == 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// A value for an address, or nothing: then that is told. A coil is 0 or 1 to whoever comes from Modbus.
std::optional<Value> value_for(const PanelEntry& place, std::string text) {
  if (place.type() == Type::BOOL && (text == "0" || text == "1")) text = text == "1" ? "TRUE" : "FALSE";
  JsonValue json;
  json.kind = JsonKind::string;
  json.text = std::move(text);
  Problems problems;
  const auto value = read_constant(json, place.type(), problems);
  for (const Problem& problem : problems.take_errors()) tell(place.name + ": " + problem.text);
  if (!value) return std::nullopt;
  if (const std::string problem = write_problem(place, *value); !problem.empty()) {
    tell(problem);
    return std::nullopt;
  }
  return value;
}

/// A text as it is, or as a literal in quotes; nothing, which is told, if the name has no space for it.
std::optional<std::vector<Value>> values_of_text(const PanelName& name, const std::string& given) {
  std::string problem;
  const auto text = given.starts_with('\'') ? read_text_literal(given, problem) : text_from_utf8(given);
  if (!text && problem.empty())
    problem = quote(given) + " is no text; allowed: printable characters of ISO 8859-1";
  if (text && text->size() > name.capacity)
    problem = quote(given) + " has " + std::to_string(text->size()) + " characters; allowed: up to " +
              std::to_string(name.capacity);
  if (problem.empty()) return text_values(*text, name.capacity);
  tell(name.name + ": " + problem);
  return std::nullopt;
}

/// Reads "NAME=VALUE" or "NAME=[VALUE, …]", or tells what is wrong with it.
std::optional<Assignment> assignment(const ModbusPanel& panel, const std::string& text) {
  const auto equals = text.find('=');
  if (equals == text.npos || equals == 0) {
    tell(quote(text) + " is not NAME=VALUE");
    return std::nullopt;
  }
  auto name = panel.find(text.substr(0, equals), true);
  if (!name) return std::nullopt;
  const std::string given = text.substr(equals + 1);
  if (name->capacity > 0) {
    auto values = values_of_text(*name, given);
    return values ? std::optional(Assignment{std::move(*name), std::move(*values)}) : std::nullopt;
  }
  const std::vector<std::string> parts = parts_of(given, name->is_list);
  const std::size_t count = name->entries.size();
  if (name->is_list && (!given.starts_with('[') || !given.ends_with(']') || parts.size() != count)) {
    tell(name->name + ": " + quote(given) + " are not the values of " + std::to_string(count) +
         " elements; allowed: [VALUE, …] with one for each");
    return std::nullopt;
  }
  std::vector<Value> values;
  for (std::size_t i = 0; i < count; ++i)
    if (const auto value = value_for(name->entries[i], parts[i])) values.push_back(*value);
  if (values.size() != count) return std::nullopt;
  return Assignment{std::move(*name), std::move(values)};
}

int write_values(const PanelOptions& options) {
  int status = kOk;
  const std::optional<Project> project = load_or_tell(options.project, status, {}, Warnings::kept);
  if (!project) return status;
  auto target = find_target(*project, options);
  if (!target) return kCouldNotStart;
  ModbusPanel panel(*project, options, std::move(*target));
  if (!panel.has_map()) return kNotValid;
  std::vector<Assignment> assignments;
  for (const std::string& text : options.names)
    if (auto one = assignment(panel, text)) assignments.push_back(std::move(*one));
  if (assignments.size() != options.names.size()) return kNotValid;
  if (!panel.connect()) return kCouldNotStart;
  for (const Assignment& one : assignments)
    if (!panel.write(one.name, one.values)) return kCouldNotStart;
  return kOk;
}

}  // namespace

void add_write_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("write", "Write values of a running project over Modbus, by name");
  auto options = std::make_shared<PanelOptions>();
  add_panel_options(*command, *options);
  command
      ->add_option(
          "VALUES", options->names,
          "NAME=VALUE, such as speed=250 start=TRUE (or 1) wait=1.5s mask=16#FF; of arrays heights[3]=7.5, "
          "'heights=[5, 7.5, 10]', 'heights[2..3]=[5, 7.5]'; of texts 'kind=pale ale'")
      ->required();
  command->footer(
      "Nothing is written unless every name and value is good; then they go out in their order, each in a\n"
      "request of its own, an array in as many as its registers need, 123 in each.\n"
      "Such as: lockstep write 127.0.0.1:1502 speed=120 start=TRUE --project project.json\n"
      "Exit status: 0, 1 project not valid, without a map, no such name or value, 2 nobody answers, or "
      "refuses");
  command->callback([&action, options] { action = [options] { return write_values(*options); }; });
}

}  // namespace lockstep::cli
