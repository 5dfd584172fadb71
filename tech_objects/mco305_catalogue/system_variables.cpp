#include "tech_objects/mco305_catalogue/system_variables.hpp"

#include <iterator>

namespace lockstep::mco305 {
namespace {

constexpr SystemVariable kSystemVariables[] = {
    {1, "InputByte0", "input byte 0: inputs 1..8", "", true},
    {2, "InputByte1", "input byte 1: drive inputs 18..33", "", true},
    {3, "InputByte2", "input byte 2: inputs 9..10 (12)", "", true},
    {9, "OutputByte0", "output byte 0", "", true},
    {16, "SsiErrors", "counter of SSI errors (text of 32-02)", "", true},
    {17, "UpperStatus", "upper two bytes of STAT", "", true},
    {22, "Milliseconds", "milliseconds since power-up, as TIME", "ms", true},
    {28, "MotorCurrent", "motor current", "1/100 A", true},
    {30, "MotorVoltage", "motor voltage", "1/10 V", true},
    {31, "DriveStatus", "drive status (16-03)", "", true},
    {32, "MainActualValue", "main actual value (16-05)", "", true},
    {33, "ProgramLine", "line of the program that runs, with #DEBUG NOSTOP", "", true},
    {34, "MotorFrequency", "motor frequency (16-13)", "", true},
    {35, "MotorTorque", "motor torque (16-16)", "", true},
    {4096, "ActualPosition", "actual position of the slave", "qc", true},
    {4097, "SetPosition", "set position of the slave", "qc", true},
    {4098, "IndexPosition", "last index or marker position of the slave", "qc", true},
    {4099, "WindowVelocity", "actual velocity over the window of _GETVEL", "qc/st", true},
    {4100, "MasterWindowVelocity", "velocity of the master over the window of _GETVEL", "qc/st", true},
    {4101, "PositionError", "following error", "qc", true},
    {4102, "AbsoluteTurns", "turns of the slave's absolute encoder since the first overflow", "", true},
    {4103, "MasterAbsoluteTurns", "turns of the master's absolute encoder since the first overflow", "",
     true},
    {4105, "MasterPosition",
     "master position; may be written while the master is simulated (MENCODERTYPE [5])", "qc", true},
    {4106, "MasterIndexPosition", "last index or marker position of the master", "qc", true},
    {4107, "Velocity", "velocity of the slave", "qc/ms", true},
    {4108, "MasterVelocity", "velocity of the master", "qc/ms", true},
    {4109, "PulseFrequency", "present frequency of the virtual master", "1/1000 Hz", true},
    {4110, "PulseActive", "1 while the virtual master is active", "", true},
    {4111, "Reference", "output of the position controller", "±1048575", true},
    {4113, "Timer", "TIMER in effect", "ms", true},
    {4114, "ProfTime", "PROFTIME in effect", "ms", true},
    {4115, "NegativeReferences", "whether negative references are put out", "", true},
    {4116, "DirectionOutput", "output used for the direction, 0: none", "", true},
    {4117, "PulseAcceleration", "acceleration of the virtual master", "1/1000 Hz/s (unit not printed)", true},
    {4118, "PulseTarget", "target frequency of the virtual master", "1/1000 Hz", true},
    {4119, "Vlamode", "named 'Vlamode', meaning open", "", false},
    {4120, "IndexDistance", "counts between two index pulses", "qc", true},
    {4121, "IndexType", "type of the zero pulse, as SYNCMTYPM", "", true},
    {4122, "OpenLoopReference", "reference given by OUTAN", "0x4000 = 100 %", true},
    {4123, "EncoderType", "type of the slave encoder", "", true},
    {4124, "MasterEncoderType",
     "type of the master encoder (later edition: following error in % of the commanded "
     "velocity)",
     "", true},
    {4125, "EncoderResolution", "resolution of the slave encoder", "", true},
    {4126, "MasterEncoderResolution", "resolution of the master encoder", "", true},
    {4127, "StopsAtMotorOff", "0: amplifier idles at motor off, else it stops", "", true},
    {4128, "RealMasterVelocity", "velocity of the real master encoder, also while the master is simulated",
     "qc/s", true},
    {4218, "Flags", "32 flags of the profile generator", "", true},
    {4220, "CINDEX", "CINDEX: interpolation point of the curve, 0 ", "", false},
    {4221, "CVINDEX", "CVINDEX: as 4220, while starting or stopping in that path", "", false},
    {4222, "CMAXINDEX", "CMAXINDEX: largest index", "", false},
    {4223, "CIMPS", "CIMPS: position inside the interval", "MU", false},
    {4224, "CMILEN", "CMILEN: length of an interval", "MU", false},
    {4225, "CWRAP", "CWRAP: cycle of the curve, 1 .. 4227", "", false},
    {4226, "CSSTART", "CSSTART: start offset of the slave for this cycle, 0 for closed curves", "qc", false},
    {4227, "CCOUNTER", "CCOUNTER: cycles asked for by the last SYNCC", "", false},
    {4228, "CCURVEPOS", "CCURVEPOS: position of the slave on the curve", "UU", false},
    {4229, "CSLAVECPOSQ", "CSLAVECPOSQ: slave curve position relative to 4226", "qc", false},
    {4230, "CMASTERCPOS", "CMASTERCPOS: curve position of the master", "MU", false},
    {4231, "GETCMDVEL", "commanded velocity * 128, signed", "qc/ms*128", true},
    {4238, "MarkerDistance", "filtered distance of the master markers", "qc", true},
    {4240, "STARTKORR", "first correction after SYNCM", "qc slave", true},
    {4241, "STARTKORREST", "rest of the start correction, scaled", "", true},
    {4242, "KORRFILT", "filtered correction, scaled", "", true},
    {4243, "LASTMMDIST", "last distance of two master markers", "qc master", true},
    {4244, "MMARKCORR", "correction of the gear", "1/65536 (scale not printed)", true},
    {4245, "KORRUNFILT", "last unfiltered correction", "qc slave", true},
    {4246, "MDISTMARK", "place of the last master marker", "% of the nominal distance", true},
    {4247, "SDISTMARK", "place of the last slave marker", "% of the nominal distance", true},
    {4248, "STARTKORRVAL", "share of the start correction taken at each correction", "", true},
    {4249, "LASTSMDIST", "last distance of two slave markers", "qc slave", true},
    {4250, "MARKERFILTER", "time constant of the filter of the marker distance", "markers", true},
    {4251, "KORRTAU", "time constant of the filter of the correction", "markers", true},
    {4252, "INTMMERROR", "sum of the errors of the marker distance", "qc", true},
    {4253, "MMARKERR", "filtered sum of 4252, scaled", "", true},
    {4275, "JerkState", "state of the limited-jerk movement, 1..15", "", true},
    {4276, "VCMDSIGNED", "commanded velocity, signed", "qc/st", true},
    {4277, "JERKSTOPPATH", "stop path from the present velocity and acceleration", "qc", true},
};

static_assert(std::size(kSystemVariables) == kSystemVariableCount);

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
