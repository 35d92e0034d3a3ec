#include "model/scene/scene.h"

namespace phongpipe {

std::string_view name(LightType type) {
  constexpr std::string_view kNames[] = {"directional", "point", "spot"};
  return kNames[static_cast<std::size_t>(type)];
}

bool is_attenuated(const Light& light) {
  return light.type != LightType::directional &&
         (light.attenuation[1] != 0 || light.attenuation[2] != 0);
}

bool has_spot_factor(const Light& light) {
  return light.type == LightType::spot && light.spot_exponent != 0;
}

double distance_attenuation(const Light& light, double distance) {
  if (light.type == LightType::directional) return 1;
  const auto& [constant, linear, quadratic] = light.attenuation;
  return 1 / (constant + distance * (linear + distance * quadratic));
}

bool is_shiny(const Material& material) {
  return (material.specular > 0).any();
}

bool is_screen_space(const Scene& scene) {
  return scene.objects.front().screen_triangles != nullptr;
}

}  // namespace phongpipe
