/// The Modbus TCP server of the bridge.
/// @source contract of the project file, section 6; Modbus messaging on TCP/IP V1.0b
#pragma once

#include <poll.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "hmi_bridge/modbus_connection.hpp"
#include "hmi_bridge/modbus_map.hpp"
#include "hmi_bridge/modbus_request.hpp"
#include "scheduler/process_image.hpp"

namespace lockstep {

/// Where the server listens and how much it lets clients do.
struct ModbusServerOptions {
  std::string host = "127.0.0.1";  ///< IPv4 address or name of an interface of this machine; 0.0.0.0: all
  std::uint16_t port = 502;        ///< 0: any that is free
  std::size_t max_clients = 64;    ///< ≥ 1; a further client is refused, see `idle_time`
  /// A client that does not end a request, or take an answer, for this long is disconnected.
  std::chrono::milliseconds stall_time{10'000};
  /// Where all places are taken, a new client gets the place of the one that has been silent longest, if that
  /// is this long at least.
  std::chrono::milliseconds idle_time{10'000};
};

/// What the server has seen since its construction. Any thread may read.
struct ModbusCounters {
  std::atomic<std::uint64_t> requests{0};     ///< answered, exceptions included
  std::atomic<std::uint64_t> exceptions{0};   ///< answered with an exception
  std::atomic<std::uint64_t> connections{0};  ///< accepted
  std::atomic<std::uint64_t> refused{0};      ///< connections closed at once: too many
  std::atomic<std::uint64_t> displaced{0};    ///< silent clients whose place a new one got
  std::atomic<std::uint64_t> malformed{0};    ///< connections closed: not Modbus
  std::atomic<std::uint64_t> stalled{0};      ///< connections closed: owed something for too long
  std::atomic<std::uint64_t> faults{0};       ///< internal failures survived
  std::atomic<std::uint64_t> clients{0};      ///< connected now
};

/// Serves the map from the image, on a thread of its own. Clients get one request each in turn, so that none
/// can delay another by more than the time of one answer each.
class ModbusServer {
 public:
  /// `map` (without problems) and `image` outlive it; the server is the image's thread of the bridge.
  ModbusServer(ModbusServerOptions options, const ModbusMap& map, ProcessImage& image);
  /// Stops.
  ~ModbusServer();
  ModbusServer(const ModbusServer&) = delete;
  ModbusServer& operator=(const ModbusServer&) = delete;

  /// Listens and serves from here on. Returns an empty text, or what is wrong, such as
  /// "127.0.0.1:502: Permission denied"; then nothing has started and it may be called again.
  /// May wait for a name server if `host` is a name. Thread: the owner.
  std::string start();

  /// Disconnects all clients and ends the thread; nothing happens if it does not run. Thread: the owner.
  void stop();

  /// The port on which it listens; 0 if it does not. Thread: the owner.
  std::uint16_t port() const noexcept { return port_; }

  const ModbusCounters& counters() const noexcept { return counters_; }

 private:
  using Clock = ModbusConnection::Clock;

  std::string listen();
  void close_sockets() noexcept;
  void run() noexcept;
  void turn();
  int wait_time(Clock::time_point now) const;
  void accept_clients(Clock::time_point now);
  bool make_room(Clock::time_point now);
  bool serve(ModbusConnection& client, short events, Clock::time_point now);
  bool answer(ModbusConnection& client, Clock::time_point now);

  const ModbusServerOptions options_;
  const ModbusMap& map_;
  ProcessImage& image_;
  ModbusCounters counters_;
  std::uint16_t port_ = 0;
  int listener_ = -1;
  int wake_ = -1;  ///< event that ends the thread's waiting
  std::atomic<bool> is_stopping_{false};
  std::thread thread_;

  // The thread's.
  std::unique_ptr<ModbusResponder> responder_;
  std::vector<std::unique_ptr<ModbusConnection>> clients_;
  std::vector<pollfd> events_;  ///< wake, listener, then the clients
  Clock::time_point accept_again_{};
};

}  // namespace lockstep
