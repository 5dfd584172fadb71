/// The curves of a LinMot controller.
#pragma once

#include "projects/loader/loader.hpp"

namespace lockstep {

/// Index of a motor by its letter, A to D; 4: there is none.
std::size_t linmot_motor(std::string_view name) noexcept;

/// Makes the curves; whatever is wrong with one is reported, and warned of what makes it a bad one.
void load_linmot_curves(const JsonValue& json, LinMotController& controller, const Loading& loading);

/// What makes a curve a bad one, each in a sentence. @param maximum_acceleration that the motor can make
/// [m/s²]; 0: not known
std::vector<std::string> curve_findings(const linmot::Curve& curve,
                                        const std::vector<linmot::CurvePart>& parts, bool cyclic);

}  // namespace lockstep
