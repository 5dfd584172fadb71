/// What a project consists of, for a page: its parts, and every path that leads to a value.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "projects/loader/project.hpp"
#include "projects/studio/units.hpp"

namespace lockstep {

/// A value that can be asked for.
struct StudioSignal {
  std::string path;
  std::string type;
  std::string unit;
  std::string text;              ///< meaning
  std::string why_not_writable;  ///< empty: a program may write it
};

/// All of them, in the order of the project: tags, objects, instances. Arrays of more than `kElements`
/// elements are left out, for there is no end to cams; their elements are found by their path all the same.
std::vector<StudioSignal> studio_signals(const Project& project, const StudioUnits& units);
inline constexpr std::size_t kStudioElements = 64;

/// Those whose path or meaning has all the words of a text, in any case; those that are it first, then
/// those that begin with it.
std::vector<const StudioSignal*> find_studio_signals(const std::vector<StudioSignal>& signals,
                                                     std::string_view text, std::size_t limit);

/// The answer of `GET /api/project`, a JSON document.
std::string studio_project(const Project& project);

}  // namespace lockstep
