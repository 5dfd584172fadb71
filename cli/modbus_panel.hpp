/// The names of a project's Modbus map, read and written over the network as an operator's panel would.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "hmi_bridge/modbus_master.hpp"
#include "projects/project.hpp"

namespace lockstep::cli {

/// What `lockstep read` and `lockstep write` have in common on the command line.
struct PanelOptions {
  std::string place;    ///< HOST:PORT
  std::string project;  ///< file
  std::vector<std::string> names;
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

/// Adds the options to a command.
void add_panel_options(CLI::App& command, PanelOptions& options);

/// A connection to a running project. Messages go to standard error.
class ModbusPanel {
 public:
  /// @param project outlives it
  ModbusPanel(const Project& project, const PanelOptions& options);

  /// The place of a name, or nothing: then that is told. @param to_write a place that can be written
  std::optional<PanelEntry> find(const std::string& name, bool to_write) const;
  /// All places of the project, each name once.
  std::vector<PanelEntry> all() const;
  /// Connects; false if that cannot be, which is told.
  bool connect();
  /// Each tells what goes wrong, and gives nothing or false.
  std::optional<Value> read(const PanelEntry& place);
  bool write(const PanelEntry& place, Value value);

 private:
  bool tell_failure(const PanelEntry& place) const;

  const Project& project_;
  const PanelOptions& options_;
  std::optional<ModbusMaster> master_;
};

/// What is wrong with a value that is to be written; empty if nothing is.
std::string write_problem(const PanelEntry& place, Value value);

}  // namespace lockstep::cli
