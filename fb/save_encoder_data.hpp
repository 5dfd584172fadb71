/// Keeping the adjustments of absolute encoders at once: MC_SaveAbsoluteEncoderData.
#pragma once

#include "fb/execute_block.hpp"
#include "tech_objects/jobs/encoder_saving.hpp"

namespace lockstep {

/// Done when the disk has the adjustments of all absolute encoders, as they stood when the job began or
/// later.
/// @source S7-1500T axis functions, MC_SaveAbsoluteEncoderData
/// @errors 16#80EB disk full; 16#80EC not written; 16#80ED third instance of a project, or a further one;
/// 16#80EE another job runs; 16#80EF nothing is kept: simulation, --no-retain
struct MC_SaveAbsoluteEncoderData final : ExecuteBlock {
  static constexpr std::string_view kName = "MC_SaveAbsoluteEncoderData";
  static constexpr std::string_view kText = "Keeps the adjustments of all absolute encoders on the disk.";
  static constexpr std::string_view kSource = "S7-1500T axis functions, MC_SaveAbsoluteEncoderData";
  static constexpr auto kPins = pins(pin::kExecute, pin::kDone, pin::kBusy, pin::kError, pin::kErrorID);

  void connect(EncoderSaving& saving) noexcept override;

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& /*job*/) const noexcept override {}
  TechnologyObject* target() const noexcept override { return nullptr; }
  bool wired() const noexcept override { return true; }
  void hand_over(Job& job) noexcept override;

 private:
  EncoderSaving* saving_ = nullptr;  // of the controller; nullptr: it has too many instances
};

}  // namespace lockstep
