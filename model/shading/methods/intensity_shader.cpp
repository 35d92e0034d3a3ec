#include "model/shading/methods/intensity_shader.h"

#include <algorithm>

#include "model/shading/methods/exact_phong.h"
#include "model/shading/methods/intensity_shading.h"
#include "model/shading/methods/method_shader.h"
#include "model/shading/phong.h"

namespace phongpipe {
namespace {

Color intensity_at(const ShaderContext& context, const Vec3& normal, const Vec3& eye,
                   const std::vector<Vec3>& to_light) {
  std::vector<Illumination> lights;
  for (std::size_t i = 0; i < to_light.size(); ++i) {
    lights.push_back(
        illuminate(context.scene, context.scene.lights[i], eye.stableNormalized(), to_light[i]));
  }
  return reflect(context.scene, context.material, normal, lights);
}

// The polygon's normal, eye and lights as the middle of the polygon sees them.
Color flat_intensity(const ShaderContext& context) {
  Vec3 eye = Vec3::Zero();
  std::vector<Vec3> to_light(context.scene.lights.size(), Vec3::Zero());
  for (const ScreenVertex& vertex : context.triangle.vertices) {
    eye += vertex.eye / 3;
    for (std::size_t i = 0; i < to_light.size(); ++i) {
      to_light[i] += light_vector(context.scene.lights[i], vertex) / 3;
    }
  }
  return intensity_at(context, shading_input(context).face, eye, to_light);
}

// Sums at the corners are not clamped before they are interpolated.
Color corner_intensity(const ShaderContext& context, const ScreenVertex& vertex) {
  std::vector<Vec3> to_light;
  for (const Light& light : context.scene.lights) to_light.push_back(light_vector(light, vertex));
  return intensity_at(context, vertex.normal, vertex.eye, to_light);
}

// One stepped intensity a channel; Method is Flat or Gouraud.
template <typename Method>
class IntensityShader : public TriangleShader {
 public:
  IntensityShader(const ShaderContext& context, const std::array<Method, 3>& channels)
      : origin_{context.origin_x, context.origin_y}, channels_(channels) {}

  void shade(int x, int y, int length, Color* colors) override {
    for (std::size_t c = 0; c < 3; ++c) {
      channels_[c].start_span(x - origin_.x, y - origin_.y);
      for (int i = 0; i < length; ++i) {
        colors[i][static_cast<Eigen::Index>(c)] =
            255 * std::clamp(channels_[c].next().diffuse, 0.0, 1.0);
      }
    }
  }

  void reflect(int x, int y, int length, Reflection<double>* reflections) override {
    channels_[0].start_span(x - origin_.x, y - origin_.y);
    for (int i = 0; i < length; ++i) reflections[i] = channels_[0].next();
  }

 private:
  OriginPixel origin_;
  std::array<Method, 3> channels_;
};

PhongForm phong_form(const Scene& scene) {
  return {scene.shading.viewer == Viewer::local,
          scene.lights.front().type != LightType::directional,
          scene.shading.highlight == Highlight::reflection};
}

bool is_plain(const PhongForm& form) {
  return !form.local_viewer && !form.light_at_distance && !form.mirror;
}

// Colours as the reference computes them.
class PhongShader : public TriangleShader {
 public:
  explicit PhongShader(const ShaderContext& context)
      : origin_{context.origin_x, context.origin_y},
        plain_(is_plain(phong_form(context.scene))),
        exact_(context.scene, context.material, context.triangle),
        plain_loop_(shading_input(context)),
        varying_loop_(shading_input(context), phong_form(context.scene)) {}

  void shade(int x, int y, int length, Color* colors) override {
    exact_.shade(x, y, length, colors);
  }

  void reflect(int x, int y, int length, Reflection<double>* reflections) override {
    if (plain_) {
      run(plain_loop_, x, y, length, reflections);
    } else {
      run(varying_loop_, x, y, length, reflections);
    }
  }

 private:
  template <typename Loop>
  void run(Loop& loop, int x, int y, int length, Reflection<double>* reflections) {
    loop.start_span(x - origin_.x, y - origin_.y);
    for (int i = 0; i < length; ++i) reflections[i] = loop.next();
  }

  OriginPixel origin_;
  bool plain_;
  PhongTriangle exact_;
  ExactPhong<double, Parts::full> plain_loop_;
  VaryingPhong<double, Parts::full> varying_loop_;
};

}  // namespace

std::unique_ptr<TriangleShader> create_flat(const ShaderContext& context) {
  using Method = Flat<double, Parts::full>;
  const Color color = flat_intensity(context);
  return std::make_unique<IntensityShader<Method>>(
      context, std::array<Method, 3>{Method(color[0]), Method(color[1]), Method(color[2])});
}

std::unique_ptr<TriangleShader> create_gouraud(const ShaderContext& context) {
  using Method = Gouraud<double, Parts::full>;
  const auto& v = context.triangle.vertices;
  const Color c0 = corner_intensity(context, v[0]), c1 = corner_intensity(context, v[1]),
              c2 = corner_intensity(context, v[2]);
  const Interpolator<double> interpolate = interpolator(shading_input(context));
  const auto channel = [&](Eigen::Index c) { return Method(interpolate(c0[c], c1[c], c2[c])); };
  return std::make_unique<IntensityShader<Method>>(
      context, std::array<Method, 3>{channel(0), channel(1), channel(2)});
}

std::unique_ptr<TriangleShader> create_phong(const ShaderContext& context) {
  return std::make_unique<PhongShader>(context);
}

MethodCosts phong_costs(const Scene& scene, Parts parts, PowerKind kind) {
  const PhongForm form = phong_form(scene);
  if (is_plain(form)) return method_costs<ExactPhong, Output::cosines>(parts, kind);
  const Power power(kind, kAnyShininess);
  const auto counted = [&](auto make) { return count(Output::cosines, parts, power, make); };
  using Input = ShadingInput<Recorded>;
  if (parts == Parts::full) {
    return counted([&](const Input& in) { return VaryingPhong<Recorded, Parts::full>(in, form); });
  }
  return counted([&](const Input& in) { return VaryingPhong<Recorded, Parts::diffuse>(in, form); });
}

}  // namespace phongpipe
