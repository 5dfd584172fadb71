// The monitor without a terminal: what comes in and which keys are pressed give lines.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

#include "cli/describe/table.hpp"
#include "cli/monitor/keys.hpp"
#include "cli/monitor/view.hpp"
#include "tests/support/property.hpp"

namespace lockstep::cli::monitor_view_test {
namespace {

using namespace std::chrono_literals;

const std::vector<TraceSignal> kSignals = {{"Knife.Position", Type::LREAL, "u"},
                                           {"Knife.Velocity", Type::LREAL, "u/s"},
                                           {"gear.InSync", Type::BOOL, ""},
                                           {"Conveyor.Position", Type::LREAL, "u"},
                                           {"Länge", Type::DINT, "µm"}};

/// A monitor that hears a knife for some seconds.
class Monitored {
 public:
  explicit Monitored(std::optional<Panel> panel = {})
      : model("udpm://239.255.76.67:7667?ttl=0", std::move(panel)) {
    hear("KNIFE_HEADER", encoder_.header());
  }
  void run(int seconds) {
    for (const std::int64_t end = t_ + seconds * kSecond; t_ < end;) hear("KNIFE", next_row());
  }
  /// Time in which the machine runs and its channel, which awaits a trigger, sends no row.
  void wait(int seconds) {
    for (int i = 0; i < seconds; ++i) {
      now += 1s;
      hear("KNIFE_HEADER", encoder_.header());
    }
  }
  /// Rows that are sent and not heard.
  void lose(int rows) {
    for (int i = 0; i < rows; ++i) next_row();
  }
  /// Cycles that the run leaves out.
  void miss(int cycles) { t_ += cycles * kSecond / 50; }
  bool hear(const std::string& channel, std::span<const std::uint8_t> bytes) {
    return model.accept(channel, bytes, now);
  }
  void event(const std::string& kind, const std::string& source, const std::string& type, double seconds,
             int number = 0, const std::string& text = "", const std::string& channel = "KNIFE") {
    event_t event{};
    event.t = static_cast<std::int64_t>(seconds * 1e9);
    event.kind = kind;
    event.source = source;
    event.type = type;
    event.number = number;
    event.text = text;
    if (kind == "alarm") event.reaction_text = "remove the enable";
    hear(channel + "_EVENTS", encoded(event));
  }
  Wish press(const std::string& keys) {
    Wish wish;
    for (const char key : keys) wish = cli::press(model, {KeyKind::text, std::string(1, key)}, 10, now);
    return wish;
  }
  Wish press(KeyKind kind) { return cli::press(model, {kind, ""}, 10, now); }
  std::vector<ViewLine> lines(ViewSize size = {}, Characters characters = Characters::blocks) const {
    return view(model, now, size, characters);
  }
  std::string text(ViewSize size = {}, Characters characters = Characters::blocks) const {
    std::string text;
    for (const ViewLine& line : lines(size, characters)) {
      std::string stripped = line.text;
      stripped.erase(stripped.find_last_not_of(' ') + 1);
      text += stripped + "\n";
    }
    return text;
  }
  bool shows(const std::string& part) const { return text().find(part) != std::string::npos; }

  Model model;
  Model::Clock::time_point now{1h};

