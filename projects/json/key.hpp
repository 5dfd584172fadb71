/// Declaration of the keys of a project file: one constexpr table per struct of configuration, from which
/// come the loader, its messages, the schema, the list in projects/KEYS.md and `lockstep describe keys`.
/// @source contract of the project file, section 1
#pragma once

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "projects/json/text_form.hpp"
#include "tech_objects/objects/technology_object.hpp"
#include "tech_objects/types/declaration.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// What may stand as the value of a key, or as each of several values.
enum class KeyKind : std::uint8_t {
  unspecified,  ///< said by whoever reads it
  boolean,
  integer,
  number,
  duration,   ///< such as "10ms"
  word,       ///< one of some words
  text,       ///< a string
  title,      ///< a string of 1 to `longest` bytes, all of which can be shown
  tag,        ///< the name of a tag of a type
  signal,     ///< a path: tag, instance.Pin, Object.Variable
  object,     ///< the name of a technology object
  positions,  ///< [from, to]
  constant,   ///< true, false, a number or a string that is one, or an expression
  structure,  ///< an object with keys of its own
  variants,   ///< an object whose keys depend on one of them
  selector,   ///< that one: names the variant
  defined     ///< as a definition of the schema has it
};

/// How often the value of a key may be there.
enum class KeyShape : std::uint8_t { one, list, one_or_list, named };

/// One word of an enumeration, and the value that it stands for.
struct Word {
  std::string_view word;
  std::int64_t value;
};

struct Key;
struct KeyVariant;

/// The keys of one kind of object.
using Keys = std::span<const Key>;

/// A value that has been read, as the kind of its key has it.
struct KeyValue {
  double number = 0.0;       ///< a number; a duration [s]
  std::int64_t integer = 0;  ///< an integer, 1 for true, what a word stands for, a duration [ns]
  double second = 0.0;       ///< of positions; the first is `number`
  std::string_view text{};
  void* address = nullptr;  ///< of a tag's value, or a `TechnologyObject*`
};

/// Of a text that can be shown, where its key says no other [byte].
inline constexpr std::size_t kLongestTitle = 128;

/// One key of an object.
struct Key {
  std::string_view name;
  bool required = false;
  KeyKind kind = KeyKind::unspecified;
  KeyShape shape = KeyShape::one;
  Range range = kAny;  ///< of a number, integer or duration [ns]; infinite ends: as far as its type goes
  std::size_t longest = kLongestTitle;  ///< of a title [byte]
  std::string_view unit{};
  std::string_view text{};         ///< meaning
  std::string_view otherwise{};    ///< what holds if it is not given; empty: the default of the member
  const TextForm* form = nullptr;  ///< of a text of which more is known
  std::span<const Word> words{};
  std::span<const int> numbers{};          ///< the integers that are allowed, where they are few
  Type type = Type::BOOL;                  ///< of a tag
  ObjectKinds objects = 0;                 ///< that it may name
  Keys keys{};                             ///< of a structure
  std::span<const KeyVariant> variants{};  ///< of which an object is one
  std::string_view definition{};           ///< under which the schema has it, so that it stands there once
  std::string_view what{};                 ///< what stands there, where that is defined elsewhere
  const void* member = nullptr;  ///< tells the member of the struct from others; nullptr: it has none
  const void* inner = nullptr;   ///< the same of the struct within it, where it is a member of that
  void (*store)(void* owner, const KeyValue& value) = nullptr;  ///< into the member
  void* (*part)(void* owner) = nullptr;  ///< the struct that a structure is read into; of a list one more
  std::optional<KeyValue> (*fresh)() = nullptr;  ///< the default: what a new struct has; none: nothing
};

/// The keys that an object has if its selector is a word.
struct KeyVariant {
  std::string_view name;
  Keys keys;
  std::string_view text{};
};

namespace keys {

inline constexpr bool kRequired = true;

/// Of every object whose keys are declared, without being among them.
inline constexpr Key kComment{.name = "comment", .kind = KeyKind::text, .text = "for the reader"};

}  // namespace keys

