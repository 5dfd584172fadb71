#include "tech_objects/linmot_catalogue/parameters.hpp"

#include "tech_objects/linmot_catalogue/increments.hpp"
#include "tech_objects/linmot_catalogue/parameter_table.hpp"
#include "tech_objects/linmot_catalogue/spelling.hpp"

namespace lockstep::linmot {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return lower_case(c) >= 'a' && lower_case(c) <= 'z';
}

template <class T>
T& at(void* parameters, std::size_t offset) noexcept {
  return *static_cast<T*>(static_cast<void*>(static_cast<char*>(parameters) + offset));
}

}  // namespace

std::span<const Parameter> system_parameters() noexcept {
  return kSystemTable;
}
std::span<const Parameter> motor_parameters() noexcept {
  return kMotorTable;
}

const Parameter* find_system_parameter(std::string_view path) noexcept {
  for (const Parameter& parameter : system_parameters())
    if (same_spelling(parameter.path, path)) return &parameter;
  return nullptr;
}

const Parameter* find_motor_parameter(std::string_view path) noexcept {
  for (const Parameter& parameter : motor_parameters())
    if (parameter.scope <= Scope::linear_motor && same_spelling(parameter.path, path)) return &parameter;
  return nullptr;
}

std::string signal_name(std::string_view part) {
  std::string name;
  bool capital = true;
  for (const char c : part) {
    if (is_letter(c) || is_digit(c)) {
      name += capital && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
      capital = is_digit(c);
      continue;
    }
    if (c == '+') name += "Plus";
    if (c == '-') name += "Minus";
    capital = true;
  }
  std::size_t digits = 0;
  while (digits < name.size() && is_digit(name[digits])) ++digits;
  if (digits == 0) return name;
  // "10VPosition" is Position10V.
  const bool volts = digits + 1 < name.size() && name[digits] == 'V' && name[digits + 1] == 'P';
  const std::size_t end = digits + (volts ? 1 : 0);
  return name.substr(end) + name.substr(0, end);
}

std::string signal_path(std::string_view path) {
  std::string all;
  while (true) {
    const std::size_t end = path.find('\\');
    all += (all.empty() ? "" : ".") + signal_name(path.substr(0, end));
    if (end == path.npos) return all;
    path.remove_prefix(end + 1);
  }
}

double parameter_value(const Parameter& parameter, const void* parameters) noexcept {
  void* const place = const_cast<void*>(parameters);
  if (!parameter.effective()) return 0.0;
  if (parameter.kind == Kind::value) return at<LREAL>(place, parameter.offset);
  if (parameter.kind == Kind::on_off) return at<BOOL>(place, parameter.offset) ? 1.0 : 0.0;
  return at<DINT>(place, parameter.offset);
}

void set_parameter(const Parameter& parameter, void* parameters, double value) noexcept {
  if (!parameter.effective()) return;
  if (parameter.kind == Kind::value)
    at<LREAL>(parameters, parameter.offset) = value;
  else if (parameter.kind == Kind::on_off)
    at<BOOL>(parameters, parameter.offset) = value != 0.0;
  else
    at<DINT>(parameters, parameter.offset) = static_cast<DINT>(value);
}

double increment_of(const Parameter& parameter) noexcept {
  struct Row {
    std::string_view unit;
    double increment;
  };
  constexpr Row kRows[] = {{"mm", kPositionIncrement},        {"m/s", kVelocityIncrement},
                           {"m/s²", kAccelerationIncrement},  {"A", kCurrentIncrement},
                           {"A/mm", kProportionalIncrement},  {"A/(mm s)", kIntegralIncrement},
                           {"A/(m/s)", kDerivativeIncrement}, {"mA/(m/s²)", kFeedForwardIncrement},
                           {"%", kPercentIncrement}};
  for (const Row& row : kRows)
    if (row.unit == parameter.unit) return row.increment;
  return 1.0;
}

}  // namespace lockstep::linmot