 private:
  static constexpr std::int64_t kSecond = 1'000'000'000;
  std::span<const std::uint8_t> next_row() {
    const double time = static_cast<double>(t_) * 1e-9;
    const Value values[] = {{.r = time * 10.0},
                            {.r = 10.0 * std::sin(time)},
                            {.u = time >= 5.0 ? 1u : 0u},
                            {.r = 0.5},
                            {.i = -3}};
    const auto tick = static_cast<std::uint64_t>(t_ / 1'000'000);
    const std::int64_t t = std::exchange(t_, t_ + kSecond / 50);
    now += 20ms;
    return encoder_.row({t, tick, 0, values});
  }
  LcmEncoder encoder_{{"knife", "KNIFE", kSecond / 50, 0}, kSignals};
  std::int64_t t_ = 0;
};

TEST(MonitorView, ShowsATableWithCurvesPlotJobsAndAlarms) {
  Monitored monitored;
  monitored.run(10);
  monitored.event("job started", "gear", "MC_GearIn", 4.5);
  monitored.event("job started", "move", "MC_MoveAbsolute", 5.0);
  monitored.event("job failed", "move", "MC_MoveAbsolute", 6.25, 0x8002, "position not permitted");
  monitored.event("alarm", "Knife", "TO_SynchronousAxis", 7.5, 541, "target not reached");
  monitored.press("gja");
  monitored.press(KeyKind::down);
  EXPECT_EQ(monitored.text(), R"(lockstep monitor  1 ALARM  udpm://239.255.76.67:7667?ttl=0
KNIFE: knife  t 9.980 s  50 rows/s  age 0.0 s  dropped 0  lost 0
  Knife.Position          99.8000 u             ▁▁▂▃▄▅▆▇█          0       99.8
> Knife.Velocity          -5.2713 u/s           ▅▇▇▃▁▃▇█▅    -9.9997     9.9998
  gear.InSync                TRUE               ▁▁▁▁▅████          0          1
-- Knife.Velocity [u/s]  min -9.9997  max 9.9998
    9.9998 |                                    ▁▆███▆▂               ▅███▇▄
           |                                   ▄█     █▅            ▂██    █▇
           |                                  ▅█       █▆          ▃█        █▁
           |                                  █         █▇        ▄█          █▂
           |                                              █▂     ▅█            █
   -9.9997 |                                               █▅▂▁▃▇█
            -20 s                                                            now
-- jobs heard of: 1 running
     4.500 s  gear  MC_GearIn  running
     6.250 s  move  MC_MoveAbsolute  failed 16#8002 position not permitted


-- alarms heard of: 1 not acknowledged, 0 overruns
     7.500 s  Knife  541: target not reached (remove the enable)  tick 0



/ search  s sort  g plot  j jobs  a alarms  p pause  r record  ? help  q ends
)");
}

TEST(MonitorView, CountsRowsThatWereSentAndDidNotComeNotCyclesThatTheRunHasMissed) {
  Monitored monitored;
  monitored.run(1);
  monitored.miss(7);
  monitored.run(1);
  EXPECT_TRUE(monitored.shows("lost 0\n")) << monitored.text();
  monitored.lose(3);
  monitored.miss(2);
  monitored.run(1);
  EXPECT_TRUE(monitored.shows("lost 3\n")) << monitored.text();
}

TEST(MonitorView, TellsAChannelThatWaitsForItsTriggerFromOneThatIsGone) {
  Monitored monitored;
  monitored.run(1);
  monitored.wait(5);
  EXPECT_TRUE(monitored.shows("KNIFE: knife  WAITING  t 0.980 s")) << monitored.text();
  monitored.run(1);
  EXPECT_TRUE(monitored.shows("KNIFE: knife  t 1.980 s")) << monitored.text();
  monitored.now += 4s;
  EXPECT_TRUE(monitored.shows("KNIFE: knife  SILENT  t 1.980 s")) << monitored.text();
}

TEST(MonitorView, InALocaleWithoutUnicodeShowsTheSameInAscii) {
  Monitored monitored;
  monitored.run(30);
  monitored.press("g");
  monitored.press(KeyKind::last);
  monitored.press(KeyKind::up);
  monitored.press(KeyKind::up);
  EXPECT_EQ(monitored.text({80, 16}, Characters::ascii), R"(lockstep monitor  udpm://239.255.76.67:7667?ttl=0
KNIFE: knife  t 29.980 s  50 rows/s  age 0.0 s  dropped 0  lost 0
  Knife.Position         299.8000 u     __..--===++**##@@        100      299.8
  Knife.Velocity          -9.9092 u/s   _.*@*._=@#=_-#@+_        -10         10
> gear.InSync                TRUE       +++++++++++++++++          1          1
  Conveyor.Position        0.5000 u     +++++++++++++++++        0.5        0.5
  L?nge                        -3 ?m    +++++++++++++++++         -3         -3
-- gear.InSync  min 1  max 1
         1 |
           |
           |********************************************************************
           |
           |
         1 |
            -20 s                                                            now
/ search  s sort  g plot  j jobs  a alarms  p pause  r record  ? help  q ends
)");
}

TEST(MonitorView, FitsAnySize) {
  Monitored monitored(Panel(1));
  monitored.run(3);
  for (int i = 0; i < 300; ++i)
    monitored.event(i % 3 == 0 ? "alarm" : "job started", "Knife" + std::to_string(i), "MC_Power", 1.0, 541,
                    "a long text about what has happened there, which no line of a terminal can hold");
  monitored.press("gja");
  for (const std::size_t height : {1u, 2u, 3u, 7u, 16u, 24u, 80u})
    for (const std::size_t width : {1u, 8u, 20u, 40u, 79u, 80u, 300u})
      for (const Characters characters : {Characters::blocks, Characters::ascii}) {
        const auto lines = monitored.lines({width, height}, characters);
        ASSERT_EQ(lines.size(), height) << width;
        for (const ViewLine& line : lines) ASSERT_LE(shown_width(line.text), width) << line.text;
      }
}

TEST(MonitorView, SearchesWithoutRegardToCaseAndSorts) {
  Monitored monitored;
  monitored.run(2);
  monitored.press("/POSITION");
  EXPECT_TRUE(monitored.shows("/POSITION_"));
  EXPECT_TRUE(monitored.shows("Knife.Position"));
  EXPECT_TRUE(monitored.shows("Conveyor.Position"));
  EXPECT_FALSE(monitored.shows("Knife.Velocity"));
  for (int i = 0; i < 3; ++i) monitored.press(KeyKind::erase);
  monitored.press("xq");
  EXPECT_TRUE(monitored.shows("no signal has 'POSITxq'")) << "a q in a search is a letter\n"
                                                          << monitored.text();
  monitored.press(KeyKind::escape);
  EXPECT_TRUE(monitored.shows("Knife.Velocity"));
  const auto before = [&](const std::string& one, const std::string& other) {
    return monitored.text().find(one) < monitored.text().find(other);
  };
  EXPECT_TRUE(before("Knife.Position", "Conveyor.Position"));
  monitored.press("s");
  EXPECT_TRUE(before("Conveyor.Position", "gear.InSync"));
  EXPECT_TRUE(before("gear.InSync", "Knife.Position"));
  monitored.press("s");
  EXPECT_TRUE(before("Knife.Velocity", "Conveyor.Position")) << "what moves comes first";
  EXPECT_TRUE(before("Knife.Velocity", "gear.InSync"));
}

TEST(MonitorView, ScrollsToTheChosenSignalAndKeepsItWhenTheOrderChanges) {
  Monitored monitored;
  monitored.run(1);
  const ViewSize small{80, 6};
  EXPECT_EQ(monitored.text(small).find("Länge"), std::string::npos);
  monitored.press(KeyKind::page_down);
  EXPECT_NE(monitored.text(small).find("> Länge"), std::string::npos) << monitored.text(small);
  monitored.press("s");
  EXPECT_NE(monitored.text(small).find("> Länge"), std::string::npos);
  monitored.press(KeyKind::first);
  EXPECT_NE(monitored.text(small).find("> Conveyor.Position"), std::string::npos) << monitored.text(small);
}

TEST(MonitorView, APauseStandsWhileEverythingGoesOnBehindIt) {
  Monitored monitored;
  monitored.run(2);
  monitored.press("p");
  const std::string paused = monitored.text();
  EXPECT_NE(paused.find("PAUSED"), std::string::npos);
  monitored.run(3);
  monitored.event("alarm", "Knife", "TO_SynchronousAxis", 4.0, 541, "text");
  EXPECT_EQ(monitored.text(), paused);
  EXPECT_EQ(monitored.model.heard().traces.all().at("KNIFE").rows(), 250u);
  monitored.press("p");
  EXPECT_TRUE(monitored.shows("t 4.980 s"));
  EXPECT_TRUE(monitored.shows("1 ALARM"));
}

TEST(MonitorView, AJobThatHasEndedAndAnAlarmThatIsAcknowledgedAreNoLongerOpen) {
  Monitored monitored;
  monitored.run(1);
  monitored.press("ja");
  monitored.event("job started", "move", "MC_MoveAbsolute", 0.5);
  EXPECT_TRUE(monitored.shows("jobs heard of: 1 running"));
  monitored.event("job done", "move", "MC_MoveAbsolute", 0.75);
  EXPECT_TRUE(monitored.shows("jobs heard of: 0 running"));
  EXPECT_TRUE(monitored.shows("0.750 s  move  MC_MoveAbsolute  done"));
  monitored.event("alarm", "Knife", "TO_SynchronousAxis", 1.0, 541, "text");
  EXPECT_TRUE(monitored.shows("alarms heard of: 1 not acknowledged"));
  monitored.event("acknowledged", "Knife", "TO_SynchronousAxis", 1.5);
  EXPECT_TRUE(monitored.shows("alarms heard of: 0 not acknowledged"));
  EXPECT_TRUE(monitored.shows("1.500 s  Knife  acknowledged"));
  monitored.event("job started", "old", "MC_Home", 2.0);
  monitored.event("job started", "new", "MC_Home", 0.1);
  EXPECT_TRUE(monitored.shows("jobs heard of: 1 running")) << "time has gone back: another run";
  monitored.event("alarm", "x", "y", 1.0, 1, "z", "STRANGER");
  EXPECT_TRUE(monitored.shows("alarms heard of: 0 not acknowledged")) << "no trace of this channel is known";
}

TEST(MonitorView, HelpTellsEveryKey) {
  Monitored monitored;
  monitored.press("?");
  for (const char* const key : {"/   ", "s   ", "g   ", "p   ", "r   ", "q or Ctrl-C", "e d", "< >", "[ ]"})
    EXPECT_TRUE(monitored.shows(key)) << key;
  monitored.press("?");
  EXPECT_TRUE(monitored.shows("KNIFE: knife  no rows yet"));
  EXPECT_NE(view(Model("memq://"), monitored.now, {}, Characters::blocks)[1].text.find("no trace heard yet"),
            std::string::npos);
}

panel_t axis_state(const std::string& name = "Knife") {
  panel_t state{};
  state.run = 7;
  state.beat = 40;
  state.status_word = 0x21;  // enabled, homed
  state.enables = 1;
  state.has_position = 1;
  state.position = 12.5;
  state.speed = 95.0;
  state.jog_velocity = 50.0;
  state.axis = name;
  state.velocity_unit = "u/s";
  return state;
}

TEST(MonitorPanel, WithoutItNoKeyCommandsAnything) {
  Monitored monitored;
  monitored.run(1);
  monitored.hear("KNIFE_PANEL", encoded(axis_state()));
  for (int letter = 0x20; letter < 0x7F; ++letter) {
    if (letter == '/') continue;  // what follows would be a search
    EXPECT_FALSE(monitored.press(std::string(1, static_cast<char>(letter))).command) << letter;
  }
  for (const KeyKind kind : {KeyKind::left, KeyKind::right, KeyKind::tab, KeyKind::enter})
    EXPECT_FALSE(monitored.press(kind).command);
  EXPECT_FALSE(monitored.shows("PANEL"));
}

TEST(MonitorPanel, SaysThatItIsActiveAndSendsWhatTheKeysMean) {
  Monitored monitored(Panel(99));
  EXPECT_TRUE(monitored.shows("PANEL ACTIVE  no run is heard that takes commands"));
  EXPECT_TRUE(
      monitored.shows("Tab axis  e d on/off  left right jog  Space stop  h home  x reset  [] ovr ? help"));
  EXPECT_FALSE(monitored.press("e").command);
  EXPECT_TRUE(monitored.shows("nothing was sent"));
  monitored.run(1);
  monitored.hear("KNIFE_PANEL", encoded(axis_state()));
  EXPECT_TRUE(monitored.shows("PANEL ACTIVE  Knife: enabled, homed  12.5000")) << monitored.text();
  const auto sent = [&](const Wish& wish, std::int32_t action, double value) {
    ASSERT_TRUE(wish.command);
    EXPECT_EQ(wish.command->channel, "KNIFE_CMD");
    EXPECT_EQ(wish.command->command.action, action);
    EXPECT_DOUBLE_EQ(wish.command->command.value, value);
    EXPECT_EQ(wish.command->command.axis, "Knife");
    EXPECT_EQ(wish.command->command.run, 7);
    EXPECT_EQ(wish.command->command.beat, 40);
    EXPECT_EQ(wish.command->command.sender, 99);
  };
  sent(monitored.press("e"), command_t::ENABLE, 0.0);
  sent(monitored.press("d"), command_t::DISABLE, 0.0);
  sent(monitored.press("x"), command_t::RESET, 0.0);
  sent(monitored.press(" "), command_t::STOP, 0.0);
  sent(monitored.press("["), command_t::OVERRIDE, 85.0);
  sent(monitored.press("]"), command_t::OVERRIDE, 105.0);
  sent(monitored.press(KeyKind::left), command_t::JOG_BACKWARD, 5.0);
  monitored.press(">");
  const Wish jog = monitored.press(KeyKind::right);
  sent(jog, command_t::JOG_FORWARD, 12.5);
  EXPECT_GT(jog.command->command.sequence, 7);
  monitored.press("h");
  EXPECT_TRUE(monitored.shows("position of Knife is: _"));
  EXPECT_FALSE(monitored.press("-2.5e").command) << "an e in a number enables nothing";
  monitored.press(KeyKind::erase);
  sent(monitored.press(KeyKind::enter), command_t::HOME, -2.5);
  monitored.press("hq");
  EXPECT_FALSE(monitored.press(KeyKind::enter).command);
  EXPECT_TRUE(monitored.shows("'q' is no number"));
  monitored.press("h1");
  monitored.press(KeyKind::escape);
  EXPECT_FALSE(monitored.press(KeyKind::enter).command);
}

TEST(MonitorPanel, ShowsTheJogAndTheWholeReasonOfARefusalOnANarrowTerminalToo) {
  Monitored monitored(Panel(1));
  monitored.run(1);
  panel_t state = axis_state();
  state.enables = 0;
  state.position = -12345.6789;
  monitored.hear("KNIFE_PANEL", encoded(state));
  monitored.event("command refused", "Knife", "enable", 3.0, 0,
                  "a program enables and disables this axis, by its instance power_of_the_knife");
  EXPECT_TRUE(
      monitored.shows("PANEL ACTIVE  Knife: enabled by a program, homed  -12345.6789 u  0.000 u/s\n"
                      "    ovr 95 %  jog 10 % (5 u/s)\n"))
      << monitored.text();
  EXPECT_TRUE(monitored.shows("by its instance power_of_the_knife\n")) << monitored.text();
  const std::size_t lines = monitored.lines().size();
  EXPECT_EQ(lines, ViewSize{}.height);
  EXPECT_NE(monitored.text({140, 30}).find("homed  -12345.6789 u  0.000 u/s  ovr 95 %  jog 10 % (5 u/s)\n"),
            std::string::npos);
  EXPECT_EQ(monitored.lines({10, 30}).size(), 30u) << "a name that is wider than the terminal is cut";
}

TEST(MonitorPanel, TurnsASpeedAxisAndSaysThatItHasNoPositionToSet) {
  Monitored monitored(Panel(1));
  monitored.run(1);
  panel_t fan = axis_state("Fan");
  fan.status_word = 1;
  fan.has_position = 0;
  fan.velocity = 300.0;
  fan.velocity_unit = "1/min";
  monitored.hear("KNIFE_PANEL", encoded(fan));
  EXPECT_TRUE(monitored.shows("PANEL ACTIVE  Fan: enabled  300.000 1/min  ovr 95 %  jog 10 % (5 1/min)\n"))
      << monitored.text();
  EXPECT_EQ(monitored.press(KeyKind::right).command->command.value, 5.0);
  monitored.press("h");
  EXPECT_TRUE(monitored.shows("Fan is a speed axis: it has no position to set; nothing was sent"))
      << monitored.text();
  monitored.press("1");
  EXPECT_FALSE(monitored.press(KeyKind::enter).command) << "no position was asked for";
}

TEST(MonitorPanel, ChoosesAxesAndSendsNothingToOneThatIsSilent) {
  Monitored monitored(Panel(1));
  monitored.run(1);
  monitored.hear("KNIFE_PANEL", encoded(axis_state("Feeder")));
  monitored.hear("KNIFE_PANEL", encoded(axis_state("Knife")));
  EXPECT_TRUE(monitored.shows("PANEL ACTIVE  Feeder"));
  monitored.press(KeyKind::tab);
  EXPECT_EQ(monitored.press("e").command->command.axis, "Knife");
  monitored.event("command refused", "Knife", "enable", 3.0, 0, "too old");
  EXPECT_TRUE(monitored.shows("Knife: enable REFUSED: too old"));
  monitored.now += 1500ms;
  EXPECT_TRUE(monitored.shows("SILENT"));
  EXPECT_FALSE(monitored.press("e").command);
  EXPECT_FALSE(monitored.press(KeyKind::right).command);
}

TEST(MonitorModel, BearsAnyMessageAndKeepsNoMoreThanItMay) {
  std::mt19937 random(test::seed_of_test(20261122));
  Monitored monitored(Panel(1));
  monitored.press("gja");
  for (int i = 0; i < test::cases(600, 60'000); ++i) {
    const std::string channel = "X" + std::to_string(random() % 150);
    LcmEncoder encoder({"\033[2J", channel, 1, 0},
                       std::vector<TraceSignal>(random() % 60, kSignals[random() % 5]));
    monitored.hear(channel + "_HEADER", encoder.header());
    panel_t state = axis_state(channel + "\033[1m");
    monitored.hear(channel + "_PANEL", encoded(state));
    monitored.event(i % 2 == 0 ? "job started" : "alarm", "\007" + std::to_string(random()), "\r", i, 1, "\n",
                    channel);
    std::vector<std::uint8_t> bytes(random() % 200);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    for (const char* const end : {"", "_HEADER", "_EVENTS", "_PANEL"}) monitored.hear(channel + end, bytes);
    if (i % 100 != 0) continue;
    for (const ViewLine& line : monitored.lines({60, 40}))
      for (const char c : line.text)
        ASSERT_FALSE(static_cast<unsigned char>(c) < 0x20 || c == 0x7F) << line.text;
  }
  EXPECT_LE(monitored.model.heard().traces.all().size(), HeardTraces::kMaximum);
  EXPECT_LE(monitored.model.panel->axes().size(), Panel::kMaximumAxes);
  EXPECT_LE(monitored.model.heard().events.running().size(), HeardEvents::kMaximumJobs);
}

TEST(MonitorHistory, KeepsLeastAndGreatestOfAMinute) {
  History history;
  EXPECT_FALSE(history.whole(60 * 1'000'000'000LL));
  for (std::int64_t t = 0; t < 120'000; ++t)  // [ms]
    history.add(t * 1'000'000, t == 100'050 ? 99.0 : static_cast<double>(t % 2));
  const auto minute = history.whole(60'000'000'000);
  ASSERT_TRUE(minute);
  EXPECT_EQ(minute->minimum, 0.0);
  EXPECT_EQ(minute->maximum, 99.0) << "a peak of one value is seen";
  EXPECT_EQ(history.whole(10'000'000'000)->maximum, 1.0);
  const auto parts = history.parts(60'000'000'000, 60);
  EXPECT_EQ(parts[40]->maximum, 99.0);
  EXPECT_EQ(parts[39]->maximum, 1.0);
  history.add(5'000'000'000, 3.0);
  EXPECT_EQ(history.whole(60'000'000'000)->maximum, 3.0) << "another run";
  history.add(6'000'000'000, std::nan(""));
  history.add(7'000'000'000, HUGE_VAL);
  EXPECT_EQ(history.whole(60'000'000'000)->maximum, 3.0);
}

}  // namespace
}  // namespace lockstep::cli::monitor_view_test
