/// Addresses as project files and command lines name them.
/// @source contract of the project file, section 6
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "hmi_bridge/network/network.hpp"

namespace lockstep {

/// Reads "HOST:PORT": an IPv4 address, an IPv6 address in brackets or a name, and a port from 0 to 65535.
/// @return none if it is something else, with what is wrong and what is allowed in `problem`
std::optional<Endpoint> parse_endpoint(std::string_view text, std::string& problem);

/// What is wrong with the URL of an LCM network, and what is allowed; empty if nothing is. Allowed are
/// `udpm://ADDRESS:PORT?ttl=N` with a multicast address, where all but `udpm://` may be left out, and
/// `memq://`.
std::string lcm_url_problem(std::string_view url);

}  // namespace lockstep
