#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "hmi_bridge/modbus/server.hpp"
#include "tests/hmi_bridge/modbus_machine.hpp"
#include "tests/hmi_bridge/modbus_raw_client.hpp"
#include "tests/support/property.hpp"

namespace lockstep::modbus_hostile_client_test {
namespace {

using Bytes = RawClient::Bytes;
using std::chrono::milliseconds;

/// A read of three registers; the answer begins with the same two bytes.
Bytes request(std::uint16_t id) {
  return {static_cast<std::uint8_t>(id >> 8), static_cast<std::uint8_t>(id), 0, 0, 0, 6, 1, 3, 0, 30, 0, 3};
}
Bytes answer(std::uint16_t id) {
  return {static_cast<std::uint8_t>(id >> 8),
          static_cast<std::uint8_t>(id),
          0,
          0,
          0,
          9,
          1,
          3,
          6,
          0x0F,
          0x0F,
          0xFF,
          0xFD,
          0,
          77};
}
constexpr std::size_t kAnswer = 15;

Bytes operator+(Bytes left, const Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

class Hostile : public ::testing::Test {
 protected:
  void serve(ModbusServerOptions options = {}) {
    options.listen = {{"127.0.0.1", 0}};
    server = std::make_unique<ModbusServer>(options, machine.map, machine.image);
    ASSERT_EQ(server->start(), "");
  }

  void expect_served(RawClient& client) {
    ASSERT_TRUE(client.send(request(4711)));
    EXPECT_EQ(client.receive(kAnswer), answer(4711));
  }
  void expect_a_new_client_served() {
    RawClient client(server->port());
    expect_served(client);
  }

  /// Sends requests and takes no answers until the server takes no more either. Returns the bytes sent.
  std::size_t send_until_full(RawClient& client) {
    Bytes flood;
    for (int i = 0; i < 1000; ++i) flood = std::move(flood) + request(7);
    std::size_t sent = 0;
    pollfd capacity{client.socket(), POLLOUT, 0};
    while (::poll(&capacity, 1, 100) > 0) {
      const std::size_t from = sent % flood.size();
      const ssize_t count =
          ::send(client.socket(), flood.data() + from, flood.size() - from, MSG_DONTWAIT | MSG_NOSIGNAL);
      if (count < 0) break;
      sent += static_cast<std::size_t>(count);
      if (sent > 100'000'000) {
        ADD_FAILURE() << "the server takes everything and keeps it";
        break;
      }
    }
    return sent;
  }

  /// Waits until a counter has a value; the test fails if it never has.
  void expect_counted(const std::atomic<std::uint64_t>& counter, std::uint64_t value) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(120);
    while (counter != value && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
    EXPECT_EQ(counter, value);
  }

  ModbusMachine machine;
  std::unique_ptr<ModbusServer> server;
};

TEST_F(Hostile, SilentClientsAndHalfRequestsHoldUpNobody) {
  serve();
  std::vector<RawClient> others;
  for (std::size_t i = 0; i < 40; ++i) {
    others.emplace_back(server->port());
    const Bytes whole = request(1);
    ASSERT_TRUE(others.back().send(Bytes(whole.begin(), whole.begin() + static_cast<long>(i % 12))));
  }
  const auto before = std::chrono::steady_clock::now();
  for (int i = 0; i < 20; ++i) expect_a_new_client_served();
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(5));
}

TEST_F(Hostile, ARequestThatComesByteByByteIsAnswered) {
  serve();
  RawClient client(server->port());
  for (std::uint16_t id = 0; id < 20; ++id) {
    for (const std::uint8_t byte : request(id)) ASSERT_TRUE(client.send({byte}));
    EXPECT_EQ(client.receive(kAnswer), answer(id));
  }
}

TEST_F(Hostile, RequestsInOnePieceAreAllAnsweredInTheirOrder) {
  serve();
  RawClient client(server->port());
  Bytes sent;
  Bytes expected;
  for (std::uint16_t id = 0; id < 1000; ++id) {
    sent = sent + request(id);
    expected = expected + answer(id);
  }
  const auto before = std::chrono::steady_clock::now();
  ASSERT_TRUE(client.send(sent));
  EXPECT_EQ(client.receive(expected.size()), expected);
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(5));
}

TEST_F(Hostile, AClientThatEndsItsSideStillGetsItsAnswers) {
  serve();
  RawClient client(server->port());
  const Bytes half = {0, 1, 0, 0};
  ASSERT_TRUE(client.send(request(1) + request(2) + half));
  client.end_sending();
  EXPECT_EQ(client.receive(2 * kAnswer), answer(1) + answer(2));
  EXPECT_TRUE(client.is_hung_up_on());
  expect_counted(server->counters().clients, 0);
}

TEST_F(Hostile, WhatIsNotModbusIsHungUpOnAfterTheRequestsBeforeIt) {
  serve();
  const std::vector<Bytes> headers = {
      {0, 1, 0, 1, 0, 6},   {0, 1, 1, 0, 0, 6}, {0, 1, 0, 0, 0, 0},     {0, 1, 0, 0, 0, 1},
      {0, 1, 0, 0, 0, 255}, {0, 1, 0, 0, 1, 6}, {0, 1, 0, 0, 255, 255}, {'G', 'E', 'T', ' ', '/', ' '}};
  RawClient bystander(server->port());
  std::uint64_t count = 0;
  for (const Bytes& header : headers) {
    RawClient client(server->port());
    expect_served(client);
    ASSERT_TRUE(client.send(header));
    EXPECT_TRUE(client.is_hung_up_on());
    expect_counted(server->counters().malformed, ++count);
    expect_served(bystander);
  }
}

TEST_F(Hostile, AClientThatSendsMuchAndTakesNothingHoldsUpNobodyAndIsDisconnected) {
  ModbusServerOptions options;
  options.stall_time = milliseconds(1'000);
  serve(options);
  RawClient client(server->port());
  EXPECT_GT(send_until_full(client), 10'000u);
  expect_a_new_client_served();
  // A server that is slow to begin makes room once more.
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  while (server->counters().stalled == 0 && std::chrono::steady_clock::now() < deadline)
    send_until_full(client);
  expect_counted(server->counters().stalled, 1);
}

TEST_F(Hostile, AClientThatTakesItsAnswersLateGetsThemAll) {
  ModbusServerOptions options;
  options.stall_time = milliseconds(600'000);  // however slow the machine is
  serve(options);
  RawClient client(server->port());
  const std::size_t sent = send_until_full(client);
  EXPECT_GT(sent, 10'000u);
  client.end_sending();
  const Bytes one = answer(7);
  Bytes expected;
  expected.reserve(sent / 12 * one.size());
  for (std::size_t i = 0; i < sent / 12; ++i) expected.insert(expected.end(), one.begin(), one.end());
  EXPECT_EQ(client.receive(expected.size()), expected);
}

TEST_F(Hostile, AFloodOfRequestsLeavesTheOthersTheirTurn) {
  serve();
  std::atomic<bool> is_over{false};
  std::vector<std::thread> floods;
  for (int k = 0; k < 3; ++k)
    floods.emplace_back([&] {
      RawClient client(server->port());
      Bytes requests;
      for (std::uint16_t id = 0; id < 100; ++id) requests = requests + request(id);
      while (!is_over && client.send(requests) && client.receive(100 * kAnswer).size() == 100 * kAnswer) {
      }
      EXPECT_TRUE(is_over);
    });
  RawClient client(server->port());
  for (int i = 0; i < 100; ++i) expect_served(client);
  is_over = true;
  for (std::thread& flood : floods) flood.join();
}

TEST_F(Hostile, ARequestThatDoesNotEndIsHungUpOnAfterTheStallTime) {
  ModbusServerOptions options;
  options.stall_time = milliseconds(50);
  serve(options);
  RawClient idle(server->port());
  RawClient client(server->port());
  ASSERT_TRUE(client.send({0, 1, 0, 0, 0, 6, 1}));
  EXPECT_TRUE(client.is_hung_up_on());
  EXPECT_EQ(server->counters().stalled, 1u);
  expect_served(idle);
}

TEST_F(Hostile, OneClientTooManyIsRefusedAndTheOthersAreServed) {
  ModbusServerOptions options;
  options.max_clients = 3;
  serve(options);
  std::vector<RawClient> clients;
  for (int i = 0; i < 3; ++i) {
    clients.emplace_back(server->port());
    expect_served(clients.back());
  }
  RawClient refused(server->port());
  EXPECT_TRUE(refused.is_hung_up_on());
  EXPECT_EQ(server->counters().refused, 1u);
  for (RawClient& client : clients) expect_served(client);
}

/// A client at 127.0.0.N; the loopback network has room for many machines.
class ClientOfAddress {
 public:
  ClientOfAddress(std::uint8_t last_byte, std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    const timeval timeout{20, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
    sockaddr_in own{}, server{};
    own.sin_family = server.sin_family = AF_INET;
    own.sin_addr.s_addr = htonl(0x7F000000u | last_byte);
    server.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    server.sin_port = htons(port);
    ::bind(socket_, reinterpret_cast<sockaddr*>(&own), sizeof own);
    ::connect(socket_, reinterpret_cast<sockaddr*>(&server), sizeof server);
  }
  ClientOfAddress(ClientOfAddress&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}
  ~ClientOfAddress() {
    if (socket_ >= 0) ::close(socket_);
  }
  /// Whether a request gets an answer; else the connection has ended.
  bool is_served() const {
    const std::uint8_t request[] = {0, 1, 0, 0, 0, 6, 1, 3, 0, 0, 0, 1};
    std::uint8_t answer[32];
    return ::send(socket_, request, sizeof request, MSG_NOSIGNAL) == sizeof request &&
           ::recv(socket_, answer, sizeof answer, 0) > 0;
  }

 private:
  int socket_;
};

// Busy or idle, the connections of one machine leave places for the operator's.
TEST_F(Hostile, AllPlacesThatOneAddressCanGetLeaveRoomForAnotherOne) {
  ModbusServerOptions options;
  options.max_clients = 8;
  serve(options);
  std::vector<ClientOfAddress> greedy;
  for (int i = 0; i < 12; ++i) greedy.emplace_back(std::uint8_t{7}, server->port());
  int served = 0;
  for (const ClientOfAddress& client : greedy) served += client.is_served() ? 1 : 0;
  EXPECT_EQ(served, 6) << "three quarters";
  const ClientOfAddress operators(std::uint8_t{9}, server->port());
  EXPECT_TRUE(operators.is_served());
}

TEST_F(Hostile, TheShareOfAnAddressCanBeGiven) {
  ModbusServerOptions options;
  options.max_clients = 8;
  options.max_clients_per_address = 2;
  serve(options);
  std::vector<ClientOfAddress> clients;
  for (int i = 0; i < 4; ++i) clients.emplace_back(std::uint8_t{7}, server->port());
  for (int i = 0; i < 4; ++i) clients.emplace_back(static_cast<std::uint8_t>(20 + i), server->port());
  int served = 0;
  for (const ClientOfAddress& client : clients) served += client.is_served() ? 1 : 0;
  EXPECT_EQ(served, 6);
}

TEST_F(Hostile, AClientThatIsSilentTooLongLosesItsPlaceToANewOne) {
  ModbusServerOptions options;
  options.max_clients = 2;
  options.idle_time = milliseconds(0);
  serve(options);
  RawClient first(server->port());
  expect_served(first);
  RawClient second(server->port());
  expect_served(second);
  expect_served(first);
  RawClient third(server->port());
  expect_served(third);
  EXPECT_TRUE(second.is_hung_up_on());
  EXPECT_EQ(server->counters().displaced, 1u);
  expect_served(first);
}

TEST_F(Hostile, ClientsThatComeAndGoLeaveNothingBehind) {
  serve();
  for (int i = 0; i < 300; ++i) {
    RawClient client(server->port());
    ASSERT_TRUE(client.is_connected());
    if (i % 3 == 0) {
      ASSERT_TRUE(client.send(request(1)));
    }
    if (i % 5 == 0) {  // closes with a reset
      const linger now{1, 0};
      ::setsockopt(client.socket(), SOL_SOCKET, SO_LINGER, &now, sizeof now);
    }
  }
  expect_a_new_client_served();  // it came after all of them
  expect_counted(server->counters().clients, 0);
  EXPECT_EQ(server->counters().connections + server->counters().refused, 301u);
  EXPECT_EQ(server->counters().faults, 0u);
}

TEST_F(Hostile, AnyStreamOfBytesLeavesTheServerAtItsWork) {
  serve();
  std::mt19937 random(test::seed_of_test(20240603));
  RawClient bystander(server->port());
  for (int round = 0; round < test::cases(300, 10'000); ++round) {
    RawClient client(server->port());
    Bytes bytes(random() % 600);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random() % 3 == 0 ? random() : random() % 8);
    if (round % 2 == 0) bytes = request(1) + bytes;
    client.send(bytes);
    if (round % 10 == 0) expect_served(bystander);
    machine.tick();
  }
  expect_a_new_client_served();
  EXPECT_EQ(server->counters().faults, 0u);
}

}  // namespace
}  // namespace lockstep::modbus_hostile_client_test
