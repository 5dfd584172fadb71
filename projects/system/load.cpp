// Loads system files: names first, then the projects, then what hangs together.
#include <algorithm>
#include <filesystem>

#include "projects/json/fields.hpp"
#include "projects/loader/network.hpp"
#include "projects/loader/provided_value.hpp"
#include "projects/loader/read_keys.hpp"
#include "projects/system/couple.hpp"
#include "projects/system/system.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

/// "CONTROLLER.OBJECT" in a system file.
struct FullName {
  const JsonValue* json = nullptr;
  std::size_t controller = 0;
  std::string_view object;
};

/// An area before the projects are there.
struct NamedArea {
  std::string name;
  const JsonValue* json = nullptr;
  int interface = 1;
  std::optional<FullName> from{};
  std::vector<FullName> to{};
};

class SystemLoader {
 public:
  SystemLoader(const JsonValue& root, std::string folder, LoadedFor use, SeveralSources sources)
      : root_(root), folder_(std::move(folder)), use_(use), sources_(sources) {}

  /// The only controller that is to run.
  void run_alone(std::string_view controller, const PrepareController& prepare) {
    alone_ = controller;
    prepare_ = &prepare;
  }

  LoadedSystem load();

 private:
  void read_controllers(const JsonValue* controllers);
  void read_controller(const std::string& name, const JsonValue& json);
  void read_areas(const JsonValue* areas);
  NamedArea read_area(const std::string& name, const JsonValue& json);
  std::optional<FullName> full_name_at(const JsonValue* json);
  std::vector<FullName> full_names_at(const JsonValue* json);
  void read_networks(const Fields& fields);
  void read_delays(const JsonValue* json);
  void load_projects();
  void take_problems(std::vector<Problem> from, std::vector<Problem>& into, const std::string& file) const;

  TechnologyObject* find_object(const FullName& name, ObjectKinds kinds);
  void connect(const NamedArea& named);
  bool source_fits(const NamedArea& named, const SystemArea& area);
  bool receiver_fits(const FullName& name, const SystemArea& area, const SystemArea::Receiver& receiver);
  bool cycles_fit(const FullName& name, const SystemArea& area, const SystemArea::Receiver& receiver);
  void check_phases();
  std::vector<KeptDelays::Axis> kept(const std::vector<FullName>& names, ObjectKinds kinds);

  const JsonValue& root_;
  std::string folder_;
  LoadedFor use_;
  SeveralSources sources_;
  std::string_view alone_;  // empty: all run
  const PrepareController* prepare_ = nullptr;
  Problems problems_;
  System system_;
  std::vector<const JsonValue*> places_;  // of the controllers
  std::vector<NamedArea> areas_;
  std::vector<FullName> fixed_, left_out_;
  std::vector<Problem> of_projects_, warnings_of_projects_;
  bool projects_valid_ = true;
};

/// The keys of a system refer to nothing in a project: this is what they are read with.
struct NoProject {
  Project project;
  std::unordered_map<const JsonValue*, Instance*> instances;
  std::unordered_map<std::string, const JsonValue*> named;
  UsedOutside used;

  Loading loading(Problems& problems) {
    return {project, problems, instances, "", named, LoadedFor::looking, used};
  }
};

LoadedSystem SystemLoader::load() {
  NoProject none;
  const Loading loading = none.loading(problems_);
  const Fields fields(root_, keys::kSystem, problems_);
  LoadedSystem result;
  if (fields.usable()) {
    read_value(fields, keys::kSystem["$schema"], loading);
    read_value(fields, keys::kSystem["lockstep_system"], loading);
    if (const auto name = read_value(fields, keys::kSystem["name"], loading)) system_.name = name->text;
    if (const auto text = read_value(fields, keys::kSystem["description"], loading))
      system_.description = text->text;
    read_controllers(fields["controllers"]);
    read_areas(fields["transfer_areas"]);
    read_networks(fields);
    read_delays(fields["delays"]);
    load_projects();
    if (projects_valid_) {
      check_phases();
      for (const NamedArea& area : areas_) connect(area);
      system_.delays.fixed = kept(fixed_, kLeading);
      system_.delays.left_out = kept(left_out_, static_cast<ObjectKinds>(ObjectKind::TO_SynchronousAxis));
    }
  }
  result.problems = problems_.take_errors();
  result.warnings = problems_.take_warnings();
  result.problems.insert(result.problems.end(), of_projects_.begin(), of_projects_.end());
  result.warnings.insert(result.warnings.end(), warnings_of_projects_.begin(), warnings_of_projects_.end());
  if (result.problems.empty()) result.system = std::move(system_);
  return result;
}