namespace key_detail {

template <class T>
struct MemberOf;
template <class T, class S>
struct MemberOf<T S::*> {
  using Value = T;
  using Owner = S;
};

/// What an optional holds, or a list.
template <class T>
struct Held {
  using Type = T;
};
template <class T>
struct Held<std::optional<T>> {
  using Type = T;
};
template <class T, class A>
struct Held<std::vector<T, A>> {
  using Type = T;
};

/// A member of a struct, or of a struct within it.
template <auto... Path>
struct MemberPath {
  using Owner = void;
};
template <auto First, auto... Rest>
struct MemberPath<First, Rest...> {
  using Owner = typename MemberOf<decltype(First)>::Owner;
  static auto& of(Owner& owner) {
    if constexpr (sizeof...(Rest) == 0)
      return owner.*First;
    else
      return MemberPath<Rest...>::of(owner.*First);
  }
  using Value = std::remove_reference_t<decltype(of(std::declval<Owner&>()))>;
};

/// Its address is that of no other member.
template <auto Member>
inline constexpr char kMemberMark{};

template <auto... Path>
struct Mark {
  static constexpr const void* kAddress = nullptr;
  static constexpr const void* kInner = nullptr;
};
template <auto First, auto... Rest>
struct Mark<First, Rest...> {
  static constexpr const void* kAddress = &kMemberMark<First>;
  static constexpr const void* kInner = Mark<Rest...>::kAddress;
};

template <class T>
inline constexpr bool kIsTime = false;
template <class R, class P>
inline constexpr bool kIsTime<std::chrono::duration<R, P>> = true;

template <class T>
void assign(T& member, const KeyValue& value) {
  using V = typename Held<T>::Type;
  if constexpr (kIsTime<V>)
    member = std::chrono::duration_cast<V>(std::chrono::nanoseconds(value.integer));
  else if constexpr (std::is_same_v<V, std::string>)
    member = std::string(value.text);
  else if constexpr (std::is_same_v<V, bool>)
    member = value.integer != 0;
  else if constexpr (std::is_enum_v<V> || std::is_integral_v<V>)
    member = static_cast<V>(value.integer);
  else if constexpr (std::is_floating_point_v<V>)
    member = value.number;
  else if constexpr (std::is_pointer_v<V> &&
                     std::is_base_of_v<TechnologyObject, std::remove_cv_t<std::remove_pointer_t<V>>>)
    member = static_cast<V>(static_cast<TechnologyObject*>(value.address));
  else if constexpr (std::is_pointer_v<V>)
    member = static_cast<V>(value.address);
  else
    member = V{value.number, value.second};
}

template <auto... Path>
void store(void* owner, const KeyValue& value) {
  assign(MemberPath<Path...>::of(*static_cast<typename MemberPath<Path...>::Owner*>(owner)), value);
}

template <auto... Path>
void* part(void* owner) {
  auto& member = MemberPath<Path...>::of(*static_cast<typename MemberPath<Path...>::Owner*>(owner));
  using M = std::remove_reference_t<decltype(member)>;
  using V = typename Held<M>::Type;
  if constexpr (std::is_same_v<M, V>)
    return &member;
  else if constexpr (std::is_same_v<M, std::optional<V>>)
    return &member.emplace();
  else
    return &member.emplace_back();
}

template <class T>
std::optional<KeyValue> shown(const T& member) {
  if constexpr (kIsTime<T>)
    return KeyValue{.integer = std::chrono::nanoseconds(member).count()};
  else if constexpr (std::is_enum_v<T> || std::is_integral_v<T>)
    return KeyValue{.integer = static_cast<std::int64_t>(member)};
  else if constexpr (std::is_floating_point_v<T>)
    return std::isfinite(member)
               ? std::optional(KeyValue{.number = member,
                                        .integer = std::abs(member) < 1e9
                                                       ? static_cast<std::int64_t>(std::round(member * 1e9))
                                                       : 0})
               : std::nullopt;
  else
    return std::nullopt;
}

template <auto... Path>
std::optional<KeyValue> fresh() {
  using Owner = typename MemberPath<Path...>::Owner;
  if constexpr (std::is_default_constructible_v<Owner>) {
    const auto made = std::make_unique<Owner>();
    return shown(std::as_const(MemberPath<Path...>::of(*made)));
  }
  return std::nullopt;
}

}  // namespace key_detail

