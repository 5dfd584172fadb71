/// The technology object cam: its definition, the curve interpolated from it, and who uses it.
/// @source S7-1500T synchronous operation V7, 4.2, 8.3, 12.2.1, 13.2
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "tech_objects/cam_data.hpp"
#include "tech_objects/cam_function.hpp"
#include "tech_objects/cam_interpolation.hpp"
#include "tech_objects/job.hpp"
#include "tech_objects/status_bits.hpp"
#include "tech_objects/technology_object.hpp"

namespace lockstep {

/// TO_Cam and TO_Cam_10k.
///
/// An interpolation by MC_InterpolateCam goes through three hands. The cycle takes a copy of the definition
/// (`submit`); another thread, or the cycle itself where there is none, makes the curve (`work`); the cycle
/// brings it into effect at one interpolator tick (`step`). In between nobody waits: the copy and the spare
/// curve belong to whoever `stage_` says.
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
  bool has_elements() const noexcept;
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
  bool in_interpolation() const noexcept { return job_ != nullptr; }

  /// An axis that follows the cam, or waits to do so, says so in every interpolator tick.
  void show_use() noexcept { used_ = true; }
  bool in_use() const noexcept { return used_ || in_use_; }

  /// MC_InterpolateCam: takes the definition as it stands. Fails with 16#80AB if the cam is in use, 16#80E8
  /// if it is being interpolated already. MC_Reset: a cam has no alarms, so nothing is to be done.
  void submit(Job& job) noexcept override;

  // ---- Cycle: called by the scheduler

  /// Begin of an interpolator tick: a curve that is ready comes into effect.
  /// @param own interpolates what is due here and now; nullptr: another thread calls `work`
  void step(CamInterpolator* own) noexcept;
  /// End of an interpolator tick: the data block.
  void publish() noexcept;

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

    CamElements elements() const noexcept { return {point, valid_point, segment, valid_segment, *settings}; }
  };
  template <class Data>
  static Block block_of(Data& data) noexcept;
  template <std::size_t points>
  struct Memory;

  enum class Stage : std::uint8_t { idle, wanted, ready };

  void take_definition() noexcept;
  void take_curve() noexcept;
  bool definition_differs() noexcept;

  // Hot: touched in every interpolator tick.
  bool used_ = false;     // since the begin of the tick
  bool in_use_ = false;   // in the tick before
  bool changed_ = false;  // CamDataChanged
  std::atomic<Stage> stage_{Stage::idle};
  Job* job_ = nullptr;
  Block block_;
  Block taken_;  // the definition of the curve in effect, or of the one that is being made
  Block start_;
  std::size_t compared_ = 0;            // elements that have been compared in this round
  ErrorId error_ = ErrorId::none;       // of the curve that is ready
  TO_Cam_Struct_StatusCam status_cam_;  // of the curve that is ready
  CamFunctionPair functions_;
  std::unique_ptr<Memory<kCamPoints>> small_;
  std::unique_ptr<Memory<kCam10kPoints>> large_;
};

}  // namespace lockstep
