/// What a device keeps when its power goes: arrays and parameters, as SAVE and SAVEPROM have left them.
#pragma once

#include <vector>

#include "scheduler/aposs/device.hpp"
#include "tech_objects/jobs/encoder_saving.hpp"
#include "tech_objects/mco305_catalogue/parameters.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// Where a project keeps it, a thread of its own brings the content to the disk; without one it is lost with
/// the run. Thread: that of the cycle, but for what is for the load.
class Eeprom {
 public:
  // For the load.
  std::vector<DINT> arrays;       ///< all of them, one behind the other
  bool write_protected = false;   ///< whatever is saved is error 190
  BOOL arrays_saved = false;      ///< whether that is what counts
  EncoderSaving* disk = nullptr;  ///< who is asked to write at once; nullptr: nobody
  /// The arrays of a device get what has been saved of them; to be called when they are there.
  void restore(aposs::Arrays& target) const noexcept;

  UDINT writes{};  ///< how often it has been written to

  /// SAVE of a part, by its number in `kSavedParts`, and SAVEPROM. @errors 190 it is write-protected
  aposs::Reply save(std::int32_t part, mco305::ParameterValues& parameters, aposs::Arrays& source) noexcept;
  aposs::Reply save_all(aposs::Arrays& source) noexcept;
  /// Busy until the disk has it. @errors 115 it cannot be written; 162 it was read back otherwise
  aposs::Reply proceed() const noexcept;

 private:
  void save_arrays(aposs::Arrays& source) noexcept;
  aposs::Reply write() noexcept;
  UDINT request_{};
};

}  // namespace lockstep
