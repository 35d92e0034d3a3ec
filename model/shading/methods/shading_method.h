// All shading methods of the sources, by name, behind one interface: the scenes that a method
// cannot render, its shader for a triangle, and the operations it executes.
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

// Shades the pixels of one triangle by one method.
class TriangleShader {
 public:
  virtual ~TriangleShader() = default;

  // Colours of `length` pixels from pixel (x, y) rightwards, in output LSB (0 to 255), not rounded.
  // As in exact Phong shading, there is no highlight where N·L is not positive.
  virtual void shade(int x, int y, int length, Color* colors) = 0;

  // The bare inner loop, as costs() counts it: the method's result for the first light, even where
  // the method is degenerate. Flat and Gouraud shading return intensities.
  virtual void reflect(int x, int y, int length, Reflection<double>* reflections) = 0;

  // Number of spans that shade() shaded by exact Phong, because the method is degenerate there.
  int exact_spans() const { return exact_spans_; }

 protected:
  int exact_spans_ = 0;
};

// Input of a shader; scene, material and triangle must outlive it. The origin is the pixel about
// whose centre polynomials are expanded: a series is most accurate near it.
struct ShaderContext {
  const Scene& scene;
  const Material& material;
  const ScreenTriangle& triangle;
  const Power& power;  // of the material
  int origin_x, origin_y;
};

// The pixel that contains the triangle's centroid.
struct OriginPixel {
  int x, y;
};
OriginPixel centroid_pixel(const ScreenTriangle& triangle);

// Operations executed, for one channel.
struct MethodCosts {
  OperationCounts triangle;  // set up from the corners
  OperationCounts span;      // start a row
  OperationCounts pixel;     // evaluate and step
  OperationCounts combine;   // power and sum, if the pixel gives cosines
};

// The cost of a pixel, as stated by a source.
struct Claim {
  Parts parts;
  bool combined;  // Bishop & Weimer count power and sum, Hast et al. leave them out
  OperationCounts pixel;
  std::string_view where;
};

// Features of scenes that a method supports.
struct Abilities {
  std::vector<LightType> lights = {LightType::directional};
  bool several_lights = false;
  bool attenuation = false;  // by distance
  bool local_viewer = false;
  std::optional<Highlight> highlight = {};  // the only one supported; empty: both
  bool depth_cue = false;
};

struct ShadingMethod {
  std::string_view name, description, source;
  Abilities abilities;
  std::vector<Claim> claims;
  std::unique_ptr<TriangleShader> (*create)(const ShaderContext& context);
  MethodCosts (*costs)(Parts parts, PowerKind power);
  // Whether it shades the pieces of triangles that turn too sharply, see subdivide. Methods of the
  // paper and the literature shade whole triangles.
  bool takes_pieces = false;
};

const std::vector<ShadingMethod>& shading_methods();

// Costs of exact Phong shading for the viewer, first light and highlight of the scene. The costs of
// "phong" itself are for light and eye at infinity and N·H.
MethodCosts phong_costs(const Scene& scene, Parts parts, PowerKind power);

// Null if no method has that name.
const ShadingMethod* find_shading_method(std::string_view name);

// Why the method cannot render the scene; empty if it can. `materials`: those in use.
std::optional<std::string> refusal(const ShadingMethod& method, const Scene& scene,
                                   const std::vector<Material>& materials);

// The triangle as input of a method.
ShadingInput<double> shading_input(const ShaderContext& context);

}  // namespace phongpipe
