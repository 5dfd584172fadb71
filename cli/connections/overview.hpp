/// lockstep connections: the overview as text, as JSON and as a picture.
#pragma once

#include <cstddef>
#include <string>

#include "projects/system/connections.hpp"

namespace lockstep::cli {

/// What is to be shown of an overview.
struct OverviewOptions {
  std::string filter{};   ///< rows in which a name has this, without regard to case; empty: all
  bool local = false;     ///< couplings within a controller too
  bool delays = true;     ///< delay times
  bool computed = false;  ///< those that are computed beside them
  std::string routes{};   ///< of the axis CONTROLLER.AXIS; empty: none
};

/// Whether a row is shown.
bool is_shown(const System& system, const Interconnection& row, const OverviewOptions& options);

/// What is to be said of an interconnection, such as "recursive"; "" for nothing.
std::string remark_of(const Connections& connections, const Interconnection& row);

/// A delay in ms, such as "12 ms".
std::string milliseconds_text(double seconds);

std::string overview_text(const System& system, const Connections& connections,
                          const OverviewOptions& options, std::size_t width);
std::string overview_json(const System& system, const Connections& connections,
                          const OverviewOptions& options);
std::string overview_svg(const System& system, const Connections& connections,
                         const OverviewOptions& options);

/// The axis that options ask routes of; nullptr with a text that says what is wrong.
const LeadingObject* axis_of_routes(const System& system, const std::string& name, std::string& problem);

}  // namespace lockstep::cli
