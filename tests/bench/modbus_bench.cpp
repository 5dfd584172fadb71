// The Modbus server beside the one of libmodbus on the same machine: ./dev bench modbus
#include <modbus.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "hmi_bridge/modbus/server.hpp"

namespace lockstep::bench {
namespace {

constexpr char kHelp[] = R"(modbus_bench [--rounds N] [--requests N] [--quick]: Modbus TCP on the loopback

One client, which is libmodbus, asks one request after the other: of this server, then of a loop of libmodbus's
own functions, in turns. Both servers' threads are equally nice (5), so that a busy machine treats them alike.

Most of a request's time is the system's, above all that of waking a thread that sleeps, and how long that takes
depends on where the threads are: on one core it is a switch, on another core that idles this has to be woken,
on a virtual machine by its host. Left alone, the system puts each server's thread somewhere by chance and keeps
it there, which can make either server look three times as quick as the other. So every work is measured with
client and servers on one core, which shows the servers' own work best, and with both servers on a second core
if the machine has one.

Shown are the requests per second and the times of single requests, and the ratio of this server to libmodbus,
of the median over all rounds.
)";

using Clock = std::chrono::steady_clock;
constexpr int kRegisters = 125;
constexpr int kNice = 5;  // of Lockstep's server

/// On which processors the threads are.
struct Placement {
  const char* name;
  int client;
  int servers;  ///< and the cycle
};

/// The placements that the processors allow on which this process may run.
std::vector<Placement> placements() {
  cpu_set_t allowed;
  ::sched_getaffinity(0, sizeof allowed, &allowed);
  std::vector<int> cores;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(core, &allowed)) cores.push_back(core);
  if (cores.empty()) throw std::runtime_error("no processor is known");
  std::vector<Placement> list{{"client and servers on one core", cores[0], cores[0]}};
  if (cores.size() > 1) list.push_back({"servers on another core than the client", cores[0], cores[1]});
  return list;
}

/// Moves this thread, and with it those that it starts from here on.
void move_to(int core) {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(core, &one);
  if (::sched_setaffinity(0, sizeof one, &one) != 0) throw std::runtime_error(std::strerror(errno));
}

