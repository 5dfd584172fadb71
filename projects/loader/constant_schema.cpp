#include "projects/loader/constant_schema.hpp"

#include <nlohmann/json.hpp>

namespace lockstep {

nlohmann::ordered_json constant_schema(Type type) {
  if (type == Type::BOOL) return {{"type", {"boolean", "string"}}};
  if (is_real(type)) return {{"type", {"number", "string"}}};
  if (!is_integer(type) && !is_bit_string(type)) return {{"type", "string"}};
  nlohmann::ordered_json schema = {{"type", {"integer", "string"}}};
  // Beyond that editors, which have numbers of 53 bits, would compare others than those that are written.
  constexpr std::uint64_t kExact = std::uint64_t{1} << 53;
  if (highest(type) < kExact) schema["maximum"] = highest(type);
  if (highest(type) < kExact || lowest(type) == 0) schema["minimum"] = lowest(type);
  return schema;
}

}  // namespace lockstep
