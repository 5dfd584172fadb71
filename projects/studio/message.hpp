/// What a page says.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "projects/studio/api.hpp"

namespace lockstep {

/// A message over the WebSocket, a JSON object with a `type`.
struct StudioMessage {
  studio_api::Json json;
  studio_api::Json seq;  ///< that the answer has as well

  /// @throws studio_api::BadRequest unless it is an unsigned number of 32 bits
  std::uint32_t number(const char* key) const;
};

}  // namespace lockstep
