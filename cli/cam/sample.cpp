// lockstep cam sample: points at equal distances.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include "cli/cam/cam_command.hpp"
#include "projects/cam_files/table.hpp"

namespace lockstep::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaximumSamples = 10'000'000;

struct SampleOptions {
  CamInput input;
  std::size_t count = 361;
  std::optional<double> from, to;
  bool derivatives = false;
  bool tabs = false;
  bool json = false;
  std::string output;
};

Json json_of(const std::vector<CamSample>& samples, bool derivatives) {
  Json list = Json::array();
  for (const CamSample& sample : samples) {
    Json row = {sample.x, sample.value.position};
    if (derivatives)
      for (const double value : {sample.value.first, sample.value.second, sample.value.third})
        row.push_back(value);
    list.push_back(std::move(row));
  }
  return list;
}

int sample(const SampleOptions& options, const CamDefinition& definition) {
  const CamFunction& cam = *definition.cam.function;
  const double from = options.from.value_or(cam.start_leading_value());
  const double to = options.to.value_or(cam.end_leading_value());
  if (!(from >= cam.start_leading_value() && from < to && to <= cam.end_leading_value()))
    throw CannotDo(fmt::format("--from {} --to {}: allowed is an ascending part of {} to {}", from, to,
                               cam.start_leading_value(), cam.end_leading_value()));
  const auto samples = sampled(cam, from, to, options.count);
  write_output(options.output,
               options.json ? json_of(samples, options.derivatives).dump() + "\n"
                            : cam_point_table(samples, options.derivatives,
                                              options.tabs || options.output.ends_with(".txt") ? '\t' : ','));
  return kOk;
}

}  // namespace

void add_cam_sample(CLI::App& cam, Action& action) {
  CLI::App* command = cam.add_subcommand("sample", "A list of points at equal distances, for spreadsheets");
  auto options = std::make_shared<SampleOptions>();
  add_cam_input(*command, options->input);
  command->add_option("--count", options->count, "points; without it: 361")
      ->check(CLI::Range(std::size_t{2}, kMaximumSamples));
  command->add_option("--from", options->from, "first leading value; without it: the start of the cam");
  command->add_option("--to", options->to, "last leading value; without it: its end");
  command->add_flag("--derivatives", options->derivatives, "velocity, acceleration and jerk as well");
  command->add_flag("--tabs", options->tabs, "separate by tabs; without it by commas, in a .txt by tabs");
  command->add_flag("--json", options->json, "an array of rows");
  command->add_option("-o,--output", options->output, "the file; without it: standard output");
  command->footer(
      "A row a point: leading value, following value, velocity, acceleration, jerk; derivatives with respect "
      "to\n"
      "the leading value. Where something steps, the row holds what is behind the step.");
  command->callback([&action, options] {
    action = [options] {
      return with_cam(options->input,
                      [&](const CamDefinition& definition) { return sample(*options, definition); });
    };
  });
}

}  // namespace lockstep::cli
