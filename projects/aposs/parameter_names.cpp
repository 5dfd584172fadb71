#include "projects/aposs/parameter_names.hpp"

#include <algorithm>
#include <charconv>
#include <vector>

#include "projects/json/problem.hpp"

namespace lockstep::aposs {
namespace {

constexpr ParameterName kParameters[] = {
    {3200, "ENCODERTYPE", false},
    {3201, "ENCODER", false},
    {3202, "ENCODERABSTYPE", false},
    {3203, "ENCODERABSRES", false},
    {3204, "ENCODERBAUD", true},
    {3205, "ENCODERDATLEN", false},
    {3206, "ENCODERFREQ", false},
    {3207, "ENCODERCLOCK", false},
    {3208, "ENCODERDELAY", false},
    {3209, "ENCODERMONITORING", false},
    {3210, "POSDRCT", false},
    {3211, "POSFACT_N", false},
    {3212, "POSFACT_Z", false},
    {3213, "ENCCONTROL", true},
    {3214, "", true},
    {3215, "", true},
    {3230, "MENCODERTYPE", false},
    {3231, "MENCODER", false},
    {3232, "MENCODERABSTYPE", false},
    {3233, "MENCODERABSRES", false},
    {3234, "MENCODERBAUD", true},
    {3235, "MENCODERDATLEN", false},
    {3236, "MENCODERFREQ", false},
    {3237, "MENCODERCLOCK", false},
    {3238, "MENCODERDELAY", false},
    {3239, "MENCODERMONITORING", false},
    {3240, "MENCODERTERM", false},
    {3243, "MENCCONTROL", true},
    {3244, "", true},
    {3245, "", true},
    {3250, "", false},
    {3252, "", true},
    {3260, "KPROP", false},
    {3261, "KDER", false},
    {3262, "KINT", false},
    {3263, "KILIM", false},
    {3264, "BANDWIDTH", false},
    {3265, "FFVEL", false},
    {3266, "FFACC", false},
    {3267, "POSERR", false},
    {3268, "REVERS", false},
    {3269, "TIMER", false},
    {3270, "PROFTIME", false},
    {3271, "REGWMAX", false},
    {3272, "REGWMIN", false},
    {3273, "KILIMTIME", true},
    {3274, "POSERRTIME", true},
    {3280, "VELMAX", false},
    {3281, "RAMPMIN", false},
    {3282, "RAMPTYPE", false},
    {3283, "VELRES", false},
    {3284, "DFLTVEL", false},
    {3285, "DFLTACC", false},
    {3286, "JERKMIN", false},
    {3287, "JERKMIN2", false},
    {3288, "JERKMIN3", false},
    {3289, "JERKMIN4", false},
    {3300, "HOME_FORCE", false},
    {3301, "HOME_OFFSET", false},
    {3302, "HOME_RAMP", false},
    {3303, "HOME_VEL", false},
    {3304, "HOME_TYPE", false},
    {3310, "SYNCFACTM", false},
    {3311, "SYNCFACTS", false},
    {3312, "SYNCPOSOFFS", false},
    {3313, "SYNCACCURACY", false},
    {3314, "SYNCVELREL", false},
    {3315, "SYNCMARKM", false},
    {3316, "SYNCMARKS", false},
    {3317, "SYNCMPULSM", false},
    {3318, "SYNCMPULSS", false},
    {3319, "SYNCMTYPM", false},
    {3320, "SYNCMTYPS", false},
    {3321, "SYNCMWINM", false},
    {3322, "SYNCMWINS", false},
    {3323, "SYNCMSTART", false},
    {3324, "SYNCFAULT", false},
    {3325, "SYNCREADY", false},
    {3326, "SYNCVFTIME", false},
    {3327, "SYNCOFFTIME", false},
    {3328, "SYNCMFPAR", false},
    {3329, "SYNCMFTIME", false},
    {3330, "SYNCMMAXCORR", false},
    {3331, "SYNCTYPE", false},
    {3332, "SYNCFFVEL", true},
    {3333, "SYNCVFLIMIT", true},
    {3340, "ENDSWMOD", false},
    {3341, "NEGLIMIT", false},
    {3342, "POSLIMIT", false},
    {3343, "SWNEGLIMACT", false},
    {3344, "SWPOSLIMACT", false},
    {3345, "TESTTIM", false},
    {3346, "TESTVAL", false},
    {3347, "TESTWIN", false},
    {3350, "I_FUNCTION_1", false},
    {3351, "I_FUNCTION_2", false},
    {3352, "I_FUNCTION_3", false},
    {3353, "I_FUNCTION_4", false},
    {3354, "I_FUNCTION_5", false},
    {3355, "I_FUNCTION_6", false},
    {3356, "I_FUNCTION_7", false},
    {3357, "I_FUNCTION_8", false},
    {3358, "I_FUNCTION_9", false},
    {3359, "I_FUNCTION_10", false},
    {3360, "IOMODE", false},
    {3361, "I_FUNCTION_11", false},
    {3362, "I_FUNCTION_12", false},
    {3363, "O_FUNCTION_1", false},
    {3364, "O_FUNCTION_2", false},
    {3365, "O_FUNCTION_3", false},
    {3366, "O_FUNCTION_4", false},
    {3367, "O_FUNCTION_5", false},
    {3368, "O_FUNCTION_6", false},
    {3369, "O_FUNCTION_7", false},
    {3370, "O_FUNCTION_8", false},
    {3380, "PRGPAR", false},
    {3381, "", false},
    {3382, "STATUSMONITORING", false},
    {3383, "ERRCOND", false},
    {3384, "ESCCOND", false},
    {3385, "EXTERNAL24V", false},
    {3390, "CANNR", true},
    {3391, "CANBAUD", true},
    {3394, "RSTERMINATION", true},
    {3395, "RSBAUDRATE", true},
    {3401, "", false},
    {3402, "", false},
    {3403, "", false},
    {3404, "", false},
    {3405, "", false},
    {3406, "", false},
    {3407, "", false},
    {3408, "", false},
    {3409, "", false},
    {3410, "", false},
    {3421, "", false},
    {3422, "", false},
    {3423, "", false},
    {3424, "", false},
    {3425, "", false},
    {3426, "", false},
    {3427, "", false},
    {3428, "", false},
    {3429, "", false},
    {3430, "", false},
    {3440, "", false},
    {3441, "", false},
    {3450, "", false},
    {3451, "", false},
    {3452, "", false},
    {3453, "", false},
    {3454, "", false},
    {3455, "", false},
    {3456, "", false},
    {3457, "", false},
    {3458, "", false},
    {3459, "", false},
    {3460, "", false},
    {3461, "", false},
    {3462, "", false},
    {3470, "", false},
    {3471, "", false},
};

struct OldName {
  std::string_view name;
  std::int32_t function;  ///< of the input, normally open
};
constexpr OldName kOldNames[] = {{"I_REFSWITCH", 1}, {"I_NEGLIMITSW", 3}, {"I_POSLIMITSW", 5},
                                 {"I_ERRCLR", 7},    {"I_BREAK", 9},      {"I_CONTINUE", 11},
                                 {"I_PRGSTART", 13}, {"I_PRGCHOICE", 15}};

std::optional<std::int32_t> number_of(std::string_view digits) {
  std::int32_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (digits.empty() || error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return number;
}

/// I_FUNCTION_n_m.
std::optional<std::int32_t> input_function(std::string_view name) {
  constexpr std::string_view kBegin = "I_FUNCTION_";
  if (!name.starts_with(kBegin)) return std::nullopt;
  name.remove_prefix(kBegin.size());
  const std::size_t bar = name.find('_');
  if (bar == name.npos) return std::nullopt;
  const auto function = number_of(name.substr(0, bar)), input = number_of(name.substr(bar + 1));
  if (!function || !input || *function < 1 || *function > 15 || *input < 1 || *input > 12)
    return std::nullopt;
  return kInputFunction + 100 * *function + *input;
}

}  // namespace

std::span<const ParameterName> parameter_names() noexcept {
  return kParameters;
}

std::optional<std::int32_t> parameter_number(std::string_view name) {
  if (name.empty()) return std::nullopt;
  for (const ParameterName& parameter : kParameters)
    if (parameter.mnemonic == name) return parameter.number;
  for (const OldName& old : kOldNames)
    if (old.name == name) return kInputFunction + 100 * old.function;
  return input_function(name);
}

bool is_parameter(std::int32_t number) noexcept {
  if (number >= kFirstApplicationParameter && number <= kLastApplicationParameter) return true;
  return std::any_of(std::begin(kParameters), std::end(kParameters),
                     [number](const ParameterName& parameter) { return parameter.number == number; });
}

std::string parameter_text(std::int32_t number) {
  if (number < 2000) return std::to_string(number);
  const std::string rest = std::to_string(number % 100);
  return std::to_string(number / 100) + (rest.size() < 2 ? "-0" : "-") + rest;
}

std::string nearest_parameter(std::string_view name) {
  std::vector<std::string_view> names;
  for (const ParameterName& parameter : kParameters)
    if (!parameter.mnemonic.empty()) names.push_back(parameter.mnemonic);
  const std::string hint = did_you_mean(name, names);
  const std::size_t begin = hint.find('\''), end = hint.rfind('\'');
  if (begin == hint.npos || end <= begin) return "";
  const std::string found = hint.substr(begin + 1, end - begin - 1);
  return found + " " + parameter_text(*parameter_number(found));
}

}  // namespace lockstep::aposs
