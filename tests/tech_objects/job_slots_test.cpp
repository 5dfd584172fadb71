#include "tech_objects/axis/job_slots.hpp"

#include <gtest/gtest.h>

#include <array>

namespace lockstep::job_slots_test {
namespace {

Job job_of(JobKind kind, StopMode mode = StopMode::emergency_ramp) {
  Job job;
  job.kind = kind;
  job.asks = StopJob{.mode = mode};
  return job;
}

TEST(JobSlots, RefuseWhatHasNoSpaceLeft) {
  JobSlots jobs;
  std::array<Job, 17> many;
  for (Job& job : many) jobs.submit(job);
  EXPECT_EQ(many[15].phase, JobPhase::handed_over);
  EXPECT_EQ(many[16].error, ErrorId::no_job_memory);
  int started = 0;
  jobs.take_new([&](Job& job) { EXPECT_EQ(&job, &many[static_cast<std::size_t>(started++)]); });
  EXPECT_EQ(started, 16);
  EXPECT_FALSE(jobs.has_new());
}

TEST(JobSlots, TellWhomANewJobEnds) {
  JobSlots jobs;
  Job runs = job_of(JobKind::MC_MoveVelocity), next = job_of(JobKind::MC_MoveAbsolute);
  jobs.put(kBase, runs, JobPhase::active);
  const Overriding effects = jobs.overriding(JobClass::motion, next, true);
  EXPECT_EQ(effects.refusal, ErrorId::none);
  EXPECT_TRUE(effects.ends[kBase]);
  EXPECT_EQ(runs.phase, JobPhase::active);
}

TEST(JobSlots, EndNobodyWhereOneForbidsTheNewJob) {
  JobSlots jobs;
  Job runs = job_of(JobKind::MC_Stop), weaker = job_of(JobKind::MC_Stop, StopMode::given_dynamics);
  jobs.put(kBase, runs, JobPhase::active);
  const Overriding effects = jobs.overriding(JobClass::stop, weaker, true);
  EXPECT_EQ(effects.refusal, ErrorId::locked);
  EXPECT_FALSE(effects.ends[kBase]);
}

TEST(JobSlots, StayLockedByAStopThatIsDoneUntilItsExecuteFalls) {
  JobSlots jobs;
  Job stop = job_of(JobKind::MC_Stop);
  stop.as<StopJob>().hold = true;
  stop.phase = JobPhase::active;
  jobs.lock(stop);
  EXPECT_TRUE(jobs.locked());
  stop.phase = JobPhase::done;
  jobs.unlock_unless_done();
  EXPECT_TRUE(jobs.locked());
  stop.as<StopJob>().hold = false;
  EXPECT_FALSE(jobs.locked());
}

TEST(JobSlots, ShowAnAlarmAtAStopAsCommandAborted) {
  Job stop = job_of(JobKind::MC_Stop), motion = job_of(JobKind::MC_Halt);
  JobSlots::end(stop, JobPhase::failed, ErrorId::technology_alarm);
  JobSlots::end(motion, JobPhase::failed, ErrorId::technology_alarm);
  EXPECT_EQ(stop.phase, JobPhase::aborted);
  EXPECT_EQ(stop.error, ErrorId::none);
  EXPECT_EQ(motion.phase, JobPhase::failed);
}

}  // namespace
}  // namespace lockstep::job_slots_test
