// Variables that are declared as having no function yet: no example computes one of them, and none runs
// otherwise for what they hold.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "projects/loader/simulation.hpp"
#include "tech_objects/data_blocks/variable.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::later_variables_test {
namespace {

using Json = nlohmann::ordered_json;  // objects are numbered in their order

const std::string kProjects = LOCKSTEP_SOURCE_DIR "/projects";
constexpr int kSteps = 1000;
constexpr std::chrono::milliseconds kStep{10};

Signal element(const Variable& variable, std::size_t i, TechnologyObject& object) {
  const VariableAddress place{&variable, variable.offset + i * variable.stride, -1};
  return place.signal(object.data_block());
}

std::size_t elements(const Variable& variable) {
  return std::max<std::size_t>(variable.count, 1);
}

/// Calls `visit(object, variable, element)` for all variables of a project's objects that have a data block.
template <class Visit>
void for_each_variable(Simulation& machine, Visit visit) {
  for (const auto& object : machine.project().controller->objects) {
    if (object->data_block() == nullptr) continue;
    for (const auto& list : data_block_of(object->kind).lists())
      for (const Variable& variable : list)
        for (std::size_t i = 0; i < elements(variable); ++i) visit(*object, variable, i);
  }
}

std::string name_of(const TechnologyObject& object, const Variable& variable, std::size_t i) {
  return object.name + "." + std::string(variable.path) + " [" + std::to_string(i + 1) + "]";
}

/// A value that a project may give, other than the start value; null: there is none.
Json another_value(const Variable& variable) {
  const Value start = variable.start_value();
  if (variable.type == Type::BOOL) return start.u == 0;
  for (const Choice& choice : variable.choices)
    if (choice.value != start.i) return choice.value;
  if (!variable.choices.empty() || variable.type == Type::TAG) return nullptr;
  if (!is_real(variable.type)) return start.u + 1;
  return start.r + (variable.range.highest > start.r ? 1.0 : -1.0) * 0.25;
}

/// Sets what has no effect yet to other values, as the project file names it: Sensor[].Type is at
/// "Sensor[1]".
int configure_later(Json& config, ObjectKind kind) {
  int changed = 0;
  for (const Variable& variable : data_block_of(kind).configuration) {
    const Json value = another_value(variable);
    if (!variable.later || variable.computed || value.is_null()) continue;
    std::string path(variable.path);
    if (const auto open = path.find("[]"); open != path.npos) path.replace(open, 2, "[1]");
    std::replace(path.begin(), path.end(), '.', '/');
    config[Json::json_pointer("/" + path)] = value;
    ++changed;
  }
  return changed;
}

void expect_start_values(Simulation& machine) {
  for_each_variable(machine, [](TechnologyObject& object, const Variable& variable, std::size_t i) {
    if (!variable.later || !variable.computed) return;
    EXPECT_EQ(element(variable, i, object).load().u, variable.start_value(i).u)
        << name_of(object, variable, i) << " is computed";
  });
}

/// What the runtime computes, of both to the bit.
void expect_same_status(Simulation& plain, Simulation& changed) {
  const auto& others = changed.project().controller->objects;
  for_each_variable(plain, [&](TechnologyObject& object, const Variable& variable, std::size_t i) {
    if (!variable.computed || variable.later) return;
    TechnologyObject& other = *others[static_cast<std::size_t>(object.number) - 1];
    EXPECT_EQ(element(variable, i, object).load().u, element(variable, i, other).load().u)
        << name_of(object, variable, i);
  });
}

/// Writes a changed project beside copies of the files that it names.
std::string changed_file(const std::filesystem::path& folder, const Json& project,
                         const test::Directory& directory) {
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    std::filesystem::copy(entry.path(), directory.file(""));
  std::filesystem::remove(directory.file("project.json"));
  return directory.write("project.json", project.dump());
}

TEST(VariablesOfLater, HoldTheirStartValuesAndChangeNoExample) {
  int examples = 0, changes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kProjects)) {
    const std::string path = entry.path().string() + "/project.json";
    if (!std::filesystem::exists(path)) continue;
    SCOPED_TRACE(path);
    Json json = Json::parse(expanded_project(path));
    Simulation plain(path);
    for (const auto& object : plain.project().controller->objects) {
      Json& configured = json["technology_objects"][object->name];
      Json config = configured.value("config", Json::object());
      changes += configure_later(config, object->kind);
      if (!config.empty()) configured["config"] = config;
    }
    const test::Directory directory;
    Simulation changed(changed_file(entry.path(), json, directory));
    for (int step = 0; step < kSteps && !testing::Test::HasFailure(); ++step) {
      plain.run_for(kStep);
      changed.run_for(kStep);
      expect_start_values(plain);
      expect_start_values(changed);
      expect_same_status(plain, changed);
    }
    ++examples;
  }
  EXPECT_EQ(examples, 21);
  EXPECT_GT(changes, 500);
}

}  // namespace
}  // namespace lockstep::later_variables_test
