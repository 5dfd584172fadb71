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
  const ModbusMapConfig* map;
};

/// The Modbus map, sorted by what it names.
struct Entries {
  std::vector<std::vector<Entry>> of_tags;  ///< for each tag of the controller
  std::vector<Entry> others;                ///< pins, variables, bits of tags
};

void sort_map(const Project& project, const ModbusMapConfig& map, Entries& entries) {
  const auto& tags = project.controller->tags;
  for (const ModbusEntry& place : map.map.entries()) {
    const NamedSignal signal = project.modbus.signal_of(place);
    const Entry entry{signal.name, map.map.signal_type(place), signal.unit, &place, &map};
    const FoundPlace found = project.names.find(signal.name);
    bool is_tag = false;
    for (std::size_t i = 0; i < tags.size() && found.place && signal.signal.bit < 0; ++i) {
      if (found.place->tag != &tags[i]) continue;
      entries.of_tags[i].push_back(entry);
      is_tag = true;
    }
    if (!is_tag) entries.others.push_back(entry);
  }
}

Entries sort_entries(const Project& project) {
  Entries entries;
  entries.of_tags.resize(project.controller->tags.size());
  for (const ModbusMapConfig& map : project.modbus.maps) sort_map(project, map, entries);
  return entries;
}

std::string address_text(const ModbusEntry& place) {
  const std::uint32_t last = place.address + modbus_span(place) - 1;
  return last == place.address ? std::to_string(last) : fmt::format("{}-{}", place.address, last);
}

/// Type on the wire; bit, orders and scale only where there is something unusual.
std::string wire_text(const ModbusEntry& place) {
  std::string text(type_name(place.type));
  if (place.bit >= 0) text += fmt::format(" bit {}", place.bit);
  if (place.word_order == WordOrder::little) text += " little";
  if (place.byte_order == ByteOrder::little) text += " swapped";
  if (place.is_scaled) text += fmt::format(" * {}", place.scale);
  if (place.is_scaled && place.offset != 0.0) text += fmt::format(" {:+}", place.offset);
  return text;
}

/// For whom a map is, where it is not for everybody.
std::string table_text(const Entry& entry) {
  std::string text(modbus_table_name(entry.place->table));
  if (entry.map->server) text += fmt::format(" server {}", *entry.map->server);
  if (entry.map->unit) text += fmt::format(" unit {}", *entry.map->unit);
  return text;
}

/// The cells of an entry: table, address, type, access.
std::vector<std::string> cells(const Entry& entry) {
  const ModbusEntry& place = *entry.place;
  return {table_text(entry), address_text(place), wire_text(place), place.writable ? "write" : "read"};
}

std::string tags_text(const Project& project, const Entries& entries, std::size_t width) {
  Table table({"Tag", "Type", "Initial", "Retain", "Modbus", "Address", "As", "Access", "Comment"});
  for (std::size_t i = 0; i < project.controller->tags.size(); ++i) {
    const Tag& tag = project.controller->tags[i];
    std::vector<std::string> row{tag.name, std::string(type_name(tag.type)), literal(tag.initial, tag.type),
                                 tag.retain ? "retain" : ""};
    const auto& places = entries.of_tags[i];
    for (std::string& cell : places.empty() ? std::vector<std::string>(4) : cells(places.front()))
      row.push_back(std::move(cell));
    row.push_back(printable(tag.comment));
    table.row(std::move(row));
    for (std::size_t more = 1; more < places.size(); ++more) {
      std::vector<std::string> next{"", "", "", ""};
      for (std::string& cell : cells(places[more])) next.push_back(std::move(cell));
      next.emplace_back();
      table.row(std::move(next));
    }
  }
  return table.empty() ? "" : "\n" + table.text(0, width);
}

std::string arrays_text(const Project& project, std::size_t width) {
  Table table({"Array", "Type", "Comment"});
  for (const ArrayTag& tag : project.controller->arrays)
    table.row({tag.name, array_type_name(tag.array), printable(tag.comment)});
  return table.empty() ? "" : "\n" + table.text(0, width);
}

std::string others_text(const Entries& entries, std::size_t width) {
  Table table({"Also on Modbus", "Type", "Unit", "Modbus", "Address", "As", "Access", ""});
  for (const Entry& entry : entries.others) {
    std::vector<std::string> row{entry.name, std::string(type_name(entry.type)),
                                 std::string(unit_text(entry.unit))};
    for (std::string& cell : cells(entry)) row.push_back(std::move(cell));
    row.emplace_back();
    table.row(std::move(row));
  }
  return table.empty() ? "" : "\n" + table.text(0, width);
}

/// Where the servers of the project listen.
std::vector<std::string> server_places(const Project& project) {
  std::vector<std::string> places;
  for (const ModbusServerOptions& server : project.modbus.servers)
    for (const Endpoint& place : server.listen) places.push_back(to_string(place));
  return places;
}

std::string project_text(const Project& project, std::size_t width) {
  const Entries entries = sort_entries(project);
  std::string text = printable(project.name) + "\n";
  if (!project.description.empty()) text += paragraph(printable(project.description), 2, width);
  for (const std::string& place : server_places(project)) text += "  Modbus server on " + place + "\n";
  text += tags_text(project, entries, width) + arrays_text(project, width) + others_text(entries, width);
  Table objects({"Number", "Technology object", "Type"});
  for (const auto& object : project.controller->objects)
    objects.row({std::to_string(static_cast<std::uint32_t>(object->number)), object->name,
                 std::string(kind_name(object->kind))});
  return objects.empty() ? text : text + "\n" + objects.text(0, width);
}

