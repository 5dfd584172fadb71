// The files of a project that pages read and change at the desk, and each refusal.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/projects/studio_files.hpp"

namespace lockstep::studio_project_files_test {
namespace {

using Json = nlohmann::json;
using test::StudioFolder;

const std::string kProject = R"({ "lockstep": 1, "name": "desk", // with a comment
  "clock": { "servo_cycle": "1ms" }, "technology_objects": { "Curve": { "type": "TO_Cam", "file": "cams/feeder.cam.json" } }, "programs": [] })";

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A folder with a project and its cam.
struct Desk {
  Desk() {
    std::filesystem::create_directory(folder.path() / "cams");
    std::filesystem::copy(LOCKSTEP_SOURCE_DIR "/projects/cams/feeder.cam.json", folder.path() / "cams");
    project = folder.write("desk.json", kProject);
  }
  std::filesystem::path at(const std::string& name) const { return folder.path() / name; }

  StudioFolder folder;
  std::string project;
};

/// Its studio, as `lockstep studio` has it.
class Studio : public test::StudioMachine {
 public:
  Studio()
      : StudioMachine(Simulation::from_text(R"({ "lockstep": 1, "name": "desk",
      "clock": { "servo_cycle": "1ms" }, "programs": [] })")) {
    allow("");
  }
  void allow(const std::string& why_no_write) {
    StudioPowers powers;
    powers.mode = StudioMode::desk;
    powers.why_no_write = why_no_write;
    powers.project_file = desk.project;
    powers.project_text = expanded_project(desk.project);
    powers.tell = [this](const TraceEvent& event) { told.push_back(event); };
    session.empower(powers);
  }
  StudioAnswer read(const std::string& name) { return ask("GET", "/api/files/" + name); }
  /// @param known value of If-Match, or `new` for If-None-Match: *
  StudioAnswer put(const std::string& name, const std::string& known, const std::string& body) {
    StudioRequest request;
    request.method = "PUT";
    request.path = "/api/files/" + name;
    request.body = body;
    request.peer = "192.0.2.7:4242";
    if (known == "new")
      request.if_none_match = "*";
    else
      request.if_match = known;
    StudioAnswer answer;
    answer.status = 0;
    session.answer(request, [&answer](StudioAnswer given) { answer = std::move(given); });
    return answer;
  }

  Desk desk;
  std::vector<TraceEvent> told;
};

std::string code_of(const StudioAnswer& answer) {
  return Json::parse(answer.body).at("error").at("code");
}

TEST(StudioProjectFiles, AreReadAsTheyAre) {
  Studio studio;
  const StudioAnswer project = studio.read("desk.json");
  EXPECT_EQ(project.status, 200u);
  EXPECT_EQ(project.body, kProject) << "with its comments";
  EXPECT_TRUE(project.etag.starts_with('"') && project.etag.ends_with('"')) << project.etag;
  EXPECT_EQ(studio.read("desk.json").etag, project.etag);
  const StudioAnswer cam = studio.read("cams/feeder.cam.json");
  EXPECT_EQ(cam.status, 200u);
  EXPECT_EQ(cam.body, content_of(studio.desk.at("cams/feeder.cam.json")));
  EXPECT_NE(cam.etag, project.etag);
  EXPECT_EQ(studio.get("/api/project").at("files").dump(), R"(["desk.json","cams/feeder.cam.json"])");
  EXPECT_TRUE(studio.told.empty()) << "who looks changes nothing";
}

TEST(StudioProjectFiles, AreChangedByWhoKnowsWhatIsInThem) {
  Studio studio;
  ASSERT_EQ(::chmod(studio.desk.project.c_str(), 0640), 0);
  const std::string etag = studio.read("desk.json").etag;
  const std::string text = "{ \"lockstep\": 1 } // saved\n";
  const StudioAnswer put = studio.put("desk.json", etag, text);
  EXPECT_EQ(put.status, 200u) << put.body;
  EXPECT_EQ(content_of(studio.desk.project), text);
  EXPECT_EQ(put.etag, studio.read("desk.json").etag);
  EXPECT_NE(put.etag, etag);
  struct stat status {};
  ASSERT_EQ(::stat(studio.desk.project.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0640u) << "it stays what it was";
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(studio.desk.folder.path()), {}), 2)
      << "nothing lies beside it";
  ASSERT_EQ(studio.told.size(), 1u);
  EXPECT_EQ(studio.told[0].kind, EventKind::written);
  EXPECT_EQ(studio.told[0].source, "desk.json");
  EXPECT_EQ(studio.told[0].address, "192.0.2.7:4242");
  // A list of ETags, but not any of them at all.
  EXPECT_EQ(studio.put("desk.json", "\"a\", " + put.etag, "{}").status, 200u);
  EXPECT_EQ(studio.put("cams/feeder.cam.json", "*", "{}").status, 428u);
}

