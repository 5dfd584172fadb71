#include "hmi_bridge/network/network.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>

#include <cstring>

namespace lockstep::network_test {
namespace {

sockaddr_storage peer(const char* text) {
  sockaddr_storage storage{};
  sockaddr_in v4{};
  sockaddr_in6 v6{};
  v4.sin_family = AF_INET;
  v6.sin6_family = AF_INET6;
  if (::inet_pton(AF_INET, text, &v4.sin_addr) == 1)
    std::memcpy(&storage, &v4, sizeof v4);
  else if (::inet_pton(AF_INET6, text, &v6.sin6_addr) == 1)
    std::memcpy(&storage, &v6, sizeof v6);
  return storage;
}

bool contains(const char* network, const char* address) {
  std::string problem;
  const auto parsed = IpNetwork::parse(network, problem);
  EXPECT_TRUE(parsed.has_value()) << problem;
  return parsed && parsed->contains(peer(address));
}

TEST(IpNetwork, ContainsTheAddressesWithItsPrefix) {
  EXPECT_TRUE(contains("192.168.1.0/24", "192.168.1.255"));
  EXPECT_FALSE(contains("192.168.1.0/24", "192.168.2.0"));
  EXPECT_TRUE(contains("10.128.0.0/9", "10.200.1.2"));
  EXPECT_FALSE(contains("10.128.0.0/9", "10.127.1.2"));
  EXPECT_TRUE(contains("127.0.0.1", "127.0.0.1"));
  EXPECT_FALSE(contains("127.0.0.1", "127.0.0.2"));
  EXPECT_TRUE(contains("0.0.0.0/0", "8.8.8.8"));
  EXPECT_TRUE(contains("fd00::/8", "fdab::1"));
  EXPECT_FALSE(contains("fd00::/8", "fe80::1"));
  EXPECT_TRUE(contains("::1", "::1"));
}

TEST(IpNetwork, OfOneFamilyContainsNothingOfTheOther) {
  EXPECT_FALSE(contains("0.0.0.0/0", "::1"));
  EXPECT_FALSE(contains("::/0", "127.0.0.1"));
}

TEST(IpNetwork, IsToldWhenItIsNone) {
  for (const char* wrong : {"", "localhost", "1.2.3", "1.2.3.4/33", "1.2.3.4/-1", "1.2.3.4/", "1.2.3.4/8",
                            "::1/129", "fd00::1/8", "1.2.3.4/24x"}) {
    std::string problem;
    EXPECT_FALSE(IpNetwork::parse(wrong, problem).has_value()) << wrong;
    EXPECT_NE(problem.find("allowed"), std::string::npos) << wrong;
  }
}

TEST(IpNetwork, IsShownAsItIsWritten) {
  for (const char* text : {"192.168.1.0/24", "::1", "fd00::/8", "127.0.0.1"}) {
    std::string problem;
    EXPECT_EQ(IpNetwork::parse(text, problem)->text(), text);
  }
}

TEST(Endpoint, OfIpv6StandsInBrackets) {
  EXPECT_EQ(to_string(Endpoint{"::1", 502}), "[::1]:502");
  EXPECT_EQ(to_string(Endpoint{"plc", 1}), "plc:1");
  EXPECT_TRUE(is_loopback("127.1.2.3") && is_loopback("::1") && is_loopback("localhost"));
  EXPECT_FALSE(is_loopback("0.0.0.0") || is_loopback("::") || is_loopback("192.168.1.1"));
}

}  // namespace
}  // namespace lockstep::network_test
