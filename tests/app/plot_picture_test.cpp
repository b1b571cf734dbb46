#include "app/plot_picture.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace meander;

namespace {

using Color = std::array<int, 3>;
constexpr Color kBlue{0, 114, 178};
constexpr Color kVermilion{213, 94, 0};
constexpr Color kGuide{150, 150, 150};

bool is_color(const std::uint8_t* p, const Color& color) {
  for (int c = 0; c < 3; ++c)
    if (std::abs(p[c] - color[static_cast<std::size_t>(c)]) > 12) return false;
  return true;
}

// The rows of a column in which a colour stands, nearly.
std::vector<int> rows_of(const Image8& picture, int x, const Color& color, int from = 0) {
  std::vector<int> rows;
  for (int y = from; y < picture.height; ++y)
    if (is_color(picture.at(x, y), color)) rows.push_back(y);
  return rows;
}

double middle(const std::vector<int>& rows) { return 0.5 * (rows.front() + rows.back()); }

Plot falling() {
  Plot plot{"A title", "seconds", "error", {}, -0.5};
  PlotSeries series{"one", {}, true};
  for (int i = 0; i <= 6; ++i)
    series.points.push_back({std::pow(10.0, 0.5 * i - 1), std::pow(10.0, -0.25 * i), 0, 0});
  plot.series.push_back(series);
  return plot;
}

}  // namespace

TEST_CASE("an axis holds its values, with lines at powers of ten and between") {
  const PlotAxis wide = plot_axis({0.02, 300, -1, 0, std::numeric_limits<double>::quiet_NaN()});
  CHECK(wide.low < std::log10(0.02));
  CHECK(wide.high > std::log10(300.0));
  CHECK(wide.labelled.size() == 4);  // 0.1, 1, 10, 100
  CHECK(wide.labelled.front() == doctest::Approx(0.1));
  const PlotAxis narrow = plot_axis({0.9, 6});
  CHECK(std::count_if(narrow.labelled.begin(), narrow.labelled.end(),
                      [](double v) { return std::abs(v - 2) < 1e-9 || std::abs(v - 5) < 1e-9; }) == 2);
  const PlotAxis one = plot_axis({3});
  CHECK(one.high - one.low == doctest::Approx(1.0 / 3));
  const PlotAxis none = plot_axis({});
  CHECK(none.low == -1);
  CHECK(none.high == 1);
}

TEST_CASE("labels are read as people write them") {
  CHECK(seconds_label(0.0002) == "200 µs");
  CHECK(seconds_label(0.05) == "50 ms");
  CHECK(seconds_label(20) == "20 s");
  CHECK(percent_label(0.02) == "2 %");
  CHECK(percent_label(0.0005) == "0.05 %");
  CHECK(percent_label(1) == "100 %");
}

TEST_CASE("a straight line of slope -1/2 is drawn straight, and the guide lies on it") {
  Plot plot = falling();
  const Image8 picture = plot_picture(plot, 1000, 700);
  // Away from marks, labels and legend: the curve covers the guide.
  const double left = middle(rows_of(picture, 300, kBlue));
  const double centre = middle(rows_of(picture, 475, kBlue));
  const double right = middle(rows_of(picture, 650, kBlue));
  CHECK(left < centre);
  CHECK(std::abs(left + right - 2 * centre) <= 3);
  // Twice as high, so that the guide of the first is seen beside the second's curve.
  PlotSeries flat{"two", {}, true};
  for (const PlotPoint& p : plot.series[0].points) flat.points.push_back({p.x, 1, 0, 0});
  plot.series.insert(plot.series.begin(), {"none", {{1000, 0.02, 0, 0}}, true});
  plot.series.push_back(flat);
  const Image8 apart = plot_picture(plot, 1000, 700);
  std::vector<std::pair<int, double>> seen;
  for (int x = 450; x < 900; ++x)  // right of its name, below the legend
    if (const auto rows = rows_of(apart, x, kGuide, 260); !rows.empty() && rows.back() - rows.front() < 6)
      seen.emplace_back(x, middle(rows));
  REQUIRE(seen.size() > 50);
  const auto slope = [](auto a, auto b) { return (b.second - a.second) / (b.first - a.first); };
  const double guide = slope(seen.front(), seen.back());
  const auto first = std::pair(300, middle(rows_of(apart, 300, kVermilion)));
  const auto last = std::pair(550, middle(rows_of(apart, 550, kVermilion)));
  CHECK(guide == doctest::Approx(slope(first, last)).epsilon(0.05));
  // It goes through the last point of the first series, whose mark is the only blue below the legend.
  double x_sum = 0;
  double y_sum = 0;
  double pixels = 0;
  for (int x = 450; x < apart.width; ++x)
    for (const int y : rows_of(apart, x, kBlue, 260)) {
      x_sum += x;
      y_sum += y;
      ++pixels;
    }
  REQUIRE(pixels > 20);
  const double on_guide = seen.front().second + guide * (x_sum / pixels - seen.front().first);
  CHECK(std::abs(y_sum / pixels - on_guide) < 4);
}

