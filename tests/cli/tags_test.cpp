// lockstep tags on a small project.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/cli/command_run.hpp"

namespace lockstep::cli::tags_test {
namespace {

using nlohmann::json;

constexpr char kProject[] = R"({
  "lockstep": 1, "name": "small", "description": "Two axes.",
  "clock": { "servo_cycle": "1ms", "interpolator_ratio": 1 },
  "technology_objects": {
    "Belt": { "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 } } },
    "Drum": { "type": "TO_SynchronousAxis", "config": { "VirtualAxis": { "Mode": 1 } },
              "leading_values": [ { "to": "Belt", "coupling": "setpoint" } ] }
  },
  "tags": {
    "go":    { "type": "BOOL", "init": true, "comment": "from the HMI" },
    "speed": { "type": "LREAL", "init": 12.5, "retain": true },
    "wait":  { "type": "TIME", "init": "250ms" },
    "mask":  { "type": "WORD", "init": 4660 }
  },
  "programs": [ { "name": "Main", "ob": "Main", "cycle": "10ms", "calls": [
    { "fb": "MC_Power", "name": "power", "in": { "Axis": "Belt", "Enable": "go" } } ] } ],
  "modbus": { "server": { "listen": "127.0.0.1:1502" }, "map": [
    { "tag": "go", "table": "coil", "address": 7 },
    { "tag": "speed", "table": "holding_register", "address": 10, "word_order": "little" },
    { "tag": "speed", "table": "input_register", "address": 20, "type": "REAL" },
    { "tag": "mask.X3", "table": "discrete_input", "address": 1 },
    { "tag": "power.Status", "table": "discrete_input", "address": 2 },
    { "tag": "Drum.ActualPosition", "table": "input_register", "address": 0, "type": "REAL" } ] }
})";

TEST(Write, SaysOnceWhatIsAllowed) {
  const Directory folder;
  json project = json::parse(kProject);
  project["modbus"]["map"].push_back({{"tag", "mask"}, {"table", "holding_register"}, {"address", 30}});
  const std::string file = folder.write("project.json", project.dump());
  const std::pair<const char*, const char*> cases[] = {
      {"speed=abc", "speed: 'abc' is a name, and only constants can stand here; allowed: a number (LREAL)\n"},
      {"speed=", "speed: the expression is empty; allowed: a number (LREAL)\n"},
      {"mask=70000", "mask: 70000 does not fit WORD (0 to 65535); allowed: a number without fraction"}};
  for (const auto& [value, problem] : cases) {
    const Ended ended = lockstep({"write", "127.0.0.1:1", "--project", file, value});
    EXPECT_EQ(ended.status, 1);
    EXPECT_NE(ended.err.find(problem), std::string::npos) << ended.err;
    const auto allowed = ended.err.find("allowed:");
    EXPECT_NE(allowed, std::string::npos) << ended.err;
    EXPECT_EQ(ended.err.find("allowed:", allowed + 1), std::string::npos) << ended.err;
  }
}

TEST(Tags, TellsBetweenWhichValuesAClientMayWrite) {
  const Directory folder;
  json project = json::parse(kProject);
  project["modbus"]["map"][1].update({{"min", 2.5}, {"max", 300}});
  project["modbus"]["map"].push_back(
      {{"tag", "wait"}, {"table", "holding_register"}, {"address", 30}, {"max", 60}});
  const Ended ended = lockstep({"tags", folder.write("project.json", project.dump())});
  EXPECT_EQ(ended.status, 0);
  EXPECT_NE(ended.out.find("write 2.5 to 300"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("write to 60"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("BOOL          write\n"), std::string::npos)
      << "a BOOL has no limits: " << ended.out;
}

TEST(Tags, TellsWhatIsOnModbusAsCsv) {
  const Directory folder;
  json project = json::parse(kProject);
  project["tags"]["go"]["comment"] = "from the \"HMI\", left";
  project["modbus"]["units"] = json::parse(
      R"([{"unit": 5, "map": [{"tag": "go", "table": "holding_register", "address": 3, "bit": 2},
                              {"tag": "speed", "table": "holding_register", "address": 4, "type": "INT",
                               "scale": 0.5, "offset": -1, "min": -0.5, "max": 300.5},
                              {"diagnostic": "clients", "table": "input_register", "address": 9}]}])");
  const Ended ended = lockstep({"tags", folder.write("project.json", project.dump()), "--csv"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_TRUE(ended.out.starts_with("name,type,unit,table,address,length,wire_type,word_order,"))
      << ended.out;
  for (const char* line :
       {"go,BOOL,,coil,7,1,BOOL,big,big,,,,write,,,\"from the \"\"HMI\"\", left\",,\r\n",
        "go,BOOL,,holding_register,3,1,BOOL,big,big,2,,,write,,5,\"from the \"\"HMI\"\", left\",,\r\n",
        "speed,LREAL,,holding_register,10,4,LREAL,little,big,,,,write,,,,,\r\n",
        "speed,LREAL,,holding_register,4,1,INT,big,big,,0.5,-1,write,,5,,-0.5,300.5\r\n",
        "diagnostic.clients,ULINT,,input_register,9,4,ULINT,big,big,,,,read,,5,,,\r\n",
        "Drum.ActualPosition,LREAL,mm,input_register,0,2,REAL,big,big,,,,read,,,,,\r\n"})
    EXPECT_NE(ended.out.find(line), std::string::npos) << line << ended.out;
}

TEST(Tags, TellsArraysOnModbusAsOneLineEach) {
  const Directory folder;
  json project = json::parse(kProject);
  project["tags"]["heights"] = {{"type", "ARRAY[0..3] OF LREAL"}, {"comment", "of parts"}, {"retain", true}};
  project["tags"]["lamps"] = {{"type", "ARRAY[1..20] OF BOOL"}};
  project["modbus"]["map"] = json::parse(R"([
    { "tag": "heights", "table": "holding_register", "address": 40, "type": "REAL" },
    { "tag": "heights[1..2]", "table": "input_register", "address": 80 },
    { "tag": "lamps", "table": "holding_register", "address": 60, "bit": 14 } ])");
  const std::string file = folder.write("project.json", project.dump());
  const std::string csv = lockstep({"tags", file, "--csv"}).out;
  for (const char* line :
       {"heights,ARRAY[0..3] OF LREAL,,holding_register,40,8,REAL,big,big,,,,write,,,of parts,,\r\n",
        "heights[1..2],ARRAY[1..2] OF LREAL,,input_register,80,8,LREAL,big,big,,,,read,,,,,\r\n",
        "lamps,ARRAY[1..20] OF BOOL,,holding_register,60,3,BOOL,big,big,14,,,write,,,,,\r\n"})
    EXPECT_NE(csv.find(line), std::string::npos) << line << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  const json shown = json::parse(lockstep({"tags", file, "--json"}).out);
  EXPECT_EQ(shown["arrays"][0]["retain"], true);
  const json& place = shown["arrays"][0]["modbus"][0];
  EXPECT_EQ(place["elements"], 4);
  EXPECT_EQ(place["registers"], 8);
  EXPECT_EQ(place["type"], "REAL");
  EXPECT_EQ(shown["other_modbus"][0]["name"], "heights[1..2]");
  const std::string text = lockstep({"tags", file}).out;
  EXPECT_NE(text.find("40-47"), std::string::npos) << text;
  EXPECT_NE(text.find("4 REAL"), std::string::npos) << text;
  EXPECT_NE(text.find("60-62"), std::string::npos) << text;
}

TEST(Tags, TellsTexts) {
  const Directory folder;
  json project = json::parse(kProject);
  project["tags"]["kind"] = {
      {"type", "STRING[5]"}, {"init", "it's"}, {"comment", "of bottle"}, {"retain", true}};
  project["tags"]["note"] = {{"type", "STRING[20]"}};
  project["modbus"]["map"] = json::parse(R"([
    { "tag": "kind", "table": "holding_register", "address": 40 }, { "tag": "go", "table": "coil", "address": 1 },
    { "tag": "kind", "table": "input_register", "address": 50, "byte_order": "little" } ])");
  const std::string file = folder.write("project.json", project.dump());
  const std::string csv = lockstep({"tags", file, "--csv"}).out;
  for (const char* line : {"kind,STRING[5],,holding_register,40,3,STRING,big,big,,,,write,,,of bottle,,\r\n",
                           "kind,STRING[5],,input_register,50,3,STRING,big,little,,,,read,,,of bottle,,\r\n",
                           "go,BOOL,,coil,1,1,BOOL,big,big,,,,write,,,from the HMI,,\r\n"})
    EXPECT_NE(csv.find(line), std::string::npos) << line << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  const json shown = json::parse(lockstep({"tags", file, "--json"}).out);
  ASSERT_EQ(shown["strings"].size(), 2u);
  const json& kind = shown["strings"][0];
  EXPECT_EQ(kind["initial"], "it's");
  EXPECT_EQ(kind["retain"], true);
  EXPECT_EQ(kind["modbus"][0]["registers"], 3);
  EXPECT_EQ(kind["modbus"][0]["type"], "STRING");
  EXPECT_EQ(kind["modbus"][1]["byte_order"], "little");
  EXPECT_TRUE(shown["other_modbus"].empty());
  const std::string text = lockstep({"tags", file}).out;
  for (const char* part : {"'it$'s'", "STRING[5]", "40-42", "STRING swapped", "STRING[20]"})
    EXPECT_NE(text.find(part), std::string::npos) << part << text;
}

