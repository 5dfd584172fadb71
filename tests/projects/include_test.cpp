// Projects of several files: what they are together, and what is wrong with them is told where it stands.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

#include "changed_project.hpp"
#include "projects/assembly/sources.hpp"
#include "projects/loader/project.hpp"
#include "projects/loader/simulation.hpp"
#include "tests/support/directory.hpp"

namespace lockstep {
namespace {

constexpr char kAxis[] = R"({ "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 } } })";

/// A folder with a project and what it includes.
class Includes : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(directory_.file(name)).parent_path());
    directory_.write(name, text);
  }
  std::string main() const { return directory_.file("machine/project.json"); }

  /// @param more behind the version, name and clock of a project
  LoadedProject load(const std::string& more) const {
    write("machine/project.json",
          "{ \"lockstep\": 1, \"name\": \"parts\", \"clock\": { \"servo_cycle\": \"1ms\" },\n" + more + " }");
    return load_project_file(main());
  }
  /// The one problem of a project, as it is shown, without the folder.
  std::string told(const std::string& more) const {
    const LoadedProject loaded = load(more);
    if (loaded.problems.size() != 1)
      return std::to_string(loaded.problems.size()) + " problems\n" + lines(loaded.problems);
    std::string line = to_string(main(), loaded.problems[0]);
    const std::string folder = directory_.file("machine") + "/";
    for (std::size_t at = 0; (at = line.find(folder)) != line.npos;) line.erase(at, folder.size());
    return line;
  }

  const test::Directory directory_;
};

TEST_F(Includes, AreAsIfTheyStoodInTheProject) {
  write("machine/axes.json", "// axes\n{ \"technology_objects\": { \"B\": " + std::string(kAxis) + " } }");
  write("machine/parts/more.json", R"({
    "$schema": "project.schema.json", "comment": "of the slide",
    "include": [ "tags.json" ],
    "technology_objects": { "C": )" + std::string(kAxis) +
                                       R"( },
    "programs": [ { "name": "More", "ob": "Main", "cycle": "2ms", "calls": [ { "set": "n", "to": "n + 1" } ] } ],
    "stimuli": [ { "at": "3ms", "set": { "on": true } } ],
    "modbus": { "map": [ { "tag": "on", "table": "coil", "address": 1 } ] },
    "trace": { "signals": [ "n" ] } })");
  write("machine/parts/tags.json", R"({ "tags": { "n": { "type": "INT" }, "on": { "type": "BOOL" } } })");
  LoadedProject loaded = load(R"("include": [ "axes.json", "parts/more.json" ],
    "technology_objects": { "A": )" +
                              std::string(kAxis) + R"( },
    "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [
      { "fb": "MC_Power", "name": "power", "in": { "Axis": "C", "Enable": "on" } } ] } ],
    "modbus": { "server": { "listen": "127.0.0.1:1502" }, "map": [ { "tag": "n", "table": "holding_register", "address": 1 } ] },
    "trace": { "signals": [ "on" ] })");
  ASSERT_TRUE(loaded.project) << lines(loaded.problems);
  Project& project = *loaded.project;
  std::string objects, signals;
  for (const auto& object : project.controller->objects) objects += object->name;
  for (const NamedSignal& signal : project.trace.signals) signals += signal.name + " ";
  EXPECT_EQ(objects, "BCA") << "what is included comes first";
  EXPECT_EQ(signals, "n on ");
  EXPECT_EQ(project.controller->programs.size(), 2u);
  EXPECT_EQ(project.modbus.servers.size(), 1u);
  EXPECT_EQ(project.modbus.maps.front().map.entries().size(), 2u);
  project.controller->apply_stimuli = true;
  for (int i = 0; i < 5; ++i) project.controller->tick();
  EXPECT_EQ(project.names.find("n").place->signal.load().i, 3);
  EXPECT_EQ(project.names.find("on").place->signal.load().u, 1u);
}

TEST_F(Includes, AreExpandedIntoOneFileThatIsTheSame) {
  write("machine/parts/cam.csv", "0;0\n1;2\n2;0\n");
  write("machine/parts/part.json", R"({ "technology_objects": {
    "Axis": )" + std::string(kAxis) + R"(, "Curve": { "type": "TO_Cam", "file": "cam.csv" } },
    "tags": { "low": { "type": "LINT", "init": -9223372036854775808 }, "x": { "type": "LREAL", "init": 0.1 } } })");
  ASSERT_TRUE(load(R"("include": [ "parts/part.json" ])").project);
  ProjectSources sources(test::content(main()), directory_.file("machine"), main());
  ASSERT_TRUE(sources.usable());
  const std::string text = expanded_text(sources.root());
  const Json json = Json::parse(text);
  EXPECT_FALSE(json.contains("include"));
  EXPECT_EQ(json["technology_objects"]["Curve"]["file"], "parts/cam.csv");
  EXPECT_EQ(json["tags"]["low"]["init"], INT64_MIN);
  const LoadedProject again = load_project(text, directory_.file("machine"));
  ASSERT_TRUE(again.project) << lines(again.problems);
  EXPECT_EQ(again.project->controller->objects.size(), 2u);
}

