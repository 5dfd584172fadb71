#include "hmi_bridge/modbus/server.hpp"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <pthread.h>
#include <sched.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>
#include <system_error>
#include <utility>

namespace lockstep {
namespace {

constexpr int kAcceptsPerTurn = 8;
constexpr std::chrono::milliseconds kCheckTime{100};  ///< how often what clients owe is looked at
constexpr int kSendBuffer = 16 * 1024;                ///< [byte]
constexpr int kNice = 5;
constexpr std::chrono::milliseconds kBurst{100};  ///< how far a client may be ahead of its rate

void set_option(int socket, int level, int option, int value) noexcept {
  ::setsockopt(socket, level, option, &value, sizeof value);
}

/// Answers go out at once, a peer that vanished without a word is noticed after a minute and a half, and what
/// the system keeps for a client that takes no answers is bounded.
void tune_client(int socket) noexcept {
  set_option(socket, IPPROTO_TCP, TCP_NODELAY, 1);
  set_option(socket, SOL_SOCKET, SO_SNDBUF, kSendBuffer);
  set_option(socket, SOL_SOCKET, SO_KEEPALIVE, 1);
  set_option(socket, IPPROTO_TCP, TCP_KEEPIDLE, 60);
  set_option(socket, IPPROTO_TCP, TCP_KEEPINTVL, 10);
  set_option(socket, IPPROTO_TCP, TCP_KEEPCNT, 3);
}

/// The thread that starts the server may be one of the cycle's: nothing of its priority is passed on, and
/// under a flood of requests everything else goes first.
void step_back() noexcept {
  const sched_param ordinary{};
  ::pthread_setschedparam(::pthread_self(), SCHED_OTHER, &ordinary);
  ::setpriority(PRIO_PROCESS, 0, kNice);
  ::pthread_setname_np(::pthread_self(), "modbus");
}

/// The addresses of a host, those of IPv4 first.
struct Addresses {
  explicit Addresses(const Endpoint& endpoint) {
    addrinfo hints{};
    hints.ai_family = AF_UNSPEC;
    hints.ai_socktype = SOCK_STREAM;
    code = ::getaddrinfo(endpoint.host.c_str(), std::to_string(endpoint.port).c_str(), &hints, &found);
    for (const int family : {AF_INET, AF_INET6})
      for (const addrinfo* one = found; one != nullptr && code == 0; one = one->ai_next)
        if (one->ai_family == family) list.push_back(one);
  }
  ~Addresses() {
    if (found != nullptr) ::freeaddrinfo(found);
  }
  Addresses(const Addresses&) = delete;
  Addresses& operator=(const Addresses&) = delete;

  int code = 0;
  addrinfo* found = nullptr;
  std::vector<const addrinfo*> list;
};

std::uint16_t port_of(const sockaddr_storage& address) noexcept {
  // Both families have their port at the same offset.
  return ntohs(reinterpret_cast<const sockaddr_in&>(address).sin_port);
}

void set_port(sockaddr_storage& address, std::uint16_t port) noexcept {
  reinterpret_cast<sockaddr_in&>(address).sin_port = htons(port);
}

ModbusPeer peer_of(const sockaddr_storage& address) {
  char text[INET6_ADDRSTRLEN] = "";
  if (address.ss_family == AF_INET6)
    ::inet_ntop(AF_INET6, &reinterpret_cast<const sockaddr_in6&>(address).sin6_addr, text, sizeof text);
  else
    ::inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in&>(address).sin_addr, text, sizeof text);
  return {to_string(Endpoint{text, port_of(address)}), text};
}

/// A listening socket at an address, which gets the port that it was given; -1 and errno if that cannot be.
int open_listener(sockaddr_storage& address, socklen_t size) noexcept {
  const int socket = ::socket(address.ss_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket < 0) return -1;
  set_option(socket, SOL_SOCKET, SO_REUSEADDR, 1);
  if (address.ss_family == AF_INET6) set_option(socket, IPPROTO_IPV6, IPV6_V6ONLY, 1);
  auto* const endpoint = reinterpret_cast<sockaddr*>(&address);
  if (::bind(socket, endpoint, size) == 0 && ::listen(socket, SOMAXCONN) == 0 &&
      ::getsockname(socket, endpoint, &size) == 0)
    return socket;
  const int error = errno;
  ::close(socket);
  errno = error;
  return -1;
}

}  // namespace

