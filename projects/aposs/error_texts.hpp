/// The published errors that a program raises itself.
#pragma once

#include <string_view>

namespace lockstep::aposs {

/// What an error means; empty for one that no program raises.
std::string_view error_text(int error) noexcept;

}  // namespace lockstep::aposs
