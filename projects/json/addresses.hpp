/// Addresses as project files and command lines name them.
/// @source contract of the project file, section 6
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "hmi_bridge/network/network.hpp"
#include "projects/json/text_form.hpp"

namespace lockstep {

/// Reads "HOST:PORT": an IPv4 address, an IPv6 address in brackets or a name, and a port from 0 to 65535.
/// @return none if it is something else, with what is wrong and what is allowed in `problem`
std::optional<Endpoint> parse_endpoint(std::string_view text, std::string& problem);

/// What is wrong with the URL of an LCM network, and what is allowed; empty if nothing is. Allowed are
/// `udpm://ADDRESS:PORT?ttl=N` with a multicast address, where all but `udpm://` may be left out, and
/// `memq://`.
std::string lcm_url_problem(std::string_view url);

/// What is wrong with an endpoint, with a network from which clients may come, and with one from which
/// telegrams do, which is IPv4; empty if nothing is.
std::string endpoint_problem(std::string_view text);
std::string network_problem(std::string_view text);
std::string sender_problem(std::string_view text);

inline constexpr TextForm kEndpointForm = {
    "HOST:PORT",
    R"(^([A-Za-z0-9._-]{1,253}|\[[^\]/]*:[^\]/]*\]):0*([0-9]{1,4}|[1-5][0-9]{4}|6[0-4][0-9]{3}|65[0-4][0-9]{2}|655[0-2][0-9]|6553[0-5])$)",
    &endpoint_problem};
inline constexpr TextForm kNetworkForm = {
    "address or network",
    "^([0-9]{1,3}(\\.[0-9]{1,3}){3}(/0*[0-9]{1,2})?|[0-9A-Fa-f.]*:[0-9A-Fa-f:.]*(/0*[0-9]{1,3})?)$",
    &network_problem};
inline constexpr TextForm kSenderForm = {"IPv4 address or network",
                                         "^[0-9]{1,3}(\\.[0-9]{1,3}){3}(/0*[0-9]{1,2})?$", &sender_problem};
inline constexpr TextForm kLcmUrlForm = {
    "URL of an LCM network", R"(^(memq://|udpm://([0-9]+(\.[0-9]+){3}(:[0-9]+)?)?(\?ttl=[0-9]+)?)$)",
    &lcm_url_problem};

}  // namespace lockstep