nlohmann::ordered_json place_json(const Entry& entry) {
  const ModbusEntry& place = *entry.place;
  nlohmann::ordered_json json{{"table", modbus_table_name(place.table)},
                              {"address", place.address},
                              {is_bit_table(place.table) ? "bits" : "registers", modbus_span(place)},
                              {"type", type_name(place.type)},
                              {"word_order", place.word_order == WordOrder::big ? "big" : "little"},
                              {"access", place.writable ? "write" : "read"}};
  if (place.byte_order == ByteOrder::little) json["byte_order"] = "little";
  if (place.bit >= 0) json["bit"] = place.bit;
  if (place.is_scaled) json["scale"] = place.scale;
  if (place.is_scaled) json["offset"] = place.offset;
  if (entry.map->server) json["server"] = *entry.map->server;
  if (entry.map->unit) json["unit"] = *entry.map->unit;
  return json;
}

nlohmann::ordered_json tag_json(const Tag& tag, const std::vector<Entry>& places) {
  nlohmann::ordered_json json{{"name", tag.name},
                              {"type", type_name(tag.type)},
                              {"initial", json_value(tag.initial, tag.type)},
                              {"retain", tag.retain},
                              {"comment", tag.comment}};
  auto& modbus = json["modbus"] = nlohmann::ordered_json::array();
  for (const Entry& entry : places) modbus.push_back(place_json(entry));
  return json;
}

nlohmann::ordered_json project_json(const Project& project) {
  const Entries entries = sort_entries(project);
  nlohmann::ordered_json json{{"name", project.name}, {"description", project.description}};
  const std::vector<std::string> servers = server_places(project);
  if (!servers.empty()) json["modbus_server"] = servers.front();
  if (servers.size() > 1) json["modbus_servers"] = servers;
  auto& tags = json["tags"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < project.controller->tags.size(); ++i)
    tags.push_back(tag_json(project.controller->tags[i], entries.of_tags[i]));
  auto& arrays = json["arrays"] = nlohmann::ordered_json::array();
  for (const ArrayTag& tag : project.controller->arrays)
    arrays.push_back({{"name", tag.name},
                      {"type", array_type_name(tag.array)},
                      {"lower", tag.array.lower},
                      {"upper", tag.array.upper},
                      {"of", tag.array.element->name},
                      {"comment", tag.comment}});
  auto& others = json["other_modbus"] = nlohmann::ordered_json::array();
  for (const Entry& entry : entries.others) {
    nlohmann::ordered_json other{{"name", entry.name}, {"type", type_name(entry.type)}};
    if (entry.unit != Unit::kNone) other["unit"] = unit_text(entry.unit);
    other["modbus"] = place_json(entry);
    others.push_back(std::move(other));
  }
  auto& objects = json["technology_objects"] = nlohmann::ordered_json::array();
  for (const auto& object : project.controller->objects)
    objects.push_back({{"number", static_cast<std::uint32_t>(object->number)},
                       {"name", object->name},
                       {"type", kind_name(object->kind)}});
  return json;
}

/// A cell of a CSV file (RFC 4180).
std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

/// One line for each place on Modbus, for the import of HMI systems.
std::string project_csv(const Project& project) {
  std::string text =
      "name,type,unit,table,address,length,wire_type,word_order,byte_order,bit,scale,offset,access,server,"
      "unit_id,comment\r\n";
  const Entries entries = sort_entries(project);
  const auto line = [&](const Entry& entry, const std::string& comment) {
    const ModbusEntry& place = *entry.place;
    const auto order = [](bool is_big) { return is_big ? "big" : "little"; };
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", csv_cell(entry.name), type_name(entry.type),
        unit_text(entry.unit), modbus_table_name(place.table), place.address, modbus_span(place),
        type_name(place.type), order(place.word_order == WordOrder::big),
        order(place.byte_order == ByteOrder::big), place.bit >= 0 ? std::to_string(place.bit) : "",
        place.is_scaled ? fmt::format("{}", place.scale) : "",
        place.is_scaled ? fmt::format("{}", place.offset) : "", place.writable ? "write" : "read",
        entry.map->server ? std::to_string(*entry.map->server) : "",
        entry.map->unit ? std::to_string(*entry.map->unit) : "", csv_cell(comment));
  };
  for (std::size_t i = 0; i < entries.of_tags.size(); ++i)
    for (const Entry& entry : entries.of_tags[i]) line(entry, project.controller->tags[i].comment);
  for (const Entry& entry : entries.others) line(entry, "");
  return text;
}

enum class Form { text, json, csv };

int tell_tags(const std::string& file, Form form) {
  int status = kOk;
  const std::optional<Project> project = load_or_tell(file, status);
  if (!project) return status;
  const std::string text = form == Form::json  ? project_json(*project).dump(2) + "\n"
                           : form == Form::csv ? project_csv(*project)
                                               : project_text(*project, output_width());
  std::fwrite(text.data(), 1, text.size(), stdout);
  return kOk;
}

}  // namespace

void add_tags_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "tags", "List a project's tags with their Modbus addresses, and its objects' numbers");
  auto file = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  auto csv = std::make_shared<bool>(false);
  command->add_option("FILE", *file, "the project file")->required();
  auto* const as_json = command->add_flag("--json", *json, "as JSON, for programs");
  command->add_flag("--csv", *csv, "what is on Modbus as CSV, for HMI systems")->excludes(as_json);
  command->footer(
      "Address: zero-based, first to last. As: the type on the wire, most significant word first unless it\n"
      "says little. Access: what a client may do. Number: what ActualMaster shows.\n"
      "Exit status: 0, 1 project not valid, 2 cannot be read");
  command->callback([&action, file, json, csv] {
    action = [file, json, csv] {
      return tell_tags(*file, *json ? Form::json : *csv ? Form::csv : Form::text);
    };
  });
}

}  // namespace lockstep::cli
