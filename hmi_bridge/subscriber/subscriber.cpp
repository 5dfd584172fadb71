// A foreign subscriber: shows the rows of a trace and what happens, with nothing from Lockstep but trace.lcm.
//     lcm-gen --cpp trace.lcm
//     c++ -std=c++11 -I. subscriber.cpp -llcm -o subscriber
//     ./subscriber ROTARY_KNIFE 10
#include <cstdlib>
#include <iostream>
#include <lcm/lcm-cpp.hpp>
#include <string>

#include "lockstep/event_t.hpp"
#include "lockstep/trace_header_t.hpp"
#include "lockstep/trace_row_t.hpp"

namespace {

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
    for (int i = 0; i < row->n; ++i)
      std::cout << "  " << header.names[i] << " " << row->values[i] << header.units[i];
    std::cout << std::endl;
  }
  void on_event(const lcm::ReceiveBuffer* /*buffer*/, const std::string& /*channel*/,
                const lockstep::event_t* event) {
    std::cout << static_cast<double>(event->t) * 1e-9 << " s  " << event->kind << ": " << event->source;
    if (event->number != 0) std::cout << " " << event->number << " " << event->text;
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
