#include "projects/loader/project.hpp"

#include <filesystem>
#include <unordered_set>

#include "projects/assembly/sources.hpp"
#include "projects/keys/project.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/looked_at_axis.hpp"
#include "projects/loader/read_keys.hpp"

namespace lockstep {
namespace {

constexpr std::string_view kSystemVersion = "lockstep_system";

/// Warns of what nothing refers to: it may be a name that was mistyped elsewhere. Not where there are errors:
/// who refers to it may be what is wrong.
void warn_of_unused(const JsonValue& root, const Names::Uses& uses, const Loading& loading) {
  for (const auto& [section, what] :
       {std::pair{"tags", "tag"}, std::pair{"technology_objects", "technology object"}}) {
    const JsonValue* const named = root.find(section);
    if (named == nullptr) continue;
    for (const auto& [name, json] : named->members)
      if (!uses.names.contains(fold(name)) && json->find("programs") == nullptr)  // those act by themselves
        loading.problems.warn(*json, std::string("nothing uses the ") + what + " " + quote(name));
  }
}

void load_identity(const Fields& fields, const Loading& loading) {
  read_value(fields, keys::kProject["$schema"], loading);
  read_value(fields, keys::kProject["lockstep"], loading);
  if (const auto name = read_value(fields, keys::kProject["name"], loading))
    loading.project.name = name->text;
  if (const auto text = read_value(fields, keys::kProject["description"], loading))
    loading.project.description = text->text;
}

/// Whether it is a system file, of which one thing is told in place of all its keys.
bool is_of_a_system(const JsonValue& root, const Loading& loading) {
  const JsonValue* const version = root.find(kSystemVersion);
  if (version == nullptr || root.find(keys::kProject["lockstep"].name) != nullptr) return false;
  loading.problems.report_key(
      *version,
      "this is the file of a system of several controllers; allowed here: the project "
      "of one, such as those that it names in 'controllers'");
  return true;
}

void load_sections(const JsonValue& root, const Loading& loading) {
  if (is_of_a_system(root, loading)) return;
  const Fields fields(root, keys::kProject, loading.problems);
  if (!fields.usable()) return;
  load_identity(fields, loading);
  if (const auto* const clock = fields["clock"]) load_clock(*clock, loading);
  const auto* const objects = fields["technology_objects"];
  const auto* const programs = fields["programs"];
  // All names first, so that everything may refer to everything.
  if (const auto* const tags = fields["tags"]) load_tags(*tags, loading);
  if (objects != nullptr) declare_objects(*objects, loading);
  if (programs != nullptr) declare_instances(*programs, loading);
  if (objects != nullptr) load_objects(*objects, loading);
  load_transfer_areas({fields["transfer_areas"], fields["network"], objects}, loading);
  if (objects != nullptr) refuse_circles(*objects, loading);
  if (const auto* const counts = fields["telegrams"])
    read_struct(*counts, keys::kSentTelegrams, loading.project.sent_tags, loading);
  if (const auto* const lines = fields["ascii"]) load_ascii_lines(*lines, loading);
  if (programs != nullptr) load_programs(*programs, loading);
  if (const auto* const stimuli = fields["stimuli"]) load_stimuli(*stimuli, loading);
  load_modbus(fields["modbus"], loading);
  if (const auto* const trace = fields["trace"]) load_trace(*trace, loading);
  if (const auto* const studio = fields["studio"]) load_studio(*studio, loading);
  load_retain(fields["retain"], loading);
  if (const auto* const recorder = fields["flight_recorder"]) load_flight_recorder(*recorder, loading);
  if (const auto* const audit = fields["audit"]) load_audit(*audit, loading);
  load_expectations(fields["expectations"], fields["duration"], loading);
}

void load_root(const JsonValue& root, const Loading& loading) {
  Names::Uses uses{.names = loading.used_outside};
  loading.names().record(&uses);
  load_sections(root, loading);
  loading.names().record(nullptr);
  if (loading.problems.none()) warn_of_unused(root, uses, loading);
}

}  // namespace

TechnologyObject& Loading::add_object(ObjectKind kind, const std::string& name) const {
  if (use == LoadedFor::running || !among(kind, kAnyDrivenAxis)) return controller().add_object(kind, name);
  auto& objects = controller().objects;
  const auto number = static_cast<DB_ANY>(objects.size() + 1);
  return *objects.emplace_back(std::make_unique<LookedAtAxis>(kind, name, number));
}

const std::vector<LeadingValue>& Loading::leading_values_of(const TechnologyObject& axis) const {
  return static_cast<const ConfiguredAxis&>(axis).leading_values;
}

bool Loading::add_name(const JsonValue& at, std::string_view name, Names::Entity entity) const {
  std::string problem = names().add(name, entity);
  const auto [first, added] = named.try_emplace(fold(name), &at);
  if (problem.empty()) return true;
  if (!added && first->second != &at) problem += "; it is" + other_place(*first->second, at);
  problems.report_key(at, problem);
  return false;
}

std::optional<Operand> Loading::find(const JsonValue& at, std::string_view path) const {
  const FoundOperand found = names().find(path);
  if (!found.place && !found.known_problem) problems.report(at, found.problem);
  return found.place;
}

std::optional<Operand> Loading::find_elements(const JsonValue& at, std::string_view path) const {
  const FoundOperand found = names().find_elements(path);
  if (!found.place && !found.known_problem) problems.report(at, found.problem);
  return found.place;
}

TechnologyObject* Loading::find_object(const JsonValue* name, ObjectKinds kinds) const {
  const auto text = read_string(name, problems);
  if (!text) return nullptr;
  const Names::FoundObject found = names().find_object(*text, kinds);
  if (!found.problem.empty()) problems.report(*name, found.problem);
  return found.object;
}

void load_clock(const JsonValue& clock, const Loading& loading) {
  const Fields fields = read_struct(clock, keys::kClock, loading.controller().clock, loading);
  if (const auto overrun = read_value(fields, keys::kClock["overrun"], loading))
    loading.project.stop_on_overrun = overrun->integer != 0;
}

namespace {

/// What every instance of a range has in common is found again with each of them.
void drop_repeated(std::vector<Problem>& problems) {
  std::unordered_set<std::string> told;
  std::erase_if(problems, [&](const Problem& problem) {
    return !told.insert(problem.file + '\n' + problem.place + '\n' + problem.text + '\n' + problem.owner)
                .second;
  });
}

LoadedProject load(ProjectSources sources, const std::string& folder, const Prepare& prepare, LoadedFor use,
                   const UsedOutside& used_outside) {
  LoadedProject result;
  result.problems = sources.take_problems();
  drop_repeated(result.problems);
  if (!sources.usable()) return result;
  Project project;
  project.controller = std::make_unique<Controller>();
  Problems problems;
  std::unordered_map<const JsonValue*, Instance*> instances;
  std::unordered_map<std::string, const JsonValue*> named;
  load_root(sources.root(), {project, problems, instances, folder, named, use, used_outside});
  const std::vector<Problem> found = problems.take_errors();
  result.problems.insert(result.problems.end(), found.begin(), found.end());
  result.warnings = problems.take_warnings();
  if (!result.problems.empty()) return result;
  if (prepare) prepare(project);
  if (use == LoadedFor::running) project.controller->finish();
  result.project = std::move(project);
  return result;
}

std::string folder_of(const std::string& path) {
  return std::filesystem::path(path).parent_path().string();
}

}  // namespace

LoadedProject load_project(std::string_view text, const std::string& folder, const Prepare& prepare,
                           LoadedFor use) {
  return load(ProjectSources(text, folder), folder, prepare, use, {});
}

LoadedProject load_project_file(const std::string& path, const Prepare& prepare, LoadedFor use,
                                const UsedOutside& used_outside) {
  const std::string folder = folder_of(path);
  return load(ProjectSources(read_text_file(path, JsonDocument::kLongest), folder, path), folder, prepare,
              use, used_outside);
}

std::string expanded_project(const std::string& path) {
  const ProjectSources sources(read_text_file(path, JsonDocument::kLongest), folder_of(path), path);
  return sources.usable() ? expanded_text(sources.root()) : "";
}

}  // namespace lockstep
