// Any project text, and any text of the files that it includes: it is loaded and runs, or is refused with
// reasons that can be shown.
#include <cstdlib>

#include "projects/loader/project.hpp"
#include "tests/fuzz/texts.hpp"
#include "tests/projects/example_project.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::fuzz::project_target {
namespace {

constexpr std::string_view kNextFile = "\n#####\n";  // between the project, part0.json and part1.json
constexpr int kParts = 2;
constexpr int kTicks = 20;

constexpr char kProjectOfParts[] = R"json({ /* all of it */ "$schema": "project.schema.json",
  "lockstep": 1, "name": "parts", "comment": "of three files", // and no more
  "clock": { "servo_cycle": "1ms" }, "include": [ "part0.json" ],
  "instances": [ { "template": "axis", "for": { "n": [1, 3] }, "name": "Axis${n}", "with": { "length": "${n * 90.0}" } },
                 { "template": "axis", "name": "Last", "with": { "n": 4 } } ],
  "expectations": [ { "at": "5ms", "expect": "power1.Status", "text": "on" },
                    { "expect": "Axis1.Position", "value": 0.5, "tolerance": 1.0 } ], "duration": "20ms"
}
#####
{ "include": [ "part1.json" ], "tags": { "on": { "type": "BOOL", "init": true } } }
#####
{ "templates": { "axis": {
  "parameters": { "n": {}, "length": { "default": 360.0 }, "what": { "default": "it's" } },
  "technology_objects": { "Axis${n}": { "type": "TO_PositioningAxis", "config": {
    "VirtualAxis": { "Mode": 1 }, "Modulo": { "Enable": true, "Length": "${length}" } } } },
  "tags": { "kind${n}": { "type": "STRING[20]", "init": "${what} $${n}" } },
  "programs": [ { "name": "Run${n}", "ob": "Main", "cycle": "1ms", "calls": [
    { "fb": "MC_Power", "name": "power${n}", "in": { "Axis": "Axis${n}", "Enable": "on" } },
    { "set": "kind${n}", "to": "SEL(on, 'a', MUX(${n}, 'b', kind${n}, 'c'))" } ] } ] } } }
)json";

const test::Directory& folder() {
  static const test::Directory kFolder;
  return kFolder;
}

/// The project; what it may include is written into files.
std::string_view with_parts(std::string_view text) {
  const std::size_t end = text.find(kNextFile);
  std::string_view rest = end == text.npos ? std::string_view() : text.substr(end + kNextFile.size());
  for (int i = 0; i < kParts; ++i) {
    const std::size_t next = rest.find(kNextFile);
    folder().write("part" + std::to_string(i) + ".json", std::string(rest.substr(0, next)));
    rest = next == rest.npos ? std::string_view() : rest.substr(next + kNextFile.size());
  }
  return text.substr(0, end);
}

void check(const Problem& problem) {
  require(!problem.text.empty(), "a problem has a text");
  require((problem.place + problem.text + problem.owner + problem.file).find_first_of("\n\r\x1b") ==
              std::string::npos,
          "a problem is one line without control sequences");
  require(problem.line == 0 || problem.column > 0, "a line has a column");
}

}  // namespace

std::vector<std::string> seeds() {
  std::vector<std::string> texts{kExampleProject, kProjectOfParts};
  for (const char* name : {"01_positioning", "02_rotary_knife", "03_line_shaft", "04_cross_cutter",
                           "05_press_feeder", "06_encoder_conveyor", "07_emergency_door"})
    texts.push_back(source_file(std::string("projects/") + name + "/project.json"));
  return texts;
}

int take(const std::uint8_t* data, std::size_t size) {
  // Nothing outside of the folder can be included; other files that it names are not there.
  const std::string_view text = text_of(data, size);
  const LoadedProject loaded = load_project(with_parts(text), folder().file(""));
  require(loaded.project.has_value() == loaded.problems.empty(), "a project or problems");
  for (const Problem& problem : loaded.problems) check(problem);
  for (const Problem& warning : loaded.warnings) check(warning);
  if (!loaded.project) return 0;
  for (int tick = 0; tick < kTicks; ++tick) loaded.project->controller->tick();
  return 0;
}

}  // namespace lockstep::fuzz::project_target
