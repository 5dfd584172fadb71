#include "scheduler/text.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace lockstep {

static_assert(std::endian::native == std::endian::little, "the first of two characters is the low byte");

std::string_view Text::view() const noexcept {
  const void* const end = std::memchr(characters, 0, capacity);
  const auto size =
      end == nullptr ? capacity : static_cast<std::size_t>(static_cast<const char*>(end) - characters);
  return {characters, size};
}

void Text::assign(std::string_view text) const noexcept {
  const std::size_t size = std::min(text.size(), capacity);
  std::memmove(characters, text.data(), size);
  std::memset(characters + size, 0, capacity - size);
}

std::string text_type_name(std::size_t capacity) {
  return "STRING[" + std::to_string(capacity) + "]";
}

std::vector<Signal> text_signals(const Text& text) {
  std::vector<Signal> signals;
  for (std::size_t i = 0; i < text.capacity; i += 2)
    signals.push_back({text.characters + i, i + 1 < text.capacity ? Type::WORD : Type::BYTE, -1});
  return signals;
}

std::vector<Value> text_values(std::string_view text, std::size_t capacity) {
  std::array<char, kLongestText> memory;
  const Text copy{memory.data(), capacity};
  copy.assign(text);
  std::vector<Value> values;
  for (const Signal& signal : text_signals(copy)) values.push_back(signal.load());
  return values;
}

std::string text_of(std::span<const Value> values, std::size_t capacity) {
  std::array<char, kLongestText> memory;
  const Text copy{memory.data(), capacity};
  const std::vector<Signal> signals = text_signals(copy);
  for (std::size_t i = 0; i < signals.size(); ++i) signals[i].store(values[i]);
  return std::string(copy.view());
}

}  // namespace lockstep
