// Any cam file: JSON, or a table of points or elements.
#include "projects/cam_files/file.hpp"
#include "tests/fuzz/texts.hpp"

namespace lockstep::fuzz::cam_target {

std::vector<std::string> seeds() {
  std::vector<std::string> texts;
  for (const char* name : {"contour.csv", "feeder.cam.json", "press.cam.json", "winder.cam.json"})
    texts.push_back(source_file(std::string("projects/cams/") + name));
  return texts;
}

int take(const std::uint8_t* data, std::size_t size) {
  const LoadedCam loaded = load_cam(text_of(data, size), "/nonexistent", "", 1000);
  require(loaded.definition.has_value() == loaded.problems.empty(), "a cam or problems");
  for (const Problem& problem : loaded.problems)
    require(!problem.text.empty() &&
                (problem.place + problem.text).find_first_of("\n\r\x1b") == std::string::npos,
            "a problem is one line without control sequences");
  return 0;
}

}  // namespace lockstep::fuzz::cam_target
