// What the monitor shows of an alarm besides its number.
#include <gtest/gtest.h>

#include "cli/monitor/view.hpp"
#include "hmi_bridge/lcm/messages.hpp"

namespace lockstep::cli {
namespace {

TraceEvent following_error() {
  TraceEvent event;
  event.kind = EventKind::alarm;
  event.t = 7'500'000'000;
  event.tick = 7500;
  event.source = "Knife";
  event.type = "TO_SynchronousAxis";
  event.number = 521;
  event.text = "Following error too large";
  event.reaction_text = "remove the enable";
  event.cause = "it lags";
  event.remedy = "look at it";
  event.address = "sensor 1";
  event.value_name = "following error";
  event.limit_name = "permitted";
  event.value = 1.25;
  event.limit = 0.5;
  event.unit = "mm";
  return event;
}

std::string shown(const Model& model, std::size_t width = 100) {
  std::string text;
  for (const ViewLine& line : view(model, model.heard().at, {width, 30}, Characters::blocks))
    text += line.text.substr(0, line.text.find_last_not_of(' ') + 1) + "\n";
  return text;
}

TEST(MonitorDetails, AnAlarmHasItsValuesItsCauseAndItsRemedyBelowIt) {
  const std::vector<TraceSignal> signals = {{"Knife.Position", Type::LREAL, "mm"}};
  LcmEncoder encoder({"knife", "KNIFE", 1'000'000, 0}, signals);
  Model model("udpm://239.255.76.67:7667?ttl=0");
  const auto now = Model::Clock::now();
  model.accept("KNIFE_HEADER", encoder.header(), now);
  model.alarms = true;
  const TraceEvent event = following_error();
  EXPECT_TRUE(model.accept("KNIFE_EVENTS", encoder.event(event), now));
  EXPECT_EQ(shown(model).find("cause"), std::string::npos) << "not known yet";
  EXPECT_TRUE(model.accept("KNIFE_DETAIL", encoder.detail(event), now));
  EXPECT_NE(shown(model).find("  521: Following error too large (remove the enable)  tick 7500\n"
                              "              following error 1.25 mm, permitted 0.5 mm; sensor 1\n"
                              "              cause: it lags\n"
                              "              remedy: look at it\n"),
            std::string::npos)
      << shown(model);
  TraceEvent other = event;
  other.t += 1;
  other.cause = "of another alarm";
  EXPECT_TRUE(model.accept("KNIFE_DETAIL", encoder.detail(other), now));
  EXPECT_EQ(shown(model).find("of another"), std::string::npos) << "whose event has not been heard";
}

TEST(MonitorDetails, AnAlarmOfARunInRealTimeHasTheTimeOfTheDay) {
  const std::vector<TraceSignal> signals = {{"Knife.Position", Type::LREAL, "mm"}};
  LcmEncoder encoder({"knife", "KNIFE", 1'000'000, 1'700'000'000'000'000}, signals);
  Model model("udpm://239.255.76.67:7667?ttl=0");
  const auto now = Model::Clock::now();
  model.accept("KNIFE_HEADER", encoder.header(), now);
  model.alarms = true;
  EXPECT_TRUE(model.accept("KNIFE_EVENTS", encoder.event(following_error()), now));
  EXPECT_NE(shown(model, 120).find("(remove the enable)  2023-11-14 22:13:27 UTC, tick 7500\n"),
            std::string::npos)
      << shown(model, 120);
  EXPECT_NE(shown(model).find("(remove the enable)  2023-11-14 22:13:27 UTC"), std::string::npos)
      << "the tick is what a narrow terminal cuts off: " << shown(model);
}

TEST(MonitorDetails, DamagedOnesAreRefused) {
  const std::vector<TraceSignal> signals = {{"Knife.Position", Type::LREAL, "mm"}};
  LcmEncoder encoder({"knife", "KNIFE", 1'000'000, 0}, signals);
  Model model("udpm://239.255.76.67:7667?ttl=0");
  const auto now = Model::Clock::now();
  model.accept("KNIFE_HEADER", encoder.header(), now);
  const auto bytes = encoder.detail(following_error());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(model.accept("KNIFE_DETAIL", bytes.first(size), now)) << size;
}

}  // namespace
}  // namespace lockstep::cli
