// Commands of panels: what is let through into the cycle, what is refused, and what is told of it.
#include "hmi_bridge/lcm/command_desk.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/property.hpp"

namespace lockstep::command_desk_test {
namespace {

using namespace std::chrono_literals;

constexpr std::int64_t kRun = 0x123456789ABCDEF;
constexpr double kFastest = 50.0;

/// What the cycle sees of one axis.
struct Cycle {
  BOOL enable{}, forward{}, backward{};
  UDINT beat{}, homings{}, resets{}, overrides{}, alarm{}, stops{}, starts{};
  LREAL program{}, velocity{}, position{}, override_value{}, actual{}, speed{}, override_now = 100.0;
  DWORD status{};

  std::vector<Signal> signals() {
    return {{&enable, Type::BOOL, -1},     {&forward, Type::BOOL, -1},   {&backward, Type::BOOL, -1},
            {&beat, Type::UDINT, -1},      {&velocity, Type::LREAL, -1}, {&homings, Type::UDINT, -1},
            {&position, Type::LREAL, -1},  {&resets, Type::UDINT, -1},   {&override_value, Type::LREAL, -1},
            {&overrides, Type::UDINT, -1}, {&stops, Type::UDINT, -1},    {&program, Type::LREAL, -1},
            {&starts, Type::UDINT, -1},    {&status, Type::DWORD, -1},   {&alarm, Type::UDINT, -1},
            {&actual, Type::LREAL, -1},    {&speed, Type::LREAL, -1},    {&override_now, Type::LREAL, -1}};
  }
};

class Commands : public testing::Test {
 protected:
  Commands() { desk_.beat(); }

  static std::vector<CommandAxis> axes(Cycle& knife, Cycle& feeder) {
    return {{"Knife", kFastest, "", knife.signals()}, {"Feeder", kFastest, "power", feeder.signals()}};
  }
  static std::vector<Signal> all(Cycle& knife, Cycle& feeder) {
    std::vector<Signal> signals = knife.signals();
    for (const Signal& signal : feeder.signals()) signals.push_back(signal);
    return signals;
  }

  command_t command(std::int32_t action, double value = 0.0, const std::string& axis = "Knife") {
    command_t command{};
    command.run = kRun;
    command.beat = desk_.panel(0).beat;
    command.sender = 1;
    command.sequence = ++sequence_;
    command.action = action;
    command.value = value;
    command.axis = axis;
    return command;
  }
  std::optional<CommandDesk::Answer> give(const command_t& command) {
    const auto answer = desk_.accept(encoded(command), now_);
    image_.take_writes();
    return answer;
  }
  /// Why it is refused; empty if it is not, or not told.
  std::string refusal(const command_t& command) {
    const auto answer = give(command);
    return answer && !answer->accepted ? answer->reason : "";
  }
  bool accepted(const command_t& command) {
    const std::uint64_t before = desk_.counters().accepted;
    give(command);
    return desk_.counters().accepted == before + 1;
  }

