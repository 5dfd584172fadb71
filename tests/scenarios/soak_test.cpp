// A day of virtual time, of a run and of its kept values: memory stays as it is. CI runs minutes of it.
#include "tests/scenarios/soak.hpp"

#include <gtest/gtest.h>

#include <iostream>
#include <regex>

#include "hmi_bridge/retain/writer.hpp"
#include "projects/loader/project.hpp"
#include "tests/scenarios/modbus_client.hpp"
#include "tests/support/property.hpp"

namespace lockstep::test::soak_test {
namespace {

constexpr int kTicks = 900;  // address of the count of ticks

class Soak : public testing::TestWithParam<const char*> {};

TEST_P(Soak, ADayOfVirtualTimeTakesNoMoreMemoryThanItsFirstHours) {
  const int seconds = test::cases(300, 86400);
  const Directory directory;
  Json json = example_json(GetParam());
  json["modbus"]["map"].push_back(
      {{"diagnostic", "ticks"}, {"table", "input_register"}, {"address", kTicks}, {"type", "UDINT"}});
  add_recorders(json, directory.file("flight"));
  const double period = json["clock"]["servo_cycle"] == "500us" ? 0.0005 : 0.001;
  const auto all_ticks = static_cast<std::uint32_t>(seconds / period);
  // The trace is written, but no disk has room for a day of it.
  std::filesystem::create_symlink("/dev/null", directory.file("trace.csv"));
  Process run(lockstep_command({"run", directory.write("project.json", json.dump()), "--simulate", "--modbus",
                                "127.0.0.1:0", "--lcm", "memq://", "--trace", directory.file("trace.csv"),
                                "--duration", std::to_string(seconds) + "s"}));
  const std::string mark = "Modbus server on 127.0.0.1:";
  ASSERT_TRUE(wait_until([&] { return run.err().find('\n') != std::string::npos; }));
  ModbusClient client(std::atoi(run.err().c_str() + run.err().find(mark) + mark.size()));
  const auto wait_for = [&](double part) {
    return wait_until([&] { return client.input_double_word(kTicks) >= part * all_ticks; },
                      std::chrono::hours(12));
  };
  ASSERT_TRUE(wait_for(0.2));
  const long early = resident(run.pid());
  ASSERT_TRUE(wait_for(0.9));
  const long late = resident(run.pid());
  std::cout << early << " KiB after a fifth, " << late << " KiB near the end of " << seconds << " s\n";
  EXPECT_GT(early, 1000);
  EXPECT_LE(late, early + kMayGrow);
  ASSERT_TRUE(wait_until([&] { return !run.running(); }, std::chrono::hours(12)));
  EXPECT_EQ(run.status(), 0) << run.err();
  EXPECT_FALSE(std::regex_search(run.err(), std::regex("alarm [0-9]"))) << run.err();
}

// A simulation keeps nothing, so this one has the writer beside a controller in virtual time, which ends and
// goes on every hour.
TEST(SoakOfKeptValues, ADayOfVirtualTimeTakesNoMoreMemoryAndEndsWithTheValuesOfItsLastTick) {
  const int parts = test::cases(6, 24);
  const int ticks = test::cases(50'000, 3'600'000);  // of each part
  const Directory directory;
  const std::string file = directory.file("kept");
  const std::string text = with_kept_values(example_json("05_press_feeder")).dump();
  long early = 0;
  std::int64_t beat = 0;
  for (int part = 0; part < parts; ++part) {
    LoadedProject loaded = load_project(text, "", [&](Project& project) {
      RetainFile kept(file, project.name);
      EXPECT_TRUE(restore(kept, project.retain.values).empty());
    });
    ASSERT_TRUE(loaded.project.has_value()) << loaded.problems[0].place << loaded.problems[0].text;
    Project& project = *loaded.project;
    ASSERT_EQ(project.retain.values.size(), 3u);
    ASSERT_EQ(project.retain.values[0].signals()[0].load().i, beat) << "what the part before has kept";
    {
      RetainWriter writer(RetainFile(file, project.name), project.retain.values,
                          std::chrono::milliseconds(1));
      project.controller->images = {&writer.image()};
      writer.start();
      for (int tick = 0; tick < ticks; ++tick) project.controller->tick();
      writer.stop();
      EXPECT_FALSE(writer.failing());
      EXPECT_GT(writer.commits(), 2u) << "not at the end alone";
    }
    beat += ticks;
    const RetainFile kept(file, project.name);
    ASSERT_EQ(kept.find("beat")->value, std::to_string(beat));
    const auto beats = kept_values(kept.find("beats")->value, project.retain.values[1].signals());
    ASSERT_TRUE(beats.has_value());
    for (std::int64_t element = 0; element < 500; ++element)
      ASSERT_EQ((*beats)[static_cast<std::size_t>(element)].i, beat - (beat - element) % 500) << element;
    EXPECT_EQ(kept.find("recipe")->value.substr(0, 6), "1,2.5,");
    const long now = resident(::getpid());
    if (part == parts / 5) early = now;
    if (part >= parts / 5) {
      EXPECT_LE(now, early + kMayGrow + 256) << "part " << part;
    }
  }
  std::cout << early << " KiB after a fifth, " << resident(::getpid()) << " KiB at the end, "
            << std::filesystem::file_size(file) << " bytes in the file after " << parts << " parts\n";
}

INSTANTIATE_TEST_SUITE_P(Machines, Soak, testing::Values("03_line_shaft", "05_press_feeder"),
                         [](const auto& name) { return std::string(name.param).substr(3); });

}  // namespace
}  // namespace lockstep::test::soak_test
