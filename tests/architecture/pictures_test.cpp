// The pictures of README.md: the folders in the order in which they may use each other, the steps of a tick
// in the order in which the cycle takes them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/architecture/source_text.hpp"

namespace lockstep::pictures_test {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& path) {
  std::ifstream file(fs::path(LOCKSTEP_SOURCE_DIR) / path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The blocks of text set in a fixed pitch in the section "The house".
std::vector<std::string> pictures() {
  const std::string readme = content_of("README.md");
  const std::size_t begin = readme.find("\n## The house\n");
  const std::string section = readme.substr(begin, readme.find("\n## ", begin + 1) - begin);
  std::vector<std::string> found;
  for (std::size_t from = section.find("\n```\n"); from != std::string::npos;) {
    const std::size_t to = section.find("\n```\n", from + 1);
    found.push_back(section.substr(from + 5, to - from - 5));
    from = section.find("\n```\n", to + 1);
  }
  return found;
}

// Which of the words do not come one behind the other, in this order, one a line.
std::string out_of_order(const std::string& text, const std::vector<std::string>& words) {
  std::string missing;
  std::size_t from = 0;
  for (const std::string& word : words) {
    const std::size_t at = text.find(word, from);
    if (at == std::string::npos)
      missing += word + "\n";
    else
      from = at + word.size();
  }
  return missing;
}

TEST(Pictures, ShowEachFolderAboveThoseThatItUses) {
  ASSERT_EQ(pictures().size(), 2u);
  const std::vector<std::string> folders = {"│ cli ",       "│ projects ", "│ hmi_bridge ",
                                            "│ scheduler ", "│ fb ",       "│ tech_objects "};
  EXPECT_EQ(out_of_order(pictures()[0], folders), "");
  // The layering itself is held by `folders_test`, from the lowest to the highest.
  EXPECT_EQ(out_of_order(content_of("tests/architecture/folders_test.cpp"),
                         {R"("tech_objects", "fb", "scheduler", "hmi_bridge", "projects", "cli")"}),
            "");
}

TEST(Pictures, ShowRoomsThatAreThere) {
  const std::string picture = pictures().at(0);
  const std::string lowest = picture.substr(picture.find("│ tech_objects "));
  for (const std::string room : {"axis", "sensing", "switching", "cam_object", "drive", "synchronous", "cam",
                                 "profile", "filters", "arithmetic"}) {
    EXPECT_NE(lowest.find(" " + room + " "), std::string::npos) << room;
    EXPECT_TRUE(fs::is_directory(fs::path(LOCKSTEP_SOURCE_DIR) / "tech_objects" / room)) << room;
  }
}

// The calls that `Controller::tick` makes, in their order.
TEST(Pictures, ShowATickAsTheCycleRunsIt) {
  const std::string cycle = code_of(content_of("scheduler/cycle.cpp"), false);
  const std::size_t begin = cycle.find("void Controller::tick()");
  const std::string tick = cycle.substr(begin, cycle.find("\n}", begin) - begin);
  EXPECT_EQ(out_of_order(tick, {"take_inputs(", "Ob::MC_PreServo", "servo(t)", "Ob::MC_PostServo",
                                "Ob::MC_PreInterpolator", "interpolate()", "run_due_programs(",
                                "tell_events(", "show("}),
            "");
  EXPECT_EQ(out_of_order(pictures().at(1),
                         {"inputs", "MC_PreServo", "MC_Servo", "MC_PostServo", "MC_PreInterpolator",
                          "MC_Interpolator", "Cyclic, Main", "events", "process image", "trace row"}),
            "");
}

TEST(Pictures, ShowATickOfALinMotControllerAsItIs) {
  const std::vector<std::string> steps = {
      "read_inputs", "take_changed_parameters", "change_state", "freeze_motors", "read_code",
      "move_motors", "follow_curves",           "watch",        "write_outputs", "show"};
  const std::vector<std::string> of_motors = {"tick", "home_next", "run"};
  const std::string readme = content_of("tech_objects/linmot/README.md");
  const std::size_t begin = readme.find("\n```\n");
  const std::string picture = readme.substr(begin, readme.find("\n```\n", begin + 1) - begin);
  EXPECT_EQ(out_of_order(picture, steps), "");
  EXPECT_EQ(out_of_order(picture.substr(picture.find("move_motors")), of_motors), "");
  const std::string source = content_of("tech_objects/linmot/controller.cpp");
  const auto body = [&source](const std::string& name) {
    const std::string from = source.substr(source.find("void LinMotController::" + name + "("));
    return from.substr(0, from.find("\n}\n"));
  };
  EXPECT_EQ(out_of_order(body("servo"), steps), "");
  EXPECT_EQ(out_of_order(body("home_motors"), of_motors), "");
}

}  // namespace
}  // namespace lockstep::pictures_test
