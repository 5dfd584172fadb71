// What leaves the studio as a file, what it tells of the text of a project, and that refusals move nothing.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hmi_bridge/lcm/log.hpp"
#include "hmi_bridge/lcm/trace_reader.hpp"
#include "projects/studio/project_text.hpp"
#include "tests/projects/studio_files.hpp"
#include "tests/support/values.hpp"

namespace lockstep::studio_export_test {
namespace {

using Json = nlohmann::json;
using test::DecodedFrame;
using test::exact;
using test::StudioFolder;
using test::StudioMachine;
using test::StudioOfFiles;
using test::StudioPage;

const std::string kProjects = LOCKSTEP_SOURCE_DIR "/projects/";
const std::vector<double> kValues = {0.1,
                                     -0.0,
                                     std::numeric_limits<double>::denorm_min(),
                                     std::numeric_limits<double>::max(),
                                     -std::numeric_limits<double>::infinity(),
                                     1.0 / 3.0};

/// A file with those values, one row each 2 ms, and with a sum of two signals of a name that is markup.
std::string open_values(StudioOfFiles& studio, const StudioFolder& folder) {
  std::string text = "t,v,n\n";
  for (std::size_t i = 0; i < kValues.size(); ++i)
    text += exact(static_cast<double>(i) * 2e-3) + "," + exact(kValues[i]) + "," + std::to_string(i) + "\n";
  return studio.open(folder.write("values.csv", text));
}

TEST(StudioExport, AsALogHasTheRowsToTheBit) {
  StudioOfFiles studio;
  const StudioFolder folder;
  const std::string id = open_values(studio, folder);
  const std::string above = Json{{"signal", "=n > 2.5"}}.dump();
  ASSERT_EQ(studio.ask("POST", "/api/traces/" + id + "/derived", {}, above).status, 200u);
  const StudioAnswer answer = studio.ask(
      "GET", "/api/traces/" + id + "/export",
      {{"format", "lcm"}, {"signal", "=n > 2.5"}, {"signal", "v"}, {"from", "2000000"}, {"to", "9999999"}});
  ASSERT_EQ(answer.status, 200u) << answer.body;
  EXPECT_EQ(answer.type, "application/octet-stream");
  EXPECT_EQ(answer.file_name, "lockstep.lcm");
  LcmTraceReader reader(folder.write("out.lcm", answer.body));
  ASSERT_EQ(reader.signals().size(), 2u);
  EXPECT_EQ(reader.signals()[0].name, "=n > 2.5");
  EXPECT_EQ(reader.signals()[0].type, Type::BOOL);
  EXPECT_EQ(reader.signals()[1].name, "v");
  EXPECT_EQ(reader.signals()[1].type, Type::LREAL);
  for (std::size_t i = 1; i <= 4; ++i) {
    ASSERT_TRUE(reader.next()) << i;
    const TraceRow row = reader.row();
    EXPECT_EQ(row.t, static_cast<std::int64_t>(i) * 2'000'000);
    EXPECT_EQ(row.tick, i);
    EXPECT_EQ(row.values[0].u != 0, i > 2) << i;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(row.values[1].r), std::bit_cast<std::uint64_t>(kValues[i])) << i;
  }
  EXPECT_FALSE(reader.next()) << "to the time that was asked for";
  EXPECT_EQ(reader.remark(), "");
}

/// Bytes of a text of base 64, by the standard alone.
std::string from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    const std::size_t digit = digits.find(c);
    if (digit == std::string::npos) break;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes += static_cast<char>(bits >> held & 255u);
  }
  return bytes;
}

