/// Measuring inputs: MC_MeasuringInput, MC_MeasuringInputCyclic, MC_AbortMeasuringInput.
#pragma once

#include "fb/execute_block.hpp"
#include "tech_objects/sensing/measuring_input.hpp"

namespace lockstep {

namespace pin {

template <class T>
constexpr Pin measuring_input() {
  return object<&T::MeasuringInput>("MeasuringInput", kMeasuringInput, "measuring input");
}
template <class T>
constexpr Pin measuring_range() {
  return in<&T::MeasuringRange>("MeasuringRange", Unit::kNone, kAny,
                                "TRUE: measures only from StartPosition to EndPosition");
}
template <class T>
constexpr Pin range_start() {
  return in<&T::StartPosition>("StartPosition", Unit::kPosition, {-kPositionRange, kPositionRange},
                               "beginning of the measuring range", {.error = ErrorId::measuring_range_start});
}
template <class T>
constexpr Pin range_end() {
  return in<&T::EndPosition>("EndPosition", Unit::kPosition, {-kPositionRange, kPositionRange},
                             "end of the measuring range", {.error = ErrorId::measuring_range_end});
}

}  // namespace pin

/// Measures the position at one edge or at two.
/// @source S7-1500/S7-1500T measuring input and output cam functions, MC_MeasuringInput
/// @errors 16#800A Mode; 16#8016 actual values invalid; 16#80A2 range passed without edge, or unfit for the
/// ring; 16#80A3 a homing looks for its mark, with measuring by telegram; 16#80A5, 16#80A6 range; 16#80A7
/// edge outside the range
struct MC_MeasuringInput final : ExecuteBlock {
  lockstep::MeasuringInput* MeasuringInput{};
  DINT Mode{};
  BOOL MeasuringRange{};
  LREAL StartPosition{};
  LREAL EndPosition{};
  LREAL MeasuredValue1{};
  LREAL MeasuredValue2{};

  static constexpr std::string_view kName = "MC_MeasuringInput";
  static constexpr std::string_view kText = "Measures the position at one or two edges of an input.";
  static constexpr std::string_view kSource =
      "S7-1500/S7-1500T measuring input and output cam functions, MC_MeasuringInput";
  static constexpr Choice kModes[] = {{0, "the next rising edge"},
                                      {1, "the next falling edge"},
                                      {2, "the next two edges"},
                                      {3, "a rising edge, then a falling one"},
                                      {4, "a falling edge, then a rising one"}};
  static constexpr auto kPins =
      pins(pin::measuring_input<MC_MeasuringInput>(), pin::kExecute,
           in<&MC_MeasuringInput::Mode>("Mode", Unit::kNone, kAny, "edges that are measured",
                                        {.error = ErrorId::mode, .choices = kModes}),
           pin::measuring_range<MC_MeasuringInput>(), pin::range_start<MC_MeasuringInput>(),
           pin::range_end<MC_MeasuringInput>(), pin::kDone, pin::kBusy, pin::kCommandAborted, pin::kError,
           pin::kErrorID,
           out<&MC_MeasuringInput::MeasuredValue1>("MeasuredValue1", "position at the first edge",
                                                   Unit::kPosition),
           out<&MC_MeasuringInput::MeasuredValue2>("MeasuredValue2", "position at the second edge",
                                                   Unit::kPosition));

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  TechnologyObject* target() const noexcept override { return MeasuringInput; }
  void show(JobPhase phase) noexcept override;
};

/// Measures up to two positions in each servo cycle until it is ended.
/// @source S7-1500/S7-1500T measuring input and output cam functions, MC_MeasuringInputCyclic
/// @errors as MC_MeasuringInput; an edge outside the range is dropped
struct MC_MeasuringInputCyclic final : ExecuteBlock {
  lockstep::MeasuringInput* MeasuringInput{};
  DINT Mode{};
  BOOL MeasuringRange{};
  LREAL StartPosition{};
  LREAL EndPosition{};
  LREAL MeasuredValue1{};
  LREAL MeasuredValue2{};
  UDINT MeasuredValue1Counter{};
  UDINT MeasuredValue2Counter{};
  UDINT LostEdgeCounter1{};
  UDINT LostEdgeCounter2{};

  static constexpr std::string_view kName = "MC_MeasuringInputCyclic";
  static constexpr std::string_view kText = "Measures the positions at edges of an input until it is ended.";
  static constexpr std::string_view kSource =
      "S7-1500/S7-1500T measuring input and output cam functions, MC_MeasuringInputCyclic";
  static constexpr Choice kModes[] = {{0, "rising edges"}, {1, "falling edges"}, {2, "both"}};
  static constexpr auto kPins = pins(
      pin::measuring_input<MC_MeasuringInputCyclic>(), pin::kExecute,
      in<&MC_MeasuringInputCyclic::Mode>("Mode", Unit::kNone, kAny, "edges that are measured",
                                         {.error = ErrorId::mode, .choices = kModes}),
      pin::measuring_range<MC_MeasuringInputCyclic>(), pin::range_start<MC_MeasuringInputCyclic>(),
      pin::range_end<MC_MeasuringInputCyclic>(), pin::kBusy, pin::kCommandAborted, pin::kError, pin::kErrorID,
      out<&MC_MeasuringInputCyclic::MeasuredValue1>(
          "MeasuredValue1", "position at the first edge of a cycle; Mode 2: at a rising one",
          Unit::kPosition),
      out<&MC_MeasuringInputCyclic::MeasuredValue2>(
          "MeasuredValue2", "position at the second edge of a cycle; Mode 2: at a falling one",
          Unit::kPosition),
      out<&MC_MeasuringInputCyclic::MeasuredValue1Counter>("MeasuredValue1Counter",
                                                           "number of first values of this job"),
      out<&MC_MeasuringInputCyclic::MeasuredValue2Counter>("MeasuredValue2Counter",
                                                           "number of second values of this job"),
      out<&MC_MeasuringInputCyclic::LostEdgeCounter1>("LostEdgeCounter1",
                                                      "edges lost in the cycle of the first value, 0 to 7"),
      out<&MC_MeasuringInputCyclic::LostEdgeCounter2>("LostEdgeCounter2",
                                                      "edges lost in the cycle of the second value, 0 to 7"));

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override;
  TechnologyObject* target() const noexcept override { return MeasuringInput; }
  void show(JobPhase phase) noexcept override;
};

/// Ends what measures at a measuring input; Done also when nothing does.
/// @source S7-1500/S7-1500T measuring input and output cam functions, MC_AbortMeasuringInput
struct MC_AbortMeasuringInput final : ExecuteBlock {
  lockstep::MeasuringInput* MeasuringInput{};

  static constexpr std::string_view kName = "MC_AbortMeasuringInput";
  static constexpr std::string_view kText = "Ends a measuring job.";
  static constexpr std::string_view kSource =
      "S7-1500/S7-1500T measuring input and output cam functions, MC_AbortMeasuringInput";
  static constexpr auto kPins =
      pins(pin::measuring_input<MC_AbortMeasuringInput>(), pin::kExecute, pin::kDone, pin::kBusy,
           pin::kCommandAborted, pin::kError, pin::kErrorID);

 protected:
  std::span<const Pin> pin_table() const noexcept override { return kPins; }
  void request(Job& job) const noexcept override { job.kind = JobKind::MC_AbortMeasuringInput; }
  TechnologyObject* target() const noexcept override { return MeasuringInput; }
};

}  // namespace lockstep
