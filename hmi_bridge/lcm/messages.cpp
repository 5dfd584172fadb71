#include "hmi_bridge/lcm/messages.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "hmi_bridge/lcm/wire.hpp"

namespace lockstep {
namespace {

// Types of which a double loses values.
bool needs_exact(Type type) noexcept {
  return size_of(type) == 8 && type != Type::LREAL;
}

Type type_named(std::string_view name) noexcept {
  for (auto i = static_cast<int>(Type::BOOL); i <= static_cast<int>(Type::TAG); ++i)
    if (type_name(static_cast<Type>(i)) == name) return static_cast<Type>(i);
  return Type::LREAL;  // a later version's type still has its value as a double
}

/// FNV-1a, 64 bit: the same trace has the same id in every run and on every machine.
class Fingerprint {
 public:
  void add(std::string_view text) noexcept {
    for (const char c : text) add_byte(static_cast<unsigned char>(c));
    add_byte(0);
  }
  void add(std::int64_t number) noexcept {
    for (int shift = 0; shift < 64; shift += 8) add_byte(static_cast<unsigned char>(number >> shift));
  }
  std::int64_t value() const noexcept { return static_cast<std::int64_t>(hash_); }

 private:
  void add_byte(unsigned char byte) noexcept { hash_ = (hash_ ^ byte) * 0x100000001b3u; }
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

std::int64_t fingerprint(const trace_header_t& header) noexcept {
  Fingerprint id;
  id.add(header.project);
  id.add(header.channel);
  id.add(header.period);
  for (const auto* texts : {&header.names, &header.types, &header.units})
    for (const std::string& text : *texts) id.add(text);
  return id.value();
}

constexpr std::size_t kMinimumSignal = 3 * 5 + 4;  // three empty strings and an index

/// Whether a header holds all that it says.
bool header_fits(std::span<const std::uint8_t> bytes) noexcept {
  LcmWalk walk(bytes);
  walk.skip(8);  // hash
  const std::uint64_t signals = walk.count(kMinimumSignal);
  walk.skip(8);  // id
  walk.string();
  walk.string();
  walk.skip(8);  // period
  for (std::uint64_t i = 0; i < 3 * signals && walk.good(); ++i) walk.string();
  return walk.good();
}

/// What a row says of itself.
struct RowShape {
  std::int64_t header_id;
  std::uint64_t values, exact;  // how many
};

/// None if the row does not hold all that it says.
std::optional<RowShape> row_shape(std::span<const std::uint8_t> bytes) noexcept {
  LcmWalk walk(bytes);
  walk.skip(2 * 8);  // hash, utime
  RowShape shape{};
  shape.header_id = static_cast<std::int64_t>(walk.number(8));
  walk.skip(4 * 8);
  shape.values = walk.count(8);
  walk.skip(8 * shape.values);
  shape.exact = walk.count(8);
  return walk.good() ? std::optional(shape) : std::nullopt;
}

}  // namespace

void check_channel(const std::string& channel) {
  if (channel.empty() || channel.size() > kLongestTraceChannel)
    throw std::invalid_argument("LCM channel \"" + channel + "\": 1 to " +
                                std::to_string(kLongestTraceChannel) + " characters are allowed");
}

LcmEncoder::LcmEncoder(LcmTraceIdentity identity, std::span<const TraceSignal> signals)
    : identity_(std::move(identity)) {
  header_.n = row_.n = static_cast<std::int32_t>(signals.size());
  header_.project = identity_.project;
  header_.channel = identity_.channel;
  header_.period = identity_.period;
  row_.n_exact = 0;
  for (const TraceSignal& signal : signals) {
    types_.push_back(signal.type);
    header_.names.push_back(signal.name);
    header_.types.emplace_back(type_name(signal.type));
    header_.units.push_back(signal.unit);
    header_.exact_index.push_back(needs_exact(signal.type) ? row_.n_exact++ : -1);
  }
  header_.id = row_.header_id = fingerprint(header_);
  row_.values.resize(signals.size());
  row_.exact.resize(static_cast<std::size_t>(row_.n_exact));
  bytes_.resize(std::max(header_size(), row_size()));
}

template <class Message>
std::span<const std::uint8_t> LcmEncoder::encode(const Message& message) {
  const int size = message.encode(bytes_.data(), 0, static_cast<int>(bytes_.size()));
  return {bytes_.data(), static_cast<std::size_t>(size)};
}

std::span<const std::uint8_t> LcmEncoder::header() {
  return encode(header_);
}

std::span<const std::uint8_t> LcmEncoder::row(const TraceRow& row) {
  row_.utime = identity_.utime(row.t);
  row_.t = row.t;
  row_.tick = static_cast<std::int64_t>(row.tick);
  row_.number = rows_++;
  row_.dropped = static_cast<std::int64_t>(row.dropped);
  for (std::size_t i = 0; i < types_.size(); ++i) {
    row_.values[i] = as_double(row.values[i], types_[i]);
    if (const int exact = header_.exact_index[i]; exact >= 0) row_.exact[exact] = row.values[i].i;
  }
  return encode(row_);
}

std::span<const std::uint8_t> LcmEncoder::event(const TraceEvent& event) {
  event_t message{};
  message.utime = identity_.utime(event.t);
  message.t = event.t;
  message.tick = static_cast<std::int64_t>(event.tick);
  message.lost = static_cast<std::int64_t>(event.lost);
  message.kind = event_kind_text(event.kind);
  message.source = event.source;
  message.type = event.type;
  message.number = event.number;
  message.text = event.text;
  message.reaction = event.reaction;
  message.reaction_text = event.reaction_text;
  bytes_.resize(std::max(bytes_.size(), static_cast<std::size_t>(message.getEncodedSize())));
  return encode(message);
}

bool has_detail(const TraceEvent& event) noexcept {
  return event.kind == EventKind::alarm || event.kind == EventKind::job_failed ||
         event.kind == EventKind::job_aborted;
}

std::span<const std::uint8_t> LcmEncoder::detail(const TraceEvent& event) {
  event_detail_t message{};
  message.utime = identity_.utime(event.t);
  message.t = event.t;
  message.tick = static_cast<std::int64_t>(event.tick);
  message.kind = event_kind_text(event.kind);
  message.source = event.source;
  message.number = event.number;
  message.object = event.object;
  message.cause = event.kind == EventKind::job_aborted ? event.text : event.cause;
  message.remedy = event.remedy;
  message.address = event.address;
  message.cause_number = event.cause_number;
  message.sensor = event.sensor;
  const auto add = [&](const std::string& name, double value) {
    message.names.push_back(name);
    message.values.push_back(value);
    ++message.n;
  };
  if (event.has_value()) add(event.value_name, event.value);
  if (event.has_value() && event.has_limit()) add(event.limit_name, event.limit);
  message.unit = event.unit;
  bytes_.resize(std::max(bytes_.size(), static_cast<std::size_t>(message.getEncodedSize())));
  return encode(message);
}

LcmDecoder::Message LcmDecoder::accept(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 8 || bytes.size() > INT32_MAX) return Message::kForeign;
  const auto hash = static_cast<std::int64_t>(LcmWalk(bytes).number(8));
  if (hash == trace_header_t::getHash()) return accept_header(bytes);
  if (hash == trace_row_t::getHash()) return accept_row(bytes);
  return Message::kForeign;
}

std::size_t LcmDecoder::signals_announced(std::span<const std::uint8_t> bytes) noexcept {
  LcmWalk walk(bytes);
  const auto hash = static_cast<std::int64_t>(walk.number(8));
  return hash == trace_header_t::getHash() ? walk.count(kMinimumSignal) : 0;
}

LcmDecoder::Message LcmDecoder::accept_header(std::span<const std::uint8_t> bytes) {
  trace_header_t header;
  if (!header_fits(bytes) || !decode(header, bytes)) return Message::kDamaged;
  std::vector<TraceSignal> signals;
  int n_exact = 0;
  for (int i = 0; i < header.n; ++i) {
    const Type type = type_named(header.types[i]);
    if (header.exact_index[i] != (needs_exact(type) ? n_exact++ : -1)) return Message::kDamaged;
    signals.push_back({header.names[i], type, header.units[i]});
  }
  header_ = std::move(header);
  signals_ = std::move(signals);
  values_.assign(signals_.size(), Value{});
  has_header_ = true;
  return Message::kHeader;
}

LcmDecoder::Message LcmDecoder::accept_row(std::span<const std::uint8_t> bytes) {
  // Before it is decoded: what is kept of a row is never more than its header tells.
  const auto shape = row_shape(bytes);
  if (!shape) return Message::kDamaged;
  if (!has_header_ || shape->header_id != header_.id) return Message::kEarly;
  if (shape->values != signals_.size() || shape->exact > shape->values) return Message::kDamaged;
  if (!decode(row_, bytes)) return Message::kDamaged;
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    const Type type = signals_[i].type;
    const int exact = header_.exact_index[i];
    if (exact >= row_.n_exact) return Message::kDamaged;
    if (exact >= 0)
      values_[i].i = row_.exact[exact];
    else if (is_real(type))
      values_[i].r = row_.values[i];
    else if (row_.values[i] >= static_cast<double>(lowest(type)) &&
             row_.values[i] <= static_cast<double>(highest(type)))
      values_[i].i = static_cast<std::int64_t>(row_.values[i]);  // at most 32 bits, so signed or not is one
    else
      return Message::kDamaged;  // NaN too
  }
  return Message::kRow;
}

TraceRow LcmDecoder::row() const noexcept {
  return {row_.t, static_cast<std::uint64_t>(row_.tick), static_cast<std::uint64_t>(row_.dropped), values_};
}

}  // namespace lockstep
