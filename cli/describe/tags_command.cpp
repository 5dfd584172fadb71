// lockstep tags: the tags of a project, where they stand on Modbus, and the numbers of its objects.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/command/command.hpp"
#include "cli/command/standard_streams.hpp"
#include "cli/describe/table.hpp"
#include "cli/describe/values.hpp"
#include "hmi_bridge/traces/text_literal.hpp"

namespace lockstep::cli {
namespace {

/// An entry of the Modbus map with the name of its signal, or those of elements that follow each other.
struct Entry {
  std::string name;
  std::string type;          ///< of the signal
  std::string unit;          ///< as the project has it; empty for none
  const ModbusEntry* place;  ///< the first one
  const ModbusMapConfig* map;
  std::uint32_t span;  ///< addresses of all

  std::uint32_t elements = 0;         ///< 0: a single value
  const StringTag* string = nullptr;  ///< of a text
};

/// Type on the wire; that of a text is told as such, whatever its registers are made of.
std::string_view wire_type(const Entry& entry) {
  return entry.string != nullptr ? "STRING" : type_name(entry.place->type);
}

/// Of a text, which of two characters is the more significant byte.
bool is_big_byte_order(const Entry& entry) {
  return (entry.place->byte_order == ByteOrder::big) == (entry.string == nullptr);
}

/// The Modbus map, sorted by what it names.
struct Entries {
  std::vector<std::vector<Entry>> of_tags;     ///< for each tag of the controller
  std::vector<std::vector<Entry>> of_arrays;   ///< for each array of the controller, of all its elements
  std::vector<std::vector<Entry>> of_strings;  ///< for each text of the controller
  std::vector<Entry> others;                   ///< pins, variables, bits of tags, some elements of arrays
};

/// The tag or array that is shown as it is, in `tags` or `arrays`; else the entry is one of the others.
void sort_entry(const Project& project, Entry entry, Entries& entries) {
  const auto& tags = project.controller->tags;
  const auto& arrays = project.controller->arrays;
  for (std::size_t i = 0; i < arrays.size() && entry.elements > 0; ++i)
    if (same_name(arrays[i].name, entry.name)) return entries.of_arrays[i].push_back(std::move(entry));
  const FoundOperand found = entry.elements > 0 ? FoundOperand{} : project.names.find(entry.name);
  for (std::size_t i = 0; i < tags.size() && found.place && found.place->signal.bit < 0; ++i)
    if (found.place->tag == &tags[i]) return entries.of_tags[i].push_back(std::move(entry));
  entries.others.push_back(std::move(entry));
}

void add_text(const Project& project, const ModbusMapConfig& map, const ModbusText& text, Entries& entries) {
  const auto& strings = project.controller->strings;
  for (std::size_t i = 0; i < strings.size(); ++i)
    if (&strings[i] == text.tag)
      entries.of_strings[i].push_back({text.tag->name, text_type_name(text.tag->text.capacity), "",
                                       &map.map.entries()[text.first], &map,
                                       static_cast<std::uint32_t>(text.count()), 0, text.tag});
}

void sort_map(const Project& project, const ModbusMapConfig& map, Entries& entries) {
  auto array = map.arrays.begin();
  auto text = map.texts.begin();
  const auto& places = map.map.entries();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const ModbusEntry& place = places[i];
    if (text != map.texts.end() && text->first == i) {
      add_text(project, map, *text, entries);
      i += text++->count() - 1;
      continue;
    }
    if (array != map.arrays.end() && array->first == i) {
      const ElementPath& elements = array->elements;
      const ModbusEntry& last = places[i + elements.count() - 1];
      sort_entry(
          project,
          {elements.name, elements.type, std::string(unit_text(elements.place.unit)), &place, &map,
           last.address + modbus_span(last) - place.address, static_cast<std::uint32_t>(elements.count())},
          entries);
      i += elements.count() - 1;
      ++array;
      continue;
    }
    const NamedSignal signal = project.modbus.signal_of(place);
    sort_entry(project,
               {signal.name, std::string(type_name(map.map.signal_type(place))), unit_of(signal), &place,
                &map, modbus_span(place)},
               entries);
  }
}

Entries sort_entries(const Project& project) {
  Entries entries;
  entries.of_tags.resize(project.controller->tags.size());
  entries.of_arrays.resize(project.controller->arrays.size());
  entries.of_strings.resize(project.controller->strings.size());
  for (const ModbusMapConfig& map : project.modbus.maps) sort_map(project, map, entries);
  return entries;
}

std::string address_text(const Entry& entry) {
  const std::uint32_t first = entry.place->address;
  const std::uint32_t last = first + entry.span - 1;
  return last == first ? std::to_string(last) : fmt::format("{}-{}", first, last);
}

/// Type on the wire; bit, orders and scale only where there is something unusual.
std::string wire_text(const Entry& entry) {
  const ModbusEntry& place = *entry.place;
  std::string text = entry.elements > 0 ? fmt::format("{} ", entry.elements) : "";
  text += wire_type(entry);
  if (place.bit >= 0) text += fmt::format(" bit {}", place.bit);
  if (place.word_order == WordOrder::little) text += " little";
  if (!is_big_byte_order(entry)) text += " swapped";
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

/// Limits as the project says them: of a scaled entry the range is wider by what rounding may do.
Range told_range(const ModbusEntry& place) {
  const double rounding = place.is_scaled ? 1e-6 * std::abs(place.scale) : 0.0;
  const auto told = [](double value) {
    return std::isfinite(value) ? std::stod(fmt::format("{:.12g}", value)) : value;
  };
  return {told(place.range.lowest + rounding), told(place.range.highest - rounding)};
}

/// What a client may do, and between which values.
std::string access_text(const ModbusEntry& place) {
  if (!place.writable) return "read";
  constexpr double kFar = 1e12;  // the range of every number in a data block
  const Range range = told_range(place);
  const bool from = std::abs(range.lowest) < kFar, to = std::abs(range.highest) < kFar;
  return std::string("write") + (from ? fmt::format(" {}", range.lowest) : "") +
         (to     ? fmt::format(" to {}", range.highest)
          : from ? " or more"
                 : "");
}

/// The cells of an entry: table, address, type, access.
std::vector<std::string> cells(const Entry& entry) {
  return {table_text(entry), address_text(entry), wire_text(entry), access_text(*entry.place)};
}

bool is_kept(const Project& project, const ArrayTag& tag) {
  const auto& arrays = project.retain.arrays;
  return std::find(arrays.begin(), arrays.end(), &tag) != arrays.end();
}

/// A row with the first of some addresses, and one more for each further one; the comment stands last.
void add_rows(Table& table, std::vector<std::string> row, const std::vector<Entry>& places,
              const std::string& comment) {
  const std::size_t before = row.size();
  for (std::string& cell : places.empty() ? std::vector<std::string>(4) : cells(places.front()))
    row.push_back(std::move(cell));
  row.push_back(printable(comment));
  table.row(std::move(row));
  for (std::size_t more = 1; more < places.size(); ++more) {
    std::vector<std::string> next(before);
    for (std::string& cell : cells(places[more])) next.push_back(std::move(cell));
    next.emplace_back();
    table.row(std::move(next));
  }
}

std::string tags_text(const Project& project, const Entries& entries, std::size_t width) {
  Table table({"Tag", "Type", "Initial", "Retain", "Modbus", "Address", "As", "Access", "Comment"});
  for (std::size_t i = 0; i < project.controller->tags.size(); ++i) {
    const Tag& tag = project.controller->tags[i];
    add_rows(table,
             {tag.name, std::string(type_name(tag.type)), literal(tag.initial, tag.type),
              tag.retain ? "retain" : ""},
             entries.of_tags[i], tag.comment);
  }
  return table.empty() ? "" : "\n" + table.text(0, width);
}

std::string arrays_text(const Project& project, const Entries& entries, std::size_t width) {
  Table table({"Array", "Type", "Retain", "Modbus", "Address", "As", "Access", "Comment"});
  for (std::size_t i = 0; i < project.controller->arrays.size(); ++i) {
    const ArrayTag& tag = project.controller->arrays[i];
    add_rows(table, {tag.name, array_type_name(tag.array), is_kept(project, tag) ? "retain" : ""},
             entries.of_arrays[i], tag.comment);
  }
  return table.empty() ? "" : "\n" + table.text(0, width);
}

std::string strings_text(const Project& project, const Entries& entries, std::size_t width) {
  Table table({"Text", "Type", "Initial", "Retain", "Modbus", "Address", "As", "Access", "Comment"});
  for (std::size_t i = 0; i < project.controller->strings.size(); ++i) {
    const StringTag& tag = project.controller->strings[i];
    add_rows(
        table,
        {tag.name, text_type_name(tag.text.capacity), text_literal(tag.initial), tag.retain ? "retain" : ""},
        entries.of_strings[i], tag.comment);
  }
  return table.empty() ? "" : "\n" + table.text(0, width);
}

std::string others_text(const Entries& entries, std::size_t width) {
  Table table({"Also on Modbus", "Type", "Unit", "Modbus", "Address", "As", "Access", ""});
  for (const Entry& entry : entries.others) {
    std::vector<std::string> row{entry.name, entry.type, entry.unit};
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
  text += tags_text(project, entries, width) + arrays_text(project, entries, width) +
          strings_text(project, entries, width) + others_text(entries, width);
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
                              {is_bit_table(place.table) ? "bits" : "registers", entry.span},
                              {"type", wire_type(entry)},
                              {"word_order", place.word_order == WordOrder::big ? "big" : "little"},
                              {"access", place.writable ? "write" : "read"}};
  if (entry.elements > 0) json["elements"] = entry.elements;
  if (!is_big_byte_order(entry)) json["byte_order"] = "little";
  if (place.bit >= 0) json["bit"] = place.bit;
  if (place.is_scaled) json["scale"] = place.scale;
  if (place.is_scaled) json["offset"] = place.offset;
  const Range range = told_range(place);
  if (std::isfinite(range.lowest)) json["min"] = range.lowest;
  if (std::isfinite(range.highest)) json["max"] = range.highest;
  if (entry.map->server) json["server"] = *entry.map->server;
  if (entry.map->unit) json["unit"] = *entry.map->unit;
  return json;
}

nlohmann::ordered_json places_json(const std::vector<Entry>& places) {
  auto json = nlohmann::ordered_json::array();
  for (const Entry& entry : places) json.push_back(place_json(entry));
  return json;
}

nlohmann::ordered_json tag_json(const Tag& tag, const std::vector<Entry>& places) {
  nlohmann::ordered_json json{{"name", tag.name},
                              {"type", type_name(tag.type)},
                              {"initial", json_value(tag.initial, tag.type)},
                              {"retain", tag.retain},
                              {"comment", tag.comment}};
  json["modbus"] = places_json(places);
  return json;
}

nlohmann::ordered_json arrays_json(const Project& project, const Entries& entries) {
  auto arrays = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < project.controller->arrays.size(); ++i) {
    const ArrayTag& tag = project.controller->arrays[i];
    arrays.push_back({{"name", tag.name},
                      {"type", array_type_name(tag.array)},
                      {"lower", tag.array.lower},
                      {"upper", tag.array.upper},
                      {"of", tag.array.element->name},
                      {"retain", is_kept(project, tag)},
                      {"comment", tag.comment},
                      {"modbus", places_json(entries.of_arrays[i])}});
  }
  return arrays;
}

nlohmann::ordered_json strings_json(const Project& project, const Entries& entries) {
  auto strings = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < project.controller->strings.size(); ++i) {
    const StringTag& tag = project.controller->strings[i];
    strings.push_back({{"name", tag.name},
                       {"type", text_type_name(tag.text.capacity)},
                       {"initial", text_to_utf8(tag.initial)},
                       {"retain", tag.retain},
                       {"comment", tag.comment},
                       {"modbus", places_json(entries.of_strings[i])}});
  }
  return strings;
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
  json["arrays"] = arrays_json(project, entries);
  json["strings"] = strings_json(project, entries);
  auto& others = json["other_modbus"] = nlohmann::ordered_json::array();
  for (const Entry& entry : entries.others) {
    nlohmann::ordered_json other{{"name", entry.name}, {"type", entry.type}};
    if (!entry.unit.empty()) other["unit"] = entry.unit;
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

/// A cell of a CSV file (RFC 4180). Lines of a text stay lines.
std::string csv_cell(std::string_view text) {
  const bool is_plain = text.find_first_of(",\"\r\n") == text.npos;
  std::string cell;
  while (true) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    for (const char c : visible(text.substr(0, end))) cell += c == '"' ? "\"\"" : std::string(1, c);
    if (end == text.size()) break;
    cell += '\n';
    text.remove_prefix(end + 1);
  }
  return is_plain ? cell : "\"" + cell + "\"";
}

/// One line for each address on Modbus, for the import of HMI systems; an array is one of ARRAY type, with
/// the addresses of all its elements.
std::string project_csv(const Project& project) {
  std::string text =
      "name,type,unit,table,address,length,wire_type,word_order,byte_order,bit,scale,offset,access,server,"
      "unit_id,comment,min,max\r\n";
  const Entries entries = sort_entries(project);
  const auto line = [&](const Entry& entry, const std::string& comment) {
    const ModbusEntry& place = *entry.place;
    const Range range = told_range(place);
    const auto limit = [](double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; };
    const auto order = [](bool is_big) { return is_big ? "big" : "little"; };
    text +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", csv_cell(entry.name),
                    csv_cell(entry.type), entry.unit, modbus_table_name(place.table), place.address,
                    entry.span, wire_type(entry), order(place.word_order == WordOrder::big),
                    order(is_big_byte_order(entry)), place.bit >= 0 ? std::to_string(place.bit) : "",
                    place.is_scaled ? fmt::format("{}", place.scale) : "",
                    place.is_scaled ? fmt::format("{}", place.offset) : "", place.writable ? "write" : "read",
                    entry.map->server ? std::to_string(*entry.map->server) : "",
                    entry.map->unit ? std::to_string(*entry.map->unit) : "", csv_cell(comment),
                    limit(range.lowest), limit(range.highest));
  };
  for (std::size_t i = 0; i < entries.of_tags.size(); ++i)
    for (const Entry& entry : entries.of_tags[i]) line(entry, project.controller->tags[i].comment);
  for (std::size_t i = 0; i < entries.of_arrays.size(); ++i)
    for (const Entry& entry : entries.of_arrays[i]) line(entry, project.controller->arrays[i].comment);
  for (std::size_t i = 0; i < entries.of_strings.size(); ++i)
    for (const Entry& entry : entries.of_strings[i]) line(entry, project.controller->strings[i].comment);
  for (const Entry& entry : entries.others) line(entry, "");
  return text;
}

enum class Form { text, json, csv };

int tell_tags(const std::string& file, Form form) {
  int status = kOk;
  const std::optional<Project> project = load_or_tell(file, status);
  if (!project) return status;
  const std::string text = form == Form::json  ? json_text(project_json(*project)) + "\n"
                           : form == Form::csv ? project_csv(*project)
                                               : project_text(*project, output_width());
  write_data(text);
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
      "says little, with the number of elements of an array. Access: what a client may do. Number: what\n"
      "ActualMaster shows.\n"
      "Exit status: 0, 1 project not valid, 2 cannot be read");
  command->callback([&action, file, json, csv] {
    action = [file, json, csv] {
      return tell_tags(*file, *json ? Form::json : *csv ? Form::csv : Form::text);
    };
  });
}

}  // namespace lockstep::cli