TEST_F(Includes, TellWhatIsWrongInThemWithTheirOwnFileAndLine) {
  write("machine/part.json", "{\r\n  \"tags\": {\r\n\t\"n\": { \"type\": \"INTEGER\" } } }");
  EXPECT_EQ(told(R"("include": [ "part.json" ])").substr(0, 46),
            "part.json:/tags/n/type: unknown type 'INTEGER'");
  EXPECT_NE(told(R"("include": [ "part.json" ])").find("(line 3, column 17, tag 'n')"), std::string::npos);
  write("machine/part.json", "{\n  \"tags\": {,\n} }");
  EXPECT_EQ(told(R"("include": [ "part.json" ])").substr(0, 15), "part.json:2:12:");
  write("machine/part.json", "{ \"clock\": { } }");
  EXPECT_EQ(told(R"("include": [ "part.json" ])").substr(0, 40), "part.json:/clock: unknown key 'clock'; a");
  write("machine/part.json", "{ \"modbus\": { \"server\": 3, \"map\": [] } }");
  EXPECT_EQ(told(R"("include": [ "part.json" ])").substr(0, 47),
            "part.json:/modbus/server: unknown key 'server';");
  write("machine/part.json", "{ \"tags\": [] }");
  EXPECT_EQ(told(R"("include": [ "part.json" ])").substr(0, 33), "part.json:/tags: an array is not ");
  write("machine/part.json", "3");
  EXPECT_EQ(told(R"("include": [ "part.json" ])").substr(0, 26), "part.json:: 3 is not allow");
  write("machine/part.json", "");
  EXPECT_EQ(told(R"("include": [ "part.json" ])").substr(0, 34), "part.json:1:1: the file is empty; ");
}

TEST_F(Includes, TellOfATemplateInThemItsFileAndThatOfItsInstance) {
  const std::string instance = R"("include": [ "parts/kit.json" ],
    "instances": [ { "template": "kit", "name": "First", "with": { "n": 1 } } ])";
  write("machine/parts/kit.json", R"({ "templates": { "kit": { "parameters": { "n": {} },
  "tags": { "a${n}": { "type": "INTEGER" } } } } })");
  const std::string type = told(instance);
  EXPECT_EQ(type.substr(0, 69), "parts/kit.json:/templates/kit/tags/a${n}/type: unknown type 'INTEGER'");
  EXPECT_NE(
      type.find("(line 2, column 32, tag 'a1', instance 'First' of the template 'kit' in the project file, "
                "line 3)"),
      std::string::npos)
      << type;
  write("machine/parts/kit.json", R"({ "templates": { "kit": { "parameters": { "m": {} } } } })");
  const LoadedProject wrong = load(instance);
  ASSERT_EQ(wrong.problems.size(), 2u) << lines(wrong.problems);
  for (const Problem& problem : wrong.problems)
    EXPECT_EQ(to_string(main(), problem).rfind(main() + ":/instances/0", 0), 0u)
        << to_string(main(), problem);
}

TEST_F(Includes, TellOfExpectationsInThemTheirFile) {
  write("machine/part.json",
        "{ \"tags\": { \"n\": { \"type\": \"INT\" } },\n"
        "\"expectations\": [ { \"at\": \"1s\", \"expect\": \"m = 1\" } ] }");
  EXPECT_EQ(told(R"("include": [ "part.json" ])"),
            "part.json:/expectations/0/expect: unknown name 'm' (did you mean 'n'?) (line 2, column 44)");
}

TEST_F(Includes, TellBothPlacesOfANameThatIsThereTwice) {
  write("machine/part.json", "{\n\"tags\": { \"n\": { \"type\": \"INT\" } } }");
  EXPECT_EQ(told("\"include\": [ \"part.json\" ],\n\"tags\": { \"N\": { \"type\": \"INT\" } }"),
            "project.json:/tags/N: the name 'N' is taken already (as 'n', case does not count); each name is "
            "allowed "
            "once among tags, technology objects and instances; it is in part.json, line 2 (tag 'n') (line "
            "3, column "
            "11, tag 'N')");
  write("machine/part.json",
        "{\n\"programs\": [ { \"name\": \"Main\", \"ob\": \"MC_PreServo\", \"calls\": [] } ] }");
  EXPECT_NE(
      told(
          R"("include": [ "part.json" ], "programs": [ { "name": "main", "ob": "MC_PostServo", "calls": [] } ])")
          .find("there is a program 'main' already in part.json, line 2 (program 'Main'); each"),
      std::string::npos);
}

