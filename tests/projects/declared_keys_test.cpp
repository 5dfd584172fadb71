// The declared keys: what the loader and the schema make of them is the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>
#include <string>
#include <typeinfo>
#include <vector>

#include "projects/keys/project.hpp"
#include "projects/keys/texts.hpp"
#include "projects/loader/project.hpp"
#include "projects/loader/project_schema.hpp"
#include "schema_check.hpp"
#include "struct_members.hpp"
#include "whole_project.hpp"

namespace lockstep::declared_keys_test {
namespace {

using Pointer = Json::json_pointer;

// An object of the whole project, and what is declared of it.
struct Operand {
  Pointer pointer;
  Keys keys;
};

// For each structure that is declared the first object of the project that is one.
class Places {
 public:
  explicit Places(const Json& project) : project_(project) { walk(Pointer(""), keys::kProject); }

  std::vector<Operand> found;

  bool has(Keys keys) const {
    return std::any_of(found.begin(), found.end(),
                       [&](const Operand& place) { return place.keys.data() == keys.data(); });
  }

 private:
  void walk(const Pointer& pointer, Keys keys) {
    if (!has(keys)) found.push_back({pointer, keys});
    for (const Key& key : keys)
      for (const Pointer& value : values_of(pointer / std::string(key.name), key)) {
        if (key.kind == KeyKind::structure) walk(value, key.keys);
        for (const KeyVariant& variant : key.variants)
          if (project_.at(value / std::string(variant.keys.front().name)) == variant.name)
            walk(value, variant.keys);
      }
  }

  std::vector<Pointer> values_of(const Pointer& pointer, const Key& key) const {
    std::vector<Pointer> values;
    if (!project_.contains(pointer)) return values;
    const Json& json = project_.at(pointer);
    if (json.is_array())
      for (std::size_t i = 0; i < json.size(); ++i) values.push_back(pointer / i);
    else if (key.shape == KeyShape::named)
      for (const auto& [name, member] : json.items()) values.push_back(pointer / name);
    else
      values.push_back(pointer);
    return values;
  }

  const Json& project_;
};

LoadedProject loaded(const Json& project) {
  return load_project(project.dump(), "", {}, LoadedFor::looking);
}

// What is told at a place; empty: nothing.
std::string told_at(const LoadedProject& project, const Pointer& place) {
  for (const Problem& problem : project.problems)
    if (problem.place == place.to_string()) return problem.text;
  return "";
}

class DeclaredKeys : public SchemaCheck {
 protected:
  DeclaredKeys() : SchemaCheck(project_schema()), project_(whole_project()), places_(project_) {}

  Json with(const Pointer& place, const Json& value) const {
    Json changed = project_;
    changed[place] = value;
    return changed;
  }
  bool schema_accepts(const Json& project) { return accepts(nlohmann::json::parse(project.dump())); }

  // A number or a duration is taken by the loader as far as its own range goes, and by the schema.
  void expect_taken(const Pointer& place, const Json& value, const std::string& range) {
    const Json project = with(place, value);
    EXPECT_EQ(told_at(loaded(project), place).find(range), std::string::npos) << place << " = " << value;
    EXPECT_TRUE(schema_accepts(project)) << place << " = " << value;
  }
  void expect_refused(const Pointer& place, const Json& value, bool by_schema) {
    const Json project = with(place, value);
    EXPECT_NE(told_at(loaded(project), place), "") << place << " = " << value;
    EXPECT_EQ(schema_accepts(project), !by_schema) << place << " = " << value;
  }