ModbusServer::ModbusServer(std::vector<ModbusService> services, ProcessImage& image, ModbusIdentity identity)
    : services_(std::move(services)), image_(image), identity_(std::move(identity)) {}

ModbusServer::ModbusServer(ModbusServerOptions options, const ModbusMap& map, ProcessImage& image)
    : ModbusServer({ModbusService{std::move(options), map}}, image) {}

ModbusServer::~ModbusServer() {
  stop();
}

std::string ModbusServer::start() {
  if (thread_.joinable()) return {};
  wake_ = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  std::string problem = wake_ < 0 ? std::strerror(errno) : "";
  for (std::size_t i = 0; i < services_.size() && problem.empty(); ++i)
    problem = services_[i].options.serial ? open_line(i) : listen(i);
  sigset_t all;
  sigset_t before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);  // signals are for the thread that waits for them
  try {
    if (problem.empty()) {
      make_responders();
      is_stopping_ = is_refusing_ = refuses_writes_ = false;
      thread_ = std::thread([this] { run(); });
    }
  } catch (const std::exception& error) {
    problem = error.what();
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (!problem.empty()) close_sockets();
  return problem;
}

void ModbusServer::make_responders() {
  std::size_t clients = 0;
  for (const ModbusService& service : services_) {
    responders_.emplace_back(service.units, image_, identity_, &counters_);
    if (audit_ != nullptr) responders_.back().audit_to(*audit_, names_);
    clients += service.options.max_clients;
  }
  clients_.reserve(clients);
  events_.reserve(clients + listeners_.size() + lines_.size() + 1);
}

std::string ModbusServer::listen(std::size_t service) {
  for (const Endpoint& endpoint : services_[service].options.listen)
    if (const std::string problem = listen_at(endpoint, service); !problem.empty())
      return to_string(endpoint) + ": " + problem;
  return {};
}

std::string ModbusServer::open_line(std::size_t service) {
  const SerialOptions& options = *services_[service].options.serial;
  auto port = std::make_unique<ModbusSerialLine>(options, counters_);
  if (const std::string problem = port->open(); !problem.empty()) return options.device + ": " + problem;
  lines_.push_back({std::move(port), service, {options.device, options.device}});
  return {};
}

/// Listens at all addresses of an endpoint. An address that this machine does not have is passed over if
/// another one of the same name is there: "localhost" on a machine without IPv6.
std::string ModbusServer::listen_at(Endpoint endpoint, std::size_t service) {
  const Addresses addresses(endpoint);
  if (addresses.code != 0) return ::gai_strerror(addresses.code);
  if (addresses.list.empty()) return "has no address";
  bool is_first = true;
  for (const addrinfo* one : addresses.list) {
    sockaddr_storage address{};
    std::memcpy(&address, one->ai_addr, one->ai_addrlen);
    set_port(address, endpoint.port);
    const int socket = open_listener(address, one->ai_addrlen);
    const bool is_absent = errno == EADDRNOTAVAIL || errno == EAFNOSUPPORT;
    if (socket < 0 && (is_first || !is_absent)) return std::strerror(errno);
    if (socket < 0) continue;
    listeners_.push_back({socket, service});
    endpoint.port = port_of(address);  // the system's choice for the first is that of all
    if (is_first) endpoints_.push_back(endpoint);
    is_first = false;
  }
  return {};
}

void ModbusServer::close_sockets() noexcept {
  for (const Listener& listener : listeners_) ::close(listener.socket);
  listeners_.clear();
  lines_.clear();
  endpoints_.clear();
  if (wake_ >= 0) ::close(wake_);
  wake_ = -1;
  responders_.clear();
}

