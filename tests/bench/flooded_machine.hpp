/// A machine that runs in real time with its Modbus server and its recorder, for measuring its ticks.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "hmi_bridge/modbus/server.hpp"
#include "hmi_bridge/traces/recorder.hpp"
#include "projects/loader/project.hpp"
#include "scheduler/process_image.hpp"
#include "scheduler/trace_ring.hpp"

namespace lockstep::bench {

/// The project files of the machines that are measured: six axes on a line shaft, and so many axes in gear
/// with five signals each that an operator sees, two of which are recorded.
std::string line_shaft();
std::string axes_in_gear(int axes);

/// @throws std::runtime_error if the project has problems
Project project_of(const std::string& text);

/// A program that has subscribed to everything on the network of LCM and then stopped: what it does not take
/// fills the buffer of its socket. To be made before there are threads.
class StoppedSubscriber {
 public:
  StoppedSubscriber();
  ~StoppedSubscriber();
  StoppedSubscriber(const StoppedSubscriber&) = delete;
  StoppedSubscriber& operator=(const StoppedSubscriber&) = delete;

  const char* url() const;  ///< its network, or one within this process where there is no other

 private:
  const pid_t child_;
  bool is_there_ = false;
};

/// Processor time of ticks [µs].
struct TickTimes {
  double median = 0.0;
  double mean = 0.0;
};

/// So many ticks on a thread of their own, as `lockstep run` has them: with real-time priority where that is
/// permitted, each at its time, and none made up. Those at the beginning, which find what was before, are not
/// counted. @param processor of the cycle; negative: any
TickTimes run_ticks(Controller& controller, int processor, int ticks);

/// Ticks with something, and ticks without it.
struct TurnTimes {
  TickTimes with, without;
};

/// The same by turns: of every two cycles of the interpolator that follow each other one has it, drawn which,
/// so that what else changes the speed of the processor changes both. @param turn called before each of them,
/// outside of its time
TurnTimes run_ticks_by_turns(Controller& controller, int processor, int ticks,
                             const std::function<void(bool with)>& turn);

class FloodedMachine {
 public:
  /// @param processor of the cycle; negative: any
  FloodedMachine(const std::string& text, int processor, const StoppedSubscriber& subscriber);
  ~FloodedMachine();

  TickTimes run(int ticks) { return run_ticks(*project_.controller, processor_, ticks); }

  /// Records from here on to a full disk and a stopped subscriber, or to where nothing hinders.
  void hinder_recorder(bool hindered);

  std::uint64_t requests() const { return server_->counters().requests; }
  std::uint16_t port() const { return server_->port(); }

 private:
  struct Recording {
    TraceRing ring;
    TraceRecorder recorder;
    Recording(const Project& project, const char* file, const char* url);
  };

  Project project_;
  ProcessImage image_;
  int processor_;
  std::unique_ptr<ModbusServer> server_;
  Recording free_, hindered_;
};

}  // namespace lockstep::bench
