/// Guards the decoders that lcm-gen makes: they take counts of elements and lengths of strings as they come,
/// so that a hostile message would have them read or reserve gigabytes.
#pragma once

#include <cstdint>
#include <exception>
#include <limits>
#include <span>

namespace lockstep {

/// Goes over the bytes of a message from its beginning, before they are decoded. Once something does not fit
/// it has failed for good, and gives 0. Any one thread.
class LcmWalk {
 public:
  explicit LcmWalk(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  /// A number of `width` bytes, 1 to 8.
  std::uint64_t number(std::size_t width) noexcept {
    if (bytes_.size() < width) return fail();
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < width; ++i) number = number << 8 | bytes_[i];
    bytes_ = bytes_.subspan(width);
    return number;
  }
  void skip(std::size_t width) noexcept {
    if (bytes_.size() < width)
      fail();
    else
      bytes_ = bytes_.subspan(width);
  }
  /// How many elements there are, which take at least so many bytes each and are still to come.
  std::uint64_t count(std::size_t element) noexcept {
    const std::uint64_t count = number(4);
    const bool fits = count <= std::numeric_limits<std::int32_t>::max() && count * element <= bytes_.size();
    return fits ? count : fail();
  }
  /// A length, which counts the 0 at the end, and the characters.
  void string() noexcept {
    const std::uint64_t length = number(4);
    if (length == 0 || length > bytes_.size() || bytes_[length - 1] != 0) {
      fail();
      return;
    }
    bytes_ = bytes_.subspan(length);
  }

  bool good() const noexcept { return good_; }
  bool at_end() const noexcept { return good_ && bytes_.empty(); }

 private:
  std::uint64_t fail() noexcept {
    good_ = false;
    bytes_ = {};
    return 0;
  }

  std::span<const std::uint8_t> bytes_;
  bool good_ = true;
};

/// Decodes bytes that have been gone over. @return whether they are a message of this type, and nothing else
template <class Message>
bool decode(Message& message, std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() > std::numeric_limits<std::int32_t>::max()) return false;
  const auto size = static_cast<int>(bytes.size());
  try {
    return message.decode(bytes.data(), 0, size) == size;
  } catch (const std::exception&) {  // such as no memory
    return false;
  }
}

}  // namespace lockstep
