/// What an axis shows of its encoders, MC_SetSensor, and the adjustment of absolute encoders.
/// @source S7-1500T axis functions, encoders of an axis, MC_SetSensor
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "tech_objects/axis/axis_requests.hpp"
#include "tech_objects/axis/axis_state.hpp"
#include "tech_objects/axis/backlash.hpp"
#include "tech_objects/axis/encoders.hpp"
#include "tech_objects/axis/hand_over.hpp"
#include "tech_objects/axis/position_loop.hpp"

namespace lockstep {

/// The encoders, what is known of them, and what goes by their values.
struct SensorParts {
  AxisData& data;
  std::array<EncoderAdjustment, Encoders::kCount>& encoder_adjustments;
  Encoders& encoders_;
  const Backlash& backlash_;
  const bool& has_drive_;
  const std::unique_ptr<Drive>& drive_;
  const Modulo& modulo_;
  AxisPosition& actual_;
  double& actual_velocity_;
  const std::int64_t& counted_from_;
  const AxisMotion& motion_;
  const bool& homing_now_;
  PositionLoop& loop_;
  HandOverOrders& hand_over_;
};

/// Thread: the cycle.
class SensorOrders : private SensorParts {
 public:
  explicit SensorOrders(const SensorParts& parts) noexcept : SensorParts(parts) {}

  /// Of an axis with encoders beside that of the drive: reads and shows them all.
  void read(DriveActual& now) noexcept;

  /// What there is of the encoders, as long as nothing is wrong with them.
  void show() noexcept;
  void show_place(std::size_t encoder, AxisPosition place) noexcept;
  /// As they are called now.
  void show_places() noexcept;

  /// The encoder that a job is about; 0: the operative one.
  std::size_t sensor_of(const Job& job) const noexcept;
  /// The encoder is adjusted to the positions as they are now.
  /// @param store whether an offset of an absolute encoder that is kept already is replaced
  void adjust(std::size_t encoder, bool store) noexcept;
  /// Where an absolute encoder shows 0, by the adjustment that has been kept.
  AxisPosition adjusted_origin(std::size_t encoder) noexcept;

  /// MC_SetSensor, at once.
  ErrorId set(const SensorJob& job) noexcept;

  /// What the motor has passed of the backlash, and the load has not followed [u].
  double play() const noexcept { return backlash_.passed(data.Sensor[0].Backlash); }
  /// The play lies between the motor, with its encoder, and the load: another encoder sees it by itself.
  bool passes_backlash() const noexcept {
    return data.Sensor[0].Backlash.Enable && encoders_.operative() == 0;
  }

 private:
  void place_encoder(std::size_t encoder, AxisPosition place) noexcept;
  void switch_encoder(std::size_t encoder, bool aligned) noexcept;
  void deviate(AxisPosition place) noexcept;
};

}  // namespace lockstep
