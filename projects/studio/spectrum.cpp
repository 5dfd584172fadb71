#include "projects/studio/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>
#include <utility>

namespace lockstep {
namespace {

constexpr std::size_t kPeaks = 10;
constexpr double kNoise = 1e-9;  // of the largest amplitude, below which nothing is a peak

/// The largest product of 2, 3 and 5 that is no larger.
std::size_t quick_size(std::size_t size) noexcept {
  std::size_t best = 1;
  for (std::size_t five = 1; five <= size; five *= 5)
    for (std::size_t three = five; three <= size; three *= 3) {
      std::size_t two = three;
      while (two <= size / 2) two *= 2;
      best = std::max(best, two);
    }
  return best;
}

double weight(SpectrumWindow window, double part) noexcept {
  const double angle = 2.0 * std::numbers::pi * part;
  switch (window) {
    case SpectrumWindow::hann:
      return 0.5 - 0.5 * std::cos(angle);
    case SpectrumWindow::flattop:
      return 0.21557895 - 0.41663158 * std::cos(angle) + 0.277263158 * std::cos(2.0 * angle) -
             0.083578947 * std::cos(3.0 * angle) + 0.006947368 * std::cos(4.0 * angle);
    default:
      return 1.0;
  }
}

/// Local maxima; where they lie between two values by the parabola through three of them. How high they are
/// too, but for a window with a flat top: there the highest of the three is it already.
std::vector<Spectrum::Peak> peaks_of(const std::vector<double>& amplitude, double step, bool is_flat) {
  std::vector<Spectrum::Peak> peaks;
  const double floor = amplitude.empty() ? 0.0 : kNoise * *std::ranges::max_element(amplitude);
  for (std::size_t i = 1; i + 1 < amplitude.size(); ++i) {
    const double before = amplitude[i - 1], here = amplitude[i], behind = amplitude[i + 1];
    if (!(here > before && here >= behind && here > floor)) continue;
    const double bend = before - 2.0 * here + behind;
    const double shift = bend < 0.0 ? 0.5 * (before - behind) / bend : 0.0;
    peaks.push_back(
        {(static_cast<double>(i) + shift) * step, is_flat ? here : here - 0.25 * (before - behind) * shift});
  }
  std::ranges::sort(peaks, std::ranges::greater{}, &Spectrum::Peak::amplitude);
  if (peaks.size() > kPeaks) peaks.resize(kPeaks);
  return peaks;
}

/// The position without its wraps: a step of more than half of what it spans is one.
std::vector<double> unwrapped(const std::vector<double>& position) {
  const auto [lowest, highest] = std::ranges::minmax_element(position);
  const double span = *highest - *lowest;
  // The ring is a step longer than what is seen of it.
  double largest = 0.0;
  for (std::size_t i = 1; i < position.size(); ++i)
    if (const double step = std::abs(position[i] - position[i - 1]); step <= span / 2)
      largest = std::max(largest, step);
  std::vector<double> result = position;
  double turns = 0.0;
  for (std::size_t i = 1; i < position.size(); ++i) {
    const double step = position[i] - position[i - 1];
    // What a wrap has moved on is as much as the step before it.
    const double before = i > 1 ? result[i - 1] - result[i - 2] : largest;
    if (std::abs(step) > span / 2) turns += before - step;
    result[i] = position[i] + turns;
  }
  return result;
}

}  // namespace

std::optional<SpectrumWindow> spectrum_window(std::string_view name) noexcept {
  if (name == "hann") return SpectrumWindow::hann;
  if (name == "rectangle") return SpectrumWindow::rectangle;
  if (name == "flattop") return SpectrumWindow::flattop;
  return {};
}

Spectrum spectrum_of(const std::vector<double>& values, double distance, SpectrumWindow window) {
  Spectrum spectrum;
  const std::size_t size = quick_size(values.size());
  const std::size_t from = values.size() - size;
  double mean = 0.0;
  for (std::size_t i = from; i < values.size(); ++i) mean += values[i] / static_cast<double>(size);
  std::vector<double> weighted(size);
  double sum = 0.0;
  for (std::size_t i = 0; i < size; ++i) {
    const double part = weight(window, static_cast<double>(i) / static_cast<double>(size));
    // Without the mean, which a window would spread over its neighbours.
    weighted[i] = (values[from + i] - mean) * part;
    sum += part;
  }
  Eigen::FFT<double> transform;
  transform.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<std::complex<double>> lines;
  transform.fwd(lines, weighted);
  spectrum.rows = size;
  spectrum.step = 1.0 / (static_cast<double>(size) * distance);
  spectrum.amplitude.reserve(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    // All but the mean and the highest one stand there twice, as sines to the left and to the right.
    const bool is_single = i == 0 || (size % 2 == 0 && i == size / 2);
    spectrum.amplitude.push_back(std::abs(lines[i]) * (is_single ? 1.0 : 2.0) / sum);
  }
  if (!spectrum.amplitude.empty()) spectrum.amplitude[0] = std::abs(mean);
  std::vector<double> without_mean = spectrum.amplitude;
  if (!without_mean.empty()) without_mean[0] = 0.0;
  spectrum.peaks = peaks_of(without_mean, spectrum.step, window == SpectrumWindow::flattop);
  return spectrum;
}

std::vector<double> by_order(const std::vector<double>& position, const std::vector<double>& values,
                             double& distance) {
  if (position.size() < 2) return {};
  std::vector<double> path = unwrapped(position);
  if (path.back() < path.front())
    for (double& one : path) one = -one;
  for (std::size_t i = 1; i < path.size(); ++i)
    if (path[i] < path[i - 1]) return {};
  const double length = path.back() - path.front();
  if (!(length > 0.0)) return {};
  const std::size_t size = path.size();
  distance = length / static_cast<double>(size - 1);
  std::vector<double> result(size);
  std::size_t right = 1;
  for (std::size_t i = 0; i < size; ++i) {
    const double at = path.front() + distance * static_cast<double>(i);
    while (right + 1 < size && path[right] < at) ++right;
    const double step = path[right] - path[right - 1];
    const double part = step > 0.0 ? std::clamp((at - path[right - 1]) / step, 0.0, 1.0) : 1.0;
    result[i] = values[right - 1] + part * (values[right] - values[right - 1]);
  }
  return result;
}

}  // namespace lockstep
