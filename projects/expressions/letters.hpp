/// Letters and digits of names and numbers, whatever the locale.
#pragma once

namespace lockstep {

inline bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
inline bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

}  // namespace lockstep
