/// What requests and answers of the studio are made of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hmi_bridge/studio/handler.hpp"

namespace lockstep::studio_api {

using Json = nlohmann::ordered_json;

/// What is wrong with a request; all of it.
struct Wrong {
  unsigned status;
  Json errors = Json::array();

  void add(std::string_view code, const std::string& message, const Json& more = Json::object());
};

/// Thrown where nothing else is to be looked at.
struct BadRequest : std::runtime_error {
  BadRequest(unsigned status_code, std::string word, const std::string& text)
      : std::runtime_error(text), status(status_code), code(std::move(word)) {}
  unsigned status;
  std::string code;
};

/// One line; what is no UTF-8 is replaced.
std::string text_of(const Json& json);
StudioAnswer answer_of(const Json& json);
StudioAnswer answer_of(const Wrong& wrong);
StudioAnswer error_answer(unsigned status, std::string_view code, const std::string& message);

/// @throws BadRequest
Json parsed(std::string_view text);
/// A value of the query; `otherwise`: it is not there. @throws BadRequest
std::int64_t whole_number(const StudioRequest& request, std::string_view key, std::int64_t otherwise);
/// The parts between commas.
std::vector<std::string> split(std::string_view text);
/// The paths that a message names; @throws BadRequest if they are none, or too many
std::vector<std::string> paths_in(const Json& json, std::size_t limit);
/// Whether what can be answered is wanted though something else of the question is wrong.
bool is_partial(const Json& json);

template <class List, class Convert>
Json array_of(const List& list, Convert convert) {
  Json array = Json::array();
  for (const auto& one : list) array.push_back(convert(one));
  return array;
}

}  // namespace lockstep::studio_api
