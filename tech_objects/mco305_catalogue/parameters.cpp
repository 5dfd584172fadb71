#include "tech_objects/mco305_catalogue/parameters.hpp"

namespace lockstep::mco305 {
namespace {

/// Divisors: 0 or less would leave nothing to compute with.
constexpr std::int32_t kDivisors[] = {kEncoder,  kEncoderAbsRes, kPosFactN, kPosFactZ, kTimer,
                                      kProfTime, kVelMax,        kRampMin,  kVelRes};

/// From 5.00 on there is one more start behaviour.
constexpr std::int32_t kLastStart = 6, kLastStartLater = 7, kOffsetWaits = 1000, kByCurve = 2000;

bool is_start_behaviour(std::int32_t value, bool later_edition) noexcept {
  const std::int32_t last = later_edition ? kLastStartLater : kLastStart;
  return (value >= 0 && value <= last) || (value >= kOffsetWaits && value <= kOffsetWaits + last) ||
         value == kByCurve;
}

}  // namespace

std::string_view options_of(std::int32_t number) noexcept {
  switch (number) {
    case kEncoderAbsType:
    case kMasterEncoderAbsType:
      return "0, 4, 5";
    case kSyncMStart:
      return R"(0 to 6, 1000 to 1006, 2000, with "firmware": "5.00" also 7 and 1007)";
    case kErrCond:
      return "0, 1, 2, 3, 5";
    case kCanBaud:
      return "16 to 22, 24";
    default:
      return {};
  }
}

bool is_option(std::int32_t number, std::int32_t value, bool later_edition) noexcept {
  constexpr std::int32_t kFirstProtocol = 4, kNoReaction = 4, kNoRate = 23;
  switch (number) {
    case kEncoderAbsType:
    case kMasterEncoderAbsType:
      return value == 0 || value >= kFirstProtocol;
    case kSyncMStart:
      return is_start_behaviour(value, later_edition);
    case kErrCond:
      return value != kNoReaction;
    case kCanBaud:
      return value != kNoRate;
    default:
      return true;
  }
}

ParameterSet set_of(std::int32_t number) noexcept {
  if (is_application_parameter(number)) return ParameterSet::kApplication;
  if (is_read_out(number)) return ParameterSet::kNone;
  const bool global = (number >= 3350 && number < 3360) || (number >= 3380 && number < 3390);
  return global ? ParameterSet::kGlobal : ParameterSet::kAxis;
}

ParameterValues::ParameterValues() noexcept {
  const auto all = parameters();
  for (std::size_t i = 0; i < all.size(); ++i) values_[i] = stored_[i] = all[i].start;
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
  if (error != 0) return error;
  const std::size_t index = parameter_index(number);
  ++changes_[index];
  if (index < kNumberedParameters) {
    stored_[index] = values_[index];
    *saved(set_of(number)) = true;
  }
  return 0;
}

bool ParameterValues::power_up() noexcept {
  bool sound = true;
  const auto all = parameters();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ParameterSet of = set_of(all[i].number);
    if (of != ParameterSet::kNone && *saved(of)) sound = set(all[i].number, stored_[i]) == 0 && sound;
    stored_[i] = values_[i];
  }
  return sound;
}

void ParameterValues::save(ParameterSet of) noexcept {
  const auto all = parameters();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (set_of(all[i].number) == of) stored_[i] = values_[i];
  *saved(of) = true;
}

void ParameterValues::forget() noexcept {
  for (std::size_t i = 0; i < stored_.size(); ++i) values_[i] = stored_[i];
  ++version_;
}

std::int32_t* ParameterValues::kept(std::int32_t number) noexcept {
  const std::size_t index = parameter_index(number);
  if (index == kNoParameter) return nullptr;
  return index < kNumberedParameters ? &stored_[index] : &values_[index];
}

std::uint32_t ParameterValues::changes(std::int32_t number) const noexcept {
  const std::size_t index = parameter_index(number);
  return index == kNoParameter ? 0 : changes_[index];
}

}  // namespace lockstep::mco305
