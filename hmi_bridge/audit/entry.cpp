#include "hmi_bridge/audit/entry.hpp"

#include <time.h>

#include <cmath>
#include <cstdio>

#include "hmi_bridge/network/visible_text.hpp"
#include "hmi_bridge/traces/csv_number.hpp"

namespace lockstep {

std::string audit_value(Value value, Type type) {
  if (type == Type::BOOL) return value.u != 0 ? "true" : "false";
  char text[kNumberLength];
  std::string number(text, print_value(text, value, type));
  return is_real(type) && !std::isfinite(value.r) ? json_text(number) : number;
}

std::string audit_time(std::chrono::system_clock::time_point time) {
  const auto whole = std::chrono::floor<std::chrono::seconds>(time);
  const std::time_t seconds = std::chrono::system_clock::to_time_t(whole);
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  char text[64];
  const std::size_t length = std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &utc);
  const auto fraction = std::chrono::duration_cast<std::chrono::microseconds>(time - whole).count();
  std::snprintf(text + length, sizeof text - length, ".%06dZ", static_cast<int>(fraction));
  return text;
}

std::string audit_line(const AuditEntry& entry, std::uint64_t folded) {
  std::string line = R"({"time":")" + audit_time(entry.time) + R"(","tick":)" + std::to_string(entry.tick);
  const auto add_text = [&line](const char* key, const std::string& text) {
    if (!text.empty()) line.append(",\"").append(key).append("\":").append(json_text(text));
  };
  const auto add = [&line](const char* key, const std::string& json) {
    if (!json.empty()) line.append(",\"").append(key).append("\":").append(json);
  };
  add_text("via", entry.via);
  add_text("from", entry.from);
  add_text("who", entry.who);
  add_text("action", entry.action);
  add_text("target", entry.target);
  add("old", entry.before);
  add("new", entry.after);
  add_text("result", entry.accepted ? "accepted" : "refused");
  add_text("why", entry.why);
  if (folded > 1) add("folded", std::to_string(folded));
  return line + "}\n";
}

}  // namespace lockstep
