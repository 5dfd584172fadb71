// A day of virtual time with everything on: memory stays as it is. CI runs five minutes of it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iostream>

#include "hmi_bridge/command_desk.hpp"
#include "hmi_bridge/modbus_client.hpp"
#include "hmi_bridge/modbus_server.hpp"
#include "hmi_bridge/retain_writer.hpp"
#include "projects/project.hpp"
#include "tests/scenarios/modbus_client.hpp"
#include "tests/scenarios/small_project.hpp"
#include "tests/support/property.hpp"

namespace lockstep::test {
namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr long kMayGrow = 300'000;  // [KiB] the sanitizer keeps what has been released, up to 256 MiB
#else
constexpr long kMayGrow = 256;  // [KiB]
#endif

constexpr int kTicks = 900;  // address of the count of ticks

/// Memory of a process in the machine [KiB].
long resident(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmRSS:")) return std::atol(line.c_str() + 6);
  return -1;
}

/// Adds a flight recorder, and channels with fewer rows and with those around occasions that come and go.
void add_recorders(Json& json, const std::string& flight) {
  const Json signal = json["trace"]["signals"][json["trace"]["signals"].size() - 1];
  json["flight_recorder"] = {{"before", "10s"}, {"after", "1s"}, {"file", flight}};
  json["trace"]["channels"] = Json::parse(R"([
    {"channel": "SLOW", "signals": [], "every": 100},
    {"channel": "EDGE", "signals": [], "every": 3,
     "trigger": {"on": "rising", "signal": "", "before": "5s", "after": "1s"}}])");
  for (Json& channel : json["trace"]["channels"]) channel["signals"].push_back(signal);
  json["trace"]["channels"][1]["trigger"]["signal"] = signal;
}

class Soak : public testing::TestWithParam<const char*> {};

TEST_P(Soak, ADayOfVirtualTimeTakesNoMoreMemoryThanItsFirstHours) {
  const int seconds = test::cases(300, 86400);
  const Directory directory;
  Json json = example_json(GetParam());
  json["modbus"]["map"].push_back(
      {{"diagnostic", "ticks"}, {"table", "input_register"}, {"address", kTicks}, {"type", "UDINT"}});
  add_recorders(json, directory.file("flight"));
  const double period = json["clock"]["servo_cycle"] == "500us" ? 0.0005 : 0.001;
  const auto all_ticks = static_cast<std::uint32_t>(seconds / period);
  // The trace is written, but no disk has room for a day of it.
  std::filesystem::create_symlink("/dev/null", directory.file("trace.csv"));
  Process run(lockstep_command({"run", directory.write("project.json", json.dump()), "--simulate", "--modbus",
                                "127.0.0.1:0", "--lcm", "memq://", "--trace", directory.file("trace.csv"),
                                "--duration", std::to_string(seconds) + "s"}));
  const std::string mark = "Modbus server on 127.0.0.1:";
  ASSERT_TRUE(wait_until([&] { return run.err().find('\n') != std::string::npos; }));
  ModbusClient client(std::atoi(run.err().c_str() + run.err().find(mark) + mark.size()));
  const auto wait_for = [&](double part) {
    return wait_until([&] { return client.input_double_word(kTicks) >= part * all_ticks; },
                      std::chrono::hours(12));
  };
  ASSERT_TRUE(wait_for(0.2));
  const long early = resident(run.pid());
  ASSERT_TRUE(wait_for(0.9));
  const long late = resident(run.pid());
  std::cout << early << " KiB after a fifth, " << late << " KiB near the end of " << seconds << " s\n";
  EXPECT_GT(early, 1000);
  EXPECT_LE(late, early + kMayGrow);
  ASSERT_TRUE(wait_until([&] { return !run.running(); }, std::chrono::hours(12)));
  EXPECT_EQ(run.status(), 0) << run.err();
  EXPECT_EQ(run.err().find("alarm"), std::string::npos) << run.err();
}

