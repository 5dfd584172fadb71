#include "projects/studio/api.hpp"

#include <algorithm>
#include <charconv>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "projects/json/problem.hpp"

namespace lockstep::studio_api {
namespace {

constexpr int kDepth = 20;  // of JSON

/// What is wrong with a text, without the number that the library gives to it.
std::string syntax_problem(std::string text) {
  const std::size_t end = text.find("] ");
  if (text.starts_with("[json.exception.") && end != text.npos) text.erase(0, end + 2);
  return "this is no JSON: " + text;
}

}  // namespace

void Wrong::add(std::string_view code, const std::string& message, const Json& more) {
  Json error = {{"code", code}, {"message", message}};
  error.update(more);
  errors.push_back(error);
}

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

StudioAnswer answer_of(const Json& json) {
  StudioAnswer answer;
  answer.body = text_of(json) + "\n";
  return answer;
}

StudioAnswer answer_of(const Wrong& wrong) {
  StudioAnswer answer = answer_of(Json{{"error", wrong.errors.front()}, {"errors", wrong.errors}});
  answer.status = wrong.status;
  return answer;
}

StudioAnswer error_answer(unsigned status, std::string_view code, const std::string& message) {
  Wrong wrong{status};
  wrong.add(code, message);
  return answer_of(wrong);
}

Json parsed(std::string_view text) {
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  const Json::parser_callback_t bounded = [&keys](int depth, Json::parse_event_t event, Json& value) {
    if (depth > kDepth)
      throw BadRequest(422, "bad_request", "this JSON is nested too deeply; allowed: 20 levels");
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
      throw BadRequest(422, "bad_request", "the key " + quote(value.get<std::string>()) + " is there twice");
    return true;
  };
  try {
    return Json::parse(text, bounded);
  } catch (const Json::exception& error) {
    throw BadRequest(422, "bad_request", syntax_problem(error.what()));
  }
}

std::int64_t whole_number(const StudioRequest& request, std::string_view key, std::int64_t otherwise) {
  const std::string_view text = request.value(key);
  if (text.empty()) return otherwise;
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size())
    throw BadRequest(422, "wrong_type",
                     std::string(key) + ": '" + std::string(text) + "' has to be a whole number");
  return number;
}

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(','), text.size());
    parts.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return parts;
}

std::vector<std::string> paths_in(const Json& json, std::size_t limit) {
  const auto paths = json.find("paths");
  if (paths == json.end() || !paths->is_array() || paths->empty())
    throw BadRequest(422, "bad_request", "'paths' has to be a list of paths, one at least");
  if (paths->size() > limit)
    throw BadRequest(422, "too_many",
                     std::to_string(paths->size()) + " paths; allowed: " + std::to_string(limit));
  std::vector<std::string> result;
  for (const Json& path : *paths) {
    if (!path.is_string()) throw BadRequest(422, "wrong_type", "a path has to be a text");
    result.push_back(path.get<std::string>());
  }
  return result;
}

bool is_partial(const Json& json) {
  const auto found = json.find("partial");
  return found != json.end() && found->is_boolean() && found->get<bool>();
}

}  // namespace lockstep::studio_api
