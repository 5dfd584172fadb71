#include "hmi_bridge/lcm/publisher.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "hmi_bridge/lcm/url.hpp"

namespace lockstep {
namespace {

// LCM makes the same attempt, but tells of it on standard error only.
void require_route(const std::string& url, const sockaddr_in& address) {
  const int probe = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const bool routed =
      probe >= 0 && ::connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  const int error = errno;
  if (probe >= 0) ::close(probe);
  if (!routed) refuse_lcm(url, "no multicast route: " + std::generic_category().message(error));
}

lcm_t* join(const std::string& url) {
  if (url.starts_with("udpm://"))
    require_route(url, lcm_group(url));
  else if (url != kLcmOwnProcess)
    refuse_lcm(url, "unknown network, udpm://ADDRESS:PORT?ttl=N and memq:// are allowed");
  lcm_t* lcm = lcm_create(url.c_str());
  if (lcm == nullptr) refuse_lcm(url, "cannot be joined");
  return lcm;
}

}  // namespace

LcmPublisher::LcmPublisher(const std::string& url, LcmTraceIdentity identity, bool events)
    : url_(url),
      identity_(std::move(identity)),
      header_channel_(identity_.channel + std::string(kHeaderSuffix)),
      events_channel_(identity_.channel + std::string(kEventsSuffix)),
      detail_channel_(identity_.channel + std::string(kDetailSuffix)),
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
  if (!events_) return;
  publish(events_channel_, encoder_.value().event(event), 0);
  if (has_detail(event)) publish(detail_channel_, encoder_.value().detail(event), 0);
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
