#include "projects/studio/project_text.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>

#include "projects/json/problem.hpp"

namespace lockstep {
namespace {

using namespace studio_api;

/// Parts of documents are named by references, which have to last.
const Json kNothing;

const Json& at(const Json& json, const char* key) {
  if (!json.is_object()) return kNothing;
  const auto found = json.find(key);
  return found == json.end() ? kNothing : *found;
}

bool is_letter(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// A value or expression as it is written.
std::string written(const Json& json) {
  return json.is_string() ? json.get<std::string>() : text_of(json);
}

std::string escaped(std::string_view key) {
  std::string result;
  for (const char c : key) {
    if (c == '~')
      result += "~0";
    else if (c == '/')
      result += "~1";
    else
      result += c;
  }
  return result;
}

/// Calls `visit(call, pointer)` for each call of a list, those within branches too.
using Visit = std::function<void(const Json&, const std::string&)>;
void each_call(const Json& calls, const std::string& pointer, const Visit& visit) {
  if (!calls.is_array()) return;
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const std::string here = pointer + "/" + std::to_string(i);
    visit(calls[i], here);
    each_call(at(calls[i], "then"), here + "/then", visit);
    each_call(at(calls[i], "else"), here + "/else", visit);
  }
}

Json calls_json(const Json& calls, const std::string& pointer);

Json call_json(const Json& call, const std::string& pointer) {
  Json json = {{"pointer", pointer}};
  if (call.contains("fb")) {
    json["kind"] = "fb";
    json["instance"] = at(call, "name");
    json["fb"] = at(call, "fb");
    json["in"] = Json::array();
    if (const Json& inputs = at(call, "in"); inputs.is_object())
      for (const auto& [pin, value] : inputs.items())
        json["in"].push_back(
            {{"pin", pin}, {"text", written(value)}, {"pointer", pointer + "/in/" + escaped(pin)}});
    return json;
  }
  for (const char* const kind : {"set", "set_start"})
    if (call.contains(kind)) {
      json["kind"] = kind;
      json["target"] = call[kind];
      json["text"] = written(at(call, "to"));
      json["pointer_text"] = pointer + "/to";
      return json;
    }
  json["kind"] = "if";
  json["text"] = written(at(call, "if"));
  json["then"] = calls_json(at(call, "then"), pointer + "/then");
  json["else"] = calls_json(at(call, "else"), pointer + "/else");
  return json;
}

Json calls_json(const Json& calls, const std::string& pointer) {
  Json list = Json::array();
  if (calls.is_array())
    for (std::size_t i = 0; i < calls.size(); ++i)
      list.push_back(call_json(calls[i], pointer + "/" + std::to_string(i)));
  return list;
}

void each_call_of(const Json& document,
                  const std::function<void(const Json&, const Json&, const std::string&)>& visit) {
  const Json& programs = at(document, "programs");
  if (!programs.is_array()) return;
  for (std::size_t i = 0; i < programs.size(); ++i)
    each_call(at(programs[i], "calls"), "/programs/" + std::to_string(i) + "/calls",
              [&](const Json& call, const std::string& pointer) { visit(programs[i], call, pointer); });
}

/// Whether a name stands in a text as a whole word, or begins a path there.
bool names(std::string_view text, std::string_view name) {
  for (std::size_t i = 0; i + name.size() <= text.size(); ++i) {
    if (!same_name(text.substr(i, name.size()), name)) continue;
    const bool begins = i == 0 || (!is_letter(text[i - 1]) && text[i - 1] != '.');
    const bool ends = i + name.size() == text.size() || !is_letter(text[i + name.size()]);
    if (begins && ends) return true;
  }
  return false;
}

bool is_between(const Json& coupling, const Json& leading, std::string_view following) {
  const Json& to = at(coupling, "leading");
  const Json& of = at(coupling, "following");
  return same_name(to.get_ref<const std::string&>(), leading.get_ref<const std::string&>()) &&
         same_name(of.get_ref<const std::string&>(), following);
}

/// Adds how the leading value is taken, and those couplings that the project allows and of which no program
/// makes anything.
void add_possible_couplings(const Json& objects, Json& list) {
  if (!objects.is_object()) return;
  const std::size_t programmed = list.size();
  for (const auto& [name, json] : objects.items()) {
    const Json& allowed = at(json, "leading_values");
    for (std::size_t i = 0; allowed.is_array() && i < allowed.size(); ++i) {
      const Json& leading = at(allowed[i], "to");
      if (!leading.is_string()) continue;
      const auto begin = list.begin(), end = begin + static_cast<std::ptrdiff_t>(programmed);
      const Json& coupling = at(allowed[i], "coupling");
      bool is_programmed = false;
      for (auto programmed_one = begin; programmed_one != end; ++programmed_one)
        if (is_between(*programmed_one, leading, name)) {
          is_programmed = true;
          if (coupling.is_string()) (*programmed_one)["coupling"] = coupling;
        }
      if (is_programmed) continue;
      Json one = {
          {"following", name},
          {"leading", leading},
          {"possible", true},
          {"pointer", "/technology_objects/" + escaped(name) + "/leading_values/" + std::to_string(i)}};
      if (coupling.is_string()) one["coupling"] = coupling;
      list.push_back(std::move(one));
    }
  }
}

}  // namespace

StudioProjectText::StudioProjectText(std::string_view text) {
  if (!text.empty()) document_ = Json::parse(text, nullptr, false);
  if (document_.is_discarded()) document_ = nullptr;
}

Json StudioProjectText::programs() const {
  Json list = Json::array();
  const Json& programs = at(document_, "programs");
  if (!programs.is_array()) return list;
  for (std::size_t i = 0; i < programs.size(); ++i) {
    const std::string pointer = "/programs/" + std::to_string(i);
    Json json = {{"name", at(programs[i], "name")}, {"ob", at(programs[i], "ob")}, {"pointer", pointer}};
    for (const char* const key : {"cycle", "priority", "comment"})
      if (programs[i].contains(key)) json[key] = programs[i][key];
    json["calls"] = calls_json(at(programs[i], "calls"), pointer + "/calls");
    list.push_back(std::move(json));
  }
  return list;
}

Json StudioProjectText::couplings() const {
  Json list = Json::array();
  each_call_of(document_, [&](const Json& program, const Json& call, const std::string& pointer) {
    const Json& inputs = at(call, "in");
    const Json& leading = at(inputs, "Master");
    const Json& following = at(inputs, "Slave");
    if (!leading.is_string() || !following.is_string()) return;
    Json json = {{"following", following},  {"leading", leading}, {"instance", at(call, "name")},
                 {"block", at(call, "fb")}, {"pointer", pointer}, {"program", at(program, "name")}};
    for (const char* const key : {"Cam", "RatioNumerator", "RatioDenominator"})
      if (inputs.contains(key)) json[key] = written(inputs[key]);
    list.push_back(std::move(json));
  });
  add_possible_couplings(at(document_, "technology_objects"), list);
  return list;
}

Json StudioProjectText::uses(std::string_view name) const {
  Json list = Json::array();
  if (name.empty()) return list;
  each_call_of(document_, [&](const Json& program, const Json& call, const std::string& pointer) {
    const std::string where = "program " + written(at(program, "name"));
    const auto look = [&](const std::string& key, const Json& value, const std::string& what) {
      if (!value.is_string() || !names(value.get_ref<const std::string&>(), name)) return;
      list.push_back({{"pointer", pointer + "/" + key}, {"text", value}, {"where", where + what}});
    };
    for (const char* const key : {"set", "set_start", "to", "if"}) look(key, at(call, key), "");
    if (const Json& inputs = at(call, "in"); inputs.is_object())
      for (const auto& [pin, value] : inputs.items())
        look("in/" + escaped(pin), value, ", " + written(at(call, "name")) + "." + pin);
    if (call.contains("name")) look("name", at(call, "name"), ", the instance");
  });
  return list;
}

Json StudioProjectText::wiring(std::string_view instance, std::string_view pin) const {
  Json found;
  each_call_of(document_, [&](const Json&, const Json& call, const std::string& pointer) {
    const Json& name = at(call, "name");
    if (!name.is_string() || !same_name(name.get_ref<const std::string&>(), instance)) return;
    const Json& inputs = at(call, "in");
    if (!inputs.is_object()) return;
    for (const auto& [key, value] : inputs.items())
      if (same_name(key, pin))
        found = {{"text", written(value)}, {"pointer", pointer + "/in/" + escaped(key)}};
  });
  return found;
}

Json StudioProjectText::configured(std::string_view object, std::string_view path) const {
  const Json& objects = at(document_, "technology_objects");
  if (!objects.is_object()) return {};
  for (const auto& [name, json] : objects.items()) {
    if (!same_name(name, object)) continue;
    const Json* here = &at(json, "config");
    std::string_view rest = path;
    while (here->is_object()) {
      const Json* next = nullptr;
      std::size_t taken = 0;
      for (const auto& [key, value] : here->items())
        if (rest.size() >= key.size() && same_name(rest.substr(0, key.size()), key) &&
            (rest.size() == key.size() || rest[key.size()] == '.') && key.size() >= taken) {
          next = &value;
          taken = key.size();
        }
      if (next == nullptr) return {};
      if (taken == rest.size()) return *next;
      rest.remove_prefix(taken + 1);
      here = next;
    }
  }
  return {};
}

Json StudioProjectText::cams() const {
  Json list = Json::array();
  const Json& objects = at(document_, "technology_objects");
  if (!objects.is_object()) return list;
  for (const auto& [name, json] : objects.items()) {
    const Json& type = at(json, "type");
    if (!type.is_string() || !type.get_ref<const std::string&>().starts_with("TO_Cam") ||
        type == "TO_CamTrack")
      continue;
    Json one = {{"name", name}, {"type", type}};
    if (json.contains("file")) one["file"] = json["file"];
    list.push_back(std::move(one));
  }
  return list;
}

}  // namespace lockstep
