/// The parameters of the option, declared once: compiler, project, `describe` and the device read this table.
/// @source MCO 305 Design Guide, parameter reference; MG.33.L5.03 for those of the later edition
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace lockstep::mco305 {

inline constexpr std::int32_t kLargestPosition = 1'073'741'823;  ///< MLONG

/// What else bounds a range, beside its numbers.
enum class Bound : std::uint8_t {
  kNone,
  kVelocityResolution,  ///< VELRES
  kLeadingMarkers,      ///< SYNCMPULSM
  kFollowingMarkers     ///< SYNCMPULSS
};

struct Parameter {
  std::int32_t number;        ///< 32-67 as 3267
  std::string_view mnemonic;  ///< empty: it has none
  std::string_view title;
  std::string_view unit;                ///< of what is printed
  std::int32_t lowest, highest, start;  ///< as a program sees them
  int decimals;                         ///< that what is printed has behind its point: RAMPMIN 0.5 s is 500
  Bound bound;
  bool later_edition;
  bool effective;  ///< false: declared, without effect
};

inline constexpr std::size_t kNumberedParameters = 162;
inline constexpr std::int32_t kFirstNumber = 3200;
inline constexpr std::int32_t kFirstApplicationParameter = 1900, kLastApplicationParameter = 1999;
inline constexpr std::size_t kApplicationParameters = 100;
inline constexpr std::size_t kParameterCount = kNumberedParameters + kApplicationParameters;
inline constexpr std::size_t kNoParameter = SIZE_MAX;

/// Those with a number of their own, in its order; beside them 1900 to 1999.
std::span<const Parameter> parameters() noexcept;

constexpr bool is_application_parameter(std::int32_t number) noexcept {
  return number >= kFirstApplicationParameter && number <= kLastApplicationParameter;
}
/// What is published of it between its lowest and highest value; empty: all of them.
std::string_view options_of(std::int32_t number) noexcept;
/// Whether a value of its range is one of those.
bool is_option(std::int32_t number, std::int32_t value, bool later_edition) noexcept;
/// Where its value stands; `kNoParameter` if there is no such number.
std::size_t parameter_index(std::int32_t number) noexcept;
/// Process data and read-outs: a program reads them only.
constexpr bool is_read_out(std::int32_t number) noexcept {
  return number >= 3400;
}

/// Numbers that the device itself asks for.
enum ParameterNumber : std::int32_t {
  kEncoderType = 3200,
  kEncoder = 3201,
  kEncoderAbsType = 3202,
  kEncoderAbsRes = 3203,
  kEncoderDatLen = 3205,
  kEncoderFreq = 3206,
  kEncoderMonitoring = 3209,
  kPosDirection = 3210,
  kPosFactN = 3211,
  kPosFactZ = 3212,
  kEncControl = 3213,
  kMasterEncoderType = 3230,
  kMasterEncoder = 3231,
  kMasterEncoderAbsType = 3232,
  kMasterEncoderAbsRes = 3233,
  kMasterEncoderDatLen = 3235,
  kMasterEncoderMonitoring = 3239,
  kMasterEncControl = 3243,
  kKProp = 3260,
  kKDer = 3261,
  kKInt = 3262,
  kKILim = 3263,
  kBandwidth = 3264,
  kFFVel = 3265,
  kFFAcc = 3266,
  kPosErr = 3267,
  kRevers = 3268,
  kTimer = 3269,
  kProfTime = 3270,
  kRegWMax = 3271,
  kRegWMin = 3272,
  kKILimTime = 3273,
  kPosErrTime = 3274,
  kVelMax = 3280,
  kRampMin = 3281,
  kRampType = 3282,
  kVelRes = 3283,
  kDfltVel = 3284,
  kDfltAcc = 3285,
  kJerkMin = 3286,
  kHomeForce = 3300,
  kHomeOffset = 3301,
  kHomeRamp = 3302,
  kHomeVel = 3303,
  kHomeType = 3304,
  kSyncFactM = 3310,
  kSyncFactS = 3311,
  kSyncPosOffs = 3312,
  kSyncAccuracy = 3313,
  kSyncVelRel = 3314,
  kSyncMarkM = 3315,
  kSyncMarkS = 3316,
  kSyncMPulsM = 3317,
  kSyncMPulsS = 3318,
  kMarkerTypeMaster = 3319,
  kMarkerTypeSlave = 3320,
  kSyncMWinM = 3321,
  kSyncMWinS = 3322,
  kSyncMStart = 3323,
  kSyncFaultCount = 3324,
  kSyncReadyCount = 3325,
  kSyncVfTime = 3326,
  kSyncOffTime = 3327,
  kSyncMfPar = 3328,
  kSyncMfTime = 3329,
  kSyncMMaxCorr = 3330,
  kSyncType = 3331,
  kSyncVfLimit = 3333,
  kSyncFfVel = 3332,
  kEndSwMod = 3340,
  kNegLimit = 3341,
  kPosLimit = 3342,
  kSwNegLimAct = 3343,
  kSwPosLimAct = 3344,
  kTestTim = 3345,
  kTestVal = 3346,
  kTestWin = 3347,
  kFirstInputFunction = 3350,
  kIoMode = 3360,
  kFirstOutputFunction = 3363,
  kPrgPar = 3380,
  kPowerUpState = 3381,
  kStatusMonitoring = 3382,
  kErrCond = 3383,
  kEscCond = 3384,
  kExternalSupply = 3385,
  kCanNumber = 3390,
  kCanBaud = 3391,
};

/// What SAVE keeps together.
enum class ParameterSet : std::uint8_t {
  kAxis,         ///< AXPARS: 32-xx and 33-xx, but for the next
  kGlobal,       ///< GLBPARS: 33-5x, 33-8x
  kApplication,  ///< USRPARS: 1900 to 1999
  kNone          ///< read-outs
};
ParameterSet set_of(std::int32_t number) noexcept;

/// The values of one device: those that count, and those that its EEPROM holds.
class ParameterValues {
 public:
  ParameterValues() noexcept;

  std::int32_t operator[](std::int32_t number) const noexcept { return values_[parameter_index(number)]; }
  double real(std::int32_t number) const noexcept { return static_cast<double>((*this)[number]); }
  /// From a program: no range is looked at, but a value with which nothing can be computed is refused.
  /// @return 0, or 112 for a number that is not there or such a value
  int set(std::int32_t number, std::int32_t value) noexcept;
  /// As from a panel: ON PARAM sees it, and it is kept. @return as `set`
  int change(std::int32_t number, std::int32_t value) noexcept;
  /// All of them, in the order of `parameter_index`.
  const std::array<std::int32_t, kParameterCount>& all() const noexcept { return values_; }

  /// Once, when the project has been read and what is kept has been given back: a set that has been saved
  /// counts, of the others what the project says is kept from now on.
  /// @return false if there was a value with which nothing can be computed; the project's stays
  bool power_up() noexcept;
  /// The values of a set are kept: SAVE.
  void save(ParameterSet set) noexcept;
  /// The end of a program: what it has set and not saved is as it was before.
  void forget() noexcept;
  /// What stands in the EEPROM, for who writes it down; of application parameters those that count.
  std::int32_t* kept(std::int32_t number) noexcept;
  /// Whether a set has been saved. Not of kNone.
  bool* saved(ParameterSet set) noexcept { return &saved_[static_cast<std::size_t>(set)]; }

  /// Counts every change.
  std::uint32_t version() const noexcept { return version_; }
  /// How often it has been changed from outside.
  std::uint32_t changes(std::int32_t number) const noexcept;

 private:
  std::array<std::int32_t, kParameterCount> values_{};
  std::array<std::uint16_t, kParameterCount> changes_{};
  std::uint32_t version_ = 0;
  std::array<std::int32_t, kNumberedParameters> stored_{};
  std::array<bool, 3> saved_{};
};

}  // namespace lockstep::mco305
