#include "projects/loader/mco305_panel.hpp"

#include "scheduler/mco305/mco305.hpp"

namespace lockstep {

void expect_writes(const Operand& place) noexcept {
  if (place.object != nullptr && place.object->kind == ObjectKind::MCO_305)
    static_cast<Mco305*>(place.object)->expect_writes_at(place.signal.address);
}

}  // namespace lockstep