TEST_CASE("neither the legend nor the name of the guide hides a curve") {
  constexpr std::array<Color, 6> kColors{kBlue,           kVermilion,     Color{0, 158, 115},
                                         {204, 121, 167}, {86, 180, 233}, {230, 159, 0}};
  // Flat curves at the top, at the bottom, at both, and all over the plot.
  const std::vector<std::vector<double>> plots{
      {1}, {1, 0.01}, {1, 0.5, 0.01}, {1, 0.5, 0.2, 0.1, 0.04, 0.01}, {1, 1.1, 1.2, 1.3, 1.4, 1.5}};
  for (const std::vector<double>& levels : plots) {
    Plot plot{"A title", "seconds", "error", {}, -0.5};
    for (const double level : levels)
      plot.series.push_back(
          {"a long name", {{0.1, level, 0, 0}, {1, level, 0, 0}, {100, level, 0, 0}}, true});
    const Image8 picture = plot_picture(plot, 1200, 750);
    for (std::size_t i = 0; i < levels.size(); ++i) {
      CAPTURE(levels.size());
      CAPTURE(i);
      // Along the row of the mark at its left end, from there to the other end.
      int row = 0;
      int first = 0;
      int last = 0;
      int most = 0;
      for (int y = 0; y < picture.height; ++y) {
        std::vector<int> columns;
        for (int x = 0; x < picture.width; ++x)
          if (is_color(picture.at(x, y), kColors[i])) columns.push_back(x);
        if (static_cast<int>(columns.size()) <= most) continue;
        most = static_cast<int>(columns.size());
        first = columns.front();
        last = columns.back();
        row = y;
      }
      CAPTURE(row);
      CHECK(last - first > 880);
      CHECK(most > last - first - 6);
    }
  }
}

TEST_CASE("an estimate has the colour of what was measured before it") {
  Plot plot = falling();
  PlotSeries estimate{"its estimate", {}, false};
  for (const PlotPoint& p : plot.series[0].points) estimate.points.push_back({p.x, 0.1 * p.y, 0, 0});
  plot.series.push_back(estimate);
  plot.series.push_back({"another", {{1, 0.01, 0, 0}, {100, 0.01, 0, 0}}, true});
  const Image8 picture = plot_picture(plot, 1200, 750);
  int twice = 0;
  int other = 0;
  for (int x = 300; x < 900; ++x) {
    const auto rows = rows_of(picture, x, kBlue);
    twice += !rows.empty() && rows.back() - rows.front() > 100;
    other += !rows_of(picture, x, kVermilion).empty();
  }
  CHECK(twice > 150);  // where a dash is
  CHECK(other > 300);
}

TEST_CASE("no point, one point, equal points and points that are none are all drawn") {
  Plot plot{"", "s", "e", {}, -0.5};
  (void)plot_picture(plot, 400, 300);
  plot.series.push_back({"nothing", {}, true});
  plot.series.push_back({"bad", {{0, 1, 0, 0}, {1, -1, 0, 0}, {1, INFINITY, 0, 0}, {NAN, 1, 0, 0}}, false});
  const Image8 none = plot_picture(plot, 400, 300);
  for (int x = 0; x < none.width; ++x)
    CHECK(rows_of(none, x, kBlue).size() <= 12);  // the legend's mark alone
  plot.series.front().points = {{2, 0.1, 0.05, 0.2}, {2, 0.1, 0, 0}};
  const Image8 one = plot_picture(plot, 1000, 700);
  int widest = 0;
  for (int x = 300; x < 700; ++x) widest = std::max(widest, static_cast<int>(rows_of(one, x, kBlue).size()));
  CHECK(widest > 60);  // the bar
}
