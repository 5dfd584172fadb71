#include "projects/studio/readings.hpp"

#include <algorithm>
#include <utility>

#include "projects/studio/api_values.hpp"

namespace lockstep {
namespace {

using namespace studio_api;

constexpr std::chrono::seconds kReadTime{
    2};  // for a row that has what is read, and how long it goes on coming

}  // namespace

void StudioReadings::read(const StudioRequest& request, Done done) {
  Reading reading;
  Wrong wrong{422};
  const Json asked = parsed(request.body);
  for (const std::string& path : paths_in(asked, kRead)) {
    std::string problem;
    if (std::optional<ReadPlace> place = read_place_at(project_, path, problem))
      reading.places.push_back(std::move(*place));
    else
      wrong.add("not_found", problem, {{"path", path}});
  }
  const bool is_all_wrong = reading.places.empty() || !is_partial(asked);
  if (!wrong.errors.empty() && is_all_wrong) return done(studio_api::answer_of(wrong));
  reading.errors = std::move(wrong.errors);
  reading.until = Clock::now() + kReadTime;
  for (const ReadPlace& place : reading.places)
    for (const NamedSignal& signal : place.signals) {
      reading.indices.push_back(feed_.index(signal));
      kept_.insert_or_assign(signal.name, Kept{signal, reading.until});
    }
  // The row that is being made now may be older than the question.
  reading.from = feed_.store().end();
  reading.done = std::move(done);
  waiting_.push_back(std::move(reading));
}

bool StudioReadings::forget(Clock::time_point now) {
  return std::erase_if(kept_, [&](const auto& one) { return one.second.until < now; }) != 0;
}

bool StudioReadings::is_there(const Reading& reading) const noexcept {
  const TraceStore& store = feed_.store();
  return store.end() > reading.from && store.end() > store.begin() &&
         std::all_of(reading.indices.begin(), reading.indices.end(),
                     [this](std::size_t index) { return feed_.is_in_newest(index); });
}

StudioAnswer StudioReadings::answer_of(const Reading& reading) const {
  const TraceStore& store = feed_.store();
  const TraceWindow row = store.rows(reading.indices, store.end() - 1, store.end());
  Json values = Json::array();
  std::size_t column = 0;
  for (const ReadPlace& place : reading.places) {
    std::vector<Value> here;
    for (std::size_t i = 0; i < place.signals.size(); ++i) here.push_back(row.columns[column++].first[0]);
    values.push_back(reading_json(place, here, units_));
  }
  Json json = {{"t", std::to_string(row.t[0])}, {"tick", std::to_string(row.tick[0])}, {"values", values}};
  if (!reading.errors.empty()) json["errors"] = reading.errors;
  return studio_api::answer_of(json);
}

void StudioReadings::answer(Clock::time_point now) {
  std::erase_if(waiting_, [&](Reading& reading) {
    if (is_there(reading)) {
      reading.done(answer_of(reading));
      return true;
    }
    if (now < reading.until) return false;
    reading.done(error_answer(503, "busy", "no tick has ended within two seconds, or too much is asked for"));
    return true;
  });
}

}  // namespace lockstep