  Cycle knife_, feeder_;
  ProcessImage image_{all(knife_, feeder_)};
  CommandDesk desk_{axes(knife_, feeder_), image_, kRun};
  CommandDesk::Clock::time_point now_{1h};
  std::int64_t sequence_ = 0;
};

// Anybody on the network can send in the name of a panel, with the highest of all sequences.
TEST_F(Commands, ThatStopOrDisableCannotBeTakenAwayByAForgedSequence) {
  EXPECT_TRUE(accepted(command(command_t::ENABLE)));
  EXPECT_TRUE(accepted(command(command_t::JOG_FORWARD, 1.0)));
  command_t forged = command(command_t::RESET);
  forged.sequence = std::numeric_limits<std::int64_t>::max();
  EXPECT_TRUE(accepted(forged));
  EXPECT_EQ(refusal(command(command_t::JOG_FORWARD, 1.0)), "repeated, or overtaken by a later one");
  EXPECT_TRUE(knife_.forward);
  EXPECT_TRUE(accepted(command(command_t::STOP)));
  EXPECT_FALSE(knife_.forward);
  EXPECT_TRUE(accepted(command(command_t::DISABLE)));
  EXPECT_FALSE(knife_.enable);
}

// A jog that hung on its way does not go on behind a stop.
TEST_F(Commands, OfAJogThatTheStopOvertookDoNothing) {
  EXPECT_TRUE(accepted(command(command_t::ENABLE)));
  const command_t late = command(command_t::JOG_FORWARD, 1.0);
  EXPECT_TRUE(accepted(command(command_t::STOP)));
  EXPECT_EQ(refusal(late), "repeated, or overtaken by a later one");
  EXPECT_FALSE(knife_.forward);
}

TEST_F(Commands, EnterTheCycleAtTheNextTick) {
  const auto answer = give(command(command_t::ENABLE));
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->accepted);
  EXPECT_EQ(answer->axis, "Knife");
  EXPECT_EQ(answer->action, "enable");
  EXPECT_TRUE(knife_.enable);
  give(command(command_t::JOG_FORWARD, 12.5));
  EXPECT_TRUE(knife_.forward);
  EXPECT_FALSE(knife_.backward);
  EXPECT_EQ(knife_.velocity, 12.5);
  EXPECT_EQ(knife_.beat, 1u);
  give(command(command_t::JOG_BACKWARD, kFastest));
  EXPECT_FALSE(knife_.forward);
  EXPECT_TRUE(knife_.backward);
  EXPECT_EQ(knife_.beat, 2u);
  give(command(command_t::STOP));
  EXPECT_FALSE(knife_.forward || knife_.backward);
  EXPECT_TRUE(knife_.enable);
  give(command(command_t::HOME, -3.5));
  EXPECT_EQ(knife_.homings, 1u);
  EXPECT_EQ(knife_.position, -3.5);
  give(command(command_t::RESET));
  EXPECT_EQ(knife_.resets, 1u);
  give(command(command_t::OVERRIDE, 30.0));
  EXPECT_EQ(knife_.overrides, 1u);
  EXPECT_EQ(knife_.override_value, 30.0);
  give(command(command_t::JOG_FORWARD, 1.0));
  give(command(command_t::DISABLE));
  EXPECT_FALSE(knife_.enable || knife_.forward) << "disabling ends a jog";
  EXPECT_FALSE(feeder_.enable || feeder_.forward || feeder_.beat != 0) << "the other axis is left alone";
}

TEST_F(Commands, OfHomingAreRefusedToASpeedAxisAndTheOthersAreNot) {
  Cycle fan;
  ProcessImage image(fan.signals());
  CommandDesk desk({{"Fan", kFastest, "", fan.signals(), "TO_SpeedAxis", "1/min", false}}, image, kRun);
  desk.beat();
  const auto give_fan = [&](std::int32_t action, double value) {
    const auto answer = desk.accept(encoded(command(action, value, "Fan")), now_);
    image.take_writes();
    return answer.value_or(CommandDesk::Answer{});
  };
  const CommandDesk::Answer homed = give_fan(command_t::HOME, 3.0);
  EXPECT_FALSE(homed.accepted);
  EXPECT_EQ(homed.action, "home");
  EXPECT_EQ(homed.reason,
            "a TO_SpeedAxis has no position that could be set; allowed: enable, disable, stop, jog, reset, "
            "override");
  EXPECT_EQ(fan.homings, 0u);
  EXPECT_EQ(desk.counters().not_valid, 1u);
  EXPECT_TRUE(give_fan(command_t::ENABLE, 0.0).accepted);
  EXPECT_TRUE(give_fan(command_t::JOG_FORWARD, 20.0).accepted);
  EXPECT_TRUE(give_fan(command_t::RESET, 0.0).accepted);
  EXPECT_TRUE(give_fan(command_t::OVERRIDE, 50.0).accepted);
  EXPECT_TRUE(fan.enable && fan.forward && fan.resets == 1 && fan.overrides == 1);
  const auto state = decode_panel(encoded(desk.panel(0)));
  ASSERT_TRUE(state);
  EXPECT_EQ(state->type, "TO_SpeedAxis");
  EXPECT_EQ(state->velocity_unit, "1/min");
  EXPECT_EQ(state->has_position, 0);
  EXPECT_EQ(desk_.panel(0).has_position, 1);
}

TEST_F(Commands, OfAnotherRunOldOnesAndRepeatedOnesAreRefused) {
  command_t other = command(command_t::ENABLE);
  other.run ^= 1;
  EXPECT_NE(refusal(other).find("another run"), std::string::npos);
  const command_t old = command(command_t::ENABLE);
  for (int i = 0; i <= CommandDesk::kOldestBeat; ++i) desk_.beat();
  EXPECT_NE(refusal(old).find("too old"), std::string::npos);
  command_t future = command(command_t::ENABLE);
  ++future.beat;
  EXPECT_NE(refusal(future).find("too old"), std::string::npos);
  const command_t once = command(command_t::RESET);
  EXPECT_TRUE(accepted(once));
  EXPECT_NE(refusal(once).find("repeated"), std::string::npos);
  EXPECT_EQ(knife_.resets, 1u);
  EXPECT_FALSE(knife_.enable);
  EXPECT_EQ(desk_.counters().stale, 4u);
}

TEST_F(Commands, UnknownAxesActionsAndValuesAreRefused) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal(command(command_t::ENABLE, 0.0, "Conveyor")).find("no axis"), std::string::npos);
  for (const std::int32_t action : {-1, 9, 2147483647})
    EXPECT_NE(refusal(command(action)).find("allowed: 0 to 8"), std::string::npos) << action;
  for (const double value : {0.0, -1.0, kFastest * 1.001, kNan, kInfinity})
    for (const int action : {+command_t::JOG_FORWARD, +command_t::JOG_BACKWARD})
      EXPECT_FALSE(accepted(command(action, value))) << value;
  for (const double value : {1.1e12, -kInfinity, kNan})
    EXPECT_FALSE(accepted(command(command_t::HOME, value))) << value;
  for (const double value : {-0.5, 200.5, kNan, kInfinity})
    EXPECT_FALSE(accepted(command(command_t::OVERRIDE, value))) << value;
  EXPECT_EQ(desk_.counters().accepted, 0u);
  EXPECT_EQ(knife_.beat + knife_.homings + knife_.overrides, 0u);
  EXPECT_EQ(desk_.counters().not_valid, desk_.counters().refused());
}