void ModbusServer::wake() noexcept {
  const std::uint64_t one = 1;
  while (::write(wake_, &one, sizeof one) < 0 && errno == EINTR) {
  }
}

void ModbusServer::refuse_writes() {
  if (!thread_.joinable()) return;
  is_refusing_ = true;
  wake();
  refuses_writes_.wait(false);
}

/// Between two turns, so that no request is under way.
void ModbusServer::begin_to_refuse() noexcept {
  for (ModbusResponder& responder : responders_) responder.refuse_writes();
  std::uint64_t woken = 0;
  while (::read(wake_, &woken, sizeof woken) < 0 && errno == EINTR) {
  }
  refuses_writes_ = true;
  refuses_writes_.notify_all();
}

void ModbusServer::stop() {
  if (!thread_.joinable()) return;
  is_stopping_ = true;
  wake();
  thread_.join();
  close_sockets();
}

void ModbusServer::run() noexcept {
  step_back();
  while (!is_stopping_) {
    if (is_refusing_ && !refuses_writes_) begin_to_refuse();
    try {
      turn();
    } catch (...) {
      ++counters_.faults;
      std::this_thread::sleep_for(kCheckTime);  // what the system lacks it will lack at once again
    }
  }
  clients_.clear();
  counters_.clients = 0;
}

void ModbusServer::turn() {
  wait();
  const Clock::time_point now = Clock::now();
  const std::size_t first_line = 1 + listeners_.size();
  const std::size_t first_client = first_line + lines_.size();
  for (std::size_t i = 0; i < clients_.size(); ++i)
    if (!serve(clients_[i], events_[first_client + i].revents, now)) clients_[i].connection.reset();
  for (std::size_t i = 0; i < lines_.size(); ++i) serve_line(lines_[i], events_[first_line + i].revents, now);
  std::erase_if(clients_, [](const Client& client) { return client.connection == nullptr; });
  for (std::size_t i = 0; i < listeners_.size(); ++i)
    if (events_[i + 1].revents != 0) accept_clients(listeners_[i], now);
  counters_.clients = clients_.size();
}

/// Waits until there is something to do.
void ModbusServer::wait() {
  const Clock::time_point now = Clock::now();
  const bool accepts = now >= accept_again_;
  events_.assign(1, {wake_, POLLIN, 0});
  for (const Listener& listener : listeners_) events_.push_back({accepts ? listener.socket : -1, POLLIN, 0});
  for (const Line& line : lines_) events_.push_back({line.port->descriptor(), POLLIN, 0});
  for (const Client& client : clients_)
    events_.push_back({client.connection->socket(), client.connection->events(), 0});
  const Clock::time_point until = due(now);
  const std::int64_t left = std::max<std::int64_t>(0, std::chrono::nanoseconds(until - now).count());
  constexpr std::int64_t kSecond = 1'000'000'000;
  const timespec time{static_cast<time_t>(left / kSecond), static_cast<long>(left % kSecond)};
  const bool has_end = until != Clock::time_point::max();
  if (::ppoll(events_.data(), events_.size(), has_end ? &time : nullptr, nullptr) >= 0) return;
  if (errno != EINTR) throw std::system_error(errno, std::generic_category());
  for (pollfd& event : events_) event.revents = 0;
}

/// When there is something to do even if nothing comes.
ModbusServer::Clock::time_point ModbusServer::due(Clock::time_point now) const {
  Clock::time_point until = Clock::time_point::max();
  if (now < accept_again_) until = accept_again_;
  for (const Line& line : lines_) until = std::min(until, line.port->due());
  for (const Client& client : clients_) {
    const ModbusConnection& connection = *client.connection;
    const bool has_request = !connection.request().empty();
    if (has_request) until = std::min(until, std::max(now, may_ask_at(client)));
    if (!has_request && (connection.is_owing() || services_[client.service].options.idle_limit.count() > 0))
      until = std::min(until, now + kCheckTime);
  }
  return until;
}

