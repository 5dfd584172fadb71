#include "projects/studio/project_files.hpp"

#include <nettle/base16.h>
#include <nettle/sha2.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "projects/json/document.hpp"

namespace lockstep {
namespace {

using namespace studio_api;

constexpr std::string_view kCam = ".cam.json";
constexpr std::string_view kLayouts = "studio.json";  // of pages, beside the project

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

/// SHA-256 of the content alone: the same whoever has written it, and another for every other content.
std::string etag_of(std::string_view content) {
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, content.size(), reinterpret_cast<const std::uint8_t*>(content.data()));
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
  sha256_digest(&context, digest.size(), digest.data());
  std::string text(BASE16_ENCODE_LENGTH(digest.size()), '\0');
  base16_encode_update(text.data(), digest.size(), digest.data());
  return '"' + text + '"';
}

/// Whether a list of ETags has one. @source RFC 9110, 13.1.1
bool names_etag(std::string_view list, std::string_view etag) noexcept {
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    std::string_view one = list.substr(0, comma);
    while (one.starts_with(' ') || one.starts_with('\t')) one.remove_prefix(1);
    while (one.ends_with(' ') || one.ends_with('\t')) one.remove_suffix(1);
    if (one == etag) return true;
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  return false;
}

bool may_be_new(std::string_view name) noexcept {
  if (name == kLayouts) return true;
  return name.size() > kCam.size() && name.ends_with(kCam) && !name.starts_with('.') &&
         name.find('/') == name.npos;
}

/// What keeps a text from being JSON as project and cams are written, comments among it.
Wrong wrong_with(std::string_view name, std::string_view text) {
  const JsonDocument document(text);
  Wrong wrong{422};
  for (const Problem& problem : document.problems()) {
    Json more = {{"path", name}, {"pointer", problem.place}};
    if (problem.line != 0) more["line"] = problem.line;
    wrong.add("bad_request", std::string(name) + ": " + problem.text, more);
  }
  return wrong;
}

}  // namespace

StudioProjectFiles::StudioProjectFiles(const std::string& project, std::vector<std::string> cams)
    : folder_(folder_of(project)), project_(project.substr(project.rfind('/') + 1)), cams_(std::move(cams)) {}

bool StudioProjectFiles::is_held(std::string_view name) const noexcept {
  return are_there() && (name == project_ || std::ranges::find(cams_, name) != cams_.end());
}

Json StudioProjectFiles::names() const {
  Json names = Json::array();
  if (!are_there()) return names;
  names.push_back(project_);
  for (const std::string& cam : cams_) names.push_back(cam);
  return names;
}

StudioAnswer StudioProjectFiles::answer(const StudioRequest& request, std::string_view name) const {
  folder_.check_name(name);
  if (request.method == "PUT") return put(request, name);
  const bool is_file = is_held(name) || may_be_new(name);
  if (!is_file) throw BadRequest(404, "not_found", "the project has no file '" + std::string(name) + "'");
  StudioAnswer answer;
  answer.body = folder_.read(name, JsonDocument::kLongest);
  answer.etag = etag_of(answer.body);
  answer.cache = "no-cache";
  return answer;
}

StudioAnswer StudioProjectFiles::put(const StudioRequest& request, std::string_view name) const {
  if (!is_held(name) && !may_be_new(name))
    throw BadRequest(404, "not_found",
                     "'" + std::string(name) +
                         "' is no file of the project; allowed besides: a new NAME.cam.json in its folder, "
                         "and studio.json");
  const bool is_there = folder_.has(name);
  if (request.if_match.empty() && request.if_none_match != "*")
    throw BadRequest(
        428, "stale",
        is_there ? "the header If-Match has to be the ETag of the file as it was read"
                 : "there is no '" + std::string(name) + "' yet; the header 'If-None-Match: *' makes it");
  const std::string before = is_there ? etag_of(folder_.read(name, JsonDocument::kLongest)) : "";
  if (request.if_match == "*")
    throw BadRequest(
        428, "stale",
        "the header If-Match has to be the ETag of the file as it was read; '*' says nothing of it");
  const bool is_known =
      request.if_match.empty() ? !is_there : is_there && names_etag(request.if_match, before);
  if (!is_known)
    throw BadRequest(
        412, "stale",
        !is_there ? "there is no '" + std::string(name) + "' any more"
                  : "'" + std::string(name) + "' has been changed by somebody else; its ETag is " + before);
  if (const Wrong wrong = wrong_with(name, request.body); !wrong.errors.empty()) return answer_of(wrong);
  folder_.write(name, request.body);
  StudioAnswer answer = answer_of(Json{{"name", name}, {"bytes", request.body.size()}});
  answer.etag = etag_of(request.body);
  return answer;
}

}  // namespace lockstep
