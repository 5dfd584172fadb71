/// Reads objects of the project file as their keys are declared.
#pragma once

#include "projects/json/key.hpp"
#include "projects/loader/loader.hpp"

namespace lockstep {

/// The value of a key that is there once, or of one of several; none if it is missing, or is not as it is
/// declared: then that is reported.
std::optional<KeyValue> read_value(const JsonValue* json, const Key& key, const Loading& loading);

/// The value of a key of an object; none if it is missing, or is not as it is declared: then that is
/// reported.
inline std::optional<KeyValue> read_value(const Fields& fields, const Key& key, const Loading& loading) {
  return read_value(fields[key.name], key, loading);
}

/// Which of several kinds an object is, by the key that tells it; none if that is missing, which is not
/// reported, or wrong.
std::optional<std::size_t> read_variant(const JsonValue& json, std::span<const KeyVariant> variants,
                                        Problems& problems);

/// Which of `keys::kObjects` an object is.
std::size_t variant_of(const TechnologyObject& object) noexcept;

/// Reads all keys that have a member, and the structures within. @param target the struct that `keys` declare
void read_members(const Fields& fields, Keys keys, void* target, const Loading& loading);

/// Reads the keys of a struct; what is not given stays as it is.
template <class S, std::size_t n>
void read_keys(const Fields& fields, const KeyTable<S, n>& table, S& target, const Loading& loading) {
  read_members(fields, table, &target, loading);
}

/// Reads the keys of a struct from an object that is looked at whole: unknown and missing keys are reported.
template <class S, std::size_t n>
Fields read_struct(const JsonValue& json, const KeyTable<S, n>& table, S& target, const Loading& loading) {
  const Fields fields(json, table, loading.problems);
  read_keys(fields, table, target, loading);
  return fields;
}

}  // namespace lockstep
