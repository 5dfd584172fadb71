/// Networks that carry leading values between processes, as projects and systems name them.
#pragma once

#include <string>
#include <vector>

#include "hmi_bridge/network/network.hpp"
#include "projects/keys/network.hpp"

namespace lockstep {

class JsonValue;
class Problems;
struct Loading;

/// Reads and checks a network, whose names of files are relative to a folder.
/// @param project whether it is that of a project
NetworkConfig read_network(const JsonValue& json, const std::string& folder, bool project,
                           const Loading& loading);
/// Reads one IPv4 network or a list of them. @param json may be nullptr
std::vector<IpNetwork> read_senders(const JsonValue* json, Problems& problems);
/// What is wrong with the channel of a transfer area; empty: nothing.
std::string channel_problem(const std::string& channel);

}  // namespace lockstep
