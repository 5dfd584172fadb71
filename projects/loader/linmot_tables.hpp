/// State table, input table and data modules of a LinMot controller.
#pragma once

#include "projects/loader/loader.hpp"

namespace lockstep {

void load_state_table(const JsonValue& json, LinMotController& controller, const Loading& loading);
/// When the state table is there.
void load_input_table(const JsonValue& json, LinMotController& controller, const Loading& loading);
void load_linmot_profibus(const JsonValue& json, LinMotController& controller, const Loading& loading);

}  // namespace lockstep