/// A key of a struct; `void`: of any, since it has no member.
template <class S>
struct KeyOf : Key {
  using Owner = S;
  constexpr explicit KeyOf(Key key) : Key(key) {}

  constexpr KeyOf needed() const { return with(&Key::required, true); }
  constexpr KeyOf list() const { return with(&Key::shape, KeyShape::list); }
  constexpr KeyOf one_or_list() const { return with(&Key::shape, KeyShape::one_or_list); }
  /// An object of which each member is a name and a value.
  constexpr KeyOf named() const { return with(&Key::shape, KeyShape::named); }
  constexpr KeyOf up_to(std::size_t longest) const { return with(&Key::longest, longest); }
  constexpr KeyOf otherwise_is(std::string_view what) const { return with(&Key::otherwise, what); }
  constexpr KeyOf defined_as(std::string_view name) const { return with(&Key::definition, name); }
  constexpr KeyOf of_form(const TextForm& form) const { return with(&Key::form, &form); }
  constexpr KeyOf of(std::string_view other_unit) const { return with(&Key::unit, other_unit); }

 private:
  template <class T>
  constexpr KeyOf with(T Key::*member, T value) const {
    KeyOf changed = *this;
    changed.*member = value;
    return changed;
  }
};

/// The keys of a struct, in the order in which they are shown and read.
template <class S, std::size_t n>
struct KeyTable {
  std::array<Key, n> all;

  constexpr operator Keys() const { return all; }
  /// The key of a name, which has to be there.
  consteval const Key& operator[](std::string_view name) const {
    for (const Key& key : all)
      if (key.name == name) return key;
    throw "there is no such key";
  }
};

/// The table itself. No name and no member may be there twice.
template <class S, std::size_t n>
consteval KeyTable<S, n> checked(const KeyTable<S, n>& table) {
  for (std::size_t i = 0; i < table.all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (table.all[i].name == table.all[j].name) throw "a key is declared twice";
#ifndef __SANITIZE_ADDRESS__  // g++ 12 takes such a comparison for no constant where it sanitizes
      if (table.all[i].store != nullptr && table.all[i].store == table.all[j].store)
        throw "a member is declared twice";
#endif
    }
  return table;
}

/// Declares the keys of a struct. No name and no member may be there twice.
template <class S, class... K>
consteval KeyTable<S, sizeof...(K)> key_table(K... list) {
  static_assert(((std::is_same_v<typename K::Owner, S> || std::is_void_v<typename K::Owner>)&&...),
                "a key of another struct");
  return checked(KeyTable<S, sizeof...(K)>{{static_cast<const Key&>(list)...}});
}

/// The keys of two tables of a struct, one after the other. No name and no member may be there twice.
template <class S, std::size_t n, std::size_t m>
consteval KeyTable<S, n + m> joined(const KeyTable<S, n>& first, const KeyTable<S, m>& second) {
  KeyTable<S, n + m> table;
  for (std::size_t i = 0; i < n; ++i) table.all[i] = first.all[i];
  for (std::size_t i = 0; i < m; ++i) table.all[n + i] = second.all[i];
  return checked(table);
}

