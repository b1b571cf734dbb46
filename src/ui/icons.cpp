#include "ui/icons.h"

#include <cmath>
#include <initializer_list>

namespace meander {
namespace {

constexpr float kStroke = 1.35f;
constexpr float kTau = 6.2831853f;

// A pen over a grid whose middle is the icon's, one unit a point.
struct Pen {
  ImDrawList& list;
  ImVec2 center;
  ImU32 color;

  [[nodiscard]] ImVec2 at(const ImVec2& p) const { return {center.x + p.x, center.y + p.y}; }

  void line(std::initializer_list<ImVec2> points, bool closed = false) const {
    for (const ImVec2& p : points) list.PathLineTo(at(p));
    list.PathStroke(color, closed ? ImDrawFlags_Closed : ImDrawFlags_None, kStroke);
  }
  void box(const ImVec2& low, const ImVec2& high, float rounding = 1) const {
    list.AddRect(at(low), at(high), color, rounding, 0, kStroke);
  }
  void filled_box(const ImVec2& low, const ImVec2& high) const {
    list.AddRectFilled(at(low), at(high), color, 1);
  }
  // From one angle to another, in turns clockwise from the right.
  void arc(const ImVec2& middle, float radius, float from, float to) const {
    list.PathArcTo(at(middle), radius, from * kTau, to * kTau, 20);
    list.PathStroke(color, 0, kStroke);
  }
  void dot(const ImVec2& p, float radius) const { list.AddCircleFilled(at(p), radius, color, 12); }
  void triangle(const ImVec2& a, const ImVec2& b, const ImVec2& c) const {
    list.AddTriangleFilled(at(a), at(b), at(c), color);
  }
};

void folder(const Pen& pen) {
  pen.line({{-6.5f, 5}, {-6.5f, -4.5f}, {-2, -4.5f}, {-0.5f, -2.5f}, {6.5f, -2.5f}, {6.5f, 5}}, true);
}

void open(const Pen& pen) {
  pen.line({{-6.5f, 4.5f}, {-6.5f, -5}, {-2.5f, -5}, {-1, -3}, {4.5f, -3}, {4.5f, -1}});
  pen.line({{-6.5f, 4.5f}, {-4, -1}, {7, -1}, {4.5f, 4.5f}}, true);
}

void save(const Pen& pen) {
  pen.line({{0, -6}, {0, 2}});
  pen.line({{-3, -0.7f}, {0, 2.3f}, {3, -0.7f}});
  pen.line({{-6, 1.5f}, {-6, 5.5f}, {6, 5.5f}, {6, 1.5f}});
}

void copy(const Pen& pen) {
  pen.box({-2.5f, -2.5f}, {6, 6});
  pen.line({{-3.5f, 3}, {-6, 3}, {-6, -6}, {3, -6}, {3, -3.5f}});
}

// An arrow turning to the left; `side` -1 turns it to the right.
void turn(const Pen& pen, float side) {
  pen.line({{side * -3, -6}, {side * -6, -3}, {side * -3, 0}});
  pen.list.PathLineTo(pen.at({side * -6, -3}));
  pen.list.PathLineTo(pen.at({side * 2, -3}));
  pen.list.PathBezierCubicCurveTo(pen.at({side * 7, -3}), pen.at({side * 7, 5}), pen.at({side * 2, 5}), 16);
  pen.list.PathLineTo(pen.at({side * -3, 5}));
  pen.list.PathStroke(pen.color, 0, kStroke);
}

void compare(const Pen& pen) {
  pen.box({-6.5f, -5}, {6.5f, 5});
  pen.filled_box({0, -5}, {6.5f, 5});
  pen.line({{0, -7}, {0, 7}});
}

void camera(const Pen& pen) {
  pen.line({{-6.5f, 5}, {-6.5f, -3}, {-3.5f, -3}, {-2, -5.5f}, {2, -5.5f}, {3.5f, -3}, {6.5f, -3}, {6.5f, 5}},
           true);
  pen.arc({0, 0.8f}, 2.4f, 0, 1);
}

void region(const Pen& pen) {
  for (const float x : {-1.0f, 1.0f})
    for (const float y : {-1.0f, 1.0f}) pen.line({{x * 2.5f, y * 5.5f}, {x * 6, y * 5.5f}, {x * 6, y * 2}});
  pen.dot({0, 0}, 1.3f);
}

void eye(const Pen& pen, bool shut) {
  pen.list.PathLineTo(pen.at({-7, 0}));
  pen.list.PathBezierCubicCurveTo(pen.at({-3.5f, -5.5f}), pen.at({3.5f, -5.5f}), pen.at({7, 0}), 14);
  pen.list.PathBezierCubicCurveTo(pen.at({3.5f, 5.5f}), pen.at({-3.5f, 5.5f}), pen.at({-7, 0}), 14);
  pen.list.PathStroke(pen.color, ImDrawFlags_Closed, kStroke);
  if (shut)
    pen.line({{-5.5f, 5.5f}, {5.5f, -5.5f}});
  else
    pen.dot({0, 0}, 2);
}

void link(const Pen& pen, bool broken) {
  pen.list.AddRect(pen.at({-7, -2.6f}), pen.at({broken ? -1.5f : 0.5f, 2.6f}), pen.color, 2.6f, 0, kStroke);
  pen.list.AddRect(pen.at({broken ? 1.5f : -0.5f, -2.6f}), pen.at({7, 2.6f}), pen.color, 2.6f, 0, kStroke);
}

void help(const Pen& pen) {
  pen.arc({0, 0}, 6.5f, 0, 1);
  pen.arc({0, -1.6f}, 2, 0.5f, 1.15f);
  pen.line({{1.2f, 0}, {0, 1}, {0, 2}});
  pen.dot({0, 3.8f}, 0.9f);
}

void file(const Pen& pen) {
  pen.line({{-4.5f, -6}, {1.5f, -6}, {4.5f, -3}, {4.5f, 6}, {-4.5f, 6}}, true);
  pen.line({{1.5f, -6}, {1.5f, -3}, {4.5f, -3}});
}

void close(const Pen& pen) {
  pen.line({{-3.5f, -3.5f}, {3.5f, 3.5f}});
  pen.line({{-3.5f, 3.5f}, {3.5f, -3.5f}});
}

void pause(const Pen& pen) {
  pen.filled_box({-4.5f, -5}, {-1.5f, 5});
  pen.filled_box({1.5f, -5}, {4.5f, 5});
}

void up(const Pen& pen) {
  pen.line({{0, 5.5f}, {0, -5}});
  pen.line({{-4, -1}, {0, -5}, {4, -1}});
}

}  // namespace

void draw_icon(ImDrawList& list, Icon icon, const ImVec2& center, ImU32 color) {
  const Pen pen{list, {std::floor(center.x) + 0.5f, std::floor(center.y) + 0.5f}, color};
  switch (icon) {
    case Icon::open:
      return open(pen);
    case Icon::save:
      return save(pen);
    case Icon::copy:
      return copy(pen);
    case Icon::undo:
      return turn(pen, 1);
    case Icon::redo:
      return turn(pen, -1);
    case Icon::compare:
      return compare(pen);
    case Icon::camera:
      return camera(pen);
    case Icon::region:
      return region(pen);
    case Icon::pause:
      return pause(pen);
    case Icon::play:
      return pen.triangle({-4, -5.5f}, {5.5f, 0}, {-4, 5.5f});
    case Icon::help:
      return help(pen);
    case Icon::eye:
      return eye(pen, false);
    case Icon::eye_shut:
      return eye(pen, true);
    case Icon::link:
      return link(pen, false);
    case Icon::unlink:
      return link(pen, true);
    case Icon::close:
      return close(pen);
    case Icon::chevron_right:
      return pen.line({{-1.5f, -3.5f}, {2, 0}, {-1.5f, 3.5f}});
    case Icon::chevron_down:
      return pen.line({{-3.5f, -1.5f}, {0, 2}, {3.5f, -1.5f}});
    case Icon::folder:
      return folder(pen);
    case Icon::file:
      return file(pen);
    case Icon::up:
      return up(pen);
  }
}

}  // namespace meander
