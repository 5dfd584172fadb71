/// Texts of strangers - from files, networks and devices - as they may be shown: whoever prints or logs one
/// lets it through here.
#pragma once

#include <string>
#include <string_view>

namespace lockstep {

/// A piece of a text for a message: on one line, without what a terminal cannot show, of 60 characters at
/// most.
/// @param text UTF-8; what is none of it is shown as "?"
std::string shown(std::string_view text);

/// The whole text on one line: "?" stands for each character that a terminal obeys instead of showing it (C0,
/// C1, ends of lines, turns of the direction) and for each byte that is none of UTF-8.
std::string visible(std::string_view text);

/// The whole text as a string of JSON, in its quotes: what `visible` gives, with quotes and backslashes
/// escaped.
std::string json_text(std::string_view text);

}  // namespace lockstep
