#include "fb/checks/copy_cam_data_check.hpp"

namespace lockstep {
namespace {

/// What is to be copied of one kind of element, by the names of its pins.
struct Copied {
  std::string_view number_pin, start_pin, array_pin;
  DINT number, start;
  const Array* array;
};

void check(const WrittenCall& call, const Copied& copied, CallWarnings& warnings) {
  const bool known = !call.computed(copied.number_pin) && !call.computed(copied.start_pin);
  if (!known || call.given(copied.number_pin) == nullptr || copied.number <= 0) return;
  const GivenInput* const array = call.given(copied.array_pin);
  if (array == nullptr)
    return warnings.push_back(
        {0, copied.number_pin,
         std::string(copied.array_pin) + " is not given; the block will report an error"});
  if (copied.array == nullptr) return;  // what it is given is reported
  const std::int64_t available = std::int64_t{copied.array->upper} - copied.start + 1;
  if (copied.array->holds(copied.start) && copied.number <= available) return;
  warnings.push_back({0, copied.number_pin,
                      std::to_string(copied.number) + " from " + std::to_string(copied.start) +
                          " on are more than " + array->shown + " has, an " + array_type_name(*copied.array) +
                          "; the block will report an error"});
}

}  // namespace

void check_copied_elements(const WrittenCall& call, CallWarnings& warnings) {
  const auto& block = static_cast<const MC_CopyCamData&>(*call.block);
  check(call,
        {"NumberOfPoints", "StartPointArray", "ArrayOfPoints", block.NumberOfPoints, block.StartPointArray,
         block.ArrayOfPoints},
        warnings);
  check(call,
        {"NumberOfSegments", "StartSegmentArray", "ArrayOfSegments", block.NumberOfSegments,
         block.StartSegmentArray, block.ArrayOfSegments},
        warnings);
}

}  // namespace lockstep
