#include "projects/runtime/judge.hpp"

#include <algorithm>
#include <cmath>

#include "hmi_bridge/traces/text_literal.hpp"
#include "projects/expressions/constant.hpp"
#include "projects/json/fields.hpp"
#include "scheduler/events.hpp"

namespace lockstep {
namespace {

std::string text_of(const SeenValue& seen) {
  if (!seen.signal) return text_literal(seen.text.view());
  const Signal& signal = *seen.signal;
  if (signal.value_type() == Type::TIME) return duration_text(signal.load().i);
  return value_text(signal.load(), signal.value_type());
}

Judgement judged(const Expectation& expectation, std::int64_t at) {
  Judgement result{&expectation, at};
  EvaluationCounters counters;
  const Value value = expectation.expression.evaluate(counters);
  const Type type = expectation.expression.type();
  result.actual = value_text(value, type);
  // A comparison with NaN does not hold.
  result.holds = expectation.value
                     ? std::abs(as_double(value, type) - *expectation.value) <= expectation.tolerance
                     : value.u != 0;
  std::string seen;
  for (const SeenValue& one : expectation.seen)
    if (one.name != expectation.written) seen += (seen.empty() ? "" : ", ") + one.name + " = " + text_of(one);
  if (!seen.empty()) result.actual += " (" + seen + ")";
  return result;
}

/// What happens in the controller, for as long as this lives.
class EventsOfARun {
 public:
  EventsOfARun(Controller& controller, const std::function<void(const TraceEvent&)>& tell)
      : controller_(controller), tell_(tell), texts_(controller) {
    if (!tell) return;
    controller.events = &queue_;
    controller.tell_jobs();
  }
  ~EventsOfARun() {
    if (tell_) controller_.events = nullptr;
  }
  EventsOfARun(const EventsOfARun&) = delete;
  EventsOfARun& operator=(const EventsOfARun&) = delete;

  void take() {
    for (; queue_.readable() != 0; queue_.pop(1)) tell_(texts_.of(queue_.event(0), queue_.lost()));
  }

 private:
  Controller& controller_;
  const std::function<void(const TraceEvent&)>& tell_;
  EventQueue queue_;
  EventTexts texts_;
};

}  // namespace

std::vector<Judgement> judge(Project& project, const std::function<void(const TraceEvent&)>& tell) {
  Controller& controller = *project.controller;
  EventsOfARun events(controller, tell);
  const Expectations& expectations = project.expectations;
  std::vector<Judgement> judgements;
  for (const Expectation& expectation : expectations.list) judgements.push_back({&expectation});
  std::vector<Judgement*> open;
  for (Judgement& one : judgements)
    if (one.expectation->at) open.push_back(&one);
  std::ranges::stable_sort(open, {}, [](const Judgement* one) { return *one->expectation->at; });
  controller.apply_stimuli = true;
  auto next = open.begin();
  std::int64_t time = 0;
  while (controller.now() < expectations.duration || next != open.end()) {
    time = controller.now();
    controller.tick();
    events.take();
    for (; next != open.end() && *(*next)->expectation->at <= time; ++next)
      **next = judged(*(*next)->expectation, time);
  }
  for (Judgement& one : judgements)
    if (!one.expectation->at) one = judged(*one.expectation, time);
  return judgements;
}

std::string title_of(const Expectation& expectation) {
  if (!expectation.text.empty()) return expectation.text;
  if (!expectation.value) return expectation.written;
  std::string text = expectation.written + " = " + decimal_text(*expectation.value);
  if (expectation.tolerance != 0.0) text += " ± " + decimal_text(expectation.tolerance);
  return text;
}

}  // namespace lockstep