TEST_F(Includes, AreRefusedWhereTheyCannotBeHad) {
  const auto include = [&](const std::string& name) { return told(R"("include": [ ")" + name + "\" ]"); };
  EXPECT_EQ(
      include("none.json"),
      "project.json:/include/0: 'none.json' cannot be included: No such file or directory; allowed: a file, "
      "relative to the one that includes it (line 2, column 14)");
  std::filesystem::create_directories(directory_.file("machine/folder"));
  EXPECT_NE(include("folder").find("'folder' is no file"), std::string::npos);
  ASSERT_EQ(::mkfifo(directory_.file("machine/pipe").c_str(), 0600), 0);
  EXPECT_NE(include("pipe").find("'pipe' is no file"), std::string::npos);
  write("other.json", "{}");
  EXPECT_NE(include("../other.json").find("'../other.json' leads out of the folder of the project"),
            std::string::npos);
  EXPECT_NE(include(directory_.file("other.json")).find("leads out of the folder"), std::string::npos);
  std::filesystem::create_symlink(directory_.file("other.json"), directory_.file("machine/link.json"));
  EXPECT_NE(include("link.json").find("leads out of the folder"), std::string::npos);
  EXPECT_NE(include("").find("allowed: a text of 1 to 128"), std::string::npos);
  EXPECT_NE(include("a\\u0000b").find("without control characters"), std::string::npos);
  EXPECT_NE(told(R"("$schema": 3)").find("/$schema: 3 is not allowed here; allowed: a string"),
            std::string::npos);
  EXPECT_NE(told(R"("include": "part.json")").find("allowed: an array"), std::string::npos);
  EXPECT_NE(told(R"("include": [ 3 ])").find("allowed: a string"), std::string::npos);
}

TEST_F(Includes, HaveNoCyclesAndNoFileTwice) {
  write("machine/a.json", R"({ "include": [ "sub/b.json" ] })");
  write("machine/sub/b.json", "{\n\"include\": [ \"../a.json\" ] }");
  EXPECT_EQ(told(R"("include": [ "a.json" ])"),
            "sub/b.json:/include/0: '../a.json' includes itself: 'a.json' → 'sub/b.json' → "
            "'../a.json'; allowed: each file once (line 2, column 14)");
  write("machine/a.json", R"({ "include": [ "project.json" ] })");
  EXPECT_NE(told(R"("include": [ "a.json" ])").find("'project.json' includes itself: "), std::string::npos);
  write("machine/a.json", "{}");
  EXPECT_NE(told(R"("include": [ "a.json", "./a.json" ])")
                .find("'./a.json' is included already in line 2; allowed: each"),
            std::string::npos);
}

TEST_F(Includes, AreLimitedInTheirNumberAndLength) {
  std::string list;
  for (std::size_t i = 0; i <= ProjectSources::kMaximumFiles; ++i) {
    const std::string name = std::to_string(i) + ".json";
    write("machine/" + name, "{}");
    list += (i == 0 ? "\"" : ", \"") + name + "\"";
  }
  EXPECT_NE(told("\"include\": [ " + list + " ]").find("includes more than 100 files"), std::string::npos);
  write("machine/0.json", "{}" + std::string(JsonDocument::kLongest - 3, ' '));
  EXPECT_NE(told("\"include\": [ \"0.json\" ]").find("are longer than 16 MiB"), std::string::npos);
}

TEST(Problems, TellLineAndColumnAndWhatTheyArePartOf) {
  const LoadedProject loaded =
      load_project(R"({ "lockstep": 1, "name": "x", "clock": { "servo_cycle": "1ms" },
  /* a */ "tags": { "n": { "type": "INT", "init": 70000 /* too much */ } },
  "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "comment": 3, "calls": [
    // nothing yet
    { "fb": "TON", "name": "wait", "in": { "IN": "n > 3 AND x", "TP": "T#1s" } } ] } ]
})");
  std::vector<std::string> told;
  for (const Problem& problem : loaded.problems) {
    const std::string line = to_string("F", problem);
    told.push_back(problem.place + " " + line.substr(line.rfind(" (") + 1));
  }
  EXPECT_EQ(told, (std::vector<std::string>{"/tags/n/init (line 2, column 51, tag 'n')",
                                            "/programs/0/comment (line 3, column 76, program 'Main')",
                                            "/programs/0/calls/0/in/IN (line 5, column 61, call 'wait')",
                                            "/programs/0/calls/0/in/TP (line 5, column 65, call 'wait')"}));
}

TEST(Problems, AreNotMadeByCommentsAndASchema) {
  Json project = Json::parse(kExampleProject);
  project["$schema"] = "../project.schema.json";
  for (const char* place : {"", "/clock", "/technology_objects/Knife", "/technology_objects/Knife/drive",
                            "/tags/speed", "/programs/0", "/programs/0/calls/0", "/programs/0/calls/5",
                            "/programs/0/calls/6", "/stimuli/0", "/modbus/map/0", "/trace/lcm"})
    project[Json::json_pointer(std::string(place) + "/comment")] = "as drawn";
  const LoadedProject loaded = load_project("\xEF\xBB\xBF" + project.dump(2));
  EXPECT_TRUE(loaded.project) << lines(loaded.problems);
}

}  // namespace
}  // namespace lockstep