TEST(StudioExport, AsAPageHasTheRowsToTheBitAndNoMarkupOfNames) {
  StudioOfFiles studio;
  const StudioFolder folder;
  const std::string id = open_values(studio, folder);
  const std::string name = "</script><script>alert('seen')</script>";
  const StudioAnswer answer =
      studio.ask("GET", "/api/traces/" + id + "/export",
                 {{"format", "html"}, {"signals", "v,n"}, {"name", name}, {"from", "4000000"}});
  ASSERT_EQ(answer.status, 200u) << answer.body;
  EXPECT_EQ(answer.type, "text/html; charset=utf-8");
  EXPECT_EQ(answer.body.find(name), std::string::npos);
  EXPECT_EQ(answer.body.find("<script>alert"), std::string::npos);
  const std::string opening = R"(<script type="application/json" id="lockstep-trace">)";
  const std::size_t begin = answer.body.find(opening);
  ASSERT_NE(begin, std::string::npos);
  const std::size_t data = begin + opening.size();
  const Json json = Json::parse(answer.body.substr(data, answer.body.find("</script>", data) - data));
  EXPECT_EQ(json.at("about").at("name"), name);
  EXPECT_EQ(json.at("signals").at(0).at("path"), "v");
  EXPECT_EQ(json.at("signals").at(1).at("path"), "n");
  const DecodedFrame frame(from_base64(json.at("frame").get<std::string>()));
  ASSERT_TRUE(frame.is_whole);
  ASSERT_EQ(frame.t.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(frame.t[i], static_cast<std::int64_t>(i + 2) * 2'000'000);
    EXPECT_EQ(frame.columns[0].arrays[0][i], std::bit_cast<std::uint64_t>(kValues[i + 2]));
    EXPECT_EQ(frame.columns[1].real(0, i), static_cast<double>(i + 2));
  }
  // It needs no server: nothing of it is named that would have to be fetched.
  EXPECT_EQ(answer.body.find("<script type=\"module\" src="), std::string::npos);
  EXPECT_EQ(answer.body.find("<link rel=\"stylesheet\""), std::string::npos);
}

TEST(StudioExport, AsAPageHasTheEventsAndJobsOfItsTime) {
  StudioOfFiles studio;
  const StudioFolder folder;
  const std::string path = (folder.path() / "run.lcm").string();
  const std::vector<TraceSignal> signals = {{"v", Type::LREAL, ""}};
  LcmLog log(path, {"files", "TRACE", 1'000'000, 0});
  log.begin(signals);
  const auto tell = [&log](std::int64_t t, const std::string& instance, EventKind kind) {
    TraceEvent event;
    event.t = t * 1'000'000;
    event.source = instance;
    event.type = "MC_GearIn";
    event.text = "</script><script>alert('seen')</script>";
    event.kind = kind;
    log.event(event);
  };
  for (std::int64_t t = 0; t < 100; ++t) {
    if (t == 2) tell(t, "early", EventKind::job_started);
    if (t == 5) tell(t, "early", EventKind::job_done);
    if (t == 10) tell(t, "across", EventKind::job_started);
    if (t == 50) tell(t, "across", EventKind::job_done);
    if (t == 55) tell(t, "goes_on", EventKind::job_started);
    if (t == 80) tell(t, "late", EventKind::job_started);
    log.row({t * 1'000'000, static_cast<std::uint64_t>(t), 0, std::vector<Value>{test::real(1.0)}});
  }
  log.end();
  const std::string id = studio.open(path);
  const StudioAnswer answer =
      studio.ask("GET", "/api/traces/" + id + "/export",
                 {{"format", "html"}, {"signals", "v"}, {"from", "20000000"}, {"to", "60000000"}});
  ASSERT_EQ(answer.status, 200u) << answer.body;
  EXPECT_EQ(answer.body.find("<script>alert"), std::string::npos);
  const std::string opening = R"(<script type="application/json" id="lockstep-trace">)";
  const std::size_t data = answer.body.find(opening) + opening.size();
  const Json json = Json::parse(answer.body.substr(data, answer.body.find("</script>", data) - data));
  std::vector<std::string> jobs, events;
  for (const Json& job : json.at("jobs")) jobs.push_back(job.at("instance"));
  for (const Json& event : json.at("events"))
    events.push_back(event.at("source").get<std::string>() + " " + event.at("t").get<std::string>());
  EXPECT_EQ(jobs, (std::vector<std::string>{"across", "goes_on"}));
  EXPECT_EQ(events, (std::vector<std::string>{"across 50000000", "goes_on 55000000"}));
}