TEST_F(Commands, EnablingIsLeftToAProgramThatDoesIt) {
  EXPECT_NE(refusal(command(command_t::ENABLE, 0.0, "Feeder")).find("instance power"), std::string::npos);
  EXPECT_NE(refusal(command(command_t::DISABLE, 0.0, "Feeder")).find("instance power"), std::string::npos);
  EXPECT_TRUE(accepted(command(command_t::JOG_FORWARD, 1.0, "Feeder")));
  EXPECT_EQ(desk_.panel(0).enables, 1);
  EXPECT_EQ(desk_.panel(1).enables, 0);
}

TEST_F(Commands, OnePanelJogsAnAxisAndAnyMayStopIt) {
  EXPECT_TRUE(accepted(command(command_t::JOG_FORWARD, 1.0)));
  now_ += 100ms;
  command_t other = command(command_t::JOG_BACKWARD, 1.0);
  other.sender = 2;
  EXPECT_NE(refusal(other).find("another panel"), std::string::npos);
  EXPECT_TRUE(knife_.forward);
  other = command(command_t::STOP);
  other.sender = 2;
  EXPECT_TRUE(accepted(other));
  EXPECT_FALSE(knife_.forward);
  EXPECT_TRUE(accepted(command(command_t::JOG_FORWARD, 1.0)));
  now_ += CommandDesk::kHold;
  other = command(command_t::JOG_BACKWARD, 1.0);
  other.sender = 2;
  EXPECT_TRUE(accepted(other)) << "the first one has let go";
}

// A page: its button is held down, and let go by a stop.
class PageCommands : public Commands {
 protected:
  /// @return why it is refused; empty: it is not
  std::string give_page(std::int32_t action, std::int64_t page = 1) {
    command_t given = command(action, 1.0);
    given.sender = page;
    const CommandDesk::Verdict verdict = desk_.give(given, now_, CommandRoute::studio);
    image_.take_writes();
    return verdict.reason;
  }
  std::string jog(std::int64_t page = 1) { return give_page(command_t::JOG_FORWARD, page); }
  std::string stop(std::int64_t page = 1) { return give_page(command_t::STOP, page); }
};

