// lockstep describe override: what a new job does to those that run.
#include "tech_objects/jobs/override.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/describe/subject.hpp"
#include "cli/describe/table.hpp"
#include "projects/json/problem.hpp"

namespace lockstep::cli {
namespace {

/// A class of jobs in words.
struct ClassText {
  JobClass job_class;
  std::string_view instructions;  ///< separated by ", "
  std::string_view which;         ///< empty: all of their jobs
};

constexpr std::string_view kSingle = "MC_Halt, MC_MoveAbsolute, MC_MoveRelative, MC_MoveVelocity, MC_MoveJog";

constexpr ClassText kClasses[] = {
    {JobClass::home_passive, "MC_Home", "Mode 2, 8, 10"},
    {JobClass::home_active, "MC_Home", "Mode 3, 5"},
    {JobClass::home_cancel, "MC_Home", "Mode 9"},
    {JobClass::home_direct, "MC_Home", "Mode 0, 1, 6, 7, 11, 12, 13"},
    {JobClass::motion, kSingle, ""},
    {JobClass::stop, "MC_Stop", ""},
    {JobClass::superimposed, "MC_MoveSuperimposed, MC_MotionInSuperimposed, MC_HaltSuperimposed", ""},
    {JobClass::motion_in, "MC_MotionInVelocity, MC_MotionInPosition", ""},
    {JobClass::gear_in, "MC_GearIn", ""},
    {JobClass::gear_in_velocity, "MC_GearInVelocity", ""},
    {JobClass::gear_in_pos_waiting, "MC_GearInPos", "waiting"},
    {JobClass::gear_in_pos_active, "MC_GearInPos", "active"},
    {JobClass::cam_in_waiting, "MC_CamIn", "waiting"},
    {JobClass::cam_in_active, "MC_CamIn", "active"},
    {JobClass::phasing, "MC_PhasingAbsolute, MC_PhasingRelative", ""},
    {JobClass::offset, "MC_OffsetAbsolute, MC_OffsetRelative", ""},
    {JobClass::leading_value_additive, "MC_LeadingValueAdditive", ""},
    {JobClass::gear_out_waiting, "MC_GearOut", "waiting"},
    {JobClass::gear_out_active, "MC_GearOut", "active"},
    {JobClass::cam_out_waiting, "MC_CamOut", "waiting"},
    {JobClass::cam_out_active, "MC_CamOut", "active"},
    {JobClass::measuring, "MC_MeasuringInput, MC_MeasuringInputCyclic", ""},
    {JobClass::measuring_abort, "MC_AbortMeasuringInput", ""},
};

std::vector<std::string_view> instructions_of(const ClassText& text) {
  std::vector<std::string_view> names;
  for (std::string_view rest = text.instructions; !rest.empty();) {
    const auto end = std::min(rest.find(", "), rest.size());
    names.push_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 2, rest.size()));
  }
  return names;
}

std::vector<ClassText> classes_of(std::string_view instruction) {
  std::vector<ClassText> classes;
  for (const ClassText& text : kClasses)
    for (const std::string_view name : instructions_of(text))
      if (same_name(name, instruction)) classes.push_back(text);
  return classes;
}

const OverrideException* exception_of(JobClass new_job, JobClass running) {
  static const auto exceptions = override_exceptions();
  for (const OverrideException& exception : exceptions)
    if (exception.new_job == new_job && exception.running == running) return &exception;
  return nullptr;
}

std::string_view effect_text(OverrideEffect effect) {
  switch (effect) {
    case OverrideEffect::none:
      return "no effect";
    case OverrideEffect::abort:
      return "aborts it";
    case OverrideEffect::reject:
      return "is rejected";
    case OverrideEffect::abort_by_rank:
      return "aborts it if its stop is the same or stronger";
  }
  return "";
}

/// A cell in words; a footnote's condition is told, an exception marked.
std::string cell(JobClass new_job, JobClass running) {
  const OverrideEffect controlled = override_effect(new_job, running, true);
  const OverrideEffect free = override_effect(new_job, running, false);
  std::string text(effect_text(controlled));
  if (free != controlled) text += "; without position control: " + std::string(effect_text(free));
  return exception_of(new_job, running) != nullptr ? text + " *" : text;
}

/// Line of the manual's table that has the cell; 0: it stands in none.
int line_of(JobClass new_job, JobClass running) {
  const std::size_t table = running == JobClass::measuring ? 2 : running < JobClass::gear_in ? 0 : 1;
  return override_rows()[static_cast<std::size_t>(new_job)].lines[table];
}

std::string running_name(const ClassText& running) {
  return std::string(running.instructions) +
         (running.which.empty() ? "" : " (" + std::string(running.which) + ")");
}

