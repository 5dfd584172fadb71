// External encoders: what they measure.
#include "projects/keys/objects.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/read_keys.hpp"

namespace lockstep {
namespace {

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

/// What goes with one of the two things that an encoder may measure.
void check_source(const Fields& fields, Problems& problems) {
  const JsonValue* const follows = fields["follows"];
  const JsonValue* const signal = fields["signal"];
  if ((follows == nullptr) == (signal == nullptr))
    problems.report(fields.value(),
                    "an encoder measures one thing; allowed is one of the keys 'follows' (an axis) and "
                    "'signal' (a number)");
  const JsonValue* const valid = fields["valid"];
  if (valid != nullptr && signal == nullptr && follows != nullptr)
    problems.report(*valid, "'valid' is allowed with 'signal' only");
  const JsonValue* const ratio = fields["ratio"];
  if (ratio != nullptr && follows == nullptr && signal != nullptr)
    problems.report(*ratio, "'ratio' is allowed with 'follows' only");
  const JsonValue* const wrap = fields["wrap"];
  if (wrap != nullptr && signal == nullptr && follows != nullptr)
    problems.report(*wrap, "'wrap' is allowed with 'signal' only: an axis counts its turns");
}

}  // namespace

void load_encoder(const JsonValue& json, ExternalEncoder& encoder, const Loading& loading) {
  Problems& problems = loading.problems;
  const Fields object(json, keys::kObjects, variant_of(encoder), problems);
  if (const JsonValue* const config = object["config"]) {
    load_configuration(*config, encoder, loading);
    check_delay(*config, encoder.data.CrossPlcSynchronousOperation.LocalLeadingValueDelayTime, loading);
  }
  const JsonValue* const source = object["encoder"];
  if (source == nullptr) return;
  const std::size_t model = read_variant(*source, keys::kEncoders, problems).value_or(0);
  const Fields fields(*source, keys::kEncoders, model, problems);
  if (!fields.usable()) return;
  check_source(fields, problems);
  read_members(fields, keys::kEncoders[model].keys, &encoder.source_settings, loading);
  if (const JsonValue* const signal = fields["signal"])
    if (const auto found = find_number(*signal, loading)) encoder.source_settings.signal = *found;
}

}  // namespace lockstep
