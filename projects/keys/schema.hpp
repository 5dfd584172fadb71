/// The schema (JSON Schema draft-07) of what is declared as keys.
#pragma once

#include <nlohmann/json.hpp>

#include "projects/json/key.hpp"

namespace lockstep {

/// Writes schemas of keys, and collects the definitions to which they refer.
class KeySchema {
 public:
  using Json = nlohmann::ordered_json;

  /// An object with the keys, and no others.
  Json object(Keys keys);
  /// The value of a key.
  Json value(const Key& key);

  Json definitions = Json::object();

 private:
  Json single(const Key& key);
  Json structure(const Key& key);
  Json variants(std::span<const KeyVariant> variants);
};

}  // namespace lockstep
