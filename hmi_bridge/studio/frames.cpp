#include "hmi_bridge/studio/frames.hpp"

#include <bit>
#include <cstring>
#include <type_traits>
#include <utility>

namespace lockstep {
namespace {

static_assert(std::endian::native == std::endian::little, "frames are written as they stand in memory");

constexpr std::uint8_t kVersion = 1;
constexpr std::uint8_t kReal = 0, kSigned = 1, kUnsigned = 2, kBool = 3;

std::uint8_t wire_type_of(Type type) noexcept {
  if (is_real(type)) return kReal;
  if (type == Type::BOOL) return kBool;
  return lowest(type) < 0 ? kSigned : kUnsigned;
}

class Bytes {
 public:
  template <class Number>
  void add(Number number) {
    static_assert(std::is_trivially_copyable_v<Number>);
    const std::size_t end = bytes_.size();
    bytes_.resize(end + sizeof(number));
    std::memcpy(bytes_.data() + end, &number, sizeof(number));
  }
  void add_values(const std::vector<Value>& values, std::uint8_t wire_type) {
    for (const Value value : values) {
      if (wire_type == kBool)
        add(static_cast<std::uint8_t>(value.u & 1u));
      else
        add(value.u);
    }
    pad();
  }
  void pad() { bytes_.resize((bytes_.size() + 7) / 8 * 8); }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

std::vector<std::uint8_t> encode_frame(const StudioFrameHead& head, const TraceWindow& window) {
  Bytes bytes;
  bytes.add(static_cast<std::uint8_t>(head.kind));
  bytes.add(kVersion);
  bytes.add(static_cast<std::uint16_t>(window.columns.size()));
  bytes.add(head.subscription);
  bytes.add(static_cast<std::uint32_t>(window.t.size()));
  bytes.add(head.frame);
  bytes.add(head.dropped);
  for (const std::int64_t t : window.t) bytes.add(t);
  for (const std::uint64_t tick : window.tick) bytes.add(tick);
  for (const TraceWindow::Column& column : window.columns) {
    const std::uint8_t wire_type = wire_type_of(column.type);
    bytes.add(wire_type);
    bytes.add(static_cast<std::uint8_t>(window.is_coarse ? 4 : 1));  // arrays
    bytes.pad();
    bytes.add_values(column.first, wire_type);
    if (!window.is_coarse) continue;
    bytes.add_values(column.minimum, wire_type);
    bytes.add_values(column.maximum, wire_type);
    bytes.add_values(column.last, wire_type);
  }
  return bytes.take();
}

}  // namespace lockstep
