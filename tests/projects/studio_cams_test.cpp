// Cams for pages: those of a project, and files that stand in the body of a request.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "projects/cam_files/facts.hpp"
#include "projects/cam_files/file.hpp"
#include "projects/cam_files/table.hpp"
#include "tests/projects/studio_files.hpp"

namespace lockstep::studio_cams_test {
namespace {

using Json = nlohmann::json;

const std::string kFolder = LOCKSTEP_SOURCE_DIR "/projects/cams/";

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

class Studio : public test::StudioMachine {
 public:
  Studio()
      : StudioMachine(Simulation::from_text(R"({ "lockstep": 1, "name": "cams",
      "clock": { "servo_cycle": "1ms" }, "programs": [] })")) {
    StudioPowers powers;
    powers.project_folder = LOCKSTEP_SOURCE_DIR "/projects";
    powers.project_text = R"({ "lockstep": 1, "name": "cams", "clock": { "servo_cycle": "1ms" },
        "technology_objects": { "Curve": { "type": "TO_Cam", "file": "cams/press.cam.json" },
                                "Gone": { "type": "TO_Cam", "file": "cams/none.cam.json" } }, "programs": [] })";
    powers.cams = {{"feeder.cam.json", kFolder + "feeder.cam.json"},
                   {"gone.cam.json", kFolder + "gone.cam.json"}};
    session.empower(powers);
  }
  StudioAnswer design(const std::string& body, std::vector<std::pair<std::string, std::string>> query = {}) {
    return ask("POST", "/api/cam/design", std::move(query), body);
  }
};

TEST(StudioCams, AreThoseOfTheProjectAndTheFilesThatWereGiven) {
  Studio studio;
  const Json cams = studio.get("/api/cams").at("cams");
  ASSERT_EQ(cams.size(), 4u) << cams;
  EXPECT_EQ(cams[0].at("name"), "Curve");
  EXPECT_EQ(cams[2].at("name"), "feeder.cam.json");
  EXPECT_EQ(cams[2].at("type"), "file");
  const Json press = studio.get("/api/cams/Curve");
  EXPECT_TRUE(press.at("problems").empty()) << press;
  const LoadedCam known = load_cam_file(kFolder + "press.cam.json", "", kCamPoints);
  ASSERT_TRUE(known.definition);
  EXPECT_EQ(press.at("extremes"), Json::parse(cam_facts(*known.definition).dump()).at("extremes"));
  EXPECT_FALSE(studio.get("/api/cams/Gone").at("problems").empty()) << "what is wrong with it is told";
  EXPECT_EQ(studio.ask("GET", "/api/cams/gone.cam.json").status, 404u);
  EXPECT_EQ(studio.ask("GET", "/api/cams/Other").status, 404u);
  EXPECT_EQ(studio.ask("GET", "/api/cams/../../etc/passwd").status, 404u);
}

TEST(StudioCams, HaveTheCurvesThatTheProductComputes) {
  Studio studio;
  const Json cam = studio.get("/api/cams/feeder.cam.json", {{"curves", "91"}});
  const LoadedCam known = load_cam_file(kFolder + "feeder.cam.json", "", kCamPoints);
  const CamFunction& function = *known.definition->cam.function;
  const auto samples = sampled(function, function.start_leading_value(), function.end_leading_value(), 91);
  const Json& curves = cam.at("curves");
  ASSERT_EQ(curves.at("x").size(), samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(curves.at("x")[i].get<double>(), samples[i].x);
    EXPECT_EQ(curves.at("following value")[i].get<double>(), samples[i].value.position);
    EXPECT_EQ(curves.at("acceleration")[i].get<double>(), samples[i].value.second);
  }
  for (const char* wrong : {"1", "10001", "-2"})
    EXPECT_EQ(studio.ask("GET", "/api/cams/feeder.cam.json", {{"curves", wrong}}).status, 422u) << wrong;
  EXPECT_FALSE(studio.get("/api/cams/feeder.cam.json").contains("curves")) << "unless asked for";
}

TEST(StudioCams, OfABodyAreDesignedWithAllThatIsWrong) {
  Studio studio;
  const StudioAnswer whole = studio.design(text_of(kFolder + "feeder.cam.json"), {{"curves", "11"}});
  ASSERT_EQ(whole.status, 200u) << whole.body;
  const Json json = Json::parse(whole.body);
  EXPECT_EQ(json.at("name"), "Feeder");
  EXPECT_TRUE(json.at("problems").empty());
  EXPECT_EQ(json.at("curves").at("x").size(), 11u);
  const StudioAnswer wrong = studio.design(
      R"({ "lockstep_cam": 1, "type": "TO_Cam", "elements": [ { "shape": "line" }, { "shape": "nothing" } ] })");
  ASSERT_EQ(wrong.status, 200u) << "problems are what was asked for: " << wrong.body;
  EXPECT_GE(Json::parse(wrong.body).at("problems").size(), 2u) << wrong.body;
  EXPECT_EQ(studio.design("{ \"lockstep_cam\": 1, ").status, 422u);
  EXPECT_EQ(studio.design("").status, 422u);
  EXPECT_EQ(studio.design("x,y\n0,0\n1,1\n").status, 422u);
  EXPECT_EQ(studio.ask("GET", "/api/cam/design").status, 404u);
}

// A project names files, and what is wrong with them would be told to whoever asks.
TEST(StudioCams, OfABodyReadNoFileOfThisMachine) {
  Studio studio;
  for (const std::string body : {R"({ "lockstep": 1, "name": "x", "include": ["/etc/passwd"] })",
                                 R"({ "lockstep_cam": 1, "lockstep": 1, "include": ["/etc/passwd"] })",
                                 R"({ "lockstep_cam": 1, "type": "TO_Cam", "file": "/etc/passwd" })"}) {
    const StudioAnswer answer = studio.design(body);
    EXPECT_EQ(answer.body.find("root"), std::string::npos) << answer.body;
    EXPECT_TRUE(answer.status == 422u || !Json::parse(answer.body).at("problems").empty()) << answer.body;
  }
}

}  // namespace
}  // namespace lockstep::studio_cams_test
