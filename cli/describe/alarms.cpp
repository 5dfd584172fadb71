// lockstep describe: technology alarms and error identifiers.
#include <nlohmann/json.hpp>

#include "cli/describe/subject.hpp"
#include "cli/describe/table.hpp"
#include "cli/describe/values.hpp"
#include "tech_objects/alarms/error_remedies.hpp"
#include "tech_objects/alarms/reactions.hpp"
#include "tech_objects/data_blocks/status_bits.hpp"

namespace lockstep::cli {
namespace {

std::string reaction_text(const Alarm& alarm) {
  return std::string(alarm_reaction_text(alarm.reaction));
}

std::string_view class_text(AlarmClass alarm_class) {
  switch (alarm_class) {
    case AlarmClass::warning:
      return "warning: MC_Reset or the end of its cause clears it";
    case AlarmClass::acknowledgeable:
      return "acknowledged with MC_Reset, then new jobs";
    case AlarmClass::fatal:
      return "fatal: restart of the technology object";
  }
  return "";
}
std::string_view class_name(AlarmClass alarm_class) {
  constexpr std::string_view names[] = {"warning", "acknowledgeable", "fatal"};
  return names[static_cast<std::size_t>(alarm_class)];
}

std::string bit_text(const Alarm& alarm) {
  const auto name = [](const BitNames& names, int bit) {
    return ".X" + std::to_string(bit) + " " + std::string(names[static_cast<std::size_t>(bit)]);
  };
  if (alarm.error_bit >= 0) return "ErrorWord" + name(kErrorBitNames, alarm.error_bit);
  return alarm.warning_bit >= 0 ? "WarningWord" + name(kWarningBitNames, alarm.warning_bit) : "";
}

nlohmann::ordered_json alarm_json(const Alarm& alarm) {
  nlohmann::ordered_json json{{"kind", "alarm"},
                              {"number", alarm.number},
                              {"text", alarm.text},
                              {"reaction", alarm.reaction},
                              {"reaction_text", reaction_text(alarm)},
                              {"class", class_name(alarm.alarm_class)}};
  if (!alarm.cause.empty()) json["cause"] = alarm.cause;
  if (!alarm.remedy.empty()) json["remedy"] = alarm.remedy;
  if (!alarm.values.value.empty()) json["value"] = alarm.values.value;
  if (!alarm.values.limit.empty()) json["limit"] = alarm.values.limit;
  if (alarm.error_bit >= 0) json["error_bit"] = alarm.error_bit;
  if (alarm.warning_bit >= 0) json["warning_bit"] = alarm.warning_bit;
  if (!alarm.not_raised.empty()) json["not_raised"] = alarm.not_raised;
  return json;
}

std::string alarm_text(const Alarm& alarm, std::size_t width) {
  Table table({"", ""});
  table.row({"Reaction", std::to_string(alarm.reaction) + ": " + reaction_text(alarm)});
  table.row({"Shown in", "ErrorDetail.Number, ErrorDetail.Reaction" +
                             (bit_text(alarm).empty() ? "" : ", " + bit_text(alarm))});
  table.row({"Class", std::string(class_text(alarm.alarm_class))});
  if (!alarm.cause.empty()) table.row({"Cause", std::string(alarm.cause)});
  if (!alarm.remedy.empty()) table.row({"Remedy", std::string(alarm.remedy)});
  if (!alarm.values.value.empty())
    table.row(
        {"Told with it", std::string(alarm.values.value) +
                             (alarm.values.limit.empty() ? "" : ", " + std::string(alarm.values.limit))});
  if (!alarm.not_raised.empty()) table.row({"Never raised", std::string(alarm.not_raised)});
  return "Alarm " + std::to_string(alarm.number) + "\n" + paragraph(alarm.text, 2, width) + "\n" +
         table.text(2, width);
}

/// The pins for whose values an error is reported, as "MC_Home.Mode".
std::vector<std::string> pins_with(ErrorId id) {
  std::vector<std::string> names;
  for (const BlockType& type : block_types())
    for (const Pin& pin : type.pins)
      if (pin.error == id && id != ErrorId::none)
        names.push_back(std::string(type.name) + "." + std::string(pin.name));
  return names;
}

nlohmann::ordered_json error_json(ErrorId id) {
  return {{"kind", "error"},
          {"id", error_literal(static_cast<unsigned>(id))},
          {"text", error_text(id)},
          {"remedy", error_remedy(id)},
          {"pins", pins_with(id)}};
}

std::string error_page(ErrorId id, std::size_t width) {
  std::string text = "ErrorID " + error_literal(static_cast<unsigned>(id)) + "\n";
  text += paragraph(error_text(id), 2, width);
  if (const std::string_view remedy = error_remedy(id); !remedy.empty())
    text += "\n" + paragraph("Remedy: " + std::string(remedy), 2, width);
  std::string pins;
  for (const std::string& name : pins_with(id)) pins += (pins.empty() ? "" : ", ") + name;
  if (!pins.empty()) text += "\n" + paragraph("Reported for a value that is not permitted at:", 2, width);
  return pins.empty() ? text : text + paragraph(pins, 4, width);
}

std::string alarms_text(std::size_t width) {
  Table table({"Alarm", "Reaction", "Class", "Meaning"});
  for (const Alarm& alarm : alarms()) {
    table.row({std::to_string(alarm.number), std::to_string(alarm.reaction),
               std::string(class_name(alarm.alarm_class)), std::string(alarm.text)});
    if (!alarm.cause.empty()) table.note("cause: " + std::string(alarm.cause));
    if (!alarm.remedy.empty()) table.note("remedy: " + std::string(alarm.remedy));
  }
  std::string text = "Technology alarms\n";
  text += paragraph("ErrorDetail.Number of an object; lockstep describe NUMBER tells more.", 2, width) + "\n";
  text += table.text(0, width) + "\n";
  Table reactions({"Reaction", "Meaning"});
  for (std::size_t i = 0; i < std::size(kAlarmReactions); ++i)
    reactions.row({std::to_string(i), std::string(kAlarmReactions[i])});
  return text + reactions.text(0, width);
}

std::string errors_text(std::size_t width) {
  Table table({"ErrorID", "Meaning"});
  for (const ErrorText& error : error_texts()) {
    table.row({error_literal(static_cast<unsigned>(error.id)), std::string(error.text)});
    if (const std::string_view remedy = error_remedy(error.id); !remedy.empty())
      table.note("remedy: " + std::string(remedy));
  }
  return "Error identifiers\n" +
         paragraph("Output ErrorID of a block; lockstep describe 16#8026 tells which inputs report one.", 2,
                   width) +
         "\n" + table.text(0, width);
}

}  // namespace

Subject alarm_subject(const Alarm& alarm) {
  return {[&alarm](std::size_t width) { return alarm_text(alarm, width); },
          [&alarm] { return alarm_json(alarm); }};
}

Subject alarms_subject() {
  return {&alarms_text, [] {
            nlohmann::ordered_json json{{"kind", "alarms"}};
            auto& list = json["alarms"] = nlohmann::ordered_json::array();
            for (const Alarm& alarm : alarms()) list.push_back(alarm_json(alarm));
            return json;
          }};
}

Subject error_subject(ErrorId id) {
  return {[id](std::size_t width) { return error_page(id, width); }, [id] { return error_json(id); }};
}

Subject errors_subject() {
  return {&errors_text, [] {
            nlohmann::ordered_json json{{"kind", "errors"}};
            auto& list = json["errors"] = nlohmann::ordered_json::array();
            for (const ErrorText& error : error_texts()) list.push_back(error_json(error.id));
            return json;
          }};
}

}  // namespace lockstep::cli
