#include "ui/style.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace meander {
namespace {

struct FontFiles {
  std::string plain;
  std::string strong;
};

// Whether the file begins as a TrueType or OpenType font does: ImGui takes that for granted.
bool readable(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 4> start{};
  if (path.empty() || !file.read(start.data(), start.size())) return false;
  const std::string_view tag(start.data(), start.size());
  return tag == "OTTO" || tag == "true" || tag == "ttcf" || tag == std::string_view("\0\1\0\0", 4);
}

FontFiles find_fonts() {
  std::vector<FontFiles> choices;
  if (const char* own = std::getenv("MEANDER_FONT"); own && *own) {
    if (!readable(own))
      throw Error(Fault::runtime, std::string(own) + ": not a font file, but MEANDER_FONT names it");
    return {own, own};
  }
  choices.push_back({MEANDER_FONT, MEANDER_STRONG_FONT});  // as found when this was built
  const std::string shared = "/usr/share/fonts/";
  for (const char* folder : {"opentype/inter/", "truetype/inter/", "inter/"})
    choices.push_back({shared + folder + "Inter-Regular.otf", shared + folder + "Inter-SemiBold.otf"});
  choices.push_back({shared + "truetype/open-sans/OpenSans-Regular.ttf",
                     shared + "truetype/open-sans/OpenSans-Semibold.ttf"});
  choices.push_back(
      {shared + "truetype/dejavu/DejaVuSans.ttf", shared + "truetype/dejavu/DejaVuSans-Bold.ttf"});
  for (const FontFiles& files : choices)
    if (readable(files.plain)) return {files.plain, readable(files.strong) ? files.strong : files.plain};
  throw Error(Fault::runtime,
              "the interface finds no font: install the package fonts-inter, or name a font file in the "
              "environment variable MEANDER_FONT");
}

// Every digit as wide as the widest, in the middle of its place.
void align_digits(ImFont& font) {
  float width = 0;
  for (ImWchar digit = '0'; digit <= '9'; ++digit) width = std::max(width, font.GetCharAdvance(digit));
  for (ImFontGlyph& glyph : font.Glyphs) {
    if (glyph.Codepoint < '0' || glyph.Codepoint > '9') continue;
    const float shift = 0.5f * (width - glyph.AdvanceX);
    glyph.X0 += shift;
    glyph.X1 += shift;
    glyph.AdvanceX = width;
    font.IndexAdvanceX[static_cast<int>(glyph.Codepoint)] = width;
  }
}

ImFont* add_font(const std::string& file, float points, float scale) {
  // Latin, Greek, punctuation, super- and subscripts, fractions, arrows, operators.
  static constexpr std::array<ImWchar, 15> kRanges{0x20,   0xFF,   0x391,  0x3C9,  0x2010,
                                                   0x203A, 0x2070, 0x209C, 0x2150, 0x215F,
                                                   0x2190, 0x2193, 0x2202, 0x2265, 0};
  ImFontConfig config;
  config.OversampleH = 2;
  config.OversampleV = 1;
  config.PixelSnapH = false;
  return ImGui::GetIO().Fonts->AddFontFromFileTTF(file.c_str(), points * scale, &config, kRanges.data());
}

}  // namespace

ImFont* plain_font() { return ImGui::GetIO().Fonts->Fonts[0]; }
ImFont* small_font() { return ImGui::GetIO().Fonts->Fonts[1]; }
ImFont* strong_font() { return ImGui::GetIO().Fonts->Fonts[2]; }

void load_fonts(float scale) {
  ImGuiIO& io = ImGui::GetIO();
  const FontFiles files = find_fonts();
  io.Fonts->Clear();
  io.Fonts->Flags |= ImFontAtlasFlags_NoMouseCursors;
  const bool loaded = add_font(files.plain, kTextSize, scale) && add_font(files.plain, kSmallSize, scale) &&
                      add_font(files.strong, kTextSize, scale) && io.Fonts->Build();
  if (!loaded)
    throw Error(Fault::runtime,
                files.plain + ": not a font that can be read; the package fonts-inter has one");
  for (ImFont* font : io.Fonts->Fonts) {
    font->Scale = 1 / scale;
    align_digits(*font);
  }
}

void apply_style() {
  ImGuiStyle style;
  style.WindowPadding = {10, 8};
  style.FramePadding = {6, 3};
  style.ItemSpacing = {6, 3};
  style.ItemInnerSpacing = {5, 4};
  style.CellPadding = {4, 2};
  style.IndentSpacing = 12;
  style.ScrollbarSize = 9;
  style.GrabMinSize = 8;
  style.WindowBorderSize = 0;
  style.ChildBorderSize = 0;
  style.PopupBorderSize = 1;
  style.FrameBorderSize = 0;
  style.WindowRounding = 0;
  style.ChildRounding = kRounding;
  style.FrameRounding = kRounding;
  style.PopupRounding = 4;
  style.ScrollbarRounding = 4;
  style.GrabRounding = kRounding;
  style.CircleTessellationMaxError = 0.1f;
  style.CurveTessellationTol = 0.4f;
  const auto set = [&style](ImGuiCol index, ImU32 color) {
    style.Colors[index] = ImGui::ColorConvertU32ToFloat4(color);
  };
  set(ImGuiCol_Text, kTextColor);
  set(ImGuiCol_TextDisabled, kDimColor);
  set(ImGuiCol_WindowBg, kPanelColor);
  set(ImGuiCol_ChildBg, 0);
  set(ImGuiCol_PopupBg, IM_COL32(46, 46, 46, 255));
  set(ImGuiCol_Border, IM_COL32(16, 16, 16, 255));
  for (const ImGuiCol frame : {ImGuiCol_FrameBg, ImGuiCol_Button, ImGuiCol_Header}) set(frame, kFrameColor);
  for (const ImGuiCol hovered : {ImGuiCol_FrameBgHovered, ImGuiCol_ButtonHovered, ImGuiCol_HeaderHovered})
    set(hovered, kHoverColor);
  for (const ImGuiCol held : {ImGuiCol_FrameBgActive, ImGuiCol_ButtonActive, ImGuiCol_HeaderActive})
    set(held, kHeldColor);
  set(ImGuiCol_CheckMark, kAccent);
  set(ImGuiCol_SliderGrab, kAccent);
  set(ImGuiCol_SliderGrabActive, kAccent);
  set(ImGuiCol_ScrollbarBg, 0);
  set(ImGuiCol_ScrollbarGrab, IM_COL32(74, 74, 74, 255));
  set(ImGuiCol_ScrollbarGrabHovered, IM_COL32(92, 92, 92, 255));
  set(ImGuiCol_ScrollbarGrabActive, IM_COL32(110, 110, 110, 255));
  set(ImGuiCol_Separator, IM_COL32(60, 60, 60, 255));
  set(ImGuiCol_TextSelectedBg, kAccentFill);
  set(ImGuiCol_ModalWindowDimBg, IM_COL32(0, 0, 0, 120));
  set(ImGuiCol_NavHighlight, kAccent);
  ImGui::GetStyle() = style;
}

}  // namespace meander
