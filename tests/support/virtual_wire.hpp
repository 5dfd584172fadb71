/// Networks of several machines on one: each has a network of its own, and all hang on one wire that takes
/// time and loses frames. Needs the network of a test (`in_own_network`), with the rights of root there.
#pragma once

#include <gtest/gtest.h>
#include <linux/if_packet.h>
#include <net/ethernet.h>
#include <net/if.h>
#include <poll.h>
#include <pthread.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <deque>
#include <map>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/hmi_bridge/own_network.hpp"

namespace lockstep::test {

/// What the wire does to each frame.
struct WireQuality {
  std::chrono::microseconds delay{200};
  std::chrono::microseconds jitter{50};  ///< more or less by up to it, evenly spread
  double loss = 0.001;
  std::int64_t rate = 100'000'000;  ///< at which each machine can send [bit/s]
  std::uint32_t seed = 1;
};

inline int shell(const std::string& line) {
  return ForeignProgram({"sh", "-c", line}).status();
}

/// A wire in this process, for kernels without netem: takes the frames of some interfaces and gives each to
/// all others, later.
class UserWire {
 public:
  UserWire(const std::vector<std::string>& interfaces, const WireQuality& quality)
      : quality_(quality), random_(quality.seed) {
    for (const std::string& name : interfaces) sockets_.push_back(open(name));
    free_.resize(sockets_.size());
    thread_ = std::thread([this] { run(); });
    sched_param priority{.sched_priority = 85};  // above the programs that it stands between
    pthread_setschedparam(thread_.native_handle(), SCHED_FIFO, &priority);
  }
  ~UserWire() {
    stop_ = true;
    thread_.join();
    for (const int socket : sockets_) ::close(socket);
  }
  UserWire(const UserWire&) = delete;
  UserWire& operator=(const UserWire&) = delete;

  std::uint64_t lost() const { return lost_; }
  std::uint64_t carried() const { return carried_; }

 private:
  using Time = std::chrono::steady_clock::time_point;
  struct Frame {
    std::size_t from;
    std::vector<std::uint8_t> bytes;
  };

  static int open(const std::string& name) {
    const int fd = ::socket(AF_PACKET, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, htons(ETH_P_ALL));
    sockaddr_ll address{};
    address.sll_family = AF_PACKET;
    address.sll_protocol = htons(ETH_P_ALL);
    address.sll_ifindex = static_cast<int>(::if_nametoindex(name.c_str()));
    EXPECT_EQ(::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0) << name;
    packet_mreq all{};
    all.mr_ifindex = address.sll_ifindex;
    all.mr_type = PACKET_MR_PROMISC;
    ::setsockopt(fd, SOL_PACKET, PACKET_ADD_MEMBERSHIP, &all, sizeof all);
    return fd;
  }

