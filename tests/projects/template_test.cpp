// Templates: their instances are what they would be if they were written out, and errors name all that is
// concerned.
#include <gtest/gtest.h>

#include <string>

#include "changed_project.hpp"
#include "projects/assembly/placeholders.hpp"
#include "projects/assembly/sources.hpp"
#include "projects/loader/project.hpp"

namespace lockstep {
namespace {

std::string project(const std::string& more) {
  return "{ \"lockstep\": 1, \"name\": \"stations\", \"clock\": { \"servo_cycle\": \"1ms\" },\n" + more +
         " }";
}

constexpr char kStation[] = R"("templates": { "station": {
  "parameters": { "n": { "comment": "from 1" }, "pitch": { "default": 30.0 }, "first": { "default": false } },
  "technology_objects": { "Axis${n}": { "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 },
    "PositionLimits_SW": { "MaxPosition": "${n * pitch}" } } } },
  "tags": { "go${n}": { "type": "BOOL", "init": "${first}" }, "at${n}": { "type": "DINT", "init": "${100 + 2 * n}" },
    "what${n}": { "type": "STRING[30]", "init": "${name} at ${pitch} $${n}" } },
  "programs": [ { "name": "Run${name}", "ob": "Main", "cycle": "1ms", "calls": [
    { "fb": "MC_Power", "name": "power${n}", "in": { "Axis": "Axis${n}", "Enable": "go${n} AND at${n} > ${n}" } } ] } ],
  "modbus": { "map": [ { "tag": "go${n}", "table": "coil", "address": "${n - 1}" } ] },
  "trace": { "signals": [ "Axis${n}.Position" ] } } })";

TEST(Templates, AreWrittenOutForEachInstance) {
  const std::string text = project(std::string(kStation) + R"(,
    "tags": { "own": { "type": "BOOL" } },
    "instances": [ { "template": "station", "name": "Last", "with": { "n": 9, "pitch": 2, "first": true } },
      { "template": "station", "for": { "n": [1, 3] }, "name": "S${n}", "with": { "pitch": "${n * 0.5}" } } ],
    "modbus": { "server": { "listen": "127.0.0.1:1502" } })");
  const LoadedProject loaded = load_project(text);
  ASSERT_TRUE(loaded.project) << lines(loaded.problems);
  ProjectSources sources(text, "");
  const Json json = Json::parse(expanded_text(sources.root()));
  EXPECT_FALSE(json.contains("templates") || json.contains("instances"));
  std::string objects, tags, programs;
  for (const auto& [name, object] : json["technology_objects"].items()) objects += name + " ";
  for (const auto& [name, tag] : json["tags"].items()) tags += name + " ";
  for (const auto& program : json["programs"]) programs += program["name"].get<std::string>() + " ";
  EXPECT_EQ(objects, "Axis9 Axis1 Axis2 Axis3 ");
  EXPECT_EQ(tags, "own go9 at9 what9 go1 at1 what1 go2 at2 what2 go3 at3 what3 ");
  EXPECT_EQ(programs, "RunLast RunS1 RunS2 RunS3 ");
  const auto limit = [&](const char* axis) {
    return json["technology_objects"][axis]["config"]["PositionLimits_SW"]["MaxPosition"];
  };
  EXPECT_EQ(limit("Axis9"), Json(18)) << "whole numbers give a whole number";
  EXPECT_EQ(limit("Axis3").dump(), "4.5");
  EXPECT_EQ(limit("Axis2").dump(), "2.0");
  EXPECT_EQ(json["tags"]["go9"]["init"], true);
  EXPECT_EQ(json["tags"]["at3"]["init"], 106);
  EXPECT_EQ(json["tags"]["what3"]["init"], "S3 at 1.5 $${n}");
  EXPECT_EQ(json["programs"][1]["calls"][0]["in"]["Enable"], "go1 AND at1 > 1");
  EXPECT_EQ(json["modbus"]["map"][3]["address"], 2);
  EXPECT_EQ(json["trace"]["signals"].size(), 4u);
  const LoadedProject again = load_project(json.dump());
  ASSERT_TRUE(again.project) << lines(again.problems);
  EXPECT_EQ(again.project->controller->instances.size(), 4u);
}

