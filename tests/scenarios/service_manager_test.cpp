// What a run tells systemd: ready, that its ticks advance, that it ends. The test takes systemd's part.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>

#include <cstddef>
#include <optional>

#include "tests/scenarios/cycle_thread.hpp"
#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::service_manager_test {
namespace {

using namespace std::chrono_literals;

/// The socket of a service manager, at a path or, with "@", at an abstract address.
class NotifySocket {
 public:
  explicit NotifySocket(std::string name)
      : name_(std::move(name)), socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    name_.copy(address.sun_path, sizeof address.sun_path - 1);
    if (name_[0] == '@') address.sun_path[0] = '\0';
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name_.size());
    EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&address), size), 0) << name_;
  }
  ~NotifySocket() { ::close(socket_); }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  const std::string& name() const { return name_; }
  /// The next message; none after that time.
  std::optional<std::string> next(std::chrono::milliseconds limit = 60s) const {
    pollfd source{socket_, POLLIN, 0};
    if (::poll(&source, 1, static_cast<int>(limit.count())) != 1) return std::nullopt;
    char text[256];
    const ssize_t size = ::recv(socket_, text, sizeof text, 0);
    return std::string(text, size < 0 ? 0 : static_cast<std::size_t>(size));
  }
  void drain() const {
    while (next(0ms)) continue;
  }

 private:
  const std::string name_;
  const int socket_;
};

std::string one_axis(const Directory& directory) {
  Json json = empty_project();
  json["technology_objects"]["A"] = virtual_axis();
  return directory.write("project.json", json.dump());
}

std::vector<std::string> watched_run(const std::string& project, const NotifySocket& socket,
                                     const std::vector<std::string>& environment,
                                     const std::vector<std::string>& options = {}) {
  std::vector<std::string> command{"env", "NOTIFY_SOCKET=" + socket.name()};
  command.insert(command.end(), environment.begin(), environment.end());
  for (const std::string& word : lockstep_command({"run", project})) command.push_back(word);
  command.insert(command.end(), options.begin(), options.end());
  return command;
}

void is_told_of(const NotifySocket& socket) {
  const Directory directory;
  Process run(watched_run(one_axis(directory), socket, {"WATCHDOG_USEC=200000"}));
  EXPECT_EQ(socket.next(), "READY=1") << run.err();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(socket.next(), "WATCHDOG=1") << run.err();
  run.send(SIGTERM);
  std::optional<std::string> message = "WATCHDOG=1";
  while (message == "WATCHDOG=1") message = socket.next();
  EXPECT_EQ(message, "STOPPING=1");
  EXPECT_EQ(run.status(), 0) << run.err();
}

TEST(ServiceManager, AtAPathIsToldOfBeginTicksAndEnd) {
  const Directory directory;
  is_told_of(NotifySocket(directory.file("notify")));
}

TEST(ServiceManager, AtAnAbstractAddressIsToldOfBeginTicksAndEnd) {
  is_told_of(NotifySocket("@lockstep/test/" + std::to_string(::getpid())));
}

TEST(ServiceManager, ThatWatchesNobodyOrAnotherProcessHearsOfBeginAndEndAlone) {
  const Directory directory;
  const NotifySocket socket(directory.file("notify"));
  const std::vector<std::vector<std::string>> environments{
      {}, {"WATCHDOG_USEC=20000", "WATCHDOG_PID=1"}, {"WATCHDOG_USEC=soon"}, {"WATCHDOG_USEC=-1"}};
  for (const std::vector<std::string>& environment : environments) {
    Process run(watched_run(one_axis(directory), socket, environment, {"--duration", "300ms"}));
    EXPECT_EQ(run.status(), 0) << run.err();
    EXPECT_EQ(socket.next(), "READY=1");
    EXPECT_EQ(socket.next(), "STOPPING=1");
    EXPECT_EQ(socket.next(0ms), std::nullopt);
  }
}

/// Stops one thread of a process that this one has started, as a debugger does, while the others go on.
class StoppedThread {
 public:
  explicit StoppedThread(pid_t thread) : thread_(thread) {
    EXPECT_EQ(::ptrace(PTRACE_SEIZE, thread_, nullptr, nullptr), 0) << std::strerror(errno);
    EXPECT_EQ(::ptrace(PTRACE_INTERRUPT, thread_, nullptr, nullptr), 0) << std::strerror(errno);
    int status = 0;
    EXPECT_EQ(::waitpid(thread_, &status, __WALL), thread_);
    EXPECT_TRUE(WIFSTOPPED(status));
  }
  ~StoppedThread() { ::ptrace(PTRACE_DETACH, thread_, nullptr, nullptr); }
  StoppedThread(const StoppedThread&) = delete;
  StoppedThread& operator=(const StoppedThread&) = delete;

 private:
  const pid_t thread_;
};

TEST(ServiceManager, HearsNothingWhileTicksDoNotAdvance) {
  const Directory directory;
  const NotifySocket socket(directory.file("notify"));
  Process run(watched_run(one_axis(directory), socket, {"WATCHDOG_USEC=80000"}));
  ASSERT_EQ(socket.next(), "READY=1") << run.err();
  ASSERT_EQ(socket.next(), "WATCHDOG=1");
  {
    const pid_t thread = thread_named(run.pid(), "cycle");
    ASSERT_NE(thread, 0);
    const StoppedThread cycle(thread);
    // The last ticks may not have been told of yet.
    ASSERT_TRUE(wait_until([&] { return !socket.next(500ms); })) << "it is told of ticks that there are not";
    EXPECT_EQ(socket.next(1s), std::nullopt);
    EXPECT_TRUE(run.running());
  }
  EXPECT_EQ(socket.next(), "WATCHDOG=1") << "as soon as they advance again";
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 0) << run.err();
}

TEST(ServiceManager, ThatTakesNothingHoldsNoRunUp) {
  const Directory directory;
  const NotifySocket socket(directory.file("notify"));
  Process run(watched_run(one_axis(directory), socket, {"WATCHDOG_USEC=4000"}, {"--duration", "1s"}));
  EXPECT_EQ(run.status(), 0) << run.err();
  EXPECT_EQ(socket.next(), "READY=1");
}

TEST(ServiceManager, WhoseAddressIsNoneIsNoReasonNotToRun) {
  const Directory directory;
  for (const std::string& name :
       {std::string("vsock:2:1"), std::string("x"), "/" + std::string(200, 'x'), directory.file("nobody")}) {
    Process run(
        {"env", "NOTIFY_SOCKET=" + name, LOCKSTEP_PROGRAM, "run", one_axis(directory), "--duration", "50ms"});
    EXPECT_EQ(run.status(), 0) << name << run.err();
  }
}

}  // namespace
}  // namespace lockstep::test::service_manager_test
