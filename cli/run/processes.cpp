// lockstep run of a system file in real time: a process for each controller, one summary of them all.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "cli/command/command.hpp"
#include "cli/command/shortage.hpp"
#include "cli/run/ending.hpp"
#include "cli/run/run_command.hpp"
#include "cli/run/service_manager.hpp"

namespace lockstep::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto kLookAtProcesses = 20ms;  // at whether a process has ended
constexpr std::size_t kDescriptorsOfProcess = 2, kDescriptorsOfThis = 20;
constexpr std::int64_t kServiceCycle = 100'000'000;  // [ns] of looks that a service manager hears of
constexpr std::size_t kSummaryChunk = 4096;          // of a summary that is read [byte]

/// What a process of a controller is told of the run.
std::vector<std::string> arguments_of(const RunOptions& options, FailOn fail_on,
                                      const std::string& controller) {
  std::vector<std::string> words{"lockstep", "run", options.file, "--controller", controller};
  const auto add = [&](bool wanted, const char* option, const std::string& value = "") {
    if (!wanted) return;
    words.emplace_back(option);
    if (!value.empty()) words.push_back(value);
  };
  std::string signals;
  for (const std::string& signal : options.signals) signals += (signals.empty() ? "" : ",") + signal;
  add(options.duration > 0, "--duration", std::to_string(options.duration) + "ns");
  add(!options.trace.empty(), "--trace", options.trace);
  add(!signals.empty(), "--signals", signals);
  add(options.stimuli, "--stimuli");
  add(options.no_modbus, "--no-modbus");
  add(options.no_lcm, "--no-lcm");
  add(options.no_retain, "--no-retain");
  add(fail_on.alarm, "--fail-on", fail_on.warning ? "warning" : "alarm");
  add(fail_on.job, "--fail-on", "job");
  return words;
}

/// A process that runs a controller. It ends with this one.
class ControllerProcess {
 public:
  /// @throws std::system_error
  ControllerProcess(std::string controller, const std::vector<std::string>& arguments)
      : name(std::move(controller)), summary_(::memfd_create("summary", MFD_CLOEXEC)) {
    if (summary_ < 0) throw std::system_error(errno, std::generic_category(), "a summary cannot be kept");
    start(arguments);
  }
  ~ControllerProcess() {
    stop();
    if (pid_ > 0) ::waitpid(pid_, nullptr, 0);
    ::close(summary_);
  }
  ControllerProcess(const ControllerProcess&) = delete;
  ControllerProcess& operator=(const ControllerProcess&) = delete;

  /// Asks it to end. Any thread.
  void stop() noexcept {
    const std::lock_guard lock(mutex_);
    if (pid_ > 0) ::kill(pid_, SIGTERM);
  }
  /// Whether it has ended by now.
  bool ended() noexcept {
    const std::lock_guard lock(mutex_);
    if (pid_ <= 0) return true;
    int status = 0;
    if (::waitpid(pid_, &status, WNOHANG) != pid_) return false;
    pid_ = -1;
    status_ = WIFEXITED(status) ? WEXITSTATUS(status) : kStoppedByFault;
    return true;
  }
  /// Of one that has ended.
  int status() const noexcept { return status_; }
  std::string summary() const {
    std::string text;
    std::array<char, kSummaryChunk> buffer;
    ::lseek(summary_, 0, SEEK_SET);
    for (ssize_t n = 0; (n = ::read(summary_, buffer.data(), buffer.size())) > 0;)
      text.append(buffer.data(), static_cast<std::size_t>(n));
    return text;
  }

  const std::string name;

 private:
  void start(const std::vector<std::string>& arguments);

  const int summary_;
  std::mutex mutex_;  // guards the number of the process, which another one has once it has been waited for
  pid_t pid_ = -1;
  int status_ = kStoppedByFault;
};

void ControllerProcess::start(const std::vector<std::string>& arguments) {
  std::vector<char*> words;
  for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  // Of its own: what the terminal sends to a group comes to this process alone, which asks the others.
  ::setenv(kSummaryVariable, std::to_string(summary_).c_str(), 1);
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid < 0) throw std::system_error(errno, std::generic_category(), "no further process can be begun");
  if (pid > 0) {
    pid_ = pid;
    return;
  }
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  ::fcntl(summary_, F_SETFD, 0);
  if (::getppid() == parent) ::execv("/proc/self/exe", words.data());
  ::_exit(kCouldNotStart);
}

/// The graver one of two exit statuses.
int graver(int a, int b) noexcept {
  constexpr std::array kOrder{static_cast<int>(kOk), static_cast<int>(kFailedOn), static_cast<int>(kNotValid),
                              static_cast<int>(kCouldNotStart)};
  const auto rank = [&](int status) { return std::ranges::find(kOrder, status) - kOrder.begin(); };
  return rank(b) > rank(a) ? b : a;
}

/// Waits for all; those that others need go, and all are asked to end.
void wait_for_all(std::vector<std::unique_ptr<ControllerProcess>>& processes, const Ending& ending,
                  ServiceManager& manager) {
  const auto stop_all = [&] {
    for (const auto& process : processes) process->stop();
  };
  bool stopping = false;
  std::uint64_t looks = 0;
  for (;;) {
    std::size_t running = 0;
    const ControllerProcess* failed = nullptr;
    for (const auto& process : processes) {
      if (!process->ended())
        ++running;
      else if (process->status() != kOk && process->status() != kFailedOn)
        failed = process.get();
    }
    if (running == 0) return;
    if (ending.requested()) manager.stopping();
    if (failed != nullptr && !stopping && !ending.requested()) {
      tell(failed->name + " has ended with status " + std::to_string(failed->status()) +
               ": the other controllers are brought to rest",
           Severity::error);
      stop_all();
      stopping = true;
    }
    if (running == processes.size()) manager.look(++looks);
    std::this_thread::sleep_for(kLookAtProcesses);
  }
}

int tell_ends(const std::vector<std::unique_ptr<ControllerProcess>>& processes) {
  int status = kOk;
  for (const auto& process : processes) {
    write_message(process->name + "\n" + process->summary());
    if (process->status() != kOk) write_message(fmt::format("  ended with status {}\n", process->status()));
    status = graver(status, process->status());
  }
  return status;
}

}  // namespace

int run_processes(const RunOptions& options, FailOn fail_on) {
  int status = kOk;
  const std::optional<System> system = load_system_or_tell(options.file, status, LoadedFor::looking);
  if (!system) return status;
  for (std::size_t i = 0; i < system->controllers.size(); ++i) options_of(*system, i, options);
  require_descriptors(kDescriptorsOfThis + kDescriptorsOfProcess * system->controllers.size());
  Ending ending;
  ServiceManager manager(kServiceCycle);
  ::unsetenv("NOTIFY_SOCKET");  // this process speaks for all
  std::vector<std::unique_ptr<ControllerProcess>> processes;
  try {
    for (const SystemController& controller : system->controllers)
      processes.push_back(std::make_unique<ControllerProcess>(
          controller.name, arguments_of(options, fail_on, controller.name)));
  } catch (const std::system_error& error) {
    throw CouldNotStart(error.what());
  }
  ending.run([&processes] {
    for (const auto& process : processes) process->stop();
  });
  wait_for_all(processes, ending, manager);
  ending.finished();
  return tell_ends(processes);
}

}  // namespace lockstep::cli
