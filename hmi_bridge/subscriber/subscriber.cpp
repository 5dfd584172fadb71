// A foreign subscriber: shows the rows of a trace and what happens, with nothing from Lockstep but trace.lcm.
//     lcm-gen --cpp trace.lcm
//     c++ -std=c++11 -I. subscriber.cpp -llcm -o subscriber
//     ./subscriber ROTARY_KNIFE 10
// For a network on which nobody lies: it receives with LCM's own library, which believes what a datagram
// claims.
#include <cstdlib>
#include <iostream>
#include <lcm/lcm-cpp.hpp>
#include <string>

#include "lockstep/event_t.hpp"
#include "lockstep/trace_header_t.hpp"
#include "lockstep/trace_row_t.hpp"

namespace {

// What others wrote, without what a terminal would obey: control characters of ASCII, and their like beyond
// it.
std::string shown(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const unsigned char c = static_cast<unsigned char>(text[i]);
    const bool beyond = c >= 0x80 && c < 0xA0 && i > 0 && static_cast<unsigned char>(text[i - 1]) == 0xC2;
    result += c < 0x20 || c == 0x7F || beyond ? '?' : text[i];
  }
  return result;
}

struct Screen {
  lockstep::trace_header_t header{};
  long rows = 0;
  std::int64_t last_tick = -1;

  void on_header(const lcm::ReceiveBuffer* /*buffer*/, const std::string& /*channel*/,
                 const lockstep::trace_header_t* message) {
    header = *message;
  }
  void on_row(const lcm::ReceiveBuffer* /*buffer*/, const std::string& /*channel*/,
              const lockstep::trace_row_t* row) {
    if (row->header_id != header.id) return;  // its header comes within a second
    ++rows;
    last_tick = row->tick;
    std::cout << static_cast<double>(row->t) * 1e-9 << " s";
    for (int i = 0; i < row->n && i < header.n; ++i)
      std::cout << "  " << shown(header.names[i]) << " " << row->values[i] << shown(header.units[i]);
    std::cout << std::endl;
  }
  void on_event(const lcm::ReceiveBuffer* /*buffer*/, const std::string& /*channel*/,
                const lockstep::event_t* event) {
    std::cout << static_cast<double>(event->t) * 1e-9 << " s  " << shown(event->kind) << ": "
              << shown(event->source);
    if (event->number != 0) std::cout << " " << event->number << " " << shown(event->text);
    std::cout << std::endl;
  }
};

}  // namespace

int main(int argc, char** argv) {
  const std::string channel = argc > 1 ? argv[1] : "LOCKSTEP";
  const long enough = argc > 2 ? std::atol(argv[2]) : -1;  // rows; none given: for ever
  lcm::LCM lcm("udpm://239.255.76.67:7667?ttl=0");
  if (!lcm.good()) return 1;
  Screen screen;
  lcm.subscribe(channel + "_HEADER", &Screen::on_header, &screen);
  lcm.subscribe(channel, &Screen::on_row, &screen)->setQueueCapacity(0);
  lcm.subscribe(channel + "_EVENTS", &Screen::on_event, &screen)->setQueueCapacity(0);
  while (screen.rows != enough && lcm.handle() == 0) continue;
  return 0;
}
