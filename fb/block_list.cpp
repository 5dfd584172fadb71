// The one list of function blocks: a new block is its file pair, its test and one line here.
#include "fb/block.hpp"
#include "fb/edge.hpp"

namespace lockstep {
namespace {

constexpr BlockType kTypes[] = {
    block_type<R_TRIG>(),
    block_type<F_TRIG>(),
};

}  // namespace

std::span<const BlockType> block_types() noexcept {
  return kTypes;
}

}  // namespace lockstep
