/// The keys of what a project is put together from: files that it includes, templates and their instances.
#pragma once

#include "projects/json/key.hpp"

namespace lockstep::keys {

inline constexpr auto kSchema = key::text("$schema", "where the schema of the file is, for editors");
inline constexpr auto kInclude =
    key::title("include", "files with further parts, relative to this one and within the project's folder")
        .list();

/// What a part of a project may hold, of which the project has the whole.
inline constexpr auto kPartMap = key_table<void>(
    key::defined("map", "list_of_parts", "list", "entries behind those of the project's map").needed());
inline constexpr auto kPartSignals = key_table<void>(
    key::defined("signals", "list_of_parts", "list", "columns behind those of the project's trace").needed());
inline constexpr auto kPartObjects =
    key::defined("technology_objects", "named_parts", "{ name: object }", "name: technology object");
inline constexpr auto kPartAreas = key::defined("transfer_areas", "named_parts", "{ name: transfer area }",
                                                "name: path of a leading value to proxies");
inline constexpr auto kPartTags = key::defined("tags", "named_parts", "{ name: tag }", "name: tag");
inline constexpr auto kPartPrograms = key::defined("programs", "list_of_parts", "[ program, … ]", "programs");
inline constexpr auto kPartStimuli =
    key::defined("stimuli", "list_of_parts", "[ stimulus, … ]", "changes of tags in a simulation");
inline constexpr auto kPartExpectations =
    key::defined("expectations", "list_of_parts", "[ expectation, … ]", "what lockstep test looks at");
inline constexpr auto kPartModbus =
    key::structure("modbus", kPartMap, "entries of the project's map of all unit ids");
inline constexpr auto kPartTrace = key::structure("trace", kPartSignals, "columns of the project's trace");

inline constexpr auto kParameter = key_table<void>(key::defined(
    "default", "parameter_value", "number, text, true or false", "what it is if the instance does not say"));
inline constexpr auto kTemplate = key_table<void>(
    key::structure("parameters", kParameter, "name of a parameter: its default").named(), kPartObjects,
    kPartAreas, kPartTags, kPartPrograms, kPartStimuli, kPartExpectations, kPartModbus, kPartTrace);
inline constexpr auto kTemplates =
    key::structure("templates", kTemplate, "name: parts that several instances have").named();

inline constexpr auto kInstance = key_table<void>(
    key::text("template", "name of the template").needed(),
    key::text("name", "of the instance; parameter name of its template").needed(),
    key::defined("with", "parameter_values", "{ parameter: value }", "parameters of the template"),
    key::defined("for", "parameter_range", "{ parameter: [from, to] }",
                 "an instance for each whole number of a range"));
inline constexpr auto kInstances = key::structure("instances", kInstance, "of the templates").list();

/// A file that is included.
inline constexpr auto kPart =
    key_table<void>(kSchema, kInclude, kPartObjects, kPartAreas, kPartTags, kPartPrograms, kPartStimuli,
                    kPartExpectations, kPartModbus, kPartTrace, kTemplates, kInstances);

}  // namespace lockstep::keys
