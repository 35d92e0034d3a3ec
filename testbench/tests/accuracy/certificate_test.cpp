// Certified errors: no pixel errs by more than was proved of it, whatever the triangle, and what
// cannot be proved takes exact_path.
#include "model/fixed/certificate.h"

#include <gtest/gtest.h>

#include <map>

#include "model/files/scene_file.h"
#include "model/fixed/model_frame.h"
#include "model/fixed/prepared_frame.h"
#include "model/scene/input_error.h"
#include "model/shading/phong.h"
#include "testbench/accuracy/accuracy.h"
#include "testbench/cases/named_scene.h"
#include "testbench/cases/random_frame.h"
#include "testbench/hardware/hardware.h"

namespace phongpipe {
namespace {

constexpr unsigned kCertificateSeed = 1986;

template <typename T>
T one_of(Random& random, std::initializer_list<T> values) {
  return values.begin()[random.below(values.size())];
}

// Any light, viewer, equation and material that the pipeline simulates.
Scene hostile_scene(Random& random, bool plain) {
  Scene scene = lit_scene(64, 48);
  scene.shading.viewer = random.integer(0, 2) == 0 ? Viewer::local : Viewer::infinite;
  scene.shading.highlight = random.integer(0, 2) == 0 ? Highlight::reflection : Highlight::halfway;
  Light& light = scene.lights.front();
  light.direction = -random.unit_near(Vec3(0, 0, 1), 80);
  light.type = one_of(
      random, {LightType::directional, LightType::directional, LightType::point, LightType::spot});
  if (light.type != LightType::directional) {
    light.position = one_of(random, {0.05, 1.0, 20.0}) * random.unit_near(Vec3(0, 0, 1), 60);
    if (random.integer(0, 1) == 0) light.attenuation = {1, 0.2, random.uniform(0, 3)};
    if (random.integer(0, 4) == 0) light.attenuation = {random.uniform(1, 3), 0, 0};
    if (light.type == LightType::spot) {
      light.spot_exponent = one_of(random, {0.0, 1.0, 30.0});
      light.spot_cutoff_degrees = random.uniform(10, 80);
    }
  }
  const double least = light.type == LightType::directional ? 0 : 1;  // fading wants a highlight
  for (int i = 0; i < 4; ++i) {
    const double n = one_of(random, {least, 1.0, 2.5, 20.0, 164.0, 1000.0, 10'000.0});
    scene.materials.push_back(grey_material(one_of(random, {0.0, 1e-6, 0.01, 0.6, 1.0}),
                                            one_of(random, {0.0, 0.02, 0.4, 1.0}), n));
    if (plain && random.integer(0, 5) == 0) scene.materials.back().shininess = 0.4 + least;
  }
  return scene;
}

Vec3 hostile_normal(Random& random, const Vec3& axis, double spread) {
  const Vec3 normal = random.unit_near(axis, spread);
  return random.integer(0, 3) == 0 ? Vec3(random.uniform(0.2, 1) * normal) : normal;
}

// From slivers to triangles that cover the image and reach far beyond it; from flat to normals that
// are opposed.
ScreenTriangle hostile_triangle(Random& random, const Scene& scene) {
  const Image& image = scene.image;
  ScreenTriangle triangle;
  const double size = one_of(random, {0.6, 3.0, 8.0, 25.0, 4000.0});
  const double thin = one_of(random, {1.0, 1.0, 0.1, 0.001});
  const double x = random.uniform(0, image.width), y = random.uniform(0, image.height);
  const Vec3 along = random.unit();
  const double spread = one_of(random, {0.0, 1e-4, 1.0, 5.0, 15.0, 40.0, 90.0, 179.0});
  const Vec3 axis = random.unit_near(Vec3(0, 0, 1), 100);
  const double near = one_of(random, {0.01, 0.5, 3.0});
  for (ScreenVertex& vertex : triangle.vertices) {
    const double s = random.uniform(-size, size), t = thin * random.uniform(-size, size);
    vertex.x = snap(x + s * along.x() - t * along.y());
    vertex.y = snap(y + s * along.y() + t * along.x());
    vertex.z = random.uniform(0, 1);
    vertex.position = near * random.unit() - Vec3(0, 0, 1);
    vertex.normal = hostile_normal(random, axis, spread);
    vertex.eye = scene.shading.viewer == Viewer::local
                     ? Vec3(random.unit_near(Vec3(0, 0, 1), 70) * random.uniform(0.5, 4))
                     : infinite_eye(scene);
  }
  return triangle;
}

Geometry hostile_geometry(Random& random, const Scene& scene, int triangles) {
  Geometry geometry;
  geometry.materials = scene.materials;
  while (static_cast<int>(geometry.triangles.size()) < triangles) {
    ScreenTriangle triangle = hostile_triangle(random, scene);
    if (signed_area(triangle) == 0) continue;
    triangle.material = static_cast<std::uint32_t>(random.below(geometry.materials.size()));
    geometry.triangles.push_back(triangle);
  }
  return geometry;
}

struct Worst {
  double error_lsb = 0;             // of all pixels but the refused triangles'
  double over_certificate_lsb = 0;  // of an error over the triangle's certificate
  double nearest = 0;               // largest share of its certificate that an error reaches
  std::uint64_t pixels = 0, refused = 0;
  Ledger ledger;
};

// Every pixel of the frame's first light, hidden ones included, against exact Phong shading.
void measure(const FrameSetup& frame, Worst& worst) {
  std::map<std::uint32_t, PhongTriangle> exact;
  std::vector<Color> colors;
  SpanStream stream(frame);
  while (stream.next()) {
    const Span& span = stream.span();
    const ScreenTriangle& triangle = frame.geometry->triangles[span.triangle];
    const auto found = exact
                           .try_emplace(span.triangle, *frame.scene,
                                        frame.geometry->materials[triangle.material], triangle)
                           .first;
    colors.resize(static_cast<std::size_t>(span.row.length));
    found->second.shade(span.row.x, span.row.y, span.row.length, colors.data());
    const Certificates::Triangle& certificate = frame.certificates->triangles[span.triangle];
    for (std::size_t i = 0; i < colors.size(); ++i) {
      const double error = std::fabs((stream.colors()[i] & 255U) - colors[i][0]);
      worst.over_certificate_lsb =
          std::max(worst.over_certificate_lsb, error - certificate.error_lsb);
      if (certificate.refused_pixels > 0) continue;
      worst.error_lsb = std::max(worst.error_lsb, error);
      worst.nearest = std::max(worst.nearest, error / certificate.error_lsb);
    }
  }
  worst.pixels += stream.ledger().sum();
  for (std::size_t path = 0; path < kShadingPaths; ++path) {
    worst.ledger.counts[path] += stream.ledger().counts[path];
  }
}

struct Limit {
  double max_error_lsb;
  const char* hardware;
  int frames;
};

class HostileTriangles : public testing::TestWithParam<Limit> {};

TEST_P(HostileTriangles, StayWithinWhatIsProved) {
  const auto& [limit, hardware_name, frames] = GetParam();
  constexpr int kTriangles = 1000;
  const Hardware hardware =
      load_hardware(hardware_name, {fmt::format("max_error={}", limit), "channels=1"});
  Worst worst;
  for (int i = 0; i < frames; ++i) {
    SCOPED_TRACE(fmt::format("seed {}, frame {}", kCertificateSeed, i));
    Random random(kCertificateSeed + static_cast<unsigned>(i));
    const Scene scene = hostile_scene(random, hardware.formats.rom_layout == RomLayout::plain);
    const Geometry geometry = hostile_geometry(random, scene, kTriangles);
    FrameConfiguration configuration{
        {hardware.formats, derive_blocks(hardware.formats, scene, geometry)}, hardware.setup};
    configuration.diffuse = true;
    FrameSetup frame(scene, geometry, configuration);
    frame.certificates = certify(frame);
    measure(frame, worst);
    ASSERT_LE(worst.over_certificate_lsb, 0);
  }
  fmt::print("{} triangles, {} pixels, at most {:.3f} LSB, {:.2f} of what is proved;",
             frames * kTriangles, worst.pixels, worst.error_lsb, worst.nearest);
  for (std::size_t path = 0; path < kShadingPaths; ++path) {
    fmt::print(" {} {}", kShadingPathNames[path], worst.ledger.counts[path]);
  }
  fmt::print("\n");
  EXPECT_LE(worst.error_lsb, limit);
  // Nothing that exact_path can do is refused: but for a few pixels on a terminator.
  EXPECT_LT(static_cast<double>(worst.ledger[ShadingPath::refused]),
            1e-6 * static_cast<double>(worst.pixels));
  // All ways are tried.
  for (const ShadingPath path :
       {ShadingPath::taylor, ShadingPath::six_point, ShadingPath::exact_path}) {
    EXPECT_GT(worst.ledger[path], worst.pixels / 1000) << kShadingPathNames[static_cast<int>(path)];
  }
  EXPECT_GT(worst.nearest, 0.9);
}

INSTANTIATE_TEST_SUITE_P(Limits, HostileTriangles,
                         testing::Values(Limit{1, "default", 100}, Limit{0.502, "default", 5},
                                         Limit{4, "default", 8}, Limit{2, "paper-1k", 8},
                                         Limit{8, "paper-8k", 8}),
                         [](const auto& info) {
                           std::string name =
                               fmt::format("{}_{}", info.param.hardware, info.param.max_error_lsb);
                           for (char& c : name) c = std::isalnum(c) ? c : '_';
                           return name;
                         });

// What the user is told of a limit that cannot be had.
std::string refusal_of(const std::vector<std::string>& settings) {
  try {
    const Hardware hardware = load_hardware("default", settings);
    const PreparedFrame frame(load_named_scene("sphere", {}), hardware.formats, hardware.setup);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(Certificate, BelowOutputRoundingIsRefusedWithTheLeastThatCanBeHad) {
  EXPECT_NE(refusal_of({"max_error=0.4"}).find("the least that can be had is 0.502"),
            std::string::npos);
  EXPECT_NE(refusal_of({"max_error=0.502", "diffuse_fraction_bits=6"}).find("0.509"),
            std::string::npos);
  EXPECT_EQ(refusal_of({"max_error=0.502"}), "");
  EXPECT_NE(refusal_of({"max_error=1", "mantissa_bits=30"}).find("mantissa_bits = 52"),
            std::string::npos);
}

// A normal without direction, and a highlight right on the terminator, have no colour to be near.
TEST(Certificate, WhatHasNoExactColorIsRefused) {
  Scene scene = lit_scene(16, 16);
  scene.materials = {grey_material(0.6, 0.3, 20)};
  Geometry geometry;
  geometry.materials = scene.materials;
  ScreenTriangle triangle;
  const double x[] = {0, 16, 0}, y[] = {0, 0, 16};
  const Vec3 normals[] = {{0, 0, 1}, {0, 0, -1}, {0, 0, 1}};
  for (std::size_t i = 0; i < 3; ++i) {
    ScreenVertex& v = triangle.vertices[i];
    v.x = snap(x[i] + 0.5);
    v.y = snap(y[i] + 0.5);
    v.normal = normals[i];
    v.eye = infinite_eye(scene);
  }
  geometry.triangles = {triangle};
  const Hardware hardware = load_hardware("default", {"max_error=1"});
  const FrameSetup frame(
      scene, geometry,
      {{hardware.formats, derive_blocks(hardware.formats, scene, geometry)}, hardware.setup});
  const Certificates certificates = certify(frame);
  // Normals cancel out along the column in the middle.
  EXPECT_TRUE(certificates.triangles[0].exact);
  EXPECT_EQ(certificates.triangles[0].refused_pixels, 8U);
  EXPECT_EQ(certificates.triangles[0].error_lsb, 255);
}

// Scenes for which an error was once proved that did not hold.
struct Pitfall {
  const char* name;
  const char* light;     // keys of [[light]]
  const char* triangle;  // a row: six numbers of each corner
  const char* material;  // keys of [material.m]
  std::vector<std::string> settings = {};
  const char* more = "";
  const char* image = "width = 64\nheight = 64";
};

std::ostream& operator<<(std::ostream& out, const Pitfall& pitfall) {
  return out << pitfall.name;
}

constexpr const char* kFlat = "0,0,0,0,0,-1,60,0,0,0,0,-1,0,60,0,0,0,-1";
constexpr const char* kAcross = "type = \"directional\"\ndirection = [0, 0, 1]";

class Pitfalls : public testing::TestWithParam<Pitfall> {};

TEST_P(Pitfalls, AreProved) {
  const Pitfall& p = GetParam();
  const std::string text = fmt::format(
      "[image]\n{}\n{}\n[[light]]\n{}\n[[object]]\ntriangle_rows = "
      "\"\"\"\nx0,y0,z0,nx0,ny0,nz0,x1,y1,z1,nx1,ny1,nz1,x2,y2,z2,nx2,ny2,nz2\n{}"
      "\n\"\"\"\nmaterial = "
      "\"m\"\n[material.m]\n{}\n",
      p.image, p.more, p.light, p.triangle, p.material);
  const Scene scene = parse_scene(text, "pitfall.toml");
  for (const char* limit : {"max_error=0.6", "max_error=1", "max_error=4", "max_error=12"}) {
    std::vector<std::string> settings = p.settings;
    settings.emplace_back(limit);
    const Hardware hardware = load_hardware("default", settings);
    const PreparedFrame frame(scene, hardware.formats, hardware.setup);
    const ModelFrame model = run_model(frame.setup);
    const double largest = measure_accuracy(frame.setup, model).total.largest_lsb;
    EXPECT_LE(largest, *certified_error(frame.setup)) << limit;
    // Hardware with every effect gives the same picture.
    const PreparedFrame all(scene, hardware.formats, hardware.setup, Effects::all);
    const ModelFrame everything = run_model(all.setup);
    for (std::size_t i = 0; i < model.framebuffer.size(); ++i) {
      ASSERT_EQ(model.framebuffer.color(i) & 255U, everything.framebuffer.color(i) & 255U) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Pitfalls,
    testing::Values(
        Pitfall{"lamp_over_the_middle_of_a_triangle",
                "type = \"point\"\nposition = [20.5, 20.5, -1]\nattenuation = [0, 0, 1]", kFlat,
                "ambient = 0\ndiffuse = 0\nspecular = 1\nshininess = 20"},
        Pitfall{"light_and_eye_nearly_opposed", "type = \"point\"\nposition = [500, 20, 1e6]",
                "0,0,0,0.9,0,0.436,60,0,0,0.9,0,0.436,0,60,0,0.9,0,0.436",
                "ambient = 0\ndiffuse = 0.5\nspecular = 1\nshininess = 1"},
        Pitfall{"tiny_constant_attenuation",
                "type = \"point\"\nposition = [1752, 20, -1000]\nattenuation = [1e-9, 0, 0]", kFlat,
                "ambient = 0\ndiffuse = 1e-6\nspecular = 0\nshininess = 20"},
        Pitfall{"words_that_saturate",
                kAcross,
                kFlat,
                "ambient = 0\ndiffuse = 0\nspecular = 1\nshininess = 20",
                {"rom_layout=plain", "rom_address_bits=10", "rom_data_bits=4"}},
        Pitfall{"overexposed_highlight_that_fades",
                "type = \"point\"\nposition = [20, 20, -1000]\nattenuation = [0.5, 0, 0]",
                "0,0,1,0,0,-1,60,0,1,0,0,-1,0,60,1,0,0,-1",
                "ambient = 0\ndiffuse = 0.1\nspecular = 1\nshininess = 20",
                {},
                "[depth_cue]\nnear = 0\nfar = 2\ncolor = 0"},
        Pitfall{"one_channel_of_a_colour",
                "type = \"directional\"\ndirection = [0.5, 0, 1]",
                kFlat,
                "ambient = 0\ndiffuse = [0, 0.6, 0]\nspecular = 1\nshininess = 20",
                {"channels=1"}},
        Pitfall{"edge_of_a_cone_on_pixel_centres",
                "type = \"spot\"\nposition = [60.5, 50.5, -20]\ndirection = [0, 0, "
                "1]\nspot_cutoff_degrees = 45",
                "72.7421875,50.34765625,0,0,0,-1,127.8359375,75.390625,0,0,0,-1,129.3515625,"
                "4.41796875,0,0,0,-1",
                "ambient = 0\ndiffuse = 0.9\nspecular = 0\nshininess = 20",
                {},
                "",
                "width = 136\nheight = 96"},
        Pitfall{"terminator_in_the_middle_of_a_long_row",
                "type = \"directional\"\ndirection = [-1, 0, 0]",
                "0.5,0.25,0,-0.45399049973954675,0,-0.8910065241883679,4000.5,0.25,0,"
                "0.45399049973954675,0,-0.8910065241883679,2000.5,3000.25,0,0,0,-1",
                "ambient = 0\ndiffuse = 0.5\nspecular = 1\nshininess = 1",
                {},
                "",
                "width = 4096\nheight = 4"}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace phongpipe
