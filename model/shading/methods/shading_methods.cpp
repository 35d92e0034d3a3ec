// The methods by name, with what their sources claim.

#include <algorithm>
#include <iterator>

#include "model/shading/methods/angle_interpolation.h"
#include "model/shading/methods/duff.h"
#include "model/shading/methods/exact_phong.h"
#include "model/shading/methods/fitted_shading.h"
#include "model/shading/methods/intensity_shader.h"
#include "model/shading/methods/intensity_shading.h"
#include "model/shading/methods/method_shader.h"
#include "model/shading/methods/mirror_highlights.h"
#include "model/shading/methods/reflected_vectors.h"
#include "model/shading/methods/reflection_shading.h"
#include "model/shading/methods/taylor_shading.h"

namespace phongpipe {
namespace {

constexpr const char* kBishop = "Bishop & Weimer 1986";
constexpr const char* kHast = "Hast, Barrera & Bengtsson 2001";
constexpr const char* kOtm = "Mortensen 1995 (OTMPHONG.DOC)";

// A source's row: additions (subtractions among them), multiplications, divisions, roots, reads.
constexpr OperationCounts row(std::size_t add, std::size_t multiply, std::size_t divide,
                              std::size_t sqrt, std::size_t read = 0) {
  return {add, multiply, 0, divide, sqrt, read};
}

Claim diffuse(const OperationCounts& counts, const char* where) {
  return {Parts::diffuse, false, counts, where};
}
Claim full(const OperationCounts& counts, const char* where) {
  return {Parts::full, false, counts, where};
}

Abilities everything() {
  return {{LightType::directional, LightType::point, LightType::spot}, true, true, true, {}};
}
Abilities halfway() {
  return {{LightType::directional}, false, false, false, Highlight::halfway};
}
Abilities mirror() {
  return {{LightType::directional}, false, false, false, Highlight::reflection};
}
Abilities taylor_local() {
  return {{LightType::directional}, false, false, true, Highlight::halfway};
}
Abilities point_light() {
  return {{LightType::directional, LightType::point}, false, false, false, Highlight::reflection};
}
Abilities spotlight() {
  return {{LightType::spot}, false, false, false, Highlight::reflection};
}
Abilities viewpoint() {
  return {{LightType::directional}, false, false, true, Highlight::reflection};
}

template <template <typename, Parts> class Method, Output kOutput = Output::cosines>
ShadingMethod method(const char* name, const char* description, const char* source,
                     Abilities abilities, std::vector<Claim> claims = {}) {
  return {name,
          description,
          source,
          std::move(abilities),
          std::move(claims),
          create_shader<Method>,
          method_costs<Method, kOutput>};
}

// Flat, Gouraud and Phong shading render everything by shaders of their own.
ShadingMethod general(ShadingMethod method,
                      std::unique_ptr<TriangleShader> (*create)(const ShaderContext&)) {
  method.abilities = everything();
  method.abilities.depth_cue = method.name == "phong";
  method.create = create;
  return method;
}

std::vector<ShadingMethod> classic_methods() {
  return {
      general(method<Flat, Output::intensity>("flat", "one intensity a polygon, of its own normal",
                                              kBishop, {}),
              create_flat),
      general(method<Gouraud, Output::intensity>(
                  "gouraud", "intensities of the corners, interpolated", "Gouraud 1971", {},
                  {diffuse(row(1, 0, 0, 0), "Bishop & Weimer, Gouraud Shading"),
                   full(row(1, 0, 0, 0), "Bishop & Weimer, Gouraud Shading")}),
              create_gouraud),
      general(method<ExactPhong>(
                  "phong", "normals interpolated and normalised at each pixel: the reference",
                  "Phong 1973", {}, {diffuse(row(7, 6, 1, 1), "Bishop & Weimer, Phong Shading")}),
              create_phong),
      method<Duff>("duff", "N·L and N·N stepped, a quotient for each cosine; exact", "Duff 1979",
                   halfway(),
                   {diffuse(row(3, 0, 1, 1), "Bishop & Weimer; Hast et al., section 1.2")}),
      method<DuffTable>("duff-table", "Duff's method with 1/√ from a table of 1,024 words",
                        "Duff 1979", halfway()),
      method<Taylor>("taylor", "second-degree series, eye at infinity", kBishop, halfway(),
                     {diffuse(row(2, 0, 0, 0), "Bishop & Weimer, abstract"),
                      {Parts::full, true, row(5, 0, 0, 0, 1), "Bishop & Weimer, abstract"}}),
      method<TaylorLocal>("taylor-local", "second-degree series, eye at a finite distance", kBishop,
                          taylor_local(),
                          {diffuse(row(2, 0, 0, 0), "Bishop & Weimer, Going Further"),
                           {Parts::full, true, row(5, 0, 0, 0, 1), "Bishop & Weimer"}}),
      method<AngleInterpolation, Output::palette>(
          "otm", "angle to the light interpolated in bytes; highlight by the same angle", kOtm,
          halfway(),
          {diffuse(row(1, 0, 0, 0, 1), "as Gouraud's fill, with a table"),
           {Parts::full, true, row(1, 0, 0, 0, 1), "as Gouraud's fill, with a palette"}}),
      method<TwoAngleInterpolation>(
          "otm-halfway", "as otm, with the angle to H interpolated too (not in the source)", kOtm,
          halfway()),
  };
}

// A fit for an eye at infinity, and the same for one at a finite distance.
template <SeriesFit kFit>
std::vector<ShadingMethod> fitted_methods(const char* name, const char* local_name,
                                          const char* description) {
  const char* const source = "this project, model/shading/quadratics";
  return {
      method<Fitted<kFit, false>::template Series>(name, description, source, halfway()),
      method<Fitted<kFit, true>::template Series>(local_name, description, source, taylor_local())};
}

std::vector<ShadingMethod> quadratic_methods() {
  std::vector<ShadingMethod> all;
  const auto add = [&all](std::vector<ShadingMethod> methods) {
    for (ShadingMethod& method : methods) method.takes_pieces = true;
    std::move(methods.begin(), methods.end(), std::back_inserter(all));
  };
  add(fitted_methods<SeriesFit::six_point>("six-point", "six-point-local",
                                           "quadratics through corners and middles of edges"));
  add(fitted_methods<SeriesFit::weighted>(
      "weighted", "weighted-local", "quadratics near ten points, by the power's sensitivity"));
  add(fitted_methods<SeriesFit::focused>("focused", "focused-local",
                                         "the same, with the points closing in on the highlight"));
  return all;
}

std::vector<ShadingMethod> hast_methods() {
  return {
      method<Hybrid>("hybrid", "Gouraud's diffuse component, R·V by eq. 17", kHast, mirror(),
                     {full(row(5, 0, 1, 0), "section 3")}),
      method<ReflectionQuotient>("reflection", "reflection shading, a quotient for each cosine",
                                 kHast, halfway(), {diffuse(row(4, 0, 1, 0), "section 4")}),
      method<DuffBlinn>("duff-blinn", "Duff's method, N·L and N·H times one 1/√", kHast, halfway(),
                        {full(row(4, 2, 1, 1), "section 4.2")}),
      method<DuffEq17>("duff-eq17", "Duff's diffuse component, R·V by eq. 17", kHast, mirror(),
                       {full(row(5, 0, 2, 1), "section 4.2")}),
      method<DuffEq33>("duff-eq33", "Duff's diffuse component, R·V by eq. 33", kHast, mirror(),
                       {full(row(4 + 1, 1, 2, 1), "section 4.2")}),
      method<DuffEq34>("duff-eq34", "Duff's diffuse component, R·V by eq. 34", kHast, mirror(),
                       {full(row(4 + 1, 3, 1, 1), "section 4.2")}),
      method<ReflectionBlinn>("reflection-blinn", "reflection shading, N·L and N·H times one 1/x",
                              kHast, halfway(), {full(row(6, 2, 1, 0), "section 4.3")}),
      method<ReflectionHybrid>("reflection-hybrid", "reflection shading, R·V by eq. 17", kHast,
                               mirror(), {full(row(8, 0, 2, 0), "section 4.3")}),
      method<ReflectionEq34>("reflection-eq34", "reflection shading, R·V by eq. 34", kHast,
                             mirror(), {full(row(6 + 1, 3, 1, 0), "section 4.3")}),
      method<PointReflection>("point-reflection", "reflection shading with a point light", kHast,
                              point_light()),
      method<SpotReflection, Output::spot>("spot-reflection", "reflection shading with a spotlight",
                                           kHast, spotlight()),
      method<ViewpointReflection>("viewpoint-reflection",
                                  "reflection shading with a fixed viewpoint", kHast, viewpoint()),
  };
}

}  // namespace

const std::vector<ShadingMethod>& shading_methods() {
  static const std::vector<ShadingMethod> methods = [] {
    std::vector<ShadingMethod> all = classic_methods();
    for (auto methods : {quadratic_methods(), hast_methods()}) {
      std::move(methods.begin(), methods.end(), std::back_inserter(all));
    }
    return all;
  }();
  return methods;
}

}  // namespace phongpipe
