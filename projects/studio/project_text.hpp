/// A project as it is written, for pages: programs with the JSON pointer of each part, couplings, uses of a
/// name.
#pragma once

#include <string>
#include <string_view>

#include "projects/studio/api.hpp"

namespace lockstep {

/// The text of a valid project, includes and templates in their places. Any thread once it is made.
class StudioProjectText {
 public:
  /// @param text a JSON document; empty: nothing is known
  explicit StudioProjectText(std::string_view text = "");

  bool is_known() const noexcept { return !document_.is_null(); }
  /// Programs in their order, with their calls as they are written.
  studio_api::Json programs() const;
  /// What one axis follows another by: the calls whose inputs name both.
  studio_api::Json couplings() const;
  /// Where a name stands within expressions and targets of programs, without regard to case.
  studio_api::Json uses(std::string_view name) const;
  /// The expression of a pin of an instance and its pointer; null: it is not wired.
  studio_api::Json wiring(std::string_view instance, std::string_view pin) const;
  /// The start value that the project gives a variable of an object; null: none.
  studio_api::Json configured(std::string_view object, std::string_view path) const;
  /// The cams that the project has, with their files.
  studio_api::Json cams() const;
  /// All of it, without comments.
  std::string whole() const { return studio_api::text_of(document_); }

 private:
  studio_api::Json document_;
};

}  // namespace lockstep
