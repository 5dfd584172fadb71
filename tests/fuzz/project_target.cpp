// Any project text: it is loaded and runs, or is refused with reasons that can be shown.
#include "projects/loader/project.hpp"
#include "tests/fuzz/texts.hpp"
#include "tests/projects/example_project.hpp"

namespace lockstep::fuzz {

std::vector<std::string> seeds() {
  std::vector<std::string> texts{kExampleProject};
  for (const char* name : {"01_positioning", "02_rotary_knife", "03_line_shaft", "04_cross_cutter",
                           "05_press_feeder", "06_encoder_conveyor", "07_emergency_door"})
    texts.push_back(source_file(std::string("projects/") + name + "/project.json"));
  return texts;
}

namespace {

constexpr int kTicks = 20;

void check(const Problem& problem) {
  require(!problem.text.empty(), "a problem has a text");
  require((problem.place + problem.text).find_first_of("\n\r\x1b") == std::string::npos,
          "a problem is one line without control sequences");
}

}  // namespace
}  // namespace lockstep::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lockstep;
  // Files that it names are not looked for in the file system at large.
  const LoadedProject loaded = load_project(fuzz::text_of(data, size), "/nonexistent");
  fuzz::require(loaded.project.has_value() == loaded.problems.empty(), "a project or problems");
  for (const Problem& problem : loaded.problems) fuzz::check(problem);
  for (const Problem& warning : loaded.warnings) fuzz::check(warning);
  if (!loaded.project) return 0;
  for (int tick = 0; tick < fuzz::kTicks; ++tick) loaded.project->controller->tick();
  return 0;
}