TEST(StudioProjectFiles, AskForIfMatchAndRefuseWhatIsStale) {
  Studio studio;
  const std::string etag = studio.read("desk.json").etag;
  const StudioAnswer unknown = studio.put("desk.json", "", "{}");
  EXPECT_EQ(unknown.status, 428u);
  EXPECT_EQ(code_of(unknown), "stale");
  EXPECT_NE(unknown.body.find("If-Match"), std::string::npos);
  const StudioAnswer whatever = studio.put("desk.json", "*", "{}");
  EXPECT_EQ(whatever.status, 428u);
  EXPECT_NE(whatever.body.find("'*' says nothing"), std::string::npos) << whatever.body;
  EXPECT_EQ(content_of(studio.desk.project), kProject);
  // Somebody else changes it meanwhile.
  studio.desk.folder.write("desk.json", kProject + "\n");
  const StudioAnswer stale = studio.put("desk.json", etag, "{}");
  EXPECT_EQ(stale.status, 412u);
  EXPECT_EQ(code_of(stale), "stale");
  EXPECT_EQ(studio.put("desk.json", "new", "{}").status, 412u) << "it is there already";
  EXPECT_EQ(content_of(studio.desk.project), kProject + "\n");
  EXPECT_EQ(studio.told.back().kind, EventKind::write_refused);
  std::filesystem::remove(studio.desk.project);
  EXPECT_EQ(studio.put("desk.json", etag, "{}").status, 412u) << "it is gone";
  EXPECT_EQ(studio.read("desk.json").status, 404u);
}

TEST(StudioProjectFiles, MayBeNewCams) {
  Studio studio;
  EXPECT_EQ(studio.read("new.cam.json").status, 404u);
  EXPECT_EQ(studio.put("new.cam.json", "", "{}").status, 428u);
  EXPECT_EQ(studio.put("new.cam.json", "\"1\"", "{}").status, 412u);
  const StudioAnswer made = studio.put("new.cam.json", "new", "{ \"cam\": 1 }");
  EXPECT_EQ(made.status, 200u) << made.body;
  EXPECT_EQ(studio.read("new.cam.json").body, "{ \"cam\": 1 }");
  EXPECT_EQ(studio.put("new.cam.json", "new", "{}").status, 412u);
  EXPECT_EQ(studio.put("new.cam.json", made.etag, "{}").status, 200u);
}

TEST(StudioProjectFiles, HoldLayoutsOfPagesBesideTheProject) {
  Studio studio;
  EXPECT_EQ(studio.read("studio.json").status, 404u) << "nobody has kept one yet";
  EXPECT_EQ(studio.put("studio.json", "", "{}").status, 428u);
  const std::string layouts = R"({"lockstep_studio":1,"layouts":{}})";
  const StudioAnswer made = studio.put("studio.json", "new", layouts);
  EXPECT_EQ(made.status, 200u) << made.body;
  EXPECT_EQ(content_of(studio.desk.at("studio.json")), layouts);
  EXPECT_EQ(studio.read("studio.json").etag, made.etag);
  EXPECT_EQ(studio.put("studio.json", "new", "{}").status, 412u) << "somebody else has";
  EXPECT_EQ(studio.put("studio.json", made.etag, "{}").status, 200u);
  EXPECT_EQ(studio.put("cams/studio.json", "new", "{}").status, 404u) << "beside the project alone";
}

