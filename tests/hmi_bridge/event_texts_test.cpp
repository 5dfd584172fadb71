// Events in words.
#include <gtest/gtest.h>

#include "hmi_bridge/traces/event.hpp"

namespace lockstep::event_texts_test {
namespace {

TEST(EventTexts, TellOfMissedTicksThatAnAlarmMayComeFrom) {
  Controller controller;
  controller.add_axis(ObjectKind::TO_PositioningAxis, "Slide");
  const EventTexts texts(controller);
  Event event{.kind = EventKind::alarm, .number = 521};
  const std::string plain = texts.of(event, 0).text;
  EXPECT_FALSE(plain.empty());
  event.late = true;
  EXPECT_EQ(texts.of(event, 0).text,
            plain + "; ticks were missed within the second before, which it may come from");
  event.kind = EventKind::acknowledged;
  EXPECT_EQ(texts.of(event, 0).text, "") << "nobody looks for its cause";
}

}  // namespace
}  // namespace lockstep::event_texts_test