/// Requests to others on the line get no answer, and those to everybody are carried out without one.
void ModbusServer::serve_line(Line& line, short events, Clock::time_point now) {
  line.port->receive(now, (events & (POLLERR | POLLHUP | POLLNVAL)) != 0);
  const std::span<std::uint8_t> frame = line.port->request(now);
  if (frame.empty()) return;
  const ModbusService& service = services_[line.service];
  std::uint8_t& unit = frame[kModbusHeader - 1];
  const bool is_for_all = unit == 0;
  if (is_for_all) unit = service.options.serial_unit;
  if (unit != service.options.serial_unit && service.units.own[unit] == nullptr) return;
  ModbusResponder& responder = responders_[line.service];
  responder.set_peer(line.peer);
  const std::span<const std::uint8_t> reply = responder.answer(frame);
  if (reply.empty()) {
    ++counters_.faults;
    return;
  }
  ++counters_.requests;
  if (responder.exception() != ModbusException::none) ++counters_.exceptions;
  if (!is_for_all) line.port->reply(reply);
}

bool ModbusServer::serve(Client& client, short events, Clock::time_point now) {
  ModbusConnection& connection = *client.connection;
  const bool is_broken = (events & (POLLERR | POLLHUP | POLLNVAL)) != 0;
  if (((events & POLLIN) != 0 || is_broken) && !connection.receive(now)) return false;
  if (((events & POLLOUT) != 0 || is_broken) && !connection.flush()) return false;
  if (!connection.request().empty()) {
    // Of a client that is gone altogether nobody waits for the answer that its rate holds up.
    const bool may = may_ask(client, now);
    if (may ? !answer(client, now) : is_broken) return false;
    count_waiting(client, now);
  }
  if (connection.is_malformed()) {
    ++counters_.malformed;
    return false;
  }
  return !is_too_late(client, now) && !connection.is_over();
}

/// Whether a client has not done for too long what it should have.
bool ModbusServer::is_too_late(const Client& client, Clock::time_point now) {
  const ModbusConnection& connection = *client.connection;
  const ModbusServerOptions& options = services_[client.service].options;
  if (!connection.request().empty()) return false;  // it waits for us
  const Clock::duration silence = now - connection.last_progress();
  if (connection.is_owing() && silence > options.stall_time) {
    ++counters_.stalled;
    return true;
  }
  if (options.idle_limit.count() > 0 && !connection.is_owing() && silence > options.idle_limit) {
    ++counters_.idle;
    return true;
  }
  return false;
}

ModbusServer::Clock::time_point ModbusServer::may_ask_at(const Client& client) const {
  return services_[client.service].options.requests_per_second == 0 ? Clock::time_point{}
                                                                    : client.due - kBurst;
}

/// Whether a client's next request keeps to its rate; if it does, the request counts.
bool ModbusServer::may_ask(Client& client, Clock::time_point now) {
  const std::uint32_t rate = services_[client.service].options.requests_per_second;
  if (rate == 0) return true;
  if (now < may_ask_at(client)) return false;
  client.is_waiting = false;
  client.due = std::max(now, client.due) + Clock::duration(std::chrono::seconds(1)) / rate;
  return true;
}

/// Counts the next request if it has to wait, once.
void ModbusServer::count_waiting(Client& client, Clock::time_point now) {
  if (client.is_waiting || client.connection->request().empty() || now >= may_ask_at(client)) return;
  client.is_waiting = true;
  ++counters_.throttled;
}

bool ModbusServer::answer(Client& client, Clock::time_point now) {
  ModbusResponder& responder = responders_[client.service];
  responder.set_peer(client.peer);
  const std::span<const std::uint8_t> reply = responder.answer(client.connection->request());
  if (reply.empty()) {
    ++counters_.faults;
    return false;
  }
  // Counted first, so that whoever has an answer finds it counted.
  ++counters_.requests;
  if (responder.exception() != ModbusException::none) ++counters_.exceptions;
  return client.connection->reply(reply, now);
}

