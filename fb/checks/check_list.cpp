// The one list of checks: a block with something to check is a line here.
#include <algorithm>

#include "fb/checks/block_checks.hpp"
#include "fb/checks/cam_in_check.hpp"
#include "fb/checks/copy_cam_data_check.hpp"

namespace lockstep {
namespace {

constexpr BlockChecks kChecks[] = {
    {.block = MC_CamIn::kName, .one = check_cyclic_cam, .all = check_cam_exchanges},
    {.block = MC_CopyCamData::kName, .one = check_copied_elements},
};

}  // namespace

std::span<const BlockChecks> block_checks() noexcept {
  return kChecks;
}

const BlockChecks* checks_of(const BlockType& type) noexcept {
  const auto* const found =
      std::find_if(std::begin(kChecks), std::end(kChecks),
                   [&](const BlockChecks& checks) { return checks.block == type.name; });
  return found == std::end(kChecks) ? nullptr : found;
}

}  // namespace lockstep
