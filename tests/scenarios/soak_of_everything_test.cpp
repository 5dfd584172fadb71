// A day of virtual time with everything on at once, which no simulation has: server and clients of Modbus,
// traces with triggers, flight recorder, alarms, kept values, commands. Memory stays as it is. CI runs five
// minutes of it.
#include <gtest/gtest.h>

#include <iostream>

#include "hmi_bridge/lcm/command_desk.hpp"
#include "hmi_bridge/lcm/log.hpp"
#include "hmi_bridge/lcm/publisher.hpp"
#include "hmi_bridge/modbus/client.hpp"
#include "hmi_bridge/modbus/server.hpp"
#include "hmi_bridge/retain/writer.hpp"
#include "hmi_bridge/traces/channel.hpp"
#include "hmi_bridge/traces/columns.hpp"
#include "hmi_bridge/traces/csv_trace.hpp"
#include "hmi_bridge/traces/flight_recorder.hpp"
#include "hmi_bridge/traces/recorder.hpp"
#include "projects/loader/project.hpp"
#include "tests/scenarios/modbus_client.hpp"
#include "tests/scenarios/soak.hpp"
#include "tests/support/property.hpp"

namespace lockstep::test::soak_of_everything_test {
namespace {

/// An example, with kept values, an axis that takes commands, a drive that fails every minute of the
/// run, a device that is the server itself, and channels around what comes and goes.
Json everything(const char* example, const std::string& flight) {
  Json json = with_kept_values(example_json(example));
  json["technology_objects"]["Slide"] = virtual_axis();
  json["technology_objects"]["Weak"] = Json::parse(
      R"({"type": "TO_PositioningAxis", "drive": {"model": "simulated", "faults": {"drive": "broken"}}})");
  for (const char* const name : {"broken", "healed", "heard", "blink"})
    json["tags"][name] = {{"type", "BOOL"}};
  for (const char* const name : {"seen", "echo"}) json["tags"][name] = {{"type", "DINT"}};
  json["programs"].push_back(
      {{"name", "Faults"},
       {"ob", "Main"},
       {"cycle", "10ms"},
       {"calls",
        {assignment("broken", "beat MOD 60000 > 59000"), assignment("healed", "beat MOD 60000 < 30000"),
         assignment("blink", "beat MOD 4000 < 2000"),
         call("MC_Power", "power_weak", {{"Axis", "Weak"}, {"Enable", true}}),
         call("MC_Reset", "reset_weak", {{"Axis", "Weak"}, {"Execute", "healed"}})}}});
  json["modbus"]["map"].push_back({{"tag", "beat"}, {"table", "input_register"}, {"address", 200}});
  json["modbus"]["map"].push_back({{"tag", "echo"}, {"table", "holding_register"}, {"address", 300}});
  json["modbus"]["clients"] = Json::parse(R"([{"connect": "127.0.0.1:1", "devices": [
    {"name": "itself", "cycle": "1ms", "quality": "heard",
     "read": [{"tag": "seen", "table": "input_register", "address": 200}],
     "write": [{"tag": "beat", "table": "holding_register", "address": 300}]}]}])");
  add_recorders(json, flight);
  Json alarms = json["trace"]["channels"][1];
  json["trace"]["channels"][1]["trigger"]["signal"] = "blink";
  alarms["channel"] = "ALARMS";
  alarms["trigger"] = {{"on", "alarm"}, {"before", "2s"}, {"after", "1s"}};
  json["trace"]["channels"].push_back(alarms);
  json["trace"]["lcm"]["commands"] = Json::parse(R"({"axes": {"Slide": {"jog_velocity": 10.0}}})");
  return json;
}

