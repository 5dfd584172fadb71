#include "tech_objects/mco305_catalogue/system_variables.hpp"

namespace lockstep::mco305 {
namespace {

constexpr SystemVariable kSystemVariables[] = {
    {1, "input byte 0: inputs 1..8", "", true},
    {2, "input byte 1: drive inputs 18..33", "", true},
    {3, "input byte 2: inputs 9..10 (12)", "", true},
    {9, "output byte 0", "", true},
    {16, "counter of SSI errors (text of 32-02)", "", false},
    {17, "upper two bytes of STAT", "", true},
    {22, "milliseconds since power-up, as TIME", "ms", true},
    {28, "motor current", "1/100 A", false},
    {30, "motor voltage", "1/10 V", false},
    {31, "drive status (16-03)", "", true},
    {32, "main actual value (16-05)", "", true},
    {33, "line of the program that runs, with #DEBUG NOSTOP", "", true},
    {34, "motor frequency (16-13)", "", false},
    {35, "motor torque (16-16)", "", true},
    {4096, "actual position of the slave", "qc", true},
    {4097, "set position of the slave", "qc", true},
    {4098, "last index or marker position of the slave", "qc", true},
    {4099, "actual velocity over the window of _GETVEL", "qc/st", true},
    {4100, "velocity of the master over the window of _GETVEL", "qc/st", true},
    {4101, "following error", "qc", true},
    {4102, "turns of the slave's absolute encoder since the first overflow", "", false},
    {4103, "turns of the master's absolute encoder since the first overflow", "", false},
    {4105, "master position; may be written while the master is simulated (MENCODERTYPE [5])", "qc", true},
    {4106, "last index or marker position of the master", "qc", true},
    {4107, "velocity of the slave", "qc/ms", true},
    {4108, "velocity of the master", "qc/ms", true},
    {4109, "present frequency of the virtual master", "1/1000 Hz", true},
    {4110, "1 while the virtual master is active", "", true},
    {4111, "output of the position controller", "±1048575", true},
    {4113, "TIMER in effect", "ms", true},
    {4114, "PROFTIME in effect", "ms", true},
    {4115, "whether negative references are put out", "", false},
    {4116, "output used for the direction, 0: none", "", false},
    {4117, "acceleration of the virtual master", "1/1000 Hz/s (unit not printed)", true},
    {4118, "target frequency of the virtual master", "1/1000 Hz", true},
    {4119, "named 'Vlamode', meaning open", "", false},
    {4120, "counts between two index pulses", "qc", true},
    {4121, "type of the zero pulse, as SYNCMTYPM", "", true},
    {4122, "reference given by OUTAN", "0x4000 = 100 %", true},
    {4123, "type of the slave encoder", "", true},
    {4124,
     "type of the master encoder (later edition: following error in % of the commanded "
     "velocity)",
     "", true},
    {4125, "resolution of the slave encoder", "", true},
    {4126, "resolution of the master encoder", "", true},
    {4127, "0: amplifier idles at motor off, else it stops", "", false},
    {4128, "velocity of the real master encoder, also while the master is simulated", "qc/s", true},
    {4218, "32 flags of the profile generator", "", true},
    {4220, "CINDEX: interpolation point of the curve, 0 ", "", false},
    {4221, "CVINDEX: as 4220, while starting or stopping in that path", "", false},
    {4222, "CMAXINDEX: largest index", "", false},
    {4223, "CIMPS: position inside the interval", "MU", false},
    {4224, "CMILEN: length of an interval", "MU", false},
    {4225, "CWRAP: cycle of the curve, 1 .. 4227", "", false},
    {4226, "CSSTART: start offset of the slave for this cycle, 0 for closed curves", "qc", false},
    {4227, "CCOUNTER: cycles asked for by the last SYNCC", "", false},
    {4228, "CCURVEPOS: position of the slave on the curve", "UU", false},
    {4229, "CSLAVECPOSQ: slave curve position relative to 4226", "qc", false},
    {4230, "CMASTERCPOS: curve position of the master", "MU", false},
    {4231, "commanded velocity * 128, signed", "qc/ms*128", true},
    {4238, "filtered distance of the master markers", "qc", true},
    {4240, "first correction after SYNCM", "qc slave", false},
    {4241, "rest of the start correction, scaled", "", true},
    {4242, "filtered correction, scaled", "", true},
    {4243, "last distance of two master markers", "qc master", true},
    {4244, "correction of the gear, scaled", "", false},
    {4245, "last unfiltered correction", "qc slave", true},
    {4246, "place of the last master marker", "% of the nominal distance", true},
    {4247, "place of the last slave marker", "% of the nominal distance", true},
    {4248, "share of the start correction taken at each correction", "", true},
    {4249, "last distance of two slave markers", "qc slave", true},
    {4250, "time constant of the filter of the marker distance", "markers", true},
    {4251, "time constant of the filter of the correction", "markers", true},
    {4252, "sum of the errors of the marker distance", "qc", true},
    {4253, "filtered sum of 4252, scaled", "", true},
    {4275, "state of the limited-jerk movement, 1..15", "", true},
    {4276, "commanded velocity, signed", "qc/st", true},
    {4277, "stop path from the present velocity and acceleration", "qc", true},
};

}  // namespace

std::span<const SystemVariable> system_variables() noexcept {
  return kSystemVariables;
}

const SystemVariable* find_system_variable(std::int32_t index) noexcept {
  for (const SystemVariable& variable : kSystemVariables)
    if (variable.index == index) return &variable;
  return nullptr;
}

}  // namespace lockstep::mco305
