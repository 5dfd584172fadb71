#include "projects/runtime/telegram_recorder.hpp"

#include <algorithm>
#include <array>
#include <ctime>
#include <exception>
#include <filesystem>
#include <system_error>
#include <utility>

namespace lockstep {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kOfTelegrams = "_telegrams_", kOfLogs = ".lcm";

std::string stamp_of(std::chrono::system_clock::time_point time) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y%m%dT%H%M%SZ", &parts)};
}

std::int64_t utime_of(std::chrono::system_clock::time_point time) {
  return std::chrono::duration_cast<std::chrono::microseconds>(time.time_since_epoch()).count();
}

}  // namespace

TelegramRecorder::TelegramRecorder(FlightRecorderOptions options, const TelegramMemory& memory)
    : options_(std::move(options)), memory_(memory) {}

void TelegramRecorder::event(const TraceEvent& event) {
  if (event.kind != EventKind::alarm) return;
  const auto now = Clock::now();
  if (!from_) {
    if (files_ >= options_.files) return;
    ++files_;
    from_ = now - std::chrono::nanoseconds(options_.before);
  }
  until_ = now + std::chrono::nanoseconds(options_.after);
}

void TelegramRecorder::flush() {
  if (until_ && Clock::now() >= *until_) write();
}

void TelegramRecorder::end() {
  if (until_) write();
}

void TelegramRecorder::write() {
  const std::string path = options_.file + std::string(kOfTelegrams) + stamp_of(Clock::now()) + "_" +
                           std::to_string(files_) + std::string(kOfLogs);
  const std::vector<KeptTelegram> telegrams = memory_.since(utime_of(*from_));
  from_.reset();
  until_.reset();
  try {
    write_telegrams(path, telegrams);
    written_.push_back(path);
    remove_oldest();
  } catch (const std::exception& error) {
    lose(telegrams.size(), error.what());
  }
}

/// Their names begin with their time, so that the oldest are the first.
void TelegramRecorder::remove_oldest() const {
  const fs::path file(options_.file);
  const std::string beginning = file.filename().string() + std::string(kOfTelegrams);
  const fs::path folder = file.parent_path().empty() ? fs::path(".") : file.parent_path();
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(beginning) && name.ends_with(kOfLogs) && entry.is_regular_file())
      found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  const auto keep = static_cast<std::size_t>(options_.keep);
  std::error_code left;
  for (std::size_t i = 0; i + keep < found.size(); ++i) fs::remove(found[i], left);
}

}  // namespace lockstep
