#include "projects/json/document.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <unordered_set>

namespace lockstep {
namespace {

std::string text_of(SourcePosition position) {
  return std::to_string(position.line) + ":" + std::to_string(position.column);
}

/// What people write who think of another notation.
std::string_view hint(std::string_view message) {
  const auto has = [message](std::string_view part) { return message.find(part) != message.npos; };
  if (has("unexpected number literal") && has("expected string literal"))
    return " (the decimal point is '.', as in 1.5; a key is a text in \"\")";
  const bool begins_another = has("unexpected string literal") || has("unexpected '{'") ||
                              has("unexpected '['") || has("unexpected number") || has("unexpected true") ||
                              has("unexpected false");
  if (begins_another && (has("expected '}'") || has("expected ']'")))
    return " (a comma is missing before it)";
  if (has("unexpected '}'") || has("unexpected ']'")) return " (no comma stands before it)";
  if (has("invalid literal"))
    return R"( (allowed: true, false, numbers such as 1.5 and 1e3, texts in "", // comments))";
  return "";
}

/// What nlohmann's message says, without its number and place.
std::string reason(std::string_view message) {
  const auto column = message.find(", column ");
  const auto colon = column == message.npos ? message.npos : message.find(": ", column);
  if (colon != message.npos) message.remove_prefix(colon + 2);
  std::string text;
  constexpr std::string_view kLastRead = "; last read: '";
  const auto last_read = message.find(kLastRead);
  if (last_read == message.npos) return std::string(message).append(hint(message));
  // What was read last may be very long; what is expected follows it.
  const std::string_view token = message.substr(last_read + kLastRead.size());
  const auto end = token.rfind('\'');
  text = std::string(message.substr(0, last_read)) + "; last read: " + quote(token.substr(0, end));
  const auto expected = token.rfind("; expected ");
  if (expected != token.npos && end < expected) text += token.substr(expected);
  return text.append(hint(message));
}

/// Where a comment begins that does not end; npos if there is none.
std::size_t open_comment(std::string_view text) {
  for (std::size_t at = text.find_first_of("\"/"); at < text.size(); at = text.find_first_of("\"/", at + 1)) {
    const std::size_t begin = at;
    if (text[at] == '"') {
      for (++at; at < text.size() && text[at] != '"'; ++at)
        if (text[at] == '\\') ++at;
    } else if (text.substr(at, 2) == "//") {
      at = text.find('\n', at);
    } else if (text.substr(at, 2) == "/*") {
      at = text.find("*/", at + 2);
      if (at == text.npos) return begin;
      ++at;
    }
    if (at >= text.size()) break;
  }
  return text.npos;
}

void append_segment(std::string& pointer, std::string_view key) {
  pointer += '/';
  for (const char c : key) {
    if (c == '~')
      pointer += "~0";
    else if (c == '/')
      pointer += "~1";
    else
      pointer += c;
  }
}

/// What the elements of an array, or the members of an object, are called; empty: nothing of its own.
std::string_view called(std::string_view key) {
  constexpr std::pair<std::string_view, std::string_view> kCalled[] = {{"calls", "call"},
                                                                       {"then", "call"},
                                                                       {"else", "call"},
                                                                       {"programs", "program"},
                                                                       {"devices", "device"},
                                                                       {"technology_objects", "object"},
                                                                       {"tags", "tag"},
                                                                       {"transfer_areas", "transfer area"},
                                                                       {"controllers", "controller"},
                                                                       {"instances", "instance"},
                                                                       {"templates", "template"}};
  const auto* const found = std::ranges::find(kCalled, key, [](const auto& one) { return one.first; });
  return found == std::end(kCalled) ? std::string_view() : found->second;
}

}  // namespace

const JsonValue* JsonValue::find(std::string_view key) const noexcept {
  for (const Member& member : members)
    if (member.key == key) return member.value;
  return nullptr;
}

std::string JsonValue::pointer() const {
  std::vector<const JsonValue*> path;
  for (const JsonValue* value = this; value->parent_ != nullptr; value = value->parent_)
    path.push_back(value);
  std::reverse(path.begin(), path.end());
  std::string result;
  for (const JsonValue* const value : path) {
    if (value->parent_->kind == JsonKind::array)
      append_segment(result, std::to_string(value->index_));
    else
      append_segment(result, lockstep::shown(value->key_));
  }
  return result;
}

/// The name under which the parent has it; of a copy in an instance of a template it is not that of the
/// template.
std::string JsonValue::name_in_parent() const {
  if (instance_ != nullptr)
    for (const Member& member : parent_->members)
      if (member.value == this) return member.key;
  return key_;
}

std::string JsonValue::named_part() const {
  for (const JsonValue* value = this; value->parent_ != nullptr; value = value->parent_) {
    const std::string_view what = called(value->parent_->key_);
    if (what.empty()) continue;
    if (value->parent_->kind == JsonKind::object)
      return std::string(what) + " " + quote(value->name_in_parent());
    const JsonValue* const name = value->find("name");
    if (name != nullptr && name->kind == JsonKind::string) return std::string(what) + " " + quote(name->text);
  }
  return "";
}

std::string JsonValue::owner() const {
  std::string text = named_part();
  if (instance_ == nullptr) return text;
  return text + (text.empty() ? "" : ", ") + *instance_;
}

SourcePosition JsonValue::position() const noexcept {
  return source_ == nullptr ? SourcePosition{} : source_->position(offset_.value);
}

SourcePosition JsonValue::key_position() const noexcept {
  return source_ == nullptr ? SourcePosition{} : source_->position(offset_.key);
}

std::string JsonValue::shown() const {
  switch (kind) {
    case JsonKind::null:
      return "null";
    case JsonKind::boolean:
      return boolean ? "true" : "false";
    case JsonKind::number:
      return lockstep::shown(text);
    case JsonKind::string:
      return quote(text);
    case JsonKind::array:
      return "an array";
    case JsonKind::object:
      return "an object";
    case JsonKind::unusable:
      break;
  }
  return "a value";
}

/// Takes the events of nlohmann's parser and builds the document.
class JsonBuilder final : public nlohmann::json_sax<nlohmann::json> {
 public:
  /// @param overflows numbers, counted among all values, that were found too large for an LREAL before
  JsonBuilder(JsonDocument& document, const std::vector<ValueOffset>& offsets,
              const std::set<std::size_t>& overflows)
      : document_(document), offsets_(offsets), overflows_(overflows) {}

