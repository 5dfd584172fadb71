/// What a signal is made of by frequency, or by orders of a leading axis.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/traces/store.hpp"

namespace lockstep {

/// What is laid over the rows before they are transformed.
enum class SpectrumWindow : std::uint8_t {
  hann,       ///< the usual one
  rectangle,  ///< none: of what repeats within the rows
  flattop     ///< amplitudes of peaks are right within 0.1 %
};
std::optional<SpectrumWindow> spectrum_window(std::string_view name) noexcept;

/// Amplitudes of a signal by frequency.
struct Spectrum {
  struct Peak {
    double at;         ///< [Hz, or per unit of the leading axis], between two values where it lies
    double amplitude;  ///< [unit of the signal]
  };
  std::size_t rows = 0;           ///< that have been used
  double step = 0.0;              ///< between two amplitudes [as `Peak::at`]
  std::vector<double> amplitude;  ///< of sines, from 0 on; the first one is the mean
  std::vector<Peak> peaks;        ///< the largest local maxima, largest first
};

/// Values at equal distances. Uses as many of the last of them as transform quickly: products of 2, 3 and 5.
/// @param distance of two values [s, or unit of the leading axis] > 0  @param values two at least
Spectrum spectrum_of(const std::vector<double>& values, double distance, SpectrumWindow window);

/// A signal at equal distances of a leading axis, which moves in one direction: by straight lines between
/// rows.
/// @param position of the leading axis, which may wrap @return empty: it stands or turns back
std::vector<double> by_order(const std::vector<double>& position, const std::vector<double>& values,
                             double& distance);

}  // namespace lockstep
