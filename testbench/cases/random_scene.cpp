#include "testbench/cases/random_scene.h"

#include <memory>
#include <vector>

#include "model/scene/geometry.h"
#include "model/scene/primitives.h"
#include "testbench/system/random.h"

namespace phongpipe {
namespace {

class SceneDice {
 public:
  explicit SceneDice(std::uint64_t seed) : random_(seed) {}

  Scene roll() {
    grey_ = one_in(3);
    Scene scene;
    scene.image = {random_.integer(16, 96), random_.integer(16, 96), color()};
    scene.shading.ambient_light = color();
    scene.shading.highlight = one_in(3) ? Highlight::reflection : Highlight::halfway;
    add_materials(scene);
    const bool screen = one_in(2);
    if (screen) {
      add_screen_triangles(scene);
    } else {
      add_meshes(scene);
    }
    const int lights = random_.integer(1, 4);
    for (int i = 0; i < lights; ++i) scene.lights.push_back(light(screen));
    if (one_in(3)) {
      // In world units from the eye, or in the depth of screen triangles.
      const double near = screen ? random_.uniform(0, 0.5) : random_.uniform(2, 4);
      scene.depth_cue = DepthCue{near, near + random_.uniform(0.3, screen ? 1 : 6), color()};
    }
    return scene;
  }

 private:
  bool one_in(int count) { return random_.integer(1, count) == 1; }
  // Multiples of 1/16, so that some colours of a scene are equal now and then.
  double level() { return random_.integer(0, 16) / 16.0; }
  Color color() {
    const double grey = level();
    return grey_ ? Color::Constant(grey) : Color{grey, level(), level()};
  }

  void add_materials(Scene& scene) {
    const int count = random_.integer(1, 3);
    const bool diffuse = !one_in(5), specular = !one_in(4);
    for (int i = 0; i < count; ++i) {
      Material material;
      material.name = "material" + std::to_string(i);
      material.ambient = 0.25 * color();
      material.diffuse = diffuse && !one_in(5) ? color() : Color::Zero();
      material.specular = specular && !one_in(5) ? color() : Color::Zero();
      material.shininess = random_.integer(1, 200);
      scene.materials.push_back(material);
    }
  }

  std::string any_material(const Scene& scene) {
    const int last = static_cast<int>(scene.materials.size()) - 1;
    return scene.materials[static_cast<std::size_t>(random_.integer(0, last))].name;
  }

  void add_meshes(Scene& scene) {
    Camera& camera = scene.camera;
    camera.projection = one_in(2) ? Projection::orthographic : Projection::perspective;
    scene.shading.viewer = one_in(2) ? Viewer::local : Viewer::infinite;
    camera.eye = random_.unit_near(Vec3(0, 0.5, 1).normalized(), 60) * random_.uniform(3, 6);
    camera.vertical_extent = random_.uniform(2, 4);
    const int count = random_.integer(1, 3);
    for (int i = 0; i < count; ++i) {
      const auto& all = primitives();
      const Primitive& shape =
          all[static_cast<std::size_t>(random_.integer(0, static_cast<int>(all.size()) - 1))];
      Object object;
      object.primitive = shape.name;
      for (std::size_t k = 0; k < 2; ++k) {
        object.segments[k] = shape.min_segments[k] + random_.integer(0, 8);
      }
      object.scale = random_.uniform(0.3, 1.2);
      object.translate = random_.unit() * random_.uniform(0, 1);
      object.rotate_degrees =
          Vec3(random_.uniform(0, 360), random_.uniform(0, 360), random_.uniform(0, 360));
      object.material = any_material(scene);
      scene.objects.push_back(object);
    }
  }

  // Normals turn by up to `turn` degrees from an axis that may face away.
  ScreenTriangle triangle(const Image& image) {
    ScreenTriangle result;
    const double size = one_in(4) ? random_.uniform(0.5, 3) : random_.uniform(3, 60);
    const double flatness = one_in(5) ? 0.02 : 1;  // a sliver
    const double turn = one_in(4) ? random_.uniform(30, 85) : random_.uniform(0, 30);
    const double x = random_.uniform(0, image.width), y = random_.uniform(0, image.height);
    const double slope = random_.uniform(-1, 1);
    const Vec3 axis = random_.unit_near(Vec3(0, 0, -1), 80);
    do {
      for (ScreenVertex& vertex : result.vertices) {
        const double along = random_.uniform(-size, size);
        vertex.x = snap(x + along);
        vertex.y = snap(y + slope * along + flatness * random_.uniform(-size, size));
        vertex.z = random_.uniform(0, 1);
        vertex.normal = random_.unit_near(axis, turn);
        vertex.eye = Vec3(0, 0, -1);
        vertex.position = Vec3(in_pixels(vertex.x), in_pixels(vertex.y), vertex.z);
      }
    } while (signed_area(result) == 0);
    return result;
  }

  void add_screen_triangles(Scene& scene) {
    const int count = random_.integer(1, 3);
    for (int i = 0; i < count; ++i) {
      auto triangles = std::make_shared<std::vector<ScreenTriangle>>();
      const int size = random_.integer(1, 12);
      for (int k = 0; k < size; ++k) triangles->push_back(triangle(scene.image));
      Object object;
      object.screen_triangles = std::move(triangles);
      object.material = any_material(scene);
      scene.objects.push_back(std::move(object));
    }
  }

  // Towards the surfaces, as a rule.
  Light light(bool screen) {
    Light result;
    const Vec3 to_scene = screen ? Vec3(0, 0, 1) : Vec3(0, -0.4, -1).normalized();
    result.direction = random_.unit_near(to_scene, 80);
    result.color = color();
    if (one_in(2)) return result;
    result.type = one_in(2) ? LightType::point : LightType::spot;
    const double distance = screen ? random_.uniform(20, 200) : random_.uniform(1.5, 6);
    result.position = -result.direction * distance;
    if (screen) result.position += Vec3(40, 40, 0);
    if (one_in(2)) {
      const double scale = 1 / distance;
      result.attenuation = {0.5, random_.uniform(0, 0.5) * scale,
                            random_.uniform(0, 0.5) * scale * scale};
    }
    if (result.type == LightType::spot) {
      result.spot_exponent = one_in(2) ? 0 : random_.integer(1, 40);
      result.spot_cutoff_degrees = random_.uniform(10, 90);
    }
    return result;
  }

  Random random_;
  bool grey_ = false;
};

}  // namespace

Scene random_scene(std::uint64_t seed) {
  return SceneDice(seed).roll();
}

}  // namespace phongpipe
