/// The published errors of the option, with their bits of the alarm words.
/// @source MCO 305 Design Guide, troubleshooting; 34-70, 34-71
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace lockstep::mco305 {

struct Error {
  int number;
  std::string_view text;
  int word;  ///< 1: 34-70, 2: 34-71; 0: it has no bit
  int bit;
  std::string_view never = "";  ///< why it is not raised here; empty: it is
};

std::span<const Error> errors() noexcept;
/// nullptr: there is no such error.
const Error* find_error(int number) noexcept;

/// The errors that the device raises itself.
enum ErrorNumber : int {
  kErrorNotReset = 105,
  kHomeNotDone = 106,
  kHomeVelocityZero = 107,
  kPositionError = 108,
  kIndexNotFound = 109,
  kUnknownCommand = 110,
  kSoftwareLimit = 111,
  kUnknownParameter = 112,
  kDriveNotReady = 113,
  kSavingFailed = 115,
  kParametersCorrupted = 116,
  kUserAbort = 119,
  kHardwareLimit = 125,
  kNoSupply = 150,
  kOutputOverloaded = 154,
  kLinkFailed = 155,
  kVerificationFailed = 162,
  kArrayBound = 171,
  kWaitIndexTimeout = 179,
  kWriteProtected = 190,
  kCurveArrayWrong = 191,
  kEncoderError = 192,
  kFurtherOut = 198,
};

/// What has come up and has not been cleared, in its order.
class PendingErrors {
 public:
  void add(int number) noexcept;
  /// ERRCLR clears one.
  void clear_first() noexcept;
  void clear() noexcept { count_ = 0; }
  bool any() const noexcept { return count_ != 0; }
  bool has(int number) const noexcept;
  /// Whether a program may be started although they have not been cleared: there are none but 108, 111, 125.
  bool tolerated() const noexcept;
  /// Whether there is no other one.
  bool only(int number) const noexcept;
  int first() const noexcept { return count_ == 0 ? 0 : numbers_[0]; }
  /// In their order.
  std::span<const int> all() const noexcept { return {numbers_.data(), count_}; }
  /// 34-70, 34-71; bit 31 of the first says that the second has bits.
  std::int32_t alarm_word(int word) const noexcept;

 private:
  std::array<int, 8> numbers_{};
  std::size_t count_ = 0;
};

}  // namespace lockstep::mco305
