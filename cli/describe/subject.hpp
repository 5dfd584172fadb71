/// What `lockstep describe` can tell about: each subject as a text for people and as JSON for programs.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fb/block.hpp"
#include "tech_objects/alarms/alarms.hpp"
#include "tech_objects/data_blocks/variable.hpp"

namespace lockstep {
struct Key;
}  // namespace lockstep

namespace lockstep::cli {

/// Something that can be described; the form is made when it is asked for.
struct Subject {
  std::function<std::string(std::size_t width)> text;  ///< `width` in columns
  std::function<nlohmann::ordered_json()> json;

  explicit operator bool() const noexcept { return text != nullptr; }
};

/// What there is to describe.
Subject overview();
/// Names that people ask for: topics, blocks, objects, functions, operators in words, types.
std::vector<std::string> describable_names();

/// A function block, or one pin of it. @param pin nullptr: all
Subject block_subject(const BlockType& type, const Pin* pin);

/// The variables of a type of technology object that a path names: all for an empty one, a structure
/// (`DynamicLimits`), one variable, or a bit of it (`StatusWord.X22`), without regard to case.
/// @param object published name of the type; empty: the path stands alone
/// @return an empty subject if the path names nothing
Subject variables_subject(std::string_view object, std::string_view path);
/// Paths of all variables and structures, for suggestions.
std::vector<std::string_view> variable_names();

Subject alarms_subject();
Subject alarm_subject(const Alarm& alarm);
Subject errors_subject();
Subject error_subject(ErrorId id);

/// The instructions that stand in the override tables, and how one of them acts on running jobs.
Subject overrides_subject();
/// @return an empty subject if the instruction stands in no table
Subject override_subject(std::string_view instruction);
std::vector<std::string_view> override_names();

/// The keys of the project file that stand at a path, without regard to case: of a structure
/// (`technology_objects.drive.plant`), or one (`clock.servo_cycle`); for an empty one all structures.
/// @return an empty subject if the path names nothing
Subject keys_subject(std::string_view path);
/// Paths of all structures and keys, for suggestions.
std::vector<std::string> key_paths();
/// The one that every object may have, which stands in no table of them.
const Key& comment_key();

/// The standard functions, operators and types of expressions.
Subject functions_subject();
Subject operators_subject();
Subject types_subject();
/// A function, a conversion (`TO_INT`), an operator or a type, without regard to case.
/// @return an empty subject if the word is none of them
Subject language_subject(std::string_view word);
/// What other languages write, such as NORM_X: what is written here in its place.
Subject habit_subject(std::string_view word);
/// Their names, for suggestions.
std::vector<std::string_view> language_names();

/// A parameter of an MCO 305 by mnemonic or number (`KPROP`, `32-60`, `1900`), a command of APOSS, an error
/// by its number, a system variable by its index; each an empty subject if there is none.
Subject mco305_parameter_subject(std::string_view name);
Subject mco305_command_subject(std::string_view name);
Subject mco305_error_subject(std::string_view number);
std::vector<std::string> mco305_error_numbers();
Subject mco305_system_variable_subject(std::string_view index);
/// What one or two words name of them: `POSA`, `DEF ORIGIN`, `108`, `error 108`, `sysvar 4097`.
Subject mco305_subject(const std::vector<std::string>& words);
/// All of them, for the search.
struct Mco305Finding {
  std::string_view kind;
  std::string name;  ///< by which `describe` tells more
  std::string text;
};
std::vector<Mco305Finding> mco305_findings();

/// Of a LinMot controller: `ASCII`, `ASCII SP`, `MT Freeze`, `PROFIBUS "Run Curve"`, `LinMot_Controller "Max
/// Speed"`; an empty subject if the words name none of these.
Subject linmot_subject(const std::vector<std::string>& words);

/// The subject that the words of the command line name; an empty one if they name none.
/// @param problem then gets what is wrong, with a suggestion
Subject find_subject(const std::vector<std::string>& words, std::string& problem);

/// What `describe WORD … --json` prints of words between slashes; none: they name nothing.
std::optional<std::string> describe_as_json(std::string_view words);

}  // namespace lockstep::cli
