#include "fb/checks/written_call.hpp"

#include <algorithm>
#include <bit>

namespace lockstep {

const GivenInput* WrittenCall::given(std::string_view pin) const noexcept {
  const auto found =
      std::find_if(inputs.begin(), inputs.end(), [&](const GivenInput& input) { return input.pin == pin; });
  return found == inputs.end() ? nullptr : &*found;
}

bool WrittenCall::computed(std::string_view pin) const noexcept {
  const GivenInput* const input = given(pin);
  return input != nullptr && !input->constant;
}

TechnologyObject* WrittenCall::object(std::string_view pin) const noexcept {
  const std::uint64_t address = type->find_pin(pin)->signal(*block).load().u;
  return std::bit_cast<TechnologyObject*>(static_cast<std::uintptr_t>(address));
}

}  // namespace lockstep
