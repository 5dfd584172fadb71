#include <arpa/inet.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "hmi_bridge/lcm/url.hpp"

namespace lockstep::lcm_url_test {
namespace {

std::string group_of(const std::string& url) try {
  const sockaddr_in group = lcm_group(url);
  char host[INET_ADDRSTRLEN] = "";
  ::inet_ntop(AF_INET, &group.sin_addr, host, sizeof host);
  return std::string(host) + ":" + std::to_string(ntohs(group.sin_port));
} catch (const std::runtime_error& error) {
  return error.what();
}

TEST(LcmUrl, LeavesOutWhatLcmLeavesOut) {
  EXPECT_EQ(group_of("udpm://"), "239.255.76.67:7667");
  EXPECT_EQ(group_of("udpm://?ttl=1"), "239.255.76.67:7667");
  EXPECT_EQ(group_of("udpm://224.0.0.9"), "224.0.0.9:7667");
  EXPECT_EQ(group_of("udpm://239.1.1.1:99?ttl=1&recv_buf_size=5"), "239.1.1.1:99");
  EXPECT_EQ(group_of("udpm://192.168.0.1:99"),
            "LCM on udpm://192.168.0.1:99: \"192.168.0.1\" is not a multicast address (224.0.0.0 to "
            "239.255.255.255)");
  EXPECT_EQ(group_of("udpm://239.1.1.1:0"), "LCM on udpm://239.1.1.1:0: \"0\" is not a port (1 to 65535)");
}

TEST(LcmUrl, TellsWhatIsHeardBeyondTheMachine) {
  for (const char* url :
       {"memq://", "udpm://", "udpm://239.1.1.1:99", "udpm://239.1.1.1:99?ttl=0", "udpm://?ttl=00",
        "udpm://?recv_buf_size=9&ttl=0", "udpm://?ttl=0&recv_buf_size=3", "udpm://?xttl=3"})
    EXPECT_FALSE(lcm_leaves_machine(url)) << url;
  for (const char* url :
       {"udpm://?ttl=1", "udpm://239.1.1.1:99?ttl=3", "udpm://?recv_buf_size=9&ttl=2",
        "udpm://?ttl=3&recv_buf_size=0", "udpm://?ttl=0&ttl=1", "udpm://?ttl=0x1", "udpm://?ttl=-1"})
    EXPECT_TRUE(lcm_leaves_machine(url)) << url;
}

}  // namespace
}  // namespace lockstep::lcm_url_test
