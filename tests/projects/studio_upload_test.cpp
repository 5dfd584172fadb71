// Files that pages send to the studio: what is taken, under which name, and what becomes of the rest.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "hmi_bridge/lcm/log.hpp"
#include "hmi_bridge/studio/server.hpp"
#include "tests/projects/studio_files.hpp"
#include "tests/support/values.hpp"

namespace lockstep::studio_upload_test {
namespace {

using Json = nlohmann::json;
using test::StudioConnection;
using test::StudioFolder;
using test::StudioOfFiles;

const std::string kTrace = "t,v\n0,1\n1,2.5\n2,-3\n";

std::size_t files_in(const StudioFolder& folder) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    count += entry.exists() ? 1 : 0;
  return count;
}

/// Waits until nothing is left in a folder.
bool is_emptied(const StudioFolder& folder) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  while (files_in(folder) != 0) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

class Studio : public StudioOfFiles {
 public:
  using StudioOfFiles::StudioOfFiles;

  /// As the server does it: the body lies in a file of its own.
  StudioAnswer send(const std::string& name, const std::string& content = kTrace) {
    StudioRequest request;
    request.method = "POST";
    request.path = "/api/traces";
    if (!name.empty()) request.query.emplace_back("name", name);
    request.body_file = folder.write("sent-" + std::to_string(++number_), content);
    StudioAnswer answer;
    answer.status = 0;
    session.answer(request, [&answer](StudioAnswer given) { answer = std::move(given); });
    return answer;
  }

  StudioAnswer by_path(const std::string& path) {
    return ask("POST", "/api/traces", {}, Json{{"path", path}}.dump());
  }

  StudioFolder folder;

