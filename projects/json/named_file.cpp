#include "projects/json/named_file.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "projects/json/document.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

/// The path as far as there is one; empty where nobody can follow it.
fs::path real_path(const fs::path& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path.empty() ? fs::path(".") : path, error);
  if (error) return {};
  fs::path real = fs::weakly_canonical(absolute, error);
  if (error) return {};
  return real.has_filename() ? real : real.parent_path();  // "a/" is "a"
}

}  // namespace

bool stays_within(const std::string& path, const std::string& folder) {
  const fs::path file = real_path(path), top = real_path(folder);
  return !file.empty() && !top.empty() &&
         std::mismatch(top.begin(), top.end(), file.begin(), file.end()).first == top.end();
}

std::optional<std::string> named_file(const JsonValue& name, const std::string& folder,
                                      const std::string& top, Problems& problems) {
  const std::string path = (fs::path(folder) / name.text).string();
  if (!fs::path(name.text).is_absolute() && stays_within(path, top)) return path;
  problems.report(
      name, name.shown() + " leads out of the folder of the project; allowed: files in it and below it");
  return std::nullopt;
}

}  // namespace lockstep