/// Each of these declares a key that is read into a member of a struct, or of one within it; without a member
/// it is read by whoever needs it.
namespace key {

template <auto... Path>
using KeyOfPath = KeyOf<typename key_detail::MemberPath<Path...>::Owner>;

template <auto... Path>
constexpr auto of(std::string_view name, KeyKind kind, std::string_view text) {
  Key key{.name = name,
          .kind = kind,
          .text = text,
          .member = key_detail::Mark<Path...>::kAddress,
          .inner = key_detail::Mark<Path...>::kInner};
  if constexpr (sizeof...(Path) > 0) {
    key.store = &key_detail::store<Path...>;
    key.fresh = &key_detail::fresh<Path...>;
  }
  return KeyOfPath<Path...>(key);
}

template <auto... Path>
constexpr auto boolean(std::string_view name, std::string_view text) {
  return of<Path...>(name, KeyKind::boolean, text);
}
template <auto... Path>
constexpr auto number(std::string_view name, Range range, std::string_view unit, std::string_view text) {
  auto made = of<Path...>(name, KeyKind::number, text);
  made.range = range;
  made.unit = unit;
  return made;
}
template <auto... Path>
constexpr auto integer(std::string_view name, Range range, std::string_view text) {
  auto made = of<Path...>(name, KeyKind::integer, text);
  made.range = range;
  return made;
}
/// An integer of a few.
template <auto... Path>
constexpr auto one_of(std::string_view name, std::span<const int> numbers, std::string_view text) {
  auto made = of<Path...>(name, KeyKind::integer, text);
  made.numbers = numbers;
  made.range = {static_cast<double>(numbers.front()), static_cast<double>(numbers.back())};
  return made;
}
/// @param range [ns]
template <auto... Path>
constexpr auto duration(std::string_view name, Range range, std::string_view text) {
  auto made = of<Path...>(name, KeyKind::duration, text);
  made.range = range;
  return made;
}
template <auto... Path>
constexpr auto word(std::string_view name, std::span<const Word> words, std::string_view text) {
  auto made = of<Path...>(name, KeyKind::word, text);
  made.words = words;
  return made;
}
template <auto... Path>
constexpr auto text(std::string_view name, std::string_view meaning) {
  return of<Path...>(name, KeyKind::text, meaning);
}
template <auto... Path>
constexpr auto title(std::string_view name, std::string_view meaning) {
  return of<Path...>(name, KeyKind::title, meaning);
}
/// The name of a tag: BOOL, or as the pointer says whose member it is.
template <auto... Path>
constexpr auto tag(std::string_view name, std::string_view text, Type type = Type::BOOL) {
  auto made = of<Path...>(name, KeyKind::tag, text);
  made.type = type;
  return made;
}
inline constexpr auto signal(std::string_view name, std::string_view text) {
  return of<>(name, KeyKind::signal, text);
}
template <auto... Path>
constexpr auto object(std::string_view name, ObjectKinds objects, std::string_view text) {
  auto made = of<Path...>(name, KeyKind::object, text);
  made.objects = objects;
  return made;
}
/// @param range of each of the two
template <auto... Path>
constexpr auto positions(std::string_view name, Range range, std::string_view text) {
  auto made = of<Path...>(name, KeyKind::positions, text);
  made.range = range;
  made.unit = "u";
  return made;
}
inline constexpr auto constant(std::string_view name, std::string_view text) {
  return of<>(name, KeyKind::constant, text);
}
/// An object with keys of its own.
template <auto... Path, class Table>
constexpr auto structure(std::string_view name, const Table& table, std::string_view text) {
  Key key{.name = name, .kind = KeyKind::structure, .text = text, .keys = table};
  key.member = key_detail::Mark<Path...>::kAddress;
  key.inner = key_detail::Mark<Path...>::kInner;
  if constexpr (sizeof...(Path) > 0) key.part = &key_detail::part<Path...>;
  return KeyOfPath<Path...>(key);
}
/// A structure of keys that are apart in the file and one struct in the program.
template <class S, class Table>
constexpr auto group(std::string_view name, const Table& table, std::string_view text) {
  Key made = structure(name, table, text);
  made.part = [](void* owner) { return owner; };
  return KeyOf<S>(made);
}
inline constexpr auto variants(std::string_view name, std::span<const KeyVariant> list,
                               std::string_view text) {
  auto made = of<>(name, KeyKind::variants, text);
  made.variants = list;
  return made;
}
/// What tells the variant.
inline constexpr auto selector(std::string_view name, std::string_view text) {
  return of<>(name, KeyKind::selector, text).needed();
}
/// What a definition of the schema has. @param what such as "a call"
inline constexpr auto defined(std::string_view name, std::string_view definition, std::string_view what,
                              std::string_view text) {
  auto made = of<>(name, KeyKind::defined, text).defined_as(definition);
  made.what = what;
  return made;
}

}  // namespace key
}  // namespace lockstep
