#include "io/material_export.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "medium/presets.h"
#include "medium/similarity.h"

using namespace meander;

namespace {

constexpr Renderer kAll[] = {Renderer::cycles,  Renderer::arnold,  Renderer::renderman,
                             Renderer::openpbr, Renderer::mitsuba, Renderer::pbrt};

TranslucentMaterial material(const DVec3& albedo, const DVec3& mean_free_path, double g, Boundary boundary,
                             double ior = 1) {
  return {medium_from_albedo(albedo, mean_free_path, g), boundary, ior, 0};
}

std::string text_of(const TranslucentMaterial& what, Renderer renderer, double millimetres_per_unit = 1) {
  return export_material(what, "wax", renderer, millimetres_per_unit).text;
}

// The numbers that follow the marker, whatever stands between them.
std::vector<double> numbers(const std::string& text, const std::string& marker, int count) {
  const std::size_t at = text.find(marker);
  REQUIRE_MESSAGE(at != std::string::npos, "no " << marker << " in " << text);
  const char* here = text.c_str() + at + marker.size();
  std::vector<double> found;
  while (static_cast<int>(found.size()) < count) {
    while (std::string_view("0123456789-").find(*here) == std::string_view::npos) ++here;
    char* end = nullptr;
    found.push_back(std::strtod(here, &end));
    here = end;
  }
  return found;
}

DVec3 triple(const std::string& text, const std::string& marker) {
  const std::vector<double> found = numbers(text, marker, 3);
  return {found[0], found[1], found[2]};
}

double number(const std::string& text, const std::string& marker) { return numbers(text, marker, 1)[0]; }

void check_near(const DVec3& got, const DVec3& wanted, double relative = 1e-6) {
  for (int c = 0; c < 3; ++c) {
    CAPTURE(c);
    CHECK(std::abs(got[c] - wanted[c]) <= relative * std::abs(wanted[c]));
  }
}

bool has_note(const ExportedMaterial& exported, const std::string& word) {
  return std::ranges::any_of(exported.notes,
                             [&](const std::string& note) { return note.find(word) != std::string::npos; });
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

// Wrenninge, Villemin, Hery 2017, as Cycles has it, by plain powers.
double wrenninge(double color, double g) {
  const auto sum = [g](std::initializer_list<double> coefficients) {
    double total = 0;
    int power = 0;
    for (const double c : coefficients) total += c * std::pow(g, power++);
    return total;
  };
  const double a = sum({1.8260523782, -1.28451056436, -1.79904629312, 9.19393289202, -22.8215585862,
                        32.0234874259, -23.6264803333, 7.21067002658});
  const double b =
      4.98511194385 +
      0.127355959438 * std::exp(sum({0, 31.1491581433, -201.847017512, 841.576016723, -2018.09288505,
                                     2731.71560286, -1935.41424244, 559.009054474}));
  const double c = sum({1.09686102424, -0.394704063468, 1.05258115941, -8.83963712726, 28.8643230661,
                        -46.8802913581, 38.5402837518, -12.7181042538});
  const double d = sum({0.496310210422, 0.360146581622, -2.15139309747, 17.8896899217, -55.2984010333,
                        82.065982243, -58.5106008578, 15.8478295021});
  const double e =
      4.23190299701 +
      0.00310603949088 * std::exp(sum({0, 76.7316253952, -594.356773233, 2448.8834203, -5576.68528998,
                                       7116.60171912, -4763.54467887, 1303.5318055}));
  const double f = sum({2.40602999408, -2.51814844609, 9.18494908356, -79.2191708682, 259.082868209,
                        -403.613804597, 302.85712436, -87.4370473567});
  const double blend = std::pow(color, 0.25);
  return std::min(0.999999, (1 - blend) * a * std::pow(std::atan(b * color), c) +
                                blend * d * std::pow(std::atan(e * color), f));
}

struct Walked {
  DVec3 sigma_t;
  DVec3 albedo;
  double g;
};

// What Cycles walks in, by its own meaning of the numbers.
Walked read_cycles(const std::string& text) {
  Walked walked{};
  const std::string value = "\"].default_value = ";
  walked.g = number(text, "Subsurface Anisotropy" + value);
  const DVec3 color = triple(text, "Base Color" + value);
  const DVec3 radius = triple(text, "Subsurface Radius" + value) * number(text, "Subsurface Scale" + value);
  for (int c = 0; c < 3; ++c) walked.albedo[c] = wrenninge(color[c], walked.g);
  walked.sigma_t = 4 * glm::pi<double>() / (radius * (1 - walked.g));
  return walked;
}

// Van de Hulst's inversion as OpenPBR 1.1 writes it.
double van_de_hulst(double color, double g) {
  const double s = 4.09712 + 4.20863 * color - std::sqrt(9.59217 + 41.6808 * color + 17.7126 * color * color);
  return (1 - s * s) / (1 - g * s * s);
}

}  // namespace

TEST_CASE("Cycles' walk below a surface has our sigma_t, albedo and g") {
  for (const double g : {0.0, 0.3, 0.7, 0.9}) {
    const TranslucentMaterial wax =
        material({0.31, 0.9, 0.9995}, {0.02, 3, 150}, g, Boundary::dielectric, 1.4);
    const Walked walked = read_cycles(text_of(wax, Renderer::cycles));
    CAPTURE(g);
    CHECK(walked.g == doctest::Approx(g).epsilon(1e-6));
    check_near(walked.albedo, DVec3(wax.medium.albedo));
    check_near(walked.sigma_t, DVec3(wax.medium.sigma_t));
  }
}

TEST_CASE("a g that Cycles' walk does not take is exchanged for a similar medium") {
  for (const double g : {-0.6, 0.97}) {
    const TranslucentMaterial wax = material({0.7, 0.9, 0.99}, {0.5, 1, 2}, g, Boundary::diffuse);
    const ExportedMaterial exported = export_material(wax, "wax", Renderer::cycles, 1);
    CHECK(has_note(exported, "Cycles takes 0 to 0.9"));
    const Walked walked = read_cycles(exported.text);
    CHECK(walked.g == (g < 0 ? 0 : 0.9));
    const Coefficients ours = reduced(coefficients_of(wax.medium));
    check_near(walked.sigma_t * walked.albedo * (1 - walked.g), ours.sigma_s);
    check_near(walked.sigma_t * (1.0 - walked.albedo), ours.sigma_a, 1e-5);
  }
}

TEST_CASE("a matched body is a volume for Cycles, with our coefficients") {
  const TranslucentMaterial fog = material({0.2, 0.9, 0.95}, {0.1, 0.4, 2}, -0.4, Boundary::matched);
  const ExportedMaterial exported = export_material(fog, "fog", Renderer::cycles, 1);
  CHECK(exported.notes.empty());
  const std::string& text = exported.text;
  CHECK(text.find("ShaderNodeBsdfPrincipled") == std::string::npos);
  const std::string color = ".inputs[\"Color\"].default_value = ";
  const std::string density = ".inputs[\"Density\"].default_value = ";
  const DVec3 sigma_s = triple(text, "scatter" + color) * number(text, "scatter" + density);
  const DVec3 sigma_a = (1.0 - triple(text, "absorption" + color)) * number(text, "absorption" + density);
  check_near(sigma_s + sigma_a, DVec3(fog.medium.sigma_t));
  check_near(sigma_s / (sigma_s + sigma_a), DVec3(fog.medium.albedo));
  CHECK(number(text, "Anisotropy\"].default_value = ") == doctest::Approx(-0.4).epsilon(1e-6));
}

TEST_CASE("OpenPBR's own map gives our albedo, its radius our mean free path") {
  for (const double g : {-0.8, 0.0, 0.5, 0.95}) {
    const TranslucentMaterial wax = material({0.05, 0.9, 0.9999}, {0.02, 3, 150}, g, Boundary::matched);
    const ExportedMaterial exported = export_material(wax, "wax", Renderer::openpbr, 1);
    const std::string& text = exported.text;
    CAPTURE(g);
    CHECK(exported.notes.empty());
    const DVec3 color = triple(text, "\"subsurface_color\" type=\"color3\" value=");
    for (int c = 0; c < 3; ++c)
      CHECK(van_de_hulst(color[c], g) == doctest::Approx(double{wax.medium.albedo[c]}).epsilon(1e-6));
    const DVec3 scale = triple(text, "\"subsurface_radius_scale\" type=\"color3\" value=");
    const double radius = number(text, "\"subsurface_radius\" type=\"float\" value=");
    check_near(1.0 / (radius * scale), DVec3(wax.medium.sigma_t));
    CHECK(scale.z == 1);
    CHECK(number(text, "\"subsurface_scatter_anisotropy\" type=\"float\" value=") ==
          doctest::Approx(g).epsilon(1e-6));
    CHECK(number(text, "\"specular_weight\" type=\"float\" value=") == 0);
  }
}

TEST_CASE("Mitsuba and pbrt get the coefficients themselves, and the width of the facets") {
  TranslucentMaterial jade = material({0.3, 0.9, 0.999}, {0.02, 0.5, 40}, 0.6, Boundary::dielectric, 1.6);
  jade.roughness = 0.3;
  const Coefficients ours = coefficients_of(jade.medium);
  const std::string mitsuba = text_of(jade, Renderer::mitsuba);
  check_near(number(mitsuba, "\"scale\" value=") * triple(mitsuba, "\"sigma_t\" value="), sigma_t_of(ours));
  check_near(triple(mitsuba, "\"albedo\" value="), albedo_of(ours));
  CHECK(number(mitsuba, "\"g\" value=") == doctest::Approx(0.6).epsilon(1e-6));
  CHECK(number(mitsuba, "\"alpha\" value=") == doctest::Approx(0.09).epsilon(1e-9));
  CHECK(number(mitsuba, "\"int_ior\" value=") == 1.6);
  CHECK(mitsuba.find("type=\"roughdielectric\"") != std::string::npos);
  const std::string pbrt = text_of(jade, Renderer::pbrt);
  check_near(triple(pbrt, "\"rgb sigma_s\""), ours.sigma_s);
  check_near(triple(pbrt, "\"rgb sigma_a\""), ours.sigma_a);
  CHECK(number(pbrt, "\"float g\"") == doctest::Approx(0.6).epsilon(1e-6));
  CHECK(number(pbrt, "\"float roughness\"") == doctest::Approx(0.09).epsilon(1e-9));
  CHECK(number(pbrt, "\"float eta\"") == 1.6);
}

TEST_CASE("a dielectric boundary without an index step is none") {
  const TranslucentMaterial plain = material(DVec3(0.9), DVec3(1), 0.3, Boundary::matched);
  TranslucentMaterial frosted = material(DVec3(0.9), DVec3(1), 0.3, Boundary::dielectric);
  frosted.roughness = 0.4;
  for (const Renderer renderer : kAll) CHECK(text_of(frosted, renderer) == text_of(plain, renderer));
}

TEST_CASE("the boundary of each kind in Mitsuba and pbrt") {
  const auto with = [](Boundary boundary, double ior) {
    return material(DVec3(0.9), DVec3(1), 0, boundary, ior);
  };
  CHECK(text_of(with(Boundary::matched, 1), Renderer::mitsuba).find("type=\"null\"") != std::string::npos);
  CHECK(text_of(with(Boundary::matched, 1), Renderer::pbrt).find("\"interface\"") != std::string::npos);
  CHECK(text_of(with(Boundary::dielectric, 1.5), Renderer::mitsuba).find("type=\"dielectric\"") !=
        std::string::npos);
  CHECK(text_of(with(Boundary::dielectric, 1), Renderer::mitsuba).find("type=\"null\"") != std::string::npos);
  CHECK(text_of(with(Boundary::diffuse, 1), Renderer::pbrt).find("\"diffusetransmission\"") !=
        std::string::npos);
}

TEST_CASE("RenderMan's interior has the albedo and the extinction, its lobe a diffuse mean free path in mm") {
  const TranslucentMaterial jade =
      material({0.3, 0.9, 0.999}, {0.02, 0.5, 40}, 0.6, Boundary::dielectric, 1.6);
  const std::string glass = text_of(jade, Renderer::renderman);
  check_near(triple(glass, "\"color ssAlbedo\""), DVec3(jade.medium.albedo));
  check_near(triple(glass, "\"color extinction\""), DVec3(jade.medium.sigma_t));
  CHECK(number(glass, "\"float g\"") == doctest::Approx(0.6).epsilon(1e-6));

  // Pixar's table of Jensen's marble: 8.51 5.57 3.95 mm.
  constexpr double kMillimetresPerUnit = 10;
  Coefficients per_unit = preset_coefficients(*find_preset("marble"), 0);
  per_unit.sigma_s *= kMillimetresPerUnit;
  per_unit.sigma_a *= kMillimetresPerUnit;
  const TranslucentMaterial marble{make_medium(per_unit), Boundary::diffuse, 1, 0};
  const std::string lobe = text_of(marble, Renderer::renderman, kMillimetresPerUnit);
  check_near(number(lobe, "\"float subsurfaceDmfp\"") * triple(lobe, "\"color subsurfaceDmfpColor\""),
             {8.51, 5.57, 3.95}, 1e-3);
  CHECK(number(lobe, "\"float unitLength\"") == doctest::Approx(0.1).epsilon(1e-9));
}

TEST_CASE("Arnold gets the surface colour of the body and the mean free path") {
  const TranslucentMaterial wax =
      material({0.3, 0.9, 0.999}, {0.02, 0.5, 40}, 0.6, Boundary::dielectric, 1.5);
  const std::string text = text_of(wax, Renderer::arnold);
  check_near(number(text, "\n subsurface_scale ") * triple(text, "\n subsurface_radius "),
             1.0 / DVec3(wax.medium.sigma_t));
  check_near(triple(text, "\n subsurface_color "),
             color_of(DVec3(wax.medium.albedo), double{wax.medium.g}, {Boundary::dielectric, 1.5}));
  CHECK(number(text, "subsurface_anisotropy ") == doctest::Approx(0.6).epsilon(1e-6));
}

TEST_CASE("lengths are scene units whatever a unit is, and the text says what it is") {
  const TranslucentMaterial wax = material(DVec3(0.9), DVec3(0.5), 0, Boundary::diffuse);
  for (const Renderer renderer : kAll) {
    std::string text = text_of(wax, renderer, 25.4);
    CHECK(count(text, "of 25.4 mm each") == 1);
    if (renderer == Renderer::renderman) continue;
    text.replace(text.find("of 25.4 mm"), 10, "of 1 mm");
    CHECK(text == text_of(wax, renderer, 1));
  }
}

TEST_CASE("a note where something is lost") {
  const auto notes = [](const TranslucentMaterial& what, Renderer renderer) {
    return export_material(what, "wax", renderer, 1);
  };
  const TranslucentMaterial glass = material(DVec3(0.9), DVec3(1), 0, Boundary::dielectric, 1.5);
  CHECK(has_note(notes(glass, Renderer::cycles), "reflected back inside"));
  CHECK(has_note(notes(glass, Renderer::arnold), "reflected back inside"));
  CHECK(has_note(notes(glass, Renderer::arnold), "not published"));
  CHECK(has_note(notes(glass, Renderer::openpbr), "knows no interface"));
  TranslucentMaterial rough = glass;
  rough.roughness = 0.5;
  for (const Renderer renderer : {Renderer::renderman, Renderer::mitsuba, Renderer::pbrt})
    CHECK(has_note(notes(rough, renderer), "roughness 0.5"));
  const TranslucentMaterial diffuse = material(DVec3(0.9), DVec3(1), 0, Boundary::diffuse, 1.5);
  CHECK(has_note(notes(diffuse, Renderer::mitsuba), "diffuse boundary"));
  CHECK(has_note(notes(diffuse, Renderer::pbrt), "diffuse boundary"));
  CHECK(has_note(notes(diffuse, Renderer::openpbr), "diffuse boundary"));
  CHECK(has_note(notes(diffuse, Renderer::renderman), "reflected back inside"));
  CHECK(has_note(notes(material({0, 0.5, 0.9}, DVec3(1), 0.99, Boundary::matched), Renderer::openpbr),
                 "so low a single-scattering albedo"));
  const TranslucentMaterial extreme = material({0.1, 0.9, 1}, DVec3(1), 0.5, Boundary::dielectric, 3.9);
  for (const char* word : {"0.999999", "below 0.2", "256", "similarity", "refracted by 3.8"})
    CHECK(has_note(notes(extreme, Renderer::cycles), word));
  const TranslucentMaterial white = material(DVec3(1), DVec3(1), 0.9999, Boundary::matched);
  CHECK(has_note(notes(white, Renderer::cycles), "1024"));
  CHECK(has_note(notes(white, Renderer::cycles), "g 0.9999"));
  CHECK(
      has_note(notes(material({0.9, 0.8, 0.7}, DVec3(1), 0, Boundary::matched), Renderer::pbrt), "spectra"));
}

TEST_CASE("no note where nothing is lost") {
  const TranslucentMaterial matched = material(DVec3(0.9), DVec3(1), 0.5, Boundary::matched);
  for (const Renderer renderer :
       {Renderer::cycles, Renderer::renderman, Renderer::openpbr, Renderer::mitsuba, Renderer::pbrt})
    CHECK(export_material(matched, "wax", renderer, 1).notes.empty());
  const TranslucentMaterial glass = material(DVec3(0.9), DVec3(1), 0.5, Boundary::dielectric, 1.5);
  for (const Renderer renderer : {Renderer::renderman, Renderer::mitsuba, Renderer::pbrt})
    CHECK(export_material(glass, "wax", renderer, 1).notes.empty());
  const TranslucentMaterial diffuse = material(DVec3(0.9), DVec3(1), 0, Boundary::diffuse);
  CHECK(export_material(diffuse, "wax", Renderer::pbrt, 1).notes.empty());
  const ExportedMaterial cycles = export_material(diffuse, "wax", Renderer::cycles, 1);
  CHECK(cycles.notes.size() == 1);
  CHECK(has_note(cycles, "light enters"));
}

TEST_CASE("notes are comments of the text, and carry the material's name where there are several") {
  const TranslucentMaterial glass = material({0.1, 0.9, 1}, DVec3(1), 0.5, Boundary::dielectric, 1.5);
  const std::vector<NamedMaterial> two{{"jade", glass}, {"soap", glass}};
  for (const Renderer renderer : kAll) {
    const ExportedMaterial one = export_material(glass, "jade", renderer, 1);
    const std::string mark =
        renderer == Renderer::openpbr || renderer == Renderer::mitsuba ? "<!-- Note: " : "# Note: ";
    CHECK(count(one.text, mark) == one.notes.size());
    for (const std::string& note : one.notes) CHECK(count(one.text, mark + note) == 1);
    const ExportedMaterial both = export_materials(two, renderer, 1);
    REQUIRE(both.notes.size() == 2 * one.notes.size());
    for (std::size_t i = 0; i < one.notes.size(); ++i) {
      CHECK(both.notes[i] == "jade: " + one.notes[i]);
      CHECK(both.notes[i + one.notes.size()] == "soap: " + one.notes[i]);
    }
  }
}

TEST_CASE("no name breaks out of its place") {
  const TranslucentMaterial wax = material(DVec3(0.9), DVec3(1), 0, Boundary::matched);
  const std::string nasty = "a\"b'c\\\n--> <x/> --- $y #{}\r\t\x01\xff\xc3\xa4\xe8\x9d\x8b\xf0\x9f\x95\xaf";
  for (const Renderer renderer : kAll) {
    const std::string text = export_material(wax, nasty, renderer, 1).text;
    const std::string plain = export_material(wax, "wax", renderer, 1).text;
    CHECK(count(text, "\n") == count(plain, "\n"));
    CHECK(std::ranges::all_of(text, [](char c) { return c == '\n' || (c >= 0x20 && c < 0x7f); }));
    if (renderer != Renderer::openpbr && renderer != Renderer::mitsuba) continue;
    CHECK(count(text, "-->") == count(plain, "-->"));
    CHECK(count(text, "--") == count(plain, "--"));
  }
  const std::string python = text_of(wax, Renderer::cycles);
  CHECK(python.find("materials.new(\"wax\")") != std::string::npos);
  CHECK(
      export_material(wax, nasty, Renderer::cycles, 1)
          .text.find(
              "new(\"a\\\"b'c\\\\\\x0a--> <x/> --- $y #{}\\x0d\\x09\\x01\\ufffd\\xe4\\u874b\\U0001f56f\")") !=
      std::string::npos);
}

TEST_CASE("identifiers are unique, also with what is made of them") {
  const TranslucentMaterial wax = material(DVec3(0.9), DVec3(1), 0, Boundary::matched);
  std::vector<NamedMaterial> materials;
  for (const char* name :
       {"a b", "a_b", "a_b_2", "a_b_medium", "a_b_surface", "x_surface", "x", "9", "_9", "", "\xe8\x9d\x8b"})
    materials.push_back({name, wax});
  for (const auto& [renderer, marker] : {std::pair(Renderer::openpbr, std::string(" name=\"")),
                                         std::pair(Renderer::mitsuba, std::string(" id=\""))}) {
    const std::string text = export_materials(materials, renderer, 1).text;
    std::multiset<std::string> identifiers;
    for (std::size_t at = text.find(marker); at != std::string::npos; at = text.find(marker, at + 1)) {
      const std::size_t begin = at + marker.size();
      const std::size_t line = text.rfind('\n', at) + 1;
      if (text.compare(line, 4, "    ") != 0)
        identifiers.insert(text.substr(begin, text.find('"', begin) - begin));
    }
    CHECK(identifiers.size() == 2 * materials.size());
    for (const std::string& identifier : identifiers) CHECK(identifiers.count(identifier) == 1);
  }
}

TEST_CASE("channels and media without extinction leave finite numbers") {
  for (const DVec3& sigma_s : {DVec3(0), DVec3(1, 0, 2)})
    for (const Boundary boundary : {Boundary::matched, Boundary::diffuse, Boundary::dielectric})
      for (const Renderer renderer : kAll) {
        const TranslucentMaterial thin{medium_from_sigma(sigma_s, DVec3(0), 0.2), boundary,
                                       boundary == Boundary::matched ? 1 : 1.3, 0};
        const ExportedMaterial exported = export_material(thin, "thin", renderer, 1);
        for (const char* word : {"inf", "nan"})
          for (const char* before : {" ", "(", "[", "\""})
            CHECK(exported.text.find(std::string(before) + word + ',') == std::string::npos);
        CHECK(exported.text.find(" nan") == std::string::npos);
        CHECK(exported.text.find("-nan") == std::string::npos);
        if (renderer == Renderer::arnold || renderer == Renderer::openpbr)
          CHECK(has_note(exported, "without extinction"));
      }
}
