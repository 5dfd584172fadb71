#include "projects/json/addresses.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <utility>

#include "projects/json/problem.hpp"

namespace lockstep {
namespace {

/// Reads a decimal number without sign; none if the text is something else or too large.
std::optional<std::uint32_t> number_of(std::string_view text) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return number;
}

bool is_host(std::string_view host) {
  constexpr std::size_t kLongestHost = 253;
  return !host.empty() && host.size() <= kLongestHost && std::all_of(host.begin(), host.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '-' || c == '_';
  });
}

/// The address within "[…]"; none if it is no IPv6 address.
std::optional<std::string> bracketed_address(std::string_view host) {
  if (host.size() < 4 || host.front() != '[' || host.back() != ']') return std::nullopt;
  std::string address(host.substr(1, host.size() - 2));
  std::string problem;
  if (address.find(':') == address.npos || address.find('/') != address.npos ||
      !IpNetwork::parse(address, problem))
    return std::nullopt;
  return address;
}

/// The first number of an IPv4 address; none if it is no address.
std::optional<std::uint32_t> first_of_address(std::string_view address) {
  std::optional<std::uint32_t> first;
  for (int part = 0; part < 4; ++part) {
    const auto point = part < 3 ? address.find('.') : address.size();
    if (point == address.npos) return std::nullopt;
    const auto number = number_of(address.substr(0, point));
    if (!number || *number > 255) return std::nullopt;
    if (!first) first = number;
    address.remove_prefix(part < 3 ? point + 1 : point);
  }
  return first;
}

}  // namespace

std::optional<Endpoint> parse_endpoint(std::string_view text, std::string& problem) {
  const auto colon = text.rfind(':');
  const auto port = colon == text.npos ? std::nullopt : number_of(text.substr(colon + 1));
  const std::string_view host = text.substr(0, colon);
  if (port && *port <= 65535) {
    if (is_host(host)) return Endpoint{std::string(host), static_cast<std::uint16_t>(*port)};
    if (auto address = bracketed_address(host))
      return Endpoint{std::move(*address), static_cast<std::uint16_t>(*port)};
  }
  problem = quote(text) +
            " is not HOST:PORT; allowed: an IPv4 address, an IPv6 address in brackets or a name, a colon and "
            "a port from 0 to 65535, as in 127.0.0.1:1502 or [::1]:1502";
  return std::nullopt;
}

std::string endpoint_problem(std::string_view text) {
  std::string problem;
  return parse_endpoint(text, problem) ? "" : problem;
}

std::string network_problem(std::string_view text) {
  std::string problem;
  return IpNetwork::parse(text, problem) ? "" : quote(text) + " is no network; " + problem;
}

std::string sender_problem(std::string_view text) {
  std::string problem;
  if (IpNetwork::parse(text, problem) && text.find(':') == text.npos) return "";
  return quote(text) +
         " is no IPv4 network; allowed: an IPv4 address, alone or with the length of its prefix, as in "
         "192.168.1.0/24";
}

std::string lcm_url_problem(std::string_view url) {
  const std::string problem =
      quote(url) +
      " is no address of an LCM network; allowed: udpm://ADDRESS:PORT?ttl=N with "
      "a multicast address (224.0.0.0 to 239.255.255.255) and N from 0 to 255, memq://";
  if (url == "memq://") return "";
  constexpr std::string_view kScheme = "udpm://";
  if (!url.starts_with(kScheme)) return problem;
  url.remove_prefix(kScheme.size());
  const auto question = url.find('?');
  const std::string_view network = url.substr(0, question);
  if (question != url.npos) {
    const std::string_view option = url.substr(question + 1);
    const auto ttl = option.starts_with("ttl=") ? number_of(option.substr(4)) : std::nullopt;
    if (!ttl || *ttl > 255) return problem;
  }
  if (network.empty()) return "";
  const auto colon = network.find(':');
  if (colon != network.npos) {
    const auto port = number_of(network.substr(colon + 1));
    if (!port || *port == 0 || *port > 65535) return problem;
  }
  const auto first = first_of_address(network.substr(0, colon));
  return first && *first >= 224 && *first <= 239 ? "" : problem;
}

}  // namespace lockstep
