#include "scheduler/mco305/eeprom.hpp"

#include <algorithm>

#include "tech_objects/mco305_catalogue/errors.hpp"

namespace lockstep {

using aposs::Reply;
using mco305::ParameterSet;

void Eeprom::restore(aposs::Arrays& target) const noexcept {
  if (!arrays_saved) return;
  const auto cells = target.all();
  std::copy_n(arrays.begin(), std::min(arrays.size(), cells.size()), cells.begin());
}

/// Those that are not there any more are 0, as a DIM would begin them.
void Eeprom::save_arrays(aposs::Arrays& source) noexcept {
  const auto cells = source.all();
  const std::size_t common = std::min(arrays.size(), cells.size());
  std::copy_n(cells.begin(), common, arrays.begin());
  std::fill(arrays.begin() + static_cast<std::ptrdiff_t>(common), arrays.end(), 0);
  arrays_saved = true;
}

Reply Eeprom::write() noexcept {
  ++writes;
  if (disk == nullptr || !disk->kept) return Reply::done();
  request_ = ++disk->asked;
  return Reply::busy();
}

Reply Eeprom::proceed() const noexcept {
  const auto since = static_cast<DINT>(disk->answered - request_);
  if (since < 0) return Reply::busy();
  if (disk->error == WORD{}) return Reply::done();
  return Reply::failed(disk->differs ? mco305::kVerificationFailed : mco305::kSavingFailed);
}

Reply Eeprom::save(std::int32_t part, mco305::ParameterValues& parameters, aposs::Arrays& source) noexcept {
  if (write_protected) return Reply::failed(mco305::kWriteProtected);
  enum Part : std::int32_t { kArrays, kAxis, kGlobal, kApplication };
  if (part == kArrays) save_arrays(source);
  if (part == kAxis) parameters.save(ParameterSet::kAxis);
  if (part == kGlobal) parameters.save(ParameterSet::kGlobal);
  return write();
}

/// Application parameters are kept as they count; those of the axis are not part of it.
Reply Eeprom::save_all(aposs::Arrays& source) noexcept {
  if (write_protected) return Reply::failed(mco305::kWriteProtected);
  save_arrays(source);
  return write();
}

}  // namespace lockstep
