// Any bytes on the channel of a transfer area: each message is two bytes for its length, and itself. What is
// of the right type is made one of the right sender, with the values of the input; what counts goes to a
// proxy. What receivers tell is read from the same bytes.
#include <algorithm>
#include <cmath>
#include <string>

#include "hmi_bridge/lcm/leading_values.hpp"
#include "tech_objects/cross_controller/leading_axis_proxy.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace lockstep::fuzz::leading_value_target {
namespace {

constexpr std::int64_t kMilli = 1'000'000;

LeadingValueLink link() {
  return {.area = "line.main", .sender = "PLC_1", .source = "Conveyor", .interface = 1, .key = {}};
}

void add(std::string& input, Bytes message) {
  input += static_cast<char>(message.size() & 0xff);
  input += static_cast<char>(message.size() >> 8);
  input.append(message.begin(), message.end());
}

/// The same message, from the sender that is named.
std::vector<std::uint8_t> aimed(leading_value_t message, std::int64_t now, std::int64_t sequence) {
  message.run = 99;
  message.layout = link().layout();
  message.area = link().area;
  message.sender = link().sender;
  message.sequence = sequence;
  message.time = now - (message.time & 0x3fffff);
  for (auto& byte : message.code) byte = 0;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace

std::vector<std::string> seeds() {
  LeadingValueWriter writer(link(), 99);
  std::string input;
  for (std::uint64_t i = 1; i < 6; ++i) {
    LeadingValueTelegram telegram;
    telegram.sequence = i;
    telegram.time = static_cast<std::int64_t>(i) * kMilli;
    telegram.cycle = kMilli;
    telegram.value = {{0, 0.1 * static_cast<double>(i)}, 100.0, 0.0};
    telegram.valid = telegram.position_led = true;
    add(input, writer.write(telegram));
  }
  leading_proxies_t told{};
  told.accepted = 7;
  told.area = "line.main";
  told.controller = "PLC_2";
  told.proxies = "Line, Other";
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(told.getEncodedSize()));
  told.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  std::string of_receivers;
  add(of_receivers, bytes);
  return {input, of_receivers};
}

int take(const std::uint8_t* data, std::size_t size) {
  LeadingAxisProxy proxy("Line", static_cast<DB_ANY>(1));
  proxy.configure(0.001, 1);
  LeadingValueReader reader(link());
  std::int64_t now = 0;
  Bytes rest(data, size);
  while (rest.size() >= 2) {
    const std::size_t length = std::min<std::size_t>(rest[0] | rest[1] << 8, rest.size() - 2);
    const Bytes bytes = rest.subspan(2, length);
    rest = rest.subspan(2 + length);
    now += kMilli;
    if (const auto telegram = reader.read(bytes, now)) proxy.take(*telegram, now);
    if (const auto message = decode_leading_value(bytes))
      if (const auto telegram = reader.read(aimed(*message, now, now / kMilli), now))
        proxy.take(*telegram, now);
    if (const auto told = decode_leading_proxies(bytes))
      require(static_cast<std::size_t>(told->getEncodedSize()) == bytes.size(),
              "what receivers tell is a whole message");
    proxy.servo(now);
    proxy.before_axes();
    const Setpoint& setpoint = proxy.setpoint();
    require(std::isfinite(setpoint.position.value) && std::isfinite(setpoint.velocity) &&
                std::isfinite(setpoint.acceleration),
            "a leading value is finite, whatever has come");
  }
  return 0;
}

}  // namespace lockstep::fuzz::leading_value_target
