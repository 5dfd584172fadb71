#include "projects/loader/network.hpp"

#include <filesystem>

#include "hmi_bridge/lcm/channel_length.hpp"
#include "hmi_bridge/lcm/url.hpp"
#include "projects/json/addresses.hpp"
#include "projects/json/fields.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/read_keys.hpp"

namespace lockstep {

NetworkConfig read_network(const JsonValue& json, const std::string& folder, bool project,
                           const Loading& loading) {
  NetworkConfig network;
  if (project)
    read_struct(json, keys::kProjectNetwork, network, loading);
  else
    read_struct(json, keys::kNetwork, network, loading);
  const JsonValue* const url = json.find("lcm");
  if (url != nullptr && url->kind == JsonKind::string) {
    if (lcm_leaves_machine(network.lcm) && network.key_file.empty())
      loading.problems.warn(
          *url,
          "whoever reaches this network can send leading values in another's name; 'key_file' "
          "has them signed, and with ttl=0 only programs on this machine can");
  }
  if (!network.key_file.empty())
    network.key_file = (std::filesystem::path(folder) / network.key_file).lexically_normal().string();
  return network;
}

namespace {

void read_sender(const JsonValue& json, std::vector<IpNetwork>& senders, Problems& problems) {
  std::string problem;
  if (const auto text = read_form(&json, kSenderForm, problems))
    senders.push_back(IpNetwork::parse(*text, problem).value());
}

}  // namespace

std::vector<IpNetwork> read_senders(const JsonValue* json, Problems& problems) {
  std::vector<IpNetwork> senders;
  if (json == nullptr) return senders;
  if (json->kind != JsonKind::array) {
    read_sender(*json, senders, problems);
    return senders;
  }
  if (json->elements.empty())
    problems.report(*json, "an empty list lets nobody in; allowed: one network or more");
  for (const JsonValue* const element : json->elements) read_sender(*element, senders, problems);
  return senders;
}

std::string channel_problem(const std::string& channel) {
  if (channel.size() <= kLongestLcmChannel) return "";
  return "the channel " + quote(channel) + " is too long; allowed: up to " +
         std::to_string(kLongestLcmChannel) + " bytes";
}

}  // namespace lockstep
