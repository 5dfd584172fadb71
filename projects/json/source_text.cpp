#include "projects/json/source_text.hpp"

#include <algorithm>
#include <utility>

namespace lockstep {
namespace {

constexpr std::size_t kBlock = 1024;  // [byte]
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::size_t characters_in(std::string_view text) noexcept {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

bool is_blank(char c) noexcept {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// Goes through a text token by token.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {
    if (text_.starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
    skip_blanks();
  }

  bool over() const noexcept { return at_ >= text_.size(); }
  std::size_t at() const noexcept { return at_; }
  char next() const noexcept { return over() ? '\0' : text_[at_]; }

  /// Behind a sign such as a bracket.
  void pass_sign() {
    ++at_;
    skip_blanks();
  }
  /// Behind a string, with what is escaped in it.
  void pass_string() {
    for (++at_; !over() && text_[at_] != '"'; ++at_)
      if (text_[at_] == '\\') ++at_;
    pass_sign();
  }
  /// Behind a number, true, false or null.
  void pass_word() {
    at_ = std::min(text_.find_first_of(" \t\r\n,:[]{}\"/", at_ + 1), text_.size());
    skip_blanks();
  }

 private:
  void skip_blanks() {
    for (;;) {
      while (!over() && is_blank(text_[at_])) ++at_;
      const std::string_view rest = text_.substr(std::min(at_, text_.size()));
      if (rest.starts_with("//"))
        at_ = std::min(text_.find_first_of("\r\n", at_), text_.size());
      else if (rest.starts_with("/*"))
        at_ = std::min(text_.find("*/", at_ + 2), text_.size() - 2) + 2;
      else
        return;
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

SourceText::SourceText(std::string_view text, std::string file, std::string folder)
    : text_(text), file_(std::move(file)), folder_(std::move(folder)) {
  lines_.push_back(text_.starts_with(kByteOrderMark) ? 3 : 0);
  for (std::size_t i = 0; i < text_.size(); ++i)
    if (text_[i] == '\n') lines_.push_back(static_cast<std::uint32_t>(i + 1));
  std::size_t characters = 0;
  for (std::size_t i = 0; i < text_.size(); i += kBlock) {
    blocks_.push_back(static_cast<std::uint32_t>(characters));
    characters += characters_in(std::string_view(text_).substr(i, kBlock));
  }
}

std::size_t SourceText::characters_before(std::size_t byte) const noexcept {
  const std::size_t block = byte / kBlock;
  if (block >= blocks_.size())
    return blocks_.empty() ? 0
                           : blocks_.back() +
                                 characters_in(std::string_view(text_).substr((blocks_.size() - 1) * kBlock));
  return blocks_[block] + characters_in(std::string_view(text_).substr(block * kBlock, byte % kBlock));
}

SourcePosition SourceText::position(std::size_t byte) const noexcept {
  const std::size_t at =
      std::clamp<std::size_t>(byte, std::min<std::size_t>(lines_.front(), text_.size()), text_.size());
  const auto line = std::upper_bound(lines_.begin(), lines_.end(), at) - 1;
  return {static_cast<std::size_t>(line - lines_.begin()) + 1,
          characters_before(at) - characters_before(*line) + 1};
}

std::vector<ValueOffset> value_offsets(std::string_view text, std::size_t maximum) {
  std::vector<ValueOffset> offsets;
  Scanner scanner(text);
  bool keyed = false;  // behind a key and its colon
  std::uint32_t key = 0;
  while (!scanner.over() && offsets.size() < maximum) {
    const char sign = scanner.next();
    if (sign == ']' || sign == '}' || sign == ',' || sign == ':') {
      scanner.pass_sign();
      continue;
    }
    const auto begin = static_cast<std::uint32_t>(scanner.at());
    if (sign == '"')
      scanner.pass_string();
    else if (sign == '[' || sign == '{')
      scanner.pass_sign();
    else
      scanner.pass_word();
    if (sign == '"' && !keyed && scanner.next() == ':') {
      key = begin;
      keyed = true;
      continue;
    }
    offsets.push_back({keyed ? key : begin, begin});
    keyed = false;
  }
  return offsets;
}

}  // namespace lockstep
