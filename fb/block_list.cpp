// The one list of function blocks: a new block is its file pair, its test and one line here.
#include "fb/bistable.hpp"
#include "fb/block.hpp"
#include "fb/counters.hpp"
#include "fb/edge.hpp"
#include "fb/timers.hpp"

namespace lockstep {
namespace {

// One block a line:
// clang-format off
constexpr BlockType kTypes[] = {
    block_type<R_TRIG>(),
    block_type<F_TRIG>(),
    block_type<SR>(),
    block_type<RS>(),
    block_type<TON>(),
    block_type<TOF>(),
    block_type<TP>(),
    block_type<CTU>(),
    block_type<CTD>(),
    block_type<CTUD>(),
};
// clang-format on

}  // namespace

std::span<const BlockType> block_types() noexcept {
  return kTypes;
}

}  // namespace lockstep
