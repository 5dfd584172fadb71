/// Messages that go elsewhere than to standard error.
#pragma once

namespace lockstep::cli {

/// From here on messages go to a descriptor that never makes a writer wait, such as that of a file in memory.
/// One thread at a time.
void write_messages_to(int descriptor) noexcept;

}  // namespace lockstep::cli
