#include "hmi_bridge/lcm/url.hpp"

#include <arpa/inet.h>

#include <charconv>
#include <stdexcept>
#include <system_error>

namespace lockstep {

void refuse_lcm(const std::string& url, const std::string& why) {
  throw std::runtime_error("LCM on " + url + ": " + why);
}

sockaddr_in lcm_group(const std::string& url) {
  constexpr std::string_view kScheme = "udpm://";
  std::string_view network = url;
  if (network.starts_with(kScheme)) network.remove_prefix(kScheme.size());
  network = network.substr(0, network.find('?'));
  const std::size_t colon = network.find(':');
  const std::string host(network.substr(0, colon));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  if (::inet_pton(AF_INET, host.empty() ? "239.255.76.67" : host.c_str(), &address.sin_addr) != 1 ||
      !IN_MULTICAST(ntohl(address.sin_addr.s_addr)))
    refuse_lcm(url, "\"" + host + "\" is not a multicast address (224.0.0.0 to 239.255.255.255)");
  std::uint16_t port = 7667;
  if (colon != std::string_view::npos && colon + 1 < network.size()) {
    const std::string_view text = network.substr(colon + 1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
    if (error != std::errc{} || end != text.data() + text.size() || port == 0)
      refuse_lcm(url, "\"" + std::string(text) + "\" is not a port (1 to 65535)");
  }
  address.sin_port = htons(port);
  return address;
}

bool lcm_leaves_machine(std::string_view url) noexcept {
  constexpr std::string_view kTtl = "ttl=";
  std::size_t at = url.find('?');
  while (at != url.npos) {
    std::string_view option = url.substr(at + 1);
    at = url.find('&', at + 1);
    option = option.substr(0, option.find('&'));
    if (!option.starts_with(kTtl)) continue;
    // Anything but zeros counts as above 0, whatever LCM makes of it.
    if (option.substr(kTtl.size()).find_first_not_of('0') != option.npos) return true;
  }
  return false;
}

}  // namespace lockstep
