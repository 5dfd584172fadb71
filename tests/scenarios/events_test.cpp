// What a run tells of alarms and jobs: messages, LCM events, the flight recorder, channels with a trigger.
#include <gtest/gtest.h>
#include <lcm/eventlog.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <sstream>

#include "hmi_bridge/lcm/trace_reader.hpp"
#include "hmi_bridge/traces/recordings.hpp"
#include "lockstep/event_t.hpp"
#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::events_test {
namespace {

/// A slide that misses its window: alarm 541, acknowledged at 4 s, started again at 5 s and missed again.
Json missing_slide() {
  Json project = example_json("01_positioning");
  Json& slide = project["technology_objects"]["Slide"];
  slide["drive"]["time_constant"] = "40ms";
  slide["config"]["PositioningMonitoring"] = {{"Window", 0.0001}, {"ToleranceTime", 0.5}};
  project["stimuli"] = {stimulus("0.5s", "start", true), stimulus("4s", "reset", true),
                        stimulus("4.1s", "reset", false), stimulus("5s", "start", true)};
  return project;
}

std::vector<std::string> lines_with(const std::string& text, const std::string& part) {
  std::vector<std::string> found;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (line.find(part) != std::string::npos) found.push_back(line);
  return found;
}

/// The events of a log, in its order, with all rows of all channels between them.
struct Log {
  std::vector<event_t> events;
  std::vector<std::int64_t> row_times_before;  // of each event: t of the last row of the main channel

