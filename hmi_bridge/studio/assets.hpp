/// The studio's page: files that are a part of the program.
#pragma once

#include <span>
#include <string_view>

#include "hmi_bridge/studio/handler.hpp"

namespace lockstep {

/// A file of the page. All of it lasts as long as the program.
struct StudioAsset {
  std::string_view path;  ///< of a request, such as `/`; those of `/assets/` have a digest in their name
  std::string_view type;  ///< as HTTP names it
  std::string_view etag;  ///< with its quotes; empty: what is under this path never changes
  std::string_view content;
};

/// All of them; made by page/embed.cmake.
std::span<const StudioAsset> studio_assets() noexcept;

bool is_studio_asset(std::string_view path) noexcept;
/// @param path of one that is there
StudioAnswer studio_asset(std::string_view path);

}  // namespace lockstep