TEST_F(PageCommands, TakeNoJogUpAgainThatSilenceHasEnded) {
  EXPECT_EQ(jog(), "");
  now_ += CommandDesk::kHold - 1ms;
  EXPECT_EQ(jog(), "");
  now_ += CommandDesk::kHold;
  const UDINT beat = knife_.beat;
  for (int i = 0; i < 5; ++i) {
    EXPECT_NE(jog().find("300 ms of silence have ended this motion"), std::string::npos);
    EXPECT_NE(give_page(command_t::JOG_BACKWARD).find("300 ms of silence"), std::string::npos);
    now_ += 100ms;
  }
  EXPECT_EQ(knife_.beat, beat) << "nothing of it reaches the cycle, which has ended the motion";
  EXPECT_EQ(stop(), "");
  EXPECT_EQ(jog(), "") << "let go, and pressed anew";
  EXPECT_EQ(knife_.beat, beat + 1);
}

TEST_F(PageCommands, TakeNoJogUpAgainThatAnotherHasStopped) {
  EXPECT_EQ(jog(1), "");
  now_ += 100ms;
  EXPECT_EQ(stop(2), "");
  EXPECT_FALSE(knife_.forward);
  now_ += 100ms;
  EXPECT_NE(jog(1).find("somebody else has stopped this motion"), std::string::npos);
  EXPECT_FALSE(knife_.forward);
  EXPECT_EQ(jog(2), "") << "only whom it was taken from has to let go";
  EXPECT_EQ(stop(2), "");
  EXPECT_NE(jog(1).find("somebody else"), std::string::npos);
  EXPECT_EQ(stop(1), "");
  EXPECT_EQ(jog(1), "");
  EXPECT_TRUE(knife_.forward);
}

TEST_F(PageCommands, TakeNoJogUpAgainBehindAnotherPanelsTurn) {
  EXPECT_EQ(jog(1), "");
  now_ += CommandDesk::kHold;
  EXPECT_EQ(jog(2), "") << "the first one is silent";
  EXPECT_EQ(stop(2), "");
  EXPECT_FALSE(knife_.forward);
  EXPECT_NE(jog(1), "") << "late";
  EXPECT_FALSE(knife_.forward);
}

TEST_F(Commands, AJogIsToldOnceNotWithEachRepetition) {
  EXPECT_TRUE(give(command(command_t::JOG_FORWARD, 1.0)));
  for (int i = 0; i < 5; ++i) {
    now_ += 100ms;
    EXPECT_FALSE(give(command(command_t::JOG_FORWARD, 1.0)));
  }
  EXPECT_EQ(knife_.beat, 6u);
  now_ += 400ms;
  EXPECT_TRUE(give(command(command_t::JOG_FORWARD, 1.0)));
}

TEST_F(Commands, AFloodIsHeldBackCountedAndToldAFewTimesOnlyAndStopsGetThrough) {
  int told = 0;
  for (int i = 0; i < 5000; ++i) told += give(command(command_t::RESET)).has_value() ? 1 : 0;
  EXPECT_EQ(knife_.resets, static_cast<UDINT>(CommandDesk::kMaximumPerSecond));
  EXPECT_EQ(told, CommandDesk::kMaximumPerSecond + CommandDesk::kMaximumTold);
  EXPECT_EQ(desk_.counters().too_many, 5000u - CommandDesk::kMaximumPerSecond);
  EXPECT_TRUE(accepted(command(command_t::STOP)));
  now_ += 1s;
  EXPECT_TRUE(accepted(command(command_t::RESET)));
}

TEST_F(Commands, PanelsThatAreTooManyAreRefusedUntilOthersAreSilent) {
  for (std::size_t i = 0; i < CommandDesk::kMaximumSenders; ++i) {
    command_t one = command(command_t::RESET);
    one.sender = 100 + static_cast<std::int64_t>(i);
    EXPECT_TRUE(accepted(one));
  }
  EXPECT_NE(refusal(command(command_t::RESET)).find("too many panels"), std::string::npos);
  EXPECT_TRUE(accepted(command(command_t::STOP)));
  now_ += 3s;
  EXPECT_TRUE(accepted(command(command_t::RESET)));
}

