#include "model/fixed/frame_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/fixed/coverage.h"
#include "model/fixed/gate_bound.h"
#include "model/scene/input_error.h"
#include "model/shading/phong.h"

namespace phongpipe {
namespace {

bool is_grey(const Color& color) {
  return color[0] == color[1] && color[1] == color[2];
}

bool is_lit(const Material& material, const Light& light) {
  return (material.diffuse * light.color > 0).any();
}

bool has_highlight(const Material& material, const Light& light) {
  return (material.specular * light.color > 0).any();
}

// A highlight is attenuated by the power's base, which for an exponent of 0 makes no difference.
void require_exponents(const Scene& scene, const Geometry& geometry) {
  for (const Light& light : scene.lights) {
    if (!is_attenuated(light) && !has_spot_factor(light)) continue;
    for (const Material& material : geometry.materials) {
      if (material.shininess > 0 || !has_highlight(material, light)) continue;
      throw InputError(scene.source, 0,
                       fmt::format("material {}: a shininess of 0 under a light that fades is not "
                                   "simulated; set shininess = 1 or more, or specular = 0",
                                   material.name));
    }
  }
}

// What the tables of the octave layouts hold.
void require_shininess(const Scene& scene, const Geometry& geometry,
                       const DatapathConfiguration& configuration) {
  if (configuration.rom_layout == RomLayout::plain) return;
  for (const Material& material : geometry.materials) {
    const double n = material.shininess;
    if (n == 0 || (n >= kLeastShininess && n <= kMostShininess)) continue;
    if ((material.specular == 0).all()) continue;
    const double error_lsb = kOutputMax * ExponentRom::largest_error(configuration, n);
    const std::string why =
        n < kLeastShininess
            ? fmt::format("an octave table errs by {:.2g} LSB there", error_lsb)
            : fmt::format(
                  "such a highlight is too narrow for the specular series, though the "
                  "table would err by {:.2g} LSB only",
                  error_lsb);
    throw InputError(scene.source, 0,
                     fmt::format("material {}: shininess = {:g}: {}; use a shininess of 0 or from "
                                 "{:g} to {:g}{}",
                                 material.name, n, why, kLeastShininess, kMostShininess,
                                 n < kLeastShininess ? ", or rom_layout = plain" : ""));
  }
}

// Whether `holds` for some material under some light.
template <typename Condition>
bool any_pair(const Scene& scene, const Geometry& geometry, Condition holds) {
  return std::any_of(scene.lights.begin(), scene.lights.end(), [&](const Light& light) {
    return std::any_of(geometry.materials.begin(), geometry.materials.end(),
                       [&](const Material& material) { return holds(material, light); });
  });
}

// Integer bits above full scale that hold cosines of highlights from −2 to 1.
int specular_guard_bits(const FixedPointFormats& formats, const Scene& scene,
                        const Geometry& geometry) {
  int bits = least_specular_guard_bits(formats.rom_layout);
  if (formats.rom_layout == RomLayout::plain) return bits;
  const auto too_wide = [&](const Material& material, const Light& light) {
    return has_highlight(material, light) &&
           std::ldexp(highlight_reach(formats, material.shininess), bits) < 3;
  };
  while (bits < kSpecularGuardBits && any_pair(scene, geometry, too_wide)) {
    bits += kSpecularGuardStep;
  }
  return bits;
}

// Whether the diffuse series of some material under some light cannot gate its highlight.
bool needs_gate_series(const FixedPointFormats& formats, const Scene& scene,
                       const Geometry& geometry) {
  return any_pair(scene, geometry, [&](const Material& material, const Light& light) {
    const auto channels = formats.channel_choice == ChannelChoice::one ? 1 : 3;
    return has_highlight(material, light) &&
           (!(material.diffuse * light.color > 0).head(channels).any() ||
            diffuse_loses_sign(formats, scene, geometry, material, light));
  });
}

// Whether two triangles cover the same pixel.
bool overlap(const Scene& scene, const Geometry& geometry) {
  const auto width = static_cast<std::size_t>(scene.image.width);
  std::vector<bool> covered(width * static_cast<std::size_t>(scene.image.height));
  std::vector<RowSpan> rows;
  for (const ScreenTriangle& triangle : geometry.triangles) {
    cover(triangle, scene.image.width, scene.image.height, rows);
    for (const RowSpan& row : rows) {
      const std::size_t first =
          static_cast<std::size_t>(row.y) * width + static_cast<std::size_t>(row.x);
      for (std::size_t i = first; i < first + static_cast<std::size_t>(row.length); ++i) {
        if (covered[i]) return true;
        covered[i] = true;
      }
    }
  }
  return false;
}

OutputColor output_color(const Color& color) {
  OutputColor result;
  for (std::size_t c = 0; c < 3; ++c) {
    result[c] =
        static_cast<std::uint8_t>(std::lround(kOutputMax * color[static_cast<Eigen::Index>(c)]));
  }
  return result;
}

int first_visible_address(const HighlightTable& table) {
  std::size_t first = table.roms.front().words().size();
  for (const ExponentRom& rom : table.roms) {
    const auto& words = rom.words();
    const auto lit = std::find_if(words.begin(), words.end(), [](int word) { return word != 0; });
    first = std::min(first, static_cast<std::size_t>(lit - words.begin()));
  }
  return static_cast<int>(first);
}

// The largest attenuation by distance at a vertex: what series are relative to.
double largest_attenuation(const Light& light, const Geometry& geometry) {
  if (light.type == LightType::directional) return 1;
  double largest = 0;
  for (const ScreenTriangle& triangle : geometry.triangles) {
    for (const ScreenVertex& vertex : triangle.vertices) {
      largest = std::max(largest, distance_attenuation(light, light_vector(light, vertex).norm()));
    }
  }
  // A fading light on a vertex may have any; what is that bright saturates all the same.
  constexpr double kBrightest = 1e6;
  return is_attenuated(light) ? std::min(largest, kBrightest) : largest;
}

LightInput<double> light_input(const Scene& scene, const Light& light, double largest_attenuation,
                               const Material& material,
                               const DatapathConfiguration& configuration) {
  LightInput<double> input;
  ReflectionTerms<double>& terms = input.terms;
  terms.to_light = -light.direction;
  terms.eye = infinite_eye(scene);
  terms.halfway = halfway_vector(terms.eye, terms.to_light);
  for (std::size_t i = 0; i < 3; ++i)
    terms.attenuation[i] = light.attenuation[i] * largest_attenuation;
  terms.spot_axis = -light.direction;
  terms.spot_exponent = light.spot_exponent;
  terms.fold = material.shininess > 0 ? 1 / material.shininess : 0;
  terms.sharpness = std::max(0.0, material.shininess - 1);
  // Where there is no highlight, no shininess makes the series wider than cosines are.
  const double reach =
      has_highlight(material, light) ? highlight_reach(configuration, material.shininess) : 1;
  input.specular_scale = configuration.rom_addresses() / reach;
  input.gate_scale = kOutputMax;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto channel = static_cast<Eigen::Index>(c);
    input.diffuse_scale[c] =
        kOutputMax * material.diffuse[channel] * light.color[channel] * largest_attenuation;
  }
  return input;
}

}  // namespace

