/// A machine for many Modbus clients, and thirty-two of them, half of which are up to no good.
#pragma once

#include <atomic>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/hmi_bridge/modbus_raw_client.hpp"

namespace lockstep::test {

inline constexpr int kFloodGood = 16;
inline constexpr int kFloodFirst = 100;  ///< register of the first good client
inline constexpr int kFloodPair = 200;   ///< registers of two values that belong together

/// The project of six axes on a line shaft with a register for each client, two values and an array that
/// change in each tick; all of them are kept.
inline std::string flooded_project(nlohmann::ordered_json json) {
  using Json = nlohmann::ordered_json;
  Json& map = json["modbus"]["map"];
  for (int i = 0; i < kFloodGood; ++i) {
    const std::string tag = "own_" + std::to_string(i);
    json["tags"][tag] = {{"type", "INT"}, {"retain", true}};
    map.push_back({{"tag", tag}, {"table", "holding_register"}, {"address", kFloodFirst + i}});
  }
  for (const char* tag : {"beat", "triple"}) json["tags"][tag] = {{"type", "DINT"}, {"retain", true}};
  json["tags"]["beats"] = {{"type", "ARRAY[0..99] OF DINT"}, {"retain", true}};
  map.push_back({{"tag", "beats"}, {"table", "input_register"}, {"address", kFloodPair}});
  map.push_back({{"tag", "beat"}, {"table", "holding_register"}, {"address", kFloodPair}});
  map.push_back({{"tag", "triple"}, {"table", "holding_register"}, {"address", kFloodPair + 2}});
  json["programs"].push_back(Json::parse(R"({"name": "Beat", "ob": "MC_PreServo", "calls": [
    {"set": "beat", "to": "beat + 1"}, {"set": "triple", "to": "3 * beat"},
    {"set": "beats[beat MOD 100]", "to": "beat"}]})"));
  return json.dump();
}

/// Thirty-two clients at full speed: sixteen good ones, six that send what is malformed, five that send a
/// byte at a time, and five that say nothing more.
class FloodClients {
 public:
  /// @param rounds of each good client; 0: until this object ends
  /// @param first register of the first good client, at most 240
  FloodClients(std::uint16_t port, int rounds, std::uint64_t seed, int first = kFloodFirst)
      : port_(port), rounds_(rounds), first_(first) {
    for (int i = 0; i < 5; ++i) be_silent();
    for (int i = 0; i < kFloodGood; ++i) threads_.emplace_back([this, i] { be_good(i); });
    for (unsigned i = 0; i < 6; ++i) threads_.emplace_back([this, seed, i] { be_malformed(seed + i); });
    for (int i = 0; i < 5; ++i) threads_.emplace_back([this] { be_slow(); });
  }
  ~FloodClients() {
    is_over_ = true;
    go_on();
    for (std::thread& thread : threads_) thread.join();
  }

  FloodClients(const FloodClients&) = delete;
  FloodClients& operator=(const FloodClients&) = delete;

  /// Lets all stay connected and ask for nothing more, once what is on its way has been answered.
  void rest() { is_resting_ = true; }
  void go_on() {
    is_resting_ = false;
    is_resting_.notify_all();
  }

  int good_left() const { return good_left_; }  ///< good clients that are not through with their rounds
  int wrong() const { return wrong_; }          ///< answers that are not those asked for
  int torn() const { return torn_; }            ///< answers that are of two instants

 private:
  /// Writes its register and reads it back, and the two values that belong together.
  void be_good(int number) {
    RawClient client(port_);
    const auto low = static_cast<std::uint8_t>(first_ + number);
    for (int n = 0; rounds_ == 0 ? !is_over_ : n < rounds_; ++n) {
      is_resting_.wait(true);
      const auto value = static_cast<std::uint8_t>(n);
      const Bytes write = {0, value, 0, 0, 0, 6, 1, 6, 0, low, 0, value};
      const Bytes read = {0, value, 0, 0, 0, 6, 1, 3, 0, low, 0, 1};
      const Bytes answer = {0, value, 0, 0, 0, 5, 1, 3, 2, 0, value};
      if (!client.send(write) || client.receive(write.size()) != write) ++wrong_;
      if (!client.send(read) || client.receive(answer.size()) != answer) ++wrong_;
      const Bytes pair = {0, value, 0, 0, 0, 6, 1, 3, 0, kFloodPair, 0, 4};
      if (!client.send(pair)) ++wrong_;
      const Bytes both = client.receive(17);
      if (both.size() != 17 || both[8] != 8) {
        ++wrong_;
        continue;
      }
      const auto number_at = [&both](std::size_t i) {
        return std::uint32_t{both[i]} << 24 | std::uint32_t{both[i + 1]} << 16 |
               std::uint32_t{both[i + 2]} << 8 | both[i + 3];
      };
      if (number_at(13) != 3 * number_at(9)) ++torn_;
    }
    --good_left_;
  }
  /// Comes again and again with bytes that are no Modbus, or not quite.
  void be_malformed(std::uint64_t seed) {
    std::mt19937 random(seed);
    while (!is_over_) {
      is_resting_.wait(true);
      RawClient client(port_);
      Bytes bytes = {0, 1, 0, 0, 0, 6, 1, 3, 0, 30, 0, 3};
      for (int i = 0; i < 3; ++i) {
        const std::size_t place = random() % bytes.size();
        if (place != 7) bytes[place] = static_cast<std::uint8_t>(random());  // not the function: no writes
      }
      client.send(bytes);
      client.end_sending();
      client.is_hung_up_on();
    }
  }
  /// A whole request, a byte at a time, without end.
  void be_slow() {
    RawClient client(port_);
    const Bytes request = {0, 1, 0, 0, 0, 6, 1, 3, 0, static_cast<std::uint8_t>(first_), 0, 1};
    while (!is_over_) {
      is_resting_.wait(true);
      for (const std::uint8_t byte : request) {
        if (is_over_ || !client.send({byte})) return;
        std::this_thread::yield();
      }
      if (client.receive(11).size() != 11) ++wrong_;
    }
  }
  /// Half a request, and then nothing: needs no thread.
  void be_silent() {
    RawClient client(port_);
    client.send({0, 1, 0, 0, 0, 6});
    silent_.push_back(std::move(client));
  }

  using Bytes = RawClient::Bytes;

  const std::uint16_t port_;
  const int rounds_;
  const int first_;
  std::atomic<int> good_left_{kFloodGood};
  std::atomic<int> wrong_{0};
  std::atomic<int> torn_{0};
  std::vector<std::thread> threads_;
  std::vector<RawClient> silent_;
  std::atomic<bool> is_over_{false};
  std::atomic<bool> is_resting_{false};
};

}  // namespace lockstep::test
