/// What can be said of traces beyond their rows: spectra, one signal over another, two runs compared.
#pragma once

#include <cstdint>

#include "hmi_bridge/traces/store.hpp"
#include "projects/studio/api.hpp"
#include "projects/studio/trace_part.hpp"

namespace lockstep::studio_api {

inline constexpr std::uint64_t kSpectrumRows = 4'194'304;
inline constexpr std::size_t kSpectrumValues = 8192;        ///< that are told
inline constexpr std::uint64_t kComparedRows = 10'000'000;  ///< rows times signals

/// `GET …/spectrum?signal&window&order`. @throws BadRequest
StudioAnswer spectrum_answer(const StudioRequest& request, const TraceStore& store, const TracePart& part);
/// `GET …/xy?x&y&points&shift`: the rows of `store` with what `other` has for y at the same time.
/// @throws BadRequest
StudioAnswer xy_answer(const StudioRequest& request, const TraceStore& store, const TraceStore& other);
/// `GET /api/compare?…`: `b` is shifted by `shift`. @throws BadRequest
StudioAnswer compare_answer(const StudioRequest& request, const TraceStore& a, const TraceStore& b);

}  // namespace lockstep::studio_api
