// Capsules: scenes survive being written, to the bit, and what was changed by hand is refused.
#include "testbench/trace/capsule.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "model/files/scene_file.h"
#include "model/files/scene_writer.h"
#include "model/files/text_file.h"
#include "model/fixed/prepared_frame.h"
#include "model/scene/input_error.h"
#include "testbench/cases/named_scene.h"
#include "testbench/system/output_file.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

void expect_same(const Vec3& a, const Vec3& b) {
  ASSERT_TRUE(a == b) << a.transpose() << " and " << b.transpose();
}

void expect_same_geometry(const Scene& scene, const Scene& back) {
  const Geometry a = make_geometry(scene), b = make_geometry(back);
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t i = 0; i < a.triangles.size(); ++i) {
    ASSERT_EQ(a.triangles[i].material, b.triangles[i].material);
    for (std::size_t v = 0; v < 3; ++v) {
      const ScreenVertex &p = a.triangles[i].vertices[v], &q = b.triangles[i].vertices[v];
      ASSERT_EQ(p.x, q.x);
      ASSERT_EQ(p.y, q.y);
      ASSERT_EQ(p.z, q.z);
      expect_same(p.normal, q.normal);
      expect_same(p.eye, q.eye);
      expect_same(p.position, q.position);
    }
  }
  ASSERT_EQ(scene.lights.size(), back.lights.size());
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Light &light = scene.lights[i], &other = back.lights[i];
    ASSERT_EQ(light.type, other.type);
    if (light.type != LightType::point) expect_same(light.direction, other.direction);
    if (light.type != LightType::directional) expect_same(light.position, other.position);
    EXPECT_EQ(light.attenuation, other.attenuation);
    EXPECT_EQ(light.spot_exponent, other.spot_exponent);
    EXPECT_TRUE((scene.lights[i].color == back.lights[i].color).all());
  }
}

TEST(SceneToml, EveryShippedSceneComesBackToTheBit) {
  const fs::path root = PHONGPIPE_SCENES;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".toml") continue;
    SCOPED_TRACE(entry.path().string());
    const Scene scene = load_scene(entry.path());
    const std::string text = scene_toml(scene);
    expect_same_geometry(scene, parse_scene(text, "written.toml"));
    EXPECT_EQ(text.find(PHONGPIPE_SCENES), std::string::npos) << "it needs no other file";
  }
}

TEST(SceneToml, RandomScenesComeBackToTheBit) {
  for (int seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    const Scene scene = load_named_scene(fmt::format("random:{}", seed), {});
    expect_same_geometry(scene, parse_scene(scene_toml(scene), "written.toml"));
  }
}

TEST(SceneToml, BadMeshesInTheTextAreRefused) {
  const std::string rest =
      "[image]\nwidth = 8\nheight = 8\n[camera]\neye = [0,0,5]\ntarget = [0,0,0]\n"
      "vertical_fov_degrees = 40\n[[light]]\ntype = \"directional\"\ndirection = [0,0,-1]\n"
      "[[object]]\n";
  for (const char* mesh :
       {"vertices = [[0,0,0,0,0]]\nfaces = [[0,0,0,0]]\n",
        "vertices = [[0,0,0,0,0,0]]\nfaces = [[0,0,0,0]]\n",
        "vertices = [[0,0,0,0,0,1]]\nfaces = [[0,0,1,0]]\n",
        "vertices = [[0,0,0,0,0,1]]\nfaces = [[0,0,0,1]]\n",
        "vertices = [[0,0,0,0,0,1]]\nfaces = 7\n", "vertices = [[0,0,0,0,0,nan]]\nfaces = []\n",
        "vertices = [[0,0,0,0,0,1]]\n", "triangle_rows = \"x\"\n"}) {
    EXPECT_THROW(parse_scene(rest + mesh, "bad.toml"), InputError) << mesh;
  }
}