  explicit Log(const std::string& path, const std::string& channel) {
    const std::unique_ptr<lcm_eventlog_t, void (*)(lcm_eventlog_t*)> log(
        lcm_eventlog_create(path.c_str(), "r"), &lcm_eventlog_destroy);
    std::int64_t last = -1;
    while (lcm_eventlog_event_t* entry = lcm_eventlog_read_next_event(log.get())) {
      const std::string name(entry->channel, static_cast<std::size_t>(entry->channellen));
      if (name == channel + "_EVENTS") {
        event_t event;
        EXPECT_EQ(event.decode(entry->data, 0, entry->datalen), entry->datalen);
        EXPECT_EQ(entry->timestamp, event.utime);
        events.push_back(event);
        row_times_before.push_back(last);
      } else if (name == channel) {
        trace_row_t row;
        EXPECT_EQ(row.decode(entry->data, 0, entry->datalen), entry->datalen);
        last = row.t;
      }
      lcm_eventlog_free_event(entry);
    }
  }
  std::size_t count(const std::string& kind, const std::string& source) const {
    return static_cast<std::size_t>(std::count_if(events.begin(), events.end(), [&](const event_t& event) {
      return event.kind == kind && event.source == source;
    }));
  }
};

TEST(AlarmList, TellsEachAlarmAndAcknowledgementWithTimeAndTextInOrder) {
  const Directory directory;
  const std::string file = directory.write("project.json", missing_slide().dump(1));
  const Ended ended = lockstep({"run", file, "--simulate", "--duration", "8s"});
  EXPECT_EQ(ended.status, 0);
  const auto told = lines_with(ended.err, " s: Slide: ");
  ASSERT_EQ(told.size(), 3u) << ended.err;
  EXPECT_NE(told[0].find("alarm 541: "), std::string::npos) << told[0];
  EXPECT_NE(told[0].find("(remove the enable)"), std::string::npos) << told[0];
  EXPECT_NE(told[1].find("lockstep: 4.0"), std::string::npos) << told[1];
  EXPECT_NE(told[1].find("alarms acknowledged"), std::string::npos) << told[1];
  EXPECT_NE(told[2].find("alarm 541: "), std::string::npos) << told[2];
  EXPECT_LT(ended.err.find(told[2]), ended.err.find("simulated 8.000 s")) << "before the end is told";
  const CsvTable table = simulate(file, "8s", {"--signals", "Slide.ErrorDetail.Number"});
  const double raised = table["t"][table.first("Slide.ErrorDetail.Number", 541.0)];
  EXPECT_NEAR(std::stod(told[0].substr(told[0].find(' ') + 1)), raised, 0.0025) << told[0];
  const Ended again = lockstep({"run", file, "--simulate", "--duration", "8s"});
  EXPECT_EQ(lines_with(again.err, " s: Slide: "), told);
}

/// However late its ticks come: the program itself acknowledges, and the run goes on until that is told.
TEST(AlarmList, IsToldInRealTimeToo) {
  const Directory directory;
  Json project = missing_slide();
  project.erase("modbus");
  project["stimuli"] = {stimulus("0.5s", "start", true)};
  project["programs"][0]["calls"].push_back(assignment("reset", "alarm"));
  const std::string file = directory.write("project.json", project.dump(1));
  Process run(lockstep_command({"run", file, "--stimuli", "--no-lcm"}));
  EXPECT_TRUE(wait_until([&] { return run.err().find("acknowledged") != std::string::npos; })) << run.err();
  run.send(SIGINT);
  EXPECT_EQ(run.status(), 0);
  const auto told = lines_with(run.err(), " s: Slide: ");
  ASSERT_GE(told.size(), 2u) << run.err();
  EXPECT_NE(told[0].find("alarm 541"), std::string::npos);
  EXPECT_NE(told[1].find("acknowledged"), std::string::npos);
}

TEST(EventChannel, HoldsAlarmsAndJobsBeforeTheRowsOfTheirTicks) {
  const Directory directory;
  const std::string file = directory.write("project.json", missing_slide().dump(1));
  const auto run = [&](const std::string& name) {
    const std::string path = directory.file(name);
    EXPECT_EQ(lockstep({"run", file, "--simulate", "--duration", "8s", "--trace", path}).status, 0);
    return path;
  };
  const std::string path = run("a.lcm");
  EXPECT_EQ(content(path), content(run("b.lcm"))) << "the same bytes every time";
  const std::string channel = missing_slide()["trace"]["lcm"]["channel"];
  const Log log(path, channel);
  EXPECT_EQ(log.count("alarm", "Slide"), 2u);
  EXPECT_EQ(log.count("acknowledged", "Slide"), 1u);
  EXPECT_GE(log.count("job started", "lay_down") + log.count("job started", "home"), 1u);
  std::int64_t last = -1;
  for (std::size_t i = 0; i < log.events.size(); ++i) {
    const event_t& event = log.events[i];
    EXPECT_GE(event.t, last);
    last = event.t;
    EXPECT_LT(log.row_times_before[i], event.t) << "the row of its tick comes behind it";
    EXPECT_EQ(event.lost, 0);
    if (event.kind == "alarm") {
      EXPECT_EQ(event.number, 541);
      EXPECT_EQ(event.type, "TO_PositioningAxis");
      EXPECT_EQ(event.reaction, 4);
      EXPECT_EQ(event.reaction_text, "remove the enable");
      EXPECT_FALSE(event.text.empty());
    }
    if (event.kind == "job failed") {
      EXPECT_NE(event.number, 0);
      EXPECT_FALSE(event.text.empty());
    }
  }
}

TEST(EventChannel, EveryJobThatHasStartedHasOneEnd) {
  const Directory directory;
  const std::string path = directory.file("run.lcm");
  ASSERT_EQ(
      lockstep({"run", example("01_positioning"), "--simulate", "--duration", "30s", "--trace", path}).status,
      0);
  const std::string channel = example_json("01_positioning")["trace"]["lcm"]["channel"];
  const Log log(path, channel);
  EXPECT_GE(log.count("job started", "lay_down"), 3u);
  const std::size_t started = log.count("job started", "lay_down");
  const std::size_t ended = log.count("job done", "lay_down") + log.count("job aborted", "lay_down") +
                            log.count("job failed", "lay_down");
  EXPECT_TRUE(ended == started || ended + 1 == started) << started << " started, " << ended << " ended";
}

// ---- Flight recorder

/// The recordings in a folder, the oldest first.
std::vector<std::string> recordings(const std::string& file) {
  std::vector<std::string> paths;
  for (const Recording& recording : Recordings(file).present()) paths.push_back(recording.path);
  return paths;
}

Json recorded_slide(const std::string& file, int files = 10, int keep = 20) {
  Json project = missing_slide();
  project["flight_recorder"] = {
      {"before", "300ms"}, {"after", "100ms"}, {"file", file}, {"files", files}, {"keep", keep}};
  return project;
}

/// Eight seconds with two alarms; the program is started by the words of `before`.
Ended run_slide(const std::string& project, std::vector<std::string> before = {},
                const std::vector<std::string>& options = {}) {
  for (const std::string& word : lockstep_command({"run", project, "--simulate", "--duration", "8s"}))
    before.push_back(word);
  before.insert(before.end(), options.begin(), options.end());
  Process process(before);
  Ended ended;
  ended.status = process.status();
  ended.err = process.err();
  return ended;
}

TEST(FlightRecorder, WritesTheTimeBeforeAnAlarmAndAMomentAfterIt) {
  const Directory directory;
  const std::string file = directory.write("project.json", recorded_slide(directory.file("flight")).dump(1));
  const Ended ended = run_slide(file);
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(lines_with(ended.err, "flight recorder: wrote ").size(), 2u) << ended.err;
  const std::vector<std::string> written = recordings(directory.file("flight"));
  ASSERT_EQ(written.size(), 2u) << ended.err;
  const CsvTable table = read_csv(written[0]);
  const std::size_t raised = table.first("Slide.ErrorDetail.Number", 541.0);
  ASSERT_LT(raised, table.rows);
  const double at = table["t"][raised];
  EXPECT_NEAR(table["t"][0], at - 0.3, 0.005);
  EXPECT_NEAR(table["t"].back(), at + 0.1, 0.005);
  for (std::size_t i = 1; i < table.rows; ++i)
    EXPECT_NEAR(table["t"][i] - table["t"][i - 1], table["t"][1] - table["t"][0], 1e-9)
        << "no row is missing";
  for (const char* name : {"start", "step", "lay_down.Busy", "Slide.Position", "Slide.StatusWord"})
    EXPECT_NE(std::find(table.names.begin(), table.names.end(), name), table.names.end()) << name;
  const Ended plotted = lockstep(
      {"plot", written[0], "-o", directory.file("flight.svg"), "--signals", "Slide.Position,Slide.Velocity"});
  EXPECT_EQ(plotted.status, 0) << plotted.err;
}

TEST(FlightRecorder, StopsAtItsNumberOfFiles) {
  const Directory directory;
  Json project = recorded_slide(directory.file("flight"), 1);
  project["flight_recorder"]["signals"] = {"step", "start"};
  EXPECT_EQ(run_slide(directory.write("project.json", project.dump(1))).status, 0);
  const std::vector<std::string> written = recordings(directory.file("flight"));
  ASSERT_EQ(written.size(), 1u);
  EXPECT_EQ(read_csv(written[0]).names, (std::vector<std::string>{"t", "step", "start"}));
}

TEST(FlightRecorder, ARunWritesNothingOfAnEarlierOneOver) {
  const Directory directory;
  const std::string file = directory.write("project.json", recorded_slide("flight").dump(1));
  EXPECT_EQ(run_slide(file).status, 0);
  const std::vector<std::string> first = recordings(directory.file("flight"));
  ASSERT_EQ(first.size(), 2u);
  const std::string before = content(first[0]);
  EXPECT_EQ(run_slide(file).status, 0);
  const std::vector<std::string> both = recordings(directory.file("flight"));
  ASSERT_EQ(both.size(), 4u);
  EXPECT_EQ(both[0], first[0]);
  EXPECT_EQ(both[1], first[1]);
  EXPECT_EQ(content(both[0]), before);
  EXPECT_EQ(content(both[2]), before) << "the same run gives the same recording";
}

TEST(FlightRecorder, KeepsAsManyAsItIsToldAndTouchesNothingElse) {
  const Directory directory;
  const std::string file = directory.write("project.json", recorded_slide("flight", 10, 1).dump(1));
  const std::vector<std::string> others{"flight_1.csv", "flight_20261123T115200Z_0.csv",
                                        "flight_20261123T115200Z_7.csv.old", "flights_20261123T115200Z_7.csv",
                                        "flight_20261123115200Z_7.csv"};
  for (const std::string& other : others) directory.write(other, "mine");
  directory.write("flight_20991231T235959Z_3.csv", "of a run whose clock was wrong");
  EXPECT_EQ(run_slide(file).status, 0);
  const std::vector<Recording> first = Recordings(directory.file("flight")).present();
  ASSERT_EQ(first.size(), 1u);
  EXPECT_EQ(first[0].number, 5u) << "the second alarm, behind the number that was there";
  EXPECT_EQ(run_slide(file).status, 0);
  const std::vector<Recording> second = Recordings(directory.file("flight")).present();
  ASSERT_EQ(second.size(), 1u);
  EXPECT_EQ(second[0].number, 7u);
  for (const std::string& other : others) EXPECT_EQ(content(directory.file(other)), "mine") << other;
}

TEST(FlightRecorder, ARelativePathIsRelativeToTheProjectFile) {
  const Directory directory, elsewhere;
  std::filesystem::create_directory(directory.file("records"));
  const std::string file = directory.write("project.json", recorded_slide("records/flight").dump(1));
  const Ended ended = run_slide(file, {"env", "-C", elsewhere.file("")});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(recordings(directory.file("records/flight")).size(), 2u) << ended.err;
  EXPECT_TRUE(std::filesystem::is_empty(elsewhere.file("")));
}

TEST(FlightRecorder, InAServiceARelativePathIsRelativeToItsStateDirectory) {
  const Directory directory, state;
  const std::string file = directory.write("project.json", recorded_slide("flight").dump(1));
  const Ended ended = run_slide(file, {"env", "STATE_DIRECTORY=" + state.file("") + ":/var/empty"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(recordings(state.file("flight")).size(), 2u) << ended.err;
  EXPECT_TRUE(recordings(directory.file("flight")).empty());
}

TEST(FlightRecorder, AFullDiskIsToldAndHurtsNothing) {
  const Directory directory;
  const std::string file = directory.write("project.json", recorded_slide("flight").dump(1));
  const std::string trace = directory.file("trace.csv"), other = directory.file("plain.csv");
  // A file may grow to 128 KiB here: a trace of one signal does not come to that, a recording does.
  const Ended ended = run_slide(file, {"prlimit", "--fsize=131072"}, {"--trace", trace, "--signals", "step"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.err.find("File too large"), std::string::npos) << ended.err;
  EXPECT_EQ(recordings(directory.file("flight")).size(), 2u) << "the next alarm finds a file";
  const std::string plain = directory.write("plain.json", missing_slide().dump(1));
  EXPECT_EQ(run_slide(plain, {}, {"--trace", other, "--signals", "step"}).status, 0);
  EXPECT_EQ(content(trace), content(other)) << "the trace is what it is without a flight recorder";
}

TEST(FlightRecorder, AFolderThatIsNotThereIsToldAtTheStartAndHurtsNothing) {
  const Directory directory;
  const std::string file = directory.write("project.json", recorded_slide("nowhere/flight").dump(1));
  const Ended ended = run_slide(file);
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(lines_with(ended.err, "warning: the flight recorder cannot write: ").size(), 1u) << ended.err;
  EXPECT_LT(ended.err.find("cannot write"), ended.err.find("alarm 541")) << ended.err;
  EXPECT_EQ(lines_with(ended.err, "lost in " + directory.file("nowhere/flight")).size(), 1u) << ended.err;
}

// ---- Channels

std::vector<double> times_of(const std::string& path, const std::string& channel,
                             std::vector<std::string>* names = nullptr) {
  LcmTraceReader reader(path, channel);
  std::vector<double> times;
  while (reader.next()) times.push_back(static_cast<double>(reader.row().t) * 1e-9);
  if (names != nullptr)
    for (const TraceSignal& signal : reader.signals()) names->push_back(signal.name);
  return times;
}

TEST(TraceChannels, ShowPartsOfTheTraceEachInItsWay) {
  const Directory directory;
  Json project = missing_slide();
  project["trace"]["channels"] = Json::parse(R"([
    { "channel": "SLOW", "signals": ["Slide.Position"], "every": 50 },
    { "channel": "EDGE", "signals": ["step", "Slide.Velocity"],
      "trigger": { "on": "rising", "signal": "start", "before": "20ms", "after": "30ms" } },
    { "channel": "FALL", "signals": ["step"], "trigger": { "on": "falling", "signal": "start" } },
    { "channel": "FAST", "signals": ["Slide.Velocity"],
      "trigger": { "on": "above", "signal": "Slide.Velocity", "level": 100.0 } },
    { "channel": "TROUBLE", "signals": ["step"], "trigger": { "on": "alarm", "before": "100ms", "after": "50ms" } }
  ])");
  const std::string file = directory.write("project.json", project.dump(1));
  const std::string path = directory.file("run.lcm");
  const Ended ended = lockstep({"run", file, "--simulate", "--duration", "8s", "--trace", path});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const std::string channel = project["trace"]["lcm"]["channel"];
  const std::vector<double> all = times_of(path, channel);
  const double period = all[1] - all[0];
  std::vector<std::string> names;
  const std::vector<double> slow = times_of(path, "SLOW", &names);
  EXPECT_EQ(names, std::vector<std::string>{"Slide.Position"});
  EXPECT_EQ(slow.size(), (all.size() + 49) / 50);
  for (std::size_t i = 0; i < slow.size(); ++i) EXPECT_EQ(slow[i], all[50 * i]);

  const std::vector<double> edge = times_of(path, "EDGE");
  ASSERT_FALSE(edge.empty());
  const auto around = [&](double at, double before, double after) {
    return std::count_if(edge.begin(), edge.end(),
                         [&](double t) { return t >= at - before - 1e-9 && t <= at + after + 1e-9; });
  };
  const auto rows = static_cast<long>(std::lround(0.05 / period)) + 1;
  EXPECT_EQ(around(5.0, 0.02, 0.03), rows);
  EXPECT_EQ(static_cast<long>(edge.size()), rows) << "start is TRUE from the beginning, which is no edge";

  const CsvTable table = simulate(file, "8s", {"--signals", "start,Slide.Velocity,Slide.ErrorDetail.Number"});
  std::size_t fast = 0, falls = 0;
  for (std::size_t i = 1; i < table.rows; ++i) {
    if (table["Slide.Velocity"][i] > 100.0) ++fast;
    if (table["start"][i] < table["start"][i - 1]) ++falls;
  }
  EXPECT_GT(fast, 0u);
  EXPECT_EQ(times_of(path, "FAST").size(), fast);
  EXPECT_EQ(times_of(path, "FALL").size(), falls);

  const std::vector<double> trouble = times_of(path, "TROUBLE");
  const double raised = table["t"][table.first("Slide.ErrorDetail.Number", 541.0)];
  ASSERT_FALSE(trouble.empty());
  EXPECT_NEAR(trouble.front(), raised - 0.1, 2 * period + 1e-9);
  EXPECT_EQ(std::count_if(trouble.begin(), trouble.end(), [&](double t) { return t < raised + 1.0; }),
            static_cast<long>(std::lround(0.15 / period)) + 1);
}

// Of the run in real time, whose time stamps are those of the wall clock.
TEST(TraceChannels, RowsOfOneInstantHaveOneTimeStampOnEveryChannel) {
  const Directory directory;
  Json project = missing_slide();
  project["trace"]["channels"] = Json::parse(R"([{ "channel": "PART", "signals": ["Slide.Position"] }])");
  const std::string file = directory.write("project.json", project.dump(1));
  const std::string path = directory.file("run.lcm");
  const Ended ended = lockstep(
      {"run", file, "--no-modbus", "--no-lcm", "--no-retain", "--duration", "200ms", "--trace", path});
  ASSERT_EQ(ended.status, 0) << ended.err;
  LcmTraceReader whole(path, project["trace"]["lcm"]["channel"]);
  LcmTraceReader part(path, "PART");
  int rows = 0;
  for (; whole.next() && part.next(); ++rows) {
    ASSERT_EQ(whole.row().t, part.row().t);
    ASSERT_EQ(whole.utime(), part.utime());
  }
  EXPECT_GT(rows, 10);
}

}  // namespace
}  // namespace lockstep::test::events_test
