/// APOSS cut into words, with the files that a program includes.
/// @source MCO 305 Design Guide, tips for readability; constants; #INCLUDE
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "projects/aposs/message.hpp"

namespace lockstep::aposs {

inline constexpr std::size_t kLargestFile = 1 << 20;  ///< [byte]

struct Token {
  enum class Kind : std::uint8_t { kEnd, kName, kNumber, kText, kSymbol };
  Kind kind = Kind::kEnd;
  std::string text;    ///< as written; of a kText what stands between the quotes
  std::string folded;  ///< of a kName, in upper case
  std::int32_t number = 0;
  bool decimal = false;  ///< of a kNumber
  bool glued = false;    ///< to the token before, without a blank
  Place place;
};

/// Reads a file that a program includes, by the name that stands there; none if it cannot be read.
using ReadIncluded = std::function<std::optional<std::string>(const std::string& name)>;

struct Tokens {
  std::vector<Token> list;  ///< ends with a kEnd
  std::vector<std::string> files;
};

/// Cuts a program into tokens. Whatever the text is, it comes to an end.
Tokens cut(std::string name, std::string_view text, const ReadIncluded& read, Messages& messages);

/// Upper case, of ASCII letters.
std::string folded(std::string_view text);

}  // namespace lockstep::aposs