  bool null() override { return add(JsonKind::null) != nullptr; }
  bool boolean(bool value) override {
    JsonValue* const added = add(JsonKind::boolean);
    if (added != nullptr) added->boolean = value;
    return added != nullptr;
  }
  bool number_integer(std::int64_t value) override {
    return add_whole(value < 0,
                     value < 0 ? 0 - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value));
  }
  bool number_unsigned(std::uint64_t value) override { return add_whole(false, value); }
  bool number_float(double value, const std::string& written) override;
  bool string(std::string& value) override {
    JsonValue* const added = add(JsonKind::string);
    if (added != nullptr) added->text = std::move(value);
    return added != nullptr;
  }
  bool binary(nlohmann::json::binary_t& /*value*/) override { return false; }
  bool start_object(std::size_t /*size*/) override { return open(JsonKind::object); }
  bool start_array(std::size_t /*size*/) override { return open(JsonKind::array); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(std::string& value) override {
    open_.back().key = std::move(value);
    return true;
  }
  bool parse_error(std::size_t position, const std::string& token,
                   const nlohmann::detail::exception& exception) override;

  /// Where a number stands that is too large, and which value it is, if that ended the parsing.
  struct Overflow {
    std::size_t begin, end, number;
  };
  std::optional<Overflow> overflow;

 private:
  struct Open {
    JsonValue* value;
    std::string key;  // of the next member
    std::unordered_set<std::string> keys;
  };

  JsonValue* add(JsonKind kind);
  bool add_whole(bool negative, std::uint64_t magnitude);
  bool open(JsonKind kind);
  bool close() {
    open_.pop_back();
    return true;
  }
  bool fail(const JsonValue& at, std::string text) {
    document_.problems_.push_back(problem_at(at, std::move(text)));
    return false;
  }
  /// A value at the place of the next one, for messages.
  JsonValue next_place() const;

  JsonDocument& document_;
  const std::vector<ValueOffset>& offsets_;
  const std::set<std::size_t>& overflows_;
  std::vector<Open> open_;
};

JsonValue JsonBuilder::next_place() const {
  JsonValue place;
  place.source_ = document_.source_.get();
  if (document_.values_.size() < offsets_.size()) place.offset_ = offsets_[document_.values_.size()];
  if (open_.empty()) return place;
  place.parent_ = open_.back().value;
  if (place.parent_->kind == JsonKind::object)
    place.key_ = open_.back().key;
  else
    place.index_ = place.parent_->elements.size();
  return place;
}

JsonValue* JsonBuilder::add(JsonKind kind) {
  JsonValue place = next_place();
  if (document_.values_.size() == JsonDocument::kMaximumValues) {
    fail(place, "the file has more than " + std::to_string(JsonDocument::kMaximumValues) + " values");
    return nullptr;
  }
  const bool unusable = overflows_.contains(document_.values_.size());
  JsonValue& value = document_.values_.emplace_back(std::move(place));
  value.kind = unusable ? JsonKind::unusable : kind;
  if (open_.empty()) {
    document_.root_ = &value;
    return &value;
  }
  Open& parent = open_.back();
  if (parent.value->kind == JsonKind::array)
    parent.value->elements.push_back(&value);
  else if (parent.keys.insert(value.key_).second)
    parent.value->members.push_back({value.key_, &value});
  else
    document_.problems_.push_back(
        problem_at_key(value, "the key " + quote(value.key_) + " is there twice; each key is allowed once" +
                                  ", the other one is in line " +
                                  std::to_string(parent.value->find(value.key_)->key_position().line)));
  return &value;
}

bool JsonBuilder::add_whole(bool negative, std::uint64_t magnitude) {
  JsonValue* const value = add(JsonKind::number);
  if (value == nullptr) return false;
  value->negative = negative;
  value->whole = true;
  value->magnitude = magnitude;
  value->number = negative ? -static_cast<double>(magnitude) : static_cast<double>(magnitude);
  value->text = (negative ? "-" : "") + std::to_string(magnitude);
  return true;
}

bool JsonBuilder::number_float(double value, const std::string& written) {
  JsonValue* const added = add(JsonKind::number);
  if (added == nullptr) return false;
  added->number = value;
  added->negative = std::signbit(value);
  added->text = written;
  added->fraction = written.find('.') != written.npos || std::trunc(value) != value;
  added->whole = !added->fraction && std::abs(value) < 0x1p64;
  if (added->whole) added->magnitude = static_cast<std::uint64_t>(std::abs(value));
  return true;
}

bool JsonBuilder::open(JsonKind kind) {
  if (open_.size() == static_cast<std::size_t>(JsonDocument::kDeepest))
    return fail(next_place(),
                "nested too deeply; allowed are " + std::to_string(JsonDocument::kDeepest) + " levels");
  JsonValue* const value = add(kind);
  if (value != nullptr) open_.push_back({value, {}, {}});
  return value != nullptr;
}

bool JsonBuilder::parse_error(std::size_t position, const std::string& token,
                              const nlohmann::detail::exception& exception) {
  constexpr int kNumberOverflow = 406;
  if (exception.id == kNumberOverflow && position >= token.size()) {
    fail(next_place(), "the number " + shown(token) + " is out of range; allowed are numbers from " +
                           "-1.7976931348623157e308 to 1.7976931348623157e308");
    overflow = {position - token.size(), position, document_.values_.size()};
    return false;
  }
  const std::size_t comment = open_comment(document_.source_->text());
  if (position >= document_.source_->text().size() && comment != std::string_view::npos) {
    document_.problems_.push_back({.place = text_of(document_.source_->position(comment)),
                                   .text = "this comment has no end: missing closing '*/'",
                                   .file = document_.source_->file()});
    return false;
  }
  // A text that stands where it may not is told where it begins; what cannot be read, where it ends.
  const std::size_t length = token.size();
  const bool is_text =
      length <= position &&
      std::string_view(exception.what()).find("unexpected string literal") != std::string_view::npos &&
      document_.source_->text().compare(position - length, length, token) == 0;
  const std::size_t last = position == 0 ? 0 : position - 1;
  const SourcePosition place = document_.source_->position(is_text ? position - length : last);
  document_.problems_.push_back(
      {.place = text_of(place), .text = reason(exception.what()), .file = document_.source_->file()});
  return false;
}

JsonDocument::JsonDocument(std::string_view text, std::string file, std::string folder) {
  const auto refuse = [&](std::string place, std::string what) {
    problems_.push_back({.place = std::move(place), .text = std::move(what), .file = file});
  };
  if (text.size() > kLongest) {
    refuse("", "the file is longer than " + std::to_string(kLongest >> 20) + " MiB");
  } else if (text.find_first_not_of(" \t\r\n") == text.npos) {
    refuse("1:1", "the file is empty; a project is a JSON object");
  } else {
    source_ = std::make_unique<const SourceText>(text, file, std::move(folder));
    // The parser takes a NUL for the end of the text.
    const auto nul = text.find('\0');
    if (nul == text.npos)
      read();
    else if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF") || nul < 2)
      refuse("1:1", "the file is in UTF-16; allowed: UTF-8, which editors offer where they save a file");
    else
      refuse(text_of(source_->position(nul)), "a NUL character is not allowed");
  }
}

void JsonDocument::read() {
  // A number that no LREAL holds ends the parser. It is replaced and the text read again, so that the rest of
  // the file is looked at as well.
  constexpr int kMaximumOverflows = 20;
  std::string readable = source_->text();
  const std::vector<ValueOffset> offsets = value_offsets(readable, kMaximumValues + 1);
  std::set<std::size_t> overflows;
  std::vector<Problem> told;
  for (int i = 0; i < kMaximumOverflows; ++i) {
    values_.clear();
    root_ = nullptr;
    problems_.clear();
    JsonBuilder builder(*this, offsets, overflows);
    constexpr bool kStrict = true, kIgnoreComments = true;
    if (nlohmann::json::sax_parse(readable, &builder, nlohmann::json::input_format_t::json, kStrict,
                                  kIgnoreComments))
      break;
    root_ = nullptr;
    if (!builder.overflow) break;
    told.push_back(problems_.back());
    const auto [begin, end, number] = *builder.overflow;
    std::fill(readable.begin() + static_cast<std::ptrdiff_t>(begin),
              readable.begin() + static_cast<std::ptrdiff_t>(end), ' ');
    readable[begin] = '0';
    overflows.insert(number);
    problems_.clear();
  }
  problems_.insert(problems_.begin(), told.begin(), told.end());
}

}  // namespace lockstep
