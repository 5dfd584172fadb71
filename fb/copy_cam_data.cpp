#include "fb/copy_cam_data.hpp"

#include "tech_objects/jobs/modes.hpp"

namespace lockstep {

void MC_CopyCamData::request(Job& job) const noexcept {
  job.kind = JobKind::MC_CopyCamData;
  job.asks = CamCopyJob{};
}

void MC_CopyCamData::hand_over(Job& job) noexcept {
  const CamCopy copy{.points = ArrayOfPoints,
                     .segments = ArrayOfSegments,
                     .start_point_cam = StartPointCam,
                     .start_segment_cam = StartSegmentCam,
                     .start_point_array = StartPointArray,
                     .start_segment_array = StartSegmentArray,
                     .number_of_points = NumberOfPoints,
                     .number_of_segments = NumberOfSegments,
                     .keep = chooses(Mode, CamCopyMode::keep)};
  job.as<CamCopyJob>().copy = &copy;
  Cam->submit(job);
  job.as<CamCopyJob>().copy = nullptr;
}

}  // namespace lockstep