/// Adds a tag that changes in every millisecond and an array of which one element after the other does, both
/// kept. Of an array that is not changed at all nothing is to be written again.
Json with_kept_values(Json json) {
  json["tags"]["beat"] = {{"type", "DINT"}, {"retain", true}};
  json["tags"]["beats"] = {{"type", "ARRAY[0..499] OF DINT"}, {"retain", true}};
  json["tags"]["recipe"] = {
      {"type", "ARRAY[1..50] OF TO_Cam_Struct_PointData"}, {"init", {{1.0, 2.5}}}, {"retain", true}};
  json["programs"].push_back(
      {{"name", "Beat"},
       {"ob", "Main"},
       {"cycle", "1ms"},
       {"calls", {assignment("beat", "beat + 1"), assignment("beats[beat MOD 500]", "beat")}}});
  return json;
}

// A simulation keeps nothing, so this one has the writer beside a controller in virtual time, which ends and
// goes on every hour.
TEST(SoakOfKeptValues, ADayOfVirtualTimeTakesNoMoreMemoryAndEndsWithTheValuesOfItsLastTick) {
  const int parts = test::cases(6, 24);
  const int ticks = test::cases(50'000, 3'600'000);  // of each part
  const Directory directory;
  const std::string file = directory.file("kept");
  const std::string text = with_kept_values(example_json("05_press_feeder")).dump();
  long early = 0;
  std::int64_t beat = 0;
  for (int part = 0; part < parts; ++part) {
    LoadedProject loaded = load_project(text, "", [&](Project& project) {
      RetainFile kept(file, project.name);
      EXPECT_TRUE(restore(kept, project.retain.values).empty());
    });
    ASSERT_TRUE(loaded.project.has_value()) << loaded.problems[0].place << loaded.problems[0].text;
    Project& project = *loaded.project;
    ASSERT_EQ(project.retain.values.size(), 3u);
    ASSERT_EQ(project.retain.values[0].signals()[0].load().i, beat) << "what the part before has kept";
    {
      RetainWriter writer(RetainFile(file, project.name), project.retain.values,
                          std::chrono::milliseconds(1));
      project.controller->images = {&writer.image()};
      writer.start();
      for (int tick = 0; tick < ticks; ++tick) project.controller->tick();
      writer.stop();
      EXPECT_FALSE(writer.failing());
      EXPECT_GT(writer.commits(), 2u) << "not at the end alone";
    }
    beat += ticks;
    const RetainFile kept(file, project.name);
    ASSERT_EQ(kept.find("beat")->value, std::to_string(beat));
    const auto beats = kept_values(kept.find("beats")->value, project.retain.values[1].signals());
    ASSERT_TRUE(beats.has_value());
    for (std::int64_t element = 0; element < 500; ++element)
      ASSERT_EQ((*beats)[static_cast<std::size_t>(element)].i, beat - (beat - element) % 500) << element;
    EXPECT_EQ(kept.find("recipe")->value.substr(0, 6), "1,2.5,");
    const long now = resident(::getpid());
    if (part == parts / 5) early = now;
    if (part >= parts / 5) {
      EXPECT_LE(now, early + kMayGrow + 256) << "part " << part;
    }
  }
  std::cout << early << " KiB after a fifth, " << resident(::getpid()) << " KiB at the end, "
            << std::filesystem::file_size(file) << " bytes in the file after " << parts << " parts\n";
}

/// An axis that takes commands, a count that a client may read, and a client that does.
Json asked_project() {
  Json json = empty_project();
  json["technology_objects"]["Slide"] = virtual_axis();
  json["tags"] =
      Json::parse(R"({"beat": {"type": "DINT"}, "seen": {"type": "DINT"}, "heard": {"type": "BOOL"}})");
  json["programs"] = {
      {{"name", "Beat"}, {"ob", "Main"}, {"cycle", "1ms"}, {"calls", {assignment("beat", "beat + 1")}}}};
  json["modbus"] = Json::parse(R"({
    "map": [{"tag": "beat", "table": "input_register", "address": 0}],
    "clients": [{"connect": "127.0.0.1:1", "devices": [{"name": "itself", "cycle": "1ms", "quality": "heard",
                 "read": [{"tag": "seen", "table": "input_register", "address": 0}]}]}]})");
  json["trace"] = Json::parse(R"({"lcm": {"url": "memq://", "channel": "SOAK",
    "commands": {"axes": {"Slide": {"jog_velocity": 10.0}}}}, "signals": ["Slide.Position"]})");
  return json;
}