bool is_grey(const Scene& scene, const Geometry& geometry) {
  return is_grey(scene.image.background) && is_grey(scene.shading.ambient_light) &&
         (!scene.depth_cue || is_grey(scene.depth_cue->color)) &&
         std::all_of(scene.lights.begin(), scene.lights.end(),
                     [](const Light& light) { return is_grey(light.color); }) &&
         std::all_of(geometry.materials.begin(), geometry.materials.end(), [](const Material& m) {
           return is_grey(m.ambient) && is_grey(m.diffuse) && is_grey(m.specular);
         });
}

EffectBlocks derive_blocks(const FixedPointFormats& formats, const Scene& scene,
                           const Geometry& geometry, Effects effects) {
  const bool all = effects == Effects::all;
  EffectBlocks blocks;
  if (formats.channel_choice == ChannelChoice::automatic) {
    blocks.channels = !all && is_grey(scene, geometry) ? 1 : 3;
  } else {
    blocks.channels = formats.channel_choice == ChannelChoice::one ? 1 : 3;
  }
  blocks.diffuse = all || any_pair(scene, geometry, is_lit);
  blocks.specular = all || any_pair(scene, geometry, has_highlight);
  blocks.depth_cue = all || scene.depth_cue.has_value();
  blocks.specular_guard_bits = specular_guard_bits(formats, scene, geometry);
  if (formats.gate_choice == GateSource::off) {
    blocks.gate = GateSource::off;
  } else if (blocks.specular && needs_gate_series(formats, scene, geometry)) {
    blocks.gate = GateSource::series;
  }
  return blocks;
}

