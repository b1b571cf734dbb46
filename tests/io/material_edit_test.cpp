#include "io/scene_text.h"
#include "medium/coefficients.h"
#include "medium/similarity.h"

using namespace meander;

namespace {

struct Before {
  std::string text;
  Surface surface;
};

const std::string kGlass = "boundary = \"dielectric\"\nior = 1.5\n";
const Surface kGlassSurface{Boundary::dielectric, 1.5};

DVec3 reduced_sigma_t(const Medium& medium) { return sigma_t_of(reduced(coefficients_of(medium))); }

DVec3 color_of_medium(const Medium& medium, const Surface& surface) {
  return color_of(DVec3(medium.albedo), static_cast<double>(medium.g), surface);
}

void check_close(const DVec3& value, const DVec3& expected, double relative) {
  for (int c = 0; c < 3; ++c) {
    CAPTURE(c);
    CHECK(value[c] == doctest::Approx(expected[c]).epsilon(relative));
  }
}

void check_colors(const Medium& now, const Medium& before, const Surface& surface) {
  const DVec3 a = color_of_medium(now, surface);
  const DVec3 b = color_of_medium(before, surface);
  for (int c = 0; c < 3; ++c) CHECK(std::abs(a[c] - b[c]) < 1e-4);
}

// The same wax in each parametrisation, with g = 0.3 before the edit.
const Before kEach[] = {
    {kWax + "g = 0.3\nsigma_s = [3, 2, 1]\nsigma_a = [0.1, 0.5, 0.02]\n", {}},
    {kWax + "g = 0.3\nsigma_s = [3, 2, 1]\nsigma_a = [0.1, 0.5, 0.02]\n" + kGlass, kGlassSurface},
    {kWax + "g = 0.3\nalbedo = [0.9, 0.5, 0.99]\nmean_free_path = [0.1, 0.2, 1]\n", {}},
    {kWax + "g = 0.3\nalbedo = [0.9, 0.5, 0.99]\nmean_free_path = [0.1, 0.2, 1]\n" + kGlass, kGlassSurface},
    {kWax + "g = 0.3\ncolor = [0.2, 0.5, 0.9]\nradius = [0.1, 0.2, 1]\nradius_scale = 0.5\n", {}},
    {kWax + "g = 0.3\ncolor = [0.2, 0.5, 0.9]\nradius = [0.1, 0.2, 1]\nradius_scale = 0.5\n" + kGlass,
     kGlassSurface},
    {kWax + "preset = \"skin1\"\ng = 0.3\n", {Boundary::dielectric, 1.3}},
    {kWax + "preset = \"skin1\"\ng = 0.3\nradius = 0.5\n", {Boundary::dielectric, 1.3}},
};

}  // namespace

TEST_CASE("an edit of g holds the colour and sigma_t' by default, however the medium is given") {
  for (const Before& c : kEach) {
    CAPTURE(c.text);
    const Medium before = medium_of(load("[scene]\nmillimetres_per_unit = 4\n" + c.text));
    const Medium now =
        medium_of(load("[scene]\nmillimetres_per_unit = 4\n" + c.text, {"material.wax.g=0.85"}));
    CHECK(before.g == Real(0.3));
    CHECK(now.g == Real(0.85));
    CHECK(now.sigma_t.x > Real(1.5) * before.sigma_t.x);
    check_colors(now, before, c.surface);
    check_close(reduced_sigma_t(now), reduced_sigma_t(before), 1e-5);
  }
}

TEST_CASE("with g_lock sigma_t an edit of g holds sigma_t, and what the material names as its colour") {
  for (const Before& c : kEach) {
    CAPTURE(c.text);
    const Medium before = medium_of(load(c.text));
    const Medium now = medium_of(load(c.text + "g_lock = \"sigma_t\"\n", {"material.wax.g=-0.5"}));
    CHECK(now.g == Real(-0.5));
    check_close(DVec3(now.sigma_t), DVec3(before.sigma_t), 1e-6);
    if (c.text.find("color") != std::string::npos || c.text.find("radius") != std::string::npos)
      check_colors(now, before, c.surface);
    else
      check_close(DVec3(now.albedo), DVec3(before.albedo), 1e-6);
  }
}

