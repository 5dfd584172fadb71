// Tables of cams as people and spreadsheets write them: what is read, and what is refused with its place.
#include <gtest/gtest.h>

#include <string>

#include "projects/cam_files/file.hpp"

namespace lockstep {
namespace {

LoadedCam read(const std::string& text) {
  return load_cam(text, "", "", kCamPoints);
}

/// The first problem or warning, with its place.
std::string told(const std::string& text) {
  const LoadedCam cam = read(text);
  for (const auto* list : {&cam.problems, &cam.warnings})
    if (!list->empty()) return list->front().place + ": " + list->front().text;
  return "";
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(CamTable, IsReadWithEachSeparatorByteOrderMarkHeaderQuotesAndComments) {
  for (const std::string& text :
       {std::string("0,0\n10,1.25\n20,3\n"), std::string("0\t0\n10\t1.25\n20\t3\n"),
        std::string("0;0\r\n10;1.25\r\n20;3\r\n"),
        std::string("\xEF\xBB\xBF"
                    "0,0\n10,1.25\n20,3\n"),
        std::string("x,y\n0,0\n10,1.25\n20,3\n"), std::string("\"X\";\"Y\"\n\"0\";\"0\"\n10;1.25\n20;3\n"),
        std::string("# a cam; of 2024\n0,0\n  # between\n10,1.25\n\n20,3\n")}) {
    const LoadedCam cam = read(text);
    ASSERT_TRUE(cam.problems.empty()) << text << cam.problems[0].text;
    ASSERT_EQ(cam.definition->cam.points.size(), 3u) << text;
    EXPECT_EQ(cam.definition->cam.points[1].x, 10.0);
    EXPECT_EQ(cam.definition->cam.points[1].y, 1.25);
    EXPECT_TRUE(cam.warnings.empty()) << text;
  }
}

// "10,1,25" is 10 and 1.25 to one, and a velocity of 25 to another.
TEST(CamTable, WithADecimalCommaIsRefusedWhereItStands) {
  EXPECT_TRUE(has(told("0,0\n10,1,25\n20,3\n"), "2:6: the row has 3 values")) << told("0,0\n10,1,25\n20,3\n");
  EXPECT_TRUE(has(told("0,0,0,0\n10,5,1,25\n"), "1:"));
  EXPECT_TRUE(has(told("0,0,0,0\n10,5,1,25\n"), "with a decimal point"));
  EXPECT_TRUE(has(told("0;0\n10;1,25\n"), "2:4: '1,25'")) << told("0;0\n10;1,25\n");
  EXPECT_TRUE(has(told("0;0\n10;1,25\n"), "with a decimal point, not a comma"));
}

TEST(CamTable, WithDerivativesSaysThatTheyDoNotCount) {
  EXPECT_TRUE(has(told("0,0,0,0,0\n10,1,0.2,0,0\n20,3,0,0,0\n"),
                  "1:5: velocity, acceleration and jerk are not read"));
}

TEST(CamTable, WithOtherColumnsIsRefused) {
  EXPECT_TRUE(has(told("y,x\n0,0\n10,1\n"), "1:1: 'y' is not allowed here; allowed in the first row"))
      << told("y,x\n0,0\n10,1\n");
  EXPECT_TRUE(has(told("angle,stroke\n0,0\n10,1\n"), "1:1: 'angle'"));
  EXPECT_TRUE(has(told("x\n0,0\n10,1\n"), "1:1: 'x'"));
}

TEST(CamTable, KeepsTheOriginOfItsSegments) {
  const std::string row = "S,350,355,0,0,0,4,-1.2,0.096,0,0,0,0";
  const LoadedCam with = read("S,0,350,0\n");
  EXPECT_FALSE(with.problems.empty());
  const LoadedCam cam = read("I,1,0\nS,0,350,0,0,0,0,0,0,0,0,0,0\n" + row + ",350\n");
  ASSERT_TRUE(cam.problems.empty()) << cam.problems[0].text;
  ASSERT_EQ(cam.definition->cam.segments.size(), 2u);
  EXPECT_EQ(cam.definition->cam.segments[0].Origin, 0.0);
  EXPECT_EQ(cam.definition->cam.segments[1].Origin, 350.0);
  EXPECT_NEAR(cam.definition->cam.function->value(355.0).position, 50.0, 1e-12);
}

}  // namespace
}  // namespace lockstep