TEST_F(Commands, AnyBytesAreCountedAndMoveNothing) {
  std::mt19937 random(test::seed_of_test(20261122));
  const auto good = encoded(command(command_t::ENABLE));
  for (std::size_t size = 0; size < good.size(); ++size) desk_.accept(std::span(good).first(size), now_);
  EXPECT_EQ(desk_.counters().malformed, good.size());
  for (int i = 0; i < test::cases(20'000, 2'000'000); ++i) {
    auto bytes = encoded(command(static_cast<std::int32_t>(random() % 8), 1.0));
    for (unsigned times = 1 + random() % 4; times > 0; --times)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    if (random() % 4 == 0) bytes.resize(random() % (bytes.size() + 20));
    desk_.accept(bytes, now_);
    image_.take_writes();
    ASSERT_TRUE(std::isfinite(knife_.velocity) && knife_.velocity <= kFastest && knife_.velocity >= 0.0);
    ASSERT_TRUE(std::isfinite(knife_.position) && std::isfinite(knife_.override_value));
    ASSERT_FALSE(knife_.forward && knife_.backward);
    now_ += 10ms;
  }
  EXPECT_FALSE(feeder_.enable);
}

TEST_F(Commands, ThePanelShowsHowAnAxisStands) {
  knife_.status = static_cast<DWORD>(0x21);
  knife_.alarm = 541;
  knife_.actual = 7.5;
  knife_.speed = -2.0;
  knife_.override_now = 80.0;
  image_.publish(5);
  image_.refresh();
  const auto panel = decode_panel(encoded(desk_.panel(0)));
  ASSERT_TRUE(panel);
  EXPECT_EQ(panel->axis, "Knife");
  EXPECT_EQ(panel->run, kRun);
  EXPECT_EQ(panel->status_word, 0x21);
  EXPECT_EQ(panel->alarm, 541);
  EXPECT_EQ(panel->position, 7.5);
  EXPECT_EQ(panel->velocity, -2.0);
  EXPECT_EQ(panel->speed, 80.0);
  EXPECT_EQ(panel->jog_velocity, kFastest);
}

/// A device whose program is started and stopped.
class ProgramCommands : public Commands {
 protected:
  std::string device_refusal(std::int32_t action, double value = 0.0) {
    command_t asked = command(action, value, "Teddy");
    asked.beat = device_desk_.panel(0).beat;
    const auto answer = device_desk_.accept(encoded(asked), now_);
    device_image_.take_writes();
    return answer && !answer->accepted ? answer->reason : "";
  }

  Cycle teddy_;
  ProcessImage device_image_{teddy_.signals()};
  static CommandAxis device(Cycle& teddy) {
    return {"Teddy", 0.0, "", teddy.signals(), "MCO_305", "", false, true};
  }
  CommandDesk device_desk_{{device(teddy_)}, device_image_, kRun};
};

TEST_F(ProgramCommands, StartAndStopItsProgramAndClearItsErrors) {
  device_desk_.beat();
  EXPECT_EQ(device_refusal(command_t::START_PROGRAM, 7.0), "");
  EXPECT_EQ(teddy_.program, 7.0);
  EXPECT_EQ(teddy_.starts, 1u);
  EXPECT_EQ(teddy_.stops, 0u);
  EXPECT_EQ(device_refusal(command_t::STOP), "");
  EXPECT_EQ(teddy_.stops, 1u);
  EXPECT_EQ(device_refusal(command_t::RESET), "");
  EXPECT_EQ(teddy_.resets, 1u);
  EXPECT_EQ(device_refusal(command_t::START_PROGRAM, -1.0), "");
  EXPECT_EQ(teddy_.starts, 2u);
}

TEST_F(ProgramCommands, RefuseWhatADeviceDoesNotTake) {
  device_desk_.beat();
  constexpr std::int32_t kOfAxes[] = {command_t::DISABLE,      command_t::ENABLE, command_t::JOG_FORWARD,
                                      command_t::JOG_BACKWARD, command_t::HOME,   command_t::OVERRIDE};
  for (const std::int32_t action : kOfAxes)
    EXPECT_NE(device_refusal(action, 1.0).find("allowed: stop, reset, start program"), std::string::npos);
  for (const double number : {-2.0, 128.0, 1.5, std::nan(""), 1e300})
    EXPECT_NE(device_refusal(command_t::START_PROGRAM, number).find("from 0 to 127"), std::string::npos);
  EXPECT_EQ(teddy_.starts, 0u);
  EXPECT_NE(refusal(command(command_t::START_PROGRAM)).find("has no programs"), std::string::npos)
      << "an axis";
}

}  // namespace
}  // namespace lockstep::command_desk_test
