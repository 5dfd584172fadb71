#include "hmi_bridge/lcm/receiver.hpp"

#include <arpa/inet.h>
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

constexpr std::size_t kLongestDatagram = 65536;
constexpr int kSocketBuffer = 4 << 20;  // asked for [byte]; the system gives what net.core.rmem_max lets it
constexpr int kQueue = 1000;            // of memq://, beyond which LCM drops messages

[[noreturn]] void refuse(std::string_view url, const char* what, int error) {
  throw std::runtime_error("LCM on " + std::string(url) + ": " + what + ": " +
                           std::generic_category().message(error));
}

/// A socket that hears one group and port, and nothing else that comes to the port.
int join(std::string_view url) {
  const sockaddr_in group = lcm_group(std::string(url));
  const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd < 0) refuse(url, "no socket", errno);
  const auto must = [&](int result, const char* what) {
    if (result == 0) return;
    const int error = errno;
    ::close(fd);
    refuse(url, what, error);
  };
  const int on = 1, off = 0;
  must(::setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on), "the port cannot be shared");
  ::setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &kSocketBuffer, sizeof kSocketBuffer);
  ::setsockopt(fd, IPPROTO_IP, IP_MULTICAST_ALL, &off, sizeof off);
  must(::bind(fd, reinterpret_cast<const sockaddr*>(&group), sizeof group), "the port cannot be had");
  ip_mreq membership{};
  membership.imr_multiaddr = group.sin_addr;
  membership.imr_interface.s_addr = htonl(INADDR_ANY);
  must(::setsockopt(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership),
       "the group cannot be joined");
  return fd;
}

}  // namespace

LcmReceiver::LcmReceiver(LcmPublisher& joined, std::string channel, LcmBounds bounds, Handler handler)
    : channel_(std::move(channel)), handler_(std::move(handler)), reassembly_(bounds) {
  if (joined.name() != kLcmOwnProcess) {
    datagram_ = std::make_unique<std::uint8_t[]>(kLongestDatagram);
    socket_ = join(joined.name());
    return;
  }
  own_ = joined.instance();
  auto* const subscription = lcm_subscribe(own_, ".*", &LcmReceiver::take_own, this);
  if (subscription == nullptr) throw std::runtime_error("LCM on memq://: cannot be subscribed to");
  lcm_subscription_set_queue_capacity(subscription, kQueue);
}

LcmReceiver::~LcmReceiver() {
  if (socket_ >= 0) ::close(socket_);
}

int LcmReceiver::descriptor() const noexcept {
  return own_ != nullptr ? lcm_get_fileno(own_) : socket_;
}

int LcmReceiver::take(int maximum) {
  int taken = 0;
  while (taken < maximum && (own_ != nullptr ? lcm_handle_timeout(own_, 0) > 0 : take_datagram())) ++taken;
  return taken;
}

bool LcmReceiver::take_datagram() {
  sockaddr_in sender{};
  socklen_t length = sizeof sender;
  const ssize_t size = ::recvfrom(socket_, datagram_.get(), kLongestDatagram, 0,
                                  reinterpret_cast<sockaddr*>(&sender), &length);
  if (size < 0) return false;
  const std::uint64_t address = std::uint64_t{sender.sin_addr.s_addr} << 16 | sender.sin_port;
  const std::span<const std::uint8_t> bytes(datagram_.get(), static_cast<std::size_t>(size));
  auto message = reassembly_.accept(bytes, address, LcmReassembly::Clock::now());
  if (!message || (!channel_.empty() && message->channel != channel_)) return true;
  char text[INET_ADDRSTRLEN + 6] = "";
  ::inet_ntop(AF_INET, &sender.sin_addr, text, INET_ADDRSTRLEN);
  const std::string from = text + (":" + std::to_string(ntohs(sender.sin_port)));
  message->sender = from;
  message->address = sender;
  hand_on(*message);
  return true;
}

void LcmReceiver::take_own(const lcm_recv_buf_t* buffer, const char* channel, void* self) noexcept {
  try {
    static_cast<LcmReceiver*>(self)->hand_on(
        {channel, {static_cast<const std::uint8_t*>(buffer->data), buffer->data_size}});
  } catch (...) {  // C calls this; a message for which there is no memory is lost
  }
}

void LcmReceiver::hand_on(const LcmMessage& message) {
  if (channel_.empty() || message.channel == channel_) handler_(message);
}

}  // namespace lockstep
