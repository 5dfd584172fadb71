#include <gtest/gtest.h>

#include <vector>

#include "tech_objects/alarms/notes.hpp"

namespace lockstep::alarm_notes_test {
namespace {

std::vector<int> numbers(AlarmNotes& notes) {
  std::vector<int> all;
  notes.take([&](const AlarmNote& note) { all.push_back(note.number); });
  return all;
}

TEST(AlarmNotes, TellEachAlarmOnceUntilItIsAcknowledged) {
  AlarmNotes notes;
  EXPECT_FALSE(notes.any());
  notes.raised(541, 4);
  notes.raised(541, 4);
  notes.raised(501, 0);
  EXPECT_EQ(numbers(notes), (std::vector<int>{541, 501}));
  notes.raised(541, 4);
  EXPECT_FALSE(notes.any());
  notes.acknowledged();
  notes.acknowledged();
  notes.raised(541, 4);
  EXPECT_EQ(numbers(notes), (std::vector<int>{0, 541}));
}

TEST(AlarmNotes, KeepWhatIsAtHandWhenAnAlarmComes) {
  AlarmNotes notes;
  notes.raised(533, 2, {.cause = AlarmCause::positive_side, .value = 99.5, .limit = 100.0});
  notes.raised(533, 2, {.cause = AlarmCause::negative_side, .value = 1.0, .limit = 2.0});
  notes.take([](const AlarmNote& note) {
    EXPECT_EQ(note.detail.cause, AlarmCause::positive_side);
    EXPECT_EQ(note.detail.value, 99.5);
    EXPECT_EQ(note.detail.limit, 100.0);
  });
}

TEST(AlarmNotes, AcknowledgeNothingWithoutAnAlarm) {
  AlarmNotes notes;
  notes.acknowledged();
  EXPECT_FALSE(notes.any());
}

TEST(AlarmNotes, CountWhatDoesNotFit) {
  AlarmNotes notes;
  for (int number = 1; number <= 10; ++number) notes.raised(number, 0);
  EXPECT_EQ(numbers(notes).size(), 8u);
  EXPECT_EQ(notes.lost(), 2u);
  EXPECT_FALSE(notes.any());
}

}  // namespace
}  // namespace lockstep::alarm_notes_test