// ---- What the file says

void SystemLoader::read_controllers(const JsonValue* controllers) {
  if (read_object(controllers, problems_) == nullptr) return;
  if (controllers->members.empty())
    problems_.report(*controllers, "there is no controller; allowed: one or more");
  if (controllers->members.size() > kMaximumControllers)
    return problems_.report(*controllers,
                            "these are " + std::to_string(controllers->members.size()) +
                                " controllers; allowed: " + std::to_string(kMaximumControllers));
  for (const auto& [name, json] : controllers->members) read_controller(name, *json);
}

void SystemLoader::read_controller(const std::string& name, const JsonValue& json) {
  if (const std::string problem = identifier_problem(name); !problem.empty())
    problems_.report_key(json, problem);
  if (system_.find(name))
    problems_.report_key(json, "there is a controller " + quote(name) + " already; case does not count");
  const Fields fields(json, keys::kSystemController, problems_);
  if (!fields.usable()) return;
  NoProject none;
  const Loading loading = none.loading(problems_);
  SystemController controller;
  controller.name = name;
  if (const auto file = read_value(fields, keys::kSystemController["project"], loading))
    controller.file = (fs::path(folder_) / file->text).lexically_normal().string();
  if (const auto phase = read_value(fields, keys::kSystemController["phase"], loading))
    controller.phase = phase->integer;
  controller.addresses = read_senders(fields["address"], problems_);
  system_.controllers.push_back(std::move(controller));
  places_.push_back(&json);
}

void SystemLoader::read_areas(const JsonValue* areas) {
  if (read_object(areas, problems_) == nullptr) return;
  for (const auto& [name, json] : areas->members) areas_.push_back(read_area(name, *json));
}

NamedArea SystemLoader::read_area(const std::string& name, const JsonValue& json) {
  NamedArea area{.name = name, .json = &json};
  const Fields fields(json, keys::kSystemArea, problems_);
  if (!fields.usable()) return area;
  NoProject none;
  if (const auto interface = read_value(fields, keys::kSystemArea["interface"], none.loading(problems_)))
    area.interface = static_cast<int>(interface->integer);
  area.from = full_name_at(fields["from"]);
  area.to = full_names_at(fields["to"]);
  return area;
}

/// One or a list of them.
std::vector<FullName> SystemLoader::full_names_at(const JsonValue* json) {
  std::vector<FullName> names;
  if (json == nullptr) return names;
  if (json->kind != JsonKind::array) {
    if (const auto name = full_name_at(json)) names.push_back(*name);
    return names;
  }
  if (json->elements.empty()) problems_.report(*json, "this list is empty; allowed: one name or more");
  for (const JsonValue* const element : json->elements)
    if (const auto name = full_name_at(element)) names.push_back(*name);
  return names;
}

std::optional<FullName> SystemLoader::full_name_at(const JsonValue* json) {
  const auto text = read_string(json, problems_);
  if (!text) return std::nullopt;
  const std::size_t dot = text->find('.');
  if (dot == text->npos || dot + 1 == text->size()) {
    problems_.report(*json, json->shown() + " names no object of a controller; allowed: CONTROLLER.OBJECT");
    return std::nullopt;
  }
  const std::string_view controller = text->substr(0, dot);
  if (const auto index = system_.find(controller)) return FullName{json, *index, text->substr(dot + 1)};
  std::vector<std::string_view> names;
  for (const SystemController& one : system_.controllers) names.push_back(one.name);
  problems_.report(*json, "there is no controller " + quote(controller) + did_you_mean(controller, names) +
                              (names.empty() ? "" : "; allowed: " + list_of(names)));
  return std::nullopt;
}

void SystemLoader::read_networks(const Fields& fields) {
  NoProject none;
  const Loading loading = none.loading(problems_);
  if (const JsonValue* const simulated = fields["simulated_network"])
    read_struct(*simulated, keys::kSimulatedNetwork, system_.simulated_network, loading);
  if (const JsonValue* const network = fields["network"])
    system_.network = read_network(*network, folder_, false, loading);
}

void SystemLoader::read_delays(const JsonValue* json) {
  if (json == nullptr) return;
  const Fields fields(*json, keys::kDelays, problems_);
  if (!fields.usable()) return;
  if (const JsonValue* const fixed = read_array(fields["fixed"], problems_)) fixed_ = full_names_at(fixed);
  if (const JsonValue* const out = read_array(fields["left_out"], problems_)) left_out_ = full_names_at(out);
}

