#include "hmi_bridge/network/network.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <charconv>
#include <cstring>

namespace lockstep {

std::string to_string(const Endpoint& endpoint) {
  const bool is_v6 = endpoint.host.find(':') != std::string::npos;
  return (is_v6 ? "[" + endpoint.host + "]" : endpoint.host) + ":" + std::to_string(endpoint.port);
}

bool is_loopback(std::string_view host) noexcept {
  return host == "::1" || host == "localhost" ||
         (host.starts_with("127.") && host.find_first_not_of("0123456789.") == host.npos);
}

std::optional<IpNetwork> IpNetwork::parse(std::string_view text, std::string& problem) {
  problem =
      "allowed: an IPv4 or IPv6 address, alone or with the length of its prefix, as in 192.168.1.0/24 or "
      "fd00::/8";
  const auto slash = text.find('/');
  const std::string host(text.substr(0, slash));
  IpNetwork network;
  network.is_v6_ = host.find(':') != std::string::npos;
  if (host.size() > 64 ||
      ::inet_pton(network.is_v6_ ? AF_INET6 : AF_INET, host.c_str(), network.address_.data()) != 1)
    return std::nullopt;
  const int bits = 8 * network.size();
  network.prefix_ = bits;
  if (slash != text.npos) {
    const std::string_view length = text.substr(slash + 1);
    const char* const end = length.data() + length.size();
    const auto [stop, error] = std::from_chars(length.data(), end, network.prefix_);
    if (error != std::errc{} || stop != end || network.prefix_ < 0 || network.prefix_ > bits)
      return std::nullopt;
  }
  // An address behind its prefix is a mistake of one of the two, and nobody knows of which.
  Address masked{};
  for (int bit = 0; bit < network.prefix_; ++bit)
    masked[static_cast<std::size_t>(bit / 8)] |=
        static_cast<std::uint8_t>(network.address_[static_cast<std::size_t>(bit / 8)] & (0x80 >> bit % 8));
  if (masked != network.address_) {
    problem = "its address has bits behind the prefix; " + problem;
    return std::nullopt;
  }
  problem.clear();
  return network;
}

bool IpNetwork::same_prefix(const Address& other) const noexcept {
  for (int bit = 0; bit < prefix_; ++bit) {
    const auto byte = static_cast<std::size_t>(bit / 8);
    if (((address_[byte] ^ other[byte]) & (0x80 >> bit % 8)) != 0) return false;
  }
  return true;
}

bool IpNetwork::contains(const sockaddr_storage& peer) const noexcept {
  Address address{};
  if (is_v6_ && peer.ss_family == AF_INET6) {
    sockaddr_in6 endpoint;
    std::memcpy(&endpoint, &peer, sizeof endpoint);
    std::memcpy(address.data(), &endpoint.sin6_addr, 16);
    return same_prefix(address);
  }
  if (is_v6_ || peer.ss_family != AF_INET) return false;
  sockaddr_in endpoint;
  std::memcpy(&endpoint, &peer, sizeof endpoint);
  return contains(endpoint);
}

bool IpNetwork::contains(const sockaddr_in& peer) const noexcept {
  if (is_v6_) return false;
  Address address{};
  std::memcpy(address.data(), &peer.sin_addr, 4);
  return same_prefix(address);
}

std::string IpNetwork::text() const {
  char host[INET6_ADDRSTRLEN] = "";
  ::inet_ntop(is_v6_ ? AF_INET6 : AF_INET, address_.data(), host, sizeof host);
  return prefix_ == 8 * size() ? host : std::string(host) + "/" + std::to_string(prefix_);
}

}  // namespace lockstep