TEST(Templates, TellTemplateInstanceAndLine) {
  const LoadedProject loaded = load_project(project(R"("templates": {
  "t": { "parameters": { "n": {} }, "tags": {
    "a${n}": { "type": "INT${n}" },
    "b": { "type": "INT", "init": "${m}" } } } },
"instances": [
  { "template": "t", "name": "x", "with": { "n": 1 } },
  { "template": "t", "name": "y", "with": { "n": 2 } } ])"));
  std::vector<std::string> told;
  for (const Problem& problem : loaded.problems) told.push_back(to_string("F", problem));
  ASSERT_EQ(told.size(), 5u) << lines(loaded.problems);
  EXPECT_EQ(told[0],
            "F:/templates/t/tags/b/init: '${m}': there is no parameter 'm'; there are: n, name (line 5, "
            "column 35, tag 'b', instance 'x' of the template 't' in line 7)");
  EXPECT_EQ(told[2].substr(0, 51), "F:/templates/t/tags/a${n}/type: unknown type 'INT1'");
  EXPECT_NE(told[2].find("(line 4, column 24, tag 'a1', instance 'x' of the template 't' in line 7)"),
            told[2].npos)
      << told[2];
  EXPECT_NE(told[4].find("the name 'b' is taken already"), told[4].npos);
  EXPECT_NE(told[4].find("it is in line 5 (tag 'b', instance 'x' of the template 't' in line 7)"),
            told[4].npos)
      << told[4];
}

/// The one problem that instances give.
std::string told(const std::string& instances, const std::string& templates = kStation) {
  const LoadedProject loaded = load_project(project(templates + ", \"instances\": " + instances));
  if (loaded.problems.size() != 1)
    return std::to_string(loaded.problems.size()) + " problems\n" + lines(loaded.problems);
  return loaded.problems[0].place + ": " + loaded.problems[0].text;
}

TEST(Templates, RefuseWrongInstances) {
  const auto one = [](const std::string& rest) {
    return told(R"([ { "template": "station", )" + rest + " } ]");
  };
  const std::string at = "/instances/0";
  EXPECT_EQ(one(R"("name": "S")"), at + ": the parameter 'n' of the template is missing; it has no default");
  EXPECT_EQ(one(R"("name": "S", "with": { "n": 1, "m": 2 })"),
            at + "/with/m: the template has no parameter 'm' (did you mean 'n'?); it has: n, pitch, first");
  EXPECT_EQ(one(R"("name": "S", "for": { "m": [1, 2] }, "with": { "n": 1 })").substr(0, 48),
            at + "/for: the template has no parameter ")
      << "once, not for each number";
  EXPECT_EQ(one(R"("name": "S${n}", "for": { "n": [1, 9] }, "with": { "n": 1 })"),
            at + "/with/n: the parameter 'n' is given already; each once")
      << "once, not for each number";
  EXPECT_EQ(one(R"("name": "S", "with": { "n": "${k}" })"),
            at + "/with/n: '${k}': there is no parameter 'k' here, and no other one");
  EXPECT_EQ(one(R"("name": "S", "for": { "n": [2, 1] })"),
            at + "/for/n: from is greater than to; allowed: [from, to]");
  EXPECT_NE(one(R"("name": "S", "for": { "n": [1] })").find("two whole numbers"), std::string::npos);
  EXPECT_NE(one(R"("name": "S", "for": { "n": [1, 2.5] })").find("an integer"), std::string::npos);
  EXPECT_NE(one(R"("name": "S", "for": { "n": [1, 2], "m": [1, 2] })")
                .find("this has 2 parameters; allowed is one"),
            std::string::npos);
  EXPECT_NE(one(R"("name": "S", "for": { "n": [1, 1000000] })").find("more than 10000 instances"),
            std::string::npos);
  EXPECT_NE(one(R"("name": "S", "for": { "n": [1, 2] })").find("there is an instance 'S' already in line"),
            std::string::npos);
  EXPECT_NE(one(R"("name": "3S", "with": { "n": 1 })").find(at + "/name: "), std::string::npos);
  EXPECT_NE(one(R"("name": "S", "with": { "n": [1] })").find("a number, a text, true, false"),
            std::string::npos);
  EXPECT_EQ(told(R"([ { "template": "staton", "name": "S" } ])"),
            at + "/template: there is no template 'staton' (did you mean 'station'?); allowed: station");
  EXPECT_EQ(told(R"([ { "name": "S" } ])"), at + ": the key 'template' is missing");
  EXPECT_EQ(told("{}"), "/instances: an object is not allowed here; allowed: an array");
}

