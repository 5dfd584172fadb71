/// Telegrams of leading values as bytes and back, and which of those that come from a network count.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/lcm/key_file.hpp"
#include "lockstep/leading_proxies_t.hpp"
#include "lockstep/leading_value_t.hpp"
#include "tech_objects/leading_values/telegram.hpp"

namespace lockstep {

/// What sender and receivers of a transfer area agree on.
struct LeadingValueLink {
  std::string area;    ///< SYSTEM.AREA
  std::string sender;  ///< name of the controller that sends
  std::string source;  ///< name of its leading object
  int interface = 1;   ///< by which that provides its value
  SharedKey key{};     ///< empty: telegrams are not signed

  /// A digest of all but the key, and of the version of the telegram. What differs in one of them is foreign.
  std::int64_t layout() const noexcept;
};

/// Writes telegrams of one area. One thread at a time.
class LeadingValueWriter {
 public:
  /// @param run of this process, chosen by chance
  LeadingValueWriter(LeadingValueLink link, std::int64_t run);

  /// The bytes of a telegram; they last until the next one.
  std::span<const std::uint8_t> write(const LeadingValueTelegram& telegram);

 private:
  const LeadingValueLink link_;
  leading_value_t message_;
  std::vector<std::uint8_t> bytes_;
};

/// What has become of the messages of an area.
struct LeadingValueCounters {
  std::uint64_t accepted = 0;
  std::uint64_t malformed = 0;   ///< no telegram
  std::uint64_t foreign = 0;     ///< of another area, sender or layout
  std::uint64_t not_signed = 0;  ///< without the right code
  std::uint64_t repeated = 0;    ///< that have been accepted already, or are as old as such ones
  std::uint64_t ambiguous = 0;   ///< while there are two senders
  std::uint64_t stale = 0;  ///< older or newer than the clock allows, or with a sequence ahead of its time
};

/// Takes telegrams of one area from its one sender. Any bytes may come: nothing that a sender puts into them
/// can do more than be counted. One thread at a time.
class LeadingValueReader {
 public:
  /// How old a telegram may be [ns]. From the future it may be by its own cycle, but no more than this.
  static constexpr std::int64_t kLongestAge = 1'000'000'000;
  /// While two senders have been heard within that time [ns], nothing counts.
  static constexpr std::int64_t kAmbiguousFor = 1'000'000'000;

  explicit LeadingValueReader(LeadingValueLink link);

  /// The telegram of a message, if it counts.
  /// @param now on the clock that all controllers share [ns]
  std::optional<LeadingValueTelegram> read(std::span<const std::uint8_t> bytes, std::int64_t now);

  const LeadingValueCounters& counters() const noexcept { return counters_; }

 private:
  bool is_ambiguous(const leading_value_t& message, std::int64_t now) noexcept;
  bool is_ahead(const leading_value_t& message) const noexcept;
  bool is_repeated(const leading_value_t& message, std::int64_t now) noexcept;

  const LeadingValueLink link_;
  const std::int64_t layout_;
  LeadingValueCounters counters_;
  bool known_ = false;
  std::int64_t run_ = 0;                // of the sender
  std::int64_t run_before_ = 0;         // which `run_` has replaced; 0: none
  std::optional<std::int64_t> heard_;   // [ns] `run_`
  std::optional<std::int64_t> before_;  // [ns] `run_before_`, going on behind its replacement
  std::int64_t newest_time_ = 0;        // [ns] accepted
  std::int64_t cycle_ = 0;              // [ns] of `run_`
  std::uint64_t newest_ = 0;            // sequence accepted
  std::int64_t time_of_newest_ = 0;     // [ns]
  std::uint64_t window_ = 0;            // bit n: `newest_` − n has been accepted
};

/// The message, if the bytes are one of this type, whole and without anything behind it. Any thread.
std::optional<leading_value_t> decode_leading_value(std::span<const std::uint8_t> bytes);
std::optional<leading_proxies_t> decode_leading_proxies(std::span<const std::uint8_t> bytes);

/// What is appended to the channel of an area to name that on which its receivers tell what has come.
inline constexpr std::string_view kProxiesSuffix = "_PROXIES";

}  // namespace lockstep
