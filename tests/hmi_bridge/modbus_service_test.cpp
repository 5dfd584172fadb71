// Who may ask, where and how often.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "hmi_bridge/modbus/server.hpp"
#include "tests/hmi_bridge/modbus_machine.hpp"
#include "tests/hmi_bridge/modbus_raw_client.hpp"

namespace lockstep::modbus_service_test {
namespace {

using Bytes = RawClient::Bytes;
using Clock = std::chrono::steady_clock;

/// Reads holding register 32, which is 77.
const Bytes kRequest = {0, 1, 0, 0, 0, 6, 1, 3, 0, 32, 0, 1};
const Bytes kAnswer = {0, 1, 0, 0, 0, 5, 1, 3, 2, 0, 77};

IpNetwork network(const char* text) {
  std::string problem;
  return *IpNetwork::parse(text, problem);
}

ModbusServerOptions at(std::vector<Endpoint> places) {
  ModbusServerOptions options;
  options.listen = std::move(places);
  return options;
}

class Service : public ::testing::Test {
 protected:
  void serve(std::vector<ModbusService> services) {
    server = std::make_unique<ModbusServer>(std::move(services), machine.image);
    ASSERT_EQ(server->start(), "");
  }
  void serve(const ModbusServerOptions& options) { serve({ModbusService{options, machine.map}}); }

  void expect_served(RawClient& client) {
    ASSERT_TRUE(client.send(kRequest));
    EXPECT_EQ(client.receive(kAnswer.size()), kAnswer);
  }