/// Whether a job can meet a running one: measuring inputs have jobs of their own, and only MC_Home has its
/// row in their table and in those of axes.
bool meets(JobClass new_job, JobClass running) {
  if (static_cast<int>(running) >= kRunningClasses) return false;
  if (running == JobClass::measuring) return line_of(new_job, running) != 0;
  return new_job != JobClass::measuring && new_job != JobClass::measuring_abort;
}

std::string class_page(std::string_view instruction, const ClassText& own, std::size_t width) {
  Table table({"Running job", "Line", "What becomes of it"});
  std::vector<std::string_view> reasons;
  for (const ClassText& running : kClasses) {
    if (!meets(own.job_class, running.job_class)) continue;
    const int line = line_of(own.job_class, running.job_class);
    std::vector<std::string> names = wrapped(running_name(running), 36);
    table.row({names.front(), line == 0 ? "" : std::to_string(line), cell(own.job_class, running.job_class)});
    for (std::size_t i = 1; i < names.size(); ++i) table.row({"  " + names[i], "", ""});
    if (const auto* exception = exception_of(own.job_class, running.job_class))
      if (std::find(reasons.begin(), reasons.end(), exception->reason) == reasons.end())
        reasons.push_back(exception->reason);
  }
  std::string text = "\nA new " + std::string(instruction);
  text += (own.which.empty() ? "" : ", " + std::string(own.which)) + "\n" + table.text(2, width);
  for (const std::string_view reason : reasons)
    text += paragraph("* differs from the printed table on purpose: " + std::string(reason), 2, width);
  return text;
}

std::string instruction_text(std::string_view instruction, std::size_t width) {
  std::string text = "Override by " + std::string(instruction) + "\n";
  text += paragraph(
      "What a new job does to those that run on the axis or at its measuring inputs. Line: of the "
      "manual's text, S7-1500T synchronous operation V7, 12.3.",
      2, width);
  const auto classes = classes_of(instruction);
  const bool waits = std::any_of(classes.begin(), classes.end(),
                                 [](const ClassText& own) { return own.which == "waiting"; });
  if (waits)
    text += paragraph(
        "A job waits until its start condition is met and is active from then on; each has "
        "effects of its own.",
        2, width);
  for (const ClassText& own : classes) text += class_page(instruction, own, width);
  return text;
}

std::string_view effect_name(OverrideEffect effect) {
  constexpr std::string_view names[] = {"none", "abort", "reject", "abort_by_rank"};
  return names[static_cast<std::size_t>(effect)];
}

nlohmann::ordered_json cell_json(JobClass new_job, const ClassText& running) {
  nlohmann::ordered_json json{
      {"running", instructions_of(running)},
      {"which", running.which},
      {"effect", effect_name(override_effect(new_job, running.job_class, true))},
      {"effect_without_position_control", effect_name(override_effect(new_job, running.job_class, false))}};
  if (const int line = line_of(new_job, running.job_class); line != 0) json["line"] = line;
  if (const auto* exception = exception_of(new_job, running.job_class)) json["exception"] = exception->reason;
  return json;
}

nlohmann::ordered_json instruction_json(std::string_view instruction) {
  nlohmann::ordered_json json{{"kind", "override"}, {"instruction", instruction}};
  auto& rows = json["new_jobs"] = nlohmann::ordered_json::array();
  for (const ClassText& own : classes_of(instruction)) {
    nlohmann::ordered_json row{{"which", own.which}};
    auto& cells = row["running_jobs"] = nlohmann::ordered_json::array();
    for (const ClassText& running : kClasses)
      if (meets(own.job_class, running.job_class)) cells.push_back(cell_json(own.job_class, running));
    rows.push_back(std::move(row));
  }
  return json;
}

std::string overrides_text(std::size_t width) {
  std::string text = "Override\n";
  text += paragraph(
      "What a new job does to those that run on the axis or at its measuring inputs: lockstep "
      "describe override INSTRUCTION, with one of",
      2, width);
  for (const std::string_view name : override_names()) text += "    " + std::string(name) + "\n";
  return text;
}

}  // namespace

std::vector<std::string_view> override_names() {
  std::vector<std::string_view> names;
  for (const ClassText& text : kClasses)
    for (const std::string_view name : instructions_of(text))
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

Subject overrides_subject() {
  return {&overrides_text, [] {
            return nlohmann::ordered_json{{"kind", "overrides"}, {"instructions", override_names()}};
          }};
}

Subject override_subject(std::string_view instruction) {
  for (const std::string_view name : override_names())
    if (same_name(name, instruction))
      return {[name](std::size_t width) { return instruction_text(name, width); },
              [name] { return instruction_json(name); }};
  return {};
}

}  // namespace lockstep::cli
