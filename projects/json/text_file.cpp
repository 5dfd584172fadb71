#include "projects/json/text_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace lockstep {

std::string read_text_file(const std::string& path, std::size_t maximum) {
  const auto fail = [&] { throw UnreadableFile(path + ": " + std::strerror(errno)); };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (file == nullptr) fail();
  std::string text(64 * 1024, '\0');
  std::size_t size = 0;
  while (size <= maximum) {
    if (size == text.size()) text.resize(std::min(2 * size, maximum + 1));
    const std::size_t count = std::fread(text.data() + size, 1, text.size() - size, file.get());
    size += count;
    if (count == 0) break;
  }
  if (std::ferror(file.get()) != 0) fail();
  text.resize(size);
  return text;
}

}  // namespace lockstep