  ModbusMachine machine;
  std::unique_ptr<ModbusServer> server;
};

TEST_F(Service, ListensAtSeveralAddresses) {
  serve(at({{"127.0.0.1", 0}, {"127.0.0.2", 0}, {"localhost", 0}}));
  ASSERT_EQ(server->endpoints().size(), 3u);
  for (const std::size_t place : {0u, 2u}) {
    RawClient client(server->endpoints()[place].port);
    expect_served(client);
  }
  EXPECT_NE(server->endpoints()[0].port, server->endpoints()[2].port);
}

TEST_F(Service, ListensOnIpv6WhereTheMachineHasIt) {
  ModbusServer on_six({ModbusService{at({{"::1", 0}}), machine.map}}, machine.image);
  const std::string problem = on_six.start();
  if (problem.empty()) {
    RawClient client(on_six.port(), AF_INET6);
    expect_served(client);
  } else {
    EXPECT_TRUE(problem == "[::1]:0: Cannot assign requested address" ||
                problem == "[::1]:0: Address family not supported by protocol")
        << problem;
  }
}

TEST_F(Service, EachPlaceServesItsOwnMap) {
  const ModbusMap empty({}, {});
  serve({{at({{"127.0.0.1", 0}}), machine.map}, {at({{"127.0.0.1", 0}}), empty}});
  RawClient first(server->endpoints()[0].port);
  expect_served(first);
  RawClient second(server->endpoints()[1].port);
  ASSERT_TRUE(second.send(kRequest));
  EXPECT_EQ(second.receive(9), (Bytes{0, 1, 0, 0, 0, 3, 1, 0x83, 2}));
}

TEST_F(Service, AWriteAtOnePlaceIsReadAtAnotherAtOnce) {
  serve({{at({{"127.0.0.1", 0}}), machine.map}, {at({{"127.0.0.1", 0}}), machine.map}});
  RawClient first(server->endpoints()[0].port);
  RawClient second(server->endpoints()[1].port);
  for (std::uint8_t n = 1; n < 100; ++n) {
    ASSERT_TRUE(first.send({0, 1, 0, 0, 0, 6, 1, 6, 0, 200, 0, n}));
    ASSERT_EQ(first.receive(12).size(), 12u);
    ASSERT_TRUE(second.send({0, 1, 0, 0, 0, 6, 1, 3, 0, 200, 0, 1}));
    ASSERT_EQ(second.receive(11), (Bytes{0, 1, 0, 0, 0, 5, 1, 3, 2, 0, n}));
  }
}

TEST_F(Service, AClientFromElsewhereIsRefusedAndCounted) {
  ModbusServerOptions options = at({{"127.0.0.1", 0}});
  options.allow = {network("10.0.0.0/8"), network("127.0.0.2")};
  serve({{options, machine.map}, {at({{"127.0.0.1", 0}}), machine.map}});
  for (int i = 1; i <= 3; ++i) {
    RawClient client(server->port());
    EXPECT_TRUE(client.is_hung_up_on());
  }
  EXPECT_EQ(server->counters().not_allowed, 3u);
  EXPECT_EQ(server->counters().refused, 0u);
  EXPECT_EQ(server->counters().connections, 0u);
  RawClient at_the_other_place(server->endpoints()[1].port);
  expect_served(at_the_other_place);
}

TEST_F(Service, AClientFromAnAllowedNetworkIsServed) {
  ModbusServerOptions options = at({{"127.0.0.1", 0}});
  options.allow = {network("10.0.0.0/8"), network("127.0.0.0/8")};
  serve(options);
  RawClient client(server->port());
  expect_served(client);
  EXPECT_EQ(server->counters().not_allowed, 0u);
}

TEST_F(Service, AClientThatAsksTooOftenWaitsAndGetsEveryAnswer) {
  ModbusServerOptions options = at({{"127.0.0.1", 0}});
  options.requests_per_second = 50;
  serve({{options, machine.map}, {at({{"127.0.0.1", 0}}), machine.map}});
  RawClient client(server->port());
  const auto begin = Clock::now();
  Bytes all;
  for (int i = 0; i < 30; ++i) all.insert(all.end(), kRequest.begin(), kRequest.end());
  ASSERT_TRUE(client.send(all));
  RawClient unlimited(server->endpoints()[1].port);
  for (int i = 0; i < 200; ++i) expect_served(unlimited);
  for (int i = 0; i < 30; ++i) ASSERT_EQ(client.receive(kAnswer.size()), kAnswer);
  // 30 requests at 50 per second, of which the first ones may come 100 ms ahead.
  EXPECT_GE(Clock::now() - begin, std::chrono::milliseconds(29 * 20 - 100));
  EXPECT_GE(server->counters().throttled, 20u);
  EXPECT_EQ(server->counters().requests, 230u);
}

TEST_F(Service, AClientThatAsksForNothingIsDisconnectedAfterTheIdleLimit) {
  ModbusServerOptions options = at({{"127.0.0.1", 0}});
  options.idle_limit = std::chrono::milliseconds(200);
  serve(options);
  RawClient client(server->port());
  expect_served(client);
  EXPECT_TRUE(client.is_hung_up_on());
  EXPECT_EQ(server->counters().idle, 1u);
  EXPECT_EQ(server->counters().stalled, 0u);
}

TEST_F(Service, TheLimitOfClientsIsThatOfEachPlace) {
  ModbusServerOptions one = at({{"127.0.0.1", 0}});
  one.max_clients = 1;
  serve({{one, machine.map}, {one, machine.map}});
  RawClient first(server->endpoints()[0].port);
  expect_served(first);
  RawClient refused(server->endpoints()[0].port);
  EXPECT_TRUE(refused.is_hung_up_on());
  RawClient second(server->endpoints()[1].port);
  expect_served(second);
  EXPECT_EQ(server->counters().refused, 1u);
}

TEST_F(Service, APlaceThatIsTakenIsToldByItsNameAndNothingStarts) {
  serve(at({{"127.0.0.1", 0}}));
  ModbusMachine other;
  ModbusServer second({{at({{"127.0.0.1", 0}, {"127.0.0.1", server->port()}}), other.map}}, other.image);
  EXPECT_EQ(second.start(), "127.0.0.1:" + std::to_string(server->port()) + ": Address already in use");
  EXPECT_TRUE(second.endpoints().empty());
}

}  // namespace
}  // namespace lockstep::modbus_service_test
