#include "hmi_bridge/studio/assets.hpp"

#include <algorithm>

namespace lockstep {
namespace {

const StudioAsset* find_asset(std::string_view path) noexcept {
  const std::span<const StudioAsset> all = studio_assets();
  const auto found =
      std::find_if(all.begin(), all.end(), [path](const StudioAsset& asset) { return asset.path == path; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

bool is_studio_asset(std::string_view path) noexcept {
  return find_asset(path) != nullptr;
}

StudioAnswer studio_asset(std::string_view path) {
  StudioAnswer answer;
  if (const StudioAsset* asset = find_asset(path)) {
    answer.type = asset->type;
    answer.body = asset->content;
    answer.etag = asset->etag;
    answer.cache = asset->etag.empty() ? "public, max-age=31536000, immutable" : "no-cache";
  } else {
    answer.status = 404;
  }
  return answer;
}

}  // namespace lockstep
