#include "hmi_bridge/traces/recordings.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <ctime>
#include <filesystem>
#include <system_error>
#include <utility>

namespace lockstep {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".csv";
constexpr std::string_view kStamp = "00000000T000000Z";  // 0 stands for any digit
constexpr std::size_t kMaximumDigits = 15;               // so that there is always a next number
constexpr int kAttempts = 100;  // other runs may take the same number at the same moment

bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}

/// The time of a recording: its shape, and that there is such a time.
bool is_stamp(std::string_view text) noexcept {
  const bool shaped = std::equal(text.begin(), text.end(), kStamp.begin(), kStamp.end(),
                                 [](char c, char shape) { return shape == '0' ? is_digit(c) : c == shape; });
  if (!shaped) return false;
  const auto two_at = [text](std::size_t at) { return 10 * (text[at] - '0') + (text[at + 1] - '0'); };
  const auto within = [](int value, int first, int last) { return value >= first && value <= last; };
  return within(two_at(4), 1, 12) && within(two_at(6), 1, 31) && two_at(9) < 24 && two_at(11) < 60 &&
         two_at(13) <= 60;
}

std::string stamp_of_now() {
  const std::time_t now = std::time(nullptr);
  std::tm time{};
  ::gmtime_r(&now, &time);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y%m%dT%H%M%SZ", &time)};
}

}  // namespace

Recordings::Recordings(std::string file) : file_(std::move(file)) {}

std::string Recordings::folder() const {
  const std::string folder = fs::path(file_).parent_path().string();
  return folder.empty() ? "." : folder;
}

std::uint64_t Recordings::number_of(std::string_view name, std::string_view beginning) noexcept {
  if (!name.starts_with(beginning) || !name.ends_with(kEnding)) return 0;
  name.remove_prefix(beginning.size());
  if (name.size() < kStamp.size() + kEnding.size() + 3) return 0;
  name.remove_suffix(kEnding.size());
  if (name[0] != '_' || !is_stamp(name.substr(1, kStamp.size())) || name[kStamp.size() + 1] != '_') return 0;
  name.remove_prefix(kStamp.size() + 2);
  if (name.size() > kMaximumDigits) return 0;
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return error == std::errc{} && end == name.data() + name.size() && name[0] != '0' ? number : 0;
}

std::vector<Recording> Recordings::present() const {
  const std::string beginning = fs::path(file_).filename().string();
  std::vector<Recording> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder())) {
    const std::uint64_t number = number_of(entry.path().filename().string(), beginning);
    if (number != 0 && entry.symlink_status().type() == fs::file_type::regular)
      found.push_back({number, entry.path().string()});
  }
  std::sort(found.begin(), found.end(), [](const Recording& a, const Recording& b) {
    return std::pair(a.number, std::string_view(a.path)) < std::pair(b.number, std::string_view(b.path));
  });
  return found;
}

std::unique_ptr<CsvTrace> Recordings::open_next() const {
  const std::vector<Recording> there = present();
  std::uint64_t number = there.empty() ? 0 : there.back().number;
  const std::string beginning = file_ + "_" + stamp_of_now() + "_";
  for (int attempt = 1;; ++attempt) {
    try {
      return std::make_unique<CsvTrace>(beginning + std::to_string(++number) + std::string(kEnding),
                                        CsvTrace::Open::new_file);
    } catch (const std::system_error& error) {
      if (error.code().value() != EEXIST || attempt == kAttempts) throw;
    }
  }
}

std::vector<std::string> Recordings::remove_oldest(std::size_t keep) const noexcept try {
  std::vector<std::string> problems;
  const std::vector<Recording> there = present();
  for (std::size_t i = 0; i + keep < there.size(); ++i) {
    std::error_code error;
    if (!fs::remove(there[i].path, error) && error)
      problems.push_back(there[i].path + " cannot be removed: " + error.message());
  }
  return problems;
} catch (const std::exception& error) {
  try {
    return {error.what()};
  } catch (...) {
    return {};  // without memory the next recording tries again
  }
}

std::string Recordings::problem() const {
  if (::access(folder().c_str(), W_OK | X_OK) == 0 && fs::is_directory(folder())) return "";
  const int error = errno;
  if (error == 0 || fs::is_regular_file(folder())) return folder() + " is no directory";
  return folder() + ": " + std::generic_category().message(error);
}

}  // namespace lockstep