/// What `lockstep run` records: a CSV trace, a log and a network of LCM with their channels, a flight
/// recorder.
class Recording {
 public:
  Recording(Project& project, const Directory& directory) {
    const TraceConfig& trace = project.trace;
    const auto log = [&] { return nothing(directory, "trace.lcm"); };
    add(std::make_unique<CsvTrace>(nothing(directory, "trace.csv")), trace.signals);
    auto whole = std::make_unique<LcmLog>(log(), identity(project, trace.channel));
    for (const TraceChannelConfig& channel : trace.channels) {
      add(whole->add_channel(identity(project, channel.channel)), channel.signals, &channel);
      add(std::make_unique<LcmPublisher>("memq://", identity(project, channel.channel), false),
          channel.signals, &channel);
    }
    add(std::move(whole), trace.signals);
    add(std::make_unique<LcmPublisher>("memq://", identity(project, trace.channel)), trace.signals);
    const FlightRecorderConfig& flight = project.flight_recorder.value();
    auto flights = std::make_unique<FlightRecorder>(flight.options, columns_.of(flight.signals),
                                                    project.controller->clock.interpolator_cycle());
    flight_ = flights.get();
    sinks_.push_back(std::move(flights));
    ring_.emplace(columns_.places(), 1 << 14);
    project.controller->trace = &*ring_;
    project.controller->events = &events_;
    project.controller->tell_jobs();
    recorder_.emplace(*ring_, columns_.described(), std::move(sinks_),
                      EventSource{&events_, EventTexts(*project.controller), true});
  }
  bool wait() const { return ring_->wait_for_space() && events_.wait_for_space(); }
  TraceRecorder& recorder() { return *recorder_; }
  std::size_t flights() const { return flight_->written().size(); }

 private:
  /// The name of a file that takes everything and keeps nothing: no disk has room for a day of it.
  static std::string nothing(const Directory& directory, const std::string& name) {
    std::filesystem::create_symlink("/dev/null", directory.file(name));
    return directory.file(name);
  }
  static LcmTraceIdentity identity(const Project& project, const std::string& channel) {
    return {project.name, channel, project.controller->clock.interpolator_cycle(), 0};
  }
  void add(std::unique_ptr<TraceSink> sink, const std::vector<NamedSignal>& signals,
           const TraceChannelConfig* part = nullptr) {
    std::optional<std::size_t> occasion;
    if (part != nullptr && part->occasion) occasion = columns_.of(*part->occasion);
    sinks_.push_back(std::make_unique<TraceChannel>(std::move(sink), columns_.of(signals),
                                                    part == nullptr ? TraceSelection{} : part->selection,
                                                    occasion));
  }

  TraceColumns columns_;
  std::vector<std::unique_ptr<TraceSink>> sinks_;
  const FlightRecorder* flight_ = nullptr;
  std::optional<TraceRing> ring_;
  EventQueue events_;
  std::optional<TraceRecorder> recorder_;
};

/// Panels that come and go: each jogs the axis for a second of ten commands, to and fro.
class Panels {
 public:
  Panels(const Project& project, TraceRecorder& recorder)
      : image(project.commands.axes[0].signals), desk(project.commands.axes, image, 1), recorder_(recorder) {}

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
    const auto answer = desk.accept(encoded(command), now_);
    if (!answer) return;
    TraceEvent event;
    event.kind = answer->accepted ? EventKind::command_accepted : EventKind::command_refused;
    event.source = answer->axis;
    event.type = answer->action;
    recorder_.tell(event);
    ++answers;
  }

  ProcessImage image;
  CommandDesk desk;
  std::uint64_t answers = 0;

 private:
  TraceRecorder& recorder_;
  CommandDesk::Clock::time_point now_{std::chrono::hours(1)};
  std::int64_t commands_ = 0;
};

/// A client that comes, asks and goes, again and again, on a thread of its own.
class Visitor {
 public:
  explicit Visitor(int port) : thread_([this, port] { visit(port); }) {}
  ~Visitor() { end(); }
  void end() {
    over_ = true;
    if (thread_.joinable()) thread_.join();
  }
  std::uint64_t visits() const { return visits_; }

