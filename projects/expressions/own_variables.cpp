#include "projects/expressions/own_variables.hpp"

#include "scheduler/mco305/mco305.hpp"

namespace lockstep {

std::span<const OwnVariable> own_variables(const TechnologyObject& object) noexcept {
  if (object.kind != ObjectKind::MCO_305) return {};
  return static_cast<const Mco305&>(object).own_variables();
}

void expect_reads(TechnologyObject& object, const Variable& variable) noexcept {
  if (object.kind == ObjectKind::MCO_305) static_cast<Mco305&>(object).expect_reads(variable);
}

void bring_up_to_date(TechnologyObject& object) noexcept {
  if (object.kind == ObjectKind::MCO_305) static_cast<Mco305&>(object).bring_up_to_date();
}

}  // namespace lockstep