TEST(StudioProjectFiles, AreNothingElse) {
  Studio studio;
  studio.desk.folder.write("other.json", "{}");
  studio.desk.folder.write("cams/other.cam.json", "{}");
  const StudioFolder elsewhere;
  const std::string secret = elsewhere.write("secret.cam.json", "{}");
  std::filesystem::create_symlink(secret, studio.desk.at("link.cam.json"));
  std::filesystem::create_directory(studio.desk.at("folder.cam.json"));
  for (const std::string name :
       {"other.json", "cams/other.cam.json", ".cam.json", "none.json", "desk.json/x", "Desk.json"}) {
    EXPECT_EQ(studio.read(name).status, 404u) << name;
    EXPECT_EQ(studio.put(name, "*", "{}").status, 404u) << name;
    EXPECT_EQ(studio.put(name, "new", "{}").status, 404u) << name;
  }
  for (const std::string& name :
       {std::string(""), std::string(".."), std::string("../secret.cam.json"), secret,
        std::string("cams/../desk.json"), std::string("a\0.cam.json", 11), std::string("a\n.cam.json"),
        std::string("link.cam.json"), std::string("folder.cam.json")}) {
    EXPECT_EQ(studio.read(name).status, 403u) << name;
    EXPECT_EQ(studio.put(name, "*", "[]").status, 403u) << name;
  }
  for (const char* name : {"link.cam.json", "folder.cam.json"})
    EXPECT_EQ(studio.put(name, "new", "[]").status, 403u) << name;
  EXPECT_EQ(content_of(secret), "{}");
  EXPECT_EQ(studio.ask("DELETE", "/api/files/desk.json").status, 405u);
  EXPECT_EQ(studio.ask("POST", "/api/files/desk.json", {}, "{}").status, 405u);
  EXPECT_EQ(content_of(studio.desk.project), kProject);
}

TEST(StudioProjectFiles, AreJsonOrStayAsTheyWere) {
  Studio studio;
  const std::string etag = studio.read("desk.json").etag;
  for (const std::string text : {"", "{", "{} x", "nothing", R"({"a":1,"a":2})", "\xff"}) {
    const StudioAnswer answer = studio.put("desk.json", etag, text);
    EXPECT_EQ(answer.status, 422u) << text;
    EXPECT_EQ(code_of(answer), "bad_request");
  }
  EXPECT_EQ(content_of(studio.desk.project), kProject);
}

TEST(StudioProjectFiles, CannotBeWrittenWhereTheFolderIsLocked) {
  if (::geteuid() == 0) {
    // Nothing is locked for root, but what is no folder.
    Studio studio;
    std::filesystem::remove_all(studio.desk.at("cams"));
    studio.desk.folder.write("cams", "");
    EXPECT_EQ(studio.put("cams/feeder.cam.json", "new", "{}").status, 404u);
    return;
  }
  Studio studio;
  ASSERT_EQ(::chmod(studio.desk.folder.path().c_str(), 0500), 0);
  EXPECT_EQ(studio.put("desk.json", "*", "{}").status, 409u);
  ASSERT_EQ(::chmod(studio.desk.folder.path().c_str(), 0700), 0);
}

TEST(StudioProjectFiles, AreOnlyReadWhereNothingIsWritten) {
  Studio studio;
  studio.allow("this studio only reads, as --read-only says");
  const StudioAnswer read = studio.read("desk.json");
  EXPECT_EQ(read.status, 200u);
  const StudioAnswer put = studio.put("desk.json", read.etag, "{}");
  EXPECT_EQ(put.status, 403u);
  EXPECT_NE(put.body.find("--read-only"), std::string::npos);
  EXPECT_EQ(content_of(studio.desk.project), kProject);
}

TEST(StudioProjectFiles, AreNotThereBesideAMachine) {
  test::StudioMachine machine(Simulation::from_text(R"({ "lockstep": 1, "name": "machine",
      "clock": { "servo_cycle": "1ms" }, "programs": [] })"));
  machine.empower();
  EXPECT_EQ(machine.ask("GET", "/api/files/project.json").status, 403u);
  EXPECT_EQ(machine.ask("PUT", "/api/files/project.json", {}, "{}").status, 403u);
}

}  // namespace
}  // namespace lockstep::studio_project_files_test
