// Where a run can be looked into, and who may do what there.
#include "projects/json/addresses.hpp"
#include "projects/keys/project.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/read_keys.hpp"

namespace lockstep {

void load_networks(const JsonValue* json, std::vector<IpNetwork>& networks, Problems& problems) {
  if (read_array(json, problems) == nullptr) return;
  if (json->elements.empty())
    problems.report(*json, "an empty list lets nobody in; allowed: networks such as 192.168.1.0/24");
  for (const JsonValue* const element : json->elements) {
    std::string problem;
    if (const auto text = read_form(element, kNetworkForm, problems))
      networks.push_back(IpNetwork::parse(*text, problem).value());
  }
}

void load_studio(const JsonValue& json, const Loading& loading) {
  StudioConfig& config = loading.project.studio;
  const Fields fields = read_struct(json, keys::kStudio, config, loading);
  load_networks(fields["allow"], config.allow, loading.problems);
  if (const JsonValue* const commands = fields["commands"])
    load_commands(*commands, CommandRoute::studio, loading);
}

}  // namespace lockstep
