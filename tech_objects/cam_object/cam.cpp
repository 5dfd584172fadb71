#include "tech_objects/cam_object/cam.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace lockstep {
namespace {

/// Elements that are looked at for changes in one interpolator tick.
constexpr std::size_t kCompared = 250;
/// Points that are copied in one interpolator tick.
constexpr std::size_t kMoved = 1000;

std::size_t points_of(ObjectKind kind) noexcept {
  return kind == ObjectKind::TO_Cam_10k ? kCam10kPoints : kCamPoints;
}

/// Copies a part of a list to the same place of another.
template <class Element>
void move_part(std::span<const Element> from, std::span<Element> to, std::size_t begin,
               std::size_t end) noexcept {
  std::ranges::copy(from.subspan(begin, end - begin), to.begin() + static_cast<std::ptrdiff_t>(begin));
}

/// Whether an array has a start and as many elements from there on.
ErrorId check_source(const Array* array, const ElementType& element, DINT start, DINT number,
                     ErrorId array_error, ErrorId start_error, ErrorId number_error) noexcept {
  if (array == nullptr) return number > 0 ? array_error : ErrorId::none;
  if (array->element != &element) return array_error;
  if (!array->holds(start)) return start_error;
  return std::int64_t{start} + number - 1 > array->upper ? number_error : ErrorId::none;
}

/// Whether a data block has a place, from 1, and as many elements from there on.
ErrorId check_target(std::size_t count, DINT start, DINT number, ErrorId start_error,
                     ErrorId number_error) noexcept {
  const auto last = static_cast<std::int64_t>(count);
  if (start < 1 || start > last) return start_error;
  return number < 0 || std::int64_t{start} + number - 1 > last ? number_error : ErrorId::none;
}

/// Whether a part of two lists differs.
template <class Element>
bool differ(std::span<const Element> a, std::span<const Element> b, std::size_t from,
            std::size_t count) noexcept {
  if (from >= a.size()) return false;
  count = std::min(count, a.size() - from);
  return std::memcmp(a.data() + from, b.data() + from, count * sizeof(Element)) != 0;
}

}  // namespace

/// The data block, the definition last taken from it and the start values.
template <std::size_t points>
struct Cam::Memory {
  CamData<points> data;
  CamData<points> taken;
  CamData<points> start;
};

template <class Data>
Cam::Block Cam::block_of(Data& data) noexcept {
  return {&data,           data.Point,        data.ValidPoint,
          data.Segment,    data.ValidSegment, &data.InterpolationSettings,
          &data.StatusCam, &data.StatusWord,  &data.WarningWord};
}

Cam::Cam(ObjectKind object_kind, std::string object_name, DB_ANY object_number)
    : TechnologyObject(object_kind, std::move(object_name), object_number),
      functions_(points_of(object_kind)) {
  const auto use = [this](auto& memory) {
    block_ = block_of(memory.data);
    taken_ = block_of(memory.taken);
    start_ = block_of(memory.start);
  };
  if (kind == ObjectKind::TO_Cam_10k) {
    large_ = std::make_unique<Memory<kCam10kPoints>>();
    use(*large_);
  } else {
    small_ = std::make_unique<Memory<kCamPoints>>();
    use(*small_);
  }
}

Cam::~Cam() = default;

// ---- Load time
// --------------------------------------------------------------------------------------------------------

void Cam::define_point(std::size_t index, const TO_Cam_Struct_PointData& point) noexcept {
  block_.point[index] = point;
  block_.valid_point[index] = true;
}

void Cam::define_segment(std::size_t index, const TO_Cam_Struct_SegmentData& segment) noexcept {
  block_.segment[index] = segment;
  block_.valid_segment[index] = true;
}

ErrorId Cam::interpolate(CamInterpolator& interpolator) noexcept {
  take_definition();
  stage_.store(Stage::wanted, std::memory_order_relaxed);
  work(interpolator);
  take_curve();
  return error_;
}

void Cam::configure(double /*servo_period*/, int /*ratio*/) {
  if (small_) small_->start = small_->data;
  if (large_) large_->start = large_->data;
  if (!interpolated()) take_definition();  // what later changes are compared with
  changed_ = false;
  behind_axes();
}

// ---- Jobs
// --------------------------------------------------------------------------------------------------------------

