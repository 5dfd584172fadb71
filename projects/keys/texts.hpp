/// Declared keys for people: what may stand there, what holds without, and which structures there are.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "projects/json/key.hpp"

namespace lockstep {

/// What may stand as its value, such as "number from 0 to 1e+12".
std::string value_text(const Key& key);
/// Its meaning with its unit.
std::string meaning_text(const Key& key);
/// What holds if it is not given: the default of its member, or what is said in place of it; "required";
/// empty: nothing does.
std::string default_text(const Key& key);
/// The default of its member, where that tells what holds; none for a key that is required.
std::optional<KeyValue> default_of(const Key& key);
/// The word that stands for a value; empty if there is none.
std::string_view word_of(const Key& key, std::int64_t value);

/// The keys that may stand in one place of the file.
struct KeySection {
  std::string path;          ///< such as "technology_objects.drive.plant"; empty: the file
  std::string_view variant;  ///< the kind of object, where a place may have several; else empty
  Keys keys;
  std::string_view text;
  std::string same_as;  ///< where the same keys stand further up; empty: nowhere
};

/// All places of a project file, from its root on, in the order of the declarations.
std::vector<KeySection> key_sections();

/// All places of a system file, from its root on; their paths begin with "system".
std::vector<KeySection> system_key_sections();
/// Those of both.
std::vector<KeySection> all_key_sections();

/// The keys as a document: projects/KEYS.md.
std::string keys_document();

}  // namespace lockstep
