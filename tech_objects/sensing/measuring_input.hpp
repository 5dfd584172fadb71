/// A measuring input: TO_MeasuringInput. It tells at which position of an axis or external encoder its input
/// changed, more finely than in servo cycles. All of it runs in MC_Servo, behind axes and encoders.
/// @source S7-1500/S7-1500T measuring input and output cam functions, measuring input
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "tech_objects/data_blocks/measuring_input.hpp"
#include "tech_objects/jobs/new_jobs.hpp"
#include "tech_objects/objects/load_position.hpp"
#include "tech_objects/sensing/probe_signal.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {

class MeasuringInput final : public TechnologyObject {
 public:
  MeasuringInput(std::string name, DB_ANY number);

  // ---- Load time

  MeasuringInputData data;
  LeadingObject* measured = nullptr;  ///< whose position is measured
  std::optional<PrintMarks> marks;    ///< what the input sees; none: the tag of Interface.Address

  /// [ms] Longest Parameter.CorrectionTime with a servo period [s].
  static double longest_correction(double servo_period) noexcept;

  void configure(double servo_period, int ratio) override;
  void* data_block() noexcept override { return &data; }
  void* start_values() noexcept override { return &start_values_; }

  // ---- Cycle

  /// The jobs of MC_MeasuringInput, MC_MeasuringInputCyclic, MC_AbortMeasuringInput and MC_Reset; they start
  /// in the next servo tick, and measure what happens behind it.
  void submit(Job& job) noexcept override { new_jobs_.submit(job); }

  bool takes_part(Phase phase) const noexcept override { return phase != Phase::behind_axes; }
  void servo(std::int64_t now) noexcept override;
  void before_axes() noexcept override { load_.interpolated(); }

 private:
  /// The measuring range as a distance from its lower end, on a ring or a line.
  struct MeasuringRange {
    bool limited = false;
    double start = 0.0;   // [u]
    double length = 0.0;  // [u]
  };
  /// A measured edge of this servo cycle.
  struct Measured {
    bool rising = false;
    double position = 0.0;  // [u]
  };

  void start(Job& job) noexcept;
  ErrorId begin(Job& job) noexcept;
  ErrorId take_range(const Job& job) noexcept;
  bool by_telegram() const noexcept {
    return data.Parameter.MeasuringInputType == MeasuringInputType::telegram;
  }
  ErrorId take_telegram(const Job& job) noexcept;
  ErrorId refuse(int alarm_number) noexcept;
  bool may_tell() const noexcept;
  void reset(bool restart) noexcept;
  void end(JobPhase phase, ErrorId error) noexcept;
  void abort() noexcept;
  void end_in_error(ErrorId error) noexcept;
  Edges edges() noexcept;
  double position_at(double age) const noexcept;
  void remember() noexcept;
  double place_in_range(double position) const noexcept;
  bool in_range(double position) const noexcept;
  bool in_lead_in(double position) const noexcept;
  bool range_passed() const noexcept;
  void measure_once(const Edges& edges) noexcept;
  bool wanted_once(bool rising) const noexcept;
  void measure_cyclically(const Edges& edges) noexcept;
  void show_value(int index, double position) noexcept;
  void publish() noexcept;

  static constexpr std::size_t kHistory = 256;  // servo cycles

  double servo_period_ = 0.001;  // [s]
  Modulo modulo_;
  LoadPosition load_;
  const class ExternalEncoder* encoder_ = nullptr;  // if it is one that is measured
  ProbeSignal probe_;
  NewJobs new_jobs_;
  std::uint32_t restarts_ = 0;  // of what is measured
  std::uint32_t homings_ = 0;   // there, that end what measures
  Job* job_ = nullptr;          // that measures
  int captured_ = 0;            // values of a one-time job
  bool first_rising_ = false;   // edge of its first value
  MeasuringRange range_;
  double last_position_ = 0.0;                    // in the servo tick before [u]
  std::array<DoubleDouble, kHistory> history_{};  // lines, by servo tick
  std::size_t tick_ = 0;
  std::size_t started_ = 0;       // tick in which the job began
  std::int64_t range_left_ = -1;  // tick in which it has been left since; -1: not yet
  MeasuringInputData start_values_;
};

}  // namespace lockstep
