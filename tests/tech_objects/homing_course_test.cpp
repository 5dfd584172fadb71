#include "tech_objects/axis/homing_course.hpp"

#include <gtest/gtest.h>

namespace lockstep::homing_course_test {
namespace {

using Kind = HomingCourse::Leg::Kind;
using Phase = HomingCourse::Phase;

HomingCourse begun(Phase phase, int direction = 1, bool positive_side = false) {
  HomingCourse course;
  course.begin({.direction = direction,
                .approach_velocity = 200.0,
                .referencing_velocity = 50.0,
                .positive_side = positive_side},
               phase);
  return course;
}

// The switch is met, or left.
void see_switch(HomingCourse& course, bool on) {
  course.pass(0.0, on, std::nullopt);
}

TEST(HomingCourse, GoesFromTheSwitchOnToTheMarkWithTheReferencingVelocity) {
  HomingCourse course = begun(Phase::approach);
  EXPECT_EQ(course.velocity(), 200.0);
  EXPECT_EQ(course.guide(HomingMark::zero_mark_after_cam, 1, false).kind, Kind::goes_on);
  see_switch(course, true);
  const auto leg = course.guide(HomingMark::zero_mark_after_cam, 1, false);
  EXPECT_EQ(leg.kind, Kind::begins);
  EXPECT_EQ(leg.phase, Phase::search);
  EXPECT_EQ(leg.direction, 1);
  course.enter(leg.phase);
  EXPECT_EQ(course.velocity(), 50.0);
}

TEST(HomingCourse, LeavesAnEdgeBehindThatIsMetFromOutside) {
  HomingCourse course = begun(Phase::approach, 1, false);
  see_switch(course, true);
  const auto clear = course.guide(HomingMark::switch_edge, 1, false);
  EXPECT_EQ(clear.phase, Phase::clear);
  EXPECT_EQ(clear.direction, -1);
  course.enter(clear.phase);
  EXPECT_EQ(course.guide(HomingMark::switch_edge, -1, false).kind, Kind::goes_on);
  see_switch(course, false);
  EXPECT_EQ(course.guide(HomingMark::switch_edge, -1, false).phase, Phase::search);
}

TEST(HomingCourse, ReversesAtALimitSwitchOnce) {
  HomingCourse course = begun(Phase::approach);
  const auto leg = course.guide(HomingMark::switch_edge, 1, true);
  EXPECT_EQ(leg.phase, Phase::approach);
  EXPECT_EQ(leg.direction, -1);
  EXPECT_EQ(course.guide(HomingMark::switch_edge, -1, true).kind, Kind::gives_up);
}

TEST(HomingCourse, LooksForAZeroMarkBeyondALimitSwitchAndMeetsItInTheHomingDirection) {
  HomingCourse course = begun(Phase::search);
  const auto leg = course.guide(HomingMark::zero_mark, 1, true);
  EXPECT_EQ(leg.phase, Phase::back);
  EXPECT_EQ(leg.search, -1);
}

TEST(HomingCourse, GivesUpAtALimitSwitchWhereItLooksForAnEdge) {
  HomingCourse course = begun(Phase::search);
  EXPECT_EQ(course.guide(HomingMark::switch_edge, 1, true).kind, Kind::gives_up);
}

TEST(HomingCourse, ThatHasEndedSeeksNothing) {
  HomingCourse course = begun(Phase::search);
  EXPECT_TRUE(course.seeks());
  course.end();
  EXPECT_FALSE(course.active());
  EXPECT_FALSE(course.searching());
}

}  // namespace
}  // namespace lockstep::homing_course_test