void ModbusServer::accept_clients(const Listener& listener, Clock::time_point now) {
  for (int i = 0; i < kAcceptsPerTurn; ++i) {
    sockaddr_storage peer{};
    socklen_t size = sizeof peer;
    const int socket =
        ::accept4(listener.socket, reinterpret_cast<sockaddr*>(&peer), &size, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (socket < 0) {
      // Out of descriptors or memory: the waiting client would wake the thread again and again.
      if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM)
        accept_again_ = now + kCheckTime;
      return;
    }
    const bool is_admitted = admits(peer, listener.service);
    const bool has_capacity = is_admitted && make_room(listener.service, address_of(peer), now);
    auto* client = has_capacity ? new (std::nothrow) ModbusConnection(socket, now) : nullptr;
    if (client == nullptr) {
      if (is_admitted) ++counters_.refused;
      ::close(socket);
      continue;
    }
    tune_client(socket);
    clients_.push_back({std::unique_ptr<ModbusConnection>(client), listener.service, address_of(peer)});
    if (audit_ != nullptr) clients_.back().peer = peer_of(peer);
    ++counters_.connections;
  }
}

bool ModbusServer::admits(const sockaddr_storage& peer, std::size_t service) {
  const std::vector<IpNetwork>& allow = services_[service].options.allow;
  if (allow.empty() ||
      std::any_of(allow.begin(), allow.end(), [&](const IpNetwork& one) { return one.contains(peer); }))
    return true;
  ++counters_.not_allowed;
  if (audit_ != nullptr) audit_stranger(peer);
  return false;
}

void ModbusServer::audit_stranger(const sockaddr_storage& peer) {
  ModbusPeer stranger = peer_of(peer);
  AuditEntry entry;
  entry.via = "modbus";
  entry.from = std::move(stranger.from);
  entry.source = std::move(stranger.source);
  entry.action = "connect";
  entry.why = "not from a network in 'allow'";
  audit_->add(std::move(entry));
}

ModbusServer::Address ModbusServer::address_of(const sockaddr_storage& peer) noexcept {
  Address address{};
  if (peer.ss_family == AF_INET) {
    const auto& in = reinterpret_cast<const sockaddr_in&>(peer);
    std::memcpy(address.data(), &in.sin_addr, sizeof in.sin_addr);
  } else if (peer.ss_family == AF_INET6) {
    const auto& in = reinterpret_cast<const sockaddr_in6&>(peer);
    std::memcpy(address.data(), &in.sin6_addr, sizeof in.sin6_addr);
  }
  return address;
}

/// For one more client of this address: within its share of the service, and within the service.
bool ModbusServer::make_room(std::size_t service, const Address& address, Clock::time_point now) {
  const ModbusServerOptions& options = services_[service].options;
  const std::size_t share = options.max_clients_per_address != 0 ? options.max_clients_per_address
                                                                 : (3 * options.max_clients + 3) / 4;
  const auto of_service = [&](const Client& client) { return client.service == service; };
  const auto of_address = [&](const Client& client) {
    return client.service == service && client.address == address;
  };
  return make_room_among(share, of_address, options, now) &&
         make_room_among(options.max_clients, of_service, options, now);
}

/// Among the clients that count: where there are as many as may be, the one that has been silent longest
/// goes.
template <class Counts>
bool ModbusServer::make_room_among(std::size_t maximum, const Counts& counts,
                                   const ModbusServerOptions& options, Clock::time_point now) {
  std::size_t count = 0;
  auto silent = clients_.end();
  for (auto client = clients_.begin(); client != clients_.end(); ++client) {
    if (!counts(*client)) continue;
    ++count;
    if (silent == clients_.end() || client->connection->last_progress() < silent->connection->last_progress())
      silent = client;
  }
  if (count < maximum) return true;
  if (now - silent->connection->last_progress() < options.idle_time) return false;
  ++counters_.displaced;
  clients_.erase(silent);
  return true;
}

}  // namespace lockstep
