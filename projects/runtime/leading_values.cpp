#include "projects/runtime/leading_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <random>
#include <utility>

#include "hmi_bridge/lcm/key_file.hpp"
#include "projects/runtime/run_options.hpp"

namespace lockstep {
namespace {

std::int64_t run_by_chance() {
  std::random_device chance;
  return static_cast<std::int64_t>(std::uint64_t{chance()} << 32 | chance());
}

const char* name_of(SharedClockKind kind) noexcept {
  return kind == SharedClockKind::tai ? "CLOCK_TAI" : "CLOCK_MONOTONIC";
}

std::string names_of(const std::vector<LeadingAxisProxy*>& proxies) {
  std::string names;
  for (const LeadingAxisProxy* const proxy : proxies) names += (names.empty() ? "" : ", ") + proxy->name;
  return names;
}

}  // namespace

LeadingValueExchange::LeadingValueExchange(Project& project, const NetworkCoupling& coupling,
                                           Messages& messages)
    : network_(coupling.network),
      messages_(messages),
      clock_(make_shared_clock(network_.clock, network_.clock_error)),
      watch_(*clock_) {
  const auto areas = static_cast<double>(coupling.sent.size() + coupling.received.size());
  rate_ = areas * 1e9 / static_cast<double>(project.controller->clock.interpolator_cycle());
  try {
    const SharedKey key = network_.key_file.empty() ? SharedKey{} : read_key_file(network_.key_file);
    if (!coupling.received.empty())
      receiver_ =
          std::make_unique<LeadingValueReceiver>(network_.lcm, incoming(project, coupling, key), watch_);
    if (!coupling.sent.empty())
      sender_ = std::make_unique<LeadingValueSender>(network_.lcm, outgoing(project, coupling, key),
                                                     run_by_chance(), watch_, receiver_ == nullptr);
  } catch (const std::exception& error) {
    throw CouldNotStart(std::string("leading values: ") + error.what());
  }
  show_counts(project);
}

/// Adds the counts of this network to the tags that the project names for those of all.
void LeadingValueExchange::show_counts(Project& project) const {
  const auto show = [&](std::uint64_t* tag, const std::atomic<std::uint64_t>& count) {
    if (tag == nullptr) return;
    auto& shown = project.controller->shown_counts;
    const auto there = std::ranges::find(shown, tag, &ShownCount::tag);
    (there != shown.end() ? *there : shown.emplace_back(ShownCount{tag})).counts.push_back(&count);
  };
  const SentTelegramTags& tags = project.sent_tags;
  show(tags.clock_losses, watch_.loss_count());
  if (!sender_) return;
  show(tags.sent, sender_->sent().telegrams);
  show(tags.failed, sender_->sent().failed);
  for (const TelegramRing* const ring : sent_rings_) show(tags.dropped, ring->drops());
}

std::vector<LeadingValueSender::Area> LeadingValueExchange::outgoing(Project& project,
                                                                     const NetworkCoupling& coupling,
                                                                     const SharedKey& key) {
  std::vector<LeadingValueSender::Area> areas;
  for (const SentArea& sent : coupling.sent) {
    TelegramRing& ring = add_ring();
    sent_rings_.push_back(&ring);
    LeadingValueLink link = sent.link;
    link.key = key;
    areas.push_back({std::move(link), &ring});
    project.controller->telegram_outputs.push_back({sent.from, &ring});
  }
  return areas;
}

std::vector<LeadingValueReceiver::Area> LeadingValueExchange::incoming(Project& project,
                                                                       const NetworkCoupling& coupling,
                                                                       const SharedKey& key) {
  std::vector<LeadingValueReceiver::Area> areas;
  for (const ReceivedArea& received : coupling.received) {
    Incoming& in = *incoming_.emplace_back(std::make_unique<Incoming>());
    in.name = names_of(received.to);
    LeadingValueReceiver::Area area{.link = received.link,
                                    .from = received.senders,
                                    .counts = &in.counts,
                                    .controller = network_.controller,
                                    .proxies = in.name};
    area.link.key = key;
    for (LeadingAxisProxy* const proxy : received.to) {
      TelegramRing& ring = add_ring();
      area.rings.push_back(&ring);
      project.controller->telegram_inputs.push_back({proxy, &ring});
      proxy->count_tags.carrier = &in.counts;
    }
    areas.push_back(std::move(area));
  }
  return areas;
}

void LeadingValueExchange::keep_in(TelegramMemory& memory) noexcept {
  if (receiver_) receiver_->keep_in(memory);
  if (sender_) sender_->keep_in(memory);
}

void LeadingValueExchange::start() {
  look();
  if (receiver_) receiver_->start();
  if (sender_) sender_->start();
}

void LeadingValueExchange::end() {
  if (sender_) sender_->stop();
  if (receiver_) receiver_->stop();
}

void LeadingValueExchange::look() {
  const bool trusted = watch_.trusted();
  if (trusted != told_untrusted_) return;
  told_untrusted_ = !trusted;
  messages_.warn(trusted
                     ? std::string("leading values: the clock that all controllers share counts again")
                     : fmt::format("leading values: {}; none is valid until that is over",
                                   watch_.losses() == 0
                                       ? "no clock is kept in step with the others (PTP: ptp4l, phc2sys)"
                                       : "the clock that all controllers share has jumped, or is not kept in "
                                         "step any more"));
}

void LeadingValueExchange::tell_losses() {
  if (sender_ && sender_->sent().failed != 0)
    messages_.warn(fmt::format("leading values: {} telegrams could not be sent on {}",
                               sender_->sent().failed.load(), network_.lcm));
  std::uint64_t dropped = 0;
  for (const TelegramRing* const ring : sent_rings_) dropped += ring->dropped();
  if (dropped != 0) messages_.warn(fmt::format("leading values: {} telegrams found no space", dropped));
  for (const auto& in : incoming_) {
    const CarrierCounts& counts = in->counts;
    std::string text;
    for (const auto& [count, what] : {std::pair{&counts.malformed, "malformed"},
                                      {&counts.foreign, "foreign"},
                                      {&counts.not_signed, "without the right code"},
                                      {&counts.repeated, "repeated"},
                                      {&counts.ambiguous, "of two senders"},
                                      {&counts.stale, "of another time"},
                                      {&counts.untrusted, "without a clock"},
                                      {&counts.dropped, "without space"}})
      if (const std::uint64_t n = count->load(); n != 0)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", n, what);
    if (!text.empty()) messages_.warn(fmt::format("{}: messages that did not count: {}", in->name, text));
  }
}

std::string LeadingValueExchange::started(std::int64_t start) const {
  return fmt::format("leading values over {}: time 0 is {} ns of {}", network_.lcm, start + clock_offset(),
                     name_of(network_.clock));
}

}  // namespace lockstep
