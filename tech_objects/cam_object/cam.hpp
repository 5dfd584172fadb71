/// The technology object cam: its definition, the curve interpolated from it, and who uses it.
/// @source S7-1500T synchronous operation V7, 4.2, 8.3, 12.2.1, 13.2
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "tech_objects/cam/function.hpp"
#include "tech_objects/cam_object/interpolation.hpp"
#include "tech_objects/data_blocks/array.hpp"
#include "tech_objects/data_blocks/cam_data.hpp"
#include "tech_objects/data_blocks/status_bits.hpp"
#include "tech_objects/jobs/job.hpp"
#include "tech_objects/objects/technology_object.hpp"

namespace lockstep {

/// What MC_CopyCamData copies from where to where. Indices of the cam count from 1, those of an array as it
/// is declared.
struct CamCopy {
  const Array* points = nullptr;    ///< ARRAY OF TO_Cam_Struct_PointData; nullptr: none
  const Array* segments = nullptr;  ///< ARRAY OF TO_Cam_Struct_SegmentData; nullptr: none
  DINT start_point_cam = 1;
  DINT start_segment_cam = 1;
  DINT start_point_array = 1;
  DINT start_segment_array = 1;
  DINT number_of_points = 0;
  DINT number_of_segments = 0;
  bool keep = false;  ///< Mode 1: elements that are valid stay valid
};

/// TO_Cam and TO_Cam_10k.
///
/// An interpolation by MC_InterpolateCam goes through three hands. The cycle takes a copy of the definition
/// (`submit`); another thread, or the cycle itself where there is none, makes the curve (`work`); the cycle
/// brings it into effect at one interpolator tick (`step`). In between nobody waits: the copy and the spare
/// curve belong to whoever `stage_` says.
///
/// Copying by MC_CopyCamData and a restart by MC_Reset move a part of the elements per interpolator tick. One
/// of the three runs at a time.
class Cam final : public TechnologyObject {
 public:
  Cam(ObjectKind kind, std::string name, DB_ANY number);
  ~Cam() override;

  // ---- Load time

  /// Points of the data block: 1000 or 10000.
  std::size_t point_count() const noexcept { return block_.point.size(); }
  /// Defines the element with an index from 0 and makes it valid.
  void define_point(std::size_t index, const TO_Cam_Struct_PointData& point) noexcept;
  void define_segment(std::size_t index, const TO_Cam_Struct_SegmentData& segment) noexcept;
  CamElements elements() const noexcept { return block_.elements(); }
  const TO_Cam_Struct_InterpolationSettings& interpolation() const noexcept { return *block_.settings; }
  void set_interpolation(const TO_Cam_Struct_InterpolationSettings& settings) noexcept {
    *block_.settings = settings;
  }
  /// Interpolates the definition at once.
  ErrorId interpolate(CamInterpolator& interpolator) noexcept;

  void* data_block() noexcept override { return block_.address; }
  void* start_values() noexcept override { return start_.address; }
  void configure(double servo_period, int ratio) override;

  // ---- Cycle: called by blocks and axes

  /// The curve in effect. It does not change while the cam is in use.
  const CamFunction& function() const noexcept { return functions_.active(); }
  bool interpolated() const noexcept { return functions_.active().interpolated(); }
  bool in_interpolation() const noexcept { return runs(JobKind::MC_InterpolateCam); }
  bool copying() const noexcept { return runs(JobKind::MC_CopyCamData); }
  bool restarting() const noexcept { return runs(JobKind::MC_Reset); }

  /// An axis that follows the cam, or waits to do so, says so in every interpolator tick; axes on several
  /// processors may do so at once.
  void show_use() noexcept {
    if (!used_.load(std::memory_order_relaxed)) used_.store(true, std::memory_order_relaxed);
  }
  bool in_use() const noexcept { return used_.load(std::memory_order_relaxed) || in_use_; }

  /// MC_InterpolateCam: takes the definition as it stands. MC_CopyCamData: copies what its job says.
  /// MC_Reset with Restart: takes over the start values and interpolates them, as when the project is loaded;
  /// without it there is nothing to be done, since a cam has no alarms.
  ///
  /// Fails with 16#80AB if the cam is in use (but for copying), 16#80E7 if it is being copied into, 16#80E8
  /// if it is being interpolated, 16#800D if it is restarting, and with the errors of what is to be copied.
  void submit(Job& job) noexcept override;

  // ---- Cycle: called by the scheduler

  /// Who makes the curves: this one, in the cycle, or another thread that calls `work` (nullptr).
  void interpolate_by(CamInterpolator* own) noexcept { own_ = own; }
  bool takes_part(Phase phase) const noexcept override { return phase != Phase::servo; }
  /// A curve that is ready comes into effect.
  void before_axes() noexcept override;
  /// The data block.
  void behind_axes() noexcept override;

  // ---- Another thread

  /// Makes the curve if one is wanted; false if not. One thread at a time.
  bool work(CamInterpolator& interpolator) noexcept;

 private:
  /// A data block of either size.
  struct Block {
    void* address = nullptr;
    std::span<TO_Cam_Struct_PointData> point;
    std::span<BOOL> valid_point;
    std::span<TO_Cam_Struct_SegmentData> segment;
    std::span<BOOL> valid_segment;
    TO_Cam_Struct_InterpolationSettings* settings = nullptr;
    TO_Cam_Struct_StatusCam* status_cam = nullptr;
    DWORD* status_word = nullptr;
    DWORD* warning_word = nullptr;

    CamElements elements() const noexcept { return {point, valid_point, segment, valid_segment, *settings}; }
  };
  template <class Data>
  static Block block_of(Data& data) noexcept;
  template <std::size_t points>
  struct Memory;

  enum class Stage : std::uint8_t { idle, wanted, ready };

  bool runs(JobKind job) const noexcept { return job_ != nullptr && job_->kind == job; }
  void warn_of_restart(bool refused) noexcept;
  ErrorId check(const Job& job) const noexcept;
  ErrorId check_copy(const CamCopy& copy) const noexcept;
  void copy_part() noexcept;
  void restore_part() noexcept;
  void take_definition() noexcept;
  void take_curve() noexcept;
  bool definition_differs() noexcept;

  // Hot: touched in every interpolator tick.
  std::atomic<bool> used_{false};  // since the begin of the tick
  bool in_use_ = false;            // in the tick before
  bool changed_ = false;           // CamDataChanged
  std::atomic<Stage> stage_{Stage::idle};
  CamInterpolator* own_ = nullptr;
  Job* job_ = nullptr;
  Block block_;
  Block taken_;  // the definition of the curve in effect, or of the one that is being made
  Block start_;
  std::size_t compared_ = 0;            // elements that have been compared in this round
  CamCopy copy_;                        // that is being carried out
  std::size_t moved_ = 0;               // points that it, or the restart, has moved so far
  ErrorId error_ = ErrorId::none;       // of the curve that is ready
  TO_Cam_Struct_StatusCam status_cam_;  // of the curve that is ready
  CamFunctionPair functions_;
  std::unique_ptr<Memory<kCamPoints>> small_;
  std::unique_ptr<Memory<kCam10kPoints>> large_;
};

}  // namespace lockstep
