// What is computed once a frame, before the first triangle: light and halfway vectors, and for each
// material its scales, ambient level and ROM image.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/fixed/datapath_configuration.h"
#include "model/fixed/exponent_rom.h"
#include "model/scene/geometry.h"
#include "model/shading/triangle_setup.h"

namespace phongpipe {

struct MaterialSetup {
  LightInput<double> light;  // scales: output LSB for diffuse and gate, addresses for specular
  std::array<std::int64_t, 3> level;  // ambient plus the rounding half, in the diffuse format
  std::vector<ExponentRom> roms;      // one a channel
};

struct FrameSetup {
  DatapathConfiguration configuration;
  SeriesPlan plan;
  int width = 0, height = 0;  // of the image
  std::vector<MaterialSetup> materials;
  // Depth z is stored as (z − depth_offset) · depth_scale, from 0 to 2^depth_bits − 1.
  int depth_bits = 24;
  double depth_offset = 0, depth_scale = 0;
  std::array<std::uint8_t, 3> background = {};

  // Throws InputError where the scene asks for what the pipeline does not simulate, or the
  // configuration is out of range. `configuration.channels` and `.gate` must suit the scene, see
  // suit_scene.
  FrameSetup(const Scene& scene, const Geometry& geometry,
             const DatapathConfiguration& configuration, int depth_bits);
};

// Whether every colour of the scene is grey, so that one channel does.
bool is_grey(const Scene& scene, const Geometry& geometry);

// Sets the gate's source by what the materials in use need: a series of its own where a material
// has a highlight and no diffuse colour. A gate that is off stays off.
DatapathConfiguration suit_scene(DatapathConfiguration configuration, const Scene& scene,
                                 const Geometry& geometry);

}  // namespace phongpipe
