// lockstep studio as somebody starts it at the desk, and a studio beside a run: what is told, and who is
// heard.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "tests/hmi_bridge/studio_client.hpp"
#include "tests/scenarios/cycle_thread.hpp"
#include "tests/scenarios/lockstep_process.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::test::studio_command_test {
namespace {

using Json = nlohmann::json;

const std::string kKnife = example("02_rotary_knife");
const std::string kToken = "0123456789abcdef0123456789abcdef";

/// Has a port of this machine, whoever listens at it.
class TakenPort {
 public:
  explicit TakenPort(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    // Where another program has it already, it is taken as well.
    if (::bind(socket_, reinterpret_cast<sockaddr*>(&address), size) == 0) ::listen(socket_, 1);
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = port != 0 ? port : ntohs(address.sin_port);
  }
  ~TakenPort() { ::close(socket_); }
  TakenPort(const TakenPort&) = delete;
  TakenPort& operator=(const TakenPort&) = delete;
  std::uint16_t port() const { return port_; }

 private:
  int socket_;
  std::uint16_t port_ = 0;
};

/// A studio that runs, and what its one line tells.
class Studio : public Process {
 public:
  explicit Studio(std::vector<std::string> options) : Process(lockstep_command(command(std::move(options)))) {
    const std::string mark = "studio on http://";
    if (!wait_until([this] { return err().ends_with('\n') || !running(); }) || !running()) {
      ADD_FAILURE() << "did not start; it wrote:\n" << err();
      return;
    }
    line = err();
    const std::size_t at = line.find("127.0.0.1:");
    if (!line.starts_with(mark) || at == std::string::npos) return;
    port = static_cast<std::uint16_t>(std::atoi(line.c_str() + at + std::string("127.0.0.1:").size()));
    const std::string_view key = "/#token=";
    if (const std::size_t begin = line.find(key); begin != std::string::npos)
      token = line.substr(begin + key.size(), line.size() - begin - key.size() - 1);
  }
  std::string known() const { return "Authorization: Bearer " + token + "\r\n"; }
  void end() {
    send(SIGTERM);
    EXPECT_EQ(status(), 0) << err();
    EXPECT_EQ(err(), line) << "nothing else is said";
  }

  std::string line;
  std::uint16_t port = 0;
  std::string token;

