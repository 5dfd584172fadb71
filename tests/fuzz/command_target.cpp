// Any bytes on the channels of commands, panels and events: each message is a byte for what it is, one for
// its length, and itself. Those that begin a certain way are made good ones with values of the input.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

#include "hmi_bridge/lcm/command_desk.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace lockstep::fuzz::command_target {
namespace {

constexpr std::int64_t kRun = 77;
constexpr double kFastest = 50.0;

/// The place of an axis in the cycle.
struct Operand {
  BOOL flags[3]{};
  UDINT counts[7]{};
  LREAL reals[7]{};
  DWORD status{};

  std::vector<Signal> signals() {
    return {{&flags[0], Type::BOOL, -1},   {&flags[1], Type::BOOL, -1},   {&flags[2], Type::BOOL, -1},
            {&counts[0], Type::UDINT, -1}, {&reals[0], Type::LREAL, -1},  {&counts[1], Type::UDINT, -1},
            {&reals[1], Type::LREAL, -1},  {&counts[2], Type::UDINT, -1}, {&reals[2], Type::LREAL, -1},
            {&counts[3], Type::UDINT, -1}, {&counts[4], Type::UDINT, -1}, {&reals[3], Type::LREAL, -1},
            {&counts[5], Type::UDINT, -1}, {&status, Type::DWORD, -1},    {&counts[6], Type::UDINT, -1},
            {&reals[4], Type::LREAL, -1},  {&reals[5], Type::LREAL, -1},  {&reals[6], Type::LREAL, -1}};
  }
};

command_t good(std::int64_t beat, std::int64_t sequence) {
  command_t command{};
  command.run = kRun;
  command.beat = beat;
  command.sender = 1;
  command.sequence = sequence;
  command.axis = "Knife";
  return command;
}

void add(std::string& input, char kind, const std::vector<std::uint8_t>& message) {
  input += kind;
  input += static_cast<char>(message.size());
  input.append(message.begin(), message.end());
}

/// A good command whose axis, action and value are the input's.
command_t aimed(Bytes bytes, std::int64_t beat, std::int64_t sequence) {
  command_t command = good(beat, sequence);
  if (bytes.empty()) return command;
  command.action = bytes[0] % 10;
  if (bytes[0] >= 128) command.axis = "Fan";
  if (bytes.size() > sizeof command.value) std::memcpy(&command.value, &bytes[1], sizeof command.value);
  return command;
}

void check(const Operand& place) {
  require(place.reals[0] >= 0.0 && place.reals[0] <= kFastest, "no jog is faster than it may be");
  require(std::abs(place.reals[1]) <= 1e12, "a position is a position");
  require(place.reals[2] >= 0.0 && place.reals[2] <= 200.0, "an override is in its range");
  require(!(place.flags[1] && place.flags[2]), "no jog in both directions");
}

/// Of an axis with a position, and of one without.
std::vector<Signal> both(Operand& knife, Operand& fan) {
  std::vector<Signal> signals = knife.signals();
  for (const Signal& signal : fan.signals()) signals.push_back(signal);
  return signals;
}

}  // namespace

std::vector<std::string> seeds() {
  std::string commands, others;
  for (std::int32_t action = 0; action < 9; ++action) {
    command_t command = good(1, action + 1);
    command.action = action;
    command.value = 1.0;
    add(commands, 0, encoded(command));
  }
  panel_t panel{};
  panel.axis = "Knife";
  event_t event{};
  event.kind = "alarm";
  event.source = "Knife";
  event.text = "text";
  add(others, 1, encoded(panel));
  add(others, 2, encoded(event));
  return {commands, others, std::string("\3\11\3") + std::string(8, '\x3F')};
}

int take(const std::uint8_t* data, std::size_t size) {
  Operand knife, fan;
  ProcessImage image(both(knife, fan));
  CommandDesk desk({{"Knife", kFastest, "", knife.signals()},
                    {"Fan", kFastest, "", fan.signals(), "TO_SpeedAxis", "1/min", false}},
                   image, kRun);
  desk.beat();
  CommandDesk::Clock::time_point now{std::chrono::hours(1)};
  Bytes rest(data, size);
  std::uint64_t given = 0;
  for (std::int64_t i = 0; rest.size() >= 2; ++i) {
    const std::size_t length = std::min<std::size_t>(rest[1], rest.size() - 2);
    const Bytes message = rest.subspan(2, length);
    const int kind = rest[0] % 4;
    if (kind == 1) decode_panel(message);
    if (kind == 2) decode_event(message);
    if (kind == 2) decode_detail(message);
    if (kind == 0) desk.accept(message, now);
    if (kind == 3) desk.accept(encoded(aimed(message, 1, i)), now);
    if (kind == 0 || kind == 3) ++given;
    image.take_writes();
    check(knife);
    check(fan);
    require(fan.counts[1] == 0, "what has no position is never homed");
    now += std::chrono::milliseconds(rest[0]);
    rest = rest.subspan(2 + length);
  }
  require(desk.counters().accepted + desk.counters().refused() == given, "each command is counted once");
  return 0;
}

}  // namespace lockstep::fuzz::command_target
