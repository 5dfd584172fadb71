#include "tech_objects/mco305_catalogue/parameters.hpp"

namespace lockstep::mco305 {
namespace {

/// Divisors: 0 or less would leave nothing to compute with.
constexpr std::int32_t kDivisors[] = {kEncoder,  kPosFactN, kPosFactZ, kTimer,
                                      kProfTime, kVelMax,   kRampMin,  kVelRes};

}  // namespace

ParameterValues::ParameterValues() noexcept {
  const auto all = parameters();
  for (std::size_t i = 0; i < all.size(); ++i) values_[i] = all[i].start;
}

int ParameterValues::set(std::int32_t number, std::int32_t value) noexcept {
  constexpr int kUnknown = 112;
  const std::size_t index = parameter_index(number);
  if (index == kNoParameter || is_read_out(number)) return kUnknown;
  for (const std::int32_t divisor : kDivisors)
    if (number == divisor && value <= 0) return kUnknown;
  if (number == 3310 && value == 0) return kUnknown;
  values_[index] = value;
  ++version_;
  return 0;
}

int ParameterValues::change(std::int32_t number, std::int32_t value) noexcept {
  const int error = set(number, value);
  if (error == 0) ++changes_[parameter_index(number)];
  return error;
}

std::uint32_t ParameterValues::changes(std::int32_t number) const noexcept {
  const std::size_t index = parameter_index(number);
  return index == kNoParameter ? 0 : changes_[index];
}

}  // namespace lockstep::mco305
