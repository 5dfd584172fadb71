// Measuring inputs: what they see, and of what they measure the position.
#include "projects/expressions/constant.hpp"
#include "projects/keys/objects.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/read_keys.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {
namespace {

void load_marks(const JsonValue& json, MeasuringInput& input, const Loading& loading) {
  Problems& problems = loading.problems;
  const std::size_t before = problems.count();
  PrintMarks marks;
  const Fields fields = read_struct(json, keys::kMarks, marks, loading);
  input.marks = marks;
  if (problems.count() != before) return;
  const JsonValue* const width = fields["width"];
  if (width == nullptr)
    input.marks->width = 0.5 * marks.period;
  else if (!(marks.width > 0.0 && marks.width < marks.period))
    problems.report(*width,
                    width->shown() + " is not allowed; allowed: greater than 0 and less than 'period'");
}

/// What cannot be remembered cannot be looked up.
void check_correction(const JsonValue& config, const MeasuringInput& input, const Loading& loading) {
  const double servo_period = static_cast<double>(loading.controller().clock.servo_cycle) * 1e-9;
  const double longest = MeasuringInput::longest_correction(servo_period);
  if (input.data.Parameter.CorrectionTime <= longest) return;
  const JsonValue* const parameter = config.find("Parameter");
  const JsonValue* const time = parameter == nullptr ? nullptr : parameter->find("CorrectionTime");
  if (time == nullptr) return;
  loading.problems.report(*time, time->shown() + " is too long; allowed: up to " +
                                     value_text({.r = longest}, Type::LREAL) +
                                     " ms, which are 254 servo cycles");
}

/// One that watches another is of a later version of the technology.
void check_type(const JsonValue& config, const MeasuringInput& input, const Loading& loading) {
  if (input.data.Parameter.MeasuringInputType != MeasuringInputType::other_input) return;
  const JsonValue* const type = config.find("Parameter")->find("MeasuringInputType");
  loading.problems.report(
      *type,
      "a measuring input that watches another is not supported; allowed: 0 (time stamp), 1 (telegram)");
}

}  // namespace

void load_measuring_input(const JsonValue& json, MeasuringInput& input, const Loading& loading) {
  Problems& problems = loading.problems;
  const Fields fields(json, keys::kObjects, variant_of(input), problems);
  const std::size_t before = problems.count();
  const JsonValue* const config = fields["config"];
  if (config != nullptr) load_configuration(*config, input, loading);
  const bool sure = problems.count() == before;
  if (sure && config != nullptr) check_correction(*config, input, loading);
  if (sure && config != nullptr) check_type(*config, input, loading);
  if (const auto assigned = read_value(fields, keys::kMeasuringInputObject["assigned_to"], loading))
    key_detail::assign(input.measured, *assigned);
  const JsonValue* const marks = fields["marks"];
  if (marks != nullptr) load_marks(*marks, input, loading);
  const bool address = input.data.Interface.Address != nullptr;
  if (sure && address == (marks != nullptr))
    problems.report(marks != nullptr ? *marks : json,
                    "an input sees one thing; allowed is one of 'marks' and \"config\": { \"Interface\": { "
                    "\"Address\": the name of a BOOL tag } }");
}

}  // namespace lockstep
