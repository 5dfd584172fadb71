/// A BOOL tag of the project at which a technology object looks.
#pragma once

namespace lockstep {

/// Whether it is TRUE; nullptr: the project names none, which counts as FALSE. Thread: the cycle.
inline bool is_on(const bool* tag) noexcept {
  return tag != nullptr && *tag;
}

}  // namespace lockstep
