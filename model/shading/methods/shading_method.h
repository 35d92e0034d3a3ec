// Every shading method of the sources, by name, behind one interface: what it cannot render, its
// shader for a triangle, and the operations it executes.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/scene/geometry.h"
#include "model/shading/methods/power.h"
#include "model/shading/methods/shading_input.h"

namespace phongpipe {

// One triangle's pixels by one method.
class TriangleShader {
 public:
  virtual ~TriangleShader() = default;

  // Colours of `length` pixels from pixel (x, y) rightwards, in output LSB (0 to 255), not rounded,
  // put together as exact Phong shading does it: no highlight where N·L is not positive.
  virtual void shade(int x, int y, int length, Color* colors) = 0;

  // The bare inner loop, as costs() counts it: what the method makes of the first light, wherever
  // it is degenerate too. From flat and Gouraud shading, intensities.
  virtual void reflect(int x, int y, int length, Reflection<double>* reflections) = 0;

  // Spans that shade() gave to exact Phong shading, the method's own form being degenerate there.
  int exact_spans() const { return exact_spans_; }

 protected:
  int exact_spans_ = 0;
};

// What a shader is made from; scene, material and triangle must outlive it. The origin is the pixel
// whose centre polynomials are taken about: a series is most accurate near it.
struct ShaderContext {
  const Scene& scene;
  const Material& material;
  const ScreenTriangle& triangle;
  const Power& power;  // of the material
  int origin_x, origin_y;
};

// The pixel the triangle's centroid lies in.
struct OriginPixel {
  int x, y;
};
OriginPixel centroid_pixel(const ScreenTriangle& triangle);

// Operations executed, one channel.
struct MethodCosts {
  OperationCounts triangle;  // set up from the corners
  OperationCounts span;      // start a row
  OperationCounts pixel;     // evaluate and step
  OperationCounts combine;   // power and sum, where the pixel gives cosines
};

// What a source says a pixel costs.
struct Claim {
  Parts parts;
  bool combined;  // Bishop & Weimer count power and sum, Hast et al. leave them out
  OperationCounts pixel;
  std::string_view where;
};

// What a scene may ask of a method.
struct Abilities {
  std::vector<LightType> lights = {LightType::directional};
  bool several_lights = false;
  bool attenuation = false;  // by distance
  bool local_viewer = false;
  std::optional<Highlight> highlight = {};  // the only one it has; none: both
  bool depth_cue = false;
};

struct ShadingMethod {
  std::string_view name, description, source;
  Abilities abilities;
  std::vector<Claim> claims;
  std::unique_ptr<TriangleShader> (*create)(const ShaderContext& context);
  MethodCosts (*costs)(Parts parts, PowerKind power);
  // Takes the pieces of triangles that turn too sharply, see subdivide; the others are the paper's
  // and the literature's, and take whole triangles.
  bool takes_pieces = false;
};

const std::vector<ShadingMethod>& shading_methods();

// What exact Phong shading costs where eye or light are at a distance, or the highlight is R·V: the
// costs of "phong" itself are those of light and eye at infinity and N·H.
MethodCosts phong_costs(const Scene& scene, Parts parts, PowerKind power);

// None: no method has that name.
const ShadingMethod* find_shading_method(std::string_view name);

// Why the method cannot render the scene, whose materials in use are given; nothing if it can.
std::optional<std::string> refusal(const ShadingMethod& method, const Scene& scene,
                                   const std::vector<Material>& materials);

// The triangle as shaders receive it.
ShadingInput<double> shading_input(const ShaderContext& context);

}  // namespace phongpipe
