#include "hmi_bridge/modbus_server.hpp"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <pthread.h>
#include <sched.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/socket.h>
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

}  // namespace

ModbusServer::ModbusServer(ModbusServerOptions options, const ModbusMap& map, ProcessImage& image)
    : options_(std::move(options)), map_(map), image_(image) {}

ModbusServer::~ModbusServer() {
  stop();
}

std::string ModbusServer::start() {
  if (thread_.joinable()) return {};
  const std::string place = options_.host + ":" + std::to_string(options_.port) + ": ";
  if (const std::string problem = listen(); !problem.empty()) {
    close_sockets();
    return place + problem;
  }
  sigset_t all;
  sigset_t before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);  // signals are for the thread that waits for them
  std::string problem;
  try {
    responder_ = std::make_unique<ModbusResponder>(map_, image_);
    clients_.reserve(options_.max_clients);
    events_.reserve(options_.max_clients + 2);
    is_stopping_ = false;
    thread_ = std::thread([this] { run(); });
  } catch (const std::exception& error) {
    close_sockets();
    problem = place + error.what();
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return problem;
}

std::string ModbusServer::listen() {
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const std::string service = std::to_string(options_.port);
  if (const int code = ::getaddrinfo(options_.host.c_str(), service.c_str(), &hints, &found); code != 0)
    return ::gai_strerror(code);
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> addresses(found, ::freeaddrinfo);
  wake_ = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (wake_ < 0 || listener_ < 0) return std::strerror(errno);
  set_option(listener_, SOL_SOCKET, SO_REUSEADDR, 1);
  sockaddr_in bound{};
  socklen_t size = sizeof bound;
  if (::bind(listener_, addresses->ai_addr, addresses->ai_addrlen) != 0 ||
      ::listen(listener_, SOMAXCONN) != 0 ||
      ::getsockname(listener_, reinterpret_cast<sockaddr*>(&bound), &size) != 0)
    return std::strerror(errno);
  port_ = ntohs(bound.sin_port);
  return {};
}

void ModbusServer::close_sockets() noexcept {
  for (int* socket : {&listener_, &wake_}) {
    if (*socket >= 0) ::close(*socket);
    *socket = -1;
  }
  port_ = 0;
}

void ModbusServer::stop() {
  if (!thread_.joinable()) return;
  is_stopping_ = true;
  const std::uint64_t one = 1;
  while (::write(wake_, &one, sizeof one) < 0 && errno == EINTR) {
  }
  thread_.join();
  close_sockets();
  responder_.reset();
}

void ModbusServer::run() noexcept {
  step_back();
  while (!is_stopping_) {
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
  Clock::time_point now = Clock::now();
  const bool accepts = now >= accept_again_;
  events_.assign(1, {wake_, POLLIN, 0});
  events_.push_back({accepts ? listener_ : -1, POLLIN, 0});
  for (const auto& client : clients_) events_.push_back({client->socket(), client->events(), 0});
  if (::poll(events_.data(), events_.size(), wait_time(now)) < 0) {
    if (errno == EINTR) return;
    throw std::system_error(errno, std::generic_category());
  }
  now = Clock::now();
  for (std::size_t i = 0; i < clients_.size(); ++i)
    if (!serve(*clients_[i], events_[i + 2].revents, now)) clients_[i].reset();
  std::erase(clients_, nullptr);
  if (events_[1].revents != 0) accept_clients(now);
  counters_.clients = clients_.size();
}

int ModbusServer::wait_time(Clock::time_point now) const {
  bool has_to_check = now < accept_again_;
  for (const auto& client : clients_) {
    if (!client->request().empty()) return 0;
    has_to_check = has_to_check || client->is_owing();
  }
  return has_to_check ? static_cast<int>(kCheckTime.count()) : -1;
}

bool ModbusServer::serve(ModbusConnection& client, short events, Clock::time_point now) {
  const bool is_broken = (events & (POLLERR | POLLHUP | POLLNVAL)) != 0;
  if (((events & POLLIN) != 0 || is_broken) && !client.receive(now)) return false;
  if (((events & POLLOUT) != 0 || is_broken) && !client.flush()) return false;
  if (!client.request().empty() && !answer(client, now)) return false;
  if (client.is_malformed()) {
    ++counters_.malformed;
    return false;
  }
  if (client.is_owing() && client.request().empty() && now - client.last_progress() > options_.stall_time) {
    ++counters_.stalled;
    return false;
  }
  return !client.is_over();
}

bool ModbusServer::answer(ModbusConnection& client, Clock::time_point now) {
  const std::span<const std::uint8_t> reply = responder_->answer(client.request());
  if (reply.empty()) {
    ++counters_.faults;
    return false;
  }
  // Counted first, so that whoever has an answer finds it counted.
  ++counters_.requests;
  if (responder_->exception() != ModbusException::none) ++counters_.exceptions;
  return client.reply(reply, now);
}

void ModbusServer::accept_clients(Clock::time_point now) {
  for (int i = 0; i < kAcceptsPerTurn; ++i) {
    const int socket = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (socket < 0) {
      // Out of descriptors or memory: the waiting client would wake the thread again and again.
      if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM)
        accept_again_ = now + kCheckTime;
      return;
    }
    auto* client = make_room(now) ? new (std::nothrow) ModbusConnection(socket, now) : nullptr;
    if (client == nullptr) {
      ++counters_.refused;
      ::close(socket);
      continue;
    }
    tune_client(socket);
    clients_.emplace_back(client);
    ++counters_.connections;
  }
}

bool ModbusServer::make_room(Clock::time_point now) {
  if (clients_.size() < options_.max_clients) return true;
  const auto silent = std::min_element(clients_.begin(), clients_.end(), [](const auto& a, const auto& b) {
    return a->last_progress() < b->last_progress();
  });
  if (silent == clients_.end() || now - (*silent)->last_progress() < options_.idle_time) return false;
  ++counters_.displaced;
  clients_.erase(silent);
  return true;
}

}  // namespace lockstep
