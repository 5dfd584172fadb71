/// What Modbus servers, clients and serial lines are told.
/// @source contract of the project file, section 6; Modbus over serial line V1.02
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hmi_bridge/modbus/map.hpp"
#include "hmi_bridge/network/network.hpp"

namespace lockstep {

enum class Parity : std::uint8_t { none, even, odd };

/// A serial line. The defaults are those of the standard.
struct SerialOptions {
  std::string device;  ///< such as /dev/ttyS0
  int baud = 19200;    ///< one of `kBauds`
  Parity parity = Parity::even;
  int stop_bits = 1;  ///< 1, 2
  /// Silence that ends a frame; 0: 3.5 characters, and 1.75 ms at least, as the standard has it. Adapters
  /// that hand their bytes over in lumps need more.
  std::chrono::microseconds silence{0};
};

inline constexpr std::array kBauds = {1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200};

/// Where the server listens and how much it lets clients do there.
struct ModbusServerOptions {
  /// Addresses and names of interfaces of this machine; a name stands for all its addresses, 0.0.0.0 and ::
  /// for all of IPv4 and of IPv6.
  std::vector<Endpoint> listen{{"127.0.0.1", 502}};
  std::optional<SerialOptions> serial;  ///< RTU over this line in place of TCP; what follows is for TCP alone
  std::uint8_t serial_unit = 1;         ///< own address on the line, besides those with a map of their own
  std::vector<IpNetwork> allow;         ///< from where clients may come; empty: from everywhere
  std::size_t max_clients = 64;         ///< ≥ 1; a further client is refused, see `idle_time`
  /// Of one address, so that one machine cannot lock the others out; 0: three quarters of `max_clients`,
  /// rounded up. A further client of it is treated as one beyond `max_clients`.
  std::size_t max_clients_per_address = 0;
  std::uint32_t requests_per_second = 0;  ///< of one client; what is more waits; 0: as many as it likes
  /// A client that does not end a request, or take an answer, for this long is disconnected.
  std::chrono::milliseconds stall_time{10'000};
  /// Where all connections are taken, a new client gets that of the one that has been silent longest, if that
  /// is this long at least.
  std::chrono::milliseconds idle_time{10'000};
  /// A client that asks for nothing for this long is disconnected; 0: never.
  std::chrono::milliseconds idle_limit{0};
};

/// What is shown of the entries of one line: of a value, of an array, alone.
struct ModbusLineState {
  bool is_write = false;                 ///< a line of the write entries, else of the read entries
  std::uint32_t line = 0;                ///< `ModbusEntry::line` of its entries
  std::optional<std::uint32_t> quality;  ///< BOOL: all of its entries went well in the last cycle
  std::optional<std::uint32_t> age;      ///< TIME since the last cycle in which they did, or the start
};

/// A device and what goes to and fro. The signals of the entries are those of the client's image.
struct ModbusDevice {
  std::string name;
  int unit = 1;
  std::chrono::nanoseconds cycle{100'000'000};  ///< > 0
  std::vector<ModbusEntry> reads;               ///< from the device into signals
  std::vector<ModbusEntry> writes;              ///< from signals to the device's coils and holding registers
  std::optional<std::uint32_t> quality;         ///< BOOL: all of the last cycle went well
  std::optional<std::uint32_t> age;             ///< TIME since the last cycle that went well, or the start
  std::vector<ModbusLineState> lines;           ///< those of which something is shown alone
};

/// A connection with the devices behind it.
struct ModbusClientOptions {
  std::optional<Endpoint> connect;  ///< none: over `serial`
  SerialOptions serial;
  std::chrono::milliseconds timeout{500};           ///< for connecting, and for each answer
  std::chrono::milliseconds first_retry{100};       ///< after a failure; doubled with each further one
  std::chrono::milliseconds longest_retry{10'000};  ///< up to which it is doubled
  std::vector<ModbusDevice> devices;

  /// Where it connects to, for messages.
  std::string endpoint() const;
};

}  // namespace lockstep
