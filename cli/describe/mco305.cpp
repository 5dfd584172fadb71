// lockstep describe: parameters, commands, errors and system variables of an MCO 305.
#include <charconv>
#include <nlohmann/json.hpp>

#include "cli/describe/subject.hpp"
#include "cli/describe/table.hpp"
#include "cli/describe/values.hpp"
#include "projects/aposs/argument_check.hpp"
#include "projects/aposs/parameter_names.hpp"
#include "projects/json/problem.hpp"
#include "scheduler/aposs/commands.hpp"
#include "tech_objects/mco305_catalogue/drive_parameters.hpp"
#include "tech_objects/mco305_catalogue/errors.hpp"
#include "tech_objects/mco305_catalogue/meanings.hpp"
#include "tech_objects/mco305_catalogue/parameters.hpp"
#include "tech_objects/mco305_catalogue/system_variables.hpp"

namespace lockstep::cli {
namespace {

using Json = nlohmann::ordered_json;

/// As it is printed: thousandths with their point.
std::string value_text(std::int32_t value, int decimals) {
  if (decimals == 0) return std::to_string(value);
  std::string text = std::to_string(value);
  text.insert(0, text.size() <= 3 ? 4 - text.size() : 0, '0');
  text.insert(text.size() - 3, ".");
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string_view set_text(std::int32_t number) {
  constexpr std::string_view texts[] = {"SAVE AXPARS", "SAVE GLBPARS",
                                        "by itself, and at once by SAVE USRPARS", "it is read only"};
  return texts[static_cast<std::size_t>(mco305::set_of(number))];
}

/// What the published documents leave open.
std::string_view open_text(std::int32_t number) {
  if (number >= 3260 && number <= 3266)
    return "formula and scale of the position controller are not in the sources: README of "
           "tech_objects/mco305";
  if (number == 3206)
    return "the distance of the zero pulses of a simulated slave (ENCODERTYPE 9) is this number in "
           "thousandths, as "
           "a program sees it; there is no line that could be clocked";
  if (number == 3213 || number == 3243)
    return "1, 3: where ENCODERTYPE 11 and 21 or SWAPMENC change the encoder what is read goes on from where "
           "it is. "
           "DEF ORIGIN and DEFMORIGIN never alter what an encoder has counted: 2 and 3 do not differ from 0 "
           "and 1";
  if (number == 3319)
    return "SET takes n2 and n3 too: external marker and input n; which number means which is not in the "
           "sources";
  if (number == 3320) return "of a simulated slave SET takes n2 and n3 too: edges of input n";
  if (number == 3360) return "as at power-up; SET changes it for the next run, once it is saved";
  if (number >= 3286 && number <= 3289)
    return "jerk = (VELMAX / RAMPMIN) / JERKMIN of the slope is not in the sources";
  return "";
}

struct ParameterPage {
  std::string number, name, title, unit, range, start, meaning, kept, open;
  bool later = false, effective = true;
};

ParameterPage page_of(std::int32_t number) {
  ParameterPage page;
  page.number = aposs::parameter_text(number);
  page.kept = set_text(number);
  page.open = open_text(number);
  page.meaning = mco305::meaning_of(number);
  if (mco305::is_application_parameter(number)) {
    page.title = "application parameter";
    page.range = "-2147483648 to 2147483647";
    page.start = "0";
    return page;
  }
  const mco305::Parameter& of = mco305::parameters()[mco305::parameter_index(number)];
  page.name = of.mnemonic;
  page.title = of.title;
  page.unit = of.unit;
  page.range = value_text(of.lowest, of.decimals) + " to " + value_text(of.highest, of.decimals);
  if (of.bound == mco305::Bound::kVelocityResolution) page.range += ", at most VELRES";
  if (of.bound == mco305::Bound::kLeadingMarkers) page.range += ", within SYNCMPULSM";
  if (of.bound == mco305::Bound::kFollowingMarkers) page.range += ", within SYNCMPULSS";
  page.start = value_text(of.start, of.decimals);
  if (of.decimals != 0) page.start += "; a program sees thousandths";
  page.later = of.later_edition;
  page.effective = of.effective || mco305::is_read_out(number);
  return page;
}

std::string parameter_page(std::int32_t number, std::size_t width) {
  const ParameterPage page = page_of(number);
  Table table({"", ""});
  const auto row = [&table](const char* name, const std::string& text) {
    if (!text.empty()) table.row({name, text});
  };
  row("For", page.meaning);
  row("Unit", page.unit);
  row("Range", page.range);
  row("Start value", page.start);
  row("Kept by", page.kept);
  if (page.later) row("Edition", "later, from firmware 5.00");
  if (!page.effective) row("Effect", "declared, without effect");
  row("Open", page.open);
  return "Parameter " + page.number + (page.name.empty() ? "" : " " + page.name) + " of an MCO_305\n" +
         paragraph(page.title, 2, width) + "\n" + table.text(2, width);
}

Json parameter_json(std::int32_t number) {
  const ParameterPage page = page_of(number);
  return {{"kind", "parameter"},         {"number", page.number},       {"name", page.name},
          {"title", page.title},         {"text", page.meaning},        {"unit", page.unit},
          {"range", page.range},         {"start", page.start},         {"kept_by", page.kept},
          {"later_edition", page.later}, {"effective", page.effective}, {"open", page.open}};
}

std::string_view argument_text(aposs::Argument argument) {
  constexpr std::string_view texts[] = {"",        "value", "[value]",    "ON|OFF",          "[ON|OFF]",
                                        "[index]", "array", "parameter",  "drive-parameter", "\"text\"",
                                        "output",  "part",  "coefficient"};
  return texts[static_cast<std::size_t>(argument)];
}

std::string usage_of(const aposs::CommandRow& row) {
  std::string text(row.name);
  for (std::size_t i = 0; i < row.arity(); ++i) text += " " + std::string(argument_text(row.arguments[i]));
  return text;
}

std::string_view kind_text(const aposs::CommandRow& row) {
  constexpr std::string_view texts[] = {
      "statement",         "function", "part of the language", "form of a command", "known, and not built",
      "known, and refused"};
  return texts[static_cast<std::size_t>(row.kind)];
}

std::string_view refusal_text(aposs::Refusal refusal) {
  constexpr std::string_view texts[] = {"", "only the later edition has it", "CAN is not built",
                                        "telegrams of encoders are not described in the sources",
                                        "there is no serial line"};
  return texts[static_cast<std::size_t>(refusal)];
}

std::string_view waits_text(const aposs::CommandRow& row) {
  constexpr std::string_view texts[] = {"goes on at once", "waits with NOWAIT OFF for its end",
                                        "waits for its end"};
  return texts[static_cast<std::size_t>(row.waits)];
}

/// Whether it reads or changes parameters of the drive.
bool is_of_drive(const aposs::CommandRow& row) {
  return row.command == aposs::Command::kGetvlt || row.command == aposs::Command::kSetvlt;
}

std::string drive_number(const mco305::DriveParameter& one) {
  std::string text = std::to_string(one.number);
  return text.insert(text.size() - 2, "-");
}

/// What the simulated drive has.
std::string drive_table(const aposs::CommandRow& row, std::size_t width) {
  Table table({"parameter", "is", "unit", "decimals", ""});
  for (const mco305::DriveParameter& one : mco305::drive_parameters())
    if (one.writable || row.command == aposs::Command::kGetvlt)
      table.row({drive_number(one), std::string(one.title), std::string(one.unit),
                 std::to_string(one.decimals), std::string(one.meaning)});
  return "\nOf the drive's parameters there are these; any other is error 112:\n" + table.text(2, width);
}

std::string outside_text(const aposs::ArgumentRange& range) {
  if (range.error != 0) return "error " + std::to_string(range.error);
  return std::string(range.outside);
}

std::string command_page(const aposs::CommandRow& row, std::size_t width) {
  Table table({"", ""});
  table.row({"Form", usage_of(row)});
  table.row({"Is", std::string(kind_text(row))});
  if (row.kind == aposs::CommandKind::kStatement) table.row({"Program", std::string(waits_text(row))});
  if (row.given_up) table.row({"Interrupt", "ends it"});
  for (const aposs::ArgumentRange& range : aposs::argument_ranges())
    if (range.command == row.command)
      table.row({"Allowed", std::string(range.name) + " " + aposs::allowed_text(range) +
                                "; any other: " + outside_text(range)});
  if (row.later_edition) table.row({"Edition", "later, from firmware 5.00"});
  if (row.refusal != aposs::Refusal::kNone) table.row({"Refused", std::string(refusal_text(row.refusal))});
  return "Command " + std::string(row.name) + " of APOSS\n" + paragraph(aposs::meaning_of(row), 2, width) +
         "\n" + table.text(2, width) + (is_of_drive(row) ? drive_table(row, width) : "");
}

Json command_json(const aposs::CommandRow& row) {
  Json json{{"kind", "command"},
            {"name", row.name},
            {"text", aposs::meaning_of(row)},
            {"form", usage_of(row)},
            {"is", kind_text(row)},
            {"program", waits_text(row)},
            {"refused", refusal_text(row.refusal)}};
  for (const aposs::ArgumentRange& range : aposs::argument_ranges())
    if (range.command == row.command)
      json["ranges"].push_back({{"argument", range.argument},
                                {"name", range.name},
                                {"allowed", aposs::allowed_text(range)},
                                {"any_other", outside_text(range)}});
  if (!is_of_drive(row)) return json;
  for (const mco305::DriveParameter& one : mco305::drive_parameters())
    json["parameters"].push_back({{"number", drive_number(one)},
                                  {"title", one.title},
                                  {"unit", one.unit},
                                  {"decimals", one.decimals},
                                  {"lowest", one.lowest},
                                  {"highest", one.highest},
                                  {"writable", one.writable},
                                  {"text", one.meaning}});
  return json;
}

std::string bit_text(const mco305::Error& error) {
  if (error.word == 0) return "";
  return (error.word == 1 ? "34-70, bit " : "34-71, bit ") + std::to_string(error.bit);
}

std::string device_error_page(const mco305::Error& error, std::size_t width) {
  Table table({"", ""});
  table.row({"Shown in", "ERRNO" + (error.word == 0 ? "" : ", " + bit_text(error))});
  if (error.never.empty())
    table.row({"Reaction", "as ERRCOND (33-83) says; ON ERROR GOSUB is called, without it the program ends"});
  else
    table.row({"Never raised", std::string(error.never)});
  return "Error " + std::to_string(error.number) + " of an MCO_305\n" + paragraph(error.text, 2, width) +
         "\n" + table.text(2, width);
}

Json device_error_json(const mco305::Error& error) {
  Json json{
      {"kind", "device_error"}, {"number", error.number}, {"text", error.text}, {"bit", bit_text(error)}};
  if (!error.never.empty()) json["not_raised"] = error.never;
  return json;
}

std::string variable_page(const mco305::SystemVariable& variable, std::size_t width) {
  Table table({"", ""});
  if (!variable.unit.empty()) table.row({"Unit", std::string(variable.unit)});
  table.row({"Read by", "SYSVAR[" + std::to_string(variable.index) + "]" +
                            (variable.built ? "" : ": not built, error 112")});
  if (variable.built)
    table.row({"Path", "SysVar." + std::to_string(variable.index) + ", SysVar." + std::string(variable.name) +
                           " below the device"});
  return "System variable " + std::to_string(variable.index) + " of an MCO_305\n" +
         paragraph(variable.text, 2, width) + "\n" + table.text(2, width);
}

Json variable_json(const mco305::SystemVariable& variable) {
  return {{"kind", "system_variable"}, {"index", variable.index}, {"name", variable.name},
          {"text", variable.text},     {"unit", variable.unit},   {"built", variable.built}};
}

std::optional<int> whole(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

Subject mco305_parameter_subject(std::string_view name) {
  const auto number = aposs::parameter_of(name);
  if (!number) return {};
  return {[n = *number](std::size_t width) { return parameter_page(n, width); },
          [n = *number] { return parameter_json(n); }};
}

Subject mco305_command_subject(std::string_view name) {
  for (const aposs::CommandRow& row : aposs::commands())
    if (same_name(row.name, name) && !aposs::meaning_of(row).empty())
      return {[&row](std::size_t width) { return command_page(row, width); },
              [&row] { return command_json(row); }};
  for (const aposs::CommandAlias& alias : aposs::command_aliases())
    if (same_name(alias.name, name) && !same_name(alias.usual, name))
      return mco305_command_subject(alias.usual);
  return {};
}

Subject mco305_error_subject(std::string_view number) {
  const auto wanted = whole(number);
  const mco305::Error* const error = wanted ? mco305::find_error(*wanted) : nullptr;
  if (error == nullptr) return {};
  return {[error](std::size_t width) { return device_error_page(*error, width); },
          [error] { return device_error_json(*error); }};
}

std::vector<std::string> mco305_error_numbers() {
  std::vector<std::string> all;
  for (const mco305::Error& error : mco305::errors()) all.push_back(std::to_string(error.number));
  return all;
}

Subject mco305_system_variable_subject(std::string_view index) {
  const auto wanted = whole(index);
  const mco305::SystemVariable* const variable = wanted ? mco305::find_system_variable(*wanted) : nullptr;
  if (variable == nullptr) return {};
  return {[variable](std::size_t width) { return variable_page(*variable, width); },
          [variable] { return variable_json(*variable); }};
}

Subject mco305_subject(const std::vector<std::string>& words) {
  if (words.size() == 1) {
    if (Subject subject = mco305_parameter_subject(words[0])) return subject;
    if (Subject subject = mco305_command_subject(words[0])) return subject;
    return mco305_error_subject(words[0]);
  }
  if (same_name(words[0], "parameter")) return mco305_parameter_subject(words[1]);
  if (same_name(words[0], "command")) return mco305_command_subject(words[1]);
  if (same_name(words[0], "error")) return mco305_error_subject(words[1]);
  if (same_name(words[0], "sysvar")) return mco305_system_variable_subject(words[1]);
  return mco305_command_subject(words[0] + " " + words[1]);
}

std::vector<Mco305Finding> mco305_findings() {
  std::vector<Mco305Finding> all;
  for (const mco305::Parameter& of : mco305::parameters())
    all.push_back({"parameter", aposs::parameter_text(of.number),
                   (of.mnemonic.empty() ? "" : std::string(of.mnemonic) + ": ") + std::string(of.title)});
  for (const aposs::CommandRow& row : aposs::commands())
    if (const std::string_view text = aposs::meaning_of(row); !text.empty())
      all.push_back({"command", std::string(row.name), std::string(text)});
  for (const mco305::Error& error : mco305::errors())
    all.push_back({"device error", "error " + std::to_string(error.number), std::string(error.text)});
  for (const mco305::SystemVariable& variable : mco305::system_variables())
    all.push_back({"sysvar", "sysvar " + std::to_string(variable.index), std::string(variable.text)});
  return all;
}

}  // namespace lockstep::cli