/// libmodbus's own way to serve: one client, one thread.
class LibraryServer {
 public:
  LibraryServer() : context_(modbus_new_tcp("127.0.0.1", 0)), mapping_(modbus_mapping_new(0, 0, 200, 200)) {
    socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof place;
    if (context_ == nullptr || mapping_ == nullptr ||
        ::bind(socket_, reinterpret_cast<sockaddr*>(&place), size) != 0 || ::listen(socket_, 1) != 0 ||
        ::getsockname(socket_, reinterpret_cast<sockaddr*>(&place), &size) != 0)
      throw std::runtime_error("libmodbus's server does not start");
    port_ = ntohs(place.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~LibraryServer() {
    thread_.join();
    modbus_mapping_free(mapping_);
    modbus_free(context_);
  }
  int port() const { return port_; }

 private:
  /// Until its client hangs up.
  void serve() {
    ::setpriority(PRIO_PROCESS, 0, kNice);
    modbus_tcp_accept(context_, &socket_);
    std::uint8_t query[MODBUS_TCP_MAX_ADU_LENGTH];
    for (int length = 0; (length = modbus_receive(context_, query)) >= 0;)
      modbus_reply(context_, query, length, mapping_);
    modbus_close(context_);
    ::close(socket_);
  }

  modbus_t* context_;
  modbus_mapping_t* mapping_;
  int socket_ = -1;
  int port_ = 0;
  std::thread thread_;
};

/// What a run of requests took.
struct Result {
  double per_second = 0.0;
  double median = 0.0;  // [µs]
  double p99 = 0.0;     // [µs]
};

/// What is asked: a read or a write of so many registers.
struct Work {
  const char* name;
  int registers;
  bool is_write;
};
constexpr Work kWorks[] = {{"read 1 register", 1, false},
                           {"read 125 registers", 125, false},
                           {"write 1 register", 1, true},
                           {"write 120 registers", 120, true}};

using Client = std::unique_ptr<modbus_t, void (*)(modbus_t*)>;

Client client_of(int port) {
  Client client(modbus_new_tcp("127.0.0.1", port), [](modbus_t* context) {
    modbus_close(context);
    modbus_free(context);
  });
  modbus_set_response_timeout(client.get(), 20, 0);
  if (modbus_connect(client.get()) != 0) throw std::runtime_error(modbus_strerror(errno));
  return client;
}

Result ask(modbus_t* client, const Work& work, int requests) {
  std::vector<std::uint16_t> words(kRegisters, 7);
  std::vector<double> times;
  times.reserve(static_cast<std::size_t>(requests));
  const auto begin = Clock::now();
  for (int i = 0; i < requests; ++i) {
    const auto before = Clock::now();
    const int done = work.is_write ? modbus_write_registers(client, 0, work.registers, words.data())
                                   : modbus_read_registers(client, 0, work.registers, words.data());
    if (done != work.registers) throw std::runtime_error(modbus_strerror(errno));
    times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - before).count());
  }
  const std::chrono::duration<double> all = Clock::now() - begin;
  std::sort(times.begin(), times.end());
  return {requests / all.count(), times[times.size() / 2], times[times.size() * 99 / 100]};
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// The medians of the rounds.
Result summary(const std::vector<Result>& rounds) {
  const auto of = [&](double Result::*member) {
    std::vector<double> values;
    for (const Result& round : rounds) values.push_back(round.*member);
    return median(values);
  };
  return {of(&Result::per_second), of(&Result::median), of(&Result::p99)};
}

void compare(int port, int library_port, const Work& work, int rounds, int requests) {
  const Client ours = client_of(port);
  const Client theirs = client_of(library_port);
  std::vector<Result> own;
  std::vector<Result> other;
  ask(ours.get(), work, requests / 10 + 1);
  ask(theirs.get(), work, requests / 10 + 1);
  for (int round = 0; round < rounds; ++round) {
    own.push_back(ask(ours.get(), work, requests));
    other.push_back(ask(theirs.get(), work, requests));
  }
  const Result a = summary(own);
  const Result b = summary(other);
  std::printf("%-20s %9.0f %9.0f %6.2f   %7.1f %7.1f %6.2f   %7.1f %5.1f %7.1f\n", work.name, a.per_second,
              b.per_second, a.per_second / b.per_second, a.median, b.median, a.median / b.median, a.p99,
              a.p99 / a.median, b.p99);
  std::fflush(stdout);
}

/// A machine of 125 words, with a cycle that ticks every millisecond.
class Machine {
 public:
  Machine() : image_(signals()), map_(entries(), std::vector<Type>(kRegisters, Type::UINT)) {
    ModbusServerOptions options;
    options.listen = {{"127.0.0.1", 0}};
    server_ = std::make_unique<ModbusServer>(options, map_, image_);
    if (const std::string problem = server_->start(); !problem.empty()) throw std::runtime_error(problem);
    cycle_ = std::thread([this] {
      for (std::int64_t tick = 0; !is_over_; ++tick) {
        image_.take_writes();
        image_.publish(tick);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    });
  }
  ~Machine() {
    is_over_ = true;
    cycle_.join();
  }
  int port() const { return server_->port(); }

 private:
  std::vector<Signal> signals() {
    std::vector<Signal> list;
    for (UINT& word : words_) list.push_back({&word, Type::UINT, -1});
    return list;
  }
  static std::vector<ModbusEntry> entries() {
    std::vector<ModbusEntry> list(kRegisters);
    for (std::uint32_t i = 0; i < list.size(); ++i) {
      list[i].signal = list[i].address = i;
      list[i].type = Type::UINT;
      list[i].writable = true;
    }
    return list;
  }

  std::vector<UINT> words_ = std::vector<UINT>(kRegisters, 7);
  ProcessImage image_;
  ModbusMap map_;
  std::unique_ptr<ModbusServer> server_;
  std::atomic<bool> is_over_{false};
  std::thread cycle_;
};

void measure(const Placement& placement, int rounds, int requests) {
  std::printf("%s\n%-20s %26s   %22s   %21s\n", placement.name, "", "requests/s", "median [us]", "p99 [us]");
  std::printf("%-20s %9s %9s %6s   %7s %7s %6s   %7s %5s %7s\n", "", "Lockstep", "libmodbus", "ratio",
              "Lockst.", "libm.", "ratio", "Lockst.", "x med", "libm.");
  for (const Work& work : kWorks) {
    move_to(placement.servers);
    const Machine machine;
    const LibraryServer library;
    move_to(placement.client);
    compare(machine.port(), library.port(), work, rounds, requests);
  }
  std::puts("");
}

void run(int rounds, int requests) {
  for (const Placement& placement : placements()) measure(placement, rounds, requests);
}

}  // namespace
}  // namespace lockstep::bench

int main(int count, char** arguments) {
  int rounds = 15;
  int requests = 2000;
  for (int i = 1; i < count; ++i) {
    const std::string option = arguments[i];
    if (option == "--quick") {
      rounds = 1;
      requests = 20;
    } else if ((option == "--rounds" || option == "--requests") && i + 1 < count) {
      (option == "--rounds" ? rounds : requests) = std::max(1, std::atoi(arguments[++i]));
    } else {
      std::fputs(lockstep::bench::kHelp, option == "--help" ? stdout : stderr);
      return option == "--help" ? 0 : 2;
    }
  }
  try {
    lockstep::bench::run(rounds, requests);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "modbus_bench: %s\n", error.what());
    return 1;
  }
}
