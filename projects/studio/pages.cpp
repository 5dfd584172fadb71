#include "projects/studio/pages.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "projects/studio/api_values.hpp"
#include "projects/studio/message.hpp"

namespace lockstep {

using namespace studio_api;

std::uint32_t StudioMessage::number(const char* key) const {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_number_unsigned() ||
      found->get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max())
    throw BadRequest(422, "wrong_type", std::string("'") + key + "' has to be a number from 0 to 4294967295");
  return found->get<std::uint32_t>();
}

void StudioPages::admit(StudioClient& client, const StudioMessage& message) {
  const auto given = message.json.find("token");
  const std::string token =
      given != message.json.end() && given->is_string() ? given->get<std::string>() : "";
  if (!client.authorise(token)) throw BadRequest(401, "not_allowed", "'token' has to be that of the studio");
  pages_.at(&client).is_known = true;
}

void StudioPages::acknowledge(StudioClient& client, const StudioMessage& message) {
  pages_.at(&client).stream.acknowledge(message.number("frame"));
}

void StudioPages::unsubscribe(StudioClient& client, const StudioMessage& message) {
  Page& page = pages_.at(&client);
  const std::uint32_t id = message.number("id");
  page.subscriptions.erase(id);
  page.stream.unsubscribe(id);
  client.send_text(text_of(Json{{"type", "unsubscribed"}, {"seq", message.seq}, {"id", id}}));
}

/// Whether there is space for more signals, besides those of one subscription that is replaced.
void StudioPages::check_sum(std::size_t more, const Page& page, std::uint32_t id) const {
  std::size_t sum = more;
  for (const auto& [client, other] : pages_)
    for (const auto& [number, subscribed] : other.subscriptions)
      if (&other != &page || number != id) sum += subscribed.size();
  if (sum > StudioFeed::kSignals)
    throw BadRequest(422, "too_many", std::to_string(sum) + " signals of all pages; allowed: 1024");
}

/// How many rows there are to one that is sent: by `every`, or by `rate` [Hz].
std::uint64_t StudioPages::every_of(const StudioMessage& message) const {
  const auto every = message.json.find("every");
  const auto rate = message.json.find("rate");
  const bool has_every = every != message.json.end(), has_rate = rate != message.json.end();
  if (has_every && has_rate) throw BadRequest(422, "bad_request", "either 'every' or 'rate'");
  constexpr std::uint64_t kSparsest = StudioStream::kSparsest;
  if (has_every) {
    if (!every->is_number_unsigned() || *every < 1u || *every > kSparsest)
      throw BadRequest(422, "out_of_range", "'every' has to be a whole number from 1 to 10000");
    return every->get<std::uint64_t>();
  }
  if (!has_rate) return 1;
  const double wanted = rate->is_number() ? rate->get<double>() : 0.0;
  if (!(wanted > 0.0)) throw BadRequest(422, "out_of_range", "'rate' has to be a number above 0 [Hz]");
  const auto cycle = static_cast<double>(project_.controller->clock.interpolator_cycle());
  return static_cast<std::uint64_t>(std::clamp(1e9 / (wanted * cycle), 1.0, static_cast<double>(kSparsest)));
}

void StudioPages::subscribe(StudioClient& client, const StudioMessage& message) {
  Page& page = pages_.at(&client);
  const std::uint32_t id = message.number("id");
  const std::uint64_t every = every_of(message);
  std::vector<NamedSignal> wanted;
  Json signals = Json::array();
  for (const std::string& path : paths_in(message.json, kSubscribed)) {
    std::string problem;
    const std::optional<NamedSignal> signal = signal_at(project_, path, problem);
    if (!signal) {
      signals.push_back({{"path", path}, {"error", {{"code", "not_found"}, {"message", problem}}}});
      continue;
    }
    signals.push_back({{"path", path},
                       {"column", wanted.size()},
                       {"type", type_name(signal->signal.value_type())},
                       {"unit", units_.of(*signal)}});
    wanted.push_back(*signal);
  }
  check_sum(wanted.size(), page, id);
  std::vector<std::size_t> indices;
  for (const NamedSignal& signal : wanted) indices.push_back(feed_.index(signal));
  page.subscriptions[id] = std::move(wanted);
  page.stream.subscribe(id, std::move(indices), feed_.store(), every);
  client.send_text(text_of(Json{
      {"type", "subscribed"}, {"seq", message.seq}, {"id", id}, {"every", every}, {"signals", signals}}));
}

void StudioPages::tell(const std::string& text) const {
  for (const auto& [client, page] : pages_)
    if (page.is_known) client->send_text(text);
}

void StudioPages::send_rows() {
  for (auto& [client, page] : pages_) {
    if (!client->is_idle()) continue;
    // One of each subscription at most.
    for (std::size_t i = 0; i < page.subscriptions.size(); ++i) {
      std::optional<std::vector<std::uint8_t>> frame = page.stream.next(feed_.store());
      if (!frame) break;
      client->send_bytes(std::move(*frame));
    }
  }
}

}  // namespace lockstep
