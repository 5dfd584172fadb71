/// The URL of an LCM network.
#pragma once

#include <netinet/in.h>

#include <string>
#include <string_view>

namespace lockstep {

/// The URL whose messages stay in this process.
inline constexpr std::string_view kLcmOwnProcess = "memq://";

/// Group and port of `udpm://ADDRESS:PORT?ttl=N`, with LCM's own defaults for what is left out.
/// @throws std::runtime_error that names the URL, what is wrong with it and what is allowed
sockaddr_in lcm_group(const std::string& url);

/// Whether what is sent on the network of a URL is heard beyond this machine: its time to live is above 0.
/// One that is left out is 0, as with LCM.
bool lcm_leaves_machine(std::string_view url) noexcept;

/// What to say of commands on such a network.
inline constexpr std::string_view kLcmCommandsWarning =
    "whoever reaches this network can move these axes: LCM knows no passwords; with ttl=0 only programs on "
    "this machine can";

/// Refuses a URL. @throws std::runtime_error "LCM on URL: WHY"
[[noreturn]] void refuse_lcm(const std::string& url, const std::string& why);

}  // namespace lockstep