TEST(Tags, TellsArraysAndTheElementsThatAreOnModbus) {
  const Directory folder;
  json project = json::parse(kProject);
  project["tags"]["curve"] = {{"type", "array[0..4] of TO_Cam_Struct_PointData"}, {"comment", "of a cam"}};
  project["modbus"]["map"].push_back(
      {{"tag", "curve[2].y"}, {"table", "holding_register"}, {"address", 40}, {"type", "REAL"}});
  const std::string file = folder.write("project.json", project.dump());
  const json shown = json::parse(lockstep({"tags", file, "--json"}).out);
  EXPECT_EQ(shown["arrays"],
            json::parse(R"([{"name": "curve", "type": "ARRAY[0..4] OF TO_Cam_Struct_PointData",
      "lower": 0, "upper": 4, "of": "TO_Cam_Struct_PointData", "retain": false, "comment": "of a cam",
      "modbus": []}])"));
  bool found = false;
  for (const json& other : shown["other_modbus"])
    found |= other["name"] == "curve[2].y" && other["modbus"]["access"] == "write" && other["unit"] == "u";
  EXPECT_TRUE(found) << shown["other_modbus"];
  const std::string text = lockstep({"tags", file}).out;
  EXPECT_NE(text.find("curve"), std::string::npos);
  EXPECT_NE(text.find("ARRAY[0..4]"), std::string::npos) << text;
}

