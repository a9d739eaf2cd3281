#include "svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace redmap::bench {

namespace {

/// Of the drawing, and of the box that curves are in: SVG units.
constexpr double kWidth = 460, kHeight = 300, kLeft = 62, kRight = 14, kTop = 12, kBottom = 44;

bool is_drawn(const Series::Point& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && point.x > 0 && point.y > 0;
}

/// Where values of one axis go; a little wider than what is shown.
class Axis {
 public:
  void include(double value) { low_ = std::min(low_, value), high_ = std::max(high_, value); }
  void settle(double begin, double end) {
    if (low_ > high_) low_ = high_ = 1;
    low_ /= kRoom, high_ *= kRoom;
    begin_ = begin, end_ = end;
  }
  double at(double value) const { return begin_ + (end_ - begin_) * std::log(value / low_) / std::log(high_ / low_); }
  /// 1, 2 and 5 times the powers of ten, or powers of ten alone where there would be too many.
  std::vector<double> ticks() const {
    std::vector<double> all, tens;
    for (int power = -12; power < 13; ++power)
      for (const double digit : {1.0, 2.0, 5.0}) {
        const double value = digit * std::pow(10.0, power);
        if (value < low_ || value > high_) continue;
        all.push_back(value);
        if (digit == 1) tens.push_back(value);
      }
    return all.size() > kMostTicks && tens.size() > 1 ? tens : all;
  }

 private:
  static constexpr double kRoom = 1.25;
  static constexpr std::size_t kMostTicks = 8;
  double low_ = std::numeric_limits<double>::infinity(), high_ = 0, begin_ = 0, end_ = 1;
};

std::string draw_axes(const Plot& plot, const Axis& x, const Axis& y) {
  std::string svg;
  for (const double tick : x.ticks())
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>"
        "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4:g}</text>",
        x.at(tick), kTop, kHeight - kBottom, kHeight - kBottom + 16, tick);
  for (const double tick : y.ticks())
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{1}\" x2=\"{2}\" y1=\"{0:.1f}\" y2=\"{0:.1f}\"/>"
        "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5:g}</text>",
        y.at(tick), kLeft, kWidth - kRight, kLeft - 6, y.at(tick) + 4, tick);
  svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\" class=\"axis\">{}</text>",
                     (kLeft + kWidth - kRight) / 2, kHeight - 6, escaped(plot.x_title));
  return svg + fmt::format(
                   "<text transform=\"translate(14 {:.1f}) rotate(-90)\" text-anchor=\"middle\" "
                   "class=\"axis\">{}</text>",
                   (kTop + kHeight - kBottom) / 2, escaped(plot.y_title));
}

std::string draw_series(const Series& series, int colour, const Axis& x, const Axis& y) {
  std::string line, points;
  for (const Series::Point& point : series.points) {
    if (!is_drawn(point)) continue;
    line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? "M" : "L", x.at(point.x), y.at(point.y));
    points +=
        fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"><title>{}: {:.4g}, {:.4g}</title></circle>",
                    x.at(point.x), y.at(point.y), series.joined ? 3 : 5.5, escaped(series.name), point.x, point.y);
  }
  return fmt::format("<g class=\"series s{}\">{}{}</g>", colour,
                     series.joined ? fmt::format("<path d=\"{}\"/>", line) : std::string(), points);
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string svg_of(const Plot& plot) {
  Axis x, y;
  for (const Series& series : plot.series)
    for (const Series::Point& point : series.points)
      if (is_drawn(point)) x.include(point.x), y.include(point.y);
  x.settle(kLeft, kWidth - kRight), y.settle(kHeight - kBottom, kTop);
  std::string svg = fmt::format(
      "<figure class=\"plot\"><figcaption>{}</figcaption><svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">",
      escaped(plot.title), kWidth, kHeight, escaped(plot.title));
  svg += draw_axes(plot, x, y);
  std::string legend;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const int colour = plot.series[i].colour < 0 ? static_cast<int>(i) : plot.series[i].colour;
    svg += draw_series(plot.series[i], colour, x, y);
    legend += fmt::format("<li class=\"s{}\">{}</li>", colour, escaped(plot.series[i].name));
  }
  return svg + "</svg><ul class=\"legend\">" + legend + "</ul></figure>\n";
}

}  // namespace redmap::bench
