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

TEST(EventTexts, TellValueAndLimitApart) {
  TraceEvent event;
  event.value_name = "following error";
  event.limit_name = "permitted";
  event.unit = "mm";
  event.value = 5.000001;
  event.limit = 5.0;
  ASSERT_FALSE(detail_lines(event).empty());
  EXPECT_EQ(detail_lines(event).front(), "following error 5.000001 mm, permitted 5 mm");
  event.value = 7.25;
  EXPECT_EQ(detail_lines(event).front(), "following error 7.25 mm, permitted 5 mm");
  event.value = 5.0;
  EXPECT_EQ(detail_lines(event).front(), "following error 5 mm, permitted 5 mm");
}

}  // namespace
}  // namespace lockstep::event_texts_test