// ---- The projects

/// What is wrong in a project is told with its file.
void SystemLoader::take_problems(std::vector<Problem> from, std::vector<Problem>& into,
                                 const std::string& file) const {
  for (Problem& problem : from) {
    if (problem.file.empty()) problem.file = file;
    if (std::ranges::find(into, problem) == into.end()) into.push_back(std::move(problem));
  }
}

void SystemLoader::load_projects() {
  std::vector<UsedOutside> used(system_.controllers.size());
  const auto use = [&](const FullName& name) { used[name.controller].insert(fold(name.object)); };
  for (const NamedArea& area : areas_) {
    if (area.from) use(*area.from);
    for (const FullName& name : area.to) use(name);
  }
  for (std::size_t i = 0; i < system_.controllers.size(); ++i) {
    SystemController& controller = system_.controllers[i];
    projects_valid_ = projects_valid_ && !controller.file.empty();
    if (controller.file.empty()) continue;
    try {
      const bool here = alone_.empty() || same_name(alone_, controller.name);
      Prepare prepare;
      if (here && prepare_ != nullptr && *prepare_)
        prepare = [&](Project& project) { (*prepare_)(project, controller); };
      LoadedProject loaded =
          load_project_file(controller.file, prepare, here ? use_ : LoadedFor::looking, used[i]);
      take_problems(std::move(loaded.problems), of_projects_, controller.file);
      take_problems(std::move(loaded.warnings), warnings_of_projects_, controller.file);
      projects_valid_ = projects_valid_ && loaded.project.has_value();
      if (loaded.project) controller.project = std::move(*loaded.project);
    } catch (const UnreadableFile& error) {
      projects_valid_ = false;
      problems_.report(*places_[i]->find("project"), std::string("the project cannot be read: ") +
                                                         error.what() +
                                                         "; allowed: a file, relative to this one");
    }
  }
}

void SystemLoader::check_phases() {
  for (std::size_t i = 0; i < system_.controllers.size(); ++i) {
    SystemController& controller = system_.controllers[i];
    const std::int64_t cycle = controller.project.controller->clock.servo_cycle;
    controller.project.controller->shared_time_at_start = controller.phase;
    if (controller.phase < cycle) continue;
    problems_.report(*places_[i]->find("phase"), "a phase of " + duration_text(controller.phase) +
                                                     " is a whole servo cycle or more; allowed: less than " +
                                                     duration_text(cycle));
  }
}

// ---- What hangs together

TechnologyObject* SystemLoader::find_object(const FullName& name, ObjectKinds kinds) {
  const SystemController& controller = system_.controllers[name.controller];
  const Names::FoundObject found = controller.project.names.find_object(name.object, kinds);
  if (!found.problem.empty())
    problems_.report(*name.json, "of the controller " + quote(controller.name) + ": " + found.problem);
  return found.object;
}

void SystemLoader::connect(const NamedArea& named) {
  if (!named.from) return;
  auto* const from = static_cast<LeadingObject*>(find_object(*named.from, kPositioned));
  SystemArea area{.name = named.name,
                  .controller = named.from->controller,
                  .from = from,
                  .interface = named.interface,
                  .to = {}};
  if (from == nullptr || !source_fits(named, area)) return;
  if (const std::string problem = channel_problem(system_.channel_of(area)); !problem.empty())
    return problems_.report_key(*named.json, problem);
  for (const FullName& name : named.to) {
    auto* const proxy = static_cast<LeadingAxisProxy*>(find_object(name, kLeadingAxisProxy));
    const SystemArea::Receiver receiver{name.controller, proxy};
    if (proxy != nullptr && receiver_fits(name, area, receiver) && cycles_fit(name, area, receiver))
      area.to.push_back(receiver);
  }
  system_.areas.push_back(std::move(area));
}

bool SystemLoader::source_fits(const NamedArea& named, const SystemArea& area) {
  const std::string name = full_name(system_.controllers[area.controller], *area.from);
  std::string problem = interface_problem(*area.from, area.interface);
  const auto taken = [&](const auto& areas) {
    for (const auto& other : areas)
      if (other.from == area.from && other.interface == area.interface && problem.empty())
        problem = interface_text(area.interface) + " of '" + name + "' is that of the transfer area '" +
                  other.name + "' already; allowed: one area for each interface";
  };
  taken(system_.areas);
  taken(system_.controllers[area.controller].project.transfer_areas);
  if (!problem.empty()) problems_.report(*named.from->json, problem);
  return problem.empty();
}

