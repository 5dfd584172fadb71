// lockstep describe: parameters, commands and modules of a LinMot controller.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/describe/subject.hpp"
#include "cli/describe/table.hpp"
#include "projects/json/problem.hpp"
#include "tech_objects/linmot_catalogue/ascii_commands.hpp"
#include "tech_objects/linmot_catalogue/errors.hpp"
#include "tech_objects/linmot_catalogue/modules.hpp"
#include "tech_objects/linmot_catalogue/mt_commands.hpp"
#include "tech_objects/linmot_catalogue/parameters.hpp"

namespace lockstep::cli {
namespace {

using LinMotJson = nlohmann::ordered_json;

// ---- Parameters

std::string start_text(const linmot::Parameter& parameter) {
  if (!parameter.effective()) return "";
  const linmot::SystemParameters system;
  const linmot::MotorParameters motor;
  const bool of_system = parameter.scope == linmot::Scope::system;
  const double value = linmot::parameter_value(
      parameter, of_system ? static_cast<const void*>(&system) : static_cast<const void*>(&motor));
  std::string text;
  if (parameter.kind == linmot::Kind::choice)
    text = parameter.options[static_cast<std::size_t>(value)];
  else if (parameter.kind == linmot::Kind::on_off)
    text = value != 0.0 ? "on" : "off";
  else
    text = fmt::format("{}", value);
  return text + (parameter.printed() ? ", printed" : ", ours: the source prints none");
}

std::string options_text(const linmot::Parameter& parameter) {
  std::string text;
  for (const std::string_view option : parameter.options)
    text += (text.empty() ? "" : ", ") + std::string(option);
  return text;
}

std::string range_text_of(const linmot::Parameter& parameter) {
  if (!parameter.options.empty()) return options_text(parameter);
  if (parameter.range.unbounded()) return "";
  return fmt::format("{} to {}", parameter.range.lowest, parameter.range.highest);
}

std::string scope_text(linmot::Scope scope) {
  constexpr std::string_view texts[] = {"the controller", "every motor", "linear motors",
                                        "steppers",       "magnets",     "position sensors"};
  return std::string(texts[static_cast<std::size_t>(scope)]);
}

std::string full_path(const linmot::Parameter& parameter) {
  return (parameter.scope == linmot::Scope::system ? "" : "Drives\\Drive X\\") + std::string(parameter.path);
}

std::string signal_of(const linmot::Parameter& parameter) {
  if (!parameter.effective()) return "";
  return (parameter.scope == linmot::Scope::system ? "" : "A.") + linmot::signal_path(parameter.path);
}

/// Of the memory that ASCII commands read and write; nothing where it has no effect.
std::string address_text(const linmot::Parameter& parameter) {
  if (!parameter.effective() || parameter.scope > linmot::Scope::linear_motor) return "";
  const bool of_system = parameter.scope == linmot::Scope::system;
  const auto list = of_system ? linmot::system_parameters() : linmot::motor_parameters();
  const auto index = static_cast<std::size_t>(&parameter - list.data());
  return std::to_string(2 * (index + (of_system ? 0 : linmot::system_parameters().size())));
}

std::string changes_text(const linmot::Parameter& parameter) {
  if (parameter.read_only() || parameter.kind == linmot::Kind::shown) return "never: read only";
  return parameter.live() ? "at run time too (L)" : "in the project alone";
}

std::string linmot_parameter_page(const linmot::Parameter& parameter, std::size_t width) {
  Table table({"", ""});
  const auto row = [&table](const char* name, const std::string& text) {
    if (!text.empty()) table.row({name, text});
  };
  row("Of", scope_text(parameter.scope));
  row("Signal", signal_of(parameter));
  row("Unit", std::string(parameter.unit));
  row("Allowed", range_text_of(parameter));
  row("Start value", start_text(parameter));
  row("Changes", changes_text(parameter));
  row("Address", address_text(parameter));
  if (!parameter.effective()) row("Effect", "declared, without effect");
  return "Parameter " + full_path(parameter) + " of a LinMot_Controller\n" +
         paragraph(parameter.text, 2, width) + "\n" + table.text(2, width);
}

LinMotJson linmot_parameter_json(const linmot::Parameter& parameter) {
  return {{"kind", "linmot_parameter"},
          {"path", full_path(parameter)},
          {"of", scope_text(parameter.scope)},
          {"signal", signal_of(parameter)},
          {"unit", parameter.unit},
          {"allowed", range_text_of(parameter)},
          {"start", start_text(parameter)},
          {"live", parameter.live()},
          {"read_only", parameter.read_only()},
          {"address", address_text(parameter)},
          {"effective", parameter.effective()},
          {"text", parameter.text}};
}

/// The whole path, or what stands last in it.
bool is_named(const linmot::Parameter& parameter, std::string_view name) {
  const auto last = parameter.path.rfind('\\');
  return same_name(parameter.path, name) || same_name(full_path(parameter), name) ||
         same_name(linmot::signal_path(parameter.path), name) ||
         (last != parameter.path.npos && same_name(parameter.path.substr(last + 1), name));
}

/// All of them in published order.
Subject linmot_parameters_subject() {
  const auto text = [](std::size_t width) {
    Table table({"Parameter", ""});
    for (const auto list : {linmot::system_parameters(), linmot::motor_parameters()})
      for (const linmot::Parameter& parameter : list)
        table.row({full_path(parameter), std::string(parameter.text)});
    return table.text(0, width);
  };
  const auto json = [] {
    LinMotJson parameters = LinMotJson::array();
    for (const auto list : {linmot::system_parameters(), linmot::motor_parameters()})
      for (const linmot::Parameter& parameter : list) parameters.push_back(linmot_parameter_json(parameter));
    return LinMotJson{{"kind", "linmot_parameters"}, {"parameters", std::move(parameters)}};
  };
  return {text, json};
}

Subject linmot_parameter_subject(std::string_view name) {
  for (const auto list : {linmot::system_parameters(), linmot::motor_parameters()})
    for (const linmot::Parameter& parameter : list)
      if (is_named(parameter, name))
        return {[&parameter](std::size_t width) { return linmot_parameter_page(parameter, width); },
                [&parameter] { return linmot_parameter_json(parameter); }};
  return {};
}

// ---- Lists with one page each

/// A named thing and what is told of it.
struct CatalogueEntry {
  std::string name, text;
  std::vector<std::pair<std::string, std::string>> facts;
};

Subject list_subject(const std::string& title, const std::vector<CatalogueEntry>& entries) {
  const auto text = [title, entries](std::size_t width) {
    Table table({title, ""});
    for (const CatalogueEntry& entry : entries) table.row({entry.name, entry.text});
    return table.text(0, width);
  };
  const auto json = [title, entries] {
    LinMotJson list = LinMotJson::array();
    for (const CatalogueEntry& entry : entries) list.push_back({{"name", entry.name}, {"text", entry.text}});
    return LinMotJson{{"kind", title}, {"entries", std::move(list)}};
  };
  return {text, json};
}

Subject entry_subject(const std::string& title, const std::vector<CatalogueEntry>& entries,
                      std::string_view name) {
  for (const CatalogueEntry& entry : entries) {
    if (!same_name(entry.name, name)) continue;
    const auto text = [title, entry](std::size_t width) {
      Table table({"", ""});
      for (const auto& [what, fact] : entry.facts)
        if (!fact.empty()) table.row({what, fact});
      return title + " " + entry.name + "\n" + paragraph(entry.text, 2, width) + "\n" + table.text(2, width);
    };
    const auto json = [title, entry] {
      LinMotJson made{{"kind", title}, {"name", entry.name}, {"text", entry.text}};
      for (const auto& [what, fact] : entry.facts) made[what] = fact;
      return made;
    };
    return {text, json};
  }
  return {};
}

std::vector<CatalogueEntry> ascii_entries() {
  constexpr std::string_view forms[] = {"motor", "controller", "number, motor", "+ or -, controller",
                                        "+ or -, controller or motor"};
  std::vector<CatalogueEntry> entries;
  for (const linmot::AsciiCommand& command : linmot::ascii_commands()) {
    CatalogueEntry entry{
        std::string(command.name), std::string(command.title) + ": " + std::string(command.text), {}};
    entry.facts.emplace_back("takes", forms[static_cast<std::size_t>(command.form)]);
    if (command.form == linmot::AsciiForm::number_drive)
      entry.facts.emplace_back("range", fmt::format("{} to {}", command.lowest, command.highest));
    entry.facts.emplace_back("state", command.is(linmot::AsciiCommand::kInRun) ? "RUN only" : "any");
    if (command.is(linmot::AsciiCommand::kArms))
      entry.facts.emplace_back("begins", "at the next rising trigger");
    entries.push_back(std::move(entry));
  }
  return entries;
}

std::vector<CatalogueEntry> mt_entries() {
  std::vector<CatalogueEntry> entries;
  for (const linmot::MtRow& row : linmot::mt_commands()) {
    std::string arguments;
    for (std::size_t i = 0; i < row.arity(); ++i) {
      arguments += (i == 0 ? "" : ", ") + std::string(row.arguments[i].name);
      if (!row.arguments[i].unit.empty()) arguments += " [" + std::string(row.arguments[i].unit) + "]";
    }
    CatalogueEntry entry{std::string(row.name), std::string(row.text), {{"arguments", arguments}}};
    if (row.scope == linmot::MtScope::magnet_only)
      entry.facts.emplace_back("of", "magnets, which are not built yet");
    if (row.scope == linmot::MtScope::later) entry.facts.emplace_back("built", "not yet");
    entries.push_back(std::move(entry));
  }
  return entries;
}

std::vector<CatalogueEntry> module_entries() {
  std::vector<CatalogueEntry> entries;
  for (const linmot::ModuleRow& row : linmot::modules()) {
    CatalogueEntry entry{std::string(row.name), std::string(row.text), {}};
    entry.facts.emplace_back("words", fmt::format("{} out, {} in", row.out_words, row.in_words));
    if (row.lowest != row.highest)
      entry.facts.emplace_back("range", fmt::format("{} to {}", row.lowest, row.highest));
    entry.facts.emplace_back("unit", row.unit);
    entries.push_back(std::move(entry));
  }
  return entries;
}

}  // namespace

Subject linmot_subject(const std::vector<std::string>& words) {
  struct EntryGroup {
    std::string_view name;
    std::string title;
    std::vector<CatalogueEntry> (*entries)();
  };
  const EntryGroup groups[] = {{"ASCII", "ASCII command", ascii_entries},
                               {"MT", "State table command", mt_entries},
                               {"PROFIBUS", "PROFIBUS module", module_entries}};
  for (const EntryGroup& group : groups)
    if (same_name(words[0], group.name))
      return words.size() == 1 ? list_subject(group.title, group.entries())
                               : entry_subject(group.title, group.entries(), words[1]);
  if (words.size() != 2 || !same_name(words[0], "LinMot_Controller")) return {};
  return same_name(words[1], "Parameters") ? linmot_parameters_subject() : linmot_parameter_subject(words[1]);
}

}  // namespace lockstep::cli