TEST(Tags, TellsTagsWithTheirAddressesAndWhatElseIsOnModbusAndTheNumbersOfObjects) {
  const Directory folder;
  const Ended ended = lockstep({"tags", folder.write("project.json", kProject), "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const json shown = json::parse(ended.out);
  EXPECT_EQ(shown["modbus_server"], "127.0.0.1:1502");
  ASSERT_EQ(shown["tags"].size(), 4u);
  EXPECT_EQ(shown["tags"][0], json::parse(R"({"name": "go", "type": "BOOL", "initial": true, "retain": false,
      "comment": "from the HMI", "modbus": [{"table": "coil", "address": 7, "bits": 1, "type": "BOOL",
      "word_order": "big", "access": "write"}]})"));
  EXPECT_EQ(shown["tags"][1],
            json::parse(R"({"name": "speed", "type": "LREAL", "initial": 12.5, "retain": true,
      "comment": "", "modbus": [{"table": "holding_register", "address": 10, "registers": 4, "type": "LREAL",
      "word_order": "little", "access": "write"}, {"table": "input_register", "address": 20, "registers": 2,
      "type": "REAL", "word_order": "big", "access": "read"}]})"));
  EXPECT_EQ(shown["tags"][2]["initial"], "T#0.25s");
  EXPECT_EQ(shown["tags"][3]["modbus"], json::array());
  ASSERT_EQ(shown["other_modbus"].size(), 3u);
  EXPECT_EQ(shown["other_modbus"][0]["name"], "mask.X3");
  EXPECT_EQ(shown["other_modbus"][0]["type"], "BOOL");
  EXPECT_EQ(shown["other_modbus"][1]["name"], "power.Status");
  EXPECT_EQ(shown["other_modbus"][2]["unit"], "mm");
  EXPECT_EQ(shown["technology_objects"],
            json::parse(R"([{"number": 1, "name": "Belt", "type": "TO_PositioningAxis"},
                            {"number": 2, "name": "Drum", "type": "TO_SynchronousAxis"}])"));
}

TEST(Tags, AlignsTheTable) {
  const Directory folder;
  const Ended ended = lockstep({"tags", folder.write("project.json", kProject)});
  ASSERT_EQ(ended.status, 0) << ended.err;
  for (const char* line : {"\ngo ", " TRUE ", " 12.5 ", " retain ", "\n    from the HMI", " 10-13 ",
                           "LREAL little", "16#1234", "\nmask.X3 ", "\n2       Drum "})
    EXPECT_NE(ended.out.find(line), std::string::npos) << line << "\n" << ended.out;
}

TEST(Tags, ExitsAsCheckDoes) {
  const Directory folder;
  const Ended missing = lockstep({"tags", folder.file("nothing.json")});
  EXPECT_EQ(missing.status, 2);
  const Ended wrong = lockstep({"tags", folder.write("wrong.json", R"({"lockstep": 1, "nmae": "x"})")});
  EXPECT_EQ(wrong.status, 1);
  EXPECT_NE(wrong.err.find("wrong.json:/nmae: "), std::string::npos) << wrong.err;
  EXPECT_EQ(wrong.out, "");
}

}  // namespace
}  // namespace lockstep::cli::tags_test