  void run() {
    pthread_setname_np(pthread_self(), "wire");
    while (!stop_) {
      std::vector<pollfd> sources;
      for (const int socket : sockets_) sources.push_back({socket, POLLIN, 0});
      timespec wait{0, 10'000'000};
      if (!under_way_.empty()) {
        const auto left =
            std::chrono::nanoseconds(under_way_.begin()->first - std::chrono::steady_clock::now());
        wait.tv_nsec = std::clamp<long>(left.count(), 0, wait.tv_nsec);
      }
      ::ppoll(sources.data(), sources.size(), &wait, nullptr);
      for (std::size_t i = 0; i < sockets_.size(); ++i) take(i);
      give();
    }
  }
  void take(std::size_t from) {
    std::array<std::uint8_t, 2048> buffer;
    for (;;) {
      sockaddr_ll address{};
      socklen_t length = sizeof address;
      const ssize_t size = ::recvfrom(sockets_[from], buffer.data(), buffer.size(), 0,
                                      reinterpret_cast<sockaddr*>(&address), &length);
      if (size < 0) return;
      if (address.sll_pkttype == PACKET_OUTGOING) continue;
      if (std::uniform_real_distribution(0.0, 1.0)(random_) < quality_.loss) {
        ++lost_;
        continue;
      }
      ++carried_;
      leave_out_checksum(std::span(buffer).first(static_cast<std::size_t>(size)));
      const auto most = quality_.jitter.count();
      const std::chrono::microseconds jitter(std::uniform_int_distribution(-most, most)(random_));
      under_way_.emplace(sent(from, size) + quality_.delay + jitter,
                         Frame{from, {buffer.begin(), buffer.begin() + size}});
    }
  }
  /// When the last bit of a frame of so many bytes has left its machine, behind those before it.
  Time sent(std::size_t from, ssize_t bytes) {
    const std::chrono::nanoseconds takes(8'000'000'000 * bytes / quality_.rate);
    return free_[from] = std::max(free_[from], std::chrono::steady_clock::now()) + takes;
  }
  /// The kernel leaves the sum of UDP to a network card, which there is none here: 0 says that there is no
  /// sum.
  static void leave_out_checksum(std::span<std::uint8_t> frame) {
    constexpr std::size_t kIp = 14, kShortest = kIp + 20 + 8;
    if (frame.size() < kShortest || frame[12] != 0x08 || frame[13] != 0x00 || frame[kIp + 9] != IPPROTO_UDP)
      return;
    const std::size_t udp = kIp + 4 * std::size_t{frame[kIp] & 0x0fu};
    if (udp + 8 > frame.size()) return;
    frame[udp + 6] = frame[udp + 7] = 0;
  }
  void give() {
    while (!under_way_.empty() && under_way_.begin()->first <= std::chrono::steady_clock::now()) {
      const Frame& frame = under_way_.begin()->second;
      for (std::size_t to = 0; to < sockets_.size(); ++to)
        if (to != frame.from) (void)!::write(sockets_[to], frame.bytes.data(), frame.bytes.size());
      under_way_.erase(under_way_.begin());
    }
  }

  const WireQuality quality_;
  std::mt19937 random_;
  std::vector<int> sockets_;
  std::vector<Time> free_;  // when each machine has sent what it had to
  std::multimap<Time, Frame> under_way_;
  std::atomic<std::uint64_t> lost_{0}, carried_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

/// Some machines, with the addresses 10.7.0.1, 10.7.0.2, …, on a bridge of the kernel whose ports have netem,
/// or, where the kernel has none, on a wire in this process.
class VirtualPlant {
 public:
  VirtualPlant(std::size_t machines, const WireQuality& quality) {
    for (std::size_t i = 1; i <= machines; ++i) add(std::to_string(i));
    if (testing::Test::HasFailure()) return;
    netem_ = bridged(quality);
    if (!netem_) wire_ = std::make_unique<UserWire>(ports_, quality);
  }

  /// A command line that runs in the network of a machine, from 0.
  std::vector<std::string> on(std::size_t machine, const std::vector<std::string>& command) const {
    std::vector<std::string> line{"nsenter", "-t", std::to_string(machines_[machine]->process()), "-n", "--"};
    line.insert(line.end(), command.begin(), command.end());
    return line;
  }
  /// What carries the frames, in words.
  std::string carrier() const { return netem_ ? "netem" : "a wire in user space"; }
  const UserWire* wire() const { return wire_.get(); }

 private:
  void add(const std::string& number) {
    machines_.push_back(std::make_unique<ForeignProgram>(
        std::vector<std::string>{"unshare", "-n", "sh", "-c", "ip link set lo up && exec sleep 86400"}));
    const std::string process = std::to_string(machines_.back()->process());
    const std::string port = "port" + number;
    ASSERT_TRUE(wait_until([&] {  // until it has its network
      return shell("test \"$(readlink /proc/" + process +
                   "/ns/net)\" != \"$(readlink /proc/self/ns/net)\"") == 0;
    }));
    const std::string inside = "nsenter -t " + process + " -n -- ip ";
    ASSERT_EQ(
        shell("set -e; ip link add " + port + " type veth peer name eth0 netns " + process +
              "; ip link set " + port + " up; " + inside + "addr add 10.7.0." + number + "/24 dev eth0; " +
              inside + "link set eth0 up; " + inside + "route add 224.0.0.0/4 dev eth0"),
        0);
    ports_.push_back(port);
  }
  bool bridged(const WireQuality& quality) const {
    const std::string netem = "netem delay " + std::to_string(quality.delay.count()) + "us " +
                              std::to_string(quality.jitter.count()) + "us loss " +
                              std::to_string(100.0 * quality.loss) + "% rate " +
                              std::to_string(quality.rate) + "bit";
    std::string line = "set -e; exec 2>/dev/null; ";
    for (const std::string& port : ports_) line += "tc qdisc add dev " + port + " root " + netem + "; ";
    if (shell(line) != 0) return false;
    line = "set -e; ip link add plant type bridge mcast_snooping 0; ip link set plant up; ";
    for (const std::string& port : ports_) line += "ip link set " + port + " master plant; ";
    EXPECT_EQ(shell(line), 0);
    return true;
  }

  std::vector<std::unique_ptr<ForeignProgram>> machines_;
  std::vector<std::string> ports_;
  bool netem_ = false;
  std::unique_ptr<UserWire> wire_;
};

}  // namespace lockstep::test