template <class Named>
std::vector<Signal> places_of(const std::vector<Named>& signals) {
  std::vector<Signal> places;
  for (const Named& named : signals) places.push_back(named.signal);
  return places;
}

/// Panels that come and go: each jogs the axis for a second of ten commands, to and fro.
class Panels {
 public:
  explicit Panels(const Project& project)
      : image(project.commands.axes[0].signals), desk(project.commands.axes, image, 1) {}

  void command() {
    image.refresh();
    desk.beat();
    now_ += std::chrono::milliseconds(100);
    command_t command{};
    command.run = 1;
    command.beat = desk.panel(0).beat;
    command.sequence = ++commands_;
    command.sender = 1 + commands_ / 10;
    command.axis = "Slide";
    command.value = 5.0;
    command.action = command_t::JOG_FORWARD;
    if (command.sender % 2 == 0) command.action = command_t::JOG_BACKWARD;
    if (commands_ % 10 < 4) command.action = command_t::ENABLE;  // until the jog of the panel before is over
    desk.accept(encoded(command), now_);
  }

  ProcessImage image;
  CommandDesk desk;

 private:
  CommandDesk::Clock::time_point now_{std::chrono::hours(1)};
  std::int64_t commands_ = 0;
};

// In a simulation clients rest and nobody commands, so these two have a controller in virtual time beside
// them.
TEST(SoakOfClientsAndCommands, ADayOfVirtualTimeTakesNoMoreMemory) {
  const int ticks = test::cases(300'000, 86'400'000);
  LoadedProject loaded = load_project(asked_project().dump());
  ASSERT_TRUE(loaded.project.has_value()) << loaded.problems[0].place << loaded.problems[0].text;
  Project& project = *loaded.project;
  ProcessImage served(places_of(project.modbus.signals));
  ProcessImage polled(places_of(project.modbus.clients[0].signals));
  Panels panels(project);
  project.controller->images = {&served, &polled, &panels.image};
  ModbusServerOptions place;
  place.listen = {{"127.0.0.1", 0}};
  ModbusServer server(std::vector<ModbusService>{{place, project.modbus.units_of(0)}}, served,
                      ModbusIdentity{});
  ASSERT_EQ(server.start(), "");
  ModbusClientOptions options = project.modbus.clients[0].options;
  options.connect = Endpoint{"127.0.0.1", server.port()};
  lockstep::ModbusClient client(options, polled);
  client.start();
  ASSERT_TRUE(wait_until([&] {
    project.controller->tick();
    return client.counters().requests > 10;
  }));
  long early = 0;
  for (int tick = 0; tick < ticks; ++tick) {
    project.controller->tick();
    if (tick % 100 == 0) panels.command();
    if (tick == ticks / 5) early = resident(::getpid());
  }
  const long late = resident(::getpid());
  EXPECT_LE(late, early + kMayGrow + 256);
  std::cout << early << " KiB after a fifth, " << late << " KiB at the end; " << client.counters().requests
            << " requests, " << panels.desk.counters().accepted << " commands\n";
  EXPECT_EQ(client.counters().failed, 0u);
  EXPECT_EQ(panels.desk.counters().refused(), 0u);
  EXPECT_GE(panels.desk.counters().accepted, static_cast<std::uint64_t>(ticks / 100));
}

INSTANTIATE_TEST_SUITE_P(Machines, Soak, testing::Values("03_line_shaft", "05_press_feeder"),
                         [](const auto& name) { return std::string(name.param).substr(3); });

}  // namespace
}  // namespace lockstep::test
