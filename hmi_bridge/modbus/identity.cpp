#include "hmi_bridge/modbus/identity.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace lockstep {
namespace {

constexpr std::uint8_t kFunction = 43;
constexpr std::uint8_t kInterface = 14;
constexpr std::uint8_t kConformity = 0x82;  ///< regular identification, as a stream and object by object
constexpr std::size_t kLongestObject = 128;
constexpr std::size_t kLongestPdu = 253;
constexpr std::uint8_t kLastBasic = 2;
constexpr std::uint8_t kBasic = 1, kExtended = 3, kIndividual = 4;
constexpr std::size_t kHead = 7;  ///< bytes of the answer before its objects

using Object = std::pair<std::uint8_t, std::string_view>;

std::vector<Object> objects_of(const ModbusIdentity& identity, std::uint8_t access) {
  std::vector<Object> objects;
  for (const Object& object :
       {Object{0, identity.vendor}, Object{1, identity.product_code}, Object{2, identity.revision},
        Object{4, identity.product_name}, Object{6, identity.application}}) {
    const bool is_wanted = access != kBasic || object.first <= kLastBasic;
    if (is_wanted && !object.second.empty())
      objects.emplace_back(object.first, object.second.substr(0, kLongestObject));
  }
  return objects;
}

}  // namespace

ModbusIdentification identify(const ModbusIdentity& identity, std::span<const std::uint8_t> pdu,
                              std::span<std::uint8_t> answer) {
  if (pdu.size() < 2) return {3, 0};
  if (pdu[1] != kInterface) return {1, 0};
  if (pdu.size() != 4) return {3, 0};
  const std::uint8_t access = pdu[2];
  if (access < kBasic || access > kIndividual) return {3, 0};
  const std::vector<Object> objects = objects_of(identity, access);
  auto first =
      std::find_if(objects.begin(), objects.end(), [&](const Object& o) { return o.first == pdu[3]; });
  if (first == objects.end() && access == kIndividual) return {2, 0};
  if (first == objects.end()) first = objects.begin();  // a stream begins anew, as the standard has it
  std::size_t size = kHead;
  std::uint8_t count = 0;
  auto next = first;
  for (; next != objects.end() && (access <= kExtended || count == 0); ++next) {
    const std::string_view text = next->second;
    if (size + 2 + text.size() > kLongestPdu) break;
    answer[size] = next->first;
    answer[size + 1] = static_cast<std::uint8_t>(text.size());
    std::copy(text.begin(), text.end(), answer.begin() + static_cast<std::ptrdiff_t>(size + 2));
    size += 2 + text.size();
    ++count;
  }
  const bool more = access <= kExtended && next != objects.end();
  const std::uint8_t head[kHead] = {kFunction,
                                    kInterface,
                                    access,
                                    kConformity,
                                    static_cast<std::uint8_t>(more ? 0xFF : 0),
                                    more ? next->first : std::uint8_t{0},
                                    count};
  std::copy(std::begin(head), std::end(head), answer.begin());
  return {0, size};
}

}  // namespace lockstep
