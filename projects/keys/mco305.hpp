/// The keys of an MCO 305.
#pragma once

#include "projects/keys/drive.hpp"

namespace lockstep::keys {

/// Highest number of a program, and how many internal commands a step may have.
inline constexpr int kHighestProgram = 127;
inline constexpr int kMaximumSteps = 100'000;

inline constexpr auto kNoDrive = key_table<DriveSettings>(
    key::selector("model", "none: the actual position is the set position, as with ENCODERTYPE 9"),
    key::structure<&DriveSettings::signals, &MachineSignals::zero_marks>("zero_marks", kZeroMarks,
                                                                         "zero pulses of the encoder [qc]"),
    key::positions<&DriveSettings::signals, &MachineSignals::reference_cam>(
        "reference_cam", kPlace,
        "positions [qc] in which the home switch is active, where no tag is wired to its input"));
inline constexpr KeyVariant kDeviceDrives[] = {{"simulated", kSimulatedDrive}, {"none", kNoDrive}};

inline constexpr auto kDeviceProgram = key_table<void>(
    key::integer("number", {0, kHighestProgram}, "of the program, each once").needed(),
    key::text("file", "program in APOSS beside the project, such as teddy.m"),
    key::text("lines", "the program itself, in place of a file").list(),
    key::boolean("autostart", "it is started when the run begins; one of all").otherwise_is("false"));

inline constexpr Word kFirmware[] = {{"5.00", 1}, {"<5.00", 0}};
inline constexpr Word kTimeInterrupts[] = {{"1ms", 1}, {"20ms", 20}};
inline constexpr auto kMco305 = key_table<void>(
    key::selector("type", "published type"),
    key::word("firmware", kFirmware, "edition whose behaviour it has").otherwise_is("5.00"),
    key::constant(
        "parameters",
        "by mnemonic or number, as printed: \"VELMAX\", \"32-80\", \"1900\"; with \"file\" those of a "
        "file beside the project first")
        .named(),
    key::variants("drive", kDeviceDrives, "drive and machine; places are in qc of the encoder")
        .otherwise_is("none"),
    key::tag("inputs", "BOOL tag that is an input: 1 to 12, 18, 19, 27, 29, 32, 33").named(),
    key::tag("outputs", "BOOL tag that is an output: 1 to 8, 21, 22, 27, 29").named(),
    key::number("controller_scale", {1e-6, 1e6}, "", "of the parts of the position controller")
        .otherwise_is("1"),
    key::structure("programs", kDeviceProgram, "its programs").list(),
    key::integer("steps_per_ms", {1, kMaximumSteps},
                 "internal commands that a program may carry out in a step")
        .otherwise_is("200"),
    key::word("time_interrupts", kTimeInterrupts, "how often ON TIME and ON PERIOD are looked at")
        .otherwise_is("1ms"));

}  // namespace lockstep::keys
