// lockstep describe of what an MCO 305 has, against its tables.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "projects/aposs/parameter_names.hpp"
#include "scheduler/aposs/commands.hpp"
#include "tech_objects/mco305/device.hpp"
#include "tech_objects/mco305_catalogue/errors.hpp"
#include "tech_objects/mco305_catalogue/meanings.hpp"
#include "tech_objects/mco305_catalogue/system_variables.hpp"
#include "tests/cli/command_run.hpp"

namespace lockstep::cli::describe_mco305_test {
namespace {

using Json = nlohmann::json;

Json described(std::vector<std::string> words) {
  words.insert(words.begin(), "describe");
  words.emplace_back("--json");
  const Ended ended = lockstep(words);
  EXPECT_EQ(ended.status, 0) << ended.err;
  return ended.status == 0 ? Json::parse(ended.out) : Json();
}

TEST(DescribeMco305, TellsOfAParameterByNameAndNumber) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"KPROP"}, {"kprop"}, {"32-60"}, {"parameter", "KPROP"}}) {
    const Json shown = described(words);
    EXPECT_EQ(shown["kind"], "parameter");
    EXPECT_EQ(shown["number"], "32-60");
    EXPECT_EQ(shown["name"], "KPROP");
    EXPECT_EQ(shown["start"], "30");
    EXPECT_EQ(shown["range"], "0 to 100000");
    EXPECT_EQ(shown["kept_by"], "SAVE AXPARS");
    EXPECT_NE(shown["open"].get<std::string>().find("not in the sources"), std::string::npos);
  }
  EXPECT_EQ(described({"RAMPMIN"})["number"], "32-81");
  EXPECT_EQ(described({"1900"})["kept_by"], "by itself, and at once by SAVE USRPARS");
  EXPECT_EQ(described({"33-83"})["kept_by"], "SAVE GLBPARS");
  EXPECT_EQ(described({"34-50"})["kept_by"], "it is read only");
  EXPECT_EQ(lockstep({"describe", "32-99"}).status, 1);
}

// As the words stand in a message, in one pair of quotation marks.
TEST(DescribeMco305, TakesTwoWordsInOne) {
  EXPECT_EQ(described({"error 108"}), described({"error", "108"}));
  EXPECT_EQ(described({"sysvar 4277"}), described({"sysvar", "4277"}));
  EXPECT_EQ(described({"DEF ORIGIN"}), described({"DEF", "ORIGIN"}));
  EXPECT_EQ(described({"error 108"})["kind"], described({"error", "108"})["kind"]);
}

TEST(DescribeMco305, TellsWhatTheArgumentsOfACommandMayBe) {
  const Json ranges = described({"OUTDA"})["ranges"];
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_EQ(ranges[0]["name"], "output");
  EXPECT_EQ(ranges[0]["allowed"], "42");
  EXPECT_EQ(ranges[0]["any_other"], "error 171");
  EXPECT_EQ(ranges[1]["allowed"], "0 to 100000");
  EXPECT_FALSE(described({"POSA"}).contains("ranges"));
  EXPECT_NE(lockstep({"describe", "OUTDA"}).out.find("output 42; any other: error 171"), std::string::npos);
}

TEST(DescribeMco305, TellsOfCommandsErrorsAndSystemVariables) {
  const Json home = described({"HOME"});
  EXPECT_EQ(home["kind"], "command");
  EXPECT_EQ(home["program"], "waits for its end");
  EXPECT_EQ(described({"DEF", "ORIGIN"})["name"], "DEF ORIGIN");
  EXPECT_EQ(described({"POSA"})["form"], "POSA value");
  EXPECT_NE(described({"CANIN"})["refused"], "");
  const Json error = described({"error", "108"});
  EXPECT_EQ(error["number"], 108);
  EXPECT_EQ(error["bit"], "34-70, bit 3");
  EXPECT_NE(described({"error", "118"})["not_raised"].get<std::string>(), "");
  EXPECT_EQ(described({"sysvar", "4097"})["unit"], "qc");
  EXPECT_EQ(lockstep({"describe", "sysvar", "5000"}).status, 1);
  const Ended unknown = lockstep({"describe", "error", "104"});
  EXPECT_EQ(unknown.status, 1);
  EXPECT_NE(unknown.err.find("there is no error '104'; allowed: of an MCO_305 102, 103, 105"),
            std::string::npos)
      << unknown.err;
  EXPECT_EQ(lockstep({"describe", "error", "109999"}).status, 1);
  EXPECT_EQ(lockstep({"describe", "error", "16#8026"}).out, lockstep({"describe", "16#8026"}).out);
}

TEST(DescribeMco305, ListsTheParametersOfTheDrive) {
  const Json get = described({"GETVLT"}), set = described({"SETVLT"});
  ASSERT_GE(get["parameters"].size(), 11u);
  EXPECT_EQ(get["parameters"][0]["number"], "3-03");
  EXPECT_EQ(get["parameters"][0]["decimals"], 3);
  EXPECT_EQ(set["parameters"].size(), get["parameters"].size());
  const std::string page = lockstep({"describe", "SETVLT"}).out;
  EXPECT_NE(page.find("4-13"), std::string::npos);
  EXPECT_EQ(page.find("16-17"), std::string::npos) << "it cannot be set";
}

TEST(DescribeMco305, HasWordsForEverything) {
  for (const mco305::Parameter& of : mco305::parameters())
    EXPECT_FALSE(mco305::meaning_of(of.number).empty()) << of.number;
  for (const aposs::CommandRow& row : aposs::commands())
    if (row.kind == aposs::CommandKind::kStatement || row.kind == aposs::CommandKind::kFunction) {
      EXPECT_FALSE(aposs::meaning_of(row).empty()) << row.name;
    }
  mco305::Device device;
  device.configure({}, 1e-3);
  for (const mco305::SystemVariable& variable : mco305::system_variables()) {
    std::int32_t value = 0;
    const bool there = device.system_variable(variable.index, value);
    EXPECT_EQ(there, variable.built) << variable.index;
  }
}

TEST(DescribeMco305, IsFoundByTheSearch) {
  const Json found = described({"feed-forward"});
  bool parameter = false;
  for (const Json& one : found["found"]) parameter |= one["name"] == "32-66" && one["kind"] == "parameter";
  EXPECT_TRUE(parameter) << found;
}

}  // namespace
}  // namespace lockstep::cli::describe_mco305_test
