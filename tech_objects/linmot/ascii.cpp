#include "tech_objects/linmot/ascii.hpp"

namespace lockstep::linmot {
namespace {

constexpr int kUnknown = 58, kForm = 59, kSign = 60, kLength = 65;
constexpr std::size_t kLongest = 32;
constexpr std::int64_t kLargestNumber = 1'000'000'000'000;  // beyond every range

bool is_figure(char c) noexcept {
  return c >= '0' && c <= '9';
}

/// The number in front, which goes; none: false.
bool take_number(std::string_view& text, std::int64_t& number) noexcept {
  std::size_t count = 0;
  number = 0;
  for (; count < text.size() && is_figure(text[count]); ++count)
    if (number < kLargestNumber) number = number * 10 + (text[count] - '0');
  text.remove_prefix(count);
  return count > 0;
}

bool is_target(char c, AsciiForm form) noexcept {
  const bool motor = c >= 'A' && c <= 'Z', controller = is_figure(c);
  if (form == AsciiForm::sign_any) return motor || controller;
  return form == AsciiForm::drive || form == AsciiForm::number_drive ? motor : controller;
}

AsciiRequest refused(int error) noexcept {
  AsciiRequest request;
  request.error = error;
  return request;
}

}  // namespace

AsciiRequest read_ascii(std::string_view text) noexcept {
  if (text.size() > kLongest) return refused(kLength);
  if (text.size() < 3 || text[0] != '!') return refused(kForm);
  AsciiRequest request;
  request.command = find_ascii_command(text.substr(1, 2));
  if (request.command == nullptr) return refused(kUnknown);
  const AsciiForm form = request.command->form;
  text.remove_prefix(3);
  const bool signs = form == AsciiForm::sign_controller || form == AsciiForm::sign_any;
  const bool counts = form == AsciiForm::number_drive;
  const bool has_sign = !text.empty() && (text[0] == '+' || text[0] == '-');
  request.on = has_sign && text[0] == '+';
  const bool negative = has_sign && text[0] == '-';
  if (has_sign && !signs && !counts) return refused(kForm);
  if (has_sign) text.remove_prefix(1);
  if (counts && !take_number(text, request.number)) return refused(kForm);
  if (text.size() != 1 || !is_target(text[0], form)) return refused(kForm);
  // Its form is right.
  if (signs && !has_sign) return refused(kSign);
  if (counts && negative && !request.command->is(AsciiCommand::kSigned)) return refused(kSign);
  if (negative) request.number = -request.number;
  request.target = text[0];
  return request;
}

std::string ascii_text(const AsciiAnswer& answer) {
  using enum AsciiAnswer::Kind;
  if (answer.kind == done) return "#";
  if (answer.kind == error) return "#E" + std::to_string(answer.number);
  if (answer.kind == number) return "#" + std::to_string(answer.number);
  std::string text = std::string("#") + answer.letter;
  if (answer.letter == 'E') text += std::to_string(answer.number);
  if (answer.letter == 'E' && answer.motor != 0) text += answer.motor;
  return text;
}

std::size_t ascii_length(const AsciiAnswer& answer) noexcept {
  using enum AsciiAnswer::Kind;
  std::size_t length = 1;
  if (answer.kind == error || answer.kind == status) ++length;
  if (answer.kind == done || (answer.kind == status && answer.letter != 'E')) return length;
  if (answer.number < 0) ++length;
  std::int32_t rest = answer.number;
  do {
    ++length;
    rest /= 10;
  } while (rest != 0);
  return answer.kind == status && answer.motor != 0 ? length + 1 : length;
}

}  // namespace lockstep::linmot