Json document_of(const std::string& project) {
  std::ifstream file(kProjects + project + "/project.json");
  return Json::parse(file);
}

/// Calls `visit` for each object within that has a pointer to a text.
template <class Visit>
void each_text(const Json& json, const Visit& visit) {
  if (json.is_object() && json.contains("text") && json.contains("pointer")) visit(json);
  if (json.is_structured())
    for (const Json& part : json) each_text(part, visit);
}

TEST(StudioProjectText, PointsAtWhatIsWrittenInTheProject) {
  for (const std::string project : {"01_positioning", "02_rotary_knife", "03_line_shaft", "04_cross_cutter",
                                    "11_pick_and_place", "08_filling_line"}) {
    const Json document = document_of(project);
    const StudioProjectText text(document.dump());
    const Json programs = Json::parse(text.programs().dump());
    ASSERT_EQ(programs.size(), document.at("programs").size()) << project;
    int texts = 0;
    each_text(programs, [&](const Json& one) {
      const std::string pointer = one.at("pointer");
      const Json::json_pointer place(pointer);
      ASSERT_TRUE(document.contains(place)) << project << pointer;
      const Json& there = document.at(place);
      if (there.is_object()) return;  // a call, whose text has a pointer of its own
      EXPECT_EQ(one.at("text"), there.is_string() ? there.get<std::string>() : there.dump()) << pointer;
      ++texts;
    });
    EXPECT_GT(texts, 5) << project;
  }
}

TEST(StudioProjectText, FindsUsesOfWholeNamesAlone) {
  const StudioProjectText text(R"({ "programs": [ { "name": "Main", "ob": "Main", "calls": [
    { "fb": "MC_Power", "name": "power", "in": { "Axis": "Knife", "Enable": "run AND NOT knife_off" } },
    { "if": "Knife.Position > 1.0", "then": [ { "set": "run", "to": "other.Knife" } ],
      "else": [ { "set": "KnifeB", "to": "KNIFE.Velocity + 1.0" } ] },
    { "fb": "MC_GearIn", "name": "gear", "in": { "Master": "Belt", "Slave": "Knife", "RatioNumerator": 3 } }
    ] } ] })");
  const Json uses = Json::parse(text.uses("knife").dump());
  std::vector<std::string> pointers;
  for (const Json& use : uses) pointers.push_back(use.at("pointer"));
  EXPECT_EQ(pointers,
            (std::vector<std::string>{"/programs/0/calls/0/in/Axis", "/programs/0/calls/1/if",
                                      "/programs/0/calls/1/else/0/to", "/programs/0/calls/2/in/Slave"}));
  EXPECT_TRUE(text.uses("").empty()) << text.uses("");
  EXPECT_TRUE(text.uses("nothing").empty());
  const Json couplings = Json::parse(text.couplings().dump());
  ASSERT_EQ(couplings.size(), 1u);
  EXPECT_EQ(couplings[0].at("leading"), "Belt");
  EXPECT_EQ(couplings[0].at("following"), "Knife");
  EXPECT_EQ(couplings[0].at("RatioNumerator"), "3");
  EXPECT_EQ(couplings[0].at("pointer"), "/programs/0/calls/2");
}

