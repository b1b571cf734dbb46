// A plot on logarithmic axes for paper and pages: an error against a time.
#pragma once

#include <string>
#include <vector>

namespace meander {

struct FrameShape;

/// Seconds and a fraction. A bar is drawn from y_low to y_high where 0 < y_low < y_high. Points that are not
/// positive and finite are left out.
struct PlotPoint {
  double x = 0;
  double y = 0;
  double y_low = 0;
  double y_high = 0;
};

/// `measured`: a full line with marks in a colour of its own; otherwise dashed in that of the series before
/// it, of which it was only estimated.
struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;
  bool measured = true;
};

/// `guide_slope` is that of the line through the last point of the first series: -0.5 for what falls as the
/// root of the time; 0 draws none.
struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<PlotSeries> series;
  double guide_slope = -0.5;
};

/// The decimal logarithms at the ends of an axis, and where its lines are. Positions are values.
struct PlotAxis {
  double low = 0;
  double high = 1;
  std::vector<double> labelled;
  std::vector<double> minor;
};

/// An axis that holds all positive finite values with a margin of a twentieth of its length on either side.
/// Lines at 1, 2, 5 times powers of ten are labelled where few decades are shown, else at the powers alone.
/// At least a third of a decade; 0.1 to 10 for no value.
[[nodiscard]] PlotAxis plot_axis(const std::vector<double>& values);

/// "10 ms", "2 s", "1000 s"; "0.01 %", "20 %".
[[nodiscard]] std::string seconds_label(double seconds);
[[nodiscard]] std::string percent_label(double fraction);

/// Fills the frame, between Interface::begin_frame and end_frame.
void draw_plot(const Plot& plot, const FrameShape& frame);

}  // namespace meander