 private:
  int number_ = 0;
};

TEST(StudioUpload, IsReadAndRemoved) {
  Studio studio;
  const StudioAnswer answer = studio.send("run 7.csv");
  EXPECT_EQ(answer.status, 202u);
  EXPECT_EQ(Json::parse(answer.body).at("id"), "file-1");
  const Json trace = studio.settled("file-1");
  EXPECT_EQ(trace.at("state"), "ready");
  EXPECT_EQ(trace.at("kind"), "file");
  EXPECT_EQ(trace.at("name"), "run 7.csv");
  EXPECT_EQ(trace.at("rows"), 3);
  EXPECT_EQ(trace.at("to"), "2000000000");
  EXPECT_TRUE(is_emptied(studio.folder));
  const Json seen = studio.get("/api/traces/file-1/statistics", {{"signals", "v"}});
  EXPECT_EQ(seen.at(0).at("minimum"), -3.0);
  EXPECT_EQ(seen.at(0).at("t_minimum"), "2000000000");
  EXPECT_EQ(studio.ask("DELETE", "/api/traces/file-1").status, 200u);
  EXPECT_TRUE(studio.told("file-1").is_null());
  EXPECT_EQ(studio.ask("DELETE", "/api/traces/file-1").status, 404u);
  EXPECT_EQ(studio.ask("DELETE", "/api/traces/live").status, 404u);
}

TEST(StudioUpload, IsCalledByItsNameAloneAndTouchesNothingElse) {
  Studio studio;
  const StudioFolder other;
  const std::string kept = other.write("kept.csv", "t,kept\n0,1\n");
  EXPECT_EQ(studio.send("../../../../etc/passwd.csv").status, 202u);
  EXPECT_EQ(studio.send(kept).status, 202u);
  EXPECT_EQ(studio.send("<script>alert(1)</script>.csv").status, 202u);
  EXPECT_EQ(studio.send("\xff\xfe\n\"\\.csv").status, 202u);
  EXPECT_EQ(studio.settled("file-1").at("name"), "passwd.csv");
  EXPECT_EQ(studio.settled("file-2").at("name"), "kept.csv");
  EXPECT_EQ(studio.settled("file-2").at("signals").at(0).at("path"), "v") << "of what was sent";
  EXPECT_EQ(studio.settled("file-3").at("name"), "script>.csv");
  EXPECT_EQ(studio.settled("file-4").at("state"), "ready");
  EXPECT_TRUE(std::filesystem::exists(kept));
  EXPECT_TRUE(is_emptied(studio.folder));
}

TEST(StudioUpload, ThatIsNoTraceIsRefusedAndLeavesNoFile) {
  Studio studio;
  for (const std::string name :
       {"passwd", "a.csv/", "..", ".csv.", "a.CSV.txt", "project.json", "/", "a.csv\n", "a.csv "}) {
    const StudioAnswer answer = studio.send(name);
    EXPECT_EQ(answer.status, 422u) << name;
    EXPECT_NE(answer.body.find(".csv or .lcm"), std::string::npos) << answer.body;
    EXPECT_EQ(files_in(studio.folder), 0u) << name;
  }
  EXPECT_EQ(studio.send(std::string(5000, 'a') + ".csv").status, 422u);
  EXPECT_EQ(files_in(studio.folder), 0u);
  EXPECT_EQ(studio.get("/api/traces").at("traces").size(), 1u) << "the live one";
}

TEST(StudioUpload, ThatCannotBeReadTellsWhyByItsOwnName) {
  Studio studio;
  const std::vector<std::pair<std::string, std::string>> bad = {{"words.csv", "t,v\n0,one\n"},
                                                                {"short.csv", "t,v,w\n0,1\n"},
                                                                {"back.csv", "t,v\n1,1\n0,1\n"},
                                                                {"far.csv", "t,v\n0,1\n1e300,1\n"},
                                                                {"never.csv", "t,v\nnan,1\n"},
                                                                {"noise.lcm", "this is no event log"},
                                                                {"binary.csv", std::string("\0\1\2\3", 4)}};
  for (const auto& [name, content] : bad) {
    const StudioAnswer answer = studio.send(name, content);
    ASSERT_EQ(answer.status, 202u) << answer.body;
    const std::string id = Json::parse(answer.body).at("id");
    const Json trace = studio.settled(id);
    EXPECT_EQ(trace.at("state"), "failed") << name;
    ASSERT_TRUE(trace.contains("error")) << name;
    const std::string message = trace.at("error").at("message");
    EXPECT_NE(message.find(name), std::string::npos) << message;
    EXPECT_EQ(message.find(studio.folder.path().string()), std::string::npos) << message;
    EXPECT_EQ(studio.ask("GET", "/api/traces/" + id + "/window", {{"signals", "v"}}).status, 422u);
    EXPECT_EQ(studio.ask("GET", "/api/traces/" + id + "/xy", {{"x", "v"}, {"y", "v"}}).status, 422u);
  }
  for (const char* const name : {"empty.csv", "empty.lcm"}) {
    const StudioAnswer answer = studio.send(name, "");
    EXPECT_EQ(answer.status, 422u) << answer.body;
    EXPECT_NE(answer.body.find("the body is empty"), std::string::npos) << answer.body;
  }
  EXPECT_TRUE(is_emptied(studio.folder));
}

TEST(StudioUpload, IsTakenAsLongAsThereAreNotTooMany) {
  Studio studio;
  for (std::size_t i = 0; i < StudioTraceFiles::kFiles; ++i)
    ASSERT_EQ(studio.send("a.csv").status, 202u) << i;
  EXPECT_EQ(studio.settled("file-" + std::to_string(StudioTraceFiles::kFiles)).at("state"), "ready");
  EXPECT_TRUE(is_emptied(studio.folder));
  const StudioAnswer answer = studio.send("a.csv");
  EXPECT_EQ(answer.status, 422u);
  EXPECT_EQ(Json::parse(answer.body).at("error").at("code"), "too_many");
  EXPECT_EQ(files_in(studio.folder), 0u);
  EXPECT_EQ(studio.ask("DELETE", "/api/traces/file-3").status, 200u);
  EXPECT_EQ(studio.send("a.csv").status, 202u);
  EXPECT_EQ(studio.settled("file-33").at("state"), "ready") << "numbers are not given twice";
}

TEST(StudioUpload, IsNotTakenBesideAMachine) {
  test::StudioMachine machine(Simulation::from_text(R"({ "lockstep": 1, "name": "machine",
      "clock": { "servo_cycle": "2ms" }, "technology_objects": {}, "programs": [] })"));
  const StudioFolder folder;
  StudioRequest request;
  request.method = "POST";
  request.path = "/api/traces";
  request.body_file = folder.write("sent", kTrace);
  StudioAnswer answer;
  machine.session.answer(request, [&answer](StudioAnswer given) { answer = std::move(given); });
  EXPECT_EQ(answer.status, 403u);
  EXPECT_EQ(files_in(folder), 0u);
  const StudioAnswer named = machine.ask("POST", "/api/traces", {}, R"({"path":"/etc/passwd.csv"})");
  EXPECT_EQ(named.status, 403u);
}

TEST(StudioUpload, OfAPathNeedsOne) {
  Studio studio;
  for (const std::string body : {"", "{}", "[]", "7", R"({"path":7})"})
    EXPECT_EQ(studio.ask("POST", "/api/traces", {}, body).status, 422u) << body;
  EXPECT_EQ(studio.by_path(studio.folder.path() / "no.csv").status, 404u);
  studio.folder.write("mine.txt", kTrace);
  EXPECT_EQ(studio.by_path(studio.folder.path() / "mine.txt").status, 422u);
  // A file of the desk stays where it is.
  const std::string mine = studio.folder.write("mine.csv", kTrace);
  studio.open(mine);
  EXPECT_TRUE(std::filesystem::exists(mine));
}

// Whoever may use the studio reads by it no more than what lies where it was started.
TEST(StudioUpload, OfAPathStaysInTheFolderOfTheStudio) {
  Studio studio;
  const StudioFolder elsewhere;
  const auto here = [&studio](const char* name) { return studio.folder.path() / name; };
  const std::string secret = elsewhere.write("secret.csv", kTrace);
  studio.folder.write("mine.csv", kTrace);
  std::filesystem::create_directory(here("inner"));
  std::filesystem::create_directory(here("folder.csv"));
  std::filesystem::create_symlink(secret, here("link.csv"));
  std::filesystem::create_symlink(elsewhere.path(), here("linked"));
  ASSERT_EQ(::mkfifo(here("pipe.csv").c_str(), 0600), 0);
  StudioPowers powers;
  powers.why_no_files = "";
  powers.files = &studio.files;
  powers.trace_folder = studio.folder.path().string();
  studio.session.empower(powers);
  const std::vector<std::string> outside = {
      "",
      ".",
      "..",
      "../x.csv",
      "inner/../../x.csv",
      "inner/../mine.csv",
      secret,
      "/etc/passwd",
      studio.folder.path().string() + "/../" + elsewhere.path().filename().string() + "/secret.csv",
      "link.csv",
      "linked/secret.csv",
      "folder.csv",
      "pipe.csv",
      std::string("a\0.csv", 6),
      "a\n.csv",
      std::string(2000, 'a') + ".csv"};
  for (const std::string& path : outside) {
    const StudioAnswer answer = studio.by_path(path);
    EXPECT_EQ(answer.status, 403u) << path << answer.body;
    EXPECT_EQ(Json::parse(answer.body).at("error").at("code"), "not_allowed") << path;
  }
  EXPECT_TRUE(studio.files.all().empty());
  EXPECT_EQ(studio.by_path("inner/none.csv").status, 404u);
  EXPECT_EQ(studio.by_path("mine.csv").status, 202u);
  EXPECT_EQ(studio.by_path("./inner/./../mine.csv").status, 403u);
  EXPECT_EQ(studio.by_path(here("mine.csv")).status, 202u) << "by its whole path, too";
  // One that has no folder reads no path.
  powers.trace_folder = "";
  studio.session.empower(powers);
  EXPECT_EQ(studio.by_path("mine.csv").status, 403u);
}

TEST(StudioUpload, OfALogHasItsEventsAndJobs) {
  Studio studio;
  const std::string path = (studio.folder.path() / "run.lcm").string();
  const std::vector<TraceSignal> signals = {{"v", Type::LREAL, ""}};
  LcmLog log(path, {"files", "TRACE", 1'000'000, 0});
  log.begin(signals);
  TraceEvent event;
  event.source = "gear";
  event.type = "MC_GearIn";
  for (std::int64_t t = 0; t < 10; ++t) {
    event.t = t * 1'000'000;
    event.kind = t == 2 ? EventKind::job_started : EventKind::job_done;
    if (t == 2 || t == 7) log.event(event);
    log.row({event.t, static_cast<std::uint64_t>(t), 0, std::vector<Value>{test::real(1.0)}});
  }
  log.end();
  std::ifstream file(path, std::ios::binary);
  EXPECT_EQ(studio.send("run.lcm", {std::istreambuf_iterator<char>(file), {}}).status, 202u);
  EXPECT_EQ(studio.settled("file-1").at("rows"), 10);
  const Json told = studio.get("/api/traces/file-1/events");
  ASSERT_EQ(told.at("events").size(), 2u) << told;
  EXPECT_EQ(told.at("events").at(1).at("kind"), "job done");
  ASSERT_EQ(told.at("jobs").size(), 1u) << told;
  EXPECT_EQ(told.at("jobs").at(0).at("instance"), "gear");
  EXPECT_EQ(told.at("jobs").at(0).at("begin"), "2000000");
  EXPECT_EQ(told.at("jobs").at(0).at("end"), "7000000");
  EXPECT_EQ(studio.get("/api/events").at("events").size(), 0u) << "the run has had none";
}

/// A log of traces of v, each on a channel of its own, with as many rows as its name has letters.
std::string log_of(const StudioFolder& folder, const std::vector<std::string>& channels) {
  const std::string path = (folder.path() / "channels.lcm").string();
  const std::vector<TraceSignal> signals = {{"v", Type::LREAL, ""}};
  LcmLog log(path, {"files", "TRACE", 1'000'000, 0});
  log.begin(signals);
  log.row({0, 0, 0, std::vector<Value>{test::real(0.0)}});
  for (const std::string& channel : channels) {
    const auto sink = log.add_channel({"files", channel, 1'000'000, 0});
    sink->begin(signals);
    for (std::uint64_t row = 0; row < channel.size(); ++row)
      sink->row({static_cast<std::int64_t>(row) * 1'000'000, row, 0,
                 std::vector<Value>{test::real(static_cast<double>(row) + 0.5)}});
    sink->end();
  }
  log.end();
  return path;
}

/// Has a log read, and waits until the last of its traces is there.
void read_log(Studio& studio, const std::string& path, const std::string& last) {
  ASSERT_NE(studio.files.add(path, "channels.lcm", false), nullptr);
  EXPECT_EQ(studio.settled("file-1").at("rows"), 1);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  while (studio.told(last).is_null() && std::chrono::steady_clock::now() < deadline) {
    studio.session.look();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST(StudioUpload, OfALogHasATraceForEachOfItsChannels) {
  Studio studio;
  read_log(studio, log_of(studio.folder, {"SECOND", "OTHER"}), "file-3");
  const Json other = studio.told("file-2");
  EXPECT_EQ(other.value("name", ""), "channels.lcm, OTHER") << "by name";
  EXPECT_EQ(other.value("state", ""), "ready");
  EXPECT_EQ(other.value("of", ""), "file-1");
  EXPECT_FALSE(studio.told("file-1").contains("of"));
  EXPECT_EQ(other.value("rows", 0), 5);
  EXPECT_EQ(studio.told("file-3").value("name", ""), "channels.lcm, SECOND");
  EXPECT_EQ(studio.told("file-3").value("rows", 0), 6);
  const Json statistics = studio.get("/api/traces/file-3/statistics", {{"signals", "v"}});
  EXPECT_EQ(statistics.at(0).at("maximum"), 5.5);
  studio.session.look();
  EXPECT_TRUE(studio.told("file-4").is_null()) << "there is no further one";
}

TEST(StudioUpload, OfALogOfManyChannelsSaysWhatIsLeftOut) {
  Studio studio;
  std::vector<std::string> channels;
  for (int i = 0; i < 40; ++i) channels.push_back("C" + std::to_string(100 + i));
  read_log(studio, log_of(studio.folder, channels), "file-32");
  for (int i = 0; i < 10; ++i) studio.session.look();
  EXPECT_EQ(studio.files.all().size(), StudioTraceFiles::kFiles);
  EXPECT_NE(studio.told("file-1").value("remark", "").find("9 further traces are left out"),
            std::string::npos)
      << studio.told("file-1");
}

/// Keeps the thread that reads files from the next one for a while.
void keep_busy(Studio& studio) {
  std::string rows = "t,a\n";
  for (int row = 0; row < 300'000; ++row) rows += "0,1\n";
  EXPECT_NE(studio.files.add(studio.folder.write("long.csv", rows), "long.csv", false), nullptr);
}

TEST(StudioUpload, OfAPathIsTheFileThatWasThereWhenItWasAskedFor) {
  Studio studio;
  const StudioFolder elsewhere;
  const std::string secret = elsewhere.write("secret.csv", "t,secret\n0,1\n");
  const std::string mine = studio.folder.write("mine.csv", kTrace);
  StudioPowers powers;
  powers.why_no_files = "";
  powers.files = &studio.files;
  powers.trace_folder = studio.folder.path().string();
  studio.session.empower(powers);
  keep_busy(studio);
  EXPECT_EQ(studio.by_path("mine.csv").status, 202u);
  std::filesystem::remove(mine);
  std::filesystem::create_symlink(secret, mine);
  const Json trace = studio.settled("file-2");
  EXPECT_EQ(trace.at("state"), "ready") << trace;
  EXPECT_EQ(trace.at("name"), "mine.csv");
  EXPECT_EQ(trace.at("signals").at(0).at("path"), "v") << "not of what a link leads to by now";
}

/// The studio behind its server; all is asked of it over the network.
class Served {
 public:
  Served() {
    StudioServerOptions options;
    options.listen = {"127.0.0.1", 0};
    options.upload_folder = folder.path().string();
    server = std::make_unique<StudioServer>(std::move(options), studio.session);
    EXPECT_EQ(server->start(), "");
  }
  std::string head(const StudioConnection& client, const std::string& target, const std::string& type,
                   std::uint64_t size) const {
    return "POST " + target + " HTTP/1.1\r\nHost: " + client.host() + "\r\nOrigin: " + client.origin() +
           "\r\nContent-Type: " + type + "\r\nContent-Length: " + std::to_string(size) + "\r\n\r\n";
  }

  StudioFolder folder;
  StudioOfFiles studio;
  std::unique_ptr<StudioServer> server;
};

TEST(StudioUpload, OverTheNetworkArrivesWholeOrNotAtAll) {
  Served served;
  const std::uint16_t port = served.server->endpoint().port;
  {
    StudioConnection broken(port);
    broken.send(served.head(broken, "/api/traces?name=broken.csv", "text/csv", 1'000'000) + kTrace);
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(120);
    while (files_in(served.folder) == 0 && std::chrono::steady_clock::now() < deadline)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(files_in(served.folder), 1u) << "as long as it comes";
  }
  EXPECT_TRUE(is_emptied(served.folder)) << "what broke off is gone";
  StudioConnection client(port);
  client.send(served.head(client, "/api/traces?name=..%2F..%2Fwhole.csv", "text/csv", kTrace.size()) +
              kTrace);
  const test::HttpAnswer taken = client.answer();
  EXPECT_EQ(taken.status, 202) << taken.body;
  const Json told = Json::parse(taken.body);
  EXPECT_EQ(told.at("id"), "file-1") << "the broken one has never been a trace";
  EXPECT_EQ(told.at("name"), "whole.csv");
  EXPECT_TRUE(is_emptied(served.folder));
}

TEST(StudioUpload, OverTheNetworkOfNothingIsRefused) {
  Served served;
  StudioConnection client(served.server->endpoint().port);
  for (int again = 0; again < 2; ++again) {
    client.send(served.head(client, "/api/traces?name=empty.csv", "text/csv", 0));
    const test::HttpAnswer answer = client.answer();
    EXPECT_EQ(answer.status, 422) << answer.body;
    EXPECT_NE(answer.body.find("empty"), std::string::npos) << answer.body;
  }
  EXPECT_TRUE(is_emptied(served.folder));
}

TEST(StudioUpload, OverTheNetworkIsRefusedWithoutAFile) {
  Served served;
  const std::uint16_t port = served.server->endpoint().port;
  const auto status = [&](const std::string& target, const std::string& type, std::uint64_t size) {
    StudioConnection client(port);
    client.send(served.head(client, target, type, size) + kTrace);
    return client.answer().status;
  };
  EXPECT_EQ(status("/api/traces?name=big.csv", "text/csv", (std::uint64_t{2} << 30) + 1), 413);
  {
    StudioConnection client(served.server->endpoint().port);
    client.send(served.head(client, "/api/traces?name=big.csv", "text/csv", std::uint64_t{5} << 30));
    EXPECT_NE(client.answer().body.find("a file may have 2 GiB"), std::string::npos);
  }
  EXPECT_EQ(status("/api/traces?name=a.txt", "text/csv", kTrace.size()), 422);
  EXPECT_EQ(status("/api/traces?name=a.csv", "text/plain", kTrace.size()), 403);
  EXPECT_EQ(status("/api/traces/live/derived", "text/csv", kTrace.size()), 403);
  EXPECT_EQ(status("/api/tracesuite", "text/csv", kTrace.size()), 403);
  EXPECT_EQ(status("/api/../api/traces", "text/csv", kTrace.size()), 403);
  EXPECT_TRUE(is_emptied(served.folder));
}

}  // namespace
}  // namespace lockstep::studio_upload_test
