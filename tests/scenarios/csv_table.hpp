/// A CSV trace as a user's own program reads it: by columns, with nothing from Lockstep.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/scenarios/lockstep_process.hpp"

namespace lockstep::test {

struct CsvTable {
  std::vector<std::string> names;            ///< in the order of the file, `t` first
  std::vector<std::vector<double>> columns;  ///< one for each name
  std::size_t rows = 0;

  const std::vector<double>& operator[](const std::string& name) const {
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == name) return columns[i];
    ADD_FAILURE() << "the trace has no column " << name;
    static const std::vector<double> none;
    return none;
  }
  /// First row from `from` on in which a column has a value; `rows` if there is none.
  std::size_t first(const std::string& name, double value, std::size_t from = 0) const {
    const std::vector<double>& column = (*this)[name];
    for (std::size_t i = from; i < rows; ++i)
      if (column[i] == value) return i;
    return rows;
  }
};

inline CsvTable read_csv(const std::string& path) {
  CsvTable table;
  std::ifstream file(path);
  std::string line;
  const auto split = [](const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
    return parts;
  };
  if (!std::getline(file, line)) {
    ADD_FAILURE() << path << " has no first line";
    return table;
  }
  table.names = split(line);
  table.columns.resize(table.names.size());
  while (std::getline(file, line)) {
    const std::vector<std::string> parts = split(line);
    EXPECT_EQ(parts.size(), table.names.size()) << path << ": " << line;
    for (std::size_t i = 0; i < std::min(parts.size(), table.columns.size()); ++i)
      table.columns[i].push_back(std::strtod(parts[i].c_str(), nullptr));
    ++table.rows;
  }
  return table;
}

/// Simulates a project with a trace; an empty table, and a failure, if that does not end with 0.
inline CsvTable simulate(const std::string& project, const std::string& duration,
                         const std::vector<std::string>& options = {}) {
  const Directory directory;
  const std::string trace = directory.file("trace.csv");
  std::vector<std::string> arguments{"run", project, "--simulate", "--duration", duration, "--trace", trace};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Ended ended = lockstep(std::move(arguments));
  EXPECT_EQ(ended.status, 0) << ended.err;
  return ended.status == 0 ? read_csv(trace) : CsvTable{};
}

/// Distance of two positions on a ring, the shorter way.
inline double ring_distance(double a, double b, double length) {
  return std::remainder(a - b, length);
}

}  // namespace lockstep::test
