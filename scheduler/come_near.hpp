/// Asks for memory that another processor has written or read last, so that it is there when it is needed.
#pragma once

namespace lockstep {

/// Fetches the cache line of an address, for writing, while the processor goes on. The compiler's own
/// function would fetch it for reading where it knows of no newer processor, and the write would wait again.
/// Does nothing on other processors.
inline void come_near_for_writing([[maybe_unused]] const void* address) noexcept {
#ifdef __x86_64__
  asm volatile("prefetchw %0" : : "m"(*static_cast<const char*>(address)));
#endif
}

/// … for reading.
inline void come_near_for_reading(const void* address) noexcept {
  __builtin_prefetch(address);
}

}  // namespace lockstep