 private:
  static std::vector<std::string> command(std::vector<std::string> options) {
    options.insert(options.begin(), "studio");
    return options;
  }
};

std::string token_file(const Directory& directory) {
  std::string file = directory.write("token", kToken + "\n");
  ::chmod(file.c_str(), S_IRUSR | S_IWUSR);
  return file;
}

TEST(StudioAtTheDesk, HasATokenForEachStartWithoutWhichItShowsThePageAlone) {
  std::string tokens[2];
  for (std::string& token : tokens) {
    Studio studio({kKnife, "--listen", "127.0.0.1:0"});
    ASSERT_NE(studio.port, 0) << studio.err();
    EXPECT_EQ(studio.line,
              "studio on http://127.0.0.1:" + std::to_string(studio.port) + "/#token=" + studio.token + "\n");
    ASSERT_EQ(studio.token.size(), 64u) << "256 bits";
    EXPECT_EQ(studio.token.find_first_not_of("0123456789abcdef"), std::string::npos);
    token = studio.token;
    StudioConnection client(studio.port);
    EXPECT_EQ(client.get("/").status, 200);
    for (const std::string closed : {"/api", "/api/project", "/api/traces", "/api/describe", "/api/cams"})
      EXPECT_EQ(client.get(closed).status, 401) << closed;
    EXPECT_EQ(client.get("/api", "Authorization: Bearer " + std::string(64, '0') + "\r\n").status, 401);
    EXPECT_EQ(StudioConnection(studio.port).get("/api?token=" + token).status, 400) << "never in an address";
    const HttpAnswer about = StudioConnection(studio.port).get("/api", studio.known());
    EXPECT_EQ(about.status, 200);
    EXPECT_EQ(Json::parse(about.body)["mode"], "desk");
    studio.end();
  }
  EXPECT_NE(tokens[0], tokens[1]);
}

TEST(StudioAtTheDesk, TakesTheNextPortThatIsFree) {
  const TakenPort usual(8780);
  Studio studio({kKnife});
  EXPECT_GT(studio.port, 8780) << studio.line;
  EXPECT_LE(studio.port, 8799) << studio.line;
  EXPECT_EQ(StudioConnection(studio.port).get("/api", studio.known()).status, 200);
  studio.end();
}

TEST(StudioAtTheDesk, TakesNoOtherPortThanTheOneThatWasAskedFor) {
  const TakenPort taken(0);
  const std::string endpoint = "127.0.0.1:" + std::to_string(taken.port());
  const Ended ended = lockstep({"studio", kKnife, "--listen", endpoint});
  EXPECT_EQ(ended.status, 2);
  EXPECT_NE(ended.err.find(endpoint), std::string::npos) << ended.err;
}

TEST(StudioAtTheDesk, TellsAProjectOnceAndThenThatItIsAsBefore) {
  Studio studio({kKnife, "--listen", "127.0.0.1:0"});
  StudioConnection client(studio.port);
  const HttpAnswer project = client.get("/api/project", studio.known());
  EXPECT_EQ(project.status, 200);
  EXPECT_EQ(Json::parse(project.body)["objects"][1]["name"], "Knife");
  const std::string etag = project.header("ETag");
  ASSERT_GT(etag.size(), 2u);
  const HttpAnswer again = client.get("/api/project", studio.known() + "If-None-Match: " + etag + "\r\n");
  EXPECT_EQ(again.status, 304);
  EXPECT_EQ(again.body, "");
  EXPECT_EQ(client.get("/api/project", studio.known() + "If-None-Match: \"other\"\r\n").status, 200);
  studio.end();
}

TEST(StudioAtTheDesk, DescribesAsTheCommandLineDoes) {
  Studio studio({kKnife, "--listen", "127.0.0.1:0"});
  StudioConnection client(studio.port);
  const auto same = [&](const std::string& path, std::vector<std::string> words) {
    words.insert(words.begin(), "describe");
    words.emplace_back("--json");
    const HttpAnswer told = client.get("/api/describe" + path, studio.known());
    EXPECT_EQ(told.status, 200) << path;
    EXPECT_EQ(Json::parse(told.body), Json::parse(lockstep(words).out)) << path;
  };
  same("/MC_GearInPos", {"MC_GearInPos"});
  same("/override/MC_Halt", {"override", "MC_Halt"});
  same("", {});
  const HttpAnswer none = client.get("/api/describe/MC_Nothing", studio.known());
  EXPECT_EQ(none.status, 404);
  EXPECT_EQ(Json::parse(none.body)["error"]["code"], "not_found");
  studio.end();
}

TEST(StudioAtTheDesk, ShowsCamsAndTracesWithoutAProject) {
  const Directory directory;
  const std::string trace = directory.file("knife.csv");
  ASSERT_EQ(lockstep({"run", kKnife, "--simulate", "--duration", "100ms", "--trace", trace}).status, 0);
  const std::string cam = LOCKSTEP_SOURCE_DIR "/projects/cams/feeder.cam.json";
  Studio studio({cam, trace, "--listen", "127.0.0.1:0"});
  ASSERT_NE(studio.port, 0);
  StudioConnection client(studio.port);
  EXPECT_EQ(Json::parse(client.get("/api", studio.known()).body)["mode"], "files");
  EXPECT_EQ(client.get("/api/project", studio.known()).status, 404) << "there is none";
  EXPECT_NE(client.get("/api/cams", studio.known()).body.find("feeder.cam.json"), std::string::npos);
  EXPECT_EQ(client.get("/api/cams/feeder.cam.json?curves=11", studio.known()).status, 200);
  EXPECT_TRUE(wait_until([&] {
    const Json traces = Json::parse(client.get("/api/traces", studio.known()).body)["traces"];
    return std::any_of(traces.begin(), traces.end(), [](const Json& told) {
      return told.value("name", "") == "knife.csv" && told.value("rows", 0) > 20;
    });
  })) << client.get("/api/traces", studio.known()).body;
  studio.end();
}

TEST(StudioAtTheDesk, IsNotStartedWithWhatIsNotThere) {
  const Ended gone = lockstep({"studio", "/nowhere/none.cam.json", "--listen", "127.0.0.1:0"});
  EXPECT_EQ(gone.status, 2);
  EXPECT_NE(gone.err.find("none.cam.json"), std::string::npos) << gone.err;
  const Ended two = lockstep({"studio", kKnife, example("03_line_shaft"), "--listen", "127.0.0.1:0"});
  EXPECT_EQ(two.status, 2);
  EXPECT_NE(two.err.find("one project is allowed"), std::string::npos) << two.err;
  const Directory directory;
  const std::string bad = directory.write("project.json", "{ \"lockstep\": 1 }");
  EXPECT_EQ(lockstep({"studio", bad, "--listen", "127.0.0.1:0"}).status, 1) << "as of run";
}

TEST(StudioAtTheDesk, AsksForATokenFileBeyondThisMachine) {
  const Ended open = lockstep({"studio", "--listen", "0.0.0.0:0"});
  EXPECT_EQ(open.status, 2);
  EXPECT_NE(open.err.find("--token-file"), std::string::npos) << open.err;
  const Directory directory;
  const std::string file = token_file(directory);
  ::chmod(file.c_str(), S_IRUSR | S_IWUSR | S_IRGRP);
  const Ended readable = lockstep({"studio", "--listen", "127.0.0.1:0", "--token-file", file});
  EXPECT_EQ(readable.status, 2);
  EXPECT_NE(readable.err.find("chmod 600"), std::string::npos) << readable.err;
}

TEST(StudioAtTheDesk, HasTheTokenOfItsFileAndDoesNotTellIt) {
  const Directory directory;
  Studio studio({kKnife, "--listen", "127.0.0.1:0", "--token-file", token_file(directory)});
  EXPECT_EQ(studio.line, "studio on http://127.0.0.1:" + std::to_string(studio.port) + "/\n");
  StudioConnection client(studio.port);
  EXPECT_EQ(client.get("/api").status, 401);
  EXPECT_EQ(client.get("/api", "Authorization: Bearer " + kToken + "\r\n").status, 200);
  studio.end();
}

TEST(StudioAtTheDesk, HearsFurtherNamesAndThoseWhoMayCome) {
  Studio studio({kKnife, "--listen", "127.0.0.1:0", "--host", "machine.example", "--host", "desk.example",
                 "--allow", "192.0.2.0/24", "--allow", "127.0.0.0/8"});
  const auto asked_as = [&](const std::string& host) {
    StudioConnection client(studio.port);
    client.send("GET /api HTTP/1.1\r\nHost: " + host + "\r\n" + studio.known() + "\r\n");
    return client.answer().status;
  };
  EXPECT_EQ(asked_as("machine.example"), 200);
  EXPECT_EQ(asked_as("desk.example"), 200);
  EXPECT_EQ(asked_as("other.example"), 403);
  studio.end();
  Studio elsewhere({kKnife, "--listen", "127.0.0.1:0", "--allow", "192.0.2.0/24"});
  EXPECT_EQ(StudioConnection(elsewhere.port).get("/api", elsewhere.known()).status, 0) << "none is heard";
  elsewhere.end();
  const Ended wrong = lockstep({"studio", kKnife, "--listen", "127.0.0.1:0", "--allow", "nonsense"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("--allow"), std::string::npos) << wrong.err;
}

TEST(StudioAtTheDesk, OnlyLooksWhereItIsToldTo) {
  const std::string write = R"({"writes":[{"path":"speed","value":150}]})";
  for (const bool reads_only : {false, true}) {
    std::vector<std::string> options = {kKnife, "--listen", "127.0.0.1:0"};
    if (reads_only) options.emplace_back("--read-only");
    Studio studio(options);
    StudioConnection client(studio.port);
    const int refused = reads_only ? 403 : 200;
    EXPECT_EQ(client.post("/api/write", write, studio.known()).status, refused);
    EXPECT_EQ(client.post("/api/simulation", R"({"action":"pause"})", studio.known()).status, refused);
    const Json rights = Json::parse(client.get("/api", studio.known()).body)["rights"];
    EXPECT_EQ(rights["write"], !reads_only);
    EXPECT_EQ(rights["files"], !reads_only);
    studio.end();
  }
}

TEST(StudioAtTheDesk, WritesATraceAsOnePageAndEnds) {
  const Directory directory;
  const std::string trace = directory.file("knife.csv");
  const std::string page = directory.file("knife.html");
  ASSERT_EQ(lockstep({"run", kKnife, "--simulate", "--duration", "100ms", "--trace", trace}).status, 0);
  const Ended ended = lockstep({"studio", trace, "--export", page});
  EXPECT_EQ(ended.status, 0) << ended.err;
  const std::string written = content(page);
  EXPECT_TRUE(written.starts_with("<!doctype html>") || written.starts_with("<!DOCTYPE html>"));
  EXPECT_NE(written.find("Knife.Position"), std::string::npos);
  const std::vector<std::vector<std::string>> wrong = {{"studio", kKnife, "--export", page},
                                                       {"studio", "--export", page},
                                                       {"studio", trace, "--export", "/nowhere/page.html"}};
  for (const std::vector<std::string>& command : wrong) {
    const Ended refused = lockstep(command);
    EXPECT_EQ(refused.status, 2) << command.back();
    EXPECT_NE(refused.err.find("--export"), std::string::npos) << refused.err;
  }
}

std::uint16_t port_of_studio(RunningLockstep& run) {
  const std::string mark = "studio on http://127.0.0.1:";
  std::size_t at = std::string::npos;
  const bool is_told = wait_until([&] {
    return (at = run.err().find(mark)) != std::string::npos &&
           run.err().find('/', at + mark.size()) != std::string::npos;
  });
  return is_told ? static_cast<std::uint16_t>(std::atoi(run.err().c_str() + at + mark.size()))
                 : std::uint16_t{0};
}

TEST(StudioBesideARun, TellsHowTheCycleHasGone) {
  RunningLockstep run(kKnife, {"--studio", "127.0.0.1:0"});
  const std::uint16_t port = port_of_studio(run);
  ASSERT_NE(port, 0) << run.err();
  StudioConnection page(port);
  ASSERT_EQ(page.upgrade(), 101);
  page.say(R"({"type":"hello"})");
  page.say(R"({"type":"subscribe","id":1,"paths":["Knife.Position","speed"]})");
  std::vector<Json> told;
  while (told.size() < 3) {
    // One that comes before the first tick has no cycle to tell of.
    const std::string status = page.hear_text(R"("cycle":{)");
    ASSERT_NE(status, "") << "nothing comes any more";
    told.push_back(Json::parse(status));
  }
  for (const Json& status : told) {
    for (const char* const field : {"dropped", "bytes", "signals", "pages", "events_lost"})
      EXPECT_TRUE(status.at(field).is_number_unsigned()) << field << " of " << status;
    const Json& cycle = status.at("cycle");
    for (const char* const field : {"ticks", "overruns", "missed_ticks"})
      EXPECT_TRUE(cycle.at(field).is_number_unsigned()) << field << " of " << status;
    EXPECT_GE(cycle.at("worst_lateness_us").get<double>(), 0.0);
    EXPECT_GT(cycle.at("longest_tick_us").get<double>(), 0.0) << "each tick takes time";
  }
  EXPECT_GT(told.back().at("tap").at("tick_us").get<double>(), 0.0) << told.back();
  EXPECT_LE(told.back()["tap"]["tick_us"], told.back()["cycle"]["longest_tick_us"]) << "a mean";
  EXPECT_EQ(told.back()["pages"], 1);
  EXPECT_EQ(told.back()["signals"], 2);
  EXPECT_GT(told[2]["cycle"]["ticks"], told[1]["cycle"]["ticks"]);
  EXPECT_GE(told[2]["cycle"]["longest_tick_us"], told[1]["cycle"]["longest_tick_us"]);
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 0) << run.err();
}

TEST(StudioBesideARun, HasNoThreadOnTheProcessorOfTheCycle) {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  ASSERT_EQ(::sched_getaffinity(0, sizeof allowed, &allowed), 0);
  int processor = 0;
  while (!CPU_ISSET(processor, &allowed)) ++processor;
  if (CPU_COUNT(&allowed) < 2) {
    const Ended refused = lockstep({"run", kKnife, "--no-modbus", "--no-lcm", "--no-retain", "--cpu",
                                    std::to_string(processor), "--duration", "10ms"});
    EXPECT_EQ(refused.status, 2) << "there is no other processor";
    return;
  }
  RunningLockstep run(kKnife, {"--studio", "127.0.0.1:0", "--cpu", std::to_string(processor)});
  const std::uint16_t port = port_of_studio(run);
  ASSERT_NE(port, 0) << run.err();
  // With a page that looks, every thread of the studio is there.
  StudioConnection page(port);
  ASSERT_EQ(page.upgrade(), 101);
  page.say(R"({"type":"hello"})");
  ASSERT_NE(page.hear_text(R"("type":"hello")"), "");
  ASSERT_NE(thread_named(run.pid(), "cycle"), 0);
  int others = 0;
  bool has_studio = false;
  for (const auto& task :
       std::filesystem::directory_iterator("/proc/" + std::to_string(run.pid()) + "/task")) {
    std::string name = content(task.path() / "comm");
    name = name.substr(0, name.find('\n'));
    cpu_set_t places;
    CPU_ZERO(&places);
    ASSERT_EQ(::sched_getaffinity(std::atoi(task.path().filename().c_str()), sizeof places, &places), 0);
    has_studio = has_studio || name == "studio";
    if (name == "cycle") {
      EXPECT_EQ(CPU_COUNT(&places), 1);
      EXPECT_TRUE(CPU_ISSET(processor, &places));
    } else {
      ++others;
      EXPECT_FALSE(CPU_ISSET(processor, &places)) << name;
    }
  }
  EXPECT_TRUE(has_studio);
  EXPECT_GE(others, 3) << "the program itself, the recorder, Modbus, the studio";
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 0) << run.err();
}

