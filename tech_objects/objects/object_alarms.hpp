/// Technology alarms of objects that move nothing: an alarm with a reaction ends their processing.
#pragma once

#include "tech_objects/alarms/alarms.hpp"
#include "tech_objects/data_blocks/status_bits.hpp"
#include "tech_objects/objects/technology_object.hpp"

namespace lockstep {

/// Value of ErrorDetail.Reaction that tells whose processing ends.
/// @source S7-1500/S7-1500T alarms and error IDs
enum class ProcessingEnd : std::uint8_t {
  output_cam = 6,
  cam_track = 7,
  measuring_input = 8,
  external_encoder = 10,
  leading_axis_proxy = 13
};

/// Shows an alarm in the words of a data block. The first alarm with a reaction stays in ErrorDetail until it
/// is acknowledged. Thread: the cycle.
template <class Data>
void raise_alarm(int number, ProcessingEnd reaction, TechnologyObject& object, Data& data,
                 const AlarmDetail& detail = {}) noexcept {
  const Alarm* const alarm = find_alarm(number);
  object.alarm_notes.raised(number, alarm->reaction == 0 ? 0 : static_cast<int>(reaction), detail);
  if (alarm->error_bit >= 0) set_bit(data.ErrorWord, static_cast<unsigned>(alarm->error_bit), true);
  if (alarm->warning_bit >= 0) set_bit(data.WarningWord, static_cast<unsigned>(alarm->warning_bit), true);
  if (alarm->error_bit < 0) return;
  set_bit(data.StatusWord, StatusBit::Error, true);
  if (data.ErrorDetail.Number != 0 && data.ErrorDetail.Reaction != 0) return;
  data.ErrorDetail.Number = static_cast<UDINT>(number);
  data.ErrorDetail.Reaction = alarm->reaction == 0 ? 0 : static_cast<DINT>(reaction);
}

template <class Data>
void clear_alarms(TechnologyObject& object, Data& data) noexcept {
  object.alarm_notes.acknowledged();
  data.ErrorWord = DWORD{};
  data.WarningWord = DWORD{};
  data.ErrorDetail = {};
}

}  // namespace lockstep
