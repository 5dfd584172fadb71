// The README's machine in real time: load a project, serve Modbus, read a value as a client does, stop.
#include <modbus.h>

#include <cstdio>
#include <exception>

#include "projects/runtime/runtime.hpp"

namespace {

/// Shows what the run tells.
class Shown final : public lockstep::Messages {
  void inform(const std::string& text) noexcept override { std::printf("%s\n", text.c_str()); }
  void warn(const std::string& text) noexcept override { std::printf("warning: %s\n", text.c_str()); }
};

/// The BOOL that the project's map shows as coil 0; negative: nobody answers.
int read_coil(int port) {
  modbus_t* const client = modbus_new_tcp("127.0.0.1", port);
  std::uint8_t coil = 0;
  const bool read = modbus_connect(client) == 0 && modbus_read_bits(client, 0, 1, &coil) == 1;
  modbus_close(client);
  modbus_free(client);
  return read ? coil : -1;
}

}  // namespace

int main(int /*argc*/, char** argv) try {
  lockstep::RunOptions options;
  options.file = argv[1];
  options.modbus = "127.0.0.1:0";
  options.no_lcm = true;
  options.no_retain = true;
  lockstep::Runtime machine(options, std::make_shared<Shown>());
  machine.start();
  const int start = read_coil(machine.modbus_endpoints().front().port);
  machine.stop();
  const bool ended = machine.wait();
  std::printf("coil 0: %d\n", start);
  return start == 0 && ended ? 0 : 1;
} catch (const std::exception& error) {
  std::printf("%s\n", error.what());
  return 2;
}
