#include "projects/aposs/argument_check.hpp"

#include <algorithm>

#include "projects/aposs/parameter_names.hpp"
#include "tech_objects/mco305_catalogue/drive_parameters.hpp"
#include "tech_objects/mco305_catalogue/parameters.hpp"
#include "tech_objects/mco305_catalogue/system_variables.hpp"

namespace lockstep::aposs {
namespace {

constexpr std::int32_t kFirstTerminal = 3400;  // X34/1 is output 3401

bool is_drive_parameter(Allowed allowed) {
  return allowed == Allowed::kDrive || allowed == Allowed::kWrittenDrive || allowed == Allowed::kIndexedDrive;
}

std::string drive_text(std::int32_t number) {
  if (number < 100 || number > 9999) return std::to_string(number);
  return std::to_string(number).insert(number < 1000 ? 1 : 2, "-");
}

/// A value as it is written there.
std::string value_text(const ArgumentRange& range, std::int32_t value) {
  if (range.command == Command::kOut && value > kFirstTerminal && value < kFirstTerminal + 100)
    return "X34/" + std::to_string(value - kFirstTerminal);
  if (is_drive_parameter(range.allowed)) return drive_text(value);
  const bool parameter = range.allowed == Allowed::kParameter || range.allowed == Allowed::kWritten;
  return parameter && value >= 0 && value <= 9999 ? parameter_text(value) : std::to_string(value);
}

std::string span_text(const ArgumentRange& range, ValueSpan span) {
  const std::string lowest = value_text(range, span.lowest), highest = value_text(range, span.highest);
  if (span.lowest == span.highest) return lowest;
  if (span.lowest == kNoLowest) return "up to " + highest;
  if (span.highest == kNoHighest) return lowest + " and more";
  return lowest + (span.highest - std::int64_t{span.lowest} == 1 ? ", " : " to ") + highest;
}

std::string spans_text(const ArgumentRange& range) {
  std::string text;
  for (const ValueSpan& span : range.spans) text += (text.empty() ? "" : ", ") + span_text(range, span);
  return text;
}

std::string bits_text(std::int32_t bits) {
  std::string text;
  for (std::int32_t bit = 1; bit <= bits; bit *= 2)
    if ((bits & bit) != 0) text += (text.empty() ? "" : ", ") + std::to_string(bit);
  return text + " and their sums";
}

bool within(std::span<const ValueSpan> spans, std::int64_t value) {
  return std::ranges::any_of(
      spans, [value](const ValueSpan& span) { return value >= span.lowest && value <= span.highest; });
}

bool is_readable_variable(std::int32_t index) {
  const mco305::SystemVariable* const variable = mco305::find_system_variable(index);
  return variable != nullptr && variable->built;
}

/// What SET writes to: a parameter, or an input function by its own name.
bool is_written(std::int32_t number) {
  return number >= kInputFunction || (is_parameter(number) && !mco305::is_read_out(number));
}

/// An old name such as I_BREAK, whose value is an input.
bool takes_input(std::int32_t number) {
  return number >= kInputFunction && (number - kInputFunction) % 100 == 0;
}

constexpr ValueSpan kInputOfFunction[] = {{-12, 12}};

bool is_value(std::int32_t number, std::int32_t value) {
  if (takes_input(number)) return within(kInputOfFunction, value);
  if (number >= kInputFunction || !is_written(number)) return true;
  return mco305::ParameterValues().set(number, value) == 0;
}

/// SYNCMTYPM, SYNCMTYPS: n2 and n3 have their markers at input n.
bool is_marker_input(std::int32_t number, std::int32_t value) {
  const std::int32_t input = value / 10, edge = value % 10;
  return (number == mco305::kMarkerTypeMaster || number == mco305::kMarkerTypeSlave) && input >= 1 &&
         input <= 12 && (edge == 2 || edge == 3);
}

const mco305::Parameter* numbered(std::int32_t number) {
  const std::size_t index = mco305::parameter_index(number);
  return index < mco305::parameters().size() ? &mco305::parameters()[index] : nullptr;
}

bool is_published(std::int32_t number, std::int32_t value, bool later_edition) {
  const mco305::Parameter* const of = numbered(number);
  // Their other values, such as 11 and 21, are described with other parameters.
  const bool encoder = number == mco305::kEncoderType || number == mco305::kMasterEncoderType;
  if (of == nullptr || encoder || is_marker_input(number, value)) return true;
  return value >= of->lowest && value <= of->highest && mco305::is_option(number, value, later_edition);
}

bool is_value_of_drive(std::int32_t number, std::int32_t value) {
  const mco305::DriveParameter* const of = mco305::find_drive_parameter(number);
  return of == nullptr || !of->writable || (value >= of->lowest && value <= of->highest);
}

/// A range with what belongs to it in this place.
class Check {
 public:
  Check(const ArgumentRange& range, std::span<const Expression* const> arguments,
        const RangesOfProgram& program)
      : range_(range), arguments_(arguments), program_(program), value_(arguments[range.argument]->value) {}

