/// Endpoints on an IP network: where a server listens, and from where clients may come.
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep {

/// Where a server listens.
struct Endpoint {
  std::string host;        ///< IPv4 or IPv6 address without brackets, or a name
  std::uint16_t port = 0;  ///< 0: any that is free
  bool operator==(const Endpoint&) const = default;
};

/// "HOST:PORT", an IPv6 address in brackets.
std::string to_string(const Endpoint& endpoint);

/// Whether a host can be reached from this machine alone: 127.0.0.0/8, ::1, localhost.
bool is_loopback(std::string_view host) noexcept;

/// A range of addresses, IPv4 or IPv6.
class IpNetwork {
 public:
  /// Reads "192.168.1.0/24", "fd00::/8", or a single address.
  /// @return none if it is something else, with what is wrong and what is allowed in `problem`
  static std::optional<IpNetwork> parse(std::string_view text, std::string& problem);

  /// Whether the address of a peer lies in it; an IPv4 address lies in no IPv6 network and the other way
  /// round.
  bool contains(const sockaddr_storage& peer) const noexcept;
  bool contains(const sockaddr_in& peer) const noexcept;

  /// As it is written, a single address without a prefix length.
  std::string text() const;
  bool operator==(const IpNetwork&) const = default;

 private:
  using Address = std::array<std::uint8_t, 16>;

  int size() const noexcept { return is_v6_ ? 16 : 4; }  ///< [byte]
  bool same_prefix(const Address& other) const noexcept;

  bool is_v6_ = false;
  int prefix_ = 0;  ///< [bit]
  Address address_{};
};

}  // namespace lockstep
