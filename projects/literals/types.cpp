#include "projects/literals/types.hpp"

#include <algorithm>
#include <array>

namespace lockstep {
namespace {

/// The types that take part, smaller before larger, integers before reals: the first common one is the
/// smallest.
constexpr std::array kBySize = {Type::SINT,  Type::USINT, Type::INT,   Type::UINT, Type::DINT,
                                Type::UDINT, Type::LINT,  Type::ULINT, Type::REAL, Type::LREAL,
                                Type::BYTE,  Type::WORD,  Type::DWORD, Type::LWORD};

struct Step {
  Type from;
  Type to;
};

/// Every direct widening, ordered so that one pass over it follows a chain to its end.
constexpr std::array kSteps = {
    Step{Type::USINT, Type::INT},   Step{Type::USINT, Type::UINT}, Step{Type::SINT, Type::INT},
    Step{Type::INT, Type::REAL},    Step{Type::UINT, Type::REAL},  Step{Type::INT, Type::DINT},
    Step{Type::UINT, Type::DINT},   Step{Type::UINT, Type::UDINT}, Step{Type::DINT, Type::LREAL},
    Step{Type::UDINT, Type::LREAL}, Step{Type::DINT, Type::LINT},  Step{Type::UDINT, Type::LINT},
    Step{Type::UDINT, Type::ULINT}, Step{Type::REAL, Type::LREAL}, Step{Type::BYTE, Type::WORD},
    Step{Type::WORD, Type::DWORD},  Step{Type::DWORD, Type::LWORD}};

constexpr std::uint32_t flag(Type type) {
  return std::uint32_t{1} << static_cast<unsigned>(type);
}

}  // namespace

bool widens(Type from, Type to) noexcept {
  std::uint32_t reached = flag(from);
  for (const Step& step : kSteps)
    if ((reached & flag(step.from)) != 0) reached |= flag(step.to);
  return (reached & flag(to)) != 0;
}

std::optional<Type> common_type(Type a, Type b) noexcept {
  if (a == b) return a;
  const auto found =
      std::ranges::find_if(kBySize, [&](Type type) { return widens(a, type) && widens(b, type); });
  return found == kBySize.end() ? std::nullopt : std::optional(*found);
}

bool in_range(WideInteger value, Type type) noexcept {
  return value >= WideInteger{lowest(type)} && value <= WideInteger{highest(type)};
}

std::optional<Type> smallest_type(Type type, WideInteger low, WideInteger high) noexcept {
  const auto found = std::ranges::find_if(kBySize, [&](Type candidate) {
    return !is_real(candidate) && widens(type, candidate) && in_range(low, candidate) &&
           in_range(high, candidate);
  });
  return found == kBySize.end() ? std::nullopt : std::optional(*found);
}

std::optional<Type> type_named(std::string_view name) {
  return tag_type(upper_case(name));
}

std::string upper_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return result;
}

std::string decimal(WideInteger value) {
  const bool negative = value < 0;
  std::string digits;
  do {
    const int digit = static_cast<int>(value % 10);
    digits.insert(digits.begin(), static_cast<char>('0' + (digit < 0 ? -digit : digit)));
    value /= 10;
  } while (value != 0);
  return negative ? "-" + digits : digits;
}

std::string quoted(std::string_view text) {
  constexpr std::size_t kMaximum = 40;
  std::string result = "'";
  for (const char c : text.substr(0, kMaximum)) result += c >= ' ' && c <= '~' ? c : '?';
  if (text.size() > kMaximum) result += "…";
  return result + "'";
}

}  // namespace lockstep
