/// Texts as people write and read them: UTF-8, and literals of IEC 61131-3.
/// @source IEC 61131-3:2013, 6.3.3
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lockstep {

/// The characters of a STRING (ISO 8859-1, one byte each) for a text in UTF-8; none if one of them is not
/// printable or is not among them: allowed are U+0020 to U+007E and U+00A0 to U+00FF.
std::optional<std::string> text_from_utf8(std::string_view utf8);
/// The other way round, for any characters.
std::string text_to_utf8(std::string_view text);

/// A text as a literal in UTF-8: 'ale', with $' and $$ for quote and dollar, and $hh (hexadecimal) for a
/// character that is not printable.
std::string text_literal(std::string_view text);
/// The characters of such a literal; none, with what is wrong in `problem`, if it is none.
std::optional<std::string> read_text_literal(std::string_view literal, std::string& problem);

}  // namespace lockstep
