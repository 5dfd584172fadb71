/// The commands of APOSS, declared once: names, arguments, and what they do to the run of a program. The
/// compiler, the machine and the listing read this table.
/// @source MCO 305 Design Guide, command overview
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace lockstep::aposs {

enum class Command : std::uint8_t {
  kAcc,
  kApos,
  kAvel,
  kAxend,
  kComoptget,
  kComoptsend,
  kContinue,
  kCpos,
  kCstart,
  kCstop,
  kCurvepos,
  kCvel,
  kDec,
  kDefmcpos,
  kDefmorigin,
  kDefOrigin,
  kDefSyncorigin,
  kDelay,
  kDeleteArrays,
  kDim,
  kDisable,
  kEnable,
  kErrclr,
  kErrno,
  kExit,
  kGet,
  kGetvlt,
  kGetvltsub,
  kGosub,
  kGoto,
  kHome,
  kIf,
  kIn,
  kInad,
  kInb,
  kIndex,
  kInkey,
  kIpos,
  kLinkgpar,
  kLinksysvar,
  kLoop,
  kMapos,
  kMavel,
  kMipos,
  kMotorOff,
  kMotorOn,
  kMotorStop,
  kMovesyncorigin,
  kNowait,
  kOnApos,
  kOnCombit,
  kOnDelete,
  kOnErrorGosub,
  kOnInt,
  kOnMapos,
  kOnMcpos,
  kOnParam,
  kOnPeriod,
  kOnStatbit,
  kOnTime,
  kOut,
  kOutan,
  kOutb,
  kOutda,
  kPcd,
  kPid,
  kPosa,
  kPosaCurvepos,
  kPosr,
  kPrint,
  kPrintDev,
  kPulsacc,
  kPulsvel,
  kRepeat,
  kRstOrigin,
  kSave,
  kSaveprom,
  kSet,
  kSetcurve,
  kSetmorigin,
  kSetOrigin,
  kSetvlt,
  kSetvltsub,
  kStat,
  kSubmainprog,
  kSubprog,
  kSwapmenc,
  kSyncc,
  kSynccmm,
  kSynccms,
  kSynccstart,
  kSynccstop,
  kSyncerr,
  kSyncm,
  kSyncp,
  kSyncstat,
  kSyncstatclr,
  kSyncv,
  kSysvar,
  kTestsetp,
  kTeststart,
  kTime,
  kTrackerr,
  kVel,
  kWaitax,
  kWaiti,
  kWaitndx,
  kWaitp,
  kWaitt,
  kWhile,
  kGetvel,
  kInclude,
  kDefcorigin,
  kAposdiff,
  kCposdiff,
  kIposdiff,
  kMaposdiff,
  kMiposdiff,
  kEncposoffs,
  kMencposoffs,
  kEnctgread,
  kEnctgwrite,
  kMenctgread,
  kMenctgwrite,
  kJerkfinvel,
  kJerkstopdist,
  kTestsetdest,
  kTestsetindex,
  kTestsettime,
  kTestsettype,
  kTeststop,
  kVltalarmstat,
  kVltcontrol,
  kVlterrclr,
  kOnCaninput,
  kOnCanmsg,
  kOnKeypressed,
  kOnIpos,
  kOnMipos,
  kOnPosintSetout,
  kOnPosintSetoutToin,
  kLinkpdo,
  kLinksdo,
  kSyncmarkerstart,
  kCandel,
  kCanin,
  kCanout,
  kDefcanin,
  kDefcanout,
  kInglb,
  kInmsg,
  kMsgval,
  kOutmsg,
  kUsrstat,
  kCanini,
  kSdoread,
  kSdoreadseg,
  kSdoreadsegp,
  kSdostate,
  kSdowrite,
  kPdo,
  kInlong,
  kSwitch,
  kBreak,
  kPragma,
  kFunctionDefinition,
  kDoubleFunctions,
  kPreprocessor,
  kSetSysvar,
  kSetPcd,
  kSetPid,
  kSentPcd
};

enum class CommandKind : std::uint8_t {
  kStatement,  ///< the device carries it out
  kFunction,   ///< the device gives a value
  kLanguage,   ///< the compiler and the machine know it
  kForm,       ///< another form of a command, which the device tells apart
  kLater,      ///< known, and refused until it comes
  kNever       ///< known, and refused: `Refusal` says why
};

/// What stands behind the name of a command.
enum class Argument : std::uint8_t {
  kNone,
  kValue,          ///< a primary, or an expression in parentheses
  kOptionalValue,  ///< 0 if it is not there
  kState,          ///< ON, OFF or a value
  kOptionalState,  ///< ON if it is not there
  kIndex,          ///< a value in brackets
  kArray,          ///< the name of an array: its number
  kParameter,      ///< a parameter of the option: its number, 32-67 as 3267
  kDrive,          ///< a parameter of the drive: 4-13 or 413
  kText,           ///< "text": its number in the image
  kOutput,         ///< a number, or terminal block and pin: X59/3
  kPart,           ///< what is saved: `kSavedParts`
  kCoefficient     ///< of the PID function: `kPidCoefficients`
};

/// Whether the next command waits for the end of this one.
enum class Waits : std::uint8_t { kNever, kMotion /* with NOWAIT OFF */, kAlways };

/// Why a command is refused.
enum class Refusal : std::uint8_t { kNone, kLaterEdition, kNoCan, kNoTelegrams, kNoSerialLine };

struct CommandRow {
  Command command;
  std::string_view name;  ///< as published; a part behind a blank is a word of its own
  CommandKind kind;
  std::array<Argument, 5> arguments;
  Waits waits;
  bool pure;      ///< reads what cannot change within a step, and changes nothing
  bool given_up;  ///< by an interrupt, in place of going on behind it
  Refusal refusal;
  bool later_edition = false;  ///< taken with firmware 5.00 alone

  std::size_t arity() const noexcept;
};

std::span<const CommandRow> commands() noexcept;
/// The row of a command of the enumeration.
const CommandRow& row_of(Command command) noexcept;

inline constexpr std::string_view kSavedParts[] = {"ARRAYS", "AXPARS", "GLBPARS", "USRPARS"};
inline constexpr std::string_view kPidCoefficients[] = {"KPROP", "KDER", "KINT", "KILIM", "TIMER"};

/// What a command does, in a sentence or two.
std::string_view meaning_of(const CommandRow& row) noexcept;

/// Another spelling of the published documents: taken, with a warning where it is not the usual form.
struct CommandAlias {
  std::string_view name;
  std::string_view usual;
  bool equal;  ///< published as a form of its own; no warning
};
std::span<const CommandAlias> command_aliases() noexcept;

}  // namespace lockstep::aposs
