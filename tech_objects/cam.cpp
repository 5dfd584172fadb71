#include "tech_objects/cam.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace lockstep {
namespace {

/// Elements that are looked at for changes in one interpolator tick.
constexpr std::size_t kCompared = 250;

std::size_t points_of(ObjectKind kind) noexcept {
  return kind == ObjectKind::TO_Cam_10k ? kCam10kPoints : kCamPoints;
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
          &data.StatusCam, &data.StatusWord};
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

bool Cam::has_elements() const noexcept {
  return std::ranges::count(block_.valid_point, true) + std::ranges::count(block_.valid_segment, true) > 0;
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
  publish();
}

// ---- Interpolation at run time
// ----------------------------------------------------------------------------------------

void Cam::submit(Job& job) noexcept {
  if (job.kind == JobKind::MC_Reset) return TechnologyObject::submit(job);
  if (in_use()) return job.fail(ErrorId::cam_in_use);
  if (job_ != nullptr) return job.fail(ErrorId::cam_in_interpolation);
  take_definition();
  job_ = &job;
  job.phase = JobPhase::active;
  publish();
  stage_.store(Stage::wanted, std::memory_order_release);
}

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

void Cam::step(CamInterpolator* own) noexcept {
  in_use_ = used_;
  used_ = false;
  if (job_ != nullptr) {
    if (own != nullptr) work(*own);
    if (stage_.load(std::memory_order_acquire) == Stage::ready) take_curve();
  }
  if (!changed_ && job_ == nullptr) changed_ = definition_differs();
}

/// After an error the last curve stays in effect, and the definition is another.
void Cam::take_curve() noexcept {
  stage_.store(Stage::idle, std::memory_order_relaxed);
  if (error_ == ErrorId::none) {
    functions_.swap();
    *block_.status_cam = status_cam_;
  }
  changed_ = error_ != ErrorId::none;
  if (job_ == nullptr) return;
  if (error_ == ErrorId::none)
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

void Cam::publish() noexcept {
  DWORD& word = *block_.status_word;
  set_bit(word, CamStatusBit::Control, in_use());
  set_bit(word, CamStatusBit::OnlineStartValuesChanged, start_values_changed);
  set_bit(word, CamStatusBit::CamDataChanged, changed_);
  set_bit(word, CamStatusBit::Interpolated, interpolated());
  set_bit(word, CamStatusBit::InInterpolation, in_interpolation());
}

}  // namespace lockstep
