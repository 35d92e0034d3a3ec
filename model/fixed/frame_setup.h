// Values computed once per frame, before the first triangle: the effects in use and, for each
// material under each light, its scales, ambient level and highlight table.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/fixed/datapath_configuration.h"
#include "model/fixed/exponent_rom.h"
#include "model/fixed/geometry_memo.h"
#include "model/fixed/span.h"
#include "model/scene/geometry.h"
#include "model/shading/triangle_setup.h"

namespace phongpipe {

// Which effects are simulated. `derived`: those that the scene uses, decided for each triangle.
// `all`: every effect, with coefficients of 0 if the scene does not use it. The pictures are the
// same to the bit.
enum class Effects { derived, all };

// Contents of exponent_rom: one ROM per channel, all read at the same address.
struct HighlightTable {
  Color specular;  // highlight colour, light and largest attenuation included
  double shininess = 0;
  std::vector<ExponentRom> roms;
};

// One material under one light.
struct MaterialSetup {
  SeriesPlan plan;
  LightInput<double> light;  // scales: output LSB for diffuse and gate, addresses for specular
  std::array<std::int64_t, 3> level;  // ambient plus the rounding half, in the diffuse format
  // What is added to T0 of the specular series, with so many fraction bits: the series counts
  // addresses down from the brightest, see exponent_rom.h.
  std::int64_t specular_offset = 0;
  int specular_offset_bits = 0;
  std::uint32_t table = 0;  // index into FrameSetup::tables
  // The first address of the table at which some word is not 0; the number of addresses if all are
  // 0.
  int first_visible_address = 0;

  double offset_in_addresses() const {
    return std::ldexp(static_cast<double>(specular_offset), -specular_offset_bits);
  }
};

// The fits of a triangle's two series under one light.
struct CertifiedFits {
  SeriesFit light = SeriesFit::six_point, highlight = SeriesFit::six_point;
};

// What is proved of the triangles of a frame, and how they are shaded for it; see certificate.h.
struct Certificates {
  struct Triangle {
    bool exact = false;                // by exact_path
    bool bounded = true;               // whether the errors of quadratics were bounded before
    std::uint32_t refused_pixels = 0;  // of them: for which even that proves nothing
    double error_lsb = 0;              // proved for the pixels; full scale if some are refused
  };
  std::vector<Triangle> triangles;  // those of the geometry
  std::vector<CertifiedFits> fits;  // of each triangle under each light, light by light
};

struct FrameSetup {
  FrameConfiguration configuration;
  Effects effects = Effects::derived;
  int width = 0, height = 0;  // of the image
  // Every light is a pass over all triangles: the first writes, the others add.
  std::uint32_t passes = 1;
  std::vector<MaterialSetup> materials;  // those of the geometry for each pass, pass by pass
  std::vector<HighlightTable> tables;    // without duplicates
  bool depth_test = true;                // if some pixel is covered twice, or with Effects::all
  // Depth z is stored as (z − depth_offset) · depth_scale, from 0 to 2^depth_bits − 1.
  double depth_offset = 0, depth_scale = 0;
  OutputColor cue_color = {};
  OutputColor background = {};
  const Scene* scene = nullptr;  // all three must outlive the setup
  const Geometry* geometry = nullptr;
  GeometryMemo* memo = nullptr;              // of the geometry under the scene's lights; or none
  std::optional<Certificates> certificates;  // filled in by PreparedFrame, if the policy asks

  // Throws InputError if the scene uses what the pipeline does not simulate, or the configuration
  // is out of range. The blocks of `configuration` must be those that the scene requires, see
  // derive_blocks.
  FrameSetup(const Scene& scene, const Geometry& geometry, const FrameConfiguration& configuration,
             Effects effects = Effects::derived, GeometryMemo* memo = nullptr);

  // The rows that a triangle covers, see cover(); `rows` is overwritten.
  void cover_triangle(std::uint32_t triangle, std::vector<RowSpan>& rows) const;

  bool takes_exact_path(std::uint32_t triangle) const {
    return certificates && certificates->triangles[triangle].exact;
  }
  const CertifiedFits& fits(std::uint32_t triangle, std::uint32_t pass) const {
    return certificates->fits[pass * certificates->triangles.size() + triangle];
  }

  const MaterialSetup& material(std::uint32_t pass, std::uint32_t material) const {
    return materials[pass * materials_of_a_pass + material];
  }

 private:
  // `largest_attenuation`: the reference for attenuation.
  MaterialSetup set_up_material(std::uint32_t pass, const Material& material,
                                double largest_attenuation);
  std::uint32_t table_of(const Color& specular, double shininess);

  std::uint32_t materials_of_a_pass = 0;
};

// Whether every colour of the scene is grey, so that one channel is enough.
bool is_grey(const Scene& scene, const Geometry& geometry);

// The blocks that the scene's effects require, or all blocks. The gate's source is a separate
// series if a material has a highlight and no diffuse colour, or one too dark to tell the sign of
// N·L (see gate_bound.h); a gate chosen to be off stays off.
EffectBlocks derive_blocks(const FixedPointFormats& formats, const Scene& scene,
                           const Geometry& geometry, Effects effects = Effects::derived);

}  // namespace phongpipe
