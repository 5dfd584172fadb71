/// The leading axis of another controller, as the axes of this one follow it: TO_LeadingAxisProxy. It has no
/// motion of its own; before the axes it takes up the telegrams that have come and gives the leading value
/// for this tick.
/// @source S7-1500T synchronous operation V7, chapter 10, 13.3
#pragma once

#include <cstdint>
#include <string>

#include "tech_objects/data_blocks/leading_axis_proxy.hpp"
#include "tech_objects/jobs/new_jobs.hpp"
#include "tech_objects/leading_values/adapted_value.hpp"
#include "tech_objects/leading_values/carrier_counts.hpp"
#include "tech_objects/leading_values/recorded_values.hpp"
#include "tech_objects/leading_values/telegram.hpp"
#include "tech_objects/objects/leading_object.hpp"

namespace lockstep {

/// What has become of telegrams. Thread: the cycle.
struct TelegramCounters {
  std::uint64_t received = 0;  ///< taken over
  std::uint64_t missing = 0;   ///< numbers that have been left out, less those that came late
  std::uint64_t late = 0;      ///< behind one with a higher number
  std::uint64_t doubled = 0;   ///< of a time that there was already
  std::uint64_t refused = 0;   ///< from the future, of a source that has been restarted, or senseless
};

/// Where the counts are shown; nullptr: nobody asks. Thread: the cycle.
struct TelegramCountTags {
  std::uint64_t* received = nullptr;
  std::uint64_t* missing = nullptr;
  std::uint64_t* late = nullptr;
  std::uint64_t* doubled = nullptr;
  std::uint64_t* refused = nullptr;

  // Of the messages that carry them between processes.
  const CarrierCounts* carrier = nullptr;  ///< nullptr: they come from this process
  std::uint64_t* malformed = nullptr;
  std::uint64_t* foreign = nullptr;
  std::uint64_t* not_signed = nullptr;
  std::uint64_t* repeated = nullptr;
  std::uint64_t* ambiguous = nullptr;
  std::uint64_t* stale = nullptr;
  std::uint64_t* untrusted = nullptr;

  void show(const TelegramCounters& counters) const noexcept;
};

class LeadingAxisProxy final : public LeadingObject {
 public:
  LeadingAxisProxy(std::string name, DB_ANY number);

  // ---- Load time

  LeadingAxisProxyData data;
  TelegramCountTags count_tags;

  void configure(double servo_period, int ratio) override;
  void* data_block() noexcept override { return &data; }
  void* start_values() noexcept override { return &start_values_; }

  // ---- Cycle

  /// Takes a telegram up. @param now time of the tick [ns], on the clock of the telegram
  void take(const LeadingValueTelegram& telegram, std::int64_t now) noexcept;
  const TelegramCounters& counters() const noexcept { return counters_; }

  /// MC_Reset alone; it starts at the next interpolator tick.
  void submit(Job& job) noexcept override { new_jobs_.submit(job); }

  bool takes_part(Phase phase) const noexcept override {
    return phase == Phase::servo || phase == Phase::before_axes;
  }
  void servo(std::int64_t now) noexcept override { now_ = now; }
  void before_axes() noexcept override;

  AxisPosition actual_position() const noexcept override { return setpoint_.position; }
  bool measured_in_servo() const noexcept override { return false; }
  DoubleDouble measured_line() const noexcept override { return {}; }
  bool actual_values_valid() const noexcept override { return adapted_.begun() && !faulty(); }
  bool leading_value_stands() const noexcept override { return setpoint_.standing(); }

 private:
  bool adopt(const LeadingValueTelegram& telegram) noexcept;
  void know(const LeadingValueTelegram& telegram) noexcept;
  void record(const LeadingValueTelegram& telegram, bool newest) noexcept;
  void rename_to(DoubleDouble renamed) noexcept;
  bool valid() const noexcept;
  bool led() const noexcept { return adapted_.begun(); }
  std::int64_t longest_age() const noexcept;
  std::int64_t time_asked() const noexcept { return now_ - delay_ + local_delay_; }
  std::int64_t longer_cycle() const noexcept { return cycle_ > source_cycle_ ? cycle_ : source_cycle_; }
  void watch() noexcept;
  void lead() noexcept;
  void lose_range() noexcept;
  void forget_source() noexcept;
  bool faulty() const noexcept { return data.ErrorDetail.Number != 0; }
  void fault(int alarm_number, const AlarmDetail& detail = {}) noexcept;
  void start(Job& job) noexcept;
  ErrorId reset(bool restart) noexcept;
  void publish() noexcept;

  std::int64_t now_ = 0;            // of this tick [ns]
  std::int64_t cycle_ = 1'000'000;  // of the interpolator [ns]
  std::int64_t local_delay_ = 0;    // Parameter.LocalLeadingValueDelayTime [ns]
  NewJobs new_jobs_;
  LeadingAxisProxyData start_values_;

  // The source, once a telegram of it has come.
  bool known_ = false;
  bool restarting_ = false;  // in this tick
  bool replaced_ = false;    // it has been restarted: its values count from MC_Reset on
  bool other_ring_ = false;
  bool source_valid_ = false;
  bool source_led_ = false;
  std::int64_t source_cycle_ = 1;  // [ns]
  std::int64_t delay_ = 0;         // of the source [ns]
  std::uint64_t first_ = 0;        // number of the telegram that made it known
  std::uint64_t newest_ = 0;       // highest number
  std::int64_t newest_time_ = 0;   // of the telegram that has it [ns]
  std::uint64_t source_run_ = 0;
  std::uint32_t source_restarts_ = 0;
  DoubleDouble source_renamed_;  // [u]
  TelegramCounters counters_;

  RecordedValues recorded_;
  AdaptedValue adapted_;
  AdaptedValue undelayed_;        // for those coupled `delayed`: without local_delay_
  std::int64_t invalid_for_ = 0;  // [ns] executed, without a valid leading value
};

}  // namespace lockstep