TEST(StudioProjectText, TellsWhichCouplingsArePossibleBesidesThoseOfPrograms) {
  const StudioProjectText text(R"({ "technology_objects": {
    "Belt": { "type": "TO_PositioningAxis" }, "Line": { "type": "TO_PositioningAxis" },
    "Knife": { "type": "TO_SynchronousAxis", "leading_values": [
      { "to": "belt", "coupling": "setpoint" }, { "to": "Line", "coupling": "actual" }, { "to": 7 }, 8 ] } },
    "programs": [ { "name": "Main", "ob": "Main", "calls": [
      { "fb": "MC_GearIn", "name": "gear", "in": { "Master": "Belt", "Slave": "Knife" } } ] } ] })");
  const Json couplings = Json::parse(text.couplings().dump());
  ASSERT_EQ(couplings.size(), 2u) << couplings;
  EXPECT_EQ(couplings[0].at("instance"), "gear");
  EXPECT_FALSE(couplings[0].contains("possible"));
  EXPECT_EQ(
      couplings[1].dump(),
      R"({"coupling":"actual","following":"Knife","leading":"Line","pointer":"/technology_objects/Knife/leading_values/1","possible":true})");
}

TEST(StudioProjectText, OfNoProjectIsEmpty) {
  for (const std::string bad : {"", "{", "[]", "7", R"({"programs":7})", R"({"programs":[7]})",
                                R"({"programs":[{"calls":[7,{}]}],"technology_objects":[]})"}) {
    const StudioProjectText text(bad);
    EXPECT_TRUE(text.couplings().empty()) << bad;
    EXPECT_TRUE(text.uses("x").empty()) << bad;
    EXPECT_TRUE(text.cams().empty()) << bad;
    EXPECT_TRUE(text.configured("x", "y").is_null()) << bad;
    EXPECT_TRUE(text.wiring("x", "y").is_null()) << bad;
  }
}

TEST(StudioRefusals, MoveNoAxis) {
  const std::string project = kProjects + "02_rotary_knife/project.json";
  StudioMachine asked(project), alone(project);
  StudioPage page, stranger;
  asked.session.opened(page);
  asked.session.text(page, R"({"type":"hello"})");
  asked.session.opened(stranger);
  const std::vector<std::string> commands = {
      R"({"type":"command","axis":"Knife","action":"enable","run":1,"beat":1,"sequence":1})",
      R"({"type":"command","axis":"Knife","action":"jog forward","value":50,"run":1,"beat":1,"sequence":2})",
      R"({"type":"command","axis":"Conveyor","action":"home","run":1,"beat":1,"sequence":3})",
      R"({"type":"command","axis":"Nobody","action":"jog forward"})", R"({"type":"command"})"};
  const std::vector<std::string> watched = {
      "Knife.Position", "Knife.Velocity", "Knife.StatusWord", "Conveyor.Position", "Conveyor.StatusWord",
      "speed",          "start"};
  for (int round = 0; round < 40; ++round) {
    const auto refused = [&](const std::string& method, const std::string& path, const std::string& body) {
      const unsigned status = asked.ask(method, path, {}, body).status;
      EXPECT_GE(status, 400u) << path << body;
      EXPECT_LT(status, 500u) << path << body;
    };
    refused("POST", "/api/write", R"({"writes":[{"path":"start","value":true}]})");
    refused("POST", "/api/write", R"({"writes":[{"path":"speed","value":300.0}]})");
    refused("POST", "/api/write", "{");
    refused("POST", "/api/simulation", R"({"action":"run"})");
    refused("POST", "/api/traces", R"({"path":"x.csv"})");
    refused("PUT", "/api/files/project.json", "{}");
    refused("DELETE", "/api/traces/live", "");
    for (const std::string& command : commands) {
      asked.session.text(page, command);
      asked.session.text(stranger, command);
    }
    asked.run(10);
    alone.run(10);
    for (const std::string& path : watched)
      ASSERT_EQ(std::bit_cast<std::uint64_t>(asked.simulation.read(path)),
                std::bit_cast<std::uint64_t>(alone.simulation.read(path)))
          << path << " in round " << round;
  }
  for (const Json& text : page.texts)
    if (text.at("type") == "command") {
      EXPECT_EQ(text.at("accepted"), false) << text;
    }
  ASSERT_FALSE(stranger.texts.empty());
  for (const Json& text : stranger.texts) EXPECT_EQ(text.at("type"), "error") << text;
}

}  // namespace
}  // namespace lockstep::studio_export_test
