#include "scheduler/aposs/argument_ranges.hpp"

namespace lockstep::aposs {
namespace {

using C = Command;

constexpr int kNoSuchParameter = 112, kNoLink = 155, kNoElement = 171, kNoIndexInTime = 179;

constexpr std::int32_t kLargestPosition = 1'073'741'823;  // MLONG
constexpr std::int32_t kLargestResolution = 10'000;       // of VELRES

constexpr ValueSpan kFromNothing[] = {{0, kNoHighest}};
constexpr ValueSpan kFromOne[] = {{1, kNoHighest}};
constexpr ValueSpan kState[] = {{0, 1}};
constexpr ValueSpan kVelocity[] = {{1, kLargestResolution}};
constexpr ValueSpan kSpeed[] = {{-kLargestResolution, kLargestResolution}};
constexpr ValueSpan kTime[] = {{0, kLargestPosition}};
constexpr ValueSpan kPeriod[] = {{0, 0}, {20, kNoHighest}};
constexpr ValueSpan kPosition[] = {{-kLargestPosition, kLargestPosition}};
constexpr ValueSpan kWords[] = {{0, 10}};
constexpr ValueSpan kWord[] = {{1, 10}};
constexpr ValueSpan kApplication[] = {{1900, 1999}};
constexpr ValueSpan kInputs[] = {{1, 12}, {18, 19}, {27, 27}, {29, 29}, {32, 33}};
constexpr ValueSpan kWatchedInputs[] = {{1, 12}, {18, 33}};
constexpr ValueSpan kInputBytes[] = {{0, 2}};
constexpr ValueSpan kAnalogInputs[] = {{53, 54}};
constexpr ValueSpan kWordOfBits[] = {{1, 32}};
constexpr ValueSpan kStatusBits[] = {{1, 1}, {3, 4}, {6, 6}, {8, 12}, {25, 31}};
constexpr ValueSpan kNumberedOutputs[] = {{1, 32}, {3401, 3401}, {3405, 3405}, {3410, 3410}};
constexpr ValueSpan kOutputs[] = {{1, 8},       {21, 22},     {27, 27},    {29, 29},
                                  {3401, 3401}, {3405, 3405}, {3410, 3410}};
constexpr ValueSpan kOutputBytes[] = {{0, 1}};
constexpr ValueSpan kByte[] = {{0, 255}};
constexpr ValueSpan kAnalogOutput[] = {{42, 42}};
constexpr ValueSpan kAnalogValue[] = {{0, 100'000}};
constexpr ValueSpan kReference[] = {{-0x4000, 0x4000}};
constexpr ValueSpan kPrinters[] = {{-1, 0}};
constexpr ValueSpan kFlags[] = {{0, 8 + 16 + 32 + 64}};
constexpr ValueSpan kMasterPosition[] = {{4105, 4105}};

constexpr std::string_view kNearest = "the nearest of these is taken";
constexpr std::string_view kTakenAsOn = "it is taken for ON";
constexpr std::string_view kAtOnce = "below 0 it is over at once; an option counts no further than this";
constexpr std::string_view kBeyondMaximum = "it is more than VELMAX, whatever VELRES is";
constexpr std::string_view kNoCycles = "there is no such number of cycles";
constexpr std::string_view kOff = "it is always off";
constexpr std::string_view kNone = "there is none";
constexpr std::string_view kNeverComes = "it never comes";

constexpr ArgumentRange kRanges[] = {
    {C::kAcc, 0, "acceleration", Allowed::kSpans, kFromOne, 0, "the default (32-85) is taken"},
    {C::kComoptget, 0, "number", Allowed::kWithinArray, kWords, kNoElement, {}},
    {C::kComoptsend, 0, "number", Allowed::kWithinArray, kWords, kNoElement, {}},
    {C::kCvel, 0, "velocity", Allowed::kSpans, kSpeed, 0, kBeyondMaximum},
    {C::kDec, 0, "deceleration", Allowed::kSpans, kFromOne, 0, "the default (32-85) is taken"},
    {C::kDelay, 0, "time", Allowed::kSpans, kTime, 0, kAtOnce},
    {C::kGet, 0, "parameter", Allowed::kParameter, {}, kNoSuchParameter, {}},
    {C::kGetvlt, 0, "parameter", Allowed::kDrive, {}, kNoSuchParameter, {}},
    {C::kGetvltsub, 0, "parameter", Allowed::kIndexedDrive, {}, kNoSuchParameter, {}},
    {C::kIn, 0, "input", Allowed::kSpans, kInputs, 0, kOff},
    {C::kInad, 0, "terminal", Allowed::kSpans, kAnalogInputs, kNoElement, {}},
    {C::kInb, 0, "byte", Allowed::kSpans, kInputBytes, 0, "it is always 0"},
    {C::kLinkgpar, 0, "parameter", Allowed::kSpans, kApplication, kNoLink, {}},
    {C::kLinkgpar, 2, "minimum", Allowed::kUpToNext, {}, kNoLink, {}},
    {C::kLinkgpar, 4, "type", Allowed::kSpans, kState, 0, "nothing depends on it here"},
    {C::kLinksysvar, 0, "index", Allowed::kSystemVariable, {}, kNoLink, {}},
    {C::kLinksysvar, 1, "parameter", Allowed::kSpans, kApplication, kNoLink, {}},
    {C::kLoop, 0, "number", Allowed::kSpans, kFromNothing, 0, "nothing is repeated"},
    {C::kMovesyncorigin, 0, "distance", Allowed::kSpans, kPosition, 0,
     "an option shifts no further than this"},
    {C::kNowait, 0, "state", Allowed::kSpans, kState, 0, kTakenAsOn},
    {C::kOnCombit, 0, "bit", Allowed::kEitherSign, kWordOfBits, 0, kNone, true},
    {C::kOnInt, 0, "input", Allowed::kEitherSign, kWatchedInputs, 0, kNone, true},
    {C::kOnParam, 0, "parameter", Allowed::kParameter, {}, 0, kNeverComes},
    {C::kOnPeriod, 0, "period", Allowed::kSpans, kFromNothing, 0, "it is switched off, as by 0"},
    {C::kOnPeriod, 0, "period", Allowed::kSpans, kPeriod, 0, "an option looks at its time every 20 ms"},
    {C::kOnStatbit, 0, "bit", Allowed::kEitherSign, kWordOfBits, 0, kNone, true},
    {C::kOnStatbit, 0, "bit", Allowed::kEitherSign, kStatusBits, 0, kNeverComes},
    {C::kOnTime, 0, "time", Allowed::kSpans, kTime, 0, kAtOnce},
    {C::kOut, 0, "output", Allowed::kSpans, kNumberedOutputs, kNoElement, {}},
    {C::kOut, 0, "output", Allowed::kSpans, kOutputs, 0, "no terminal shows it"},
    {C::kOut, 1, "state", Allowed::kSpans, kState, 0, kTakenAsOn},
    {C::kOutan, 0, "reference", Allowed::kSpans, kReference, 0, kNearest},
    {C::kOutb, 0, "byte", Allowed::kSpans, kOutputBytes, kNoElement, {}},
    {C::kOutb, 1, "value", Allowed::kSpans, kByte, 0, "its lowest eight bits are taken"},
    {C::kOutda, 0, "output", Allowed::kSpans, kAnalogOutput, kNoElement, {}},
    {C::kOutda, 1, "value", Allowed::kSpans, kAnalogValue, 0, kNearest},
    {C::kPcd, 0, "word", Allowed::kSpans, kWord, kNoElement, {}},
    {C::kSetPcd, 0, "word", Allowed::kSpans, kWord, kNoElement, {}},
    {C::kPrintDev, 0, "device", Allowed::kSpans, kPrinters, 0, "below 0 nothing is printed, else everything"},
    {C::kSet, 0, "parameter", Allowed::kWritten, {}, kNoSuchParameter, {}},
    {C::kSet, 1, "value", Allowed::kValueOfWritten, {}, kNoSuchParameter, {}},
    {C::kSet, 1, "value", Allowed::kPublishedValue, {}, 0, "SET takes it without a look at its range"},
    {C::kSetPid, 1, "value", Allowed::kPidValue, {}, 0, "nothing changes"},
    {C::kSetvlt, 0, "parameter", Allowed::kWrittenDrive, {}, kNoSuchParameter, {}},
    {C::kSetvlt, 1, "value", Allowed::kValueOfDrive, {}, kNoSuchParameter, {}},
    {C::kSetvltsub, 0, "parameter", Allowed::kIndexedDrive, {}, kNoSuchParameter, {}},
    {C::kSwapmenc, 0, "state", Allowed::kSpans, kState, 0, kTakenAsOn},
    {C::kSyncc, 0, "number", Allowed::kSpans, kFromNothing, 0, kNoCycles},
    {C::kSynccmm, 0, "number", Allowed::kSpans, kFromNothing, 0, kNoCycles},
    {C::kSynccms, 0, "number", Allowed::kSpans, kFromNothing, 0, kNoCycles},
    {C::kSyncmarkerstart, 0, "type", Allowed::kSpans, kState, kNoSuchParameter, {}},
    {C::kSyncstatclr, 0, "value", Allowed::kBits, kFlags, 0, "no other flag is cleared"},
    {C::kSysvar, 0, "index", Allowed::kSystemVariable, {}, kNoSuchParameter, {}},
    {C::kSetSysvar, 0, "written index", Allowed::kSpans, kMasterPosition, kNoSuchParameter, {}},
    {C::kTestsetp, 0, "time", Allowed::kSpans, kFromOne, 0, "nothing is recorded"},
    {C::kTestsetp, 1, "index", Allowed::kSystemVariable, {}, 0, kNone},
    {C::kTestsetp, 2, "index", Allowed::kSystemVariable, {}, 0, kNone},
    {C::kTestsetp, 3, "index", Allowed::kSystemVariable, {}, 0, kNone},
    {C::kTeststart, 0, "number", Allowed::kSpans, kFromNothing, 0, "nothing is recorded"},
    {C::kVel, 0, "velocity", Allowed::kSpans, kFromNothing, 0, "the default (32-84) is taken"},
    {C::kVel, 0, "velocity", Allowed::kSpans, kFromOne, 0, "nothing moves"},
    {C::kVel, 0, "velocity", Allowed::kSpans, kVelocity, 0, kBeyondMaximum},
    {C::kWaiti, 0, "input", Allowed::kSpans, kInputs, 0, kOff},
    {C::kWaiti, 1, "state", Allowed::kSpans, kState, 0, kTakenAsOn},
    {C::kWaitndx, 0, "time", Allowed::kSpans, kFromOne, kNoIndexInTime, {}},
    {C::kWaitt, 0, "time", Allowed::kSpans, kTime, 0, kAtOnce},
};

}  // namespace

std::span<const ArgumentRange> argument_ranges() noexcept {
  return kRanges;
}

}  // namespace lockstep::aposs
