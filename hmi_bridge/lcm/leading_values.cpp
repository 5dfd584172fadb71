#include "hmi_bridge/lcm/leading_values.hpp"

#include <algorithm>
#include <utility>

#include "hmi_bridge/lcm/wire.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kCode = std::tuple_size_v<MessageCode>;  // at the end of a message
constexpr std::uint64_t kWindow = 64;

void set_value(leading_value_t& message, const LeadingValueTelegram& telegram) noexcept {
  message.sequence = static_cast<std::int64_t>(telegram.sequence);
  message.time = telegram.time;
  message.cycle = telegram.cycle;
  message.delay = telegram.delay;
  message.turns = telegram.value.position.turns;
  message.position = telegram.value.position.value;
  message.velocity = telegram.value.velocity;
  message.acceleration = telegram.value.acceleration;
  message.modulo_length = telegram.modulo.enabled ? telegram.modulo.length : 0.0;
  message.modulo_start = telegram.modulo.enabled ? telegram.modulo.start : 0.0;
  message.renamed = telegram.renamed.hi;
  message.renamed_rest = telegram.renamed.lo;
  message.restarts = static_cast<std::int32_t>(telegram.restarts);
  message.flags = (telegram.valid ? leading_value_t::VALID : 0) |
                  (telegram.position_led ? leading_value_t::POSITION_LED : 0);
}

LeadingValueTelegram telegram_of(const leading_value_t& message) noexcept {
  LeadingValueTelegram telegram;
  telegram.sequence = static_cast<std::uint64_t>(message.sequence);
  telegram.run = static_cast<std::uint64_t>(message.run);
  telegram.time = message.time;
  telegram.cycle = message.cycle;
  telegram.delay = message.delay;
  telegram.value = {{message.turns, message.position}, message.velocity, message.acceleration};
  telegram.modulo.enabled = message.modulo_length != 0.0;
  if (telegram.modulo.enabled) {
    telegram.modulo.length = message.modulo_length;
    telegram.modulo.start = message.modulo_start;
  }
  telegram.renamed = {message.renamed, message.renamed_rest};
  telegram.restarts = static_cast<std::uint32_t>(message.restarts);
  telegram.valid = (message.flags & leading_value_t::VALID) != 0;
  telegram.position_led = (message.flags & leading_value_t::POSITION_LED) != 0;
  return telegram;
}

}  // namespace

std::int64_t LeadingValueLink::layout() const noexcept {
  std::uint64_t digest = 14695981039346656037u;  // FNV-1a
  const auto add = [&](std::string_view text) {
    for (const char c : text) digest = (digest ^ static_cast<std::uint8_t>(c)) * 1099511628211u;
    digest = (digest ^ 0u) * 1099511628211u;
  };
  add(area);
  add(sender);
  add(source);
  add(std::to_string(interface));
  add(std::to_string(leading_value_t::getHash()));
  return static_cast<std::int64_t>(digest);
}

LeadingValueWriter::LeadingValueWriter(LeadingValueLink link, std::int64_t run) : link_(std::move(link)) {
  message_.run = run;
  message_.layout = link_.layout();
  message_.area = link_.area;
  message_.sender = link_.sender;
  std::fill(std::begin(message_.code), std::end(message_.code), std::uint8_t{0});
  bytes_.resize(static_cast<std::size_t>(message_.getEncodedSize()));
}

std::span<const std::uint8_t> LeadingValueWriter::write(const LeadingValueTelegram& telegram) {
  set_value(message_, telegram);
  message_.encode(bytes_.data(), 0, static_cast<int>(bytes_.size()));
  if (!link_.key.empty()) {
    const MessageCode code = code_of(std::span(bytes_).first(bytes_.size() - kCode), link_.key);
    std::copy(code.begin(), code.end(), bytes_.end() - kCode);
  }
  return bytes_;
}

std::optional<leading_value_t> decode_leading_value(std::span<const std::uint8_t> bytes) {
  LcmWalk walk(bytes);
  if (walk.number(8) != static_cast<std::uint64_t>(leading_value_t::getHash()) || !walk.good())
    return std::nullopt;
  walk.skip(7 * 8 + 7 * 8 + 2 * 4);
  walk.string();
  walk.string();
  walk.skip(kCode);
  if (!walk.at_end()) return std::nullopt;
  leading_value_t message;
  if (!decode(message, bytes)) return std::nullopt;
  return message;
}

