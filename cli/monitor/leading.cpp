#include "cli/monitor/leading.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "cli/describe/table.hpp"
#include "cli/monitor/traces.hpp"

namespace lockstep::cli {
namespace {

constexpr double kSourceSilent = 1.0, kProxiesSilent = 3.0;  // [s]

double age_of(HeardLeadingValues::Clock::time_point last, HeardLeadingValues::Clock::time_point now) {
  return std::chrono::duration<double>(now - last).count();
}

std::string source_line(const HeardSource& source, double age) {
  const leading_value_t& value = source.value;
  std::string line = fmt::format("  {} from {}  #{}  {:.4f}, {:.4f}/s", printable(value.area),
                                 printable(value.sender), value.sequence, value.position, value.velocity);
  if ((value.flags & leading_value_t::VALID) == 0) line += "  NOT VALID";
  line +=
      fmt::format("  every {:.3f} ms  {} missing", static_cast<double>(value.cycle) * 1e-6, source.missing);
  return line + (age > kSourceSilent ? fmt::format("  SILENT for {:.1f} s", age) : "");
}

std::string proxies_line(const HeardProxies& heard, double age) {
  const leading_proxies_t& told = heard.told;
  std::string line = fmt::format("    to {}.{}  {} taken", printable(told.controller),
                                 printable(told.proxies), told.accepted);
  for (const auto& [count, what] : {std::pair{told.malformed, "malformed"},
                                    {told.foreign, "foreign"},
                                    {told.not_signed, "not signed"},
                                    {told.repeated, "repeated"},
                                    {told.ambiguous, "of two senders"},
                                    {told.stale, "of another time"},
                                    {told.untrusted, "without a clock"},
                                    {told.dropped, "without space"}})
    if (count != 0) line += fmt::format("  {} {}", count, what);
  return line + (age > kProxiesSilent ? fmt::format("  SILENT for {:.1f} s", age) : "");
}

}  // namespace

bool HeardLeadingValues::accept(const std::string& channel, std::span<const std::uint8_t> bytes,
                                Clock::time_point now) {
  if (bytes.size() > kLongestMessage) return false;
  if (auto value = decode_leading_value(bytes)) return accept_source(channel, std::move(*value), now);
  if (auto told = decode_leading_proxies(bytes)) return accept_proxies(channel, std::move(*told), now);
  return false;
}

bool HeardLeadingValues::accept_source(const std::string& channel, leading_value_t value,
                                       Clock::time_point now) {
  if (value.area != channel) return false;
  const auto known = sources_.find(channel);
  if (known == sources_.end()) {
    if (sources_.size() == kMaximum) return false;
    sources_.emplace(channel, HeardSource{std::move(value), 1, 0, now});
    return true;
  }
  HeardSource& source = known->second;
  const auto before = static_cast<std::uint64_t>(source.value.sequence);
  const auto sequence = static_cast<std::uint64_t>(value.sequence);
  if (value.run != source.value.run)
    source.missing = source.telegrams = 0;
  else if (sequence > before)
    source.missing += sequence - before - 1;
  else if (source.missing > 0)
    --source.missing;
  ++source.telegrams;
  source.last = now;
  if (value.run != source.value.run || sequence > before) source.value = std::move(value);
  return true;
}

bool HeardLeadingValues::accept_proxies(const std::string& channel, leading_proxies_t told,
                                        Clock::time_point now) {
  if (channel != told.area + std::string(kProxiesSuffix)) return false;
  const std::string name = told.area + "\n" + told.controller;
  if (!proxies_.contains(name) && proxies_.size() == kMaximum) return false;
  proxies_[name] = {std::move(told), now};
  return true;
}

std::vector<std::string> leading_lines(const HeardLeadingValues& values,
                                       HeardLeadingValues::Clock::time_point now, std::size_t width) {
  std::vector<std::string> lines;
  if (values.empty()) return lines;
  lines.emplace_back("leading values:");
  std::string area;
  const auto proxies_of = [&](const std::string& of) {
    for (const auto& [name, heard] : values.proxies())
      if (heard.told.area == of) lines.push_back(proxies_line(heard, age_of(heard.last, now)));
  };
  for (const auto& [channel, source] : values.sources()) {
    lines.push_back(source_line(source, age_of(source.last, now)));
    proxies_of(channel);
  }
  for (const auto& [name, heard] : values.proxies()) {
    if (values.sources().contains(heard.told.area) || heard.told.area == area) continue;
    area = heard.told.area;
    lines.push_back("  " + printable(area) + "  NO SOURCE");
    proxies_of(area);
  }
  for (std::string& line : lines) line = cut_to(line, width);
  return lines;
}

}  // namespace lockstep::cli