/// `./dev demo` in a copy of its own, with a program in place of lockstep that keeps what it is called with.
TEST(StudioOfTheDemonstration, IsToldWithTheAddressAtWhichTheRunServesIt) {
  const Directory directory;
  namespace fs = std::filesystem;
  fs::copy_file(LOCKSTEP_SOURCE_DIR "/dev", directory.file("dev"));
  fs::create_directories(directory.file("build/release"));
  fs::create_directory(directory.file("bin"));
  const auto script = [&](const std::string& name, const std::string& text) {
    const std::string file = directory.write(name, "#!/bin/sh\n" + text);
    ::chmod(file.c_str(), S_IRWXU);
  };
  script("build/release/lockstep", "echo \"$*\" >>'" + directory.file("calls") + "'\n");
  script("bin/cmake", "exit 0\n");
  script("bin/dpkg-query", "echo installed\n");
  const TakenPort usual(8780);
  Process demo({"env", "PATH=" + directory.file("bin") + ":" + std::getenv("PATH"), "bash",
                directory.file("dev"), "demo"});
  ASSERT_EQ(demo.status(), 0) << demo.err();
  const std::string calls = content(directory.file("calls"));
  const std::string option = " --studio ";
  ASSERT_TRUE(calls.starts_with("run ")) << calls;
  const std::size_t at = calls.find(option);
  ASSERT_NE(at, std::string::npos) << calls;
  const std::size_t begin = at + option.size();
  const std::string endpoint = calls.substr(begin, calls.find_first_of(" \n", begin) - begin);
  EXPECT_TRUE(endpoint.starts_with("127.0.0.1:")) << endpoint;
  EXPECT_NE(endpoint, "127.0.0.1:8780") << "which is taken";
  EXPECT_NE((demo.out() + demo.err()).find("http://" + endpoint + "/"), std::string::npos) << demo.err();
}

}  // namespace
}  // namespace lockstep::test::studio_command_test