TEST(Templates, RefuseWrongTemplates) {
  const auto one = [](const std::string& json) {
    return told("[]", "\"templates\": { \"t\": " + json + " }");
  };
  EXPECT_EQ(one("3"), "/templates/t: 3 is not allowed here; allowed: an object");
  EXPECT_NE(one(R"({ "clock": {} })").find("unknown key 'clock'"), std::string::npos);
  EXPECT_NE(one(R"({ "parameters": { "a b": {} } })").find("/templates/t/parameters/a b: "),
            std::string::npos);
  EXPECT_NE(one(R"({ "parameters": { "Name": {} } })").find("is there without being declared"),
            std::string::npos);
  EXPECT_NE(one(R"({ "parameters": { "n": {}, "N": {} } })").find("case does not count"), std::string::npos);
  EXPECT_NE(one(R"({ "parameters": { "n": { "default": [] } } })").find("a number, a text"),
            std::string::npos);
  EXPECT_NE(told(R"([ { "template": "t", "name": "x" } ])", R"("templates": { "t": { "tags": [] } })")
                .find("/templates/t/tags: an array is not allowed here"),
            std::string::npos);
  EXPECT_NE(told(R"([ { "template": "t", "name": "x", "with": { "a": 1, "b": 1 } } ])",
                 R"("templates": { "t": { "parameters": { "a": {}, "b": {} },
                     "tags": { "v${a}": { "type": "INT" }, "v${b}": { "type": "INT" } } } })")
                .find("the key 'v1' is there twice"),
            std::string::npos);
}

TEST(Templates, TellOnceWhatATemplateMayNotHaveHoweverManyInstancesThereAre) {
  for (const char* const section : {"clock", "templates", "instances", "retain", "include"})
    EXPECT_EQ(
        told(R"([ { "template": "t", "name": "x" }, { "template": "t", "name": "y" } ])",
             R"("templates": { "t": { ")" + std::string(section) + R"(": {} } })")
            .substr(0, 40),
        ("/templates/t/" + std::string(section) + ": unknown key '" + section + "'; allowed: parameters")
            .substr(0, 40))
        << section;
}

TEST(Templates, StopAtTheGreatestNumberOfValues) {
  const std::string many = R"("templates": { "t": { "parameters": { "n": {} }, "trace": { "signals": [ "x")" +
                           [] {
                             std::string list;
                             for (int i = 0; i < 2000; ++i) list += ", \"x\"";
                             return list;
                           }() +
                           " ] } } }";
  const std::string text =
      told(R"([ { "template": "t", "name": "x${n}", "for": { "n": [1, 9000] } } ])", many);
  EXPECT_NE(text.find("with its templates the project has more than 2000000 values"), std::string::npos)
      << text.substr(0, 1000);
}

std::string filled(const std::string& text, std::string* problem = nullptr) {
  const JsonDocument document(
      R"({ "n": 3, "x": 1.5, "on": true, "who": "Ann", "far": 9e9, "negative": -2 })");
  TemplateParameters parameters;
  for (const auto& [name, value] : document.root().members) parameters.emplace(name, value);
  JsonValue value;
  value.kind = JsonKind::string;
  value.text = text;
  const std::string told = fill_placeholders(value, parameters);
  if (problem != nullptr) *problem = told;
  return told.empty() ? value.shown() : told;
}

TEST(Placeholders, BecomeWhatTheyStandFor) {
  EXPECT_EQ(filled("${n}"), "3");
  EXPECT_EQ(filled("a${n}b${ N }"), "'a3b3'");
  EXPECT_EQ(filled("${x}"), "1.5");
  EXPECT_EQ(filled("${on}"), "true");
  EXPECT_EQ(filled("x := ${on}"), "'x := TRUE'");
  EXPECT_EQ(filled("${who}"), "'Ann'");
  EXPECT_EQ(filled("${n / 2}"), "1");
  EXPECT_EQ(filled("${n * x}"), "4.5");
  EXPECT_EQ(filled("${SEL(on, 1, n)}"), "3");
  EXPECT_EQ(filled("${n > 2}"), "true");
  EXPECT_EQ(filled("${negative + 1}"), "-1");
  EXPECT_EQ(filled("${far}"), "9e9");
  EXPECT_EQ(filled("'it$$'"), "''it$$''");
  EXPECT_EQ(filled("$${n} $n ${n}"), "'$${n} $n 3'");
  EXPECT_EQ(filled("nothing"), "'nothing'");
}

TEST(Placeholders, TellWhatIsWrong) {
  for (const auto& [text, part] :
       {std::pair{"${n", "has no '}'"}, std::pair{"${}", ""}, std::pair{"${k}", "no parameter 'k'"},
        std::pair{"${n +}", ""}, std::pair{"${n / 0}", "divides by zero"},
        std::pair{"${x / 0.0}", "no finite number"}, std::pair{"a ${who + 1}", "is a text"},
        std::pair{"${n.x}", "has no parts"}, std::pair{"${'a'}", ""}}) {
    std::string problem;
    filled(text, &problem);
    EXPECT_NE(problem, "") << text;
    EXPECT_NE(problem.find(part), std::string::npos) << problem;
  }
}

}  // namespace
}  // namespace lockstep