/// A proxy has one source.
bool SystemLoader::receiver_fits(const FullName& name, const SystemArea& area,
                                 const SystemArea::Receiver& receiver) {
  const auto same = [&](const SystemArea::Receiver& other) { return other.proxy == receiver.proxy; };
  const bool twice = std::ranges::any_of(area.to, same);
  std::string other = twice ? area.name : "";
  if (sources_ == SeveralSources::refused || twice) {
    for (const SystemArea& one : system_.areas)
      if (std::ranges::any_of(one.to, same)) other = one.name;
    for (const TransferArea& one : system_.controllers[receiver.controller].project.transfer_areas)
      if (one.leads(receiver.proxy)) other = one.name;
  }
  if (other.empty()) return true;
  problems_.report(*name.json, name.json->shown() + " has the telegrams of the transfer area '" + other +
                                   "' already; allowed: one source for each proxy");
  return false;
}

/// All telegrams that come within a servo cycle of the receiver have to find space.
bool SystemLoader::cycles_fit(const FullName& name, const SystemArea& area,
                              const SystemArea::Receiver& receiver) {
  constexpr std::int64_t kTelegrams = TelegramRing::kCapacity / 2;
  const auto clock_of = [&](std::size_t index) -> const Clock& {
    return system_.controllers[index].project.controller->clock;
  };
  const std::int64_t source = clock_of(area.controller).interpolator_cycle();
  const std::int64_t own = clock_of(receiver.controller).servo_cycle;
  if (own <= kTelegrams * source) return true;
  problems_.report(*name.json,
                   "the servo cycle of the controller " +
                       quote(system_.controllers[receiver.controller].name) + ", " + duration_text(own) +
                       ", does not fit the application cycle of the source, " + duration_text(source) +
                       "; allowed: at most " + duration_text(kTelegrams * source));
  return false;
}

std::vector<KeptDelays::Axis> SystemLoader::kept(const std::vector<FullName>& names, ObjectKinds kinds) {
  std::vector<KeptDelays::Axis> list;
  for (const FullName& name : names)
    if (TechnologyObject* const object = find_object(name, kinds)) list.push_back({name.controller, object});
  return list;
}

}  // namespace

std::optional<std::size_t> System::find(std::string_view controller) const {
  for (std::size_t i = 0; i < controllers.size(); ++i)
    if (same_name(controllers[i].name, controller)) return i;
  return std::nullopt;
}

std::string System::channel_of(const SystemArea& area) const {
  return name + "." + area.name;
}

std::string full_name(const SystemController& controller, const TechnologyObject& object) {
  return controller.name + "." + object.name;
}

LoadedSystem load_system_file(const std::string& path, LoadedFor use, SeveralSources sources) {
  const JsonDocument document(read_text_file(path, JsonDocument::kLongest));
  LoadedSystem result;
  if (document.usable())
    result = SystemLoader(document.root(), fs::path(path).parent_path().string(), use, sources).load();
  result.problems.insert(result.problems.begin(), document.problems().begin(), document.problems().end());
  if (!result.problems.empty()) result.system.reset();
  return result;
}

LoadedSystem load_controller_of(const std::string& path, std::string_view controller,
                                const PrepareController& prepare) {
  const JsonDocument document(read_text_file(path, JsonDocument::kLongest));
  LoadedSystem result;
  if (document.usable()) {
    SystemLoader loader(document.root(), fs::path(path).parent_path().string(), LoadedFor::running,
                        SeveralSources::refused);
    loader.run_alone(controller, prepare);
    result = loader.load();
  }
  result.problems.insert(result.problems.begin(), document.problems().begin(), document.problems().end());
  if (!result.problems.empty()) result.system.reset();
  if (!result.system) return result;
  if (const auto index = result.system->find(controller)) couple(*result.system, *index);
  return result;
}

bool is_system(std::string_view text) {
  const JsonDocument document(text);
  return document.usable() && document.root().kind == JsonKind::object &&
         document.root().find("lockstep_system") != nullptr;
}

bool is_system_file(const std::string& path) {
  try {
    return is_system(read_text_file(path, JsonDocument::kLongest));
  } catch (const UnreadableFile&) {
    return false;
  }
}

}  // namespace lockstep
