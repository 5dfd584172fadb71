/// Moves memory that two processors share before it is needed: asks for what the other one has written or
/// read last, and leaves to it what it is going to ask for.
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

/// Has the processor bring a line of memory near, for reading.
inline void come_near_for_reading(const void* address) noexcept {
  __builtin_prefetch(address);
}

/// Moves the cache line of an address, which has been written, to where all processors find it sooner. Does
/// nothing on processors that do not know it.
inline void send_away([[maybe_unused]] const void* address) noexcept {
#ifdef __x86_64__
  asm volatile(".byte 0x0f, 0x1c, 0x00"
               :
               : "a"(address)
               : "memory");  // CLDEMOTE (%rax), unknown to old assemblers
#endif
}

}  // namespace lockstep