 private:
  void visit(int port) {
    while (!over_) {
      ModbusClient client(port);
      for (int i = 0; i < 10 && !over_; ++i) client.input_double_word(200);
      ++visits_;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  std::atomic<bool> over_{false};
  std::atomic<std::uint64_t> visits_{0};
  std::thread thread_;
};

class SoakOfEverything : public testing::TestWithParam<const char*> {};

TEST_P(SoakOfEverything, ADayOfVirtualTimeTakesNoMoreMemory) {
  const int milliseconds = cases(300'000, 86'400'000);
  const Directory directory;
  LoadedProject loaded = load_project(everything(GetParam(), directory.file("flight")).dump());
  ASSERT_TRUE(loaded.project.has_value()) << loaded.problems[0].place << loaded.problems[0].text;
  Project& project = *loaded.project;
  Controller& controller = *project.controller;
  controller.apply_stimuli = true;
  const int ticks_per_millisecond = static_cast<int>(1'000'000 / controller.clock.servo_cycle);
  const int ticks = milliseconds * ticks_per_millisecond;
  Recording recording(project, directory);
  ProcessImage served(places_of(project.modbus.signals));
  ProcessImage polled(places_of(project.modbus.clients[0].signals));
  Panels panels(project, recording.recorder());
  RetainWriter keeper(RetainFile(directory.file("kept"), project.name), project.retain.values,
                      std::chrono::milliseconds(1));
  controller.images = {&served, &polled, &panels.image, &keeper.image()};
  ModbusServerOptions place;
  place.listen = {{"127.0.0.1", 0}};
  ModbusServer server(std::vector<ModbusService>{{place, project.modbus.units_of(0)}}, served,
                      ModbusIdentity{});
  ASSERT_EQ(server.start(), "");
  ModbusClientOptions options = project.modbus.clients[0].options;
  options.connect = Endpoint{"127.0.0.1", server.port()};
  lockstep::ModbusClient client(options, polled);
  client.start();
  Visitor visitor(server.port());
  keeper.start();
  const auto begin = std::chrono::steady_clock::now();
  long early = 0, late = 0;
  for (int tick = 0; tick < ticks; ++tick) {
    ASSERT_TRUE(recording.wait());
    controller.tick();
    if (tick % (100 * ticks_per_millisecond) == 0) panels.command();
    if (tick == ticks / 5) early = resident(::getpid());
    if (tick == ticks - 1) late = resident(::getpid());
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  visitor.end();
  client.stop();
  recording.recorder().stop();
  keeper.stop();
  std::cout << early << " KiB after a fifth, " << late << " KiB at the end of " << milliseconds / 3.6e6
            << " h in " << spent.count() << " s; " << client.counters().requests << " requests, "
            << visitor.visits() << " visits, " << panels.answers << " answers, " << recording.flights()
            << " flights, " << keeper.commits() << " commits\n";
  // Beside other work the buffers of the threads fill later. A few hundred bytes lost with each of the
  // thousands of requests, commands and commits would be more.
  EXPECT_LE(late, early + kMayGrow + 1024);
  EXPECT_GT(early, 1000);
  for (const std::string& loss : recording.recorder().losses()) ADD_FAILURE() << loss;
  EXPECT_EQ(client.counters().failed, 0u);
  EXPECT_GT(client.counters().requests, 10u);
  EXPECT_GT(visitor.visits(), 2u);
  EXPECT_EQ(server.counters().exceptions, 0u);
  EXPECT_EQ(panels.desk.counters().refused(), 0u);
  EXPECT_GE(panels.desk.counters().accepted, static_cast<std::uint64_t>(milliseconds / 100));
  EXPECT_EQ(recording.flights(), static_cast<std::size_t>(std::min(milliseconds / 60'000, 10)));
  EXPECT_FALSE(keeper.failing());
  EXPECT_GT(keeper.commits(), 2u);
}

INSTANTIATE_TEST_SUITE_P(Machines, SoakOfEverything, testing::Values("03_line_shaft", "05_press_feeder"),
                         [](const auto& name) { return std::string(name.param).substr(3); });

}  // namespace
}  // namespace lockstep::test::soak_of_everything_test