  bool holds() const {
    switch (range_.allowed) {
      case Allowed::kSpans:
        return within(range_.spans, value_);
      case Allowed::kEitherSign:
        return within(range_.spans, value_ < 0 ? -std::int64_t{value_} : value_);
      case Allowed::kBits:
        return (value_ & ~range_.spans.front().highest) == 0;
      case Allowed::kUpToNext:
        return !is_constant(behind()) || value_ <= behind().value;
      case Allowed::kWithinArray:
        return value_ >= range_.spans.front().lowest && value_ <= highest_of_array();
      case Allowed::kSystemVariable:
        return is_readable_variable(value_);
      case Allowed::kParameter:
        return value_ >= kInputFunction || is_parameter(value_);
      case Allowed::kWritten:
        return is_written(value_);
      case Allowed::kValueOfWritten:
        return !is_constant(before()) || is_value(before().value, value_);
      case Allowed::kPublishedValue:
        return !is_constant(before()) || is_published(before().value, value_, program_.later_edition);
      case Allowed::kDrive:
        return mco305::find_drive_parameter(value_) != nullptr;
      case Allowed::kWrittenDrive: {
        const mco305::DriveParameter* const of = mco305::find_drive_parameter(value_);
        return of != nullptr && of->writable;
      }
      case Allowed::kIndexedDrive:
        return false;
      case Allowed::kValueOfDrive:
        return !is_constant(before()) || is_value_of_drive(before().value, value_);
      case Allowed::kPidValue:
        return value_ != 0 || before().value != kTimer;
    }
    return true;
  }

  std::string text() const {
    const std::string happens = range_.error != 0 ? "error " + std::to_string(range_.error) + " when it runs"
                                                  : std::string(range_.outside);
    std::string name(row_of(range_.command).name);
    if (name.ends_with(" =")) name.resize(name.size() - 2);
    return name + ": " + std::string(range_.name) + " " + value_text(range_, value_) + ": " + happens +
           "; allowed: " + allowed();
  }

 private:
  static constexpr std::int32_t kTimer = 4;  // of the coefficients of PID

  const Expression& before() const { return *arguments_[range_.argument - 1]; }
  const Expression& behind() const { return *arguments_[range_.argument + 1]; }
  static bool is_constant(const Expression& one) { return one.kind == Expression::Kind::kConstant; }

  std::int64_t highest_of_array() const {
    const auto size = program_.arrays[static_cast<std::size_t>(behind().value)].size;
    return std::min<std::int64_t>(size, range_.spans.front().highest);
  }

  std::string allowed() const {
    switch (range_.allowed) {
      case Allowed::kUpToNext:
        return "up to " + std::to_string(behind().value) + ", the value behind it";
      case Allowed::kWithinArray:
        return "0 to " + std::to_string(highest_of_array());
      case Allowed::kValueOfWritten:
      case Allowed::kPublishedValue:
        return of_parameter();
      case Allowed::kValueOfDrive: {
        const mco305::DriveParameter& of = *mco305::find_drive_parameter(before().value);
        return std::to_string(of.lowest) + " to " + std::to_string(of.highest);
      }
      default:
        return allowed_text(range_);
    }
  }
  std::string of_parameter() const {
    if (takes_input(before().value)) return span_text(range_, kInputOfFunction[0]);
    const std::string_view options = mco305::options_of(before().value);
    if (!options.empty()) return std::string(options);
    const mco305::Parameter& of = *numbered(before().value);
    const bool but_nothing = of.lowest < 0 && !is_value(before().value, 0);
    return std::to_string(of.lowest) + " to " + std::to_string(of.highest) + (but_nothing ? ", not 0" : "") +
           (of.decimals == 0 ? "" : ", in thousandths");
  }

  const ArgumentRange& range_;
  std::span<const Expression* const> arguments_;
  const RangesOfProgram& program_;
  std::int32_t value_;
};

}  // namespace

std::string allowed_text(const ArgumentRange& range) {
  switch (range.allowed) {
    case Allowed::kSpans:
      return spans_text(range);
    case Allowed::kEitherSign:
      return spans_text(range) + ", below 0 for the falling edge";
    case Allowed::kBits:
      return bits_text(range.spans.front().highest);
    case Allowed::kUpToNext:
      return "up to the value behind it";
    case Allowed::kWithinArray:
      return spans_text(range) + ", up to the size of the array";
    case Allowed::kSystemVariable:
      return "the index of a system variable";
    case Allowed::kParameter:
      return "32-00 to 34-71 as published, 1900 to 1999";
    case Allowed::kWritten:
      return "32-00 to 33-91 as published, 1900 to 1999";
    case Allowed::kValueOfWritten:
    case Allowed::kPublishedValue:
    case Allowed::kValueOfDrive:
      return "the range of the parameter";
    case Allowed::kDrive:
    case Allowed::kWrittenDrive: {
      std::string text;
      for (const mco305::DriveParameter& one : mco305::drive_parameters())
        if (one.writable || range.allowed == Allowed::kDrive)
          text += (text.empty() ? "" : ", ") + drive_text(one.number);
      return text;
    }
    case Allowed::kIndexedDrive:
      return "none, the simulated drive has no parameter with indices";
    case Allowed::kPidValue:
      return "for TIMER all but 0";
  }
  return "";
}

void check_arguments(Command command, std::span<const Expression* const> arguments,
                     const RangesOfProgram& program, Messages& messages) {
  const ArgumentRange* told = nullptr;
  for (const ArgumentRange& range : argument_ranges()) {
    if (range.command != command || range.argument >= arguments.size()) continue;
    if (told != nullptr && told->argument == range.argument) continue;
    const Expression& argument = *arguments[range.argument];
    if (argument.kind != Expression::Kind::kConstant) continue;
    const Check check(range, arguments, program);
    if (check.holds()) continue;
    told = &range;
    if (range.problem)
      messages.error(argument.place, check.text());
    else
      messages.warn(argument.place, check.text());
  }
}

}  // namespace lockstep::aposs