void Cam::submit(Job& job) noexcept {
  const bool resets = job.kind == JobKind::MC_Reset;
  const bool restarts = resets && job.as<ResetJob>().restart;
  if (resets && !restarts && !restarting()) {
    warn_of_restart(false);
    return TechnologyObject::submit(job);
  }
  const ErrorId error = check(job);
  if (restarts) warn_of_restart(error != ErrorId::none);
  if (error != ErrorId::none) return job.fail(error);
  moved_ = 0;
  if (job.kind == JobKind::MC_CopyCamData) copy_ = *job.as<CamCopyJob>().copy;
  if (job.kind == JobKind::MC_InterpolateCam) take_definition();
  job_ = &job;
  job.phase = JobPhase::active;
  behind_axes();
  if (job.kind == JobKind::MC_InterpolateCam) stage_.store(Stage::wanted, std::memory_order_release);
}

/// Warning 322, until a restart is carried out or MC_Reset acknowledges it.
void Cam::warn_of_restart(bool refused) noexcept {
  set_bit(*block_.warning_word, WarningBit::CommandNotAccepted, refused);
  if (refused)
    alarm_notes.raised(alarm::kRestartNotCarriedOut, 0, {.cause = AlarmCause::in_use});
  else
    alarm_notes.acknowledged();
}

ErrorId Cam::check(const Job& job) const noexcept {
  if (restarting()) return ErrorId::restarting;
  if (job.kind != JobKind::MC_CopyCamData && in_use()) return ErrorId::cam_in_use;
  if (copying()) return ErrorId::cam_being_copied;
  if (in_interpolation()) return ErrorId::cam_in_interpolation;
  return job.kind == JobKind::MC_CopyCamData ? check_copy(*job.as<CamCopyJob>().copy) : ErrorId::none;
}

ErrorId Cam::check_copy(const CamCopy& copy) const noexcept {
  for (const ErrorId error :
       {check_target(block_.point.size(), copy.start_point_cam, copy.number_of_points,
                     ErrorId::start_point_cam, ErrorId::number_of_points),
        check_target(block_.segment.size(), copy.start_segment_cam, copy.number_of_segments,
                     ErrorId::start_segment_cam, ErrorId::number_of_segments),
        check_source(copy.points, kCamPointElement, copy.start_point_array, copy.number_of_points,
                     ErrorId::points_array, ErrorId::start_point_array, ErrorId::number_of_points),
        check_source(copy.segments, kCamSegmentElement, copy.start_segment_array, copy.number_of_segments,
                     ErrorId::segments_array, ErrorId::start_segment_array, ErrorId::number_of_segments)})
    if (error != ErrorId::none) return error;
  return ErrorId::none;
}

/// The points of one tick; the segments, which are few, come with the first of them. What has been copied
/// counts when all is there.
void Cam::copy_part() noexcept {
  const auto points = static_cast<std::size_t>(copy_.number_of_points);
  const auto segments = static_cast<std::size_t>(copy_.number_of_segments);
  const auto first_point = static_cast<std::ptrdiff_t>(copy_.start_point_cam - 1);
  const auto first_segment = static_cast<std::ptrdiff_t>(copy_.start_segment_cam - 1);
  if (moved_ == 0) {
    if (!copy_.keep) {
      std::ranges::fill(block_.valid_point, false);
      std::ranges::fill(block_.valid_segment, false);
    }
    if (segments > 0)
      std::memcpy(&block_.segment[static_cast<std::size_t>(first_segment)],
                  copy_.segments->at(copy_.start_segment_array),
                  segments * sizeof(TO_Cam_Struct_SegmentData));
  }
  const std::size_t now = std::min(kMoved, points - moved_);
  if (now > 0)
    std::memcpy(&block_.point[static_cast<std::size_t>(first_point) + moved_],
                copy_.points->at(copy_.start_point_array + static_cast<std::int64_t>(moved_)),
                now * sizeof(TO_Cam_Struct_PointData));
  moved_ += now;
  if (moved_ < points) return;
  std::fill_n(block_.valid_point.begin() + first_point, points, true);
  std::fill_n(block_.valid_segment.begin() + first_segment, segments, true);
  changed_ = true;
  job_->phase = JobPhase::done;
  job_ = nullptr;
}

