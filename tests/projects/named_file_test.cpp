// Files that a project names: regular ones within its folder, whatever names them.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "projects/aposs/compiler.hpp"
#include "projects/cam_files/file.hpp"
#include "projects/json/text_file.hpp"
#include "projects/loader/project.hpp"
#include "projects/system/system.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::named_file_test {
namespace {

using Json = nlohmann::ordered_json;

class NamedFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(directory_.file("machine"));
    directory_.write("outside", kSecret);
    directory_.write("machine/inside", "0,0\n360,360\n");
    std::filesystem::create_symlink(directory_.file("outside"), directory_.file("machine/link"));
    std::filesystem::create_symlink(directory_.file("machine/inside"), directory_.file("machine/near"));
    ASSERT_EQ(::mkfifo(directory_.file("machine/pipe").c_str(), 0600), 0);
  }

  /// An object for each kind of file that it may name.
  static std::vector<std::pair<std::string, Json>> objects(const std::string& name) {
    const Json file = {{"file", name}};
    return {
        {"/technology_objects/X/file", {{"type", "TO_Cam"}, {"file", name}}},
        {"/technology_objects/X/parameters/file", {{"type", "MCO_305"}, {"parameters", file}}},
        {"/technology_objects/X/programs/0/file",
         {{"type", "MCO_305"}, {"programs", {{{"number", 0}, {"file", name}}}}}},
        {"/technology_objects/X/state_table/file", {{"type", "LinMot_Controller"}, {"state_table", file}}},
        {"/technology_objects/X/curves/1/parts/0/file",
         {{"type", "LinMot_Controller"}, {"curves", {{"1", {{"parts", {file}}}}}}}}};
  }

  /// The problems of a project with the object, a line each.
  std::string told(const Json& object) const {
    Json project = Json::parse(R"({ "lockstep": 1, "name": "files", "clock": { "servo_cycle": "1ms" } })");
    project["technology_objects"]["X"] = object;
    directory_.write("machine/project.json", project.dump());
    std::string lines;
    for (const Problem& problem : load_project_file(directory_.file("machine/project.json")).problems)
      lines += to_string("project.json", problem) + "\n";
    return lines;
  }

  static constexpr char kSecret[] = "root:x:0:0:root:/root:/bin/bash\n";
  const test::Directory directory_;
};

TEST_F(NamedFiles, StayWithinTheFolderOfTheProject) {
  for (const std::string& name : {std::string("../outside"), directory_.file("outside"), std::string("link"),
                                  std::string("../../../../../../etc/passwd"), std::string("../none")})
    for (const auto& [place, object] : objects(name)) {
      const std::string lines = told(object);
      EXPECT_NE(lines.find("project.json:" + place + ": '" + name +
                           "' leads out of the folder of the project; allowed: files in it and below it"),
                std::string::npos)
          << lines;
      EXPECT_EQ(lines.find("root:"), std::string::npos) << "what stands there is told: " << lines;
    }
}

TEST_F(NamedFiles, AreNoPipes) {
  for (const auto& [place, object] : objects("pipe"))
    EXPECT_NE(told(object).find("machine/pipe: is no regular file but a pipe, a device or a socket"),
              std::string::npos)
        << place << ": " << told(object);
}

TEST_F(NamedFiles, AreReadThroughALinkWithinTheFolder) {
  for (const char* name : {"inside", "near", "./inside", "../machine/inside"})
    EXPECT_EQ(told(objects(name)[0].second), "") << name;
}

TEST_F(NamedFiles, OfAProgramStayWithinTheFolderToo) {
  directory_.write("outside.m", "x = 1\n");
  std::filesystem::create_symlink(directory_.file("outside.m"), directory_.file("machine/link.m"));
  directory_.write("machine/main.m", "#INCLUDE \"link.m\"\n");
  const Json object = {{"type", "MCO_305"}, {"programs", {{{"number", 0}, {"file", "main.m"}}}}};
  EXPECT_NE(told(object).find("#INCLUDE of 'link.m': the file cannot be read"), std::string::npos)
      << told(object);
  EXPECT_TRUE(aposs::compile_file(directory_.file("machine/main.m")).image) << "which is of no project";
}

TEST_F(NamedFiles, ACamOfAProjectThatIsLookedAtAloneStaysThereToo) {
  const std::string project =
      R"({ "lockstep": 1, "technology_objects": { "X": { "type": "TO_Cam", "file": "../outside" } } })";
  const LoadedCam cam = load_cam(project, directory_.file("machine"), "X", kCamPoints);
  ASSERT_EQ(cam.problems.size(), 1U);
  EXPECT_NE(cam.problems[0].text.find("leads out of the folder"), std::string::npos) << cam.problems[0].text;
}

TEST_F(NamedFiles, ThatEverythingBeginsWithAreNoPipesOrDevicesEither) {
  for (const std::string& path : {directory_.file("machine/pipe"), std::string("/dev/zero")}) {
    EXPECT_THROW(read_text_file(path, 1024), UnreadableFile) << path;
    EXPECT_THROW(load_project_file(path), UnreadableFile) << path;
    EXPECT_THROW(load_system_file(path), UnreadableFile) << path;
    EXPECT_THROW(load_cam_file(path, "", kCamPoints), UnreadableFile) << path;
    EXPECT_THROW(aposs::compile_file(path), UnreadableFile) << path;
    EXPECT_FALSE(is_system_file(path)) << path;
  }
  const std::string system = directory_.write("machine/system.json", R"({ "lockstep_system": 1, "name": "s",
    "controllers": { "A": { "project": "pipe" } } })");
  std::string lines;
  for (const Problem& problem : load_system_file(system).problems) lines += to_string("", problem) + "\n";
  EXPECT_NE(lines.find("pipe: is no regular file but a pipe"), std::string::npos) << lines;
}

}  // namespace
}  // namespace lockstep::named_file_test
