/// The thread that keeps values: it takes snapshots of the cycle and writes what has changed.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "hmi_bridge/retain/file.hpp"
#include "scheduler/process_image.hpp"
#include "tech_objects/jobs/encoder_saving.hpp"

namespace lockstep {

/// Gives kept values back to their signals. Before the first tick, in the thread that loads. An array that
/// was kept with another type, and an array's values kept under the name of what is another now, stay in the
/// file as "NAME@TYPE": nobody could type them in again from a message.
/// @return what could not be given back and why, as plain texts; those values stay as they are
/// @throws RetainFileError for a text that is no value of its type: the file is damaged
std::vector<std::string> restore(RetainFile& file, const std::vector<KeptValue>& values);

/// Writes the values to their file whenever they have changed, each time those of one tick; between two
/// writes there is an interval, but for a job that asks for one at once and is answered when the disk has the
/// values. The cycle never waits for it and never wakes it. A write that fails is tried again after the next
/// interval.
class RetainWriter {
 public:
  static constexpr std::chrono::milliseconds kPoll{20};  ///< how often it looks at most
  static constexpr std::chrono::seconds kWatch{1};  ///< between two looks whether the file is there still

  /// The signals stay where they are for the life of the writer.
  /// @param saving whose jobs it answers; nullptr: there are none
  /// @param watch how often it looks whether the file is there still
  RetainWriter(RetainFile file, std::vector<KeptValue> values, std::chrono::nanoseconds interval,
               EncoderSaving* saving = nullptr, std::chrono::nanoseconds watch = kWatch);
  ~RetainWriter();  ///< stops
  RetainWriter(const RetainWriter&) = delete;
  RetainWriter& operator=(const RetainWriter&) = delete;

  /// The crossing, for the controller.
  ProcessImage& image() noexcept { return image_; }

  void start();
  /// Writes the values of the last tick and ends the thread. To be called after that tick.
  void stop();

  /// The next piece of what has happened since the last time somebody asked: why values cannot be written,
  /// that they can be again, what somebody has done to the file; empty: nothing new. Any thread but the
  /// cycle's.
  std::string news();
  /// Whether what the file holds is not what `image` shows, since writing failed. Any thread but the cycle's.
  bool failing() const;
  const std::string& path() const noexcept { return file_.path(); }
  /// How often the file has been changed. Any thread but the cycle's.
  std::uint64_t commits() const;

 private:
  void run();
  bool wait(std::chrono::steady_clock::duration time);
  bool look();
  std::vector<KeptRow> rows();
  void write();
  void watch();
  void note(const std::string& problem);
  void add_news(std::string text);
  void answer();

  RetainFile file_;
  const std::vector<KeptValue> values_;
  const std::chrono::nanoseconds interval_, watch_;
  const std::size_t asked_at_;      // place in the image of EncoderSaving::asked; its end: nobody asks
  ProcessImage image_;              // all values, whether those are present that need not be, EncoderSaving
  std::vector<Value> seen_;         // what the last look saw in it
  std::vector<std::string> texts_;  // of each value
  std::vector<bool> is_old_;        // of each text: the value has changed since
  bool changed_ = false;            // since the last write that went well
  bool is_away_ = false;            // the file was not under its name, and could not be made again
  std::uint64_t asked_ = 0;         // number of the newest job that the last look saw
  std::uint64_t answered_ = 0;      // number of the newest job that has been answered

  mutable std::mutex mutex_;  // guards those below
  std::condition_variable wake_;
  bool stop_ = false;
  bool failing_ = false;
  std::uint64_t commits_ = 0;
  std::deque<std::string> news_;
  std::thread thread_;
};

}  // namespace lockstep
