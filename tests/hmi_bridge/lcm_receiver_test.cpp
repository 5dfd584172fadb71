// The receiver of our own beside the sender of LCM's library.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>

#include <fstream>
#include <map>
#include <sstream>

#include "hmi_bridge/lcm/receiver.hpp"
#include "tests/hmi_bridge/own_network.hpp"
#include "tests/support/datagrams.hpp"

namespace lockstep::lcm_receiver_test {
namespace {

constexpr char kUrl[] = "udpm://239.255.76.67:7667?ttl=0";
const LcmTraceIdentity kIdentity{"p", "C", 1'000'000, 0};

/// What has been heard, by channel.
class Heard {
 public:
  explicit Heard(LcmPublisher& joined, const std::string& channel = "")
      : receiver_(joined, channel, LcmBounds{}, [this](const LcmMessage& message) {
          messages[std::string(message.channel)].emplace_back(message.data.begin(), message.data.end());
        }) {}
  bool hear_until(const std::function<bool()>& condition) {
    return wait_until([&] {
      pollfd source{receiver_.descriptor(), POLLIN, 0};
      if (poll(&source, 1, 10) > 0) receiver_.take(100);
      return condition();
    });
  }
  const LcmDatagramCounters& counters() const { return receiver_.counters(); }

  std::map<std::string, std::vector<std::string>> messages;

 private:
  LcmReceiver receiver_;
};

void publish(LcmPublisher& publisher, const char* channel, const std::string& data) {
  ASSERT_EQ(lcm_publish(publisher.instance(), channel, data.data(), static_cast<unsigned>(data.size())), 0);
}

std::string sample(std::size_t size) {
  std::string data(size, '\0');
  for (std::size_t i = 0; i < size; ++i) data[i] = static_cast<char>(i * 31 + i / 257);
  return data;
}

TEST(LcmReceiver, HearsWhatLcmSendsShortOrInFragments) {
  in_own_network([] {
    bring_up_network();
    LcmPublisher publisher(kUrl, kIdentity);
    Heard all(publisher), one(publisher, "ONE");
    const std::string longest(63, 'x');
    // The last of one datagram, the first of two, and one of several.
    for (const std::size_t size : {0, 9, 65'495, 65'496, 150'000})
      for (const std::string& channel : {std::string("ONE"), longest}) {
        publish(publisher, channel.c_str(), sample(size));
        const auto comes_to = [&](Heard& heard) {
          std::vector<std::string>& got = heard.messages[channel];
          ASSERT_TRUE(heard.hear_until([&] { return !got.empty(); }));
          EXPECT_EQ(got, std::vector<std::string>{sample(size)});
          got.clear();
        };
        comes_to(all);
        if (channel == "ONE") comes_to(one);
      }
    EXPECT_EQ(one.messages.size(), 1u) << "no other channel";
    EXPECT_EQ(all.counters().malformed + all.counters().refused + all.counters().given_up, 0u);
  });
}

/// Local addresses of sockets that have a port, as /proc/net/udp writes them.
std::vector<std::string> bound_to(const std::string& port) {
  std::ifstream table("/proc/net/udp");
  std::vector<std::string> found;
  for (std::string line; std::getline(table, line);) {
    std::istringstream words(line);
    std::string slot, local;
    words >> slot >> local;
    if (local.ends_with(":" + port)) found.push_back(local);
  }
  return found;
}

// Whoever reaches this machine could send to the port of a socket that is open to any address.
TEST(LcmReceiver, HearsItsGroupAndNothingElseThatComesToThePort) {
  in_own_network([] {
    bring_up_network();
    LcmPublisher publisher(kUrl, kIdentity);
    publish(publisher, "ONE", "data");
    EXPECT_EQ(bound_to("1DF3"), std::vector<std::string>{}) << "LCM's library receives nothing";
    Heard heard(publisher);
    EXPECT_EQ(bound_to("1DF3"), std::vector<std::string>{"434CFFEF:1DF3"});
    const int other = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(7667);
    const auto datagram = test::short_datagram("ONE", "forged");
    for (const char* host : {"127.0.0.1", "239.255.76.68"}) {
      ::inet_pton(AF_INET, host, &address.sin_addr);
      ::sendto(other, datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr*>(&address),
               sizeof address);
    }
    ::close(other);
    publish(publisher, "ONE", "last");
    ASSERT_TRUE(heard.hear_until([&] { return !heard.messages["ONE"].empty(); }));
    EXPECT_EQ(heard.messages["ONE"], std::vector<std::string>{"last"});
  });
}

TEST(LcmReceiver, HearsWithinItsProcess) {
  LcmPublisher publisher("memq://", kIdentity);
  Heard heard(publisher, "ONE");
  publish(publisher, "ONE", "data");
  publish(publisher, "ONE_MORE", "data");
  ASSERT_TRUE(heard.hear_until([&] { return !heard.messages["ONE"].empty(); }));
  EXPECT_EQ(heard.messages["ONE"], std::vector<std::string>{"data"});
  EXPECT_EQ(heard.messages.size(), 1u);
}

}  // namespace
}  // namespace lockstep::lcm_receiver_test
