#include "projects/loader/project_schema.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <span>
#include <string>

#include "example_project.hpp"
#include "fb/block.hpp"
#include "projects/loader/project.hpp"
#include "schema_check.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::project_schema_test {
namespace {

using nlohmann::json;

class Schema : public SchemaCheck {
 protected:
  Schema() : SchemaCheck(project_schema()) {}

  /// All problems that the loader has with a project.
  static std::string told(const json& project) {
    std::string all;
    for (const Problem& problem : load_project(project.dump()).problems) all += problem.text + "\n";
    return all;
  }
};

TEST_F(Schema, ShipsAsItIsMade) {
  expect_shipped("project.schema.json", project_schema());
}

TEST_F(Schema, UsesNothingThatValidatorsStumbleOver) {
  for (const char* word : {"\"format\"", "\"oneOf\"", "\"patternProperties\""})
    EXPECT_EQ(project_schema().find(word), std::string::npos) << word;
}

TEST_F(Schema, AcceptsEveryExampleProject) {
  EXPECT_TRUE(accepts(json::parse(kExampleProject)));
  for (const auto& entry : std::filesystem::directory_iterator(kProjects)) {
    const std::string path = entry.path().string() + "/project.json";
    if (!entry.is_directory() || !std::filesystem::exists(path)) continue;
    EXPECT_TRUE(accepts(json::parse(read(path)))) << path;
    EXPECT_TRUE(load_project_file(path).project.has_value()) << path;
    EXPECT_TRUE(load_project_file(path, {}, LoadedFor::looking).project.has_value()) << path;
  }
}

// Whatever key is added at whatever place of the example: the schema and the loader agree on whether it is
// known.
TEST_F(Schema, KnowsTheKeysThatTheLoaderKnows) {
  const json example = json::parse(kExampleProject);
  const json flat = example.flatten();
  std::vector<std::string> objects = {""};
  for (const auto& [pointer, value] : flat.items())
    for (json::json_pointer place(pointer); !place.empty();) {
      place.pop_back();
      if (example.at(place).is_object()) objects.push_back(place.to_string());
    }
  std::sort(objects.begin(), objects.end());
  objects.erase(std::unique(objects.begin(), objects.end()), objects.end());
  ASSERT_GT(objects.size(), 30u);

  for (const std::string& object : objects) {
    json project = example;
    json& place = project.at(json::json_pointer(object));
    place["no_such_key"] = 1;
    // These hold the names of tags, which the schema does not know.
    EXPECT_EQ(accepts(project), object.ends_with("/set")) << object;
    EXPECT_FALSE(load_project(project.dump()).project.has_value()) << object;
  }
}

TEST_F(Schema, MissesTheKeysThatTheLoaderMisses) {
  const json example = json::parse(kExampleProject);
  const json flat = example.flatten();
  int refused = 0;
  for (const auto& [pointer, value] : flat.items()) {
    for (json::json_pointer place(pointer); !place.empty(); place.pop_back()) {
      const json::json_pointer parent = place.parent_pointer();
      if (!example.at(parent).is_object()) continue;
      json project = example;
      project.at(parent).erase(place.back());
      if (accepts(project)) continue;
      ++refused;
      EXPECT_FALSE(load_project(project.dump()).project.has_value()) << place.to_string();
    }
  }
  EXPECT_GT(refused, 20);
}

// What the schema refuses the loader refuses too: values at every place are replaced by ones of other kinds.
TEST_F(Schema, RefusesNothingThatTheLoaderAccepts) {
  const json example = json::parse(kExampleProject);
  const json flat = example.flatten();
  const json values = {nullptr,       true,          -1, 0, 1, 2.5, 1e30, "", "start", "10ms",
                       json::array(), json::object()};
  for (const auto& [pointer, old] : flat.items()) {
    for (const json& value : values) {
      json project = example;
      project[json::json_pointer(pointer)] = value;
      if (accepts(project)) continue;
      EXPECT_FALSE(load_project(project.dump()).project.has_value()) << pointer << " = " << value;
    }
  }
}

json project_with_call(const BlockType& type, const json& in) {
  const json call = {{"fb", type.name}, {"name", "one"}, {"in", in}};
  const json program = {{"name", "Main"}, {"ob", "MC_PreServo"}, {"calls", json::array({call})}};
  return {{"lockstep", 1},
          {"name", "calls"},
          {"clock", {{"servo_cycle", "1ms"}}},
          {"programs", json::array({program})}};
}

// What is added to a call with nothing but its objects is an input of the block, or refused: of its own pins
// and of those of the next block in the list.
TEST_F(Schema, KnowsTheInputsOfEachBlock) {
  const std::span<const BlockType> types = block_types();
  int refused = 0;
  for (std::size_t i = 0; i < types.size(); ++i) {
    const BlockType& type = types[i];
    json in = json::object();
    for (const Pin& pin : type.pins)
      if (pin.type == Type::AXIS) in[std::string(pin.name)] = "A";
    EXPECT_TRUE(accepts(project_with_call(type, in))) << type.name;
    for (const auto& [object, name] : in.items()) {
      json without = in;
      without.erase(object);
      EXPECT_FALSE(accepts(project_with_call(type, without))) << type.name << " without " << object;
      EXPECT_NE(told(project_with_call(type, without)).find("'" + object + "' is missing"), std::string::npos)
          << type.name;
    }
    std::set<std::string> names = {"no_such_input"};
    for (const BlockType* const one : {&type, &types[(i + 1) % types.size()]})
      for (const Pin& pin : one->pins) names.insert(std::string(pin.name));
    for (const std::string& name : names) {
      const Pin* const pin = type.find_pin(name);
      const bool known = pin != nullptr && pin->name == name && pin->pin_class != PinClass::output;
      json pins = in;
      if (!pins.contains(name)) pins[name] = "start";
      EXPECT_EQ(accepts(project_with_call(type, pins)), known) << type.name << " " << name;
      refused += known ? 0 : 1;
    }
    in["no_such_input"] = 1;
    EXPECT_NE(told(project_with_call(type, in)).find("has no input 'no_such_input'"), std::string::npos)
        << type.name;
  }
  EXPECT_GT(refused, 500);
}

TEST_F(Schema, KnowsWhatATagOfEachTypeBeginsWith) {
  const json values = {true, 0, -1, 70'000, 1.5, "10ms", json::array()};
  int refused = 0;
  for (const char* const type : {"BOOL",
                                 "BYTE",
                                 "WORD",
                                 "DWORD",
                                 "LWORD",
                                 "SINT",
                                 "INT",
                                 "DINT",
                                 "LINT",
                                 "USINT",
                                 "UINT",
                                 "UDINT",
                                 "ULINT",
                                 "REAL",
                                 "LREAL",
                                 "TIME",
                                 "STRING[8]",
                                 "ARRAY[1..3] OF INT",
                                 "array [ -1 .. 2 ] of LREAL",
                                 "STRING",
                                 "STRING[0]",
                                 "STRING[255]",
                                 "ARRAY[1..3]",
                                 "int",
                                 "ARRAY[1..3] OF int"})
    for (const json& value : values) {
      const json project = {{"lockstep", 1},
                            {"name", "tags"},
                            {"clock", {{"servo_cycle", "1ms"}}},
                            {"tags", {{"t", {{"type", type}, {"init", value}}}}}};
      const bool loads = load_project(project.dump()).project.has_value();
      // A text may be an expression, which the loader alone reads.
      const bool unknown = value.is_string() && std::string_view(type).find('[') == std::string_view::npos;
      if (!unknown || loads) {
        EXPECT_EQ(accepts(project), loads) << type << " = " << value;
      }
      refused += loads ? 0 : 1;
    }
  EXPECT_GT(refused, 50);
}

TEST_F(Schema, DescribesEveryVariableThatAProjectMaySet) {
  const json schema = json::parse(project_schema());
  const json& config = schema.at("definitions").at("TO_SynchronousAxis").at("properties");
  EXPECT_EQ(config.at("Modulo").at("properties").at("Length").at("default"), 360.0);
  EXPECT_EQ(config.at("Properties").at("properties").at("MotionType").at("enum"), json({0, 1}));
  EXPECT_TRUE(config.contains("Sensor[4]"));
  EXPECT_FALSE(config.contains("Position") || config.contains("StatusDrive") ||
               config.contains("OperativeSensor"));
}

// ---- Included files

class PartSchema : public SchemaCheck {
 protected:
  PartSchema() : SchemaCheck(part_schema()) {}

  /// Whether a project that is nothing but this part is valid.
  bool loads(const json& part) const {
    directory_.write("part.json", part.dump());
    directory_.write("project.json", R"({ "lockstep": 1, "name": "whole", "clock": { "servo_cycle": "1ms" },
      "include": [ "part.json" ], "modbus": { "server": { "listen": "127.0.0.1:1502" } } })");
    return load_project_file(directory_.file("project.json"), {}, LoadedFor::looking).project.has_value();
  }

  /// What of the example may stand in an included file.
  static json example() {
    json part = json::parse(kExampleProject);
    for (const char* const key : {"lockstep", "name", "description", "clock", "audit"}) part.erase(key);
    part["modbus"] = {{"map", part["modbus"]["map"]}};
    part["trace"] = {{"signals", part["trace"]["signals"]}};
    part["$schema"] = "part.schema.json";
    part["comment"] = "all but the controller";
    return part;
  }

  const test::Directory directory_;
};

TEST_F(PartSchema, ShipsAsItIsMade) {
  expect_shipped("part.schema.json", part_schema());
}

TEST_F(PartSchema, AcceptsIncludedFilesAndNoProject) {
  EXPECT_TRUE(accepts(example()));
  EXPECT_TRUE(loads(example()));
  const json station = json::parse(read(kProjects + "/14_twelve_stations/station.json"), nullptr, true, true);
  EXPECT_TRUE(accepts(station));
  EXPECT_TRUE(station.contains("$schema")) << "an editor finds the schema there";
  EXPECT_FALSE(accepts(json::parse(kExampleProject)));
}

TEST_F(PartSchema, KnowsTheKeysThatTheLoaderKnows) {
  const json whole = json::parse(project_schema());
  int allowed = 0;
  for (const auto& [key, ignored] : whole["properties"].items()) {
    json part = json::object();
    part[key] = 3;  // no section of a project is that
    directory_.write("part.json", part.dump());
    directory_.write("project.json", R"({ "lockstep": 1, "name": "whole", "clock": { "servo_cycle": "1ms" },
      "include": [ "part.json" ] })");
    bool known = true;
    for (const Problem& problem : load_project_file(directory_.file("project.json")).problems)
      if (problem.text.starts_with("unknown key '" + key + "'")) known = false;
    EXPECT_EQ(json::parse(part_schema())["properties"].contains(key), known) << key;
    allowed += known ? 1 : 0;
  }
  EXPECT_EQ(allowed, 13) << "a part has grown: does the schema tell what may stand there?";
}

// As of the project: what the schema refuses the loader refuses too.
TEST_F(PartSchema, RefusesNothingThatTheLoaderAccepts) {
  const json values = {nullptr, true, -1, 2.5, "start", "10ms", json::array(), json::object()};
  const json whole = example();
  const json flat = whole.flatten();
  int refused = 0;
  for (const auto& [pointer, old] : flat.items()) {
    for (const json& value : values) {
      json part = whole;
      part[json::json_pointer(pointer)] = value;
      if (accepts(part)) continue;
      ++refused;
      EXPECT_FALSE(loads(part)) << pointer << " = " << value;
    }
  }
  EXPECT_GT(refused, 200) << "an editor is served";
}

}  // namespace
}  // namespace lockstep::project_schema_test
