#include "tech_objects/objects/technology_object.hpp"

#include "tech_objects/jobs/job.hpp"

namespace lockstep {

void TechnologyObject::submit(Job& job) noexcept {
  if (job.kind != JobKind::MC_Reset) return job.fail(ErrorId::no_technology_object);
  job.phase = JobPhase::done;
}

}  // namespace lockstep
