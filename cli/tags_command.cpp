// lockstep tags: the tags of a project, where they stand on Modbus, and the numbers of its objects.
#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/describe_table.hpp"
#include "cli/describe_values.hpp"

namespace lockstep::cli {
namespace {

/// An entry of the Modbus map with the name of its signal.
struct Entry {
  std::string name;
  Type type;  ///< of the signal
  Unit unit;
  const ModbusEntry* place;
};

/// The Modbus map, sorted by what it names.
struct Entries {
  std::vector<std::vector<Entry>> of_tags;  ///< for each tag of the controller
  std::vector<Entry> others;                ///< pins, variables, bits of tags
};

Entries sort_entries(const Project& project) {
  Entries entries;
  const auto& tags = project.controller->tags;
  entries.of_tags.resize(tags.size());
  for (const ModbusEntry& place : project.modbus.map->entries()) {
    const NamedSignal& signal = project.modbus.signals[place.signal];
    const Entry entry{signal.name, signal.signal.value_type(), signal.unit, &place};
    const FoundPlace found = project.names.find(signal.name);
    bool is_tag = false;
    for (std::size_t i = 0; i < tags.size() && found.place && signal.signal.bit < 0; ++i) {
      if (found.place->tag != &tags[i]) continue;
      entries.of_tags[i].push_back(entry);
      is_tag = true;
    }
    if (!is_tag) entries.others.push_back(entry);
  }
  return entries;
}

std::string address_text(const ModbusEntry& place) {
  const std::uint32_t last = place.address + modbus_span(place) - 1;
  return last == place.address ? std::to_string(last) : fmt::format("{}-{}", place.address, last);
}

/// Type on the wire; the order of the words only where it is not the usual one.
std::string wire_text(const ModbusEntry& place) {
  return std::string(type_name(place.type)) + (place.word_order == WordOrder::little ? " little" : "");
}

/// The cells of an entry: table, address, type, access.
std::vector<std::string> cells(const ModbusEntry& place) {
  return {std::string(modbus_table_name(place.table)), address_text(place), wire_text(place),
          place.writable ? "write" : "read"};
}

std::string tags_text(const Project& project, const Entries& entries, std::size_t width) {
  Table table({"Tag", "Type", "Initial", "Retain", "Modbus", "Address", "As", "Access", "Comment"});
  for (std::size_t i = 0; i < project.controller->tags.size(); ++i) {
    const Tag& tag = project.controller->tags[i];
    std::vector<std::string> row{tag.name, std::string(type_name(tag.type)), literal(tag.initial, tag.type),
                                 tag.retain ? "retain" : ""};
    const auto& places = entries.of_tags[i];
    for (std::string& cell : places.empty() ? std::vector<std::string>(4) : cells(*places.front().place))
      row.push_back(std::move(cell));
    row.push_back(printable(tag.comment));
    table.row(std::move(row));
    for (std::size_t more = 1; more < places.size(); ++more) {
      std::vector<std::string> next{"", "", "", ""};
      for (std::string& cell : cells(*places[more].place)) next.push_back(std::move(cell));
      next.emplace_back();
      table.row(std::move(next));
    }
  }
  return table.empty() ? "" : "\n" + table.text(0, width);
}

std::string others_text(const Entries& entries, std::size_t width) {
  Table table({"Also on Modbus", "Type", "Unit", "Modbus", "Address", "As", "Access", ""});
  for (const Entry& entry : entries.others) {
    std::vector<std::string> row{entry.name, std::string(type_name(entry.type)),
                                 std::string(unit_text(entry.unit))};
    for (std::string& cell : cells(*entry.place)) row.push_back(std::move(cell));
    row.emplace_back();
    table.row(std::move(row));
  }
  return table.empty() ? "" : "\n" + table.text(0, width);
}

std::string project_text(const Project& project, std::size_t width) {
  const Entries entries = sort_entries(project);
  std::string text = printable(project.name) + "\n";
  if (!project.description.empty()) text += paragraph(printable(project.description), 2, width);
  if (project.modbus.listen)
    text +=
        fmt::format("  Modbus server on {}:{}\n", project.modbus.listen->host, project.modbus.listen->port);
  text += tags_text(project, entries, width) + others_text(entries, width);
  Table objects({"Number", "Technology object", "Type"});
  for (const auto& object : project.controller->objects)
    objects.row({std::to_string(static_cast<std::uint32_t>(object->number)), object->name,
                 std::string(kind_name(object->kind))});
  return objects.empty() ? text : text + "\n" + objects.text(0, width);
}

nlohmann::ordered_json place_json(const ModbusEntry& place) {
  return {{"table", modbus_table_name(place.table)},
          {"address", place.address},
          {is_bit_table(place.table) ? "bits" : "registers", modbus_span(place)},
          {"type", type_name(place.type)},
          {"word_order", place.word_order == WordOrder::big ? "big" : "little"},
          {"access", place.writable ? "write" : "read"}};
}

nlohmann::ordered_json tag_json(const Tag& tag, const std::vector<Entry>& places) {
  nlohmann::ordered_json json{{"name", tag.name},
                              {"type", type_name(tag.type)},
                              {"initial", json_value(tag.initial, tag.type)},
                              {"retain", tag.retain},
                              {"comment", tag.comment}};
  auto& modbus = json["modbus"] = nlohmann::ordered_json::array();
  for (const Entry& entry : places) modbus.push_back(place_json(*entry.place));
  return json;
}

nlohmann::ordered_json project_json(const Project& project) {
  const Entries entries = sort_entries(project);
  nlohmann::ordered_json json{{"name", project.name}, {"description", project.description}};
  if (project.modbus.listen)
    json["modbus_server"] = fmt::format("{}:{}", project.modbus.listen->host, project.modbus.listen->port);
  auto& tags = json["tags"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < project.controller->tags.size(); ++i)
    tags.push_back(tag_json(project.controller->tags[i], entries.of_tags[i]));
  auto& others = json["other_modbus"] = nlohmann::ordered_json::array();
  for (const Entry& entry : entries.others) {
    nlohmann::ordered_json other{{"name", entry.name}, {"type", type_name(entry.type)}};
    if (entry.unit != Unit::kNone) other["unit"] = unit_text(entry.unit);
    other["modbus"] = place_json(*entry.place);
    others.push_back(std::move(other));
  }
  auto& objects = json["technology_objects"] = nlohmann::ordered_json::array();
  for (const auto& object : project.controller->objects)
    objects.push_back({{"number", static_cast<std::uint32_t>(object->number)},
                       {"name", object->name},
                       {"type", kind_name(object->kind)}});
  return json;
}

int tell_tags(const std::string& file, bool json) {
  int status = kOk;
  const std::optional<Project> project = load_or_tell(file, status);
  if (!project) return status;
  const std::string text =
      json ? project_json(*project).dump(2) + "\n" : project_text(*project, output_width());
  std::fwrite(text.data(), 1, text.size(), stdout);
  return kOk;
}

}  // namespace

void add_tags_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "tags", "List a project's tags with their Modbus addresses, and its objects' numbers");
  auto file = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  command->add_option("FILE", *file, "the project file")->required();
  command->add_flag("--json", *json, "as JSON, for programs");
  command->footer(
      "Address: zero-based, first to last. As: the type on the wire, most significant word first unless it\n"
      "says little. Access: what a client may do. Number: what ActualMaster shows.\n"
      "Exit status: 0, 1 project not valid, 2 cannot be read");
  command->callback([&action, file, json] { action = [file, json] { return tell_tags(*file, *json); }; });
}

}  // namespace lockstep::cli