TEST_CASE("with g_lock sigma_s_reduced an edit of g holds sigma_a and sigma_s (1 - g)") {
  for (const Before& c : kEach) {
    CAPTURE(c.text);
    const Coefficients before = reduced(coefficients_of(medium_of(load(c.text))));
    const Medium now =
        medium_of(load(c.text, {"material.wax.g_lock=sigma_s_reduced", "material.wax.g=0.85"}));
    CHECK(now.g == Real(0.85));
    check_close(reduced(coefficients_of(now)).sigma_s, before.sigma_s, 1e-5);
    check_close(reduced(coefficients_of(now)).sigma_a, before.sigma_a, 1e-4);  // of a float albedo near 1
  }
}

TEST_CASE("with the inversions of the literature an edit of g keeps the colour key and sigma_t'") {
  for (const std::string inversion : {"chiang", "van_de_hulst"}) {
    CAPTURE(inversion);
    const std::string text =
        kWax + "color = [0.2, 0.5, 0.9]\nradius = [0.1, 0.2, 1]\ninversion = \"" + inversion + "\"\n";
    const Medium before = medium_of(load(text));
    for (const std::string lock : {"look", "sigma_s_reduced"}) {
      const Medium now = medium_of(load(text + "g_lock = \"" + lock + "\"\n", {"material.wax.g=0.7"}));
      check_close(reduced_sigma_t(now), reduced_sigma_t(before), 1e-5);
      check_close(reduced(coefficients_of(now)).sigma_s, reduced(coefficients_of(before)).sigma_s, 1e-5);
    }
    const Medium plain = medium_of(load(text + "g_lock = \"sigma_t\"\n", {"material.wax.g=0.7"}));
    check_close(DVec3(plain.sigma_t), DVec3(before.sigma_t), 1e-6);
    CHECK(plain.albedo.y > before.albedo.y);
  }
}

TEST_CASE("g_lock says nothing about a file that just gives g, nor does an edit to the g it has") {
  const std::string text = kWax + "albedo = 0.7\nmean_free_path = 0.5\ng = 0.4\n";
  for (const std::string lock : {"look", "sigma_t", "sigma_s_reduced"}) {
    const Medium medium = medium_of(load(text + "g_lock = \"" + lock + "\"\n"));
    CHECK(medium.albedo == Rgb(Real(0.7)));
    CHECK(medium.sigma_t == Rgb(2));
  }
  const Medium same = medium_of(load(text, {"material.wax.g=0.4"}));
  CHECK(same.albedo == Rgb(Real(0.7)));
  CHECK(same.sigma_t == Rgb(2));
}

TEST_CASE("a g that is none, or belongs to nothing, is answered as before") {
  const std::string text = kWax + "albedo = 0.7\nmean_free_path = 0.5\n";
  CHECK(error_of(text, {"material.wax.g=thick"}) ==
        "--set material.wax.g=thick: 'g' must be a number, not the text 'thick'");
  CHECK(error_of(text, {"material.wax.g=-1"}) ==
        "--set material.wax.g=-1: 'g' is -1, but must be greater than -1 and less than 1, by 1e-7 at least");
  CHECK(error_of(kWax + "type = \"diffuse\"\n", {"material.wax.g=0.5"}).find("unknown key 'g'") !=
        std::string::npos);
}

TEST_CASE("setting a preset replaces the medium, and members set later override it") {
  const std::string text = kWax + "albedo = 0.7\nmean_free_path = 0.5\ng = 0.4\n";
  const Medium marble = medium_of(load(text, {"material.wax.preset=marble"}));
  CHECK(marble.g == 0);
  check_close(DVec3(marble.sigma_t), {2.1921, 2.6241, 3.0071}, 1e-6);
  const Medium darker = medium_of(load(text, {"material.wax.preset=marble", "material.wax.sigma_a=1"}));
  check_close(DVec3(darker.sigma_t), {3.19, 3.62, 4}, 1e-6);
  const Medium grey = medium_of(
      load(text, {"material.wax.preset=marble", "material.wax.sigma_a=1", "material.wax.albedo=0.5"}));
  check_close(DVec3(grey.sigma_t), {3.19, 3.62, 4}, 1e-6);
  CHECK(grey.albedo == Rgb(Real(0.5)));
}
