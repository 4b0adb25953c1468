#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "gsv/base/sorting.h"
#include "gsv/reality/comparison.h"
#include "gsv/reality/statistics.h"

namespace gsv::reality {
namespace {

constexpr double kWidth = 420, kHeight = 260, kLeft = 50, kTop = 30, kBottom = 40;
constexpr int kPoints = 200;

std::string Curve(const std::vector<double>& values, double low, double high, const char* style) {
  std::vector<double> sorted = values;
  base::Sort(sorted);
  std::string points;
  for (int i = 0; i <= kPoints; ++i) {
    const double at = low + (high - low) * i / kPoints;
    const auto below = std::upper_bound(sorted.begin(), sorted.end(), at) - sorted.begin();
    const double part =
        sorted.empty() ? 0 : static_cast<double>(below) / static_cast<double>(sorted.size());
    points += fmt::format("{:.1f},{:.1f} ", kLeft + (kWidth - kLeft - 10) * i / kPoints,
                          kTop + (kHeight - kTop - kBottom) * (1 - part));
  }
  return fmt::format("<polyline fill=\"none\" {} points=\"{}\"/>\n", style, points);
}

std::string Panel(const Series& series, double top) {
  std::vector<double> all = series.real;
  all.insert(all.end(), series.simulated.begin(), series.simulated.end());
  const double low = Quantile(all, 0.005), high = std::max(Quantile(all, 0.995), low + 1e-9);
  const double bottom = kHeight - kBottom;
  return fmt::format(
      "<g transform=\"translate(0 {})\">\n"
      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#888\"/>\n"
      "<text x=\"{}\" y=\"18\">distribution of: {}{}</text>\n"
      "<text x=\"{}\" y=\"{}\">{:.3g}</text><text x=\"{}\" y=\"{}\" "
      "text-anchor=\"end\">{:.3g}</text>\n"
      "<text x=\"8\" y=\"{}\">1</text><text x=\"8\" y=\"{}\">0</text>\n{}{}</g>\n",
      top, kLeft, kTop, kWidth - kLeft - 10, bottom - kTop, kLeft, series.what,
      series.unit.empty() ? "" : " (" + series.unit + ")", kLeft, bottom + 16, low, kWidth - 10,
      bottom + 16, high, kTop + 10, bottom,
      Curve(series.real, low, high, "stroke=\"#1f77b4\" stroke-width=\"2\""),
      Curve(series.simulated, low, high,
            "stroke=\"#d62728\" stroke-width=\"2\" stroke-dasharray=\"6 4\""));
}

}  // namespace

std::string ToSvg(const Comparison& comparison) {
  const double height = kHeight * static_cast<double>(comparison.series.size()) + 24;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" "
      "fill=\"white\"/>\n",
      kWidth, height);
  double top = 0;
  for (const Series& series : comparison.series) {
    svg += Panel(series, top);
    top += kHeight;
  }
  return svg + fmt::format(
                   "<text x=\"{0}\" y=\"{1}\" fill=\"#1f77b4\">real</text><text x=\"{2}\" "
                   "y=\"{1}\" fill=\"#d62728\">simulated (dashed)</text>\n</svg>\n",
                   kLeft, top + 14, kLeft + 60);
}

}  // namespace gsv::reality
