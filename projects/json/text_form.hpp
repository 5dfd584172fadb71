/// Texts of which more is known than that they are some: once for whoever reads them, and for editors.
#pragma once

#include <string>
#include <string_view>

namespace lockstep {

/// What a text may be.
struct TextForm {
  std::string_view what;     ///< for people, such as "HOST:PORT"
  std::string_view pattern;  ///< regular expression for schemas: refuses nothing that `problem` lets pass
  /// What is wrong with a text, and what is allowed; empty: nothing.
  std::string (*problem)(std::string_view text);
};

}  // namespace lockstep