std::optional<leading_proxies_t> decode_leading_proxies(std::span<const std::uint8_t> bytes) {
  LcmWalk walk(bytes);
  if (walk.number(8) != static_cast<std::uint64_t>(leading_proxies_t::getHash()) || !walk.good())
    return std::nullopt;
  walk.skip(10 * 8);
  for (int i = 0; i < 3; ++i) walk.string();
  leading_proxies_t message;
  if (!walk.at_end() || !decode(message, bytes)) return std::nullopt;
  return message;
}

LeadingValueReader::LeadingValueReader(LeadingValueLink link)
    : link_(std::move(link)), layout_(link_.layout()) {}

std::optional<LeadingValueTelegram> LeadingValueReader::read(std::span<const std::uint8_t> bytes,
                                                             std::int64_t now) {
  const auto refused = [](std::uint64_t& count) {
    ++count;
    return std::optional<LeadingValueTelegram>();
  };
  const auto message = decode_leading_value(bytes);
  if (!message) return refused(counters_.malformed);
  if (message->area != link_.area || message->sender != link_.sender || message->layout != layout_)
    return refused(counters_.foreign);
  MessageCode expected{};
  if (!link_.key.empty()) expected = code_of(bytes.first(bytes.size() - kCode), link_.key);
  MessageCode code{};
  std::copy(std::begin(message->code), std::end(message->code), code.begin());
  if (!same_code(code, expected)) return refused(counters_.not_signed);
  // Written so that no difference overflows.
  const std::int64_t ahead = std::clamp<std::int64_t>(message->cycle, 0, kLongestAge);
  if (message->time < now - kLongestAge || message->time > now + ahead || message->sequence < 1)
    return refused(counters_.stale);
  if (is_ambiguous(*message, now)) return refused(counters_.ambiguous);
  if (is_ahead(*message)) return refused(counters_.stale);
  if (is_repeated(*message, now)) return refused(counters_.repeated);
  ++counters_.accepted;
  return telegram_of(*message);
}

/// A run that another one has replaced and that goes on in time: there are two senders. Which of them leads
/// is not to be told, so that none does until one of them has been silent for a while.
bool LeadingValueReader::is_ambiguous(const leading_value_t& message, std::int64_t now) noexcept {
  if (!known_) return false;
  if (message.run == run_)
    heard_ = now;
  else if (run_before_ != 0 && message.run == run_before_ && message.time > newest_time_)
    before_ = now;
  const auto lately = [&](const std::optional<std::int64_t>& heard) {
    return heard && now - *heard < kAmbiguousFor;
  };
  return lately(heard_) && lately(before_);
}

/// A sequence that goes on faster than a sender can count, one in each of its cycles: what it would leave
/// behind it could not be told from telegrams that are repeated.
bool LeadingValueReader::is_ahead(const leading_value_t& message) const noexcept {
  const auto sequence = static_cast<std::uint64_t>(message.sequence);
  if (!known_ || message.run != run_ || sequence <= newest_) return false;
  const std::int64_t time = std::max<std::int64_t>(message.time - time_of_newest_, 0);
  return sequence - newest_ > kWindow + static_cast<std::uint64_t>(time / std::max<std::int64_t>(cycle_, 1));
}

/// Of a run each sequence counts once, and none that is far behind; another run counts if it goes on in time.
bool LeadingValueReader::is_repeated(const leading_value_t& message, std::int64_t now) noexcept {
  const auto sequence = static_cast<std::uint64_t>(message.sequence);
  if (!known_ || message.run != run_) {
    if (known_ && message.time <= newest_time_) return true;
    if (known_) run_before_ = run_;
    known_ = true;
    run_ = message.run;
    heard_ = now;
    before_.reset();
    newest_time_ = time_of_newest_ = message.time;
    cycle_ = message.cycle;
    newest_ = sequence;
    window_ = 1;
    return false;
  }
  if (sequence > newest_) {
    const std::uint64_t further = sequence - newest_;
    window_ = further < kWindow ? window_ << further | 1u : 1u;
    newest_ = sequence;
    time_of_newest_ = message.time;
    newest_time_ = std::max(newest_time_, message.time);
    return false;
  }
  const std::uint64_t behind = newest_ - sequence;
  if (behind >= kWindow || (window_ >> behind & 1u) != 0) return true;
  window_ |= std::uint64_t{1} << behind;
  return false;
}

}  // namespace lockstep
