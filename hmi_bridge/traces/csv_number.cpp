#include "hmi_bridge/traces/csv_number.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace lockstep {
namespace {

template <class T>
char* print(char* out, T number) noexcept {
  return std::to_chars(out, out + kNumberLength, number).ptr;
}

}  // namespace

char* print_seconds(char* out, std::int64_t nanoseconds) noexcept {
  constexpr std::uint64_t kSecond = 1'000'000'000;
  auto amount = static_cast<std::uint64_t>(nanoseconds);
  if (nanoseconds < 0) {
    *out++ = '-';
    amount = 0 - amount;  // right for the most negative number too
  }
  out = print(out, amount / kSecond);
  std::uint64_t fraction = amount % kSecond;
  if (fraction == 0) return out;
  *out = '.';
  char* end = out + 9;
  while (fraction % 10 == 0) {
    fraction /= 10;
    --end;
  }
  for (char* digit = end; digit > out; --digit) {
    *digit = static_cast<char>('0' + fraction % 10);
    fraction /= 10;
  }
  return end + 1;
}

char* print_value(char* out, Value value, Type type) noexcept {
  if (is_real(type)) {
    if (!std::isnan(value.r)) return print(out, value.r);
    constexpr std::string_view kNan = "nan";  // the sign of a NaN means nothing and depends on the processor
    return std::copy(kNan.begin(), kNan.end(), out);
  }
  if (type == Type::TIME) return print_seconds(out, value.i);
  return is_signed_integer(type) ? print(out, value.i) : print(out, value.u);
}

char* print_column_value(char* out, Value value, Type type) noexcept {
  char* const begin = out;
  out = print_value(out, value, type);
  if (is_real(type) && std::string_view(begin, out).find_first_of(".ein") == std::string_view::npos)
    out = std::copy_n(".0", 2, out);
  return out;
}

}  // namespace lockstep