class Capsules : public testing::Test {
 protected:
  Capsules() : file_(fs::path(testing::TempDir()) / fmt::format("capsule-{}.toml", getpid())) {
    result_.hardware = load_hardware("paper-8k", {"rom_address_bits=11"});
    result_.options.stall_percent = 20;
    result_.options.seed = 9;
    result_.rtl.emplace();
    result_.rtl->signal_divergence =
        SignalDivergence{"pixel_datapath.color.specular.rom", "address", 10, 81'204, 0x1f3, 0x1f2};
    result_.rtl->first_divergence = Divergence{9, 77, 6, 81'206, {8, 9, 10}, {8, 9, 11}, false};
    write_text(file_, capsule_text(load_named_scene("sphere", {}), result_));
  }
  ~Capsules() override { fs::remove(file_); }

  fs::path file_;
  VerificationResult result_;
};

TEST_F(Capsules, KeepEverything) {
  const Capsule capsule = read_capsule(file_, false);
  EXPECT_EQ(capsule.name, "sphere");
  EXPECT_EQ(capsule.found,
            "pixel_datapath.color.specular.rom.address: model 0x1f3, rtl 0x1f2 in cycle 81204");
  EXPECT_EQ(configuration_hash(capsule.hardware), configuration_hash(result_.hardware));
  EXPECT_EQ(capsule.hardware.name, result_.hardware.name);
  EXPECT_EQ(capsule.options.stall_percent, 20);
  EXPECT_EQ(capsule.options.seed, 9U);
  EXPECT_TRUE(capsule.same_program);
  EXPECT_NE(read_whole_file(file_).find("span = 77"), std::string::npos);
  expect_same_geometry(load_named_scene("sphere", {}), capsule.scene);
}

// As a capsule that another build of the program wrote, before it had all of today's options.
TEST_F(Capsules, KeepRowsOfTrianglesWhichAreAStringOfSeveralLines) {
  const Scene scene = load_named_scene("screen-triangles", {});
  write_text(file_, capsule_text(scene, result_));
  expect_same_geometry(scene, read_capsule(file_, false).scene);
}

TEST_F(Capsules, OfOtherProgramsAreReadAnyway) {
  std::string text = read_whole_file(file_);
  for (const char* key : {"program_hash", "max-error"}) {
    const std::size_t at = text.find(key), end = text.find('\n', at);
    ASSERT_NE(end, std::string::npos) << key;
    text.erase(at, end + 1 - at);
  }
  write_text(file_, text);
  EXPECT_THROW(read_capsule(file_, false), InputError);
  const Capsule capsule = read_capsule(file_, true);
  EXPECT_FALSE(capsule.same_program);
  EXPECT_FALSE(capsule.options.max_error_lsb.has_value());
}

TEST_F(Capsules, ChangedByHandAreRefused) {
  std::string text = read_whole_file(file_);
  const std::size_t at = text.find("shininess");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 9, "shininesS");
  write_text(file_, text);
  EXPECT_THROW(read_capsule(file_, false), InputError);
  EXPECT_THROW(read_capsule(file_, true), InputError) << "such a scene there is not";
  text = read_whole_file(file_);
  text.replace(text.find("shininesS"), 9, "shininess");
  const std::string seed = "seed = \"9\"";
  ASSERT_NE(text.find(seed), std::string::npos) << text;
  text.replace(text.find(seed), seed.size(), "seed = \"8\"");
  write_text(file_, text);
  EXPECT_THROW(read_capsule(file_, false), InputError);
  EXPECT_EQ(read_capsule(file_, true).options.seed, 8U);
}

TEST_F(Capsules, OtherFilesAreRefused) {
  write_text(file_, "[image]\nwidth = 3\n");
  EXPECT_THROW(read_capsule(file_, true), InputError);
  EXPECT_THROW(read_capsule("absent.toml", true), InputError);
}

}  // namespace
}  // namespace phongpipe
