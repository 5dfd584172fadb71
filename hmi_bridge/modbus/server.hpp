/// The Modbus server of the bridge: TCP, and RTU over serial lines.
/// @source contract of the project file, section 6; Modbus messaging on TCP/IP V1.0b
#pragma once

#include <poll.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "hmi_bridge/modbus/connection.hpp"
#include "hmi_bridge/modbus/counters.hpp"
#include "hmi_bridge/modbus/map.hpp"
#include "hmi_bridge/modbus/options.hpp"
#include "hmi_bridge/modbus/request.hpp"
#include "hmi_bridge/modbus/serial.hpp"
#include "hmi_bridge/network/network.hpp"
#include "scheduler/process_image.hpp"

namespace lockstep {

/// A group of addresses with what is served there.
struct ModbusService {
  ModbusServerOptions options;
  ModbusUnits units;  ///< maps without problems
};

/// Serves maps from one image, on a thread of its own. Clients get one request each in turn, so that none
/// can delay another by more than the time of one answer each.
class ModbusServer {
 public:
  /// Maps and `image` outlive it; the server is the image's thread of the bridge.
  ModbusServer(std::vector<ModbusService> services, ProcessImage& image, ModbusIdentity identity = {});
  ModbusServer(ModbusServerOptions options, const ModbusMap& map, ProcessImage& image);
  /// Stops.
  ~ModbusServer();
  ModbusServer(const ModbusServer&) = delete;
  ModbusServer& operator=(const ModbusServer&) = delete;

  /// Writes of clients, and clients that are turned away, are told to a log, which outlives this. Before
  /// `start`.
  /// @param names of the signals of the image
  void audit_to(AuditLog& log, std::vector<std::string> names) {
    audit_ = &log;
    names_ = std::move(names);
  }

  /// Listens and serves from here on. Returns an empty text, or what is wrong, such as
  /// "127.0.0.1:502: Permission denied"; then nothing has started and it may be called again.
  /// May wait for a name server if a host is a name. Thread: the owner.
  std::string start();

  /// From here on every write is answered with exception 4: the cycle takes no more. When it returns, each
  /// write that was acknowledged has been handed to the image, and no other one will be. Thread: the owner.
  void refuse_writes();

  /// Disconnects all clients and ends the thread; nothing happens if it does not run. Thread: the owner.
  void stop();

  /// The port on which it listens first; 0 if it does not. Thread: the owner.
  std::uint16_t port() const noexcept {
    return endpoints_.empty() ? std::uint16_t{0} : endpoints_.front().port;
  }
  /// Where it listens, in the order of the options, with the ports that the system gave. Thread: the owner.
  const std::vector<Endpoint>& endpoints() const noexcept { return endpoints_; }

  const ModbusCounters& counters() const noexcept { return counters_; }

 private:
  using Clock = ModbusConnection::Clock;

  struct Listener {
    int socket;
    std::size_t service;
  };
  /// A client, and when it may ask again.
  /// An address without its port: IPv4 as its 4 bytes, IPv6 as its 16.
  using Address = std::array<std::uint8_t, 16>;
  struct Client {
    std::unique_ptr<ModbusConnection> connection;
    std::size_t service;
    Address address;
    Clock::time_point due{};  ///< time at which the next request would keep to the rate
    bool is_waiting = false;  ///< the next request has been counted as one that waits
    ModbusPeer peer{};        ///< for the audit log
  };

  /// A serial line on which it answers.
  struct Line {
    std::unique_ptr<ModbusSerialLine> port;
    std::size_t service;
    ModbusPeer peer;
  };

  std::string listen(std::size_t service);
  std::string open_line(std::size_t service);
  std::string listen_at(Endpoint endpoint, std::size_t service);
  void make_responders();
  void close_sockets() noexcept;
  void wake() noexcept;
  void begin_to_refuse() noexcept;
  void run() noexcept;
  void turn();
  void wait();
  Clock::time_point due(Clock::time_point now) const;
  void serve_line(Line& line, short events, Clock::time_point now);
  void accept_clients(const Listener& listener, Clock::time_point now);
  bool admits(const sockaddr_storage& peer, std::size_t service);
  void audit_stranger(const sockaddr_storage& peer);
  static Address address_of(const sockaddr_storage& peer) noexcept;
  bool make_room(std::size_t service, const Address& address, Clock::time_point now);
  template <class Counts>
  bool make_room_among(std::size_t maximum, const Counts& counts, const ModbusServerOptions& options,
                       Clock::time_point now);
  bool serve(Client& client, short events, Clock::time_point now);
  bool is_too_late(const Client& client, Clock::time_point now);
  bool may_ask(Client& client, Clock::time_point now);
  Clock::time_point may_ask_at(const Client& client) const;
  void count_waiting(Client& client, Clock::time_point now);
  bool answer(Client& client, Clock::time_point now);

  const std::vector<ModbusService> services_;
  ProcessImage& image_;
  const ModbusIdentity identity_;
  ModbusCounters counters_;
  AuditLog* audit_ = nullptr;
  std::vector<std::string> names_;
  std::vector<Endpoint> endpoints_;
  std::vector<Listener> listeners_;
  std::vector<Line> lines_;
  int wake_ = -1;  ///< event that ends the thread's waiting
  std::atomic<bool> is_stopping_{false};
  std::atomic<bool> is_refusing_{false};     ///< it is asked to refuse writes
  std::atomic<bool> refuses_writes_{false};  ///< it refuses writes
  std::thread thread_;

  // The thread's.
  std::deque<ModbusResponder> responders_;  ///< of the services
  std::vector<Client> clients_;
  std::vector<pollfd> events_;  ///< wake, listeners, lines, then the clients
  Clock::time_point accept_again_{};
};

}  // namespace lockstep
