// Any bytes from a Modbus client: cut into frames and answered, as the server does it, with ticks in between.
#include <algorithm>
#include <cmath>

#include "hmi_bridge/modbus/request.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/hmi_bridge/modbus_machine.hpp"

namespace lockstep::fuzz::modbus_target {
namespace {

std::string frame(std::initializer_list<int> pdu) {
  std::string text{1, 2, 0, 0, 0, static_cast<char>(pdu.size() + 1), 1};
  text[0] = 0x11;
  for (const int byte : pdu) text += static_cast<char>(byte);
  return text;
}

void check_answer(Bytes request, Bytes answer, ModbusException exception) {
  require(answer.size() >= 9 && answer.size() <= kModbusFrame, "an answer has the length of a frame");
  require(modbus_frame_length(answer) == answer.size(), "its header tells its length");
  require(answer[0] == request[0] && answer[1] == request[1], "it has the transaction of its request");
  require(answer[6] == request[6], "it has the unit of its request");
  const bool refused = answer[7] == (request[7] | 0x80);
  require(refused || answer[7] == request[7], "it has the function of its request");
  require(!refused || (answer.size() == 9 && answer[8] >= 1 && answer[8] <= 3), "a known exception");
  // A request for a function from 128 on cannot be told from a refusal.
  require(request[7] >= 0x80 || refused == (exception != ModbusException::none), "what it says of itself");
}

}  // namespace

std::vector<std::string> seeds() {
  const std::string reads = frame({1, 0, 0, 0, 3}) + frame({2, 0, 0, 0, 1}) + frame({3, 0, 10, 0, 2}) +
                            frame({4, 0, 100, 0, 16}) + frame({3, 0, 200, 0, 125});
  const std::string writes = frame({5, 0, 0, 0xFF, 0}) + frame({6, 0, 30, 0x12, 0x34}) +
                             frame({15, 0x03, 0xE8, 0, 10, 2, 0xAA, 0x03}) +
                             frame({16, 0, 10, 0, 2, 4, 0x43, 0x48, 0, 0}) +
                             frame({22, 0, 30, 0, 0xF2, 0, 0x25});
  const std::string others = frame({23, 0, 10, 0, 2, 0, 30, 0, 1, 2, 1, 2}) + frame({43, 14, 1, 0}) +
                             frame({8, 0, 0, 1, 2}) + frame({7});
  return {reads, writes, others, reads + writes + others};
}

int take(const std::uint8_t* data, std::size_t size) {
  static ModbusMachine machine;
  static const ModbusUnits units(machine.map);
  static ModbusResponder responder(units, machine.image);
  Bytes rest(data, size);
  while (!rest.empty()) {
    const auto length = modbus_frame_length(rest);
    if (!length) break;  // the server closes the connection
    if (*length == 0 || *length > rest.size()) break;
    const Bytes request = rest.first(*length);
    const Bytes answer = responder.answer(request);
    check_answer(request, answer, responder.exception());
    machine.tick();
    rest = rest.subspan(*length);
  }
  require(std::isfinite(machine.speed) && std::isfinite(machine.rounded), "no value that is no number");
  require(machine.locked == 77, "what is read-only stays");
  return 0;
}

}  // namespace lockstep::fuzz::modbus_target