/// Takes a part of the start values over; when all are there, has them interpolated.
void Cam::restore_part() noexcept {
  if (moved_ == point_count()) return;  // the curve is being made
  const std::size_t end = std::min(moved_ + kMoved, point_count());
  for (const Block* to : {&block_, &taken_}) {
    move_part<TO_Cam_Struct_PointData>(start_.point, to->point, moved_, end);
    move_part<BOOL>(start_.valid_point, to->valid_point, moved_, end);
    if (end < point_count()) continue;
    move_part<TO_Cam_Struct_SegmentData>(start_.segment, to->segment, 0, kCamSegments);
    move_part<BOOL>(start_.valid_segment, to->valid_segment, 0, kCamSegments);
    *to->settings = *start_.settings;
  }
  moved_ = end;
  if (moved_ < point_count()) return;
  start_values_changed = false;
  compared_ = 0;
  stage_.store(Stage::wanted, std::memory_order_release);
}

// ---- Interpolation at run time
// ----------------------------------------------------------------------------------------

/// The program may go on writing meanwhile.
void Cam::take_definition() noexcept {
  std::ranges::copy(block_.point, taken_.point.begin());
  std::ranges::copy(block_.valid_point, taken_.valid_point.begin());
  std::ranges::copy(block_.segment, taken_.segment.begin());
  std::ranges::copy(block_.valid_segment, taken_.valid_segment.begin());
  *taken_.settings = *block_.settings;
  compared_ = 0;
}

bool Cam::work(CamInterpolator& interpolator) noexcept {
  if (stage_.load(std::memory_order_acquire) != Stage::wanted) return false;
  const CamElements elements = taken_.elements();
  error_ = interpolator.interpolate(elements, functions_.spare());
  if (error_ == ErrorId::none) status_cam_ = status_of(elements, functions_.spare());
  stage_.store(Stage::ready, std::memory_order_release);
  return true;
}

void Cam::before_axes() noexcept {
  in_use_ = used_.load(std::memory_order_relaxed);
  used_.store(false, std::memory_order_relaxed);
  if (copying()) copy_part();
  if (restarting()) restore_part();
  if (job_ != nullptr) {
    if (own_ != nullptr) work(*own_);
    if (stage_.load(std::memory_order_acquire) == Stage::ready) take_curve();
  }
  if (!changed_ && job_ == nullptr) changed_ = definition_differs();
}

/// After an error the last curve stays in effect, and the definition is another. A restart leaves nothing of
/// it; that there are no elements is no error then, as when the project is loaded.
void Cam::take_curve() noexcept {
  stage_.store(Stage::idle, std::memory_order_relaxed);
  const bool restarted = restarting();
  const bool good = error_ == ErrorId::none;
  if (good || restarted) {
    functions_.swap();  // what could not be made is empty
    *block_.status_cam = good ? status_cam_ : TO_Cam_Struct_StatusCam{};
  }
  changed_ = !good && !restarted;
  if (job_ == nullptr) return;
  if (good || (restarted && error_ == ErrorId::cam_empty))
    job_->phase = JobPhase::done;
  else
    job_->fail(error_);
  job_ = nullptr;
}

/// A part of the definition per tick: some thousand elements at once would be felt in the cycle.
bool Cam::definition_differs() noexcept {
  const auto part = [&](auto ours, auto theirs, std::size_t from, std::size_t count) {
    using Element = typename decltype(ours)::value_type;
    return differ<Element>(ours, theirs, from, count);
  };
  const std::size_t from = compared_;
  compared_ = from + kCompared < point_count() ? from + kCompared : 0;
  return part(block_.point, taken_.point, from, kCompared) ||
         part(block_.valid_point, taken_.valid_point, from, kCompared) ||
         (from == 0 && (part(block_.segment, taken_.segment, 0, kCamSegments) ||
                        part(block_.valid_segment, taken_.valid_segment, 0, kCamSegments))) ||
         std::memcmp(block_.settings, taken_.settings, sizeof *taken_.settings) != 0;
}

void Cam::behind_axes() noexcept {
  DWORD& word = *block_.status_word;
  set_bit(word, CamStatusBit::Control, in_use());
  set_bit(word, CamStatusBit::RestartActive, restarting());
  set_bit(word, CamStatusBit::OnlineStartValuesChanged, start_values_changed);
  set_bit(word, CamStatusBit::CamDataChanged, changed_);
  set_bit(word, CamStatusBit::Interpolated, interpolated());
  set_bit(word, CamStatusBit::InInterpolation, in_interpolation());
  set_bit(word, CamStatusBit::CopyCamDataActive, copying());
}

}  // namespace lockstep
