/// Addresses of requests, taken apart.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lockstep {

/// The target of a request, such as `/api/signals?q=a%20b`.
struct StudioUrl {
  std::string path;                                        ///< decoded, without the query
  std::vector<std::pair<std::string, std::string>> query;  ///< decoded, in their order
};

/// Text behind the question mark of a target; empty: there is none.
std::string_view query_of(std::string_view target) noexcept;

/// @return false: it does not begin with `/`, percent signs are not what they should be, or hide a character
/// of control
bool parse_url(std::string_view target, StudioUrl& url);

}  // namespace lockstep
