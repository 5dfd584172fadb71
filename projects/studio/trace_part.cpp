#include "projects/studio/trace_part.hpp"

#include <limits>

#include "projects/studio/api_values.hpp"

namespace lockstep::studio_api {

TracePart trace_part(const StudioRequest& request, const TraceStore& store) {
  if (store.end() == store.begin())
    throw BadRequest(416, "out_of_range", "there are no rows yet: nobody has asked for a signal");
  const std::int64_t from = whole_number(request, "from", store.t(store.begin()));
  const std::int64_t to = whole_number(request, "to", store.t(store.end() - 1));
  if (from > to) throw BadRequest(416, "out_of_range", "'from' has to be before 'to'");
  TracePart part{{}, store.row_at(from), store.end()};
  if (to < std::numeric_limits<std::int64_t>::max()) part.behind = store.row_at(to + 1);
  return part;
}

}  // namespace lockstep::studio_api