FrameSetup::FrameSetup(const Scene& scene_, const Geometry& geometry_,
                       const FrameConfiguration& configuration_, Effects effects_,
                       GeometryMemo* memo_)
    : configuration(configuration_),
      effects(effects_),
      width(scene_.image.width),
      height(scene_.image.height),
      passes(static_cast<std::uint32_t>(scene_.lights.size())),
      background(output_color(scene_.image.background)),
      scene(&scene_),
      geometry(&geometry_),
      memo(memo_),
      materials_of_a_pass(static_cast<std::uint32_t>(geometry_.materials.size())) {
  configuration.check();
  const auto some_overlap = [&] { return overlap(*scene, *geometry); };
  depth_test =
      effects == Effects::all || (memo != nullptr ? memo->overlap(some_overlap) : some_overlap());
  require_exponents(*scene, *geometry);
  require_shininess(*scene, *geometry, configuration);
  if (scene->depth_cue) cue_color = output_color(scene->depth_cue->color);
  for (std::uint32_t pass = 0; pass < passes; ++pass) {
    const double largest = largest_attenuation(scene->lights[pass], *geometry);
    for (const Material& material : geometry->materials) {
      materials.push_back(set_up_material(pass, material, largest));
    }
  }

  if (geometry->triangles.empty()) return;
  double nearest = geometry->triangles.front().vertices.front().z, farthest = nearest;
  for (const ScreenTriangle& triangle : geometry->triangles) {
    for (const ScreenVertex& vertex : triangle.vertices) {
      nearest = std::min(nearest, vertex.z);
      farthest = std::max(farthest, vertex.z);
    }
  }
  depth_offset = nearest;
  const double steps = static_cast<double>((std::int64_t{1} << configuration.depth_bits) - 1);
  depth_scale = farthest > nearest ? steps / (farthest - nearest) : 0;
}

void FrameSetup::cover_triangle(std::uint32_t triangle, std::vector<RowSpan>& rows) const {
  const auto compute = [&](std::vector<RowSpan>& fresh) {
    cover(geometry->triangles[triangle], width, height, fresh);
  };
  if (memo == nullptr) return compute(rows);
  memo->cover(triangle, rows, compute);
}

MaterialSetup FrameSetup::set_up_material(std::uint32_t pass, const Material& material,
                                          double largest_attenuation) {
  const Light& light = scene->lights[pass];
  const bool all = effects == Effects::all;
  const auto fitted_if = [](bool present) {
    return present ? SeriesForm::fitted : SeriesForm::absent;
  };
  MaterialSetup setup;
  setup.plan.channels = configuration.channels;
  setup.plan.diffuse = fitted_if(configuration.diffuse && (all || is_lit(material, light)));
  const bool specular = configuration.specular && (all || has_highlight(material, light));
  setup.plan.specular = fitted_if(specular);
  setup.plan.gate = fitted_if(specular && configuration.has_gate_series());
  setup.plan.depth = depth_test && pass == 0;
  setup.plan.depth_cue = configuration.depth_cue;
  setup.plan.certify = configuration.certifies();
  ReflectionForm& form = setup.plan.form;
  form.fit = configuration.series_fit;
  form.point_light = light.type != LightType::directional;
  form.local_viewer = specular && scene->shading.viewer == Viewer::local;
  form.highlight = scene->shading.highlight;
  form.attenuated = is_attenuated(light);
  form.spot_factor = has_spot_factor(light);
  setup.light = light_input(*scene, light, largest_attenuation, material, configuration);
  setup.specular_offset_bits =
      setup_fraction_bits(configuration, configuration.specular_fraction_bits);
  setup.specular_offset = std::llround(std::ldexp(
      configuration.rom_addresses() - setup.light.specular_scale, setup.specular_offset_bits));
  for (std::size_t c = 0; c < 3; ++c) {
    const auto channel = static_cast<Eigen::Index>(c);
    const double ambient =
        pass > 0 ? 0
                 : kOutputMax * scene->shading.ambient_light[channel] * material.ambient[channel];
    setup.level[c] = std::llround(std::ldexp(ambient + 0.5, configuration.diffuse_fraction_bits));
  }
  if (specular) {
    setup.table =
        table_of(material.specular * light.color * largest_attenuation, material.shininess);
    setup.first_visible_address = first_visible_address(tables[setup.table]);
  }
  if (setup.plan.certify) {  // its bounds tell, too, whether a series is needed
    setup.plan.bound_light = !all && is_present(setup.plan.light());
    setup.plan.bound_highlight = specular;
    return setup;
  }
  // The cheaper series cost no more than their bounds do.
  const bool pays = form.fit == SeriesFit::weighted || form.fit == SeriesFit::focused;
  if (!pays || form.point_light) return setup;
  setup.plan.bound_light = !all && is_present(setup.plan.light());
  setup.plan.bound_highlight =
      specular && !form.local_viewer && form.highlight == Highlight::halfway;
  return setup;
}

std::uint32_t FrameSetup::table_of(const Color& specular, double shininess) {
  const auto same = [&](const HighlightTable& table) {
    return table.shininess == shininess && (table.specular == specular).all();
  };
  const auto found = std::find_if(tables.begin(), tables.end(), same);
  const auto index = static_cast<std::uint32_t>(found - tables.begin());
  if (found == tables.end()) {
    tables.push_back({specular, shininess, {}});
    for (Eigen::Index c = 0; c < configuration.channels; ++c) {
      tables.back().roms.emplace_back(configuration, specular[c], shininess);
    }
  }
  return index;
}

}  // namespace phongpipe
