/// The words of bits that an axis shows in its data block, and what goes with them.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "tech_objects/arithmetic/setpoint.hpp"
#include "tech_objects/axis/job_slots.hpp"
#include "tech_objects/data_blocks/data_block.hpp"
#include "tech_objects/data_blocks/status_bits.hpp"

namespace lockstep::status_words {

/// A word of these bits.
template <class... Bit>
constexpr std::uint32_t word_of(Bit... bits) noexcept {
  return (std::uint32_t{0} | ... | (std::uint32_t{1} << static_cast<unsigned>(bits)));
}

/// A word of one bit, without a branch.
template <class Bit>
constexpr std::uint32_t when(bool value, Bit bit) noexcept {
  return static_cast<std::uint32_t>(value) << static_cast<unsigned>(bit);
}

/// Of `word`, the shown bits anew; the others keep what they are.
constexpr DWORD renewed(DWORD word, std::uint32_t shown, std::uint32_t bits) noexcept {
  return static_cast<DWORD>((static_cast<std::uint32_t>(word) & ~shown) | bits);
}

/// What the base motion's job shows in the StatusWord.
constexpr std::uint32_t command_bits(JobKind kind) noexcept {
  switch (kind) {
    case JobKind::MC_MoveAbsolute:
    case JobKind::MC_MoveRelative:
      return word_of(StatusBit::PositioningCommand);
    case JobKind::MC_MoveJog:
      return word_of(StatusBit::JogCommand);
    case JobKind::MC_MoveVelocity:
      return word_of(StatusBit::VelocityCommand);
    default:
      return 0;
  }
}

/// What a job of the axis' own motion shows in both words.
struct CommandBits {
  std::uint32_t word = 0;
  std::uint32_t word2 = 0;
};

/// By the kind of the job, looked up rather than told apart in every cycle.
inline constexpr auto kCommandBits = [] {
  constexpr auto kKinds = static_cast<std::size_t>(JobKind::MC_WriteParameter) + 1;
  std::array<CommandBits, kKinds> bits{};
  for (std::size_t i = 0; i < kKinds; ++i) {
    const auto kind = static_cast<JobKind>(i);
    bits[i] = {command_bits(kind), when(leaves(kind), Status2Bit::DesynchronizingCommand)};
  }
  return bits;
}();

/// Bits that `show_status` shows; others are of the functions that they belong to.
inline constexpr std::uint32_t kStatusBits =
    word_of(StatusBit::Enable, StatusBit::Error, StatusBit::HomingDone, StatusBit::OnlineStartValuesChanged,
            StatusBit::ControlPanelActive, StatusBit::Done, StatusBit::Standstill,
            StatusBit::PositioningCommand, StatusBit::JogCommand, StatusBit::VelocityCommand,
            StatusBit::HomingCommand, StatusBit::ConstantVelocity, StatusBit::Accelerating,
            StatusBit::Decelerating, StatusBit::SWLimitMinActive, StatusBit::SWLimitMaxActive,
            StatusBit::HWLimitMinActive, StatusBit::HWLimitMaxActive, StatusBit::Synchronizing,
            StatusBit::Synchronous, StatusBit::PhasingCommand, StatusBit::NonPositionControlled);
inline constexpr std::uint32_t kStatus2Bits =
    word_of(Status2Bit::StopCommand, Status2Bit::DesynchronizingCommand, Status2Bit::PhasingCommandWaiting,
            Status2Bit::OffsetCommand, Status2Bit::OffsetCommandWaiting);
inline constexpr std::uint32_t kSynchronizedMotionBits =
    word_of(SynchronizedMotionBit::MaxVelocityExceeded, SynchronizedMotionBit::MaxAccelerationExceeded,
            SynchronizedMotionBit::MaxDecelerationExceeded, SynchronizedMotionBit::InSimulation,
            SynchronizedMotionBit::LeadingValueAdditiveCommand);

/// The bits of the StatusWord that a speed axis has.
inline constexpr std::uint32_t kOfSpeedAxis = 0x0E00765F;

/// Whether the acceleration of a setpoint, which is finite and not 0, makes it quicker or slower. By their
/// signs: a product of both may be none.
inline std::uint32_t pace_bits(const Setpoint& setpoint) noexcept {
  static_assert(word_of(StatusBit::Decelerating) == word_of(StatusBit::Accelerating) << 1);
  const bool against = std::signbit(setpoint.velocity) != std::signbit(setpoint.acceleration);
  const bool slower = against & (std::abs(setpoint.velocity) > 0.0);
  return word_of(StatusBit::Accelerating) << static_cast<unsigned>(slower);
}

/// What the shifts show.
inline std::uint32_t shift_bits(const JobSlots& jobs, std::uint32_t& word) noexcept {
  std::uint32_t word2 = 0;
  if (const Job* const phasing = jobs[kPhasing]) {
    word |= when(phasing->phase == JobPhase::active, StatusBit::PhasingCommand);
    word2 |= when(phasing->phase == JobPhase::waiting, Status2Bit::PhasingCommandWaiting);
  }
  if (const Job* const offset = jobs[kOffset])
    word2 |= when(offset->phase == JobPhase::active, Status2Bit::OffsetCommand) |
             when(offset->phase == JobPhase::waiting, Status2Bit::OffsetCommandWaiting);
  return word2;
}

inline void show(TO_Struct_EffectiveLeadingValue& shown, const Setpoint& effective) noexcept {
  shown.Position = effective.position.value;
  shown.Velocity = effective.velocity;
  shown.Acceleration = effective.acceleration;
}

}  // namespace lockstep::status_words
