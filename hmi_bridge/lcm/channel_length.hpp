/// How long the names of channels may be.
#pragma once

#include <cstddef>

namespace lockstep {

/// Longest channel that LCM carries [byte].
/// @source LCM, LCM_MAX_CHANNEL_NAME_LENGTH
inline constexpr std::size_t kLongestLcmChannel = 63;
/// Longest channel of a trace [byte]: that of its header, which is longer by `kHeaderSuffix`, has to fit too.
inline constexpr std::size_t kLongestTraceChannel = kLongestLcmChannel - 7;

}  // namespace lockstep
