/// The names of a project's Modbus map, read and written over the network as an operator's panel would.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "cli/command/command.hpp"
#include "hmi_bridge/modbus/master.hpp"
#include "projects/loader/project.hpp"

namespace lockstep::cli {

/// What `lockstep read` and `lockstep write` have in common on the command line.
struct PanelOptions {
  std::string place;    ///< HOST:PORT
  std::string project;  ///< file
  std::vector<std::string> names;
  std::optional<std::size_t>
      server;            ///< index in `modbus.server`; none: the one that listens at the endpoint
  int unit = 1;          ///< of maps that are for every unit id
  double timeout = 2.0;  ///< [s]
  bool json = false;
};

/// Where a name stands.
struct PanelEntry {
  std::string name;
  int unit;
  const ModbusMap* map;
  const ModbusEntry* entry;

  Type type() const { return map->signal_type(*entry); }
};

/// What a name stands for: a value, elements that follow each other, or a text.
struct PanelName {
  std::string name;
  std::vector<PanelEntry>
      entries;  ///< of a value one, of elements one each, of a text one for two characters
  bool is_list = false;
  std::size_t capacity = 0;  ///< characters of a text; 0: it is none

  Type type() const { return entries.front().type(); }
};

/// Adds the options to a command.
void add_panel_options(CLI::App& command, PanelOptions& options);

/// Whom a panel speaks to: where, and which maps are there.
struct PanelTarget {
  Endpoint endpoint;
  std::vector<const ModbusMapConfig*> maps;  ///< of the project
};

/// The target of the options, or nothing: then that is told. Unless the options name it, the server is the
/// one that listens at this host and port, else the one that listens at this port (the host may be called by
/// another name); where several do, or none, nothing is guessed: all servers that it might be have to have
/// the same maps.
std::optional<PanelTarget> find_target(const Project& project, const PanelOptions& options);

/// A connection to a running project. Messages go to standard error.
class ModbusPanel {
 public:
  /// @param project outlives it
  ModbusPanel(const Project& project, const PanelOptions& options, PanelTarget target);

  /// What a name stands for, or nothing: then that is told. Of "heights" and "heights[*]" those elements
  /// count that the map has; of "heights[2..5]" it has to have all.
  /// @param to_write addresses that can be written
  std::optional<PanelName> find(const std::string& name, bool to_write) const;
  /// Whether there is a map at all; that there is none is told.
  bool has_map() const;
  /// All names of the maps, each once.
  std::vector<PanelName> all() const;
  /// Connects; false if that cannot be, which is told.
  bool connect();
  /// Each tells what goes wrong, and gives nothing or false. What stands side by side goes in one request, as
  /// far as one may carry it.
  std::optional<std::vector<Value>> read(const PanelName& name);
  bool write(const PanelName& name, std::span<const Value> values);

 private:
  struct Places {
    PanelEntry first;
    std::optional<PanelEntry> writable;
  };
  struct Block;

  std::optional<PanelName> find_text(const StringTag& tag, bool to_write) const;
  PanelName name_of(const ModbusMapConfig& map, const ModbusText& text) const;
  std::optional<PanelEntry> place_of(const std::string& name, bool to_write) const;
  PanelEntry place_of(const ModbusMapConfig& map, const ModbusEntry& entry) const;
  bool tell_unknown(const std::string& name) const;
  bool tell_failure(const PanelEntry& place) const;
  static std::vector<Block> blocks_of(std::span<const PanelEntry> entries, bool to_write);
  std::optional<Value> value_of(const PanelEntry& place, std::span<const std::uint16_t> words) const;

  const Project& project_;
  const PanelOptions& options_;
  const PanelTarget target_;
  const int common_unit_;                           // of maps that are for every unit id
  std::unordered_map<std::string, Places> places_;  // by folded name
  std::optional<ModbusMaster> master_;
};

/// What is wrong with a value that is to be written; empty if nothing is.
std::string write_problem(const PanelEntry& place, Value value);

}  // namespace lockstep::cli
