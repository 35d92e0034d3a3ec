// Makes a TriangleShader, and the costs, from a method's template.
#pragma once

#include <cmath>
#include <type_traits>
#include <utility>

#include "model/shading/methods/shading_method.h"
#include "model/shading/phong.h"

namespace phongpipe {

// How a pixel's intensity is computed from the method's result.
enum class Output {
  intensity,  // the result is the intensity
  palette,    // the method's table holds intensities in place of cosines
  cosines,    // diffuse + power(highlight)
  spot,       // the same, times a power of the cosine off the axis, from a table
};

// Intensity of one channel. Setup multiplies the polynomials by the colours, so no multiplication
// is left here.
template <typename T>
T combine(Output output, Parts parts, const Reflection<T>& r, const Power& power) {
  T sum = r.diffuse;
  if (output == Output::intensity || output == Output::palette) return sum;
  if (parts == Parts::full) sum += power(r.highlight);
  return output == Output::spot ? sum * power(r.spot) : sum;
}

// Whether a method can degenerate: such a method defines degenerate().
template <typename Method, typename = void>
struct CanDegenerate : std::false_type {};
template <typename Method>
struct CanDegenerate<Method,
                     std::void_t<decltype(std::declval<const Method&>().degenerate(0.0, 0.0, 0))>>
    : std::true_type {};

template <typename Method, Parts kParts>
class MethodShader : public TriangleShader {
 public:
  explicit MethodShader(const ShaderContext& context)
      : context_(context), power_(context.power), method_(shading_input(context)) {
    const Material& material = context.material;
    const Light& light = context.scene.lights.front();
    ambient_ = context.scene.shading.ambient_light * material.ambient;
    // A method renders an attenuated light only if the attenuation is constant.
    const Color color = light.type == LightType::directional
                            ? light.color
                            : Color(light.color / light.attenuation[0]);
    diffuse_ = color * material.diffuse;
    specular_ = color * material.specular;
    if (light.type == LightType::spot) {
      spot_exponent_ = light.spot_exponent;
      spot_least_ = std::cos(light.spot_cutoff_degrees * kDegrees);
    }
  }

  void shade(int x, int y, int length, Color* colors) override {
    if (degenerate(x, y, length)) {
      ++exact_spans_;
      PhongTriangle(context_.scene, context_.material, context_.triangle)
          .shade(x, y, length, colors);
      return;
    }
    start(x, y);
    for (int i = 0; i < length; ++i) {
      const Reflection<double> r = method_.next();
      Color sum = ambient_;
      if (r.diffuse > 0 && r.spot >= spot_least_) {
        Color lit = diffuse_ * r.diffuse;
        if constexpr (kParts == Parts::full) {
          lit += specular_ * power_(r.highlight > 1 ? 1 : r.highlight);
        }
        if (spot_exponent_ > 0) lit *= std::pow(r.spot, spot_exponent_);
        sum += lit;
      }
      colors[i] = sum.max(0).min(1) * 255;
    }
  }

  void reflect(int x, int y, int length, Reflection<double>* reflections) override {
    start(x, y);
    for (int i = 0; i < length; ++i) reflections[i] = method_.next();
  }

 private:
  static constexpr double kDegrees = 3.14159265358979323846 / 180;

  void start(int x, int y) { method_.start_span(x - context_.origin_x, y - context_.origin_y); }

  bool degenerate(int x, int y, int length) const {
    if constexpr (CanDegenerate<Method>::value) {
      return method_.degenerate(x - context_.origin_x, y - context_.origin_y, length);
    }
    return false;
  }

  ShaderContext context_;
  Power power_;
  Method method_;
  Color ambient_, diffuse_, specular_;
  double spot_exponent_ = 0, spot_least_ = -2;
};

template <template <typename, Parts> class Method>
std::unique_ptr<TriangleShader> create_shader(const ShaderContext& context) {
  if ((context.material.specular == 0).all()) {
    return std::make_unique<MethodShader<Method<double, Parts::diffuse>, Parts::diffuse>>(context);
  }
  return std::make_unique<MethodShader<Method<double, Parts::full>, Parts::full>>(context);
}

// Counts the operations of a method; `make` makes it from a ShadingInput<Recorded>.
template <typename Make>
MethodCosts count(Output output, Parts parts, const Power& power, Make make) {
  ShadingInput<Recorded> input;
  input.power = &power;
  Recording recording;
  OperationCounts before;
  const auto since = [&] {
    const OperationCounts now = recording.dataflow().counts();
    return now - std::exchange(before, now);
  };
  MethodCosts costs;
  auto method = make(input);
  costs.triangle = since();
  method.start_span(Recorded(), Recorded());
  costs.span = since();
  const Reflection<Recorded> reflection = method.next();
  costs.pixel = since();
  combine(output, parts, reflection, power);
  costs.combine = since();
  return costs;
}

constexpr double kAnyShininess = 20;  // counts do not depend on it

template <template <typename, Parts> class Method, Output kOutput>
MethodCosts method_costs(Parts parts, PowerKind kind) {
  const Power power(kind, kAnyShininess);
  const auto counted = [&](auto make) { return count(kOutput, parts, power, make); };
  using Input = ShadingInput<Recorded>;
  if (parts == Parts::full) {
    return counted([](const Input& in) { return Method<Recorded, Parts::full>(in); });
  }
  return counted([](const Input& in) { return Method<Recorded, Parts::diffuse>(in); });
}

}  // namespace phongpipe
