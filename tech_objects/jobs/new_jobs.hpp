/// Jobs that have been handed over and not been started yet.
#pragma once

#include <array>
#include <cstddef>

#include "tech_objects/jobs/job.hpp"

namespace lockstep {

/// In the order in which they were handed over. Thread: the cycle.
class NewJobs {
 public:
  /// With no space left the job fails with 16#8014 at once. It stays where it is until it has ended.
  void submit(Job& job) noexcept {
    if (count_ == jobs_.size()) return job.fail(ErrorId::no_job_memory);
    job.phase = JobPhase::handed_over;
    jobs_[count_++] = &job;
  }

  /// Hands each to `start` and forgets them.
  template <class Start>
  void take(Start start) noexcept {
    for (std::size_t i = 0; i < count_; ++i) start(*jobs_[i]);
    count_ = 0;
  }

 private:
  std::array<Job*, 16> jobs_{};
  std::size_t count_ = 0;
};

}  // namespace lockstep
