#include "hmi_bridge/lcm/publisher.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace lockstep {
namespace {

[[noreturn]] void refuse(const std::string& url, const std::string& why) {
  throw std::runtime_error("LCM on " + url + ": " + why);
}

// The address of "udpm://ADDRESS:PORT?options", with LCM's own defaults for what is left out.
sockaddr_in multicast_address(const std::string& url, std::string_view network) {
  network = network.substr(0, network.find('?'));
  const std::size_t colon = network.find(':');
  const std::string host(network.substr(0, colon));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  if (::inet_pton(AF_INET, host.empty() ? "239.255.76.67" : host.c_str(), &address.sin_addr) != 1 ||
      !IN_MULTICAST(ntohl(address.sin_addr.s_addr)))
    refuse(url, "\"" + host + "\" is not a multicast address (224.0.0.0 to 239.255.255.255)");
  std::uint16_t port = 7667;
  if (colon != std::string_view::npos && colon + 1 < network.size()) {
    const std::string_view text = network.substr(colon + 1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
    if (error != std::errc{} || end != text.data() + text.size() || port == 0)
      refuse(url, "\"" + std::string(text) + "\" is not a port (1 to 65535)");
  }
  address.sin_port = htons(port);
  return address;
}

// LCM makes the same attempt, but tells of it on standard error only.
void require_route(const std::string& url, const sockaddr_in& address) {
  const int probe = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const bool routed =
      probe >= 0 && ::connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  const int error = errno;
  if (probe >= 0) ::close(probe);
  if (!routed) refuse(url, "no multicast route: " + std::generic_category().message(error));
}

lcm_t* join(const std::string& url) {
  constexpr std::string_view kUdpm = "udpm://";
  if (url.starts_with(kUdpm))
    require_route(url, multicast_address(url, std::string_view(url).substr(kUdpm.size())));
  else if (url != "memq://")
    refuse(url, "unknown network, udpm://ADDRESS:PORT?ttl=N and memq:// are allowed");
  lcm_t* lcm = lcm_create(url.c_str());
  if (lcm == nullptr) refuse(url, "cannot be joined");
  return lcm;
}

}  // namespace

LcmPublisher::LcmPublisher(const std::string& url, LcmTraceIdentity identity, bool events)
    : url_(url),
      identity_(std::move(identity)),
      header_channel_(identity_.channel + std::string(kHeaderSuffix)),
      events_channel_(identity_.channel + std::string(kEventsSuffix)),
      events_(events),
      lcm_((check_channel(identity_.channel), join(url))) {}

void LcmPublisher::begin(std::span<const TraceSignal> signals) {
  encoder_.emplace(identity_, signals);
  publish_header();
}

void LcmPublisher::row(const TraceRow& row) {
  if (std::chrono::steady_clock::now() >= next_header_) publish_header();
  publish(identity_.channel, encoder_.value().row(row), 1);
}

void LcmPublisher::event(const TraceEvent& event) {
  if (events_) publish(events_channel_, encoder_.value().event(event), 0);
}

void LcmPublisher::flush() {
  if (std::chrono::steady_clock::now() >= next_header_) publish_header();
}

void LcmPublisher::end() {}

void LcmPublisher::publish_header() {
  next_header_ = std::chrono::steady_clock::now() + kHeaderPeriod;
  publish(header_channel_, encoder_.value().header(), 0);
}

void LcmPublisher::publish(const std::string& channel, std::span<const std::uint8_t> bytes,
                           std::uint64_t rows) {
  errno = 0;
  if (lcm_publish(lcm_.get(), channel.c_str(), bytes.data(), static_cast<unsigned>(bytes.size())) == 0)
    return;
  lose(rows, errno != 0 ? std::generic_category().message(errno) : "LCM could not send");
}

}  // namespace lockstep
