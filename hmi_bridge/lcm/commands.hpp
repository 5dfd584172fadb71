/// Messages of panels and events as bytes and back. Any bytes may come from a network: nothing that a sender
/// puts into them can do more than be refused.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "lockstep/command_t.hpp"
#include "lockstep/event_detail_t.hpp"
#include "lockstep/event_t.hpp"
#include "lockstep/panel_t.hpp"

namespace lockstep {

/// What is appended to the channel of a trace to name the channel of commands to its run.
inline constexpr std::string_view kCommandSuffix = "_CMD";
/// What is appended to name the channel on which a run tells how the axes stand that take commands.
inline constexpr std::string_view kPanelSuffix = "_PANEL";

/// Such as "jog forward"; empty for a number that is no action.
std::string_view action_text(std::int32_t action) noexcept;

/// The message, if the bytes are one of this type, whole and without anything behind it. Any thread.
std::optional<command_t> decode_command(std::span<const std::uint8_t> bytes);
std::optional<panel_t> decode_panel(std::span<const std::uint8_t> bytes);
std::optional<event_t> decode_event(std::span<const std::uint8_t> bytes);
std::optional<event_detail_t> decode_detail(std::span<const std::uint8_t> bytes);

std::vector<std::uint8_t> encoded(const command_t& message);
std::vector<std::uint8_t> encoded(const panel_t& message);
std::vector<std::uint8_t> encoded(const event_t& message);

}  // namespace lockstep
