// Any retain file: it is taken with values that can be read, or is refused.
#include <array>
#include <new>

#include "hmi_bridge/retain/writer.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/hmi_bridge/memory_disk.hpp"

namespace lockstep::fuzz::retain_target {
namespace {

constexpr const char* kFile = "values";

}  // namespace

std::vector<std::string> seeds() {
  test::MemoryDisk disk;
  {
    RetainFile file(kFile, "p", disk.name());
    const std::vector<KeptRow> rows{{"a", "DINT", "7", ""},
                                    {"b", "LREAL", "1.5", ""},
                                    {"c", "BOOL", "TRUE", "x=1"},
                                    {"d", "ARRAY[1..3] OF INT", "4,5,6", ""}};
    require(file.write(rows).empty(), "a file can be written");
  }
  return {disk.content[kFile]};
}

int take(const std::uint8_t* data, std::size_t size) {
  test::MemoryDisk disk({{kFile, std::string(data, data + size)}});
  std::int32_t a = 1;
  double b = 2.0;
  bool c = false;
  std::array<std::int16_t, 3> d{};
  KeptValue array{.name = "d", .signal = {d.data(), Type::INT, -1}};
  for (std::int16_t& element : d) array.elements.push_back({&element, Type::INT, -1});
  array.array_type = "ARRAY[1..3] OF INT";
  const std::vector<KeptValue> values{{.name = "a", .signal = {&a, Type::DINT, -1}},
                                      {.name = "b", .signal = {&b, Type::LREAL, -1}},
                                      {.name = "c", .signal = {&c, Type::BOOL, -1}, .basis = "x=1"},
                                      array};
  try {
    RetainFile file(kFile, "p", disk.name());
    restore(file, values);
    require(file.rows().empty() || (a == 7 && b == 1.5 && c && d[0] == 4 && d[1] == 5 && d[2] == 6),
            "all that was written, or nothing");
  } catch (const RetainFileError& error) {
    require(std::string_view(error.what()).find(kFile) != std::string_view::npos, "an error names its file");
  }
  return 0;
}

}  // namespace lockstep::fuzz::retain_target
