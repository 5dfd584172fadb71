/// The names of a project and the one path syntax by which values are reached:
/// `tag`, `instance.Pin`, `Object.Variable.Path[1]`, and a bit of any of them with `.Xn`.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <variant>
#include <vector>

#include "fb/block.hpp"
#include "projects/expressions/compiler.hpp"
#include "scheduler/controller.hpp"
#include "tech_objects/objects/technology_object.hpp"
#include "tech_objects/types/declaration.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// What is wrong with a name as an identifier of IEC 61131-3, and what is allowed; empty if nothing is.
std::string identifier_problem(std::string_view name);

/// The published names of kinds, for messages: "TO_PositioningAxis, TO_SynchronousAxis".
std::string kind_names(ObjectKinds kinds);

/// A value of the project, found by its path. Exactly one of tag, array, pin and variable is set.
struct Operand {
  Signal signal;
  Unit unit = Unit::kNone;
  const Tag* tag = nullptr;
  const ArrayTag* array = nullptr;  ///< of which it is an element
  const Pin* pin = nullptr;
  const Variable* variable = nullptr;
  TechnologyObject* object = nullptr;  ///< whose variable it is
  const Instance* instance = nullptr;  ///< whose pin it is
  ElementRange elements{};             ///< of a path with "[]": `signal` is the first of them
};

/// A place, or what is wrong with the path.
struct FoundOperand {
  std::optional<Operand> place;
  std::string problem;         ///< what is wrong, what is allowed; empty if there is a place
  bool known_problem = false;  ///< the path leads to something whose declaration has been reported already
};

/// Why a program may not write there at run time; empty if it may.
std::string why_not_writable(const Operand& place);

/// Why a program may not change the start value of what is there; empty if it may.
std::string why_no_start_value(const Operand& place);

/// The names of tags, instances and technology objects; they share one name space without regard to case.
/// What is named has to stay where it is. Looking up writes nothing (but that somebody may read it now, see
/// own_variables.hpp), so that any number of threads may do it at once, while nobody adds or records.
class Names final : public Scope {
 public:
  /// What a name stands for; monostate: something whose declaration is faulty.
  using Entity = std::variant<std::monostate, const Tag*, const ArrayTag*, const StringTag*, const Instance*,
                              TechnologyObject*>;

  /// What has been asked for, and what may still be spent on hints.
  struct Uses {
    std::unordered_set<std::string> names;  ///< folded
    int suggestions_left = 100;             ///< looking for the nearest of many names takes its time
  };
  /// From now on each look-up is recorded there: while a project is loaded, by the one thread that loads it.
  /// nullptr: no more.
  void record(Uses* uses) noexcept { uses_ = uses; }

  /// Adds a name. A name that is added twice stands for something faulty from then on.
  /// @return what is wrong with it: no identifier, or taken already; empty if nothing is.
  std::string add(std::string_view name, Entity entity);
  /// Tells what a name stands for that was added as faulty, unless it was added twice.
  void define(std::string_view name, Entity entity);

  /// What a name stands for; nullptr: there is no such name.
  const Entity* find_entity(std::string_view name) const;
  /// The technology object of a name, or what is wrong.
  struct FoundObject {
    TechnologyObject* object = nullptr;
    std::string problem;  ///< empty if there is an object, or if the problem is known already
  };
  /// @param kinds that are allowed
  FoundObject find_object(std::string_view name, ObjectKinds kinds) const;

  /// The array of a name, or what is wrong.
  struct FoundArray {
    const ArrayTag* array = nullptr;
    std::string problem;  ///< empty if there is an array, or if the problem is known already
  };
  FoundArray find_array(std::string_view name) const;

  /// The tag of type STRING with a name; nullptr: the name is none of one. Elsewhere such a tag is no place:
  /// it has no value of an elementary type.
  const StringTag* find_string(std::string_view name) const;

  /// The place to which a path leads, in any case.
  FoundOperand find(std::string_view path) const;
  /// The place to which a path leads whose index may be missing, as in "points[].x": then the place tells
  /// what it may choose from.
  FoundOperand find_elements(std::string_view path) const;

  /// For the compiler of expressions.
  Reference resolve(std::string_view name, std::string_view path) const override;
  /// What `resolve` says of something whose declaration has been reported already.
  static constexpr std::string_view kKnownProblem = "(its declaration is faulty)";

 private:
  struct Entry {
    std::string name;
    Entity entity;
    bool ambiguous = false;
  };

  const Entry* entry(std::string_view name) const;
  FoundOperand find_within(const Entry& entry, std::string_view path) const;
  FoundOperand unknown(std::string_view name) const;
  std::string nearest_name(std::string_view name) const;

  std::unordered_map<std::string, Entry> entries_;  // by folded name
  Uses* uses_ = nullptr;                            // of the loader
};

}  // namespace lockstep
