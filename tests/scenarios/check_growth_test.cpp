// What `lockstep check` takes for large projects grows as they do. Instructions are counted, by callgrind, so
// that no other work of the machine counts.
#include <gtest/gtest.h>

#include "tests/scenarios/small_project.hpp"

// Of a sanitizer's program callgrind counts nothing that would be the product's.
#ifndef __SANITIZE_ADDRESS__

namespace lockstep::test::check_growth_test {
namespace {

std::string name(const char* what, int i) {
  return what + std::to_string(i);
}

Json project_with_one_axis() {
  Json json = empty_project();
  json["technology_objects"]["A"] = virtual_axis();
  return json;
}

Json with_axes(int count) {
  Json json = empty_project();
  for (int i = 0; i < count; ++i) json["technology_objects"][name("A", i)] = virtual_axis();
  return json;
}

/// Each follows the one before it, and a program couples them.
Json with_a_chain(int count) {
  Json json = project_with_one_axis();
  Json calls = Json::array();
  for (int i = 0; i < count; ++i) {
    const std::string leading = i == 0 ? "A" : name("B", i - 1);
    json["technology_objects"][name("B", i)] = virtual_axis({leading});
    calls.push_back(call("MC_Power", name("power", i), {{"Axis", name("B", i)}, {"Enable", true}}));
    calls.push_back(
        call("MC_GearIn", name("gear", i),
             {{"Master", leading}, {"Slave", name("B", i)}, {"Execute", name("power", i) + ".Status"}}));
  }
  json["programs"].push_back({{"name", "Main"}, {"ob", "Main"}, {"cycle", "10ms"}, {"calls", calls}});
  return json;
}

Json with_output_cams(int count) {
  Json json = project_with_one_axis();
  for (int i = 0; i < count; ++i) {
    json["tags"][name("out", i)] = {{"type", "BOOL"}};
    json["technology_objects"][name("C", i)] = {
        {"type", "TO_OutputCam"},
        {"assigned_to", "A"},
        {"config", {{"Interface", {{"EnableOutput", true}, {"Address", name("out", i)}}}}}};
  }
  return json;
}

Json with_tags_everywhere(int count) {
  Json json = project_with_one_axis();
  for (int i = 0; i < count; ++i) {
    json["tags"][name("t", i)] = {{"type", "UINT"}, {"retain", true}};
    json["stimuli"].push_back(stimulus(std::to_string(i) + "ms", name("t", i), i));
    json["trace"]["signals"].push_back(name("t", i));
    json["modbus"]["map"].push_back({{"tag", name("t", i)}, {"table", "holding_register"}, {"address", i}});
  }
  return json;
}

/// Instructions of a check.
double instructions_of(const Json& json) {
  const Directory directory;
  Process process({"valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", LOCKSTEP_PROGRAM,
                   "check", directory.write("project.json", json.dump())});
  EXPECT_EQ(process.status(), 0) << process.err();
  const std::string mark = "Collected : ", text = process.err();
  const std::size_t at = text.find(mark);
  EXPECT_NE(at, std::string::npos) << text;
  return at == std::string::npos ? 0.0 : std::atof(text.c_str() + at + mark.size());
}

using Make = Json (*)(int count);
class CheckGrows : public testing::TestWithParam<Make> {};

TEST_P(CheckGrows, AsTheProjectDoes) {
  constexpr int kSome = 400;
  const double once = instructions_of(GetParam()(kSome)), twice = instructions_of(GetParam()(2 * kSome));
  const double four_times = instructions_of(GetParam()(4 * kSome));
  const double first = twice - once;
  EXPECT_GT(first, 0.0);
  // What is linear takes twice as much for twice as many more; what is quadratic, four times; a
  // little of it hides behind much that is linear.
  // What is linear takes twice as much for twice as many more; what is quadratic, four times. A little of it
  // hides behind much that is linear.
  EXPECT_LT(four_times - twice, 2.15 * first) << first / kSome << " instructions each";
}

std::string name_of(const testing::TestParamInfo<Make>& made) {
  static const std::vector<std::string> names{"Axes", "Chain", "OutputCams", "Tags"};
  return names[made.index];
}

INSTANTIATE_TEST_SUITE_P(Projects, CheckGrows,
                         testing::Values(with_axes, with_a_chain, with_output_cams, with_tags_everywhere),
                         name_of);

// An axis that ticks takes more than twice as much as there is for each here.
TEST(Check, OfManyAxesTakesATenthOfTheirMemory) {
  const Directory directory;
  const std::string project = directory.write("project.json", with_axes(20'000).dump());
  Process check({"prlimit", "--as=300000000", LOCKSTEP_PROGRAM, "check", project});
  EXPECT_EQ(check.status(), 0) << check.err().substr(0, 1000);
}

// Nothing is readied for a clock that is never started: pages are laid together for the cycle.
TEST(Check, ReadiesNothingForTheCycle) {
  const Directory directory;
  const std::string project = directory.write("project.json", with_axes(400).dump());
  const std::string calls = directory.file("calls");
  Process check({"strace", "-f", "-e", "trace=madvise", "-o", calls, LOCKSTEP_PROGRAM, "check", project});
  EXPECT_EQ(check.status(), 0) << check.err();
  EXPECT_EQ(content(calls).find("madvise("), std::string::npos) << content(calls);
}

}  // namespace
}  // namespace lockstep::test::check_growth_test

#endif
