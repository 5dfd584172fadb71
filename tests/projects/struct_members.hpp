/// How many members an aggregate has.
#pragma once

#include <cstddef>
#include <optional>
#include <type_traits>

namespace lockstep {

template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;

/// Stands for a value of any type; an optional takes what it may hold.
struct AnyMember {
  template <class T>
  requires(!kIsOptional<T>) operator T() const;
};

template <class T, class... Given>
constexpr std::size_t member_count() {
  if constexpr (requires { T{Given{}..., AnyMember{}}; })
    return member_count<T, Given..., AnyMember>();
  else
    return sizeof...(Given);
}

}  // namespace lockstep
