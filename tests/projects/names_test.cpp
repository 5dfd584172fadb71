// Looking up the names of a loaded project writes nothing.
#include "projects/expressions/names.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "projects/loader/project.hpp"

namespace lockstep::names_test {
namespace {

constexpr char kText[] = R"({"lockstep": 1, "name": "names", "clock": {"servo_cycle": "1ms"},
  "technology_objects": {"Knife": {"type": "TO_SynchronousAxis", "config": {"VirtualAxis": {"Mode": 1}}}},
  "tags": {"speed": {"type": "LREAL"}, "spare": {"type": "INT"}, "kind": {"type": "STRING[5]"},
           "heights": {"type": "ARRAY[0..3] OF LREAL"}}})";

Project loaded() {
  LoadedProject result = load_project(kText);
  EXPECT_TRUE(result.project.has_value());
  return std::move(*result.project);
}

constexpr char kHint[] = "unknown name 'sped' (did you mean 'speed'?)";

// A hint for each, however many have been given: they are rationed only while a project is loaded.
TEST(NamesOfALoadedProject, AreLookedUpWithTheSameAnswerEachTime) {
  const Project project = loaded();
  for (int i = 0; i < 300; ++i) ASSERT_EQ(project.names.find("sped").problem, kHint) << i;
}

// What a sanitizer of threads looks at, or valgrind's helgrind: two look-ups of one name at once.
TEST(NamesOfALoadedProject, AreLookedUpByAnyNumberOfThreadsAtOnce) {
  const Project project = loaded();
  std::atomic<int> wrong{0};
  const auto look = [&] {
    const Names& names = project.names;
    for (int i = 0; i < 200; ++i) {
      const bool right = names.find("Speed").place && names.find("heights[2]").place &&
                         names.find("Knife.Position").place && names.find_string("KIND") != nullptr &&
                         names.find_array("heights").array != nullptr &&
                         names.find_object("knife", kAnyDrivenAxis).object != nullptr &&
                         names.resolve("spare", "").signal && names.find("sped").problem == kHint;
      if (!right) ++wrong;
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) threads.emplace_back(look);
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

TEST(NamesOfAProjectThatIsLoaded, AreRecordedAsLongAsTheLoaderAsks) {
  Names names;
  EXPECT_EQ(names.add("Speed", {}), "");
  Names::Uses uses;
  names.record(&uses);
  names.find_entity("absent");
  EXPECT_TRUE(uses.names.empty());
  names.find_entity("SPEED");
  EXPECT_TRUE(uses.names.contains("speed"));
  uses.suggestions_left = 1;
  EXPECT_NE(names.find("sped").problem.find("did you mean"), std::string::npos);
  EXPECT_EQ(names.find("sped").problem.find("did you mean"), std::string::npos) << "they are used up";
  uses.names.clear();
  names.record(nullptr);
  names.find_entity("speed");
  EXPECT_TRUE(uses.names.empty());
  EXPECT_NE(names.find("sped").problem.find("did you mean"), std::string::npos);
}

}  // namespace
}  // namespace lockstep::names_test
