#include "projects/json/text_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "hmi_bridge/traces/regular_file.hpp"

namespace lockstep {
std::string read_text_file(const std::string& path, std::size_t maximum) {
  const RegularFile file = open_regular_file(path);
  if (!file.problem.empty()) throw UnreadableFile(path + ": " + file.problem);
  std::string text(64 * 1024, '\0');
  std::size_t size = 0;
  while (size <= maximum) {
    if (size == text.size()) text.resize(std::min(2 * size, maximum + 1));
    const std::size_t count = std::fread(text.data() + size, 1, text.size() - size, file.stream.get());
    size += count;
    if (count == 0) break;
  }
  if (std::ferror(file.stream.get()) != 0) throw UnreadableFile(path + ": " + std::strerror(errno));
  text.resize(size);
  return text;
}

}  // namespace lockstep
