// Any LCM event log, as lockstep plot reads it.
#include <sys/mman.h>
#include <unistd.h>

#include "hmi_bridge/lcm/log.hpp"
#include "hmi_bridge/lcm/trace_reader.hpp"
#include "tests/fuzz/texts.hpp"

namespace lockstep::fuzz::lcm_log_target {
namespace {

/// A file in memory, with a path.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view content = "") : file_(::memfd_create("fuzz", MFD_CLOEXEC)) {
    require(file_ >= 0 && ::write(file_, content.data(), content.size()) == std::ssize(content),
            "a file in memory");
  }
  ~MemoryFile() { ::close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

}  // namespace

std::vector<std::string> seeds() {
  const MemoryFile file;
  const std::vector<TraceSignal> signals{
      {"on", Type::BOOL, ""}, {"x", Type::LREAL, "u"}, {"n", Type::LINT, ""}};
  const std::vector<Value> values(signals.size());
  {
    LcmLog log(file.path(), {"knife", "KNIFE", 1'000'000, 0});
    log.begin(signals);
    for (int i = 0; i < 3; ++i) log.row({i * 1'000'000, static_cast<std::uint64_t>(i), 0, values});
    log.end();
  }
  std::ifstream stream(file.path(), std::ios::binary);
  return {{std::istreambuf_iterator<char>(stream), {}}};
}

int take(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(text_of(data, size));
  try {
    const TraceTable table = read_lcm_trace(file.path());
    for (const auto& column : table.columns)
      require(column.size() == table.t.size(), "columns of one length");
  } catch (const TraceFormatError& error) {
    require(std::string_view(error.what()).starts_with(file.path()), "an error names its file");
  }
  return 0;
}

}  // namespace lockstep::fuzz::lcm_log_target
