/// The keys of a LinMot controller, and of the lines to such controllers.
#pragma once

#include "projects/keys/drive.hpp"
#include "tech_objects/linmot/ascii_line.hpp"
#include "tech_objects/linmot/controller.hpp"

namespace lockstep::keys {

inline constexpr ObjectKinds kLinMotController = static_cast<ObjectKinds>(ObjectKind::LinMot_Controller);

inline constexpr Word kCurveTypes[] = {
    {"Sine", static_cast<int>(linmot::CurveType::sine)},
    {"Point To Point", static_cast<int>(linmot::CurveType::point_to_point)},
    {"Minimal Jerk", static_cast<int>(linmot::CurveType::minimal_jerk)},
    {"Limited Jerk", static_cast<int>(linmot::CurveType::limited_jerk)},
    {"Manual", static_cast<int>(linmot::CurveType::manual)}};
inline constexpr Word kJerkLaws[] = {{"peak", static_cast<int>(linmot::JerkLaw::peak)},
                                     {"quintic", static_cast<int>(linmot::JerkLaw::quintic)}};
inline constexpr Range kTravel{-2520.0, 2520.0};  // [mm]

inline constexpr auto kCurvePart = key_table<linmot::CurvePart>(
    key::word<&linmot::CurvePart::type>("type", kCurveTypes, "how it is made"),
    key::word<&linmot::CurvePart::law>("law", kJerkLaws,
                                       "of Minimal Jerk: smallest maximum of the jerk, or of the sum of its "
                                       "squares"),
    key::number<&linmot::CurvePart::start>("start", kTravel, "mm", "where it begins"),
    key::number<&linmot::CurvePart::end>("end", kTravel, "mm", "where it ends"),
    key::duration<&linmot::CurvePart::time>("time", {1e6, 1e12}, "of Sine and Minimal Jerk"),
    key::number<&linmot::CurvePart::speed>("speed", {0.0, 100.0}, "m/s",
                                           "at most, of Point To Point and Limited Jerk"),
    key::number<&linmot::CurvePart::acceleration>("acceleration", {0.0, 1e5}, "m/s²", "the same"),
    key::number<&linmot::CurvePart::jerk>("jerk", {0.0, 1e9}, "m/s³",
                                          "of Limited Jerk; 0: acceleration²/speed"),
    key::defined("points", "linmot_points", "list of [ms, mm]",
                 "of Manual; a natural cubic spline goes through them"));
inline constexpr auto kCurve = joined(
    kCurvePart,
    key_table<linmot::CurvePart>(
        key::structure("parts", kCurvePart, "several in a row, in place of what else makes a curve").list(),
        key::text("file", "CSV file beside the project with ms;mm in its lines, in place of points")));

inline constexpr auto kLinMotThermal = key_table<linmot::ThermalSettings>(
    key::number<&linmot::ThermalSettings::nominal_current>("nominal_current", kAboveZero, "A",
                                                           "that the motor bears for ever: 100 %")
        .needed(),
    key::duration<&linmot::ThermalSettings::time_constant>(
        "time_constant", {1e9, 1e14}, "of its temperature behind the square of the current"),
    key::number<&linmot::ThermalSettings::warn>("warn", {0.0, 1e4}, "%", "above which there is a warning"),
    key::number<&linmot::ThermalSettings::error>("error", {0.0, 1e4}, "%", "above which there is an error"));

inline constexpr auto kLinMotMotor = key_table<linmot::MotorSettings>(
    key::number<&linmot::MotorSettings::force_constant>("force_constant", kAboveZero, "N/A", "of the motor")
        .needed(),
    key::number<&linmot::MotorSettings::plant, &LinearMotorPlantSettings::slider_mass>(
        "slider_mass", kAboveZero, "kg", "of the slider")
        .needed(),
    key::number<&linmot::MotorSettings::plant, &LinearMotorPlantSettings::load_mass>(
        "load_mass", kNotNegative, "kg", "of what it carries"),
    key::number<&linmot::MotorSettings::plant, &LinearMotorPlantSettings::friction>(
        "friction", kNotNegative, "N", "dry, against every motion"),
    key::number<&linmot::MotorSettings::plant, &LinearMotorPlantSettings::inclination>(
        "inclination", {-90.0, 90.0}, "°", "90: out of the motor is straight upwards"),
    key::tag<&linmot::MotorSettings::plant, &LinearMotorPlantSettings::external_force>(
        "external_force", "LREAL tag: pushes besides [N]", Type::LREAL),
    key::structure<&linmot::MotorSettings::plant, &LinearMotorPlantSettings::spring>(
        "spring", kCentringSpring, "always in force"),
    key::structure<&linmot::MotorSettings::plant, &LinearMotorPlantSettings::stops>(
        "fixed_stops", kDampedStop, "something immovable in the way")
        .list(),
    key::structure<&linmot::MotorSettings::thermal>(
        "thermal", kLinMotThermal, "calculates Drive Too Hot Calculated; without it that never is"),
    key::number<&linmot::MotorSettings::start_position>("start_position", kTravel, "mm",
                                                        "where the slider stands at the start"),
    key::text("type", "that it really is; another than the configured one is an error at the start")
        .otherwise_is("the configured one"));

inline constexpr auto kLinMotWiring = key_table<void>(
    key::tag("RUN", "BOOL tag: input"), key::tag("INIT", "BOOL tag: input"),
    key::tag("FREEZE", "BOOL tag: input"), key::tag("STOP", "BOOL tag: input"),
    key::tag("TRIG A", "BOOL tag: input"), key::tag("TRIG B", "BOOL tag: input"),
    key::tag("TRIG C", "BOOL tag: input"), key::tag("TRIG D", "BOOL tag: input"),
    key::tag("ANALOG A", "LREAL tag: input [V]", Type::LREAL),
    key::tag("ANALOG B", "LREAL tag: input [V]", Type::LREAL),
    key::tag("ANALOG C", "LREAL tag: input [V]", Type::LREAL),
    key::tag("ANALOG D", "LREAL tag: input [V]", Type::LREAL), key::tag("OUT 1", "BOOL tag: WARNING"),
    key::tag("OUT 2", "BOOL tag: ERROR"), key::tag("OUT 3", "BOOL tag: POS ERR, or as configured"),
    key::tag("OUT 4", "BOOL tag: MSG, or as configured"));

inline constexpr auto kLinMotMotorFaults = key_table<linmot::MotorSettings>(
    key::tag<&linmot::MotorSettings::slider_missing>("slider_missing",
                                                     "BOOL tag: while TRUE the slider is not there"),
    key::tag<&linmot::MotorSettings::too_hot>("too_hot",
                                              "BOOL tag: while TRUE its sensor says that it is too hot"));
inline constexpr auto kLinMotFaults = key_table<linmot::Wiring>(
    key::tag<&linmot::Wiring::power_voltage>("power_voltage", "LREAL tag: power supply [V]", Type::LREAL),
    key::tag<&linmot::Wiring::signal_voltage>("signal_voltage", "LREAL tag: signal supply [V]", Type::LREAL),
    key::tag<&linmot::Wiring::heat_sink_hot>("heat_sink_hot", "BOOL tag: the heat sink is above 70 °C"),
    key::structure("A", kLinMotMotorFaults, "of this motor"),
    key::structure("B", kLinMotMotorFaults, "of this motor"),
    key::structure("C", kLinMotMotorFaults, "of this motor"),
    key::structure("D", kLinMotMotorFaults, "of this motor"));

inline constexpr auto kLinMotProfibus = key_table<void>(
    key::text("modules", "names of the data modules in their order; Control/Status is the first")
        .list()
        .needed(),
    key::text("address", "two hexadecimal figures, 00 to 7D; EE: the motors repeat their curves")
        .otherwise_is("none"),
    key::constant("preset", "module: what its word is at the start; that of every motor that has it")
        .named());

inline constexpr auto kLinMot = key_table<void>(
    key::selector("type", "published type"),
    key::text("hardware", "which controller it is, such as E400-MT").otherwise_is("all functions, version 3"),
    key::duration("control_cycle", {1e3, 1e9}, "of the position loops; 1 to 256 of them are a servo cycle")
        .otherwise_is("100us"),
    key::defined("config", "linmot_config", "parameters",
                 "the parameters by their printed names, in their directories (describe LinMot_Controller)"),
    key::structure("motors", kLinMotMotor, "A to D: what is really there; others follow their set-points")
        .named(),
    key::structure("curves", kCurve, "1 to 63: motion curves").named(),
    key::defined("state_table", "linmot_state_table", "rows",
                 "0 to 63: what each motor does, such as { \"A\": { \"Curve\": [1] } }; or file: a CSV file "
                 "beside the "
                 "project"),
    key::defined("input_table", "linmot_input_table", "codes",
                 "active_inputs, active_triggers, and what a code such as 0010 does"),
    key::structure("io", kLinMotWiring, "tags that are inputs and outputs"),
    key::structure("faults", kLinMotFaults, "what goes wrong, and when"),
    key::structure("profibus", kLinMotProfibus, "the process image of Command Interface PROFIBUS"));

inline constexpr Word kLineModes[] = {{"RS232", static_cast<int>(linmot::AsciiLine::Mode::rs232)},
                                      {"RS485", static_cast<int>(linmot::AsciiLine::Mode::rs485)}};
inline constexpr auto kAsciiLine = key_table<linmot::AsciiLine>(
    key::word<&linmot::AsciiLine::mode>("mode", kLineModes, "one controller, or up to six"),
    key::boolean<&linmot::AsciiLine::pace>(
        "pace", "characters take their time, as with 9600 baud: answers of stimuli come later by that"),
    key::object("controllers", kLinMotController, "1 to 6: LinMot controller").named().needed());
inline constexpr auto kScriptedCommand =
    key_table<void>(key::integer("line", {0, 31}, "index of the line in 'ascii'").otherwise_is("0"),
                    key::text("send", "command without its end, such as !SP2560A").needed());

}  // namespace lockstep::keys