  const Json project_;
  const Places places_;
};

// What a message says of a value beyond the range; what is left out of it is told apart.
std::string range_of(const Key& key) {
  const std::string text = value_text(key);
  return (key.kind == KeyKind::integer ? "allowed: an " : "allowed: a ") + text.substr(0, text.find(','));
}

Json shown(const Key& key, double value) {
  if (key.kind == KeyKind::duration) return std::to_string(static_cast<std::int64_t>(value)) + "ns";
  if (key.kind == KeyKind::integer) return static_cast<std::int64_t>(value);
  return value;
}

double beyond(const Key& key, double limit, double direction) {
  return key.kind == KeyKind::number ? std::nextafter(limit, direction * INFINITY) : limit + direction;
}

bool has_range(const Key& key) {
  const bool kind =
      key.kind == KeyKind::integer || key.kind == KeyKind::number || key.kind == KeyKind::duration;
  return kind && key.numbers.empty() && key.range.lowest > -1e301 && key.range.highest < 1e301;
}

TEST_F(DeclaredKeys, OfAllStructuresStandInTheWholeProject) {
  for (const KeySection& section : key_sections())
    EXPECT_TRUE(places_.has(section.keys) || section.path == "programs.calls")
        << section.path << " " << section.variant;
  const LoadedProject whole = loaded(project_);
  EXPECT_TRUE(whole.project.has_value()) << lines(whole.problems);
  EXPECT_TRUE(schema_accepts(project_));
}

TEST_F(DeclaredKeys, AreTakenAsFarAsTheirRangesGo) {
  int checked = 0;
  for (const auto& [pointer, keys] : places_.found)
    for (const Key& key : keys) {
      if (!has_range(key)) continue;
      Pointer place = pointer / std::string(key.name);
      if (key.shape == KeyShape::list) place /= std::size_t{0};
      const bool by_schema = key.kind != KeyKind::duration;  // to a schema it is a text
      expect_taken(place, shown(key, key.range.lowest), range_of(key));
      expect_taken(place, shown(key, key.range.highest), range_of(key));
      expect_refused(place, shown(key, beyond(key, key.range.lowest, -1.0)), by_schema);
      expect_refused(place, shown(key, beyond(key, key.range.highest, 1.0)), by_schema);
      if (std::isfinite(key.range.excluded)) expect_refused(place, key.range.excluded, true);
      ++checked;
    }
  EXPECT_GT(checked, 50);
}

TEST_F(DeclaredKeys, TakeTheirWordsAndNoOthers) {
  for (const auto& [pointer, keys] : places_.found)
    for (const Key& key : keys) {
      const Pointer place = pointer / std::string(key.name);
      for (const Word& word : key.words) expect_taken(place, word.word, "is not allowed here");
      for (const int number : key.numbers) expect_taken(place, number, "is not allowed here");
      if (!key.words.empty()) expect_refused(place, "no such word", true);
      if (!key.numbers.empty()) expect_refused(place, key.numbers.front() + 1, true);
    }
}

TEST_F(DeclaredKeys, TakeNoTextOfAnotherForm) {
  int refused = 0;
  for (const auto& [pointer, keys] : places_.found)
    for (const Key& key : keys) {
      if (key.form == nullptr && key.kind != KeyKind::duration) continue;
      Pointer place = pointer / std::string(key.name);
      if (key.shape == KeyShape::list) place /= std::size_t{0};
      for (const char* const text : {"", "no such form", "10", "1.5 ms"}) expect_refused(place, text, true);
      ++refused;
    }
  EXPECT_GT(refused, 30);
}

TEST_F(DeclaredKeys, TakeNoValueOfAnotherKind) {
  const Json values = {nullptr, true, "start", Json::array()};
  for (const auto& [pointer, keys] : places_.found)
    for (const Key& key : keys) {
      const Pointer place = pointer / std::string(key.name);
      for (const Json& value : values) {
        const Json project = with(place, value);
        if (schema_accepts(project)) continue;
        EXPECT_FALSE(loaded(project).project.has_value()) << place << " = " << value;
      }
    }
}

TEST_F(DeclaredKeys, AreAllThatAnObjectMayHave) {
  for (const auto& [pointer, keys] : places_.found) {
    expect_refused(pointer / "no_such_key", 1, true);
    for (const Key& key : keys) {
      Json project = project_;
      project.at(pointer).erase(std::string(key.name));
      if (!key.required) continue;
      EXPECT_NE(told_at(loaded(project), pointer).find(std::string(key.name)), std::string::npos) << pointer;
      EXPECT_FALSE(schema_accepts(project)) << pointer << " without " << key.name;
    }
  }
}

TEST_F(DeclaredKeys, OfOneTypeOfObjectAreRefusedInAnother) {
  const auto object_of = [&](const KeyVariant& type) {
    for (const auto& [name, object] : project_["technology_objects"].items())
      if (object["type"] == type.name) return name;
    return std::string();
  };
  const auto has = [](const KeyVariant& type, std::string_view name) {
    return std::ranges::find(type.keys, name, &Key::name) != type.keys.end();
  };
  int refused = 0;
  for (const KeyVariant& type : keys::kObjects)
    for (const KeyVariant& other : keys::kObjects)
      for (const Key& key : other.keys) {
        if (has(type, key.name)) continue;
        const Pointer place = Pointer("/technology_objects") / object_of(type) / std::string(key.name);
        const Json of_other = project_["technology_objects"][object_of(other)];
        const Json project = with(place, of_other.value(std::string(key.name), Json::array()));
        const std::string told = told_at(loaded(project), place);
        EXPECT_NE(told.find("unknown key"), std::string::npos) << place << ": " << told;
        EXPECT_NE(told.find(other.name), std::string::npos) << place << ": " << told;
        EXPECT_FALSE(schema_accepts(project)) << place;
        ++refused;
      }
  EXPECT_GT(refused, 100);
}

// Members of a struct that keys set.
std::size_t set_members(Keys keys) {
  std::set<const void*> marks;
  for (const Key& key : keys)
    if (key.member != nullptr) marks.insert(key.member);
  return marks.size();
}

// @param others what code sets, or no project
template <class S, std::size_t n>
void expect_declared(const KeyTable<S, n>& table, std::initializer_list<const char*> others = {}) {
  EXPECT_EQ(set_members(table) + others.size(), member_count<S>()) << typeid(S).name();
}

TEST(StructsOfTheProjectFile, HaveNoMemberThatIsNotDeclared) {
  expect_declared(keys::kZeroMarks);
  expect_declared(keys::kDigitalInput);
  expect_declared(keys::kFixedStop);
  expect_declared(keys::kPlant, {"has_stop"});
  expect_declared(keys::kFaults);
  expect_declared(keys::kSensor, {"exists"});
  expect_declared(keys::kSimulatedDrive, {"sensors", "linear_motor"});
  expect_declared(keys::kDampedStop);
  expect_declared(keys::kCentringSpring);
  expect_declared(keys::kLinearMotor, {"time_constant", "dead_time", "plant", "position_cycle", "sensors"});
  expect_declared(keys::kSimulatedEncoder, {"signal"});
  expect_declared(keys::kMarks);
  expect_declared(keys::kSwitchingTimes);
  expect_declared(keys::kClock);
  expect_declared(keys::kSerial);
  expect_declared(keys::kServer, {"listen", "allow", "stall_time", "idle_time"});
  expect_declared(keys::kClient, {"connect", "first_retry", "longest_retry", "devices"});
  expect_declared(keys::kDevice, {"unit", "reads", "writes", "quality", "age", "lines"});
  expect_declared(keys::kEntryShape, {"signal", "type", "writable", "range", "is_scaled", "counter", "line"});
  expect_declared(keys::kFlightRecorder);
  expect_declared(keys::kAudit);
  expect_declared(keys::kTrigger, {"every"});
  std::set<const void*> of_signals;
  for (const Key& key : keys::kSimulatedDrive.all)
    if (key.inner != nullptr) of_signals.insert(key.inner);
  EXPECT_EQ(of_signals.size() + set_members(keys::kLimitSwitches), member_count<MachineSignals>());
}

TEST(Keys, AreDescribedAsTheyAreDeclared) {
  const std::string path = kProjects + "/KEYS.md";
  const std::string made = keys_document();
  if (std::getenv("LOCKSTEP_UPDATE") != nullptr) std::ofstream(path) << made;
  EXPECT_TRUE(read(path) == made)
      << "a declaration has changed: run LOCKSTEP_UPDATE=1 projects_tests --gtest_filter=Keys.*";
}

TEST(Keys, HaveAMeaning) {
  for (const KeySection& section : key_sections())
    for (const Key& key : section.keys) EXPECT_FALSE(key.text.empty()) << section.path << "." << key.name;
}

}  // namespace
}  // namespace lockstep::declared_keys_test
