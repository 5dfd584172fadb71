/// Clock and instruction counter of the benchmark.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace lockstep::bench {

/// What one call of the work took [ns]: each figure is the least of several runs, since what else happens on
/// the machine only ever adds.
struct Timing {
  double mean = 0.0;    ///< processor time of a run
  double median = 0.0;  ///< of bursts, per call, on the clock; infinite without bursts
  double p99 = 0.0;     ///< of bursts, per call; those in which the thread lost its processor are left out
};

/// How long to measure.
struct Effort {
  int runs = 5;
  int calls = 1000;   ///< between two readings of the processor time, for the mean
  int burst = 1;      ///< calls between two readings of the clock, for median and 99th percentile
  int bursts = 2000;  ///< per run
};

/// Measures `work(n)`, which makes n calls.
Timing measure(const std::function<void(int calls)>& work, const Effort& effort);

/// Whether the program runs under callgrind, so that `count_instructions` counts.
bool counting_instructions();

/// Instructions that the work executes; 0 without callgrind.
std::uint64_t count_instructions(const std::function<void()>& work);

/// Instructions that the work executes so many times, without those of what is done before each time.
std::uint64_t count_instructions(int times, const std::function<void()>& before,
                                 const std::function<void()>& work);

/// Starts the program anew under callgrind, with the same arguments; returns only if that fails.
void restart_under_callgrind(char** arguments);

/// Instructions of each row by its name: what the program prints with --lines --instructions in a process of
/// its own. Empty where that does not run, as without valgrind.
std::map<std::string, double> instructions_of_rows(char** arguments);

/// Keeps the compiler from leaving a result out that nobody reads.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

}  // namespace lockstep::bench
