#include "tech_objects/linmot_catalogue/errors.hpp"

namespace lockstep::linmot {
namespace {

constexpr ErrorRow kErrors[] = {
    {"DCLV Power Too Low", false, 2, 1, 9, 0x0010, "", "power-stage supply below error threshold"},
    {"DCLV Power Too High", false, 3, 2, 10, 0x0011, "",
     "power-stage supply above error threshold (e.g. braking energy)"},
    {"DCLV Signal Too Low", false, 4, 3, 11, 0x0012, "", "logic supply below error threshold"},
    {"DCLV Signal Too High", false, 5, 4, 12, 0x0013, "", "logic supply above error threshold"},
    {"Electronic Fault", false, 6, 5, 13, 0x0014, "",
     "heat sink > 70 degrees C (error 5 s after the warning) or motor-phase short (E100: temperature only)"},
    {"Internal 12 V missing", false, 7, -1, -1, 0x0015, "", "internal 12 V rail missing"},
    {"Drive Too Hot Calculated", true, 1, 0, 0, 0x01, "Drive Too Hot Calculated",
     "calculated motor temperature: short-time overload (blocked/overloaded motor, too fast profile)"},
    {"Drive Too Hot Sensor", true, 2, 1, 1, 0x02, "", "measured motor temperature"},
    {"Drive Following Error", true, 3, 2, 2, 0x03, "Drive Following Error",
     "demand minus actual outside Following Error-/+"},
    {"Slider Missing", true, 4, 3, 3, 0x04, "",
     "slider absent / too far out / wrong way round; external sensor head gap or tape damage"},
    {"Slave Error", true, 0, -1, 4, 0, "", "error at a booster or gantry slave"},
    {"Init Failed", true, 6, 5, 5, 0x06, "",
     "initialisation not completed (stop not found, check travel blocked)"},
    {"Drive Type Mismatch", true, 7, 6, 6, 0x07, "",
     "connected type differs from the configured one or motor defective"},
    {"Curve Error / Curve Missing", true, 8, 7, 7, 0x08, "",
     "profile missing or made for another actuator type"},
    {"Overcurrent", true, 9, -1, -1, 0x09, "", "overcurrent in the motor channel (wiring, phase short)"},
    {"Channel overtemperature", true, 10, -1, -1, 0x0A, "", "motor channel in the controller too hot"},
    {"Channel fuse", true, 11, -1, -1, 0x0B, "", "fuse on AGND or 5 VDC of the channel blown"},
    {"Application Error", false, 0, -1, 15, 0x8002, "",
     "interface-specific error, e.g. PROFIBUS data out of range"},
};

constexpr WarningRow kWarnings[] = {
    {"Motor hot calculated", 0, -1, 0, "calculated temperature high"},
    {"Motor hot sensor", 1, -1, 1, "measured temperature high"},
    {"Following Error", 2, -1, 2, "following error"},
    {"Slider Missing", 3, -1, 3, "slider or sensor problem"},
    {"Slave Warning", -1, -1, 4, "warning at a booster or gantry slave"},
    {"Init not done", 6, -1, 6, "not (correctly) initialised"},
    {"Motor outside position range", 8, -1, 8, "actual position outside Pos Range Min/Max"},
    {"Low Free Capacity", -1, -1, 8, "system resources short"},
    {"DCLV Power low", -1, 1, 9, "power supply low"},
    {"DCLV Power high", -1, 2, 10, "power supply high"},
    {"DCLV Signal low", -1, 3, 11, "signal supply low"},
    {"DCLV Signal high", -1, 4, 12, "signal supply high"},
    {"Electronic Fault", -1, 5, 13, "heat sink > 70 C or phase short"},
    {"Emergency Stop", -1, -1, 14, "controller is in emergency stop"},
    {"In Position (Warn Mask)", -1, -1, -1, "demand position reached"},
};

constexpr AnswerCode kAnswerCodes[] = {
    {50, "command not possible in WAIT FOR DISABLE"},
    {51, "command not possible in DISABLE"},
    {52, "command not possible in INIT"},
    {53, "command not possible in ERROR"},
    {54, "command not possible in RUN"},
    {55, "internal error"},
    {56, "wrong controller or motor: in RS232 mode only controller 1 and motors A-D"},
    {57, "selected motor not present or type No Drive"},
    {58, "unknown command"},
    {59, "wrong command format"},
    {60, "sign error"},
    {61, "RUN/INIT/FREEZE/STOP flag is owned by a digital input enabled in IO Configuration"},
    {62, "profile not on the controller"},
    {63, "profile was made for another motor type"},
    {64, "value out of range"},
    {65, "command too long"},
    {66, "motor not in run mode Serial"},
    {67, "command not allowed on slave motors"},
    {68, "command not possible with this motor type"},
};

}  // namespace

std::span<const ErrorRow> errors() noexcept {
  return kErrors;
}
std::span<const WarningRow> warnings() noexcept {
  return kWarnings;
}
std::span<const AnswerCode> answer_codes() noexcept {
  return kAnswerCodes;
}

}  // namespace lockstep::linmot
