// External encoders: what they measure.
#include <algorithm>

#include "projects/loader/drive.hpp"
#include "projects/loader/loader.hpp"

namespace lockstep {
namespace {

constexpr double kLargest = kPositionRange;  // of lengths [u]
constexpr double kShortestWrap = 0.001;      // [u]

/// A signal that an encoder can read: a whole number.
std::optional<Signal> find_number(const JsonValue& json, const Loading& loading) {
  const auto path = read_string(&json, loading.problems);
  if (!path) return std::nullopt;
  const auto place = loading.find(json, *path);
  if (!place) return std::nullopt;
  const Signal signal = place->signal;
  if (signal.bit >= 0 || !is_numeric(signal.type)) {
    loading.problems.report(json, quote(*path) + " is of type " +
                                      std::string(type_name(signal.value_type())) +
                                      "; allowed: a number, whose value is the position");
    return std::nullopt;
  }
  return signal;
}

void load_source(const Fields& fields, SimulatedEncoderSettings& source, const Loading& loading) {
  Problems& problems = loading.problems;
  const JsonValue* const follows = fields["follows"];
  const JsonValue* const signal = fields["signal"];
  if ((follows == nullptr) == (signal == nullptr))
    problems.report(fields.value(),
                    "an encoder measures one thing; allowed is one of the keys 'follows' (an axis) and "
                    "'signal' (a number)");
  if (follows != nullptr)
    source.follows = static_cast<LeadingObject*>(loading.find_object(follows, kAnyAxis));
  if (signal != nullptr)
    if (const auto found = find_number(*signal, loading)) source.signal = *found;
  const JsonValue* const valid = fields["valid"];
  source.valid = find_bool_tag(valid, loading);
  if (valid != nullptr && signal == nullptr && follows != nullptr)
    problems.report(*valid, "'valid' is allowed with 'signal' only");
  const JsonValue* const ratio = fields["ratio"];
  if (const auto value = read_number(ratio, -kLargest, kLargest, problems)) {
    source.ratio = *value;
    if (*value == 0.0) problems.report(*ratio, "0 is not allowed; allowed: any other number");
  }
  if (ratio != nullptr && follows == nullptr && signal != nullptr)
    problems.report(*ratio, "'ratio' is allowed with 'follows' only");
  const JsonValue* const wrap = fields["wrap"];
  if (const auto value = read_number(wrap, kShortestWrap, kLargest, problems)) source.wrap = *value;
  if (wrap != nullptr && signal == nullptr && follows != nullptr)
    problems.report(*wrap, "'wrap' is allowed with 'signal' only: an axis counts its turns");
}

}  // namespace

void load_encoder(const JsonValue& json, ExternalEncoder& encoder, const Loading& loading) {
  Problems& problems = loading.problems;
  const Fields object(json, keys::kEncoderObject, problems);
  if (const JsonValue* const config = object["config"]) load_configuration(*config, encoder, loading);
  const JsonValue* const source = object["encoder"];
  if (source == nullptr) return;
  const Fields fields(*source, keys::kEncoder, problems);
  if (!fields.usable()) return;
  read_word(fields["model"], words::kModels, problems);
  load_source(fields, encoder.source_settings, loading);
  if (const auto resolution = read_number(fields["resolution"], 0.0, kLargest, problems))
    encoder.source_settings.resolution = *resolution;
  if (const auto noise = read_number(fields["noise"], 0.0, kLargest, problems))
    encoder.source_settings.noise = *noise;
  load_homing_marks(fields, encoder.source_settings.signals, loading);
}

}  // namespace lockstep
