// Tables of cams as people and spreadsheets write them: what is read, and what is refused with its place.
#include <gtest/gtest.h>

#include <string>

#include "projects/cam_files/file.hpp"
#include "projects/cam_files/table.hpp"

namespace lockstep::cam_table_test {
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
TEST(CamTable, WhoseCommasMayBeEitherIsRefusedWithBothReadings) {
  EXPECT_EQ(
      told("0,0\n10,1,25\n20,3\n"),
      "2:1: the commas may part numbers, 10 | 1 | 25, or some be decimal commas, 10 | 1.25; allowed: ';' "
      "or a tab between the numbers, or numbers with a decimal point");
  EXPECT_TRUE(has(told("0,0,0,0\n10,5,1,25\n"), "1:1: the commas may part numbers, 0 | 0 | 0 | 0, or"));
  EXPECT_TRUE(has(told("10,5,1,25,0\n20,5,3,75,0\n"),
                  "1:1: the commas may part numbers, 10 | 5 | 1 | 25 | 0, or some be "
                  "decimal commas, 10.5 | 1.25 | 0; allowed"));
  EXPECT_TRUE(has(told("0.5,0\n10,1,25\n20,3\n"), "2:1: the commas")) << "of another length than the first";
  EXPECT_TRUE(has(told("x,y\n0,0\n10,1,25\n"), "3:1: the commas")) << "or than the names";
  EXPECT_TRUE(has(told("I,1,0\nS,0,100,0,2,5,0,0,0,0,0,0,0,0\n"),
                  "2:3: the commas may part numbers, 0 | 100 | 0 | 2 | 5"))
      << "an origin, or one number less";
}

TEST(CamTable, WhoseCommasAreClearIsRead) {
  const auto second = [](const std::string& text) {
    const LoadedCam cam = read(text);
    if (!cam.problems.empty()) return cam.problems[0].place + ": " + cam.problems[0].text;
    const auto& point = cam.definition->cam.points.at(1);
    return std::to_string(point.x) + " " + std::to_string(point.y);
  };
  const std::string expected = "10.000000 1.250000";
  EXPECT_EQ(second("0;0\n10;1,25\n20;3\n"), expected) << "between semicolons a comma is the decimal sign";
  EXPECT_EQ(second("0\t0\n10\t1,25\n20\t3\n"), expected) << "between tabs too";
  EXPECT_EQ(second("0,0,0\n10,1.25,3\n20,3,0\n"), expected) << "a decimal point tells what the commas are";
  EXPECT_EQ(second("x,y,velocity\n0,1,0\n10,1,25\n20,3,0\n"), "10.000000 1.000000") << "and so do names";
  EXPECT_EQ(second("0, 0, 0\n10, 1, 25\n20, 3, 0\n"), "10.000000 1.000000") << "and blanks";
  EXPECT_EQ(second("0,-1,-2\n10,-1,-25\n20,-3,-3\n"), "10.000000 -1.000000") << "and signs";
}

TEST(CamTable, WithDecimalCommasAndDecimalPointsIsRefused) {
  EXPECT_EQ(
      told("0;0\n10;1,25\n20;3.5\n"),
      "2:4: '1,25' has a decimal comma, and line 3 a decimal point; allowed: one of them in the whole file");
  EXPECT_TRUE(has(told("0;0\n10;1.000,25\n"), "2:4: '1.000,25'"));
  EXPECT_TRUE(has(told("0;0\n10;1,000,25\n"), "2:4: '1,000,25' is not allowed here"));
}

TEST(CamTable, WithDerivativesSaysThatTheyDoNotCount) {
  EXPECT_TRUE(has(told("0,0,0,0,0\n10,1,0.2,0,0\n20,3,0,0,0\n"),
                  "1:5: velocity, acceleration and jerk are not read"));
}

TEST(CamTable, ThatIsWrittenWithCommasShowsWhatTheyAre) {
  const LoadedCam whole = read("I,1,0\nS,0,100,0,2,0,0,0,0,0,0,0,0\nP,150,250\n");
  ASSERT_TRUE(whole.problems.empty()) << whole.problems[0].text;
  const std::string elements = cam_element_table(*whole.definition, ',');
  EXPECT_EQ(elements, "I,1,0\nS,0,100,0,2,0,0,0,0,0,0,0,0,0.0\nP,150,250\n");
  EXPECT_TRUE(read(elements).problems.empty());
  const auto samples = sampled(*whole.definition->cam.function, 0.0, 100.0, 2);
  const std::string points = cam_point_table(samples, true, ',');
  EXPECT_TRUE(read(points).problems.empty()) << points;
  EXPECT_EQ(cam_point_table(samples, false, ','), "0,0\n100,200\n");
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
}  // namespace lockstep::cam_table_test
