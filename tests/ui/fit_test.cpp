// Text in frames of the interface: nothing over another, nothing cut, everything in its panel.
#include <doctest/doctest.h>
#include <imgui_internal.h>

#include <algorithm>
#include <vector>

#include "ui/sample.h"

namespace meander {
namespace {

struct Glyph {
  ImRect box;  // as seen, in points
  ImRect whole;
};

// Every visible glyph: what is not drawn with the atlas' white pixel or its lines.
std::vector<Glyph> glyphs_of(const ImDrawData& data) {
  std::vector<Glyph> glyphs;
  const ImFont* fonts = ImGui::GetFont();
  for (int n = 0; n < data.CmdListsCount; ++n) {
    const ImDrawList& list = *data.CmdLists[n];
    for (const ImDrawCmd& command : list.CmdBuffer) {
      const ImRect clip(command.ClipRect);
      for (unsigned i = 0; i + 6 <= command.ElemCount; i += 3) {
        const auto vertex = [&](unsigned k) -> const ImDrawVert& {
          return list.VtxBuffer[static_cast<int>(list.IdxBuffer[static_cast<int>(command.IdxOffset + i + k)] +
                                                 command.VtxOffset)];
        };
        const ImDrawVert& a = vertex(0);
        const ImDrawVert& c = vertex(2);
        // The first triangle of a glyph: upper left, upper right, lower right of a piece of the atlas.
        const bool glyph = a.pos.x < c.pos.x && a.pos.y < c.pos.y && vertex(1).pos.y == a.pos.y &&
                           vertex(1).uv.x == c.uv.x && c.uv.x - a.uv.x > 1.0f / 512 && c.uv.y > a.uv.y &&
                           fonts->ContainerAtlas->TexWidth > 0;
        if (!glyph) continue;
        const ImRect whole(a.pos, c.pos);
        ImRect seen = whole;
        seen.ClipWithFull(clip);
        if (seen.GetWidth() > 0 && seen.GetHeight() > 0) glyphs.push_back({seen, whole});
      }
    }
  }
  return glyphs;
}

float area_of(const ImRect& box) { return std::max(0.0f, box.GetWidth()) * std::max(0.0f, box.GetHeight()); }

// Pairs of glyphs of which one covers a good part of the other.
int overlaps(const std::vector<Glyph>& glyphs) {
  int found = 0;
  for (std::size_t i = 0; i < glyphs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      ImRect both = glyphs[i].box;
      if (!both.Overlaps(glyphs[j].box)) continue;
      both.ClipWith(glyphs[j].box);
      found += area_of(both) > 0.3f * std::min(area_of(glyphs[i].box), area_of(glyphs[j].box));
    }
  }
  return found;
}

// Glyphs cut at their left or right.
int cut(const std::vector<Glyph>& glyphs) {
  return static_cast<int>(std::count_if(glyphs.begin(), glyphs.end(), [](const Glyph& glyph) {
    return glyph.box.GetWidth() < glyph.whole.GetWidth() - 1;
  }));
}

}  // namespace

TEST_CASE("no text lies over another or is cut, at every size, with every panel open") {
  for (const auto& [width, height] :
       std::vector<std::pair<int, int>>{{960, 540}, {1280, 720}, {1920, 1080}, {640, 400}}) {
    for (const bool busy : {false, true}) {
      for (const float scroll : {0.0f, 300.0f, 700.0f, 5000.0f}) {
        TestWindow window(width, height);
        if (busy) window.model = busy_model();
        window.model.messages.clear();
        window.model.overlay.film = window.layout().image;
        window.state.open.fill(true);
        window.model.material.now.surface = {Boundary::dielectric, 1.5};
        window.state.lengths_linked = !busy;
        if (busy) window.model.material.now.given = Parametrisation::albedo;
        window.frame();
        window.frame();
        ImGui::SetScrollY(ImGui::FindWindowByName("panel"), scroll);
        window.frame();
        window.frame();
        const std::vector<Glyph> glyphs = glyphs_of(*window.drawn);
        CAPTURE(width);
        CAPTURE(busy);
        CAPTURE(scroll);
        CHECK(glyphs.size() > 250);
        CHECK(overlaps(glyphs) == 0);
        CHECK(cut(glyphs) == 0);
      }
    }
  }
}

TEST_CASE("the search for overlapping text finds it") {
  TestWindow window(640, 400);
  window.interface.begin_frame(window.shape);
  ImGui::GetForegroundDrawList()->AddText({100, 100}, IM_COL32_WHITE, "wax");
  ImGui::GetForegroundDrawList()->AddText({103, 102}, IM_COL32_WHITE, "jade");
  const std::vector<Glyph> glyphs = glyphs_of(*window.interface.end_frame());
  CHECK(glyphs.size() == 7);
  CHECK(overlaps(glyphs) > 0);
}

TEST_CASE("the panel's content is as wide as the panel") {
  for (const int width : {640, 960, 1280, 1920}) {
    TestWindow window(width, 700);
    window.state.open.fill(true);
    for (int i = 0; i < 4; ++i) window.frame();
    const ImGuiWindow* panel = ImGui::FindWindowByName("panel");
    CHECK(panel->ContentSize.x <= panel->WorkRect.GetWidth() + 1);
    CHECK(panel->ScrollMax.x == 0);
  }
}

TEST_CASE("at 1280x720 the first screen needs no scrolling") {
  TestWindow window(1280, 720);
  for (int i = 0; i < 4; ++i) window.frame();
  CHECK(ImGui::FindWindowByName("panel")->ScrollMax.y == 0);
}

TEST_CASE("each panel alone fits into the width of the panel") {
  for (std::size_t i = 0; i < kPanelNames.size(); ++i) {
    TestWindow window(320, 900);
    for (int round = 0; round < 3; ++round) {
      window.interface.begin_frame(window.shape);
      (void)draw_panel(static_cast<PanelName>(i), window.model, window.state, {0, 0, 320, 900});
      window.drawn = window.interface.end_frame();
    }
    const std::vector<Glyph> glyphs = glyphs_of(*window.drawn);
    CAPTURE(kPanelNames[i]);
    CHECK(glyphs.size() > 10);
    CHECK(overlaps(glyphs) == 0);
    CHECK(cut(glyphs) == 0);
  }
}

}  // namespace meander
