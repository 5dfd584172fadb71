// lockstep describe and lockstep linmot: what they tell of servo controllers LinMot.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/command_run.hpp"

namespace lockstep::cli::linmot_command_test {
namespace {

using Json = nlohmann::json;

Json described(std::vector<std::string> words) {
  words.insert(words.begin(), "describe");
  words.emplace_back("--json");
  const Ended ended = lockstep(words);
  EXPECT_EQ(ended.status, 0) << ended.err;
  return ended.status == 0 ? Json::parse(ended.out) : Json();
}

TEST(DescribeLinMot, TellsParametersCommandsAndModules) {
  const Json speed = described({"LinMot_Controller", "Max Speed"});
  EXPECT_EQ(speed["start"], "0.78125, printed");
  EXPECT_EQ(speed["signal"], "A.SetValueGeneration.FilterParameter.MaxSpeed");
  EXPECT_TRUE(speed["live"]);
  EXPECT_EQ(described({"LinMot_Controller", "Initialization\\Init Config\\Init Speed"})["start"],
            "0.05, ours: the source prints none");
  EXPECT_EQ(described({"ASCII"})["entries"].size(), 70u);
  EXPECT_EQ(described({"ASCII", "SP"})["range"], "-32256 to 32256");
  EXPECT_EQ(described({"MT"})["entries"].size(), 22u);
  EXPECT_EQ(described({"MT", "freeze"})["name"], "Freeze");
  EXPECT_EQ(described({"PROFIBUS", "Run Curve"})["words"], "1 out, 0 in");
}

TEST(LinMotCommand, CalculatesFeedForward) {
  const Ended ended = lockstep({"linmot", "tune", "--force-constant", "40", "--slider-mass", "0.829",
                                "--load-mass", "1.2", "--friction", "10", "--vertical"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  for (const char* const figure : {"2.029 kg", "0.2500 A", "50.725 mA/(m/s²)", "0.49761 A"})
    EXPECT_NE(ended.out.find(figure), std::string::npos) << figure << "\n" << ended.out;
}

TEST(LinMotCommand, TellsCurvesAndRows) {
  const std::string project = std::string(LOCKSTEP_SOURCE_DIR) + "/projects/27_lid/project.json";
  const Ended curves = lockstep({"linmot", "curve", project, "--number", "1"});
  EXPECT_NE(curves.out.find("Lid curve 1: 0 mm to 0 mm in 500 ms, at most 0.533333 m/s"), std::string::npos)
      << curves.out << curves.err;
  const Ended table = lockstep({"linmot", "table", project});
  EXPECT_NE(table.out.find("Abs. Position 0 mm, 1.00002 m/s, 50.0679 m/s²"), std::string::npos)
      << table.out << table.err;
  EXPECT_EQ(lockstep({"linmot", "curve", "/nowhere/x.json"}).status, 2);
}

}  // namespace
}  // namespace lockstep::cli::linmot_command_test
