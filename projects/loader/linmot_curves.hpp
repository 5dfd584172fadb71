/// The curves of a LinMot controller.
#pragma once

#include "projects/loader/loader.hpp"

namespace lockstep {

/// Index of a motor by its letter, A to D; 4: there is none.
std::size_t linmot_motor(std::string_view name) noexcept;

/// Makes the curves; whatever is wrong with one is reported, and warned of what makes it a bad one.
void load_linmot_curves(const JsonValue& json, LinMotController& controller, const Loading& loading);

/// When motors and state table are there: warns of curves that the motors which run them cannot follow, and
/// of those that step where they begin anew.
void warn_of_linmot_curves(const JsonValue& json, const LinMotController& controller, const Loading& loading);

/// What makes a curve a bad one whoever runs it, each in a sentence.
std::vector<std::string> curve_findings(const linmot::Curve& curve,
                                        const std::vector<linmot::CurvePart>& parts);
/// What of it steps when it is run again and again; empty: nothing.
std::string cyclic_finding(const linmot::Curve& curve);
/// Why a motor cannot follow it as its parameters are; empty: it can, or nothing is known of it.
std::string force_finding(const LinMotController& controller, std::size_t motor, const linmot::Curve& curve);

}  // namespace lockstep
