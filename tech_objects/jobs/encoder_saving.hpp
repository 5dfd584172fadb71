/// The adjustments of absolute encoders, brought to the disk when a program asks for it: what is common to
/// all instances of MC_SaveAbsoluteEncoderData of a controller.
/// @source S7-1500T axis functions, MC_SaveAbsoluteEncoderData
#pragma once

#include "tech_objects/jobs/job.hpp"

namespace lockstep {

/// One job at a time. The thread of the cycle calls and changes all of this; another one that writes sees
/// `asked` and answers by `answered` and `error` through an image of signals.
class EncoderSaving {
 public:
  static constexpr int kMaximumInstances = 2;  ///< of the block, in a controller

  // ---- Load time

  /// One more instance of the block; whether it may have jobs.
  bool admit() noexcept { return ++instances_ <= kMaximumInstances; }
  bool kept = false;  ///< whether somebody writes what a job asks for

  // ---- Cycle

  /// @errors 16#80EE another one runs; 16#80EF nobody writes
  void submit(Job& job) noexcept;
  /// Each tick, once the answers have come in.
  void step() noexcept;

  UDINT asked{};     ///< number of the newest job
  UDINT answered{};  ///< number of the newest job that is over
  WORD error{};      ///< why that one failed, an ErrorId; 0: the adjustments of a tick that knew it are kept
  BOOL differs{};    ///< of an error: they were written, and read back otherwise

 private:
  Job* job_ = nullptr;
  int instances_ = 0;
};

}  // namespace lockstep
