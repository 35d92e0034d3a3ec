#include "testbench/cases/guards.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "model/fixed/color_sum.h"
#include "model/fixed/depth_cue.h"
#include "model/shading/phong.h"

namespace phongpipe {
namespace {

using Count = std::uint64_t;

// Parts of pixel_datapath that can be taken out.
enum class Part {
  top_of_table,     // the address saturates at the brightest word
  bottom_of_table,  // and at the faintest
  gate,
  diffuse_clamp,
  saturation,  // of the sum
  cue_clamp
};

// The registers of a span, stepped from pixel to pixel.
class SteppedSpan {
 public:
  SteppedSpan(const FrameConfiguration& f, const Span& span)
      : f_(f),
        span_(span),
        diffuse_{ForwardDifferencer(f.diffuse_width()), ForwardDifferencer(f.diffuse_width()),
                 ForwardDifferencer(f.diffuse_width())},
        gate_(f.diffuse_width()),
        specular_(f.specular_width()),
        cue_(kCueWidth) {
    for (std::size_t c = 0; c < 3; ++c) diffuse_[c].load(span.diffuse[c]);
    gate_.load(span.gate);
    specular_.load(span.specular);
    cue_.load(span.cue);
  }
  void step() {
    for (ForwardDifferencer& series : diffuse_) series.step();
    gate_.step();
    specular_.step();
    cue_.step();
  }

  // The pixel's colour in a datapath without one of its parts.
  std::uint32_t color_without(Part part, const HighlightTable* table,
                              const OutputColor& cue) const {
    const auto channels = static_cast<std::size_t>(f_.channels);
    const bool highlight = span_.highlight && table != nullptr && (part == Part::gate || open());
    std::uint32_t color = 0;
    for (std::size_t c = 0; c < channels; ++c) {
      const int shift = f_.diffuse_fraction_bits - f_.sum_fraction_bits();
      const std::int32_t diffuse = part == Part::diffuse_clamp
                                       ? static_cast<std::int32_t>(diffuse_[c].v() >> shift)
                                       : clamped_diffuse(f_, diffuse_[c].v(), span_.level[c]);
      const std::int32_t word =
          highlight ? table->roms[c].words()[static_cast<std::size_t>(address(part))] : 0;
      std::int32_t sum = light_sum(f_, diffuse, aligned_word(f_, word));
      if (f_.depth_cue) {
        const std::int64_t share = cue_.v() >> (kCueFraction - kCueFactorBits);
        sum = faded(
            sum, cue[c],
            part == Part::cue_clamp ? static_cast<std::int32_t>(share) : cue_factor(cue_.v()));
      }
      const std::int32_t shown =
          part == Part::saturation ? sum & kOutputMax : std::clamp(sum, 0, kOutputMax);
      color |= static_cast<std::uint32_t>(shown & kOutputMax) << (c * kOutputBits);
    }
    return color;
  }

  // Whether the gate is open, by its own series or by any channel of the diffuse one.
  bool open() const {
    switch (f_.gate) {
      case GateSource::off:
        return true;
      case GateSource::series:
        return gate_.v() > 0;
      case GateSource::diffuse:
        break;
    }
    return lit();
  }
  bool lit() const {
    for (std::size_t c = 0; c < static_cast<std::size_t>(f_.channels); ++c) {
      if (is_lit(diffuse_[c].v(), span_.level[c])) return true;
    }
    return false;
  }

 private:
  int address(Part part) const {
    const std::int64_t whole = specular_.v() >> f_.specular_fraction_bits;
    const std::int64_t last = f_.rom_addresses() - 1;
    const bool wraps = (part == Part::top_of_table && whole > last) ||
                       (part == Part::bottom_of_table && whole < 0);
    return wraps ? static_cast<int>(whole & last) : ExponentRom::address(f_, specular_.v());
  }

  const FrameConfiguration& f_;
  const Span& span_;
  std::array<ForwardDifferencer, 3> diffuse_;
  ForwardDifferencer gate_, specular_, cue_;
};

// Calls `visit(span, stepped, table, color, i)` for pixel i of every span of the stream.
template <typename Visit>
void for_each_pixel(const FrameSetup& frame, const Visit& visit) {
  SpanStream stream(frame);
  while (stream.next()) {
    const Span& span = stream.span();
    const HighlightTable* const table = span.highlight ? &frame.tables[span.table] : nullptr;
    SteppedSpan stepped(frame.configuration, span);
    for (int i = 0; i < span.row.length; ++i, stepped.step()) {
      visit(span, stepped, table, stream.colors()[i], i);
    }
  }
}

template <Part part>
Count pixels_without(const GuardedFrame& guarded) {
  const FrameSetup& frame = guarded.prepared.setup;
  Count different = 0;
  for_each_pixel(frame, [&](const Span&, const SteppedSpan& stepped, const HighlightTable* table,
                            std::uint32_t color, int) {
    different += stepped.color_without(part, table, frame.cue_color) != color ? 1 : 0;
  });
  return different;
}

// Pixels whose highlight the sign of the diffuse register would gate otherwise.
Count pixels_of_gate_series(const GuardedFrame& guarded) {
  if (guarded.prepared.setup.configuration.gate != GateSource::series) return 0;
  Count different = 0;
  for_each_pixel(guarded.prepared.setup, [&](const Span& span, const SteppedSpan& stepped,
                                             const HighlightTable*, std::uint32_t, int) {
    different += span.highlight && stepped.open() != stepped.lit() ? 1 : 0;
  });
  return different;
}

// Pixels that the light would reach outside of its cone.
Count pixels_outside_cone(const GuardedFrame& guarded) {
  const FrameSetup& frame = guarded.prepared.setup;
  Scene wide = *frame.scene;
  for (Light& light : wide.lights) light.spot_cutoff_degrees = 90;
  Count different = 0;
  std::vector<RowSpan> rows;
  for (const ScreenTriangle& triangle : frame.geometry->triangles) {
    const Material& material = frame.geometry->materials[triangle.material];
    const PhongTriangle exact(*frame.scene, material, triangle), open(wide, material, triangle);
    cover(triangle, frame.width, frame.height, rows);
    for (const RowSpan& row : rows) {
      for (int x = row.x; x < row.x + row.length; ++x) {
        Color with, without;
        exact.shade(x, row.y, 1, &with);
        open.shade(x, row.y, 1, &without);
        different += (with - without).abs().maxCoeff() > 1 ? 1 : 0;
      }
    }
  }
  return different;
}

// Pixels on an edge of a triangle that the rule gives to its neighbour, or to nobody.
Count pixels_of_top_left_rule(const GuardedFrame& guarded) {
  const FrameSetup& frame = guarded.prepared.setup;
  Count left_out = 0;
  std::vector<RowSpan> rows;
  for (const ScreenTriangle& triangle : frame.geometry->triangles) {
    cover(triangle, frame.width, frame.height, rows);
    const auto covered = [&](int x, int y) {
      return std::any_of(rows.begin(), rows.end(), [&](const RowSpan& row) {
        return row.y == y && x >= row.x && x < row.x + row.length;
      });
    };
    const auto& v = triangle.vertices;
    const std::int64_t turn = signed_area(triangle) > 0 ? 1 : -1;
    for (int y = 0; y < frame.height; ++y) {
      for (int x = 0; x < frame.width; ++x) {
        const std::int64_t px = std::int64_t{x} * kSubpixels + kSubpixels / 2;
        const std::int64_t py = std::int64_t{y} * kSubpixels + kSubpixels / 2;
        bool inside = true, on_edge = false;
        for (std::size_t i = 0; i < 3; ++i) {
          const ScreenVertex &a = v[i], &b = v[(i + 1) % 3];
          const std::int64_t side = turn * ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x));
          inside = inside && side >= 0;
          on_edge = on_edge || side == 0;
        }
        left_out += inside && on_edge && !covered(x, y) ? 1 : 0;
      }
    }
  }
  return left_out;
}

// Pixels that show another colour than the triangle that is drawn last.
Count pixels_of_depth_test(const GuardedFrame& guarded) {
  const FrameSetup& frame = guarded.prepared.setup;
  std::vector<std::uint32_t> last(guarded.model.framebuffer.size());
  for_each_pixel(frame, [&](const Span& span, const SteppedSpan&, const HighlightTable*,
                            std::uint32_t color, int i) {
    if (!span.first_pass) return;
    last[guarded.model.framebuffer.index_of(span.row.x + i, span.row.y)] = color;
  });
  Count different = 0;
  for (std::size_t i = 0; i < last.size(); ++i) {
    const bool covered = guarded.model.framebuffer.covered(i);
    different += covered && frame.passes == 1 && guarded.model.framebuffer.color(i) != last[i];
  }
  return different;
}

// Pixels at which lights add up to more than full scale in some channel.
Count pixels_of_full_frame(const GuardedFrame& guarded) {
  const FrameSetup& frame = guarded.prepared.setup;
  const Framebuffer& framebuffer = guarded.model.framebuffer;
  std::vector<std::array<std::uint32_t, 3>> sums(framebuffer.size());
  for_each_pixel(frame, [&](const Span& span, const SteppedSpan&, const HighlightTable*,
                            std::uint32_t color, int i) {
    const std::size_t index = framebuffer.index_of(span.row.x + i, span.row.y);
    if (!framebuffer.owned(index, span.triangle)) return;
    for (std::size_t c = 0; c < 3; ++c) {
      sums[index][c] += (color >> (c * kOutputBits)) & std::uint32_t{kOutputMax};
    }
  });
  return static_cast<Count>(std::count_if(sums.begin(), sums.end(), [](const auto& sum) {
    return *std::max_element(sum.begin(), sum.end()) > std::uint32_t{kOutputMax};
  }));
}

// Registers that leave their range between the start of a span and a pixel whose value fits.
Count pixels_after_wrap(const GuardedFrame& guarded) {
  Count wrapped = 0;
  const FrameConfiguration& f = guarded.prepared.setup.configuration;
  SpanStream stream(guarded.prepared.setup);
  while (stream.next()) {
    const Span& span = stream.span();
    if (!span.highlight) continue;
    // The same series in registers that do not wrap.
    ForwardDifferencer narrow(f.specular_width()), wide(62);
    narrow.load(span.specular);
    wide.load(span.specular);
    bool left = false;
    for (int i = 0; i < span.row.length; ++i) {
      left = left || narrow.d1() != wide.d1() || narrow.d2() != wide.d2();
      wrapped += left && narrow.v() == wide.v() ? 1 : 0;
      narrow.step();
      wide.step();
    }
  }
  return wrapped;
}

std::vector<Guard> all_guards() {
  using Of = const GuardedFrame&;
  return {
      {"top_of_table", "an address above the table reads its brightest word", "pixel",
       pixels_without<Part::top_of_table>},
      {"bottom_of_table", "an address below the table reads its faintest word", "pixel",
       pixels_without<Part::bottom_of_table>},
      {"gate", "no highlight where N·L is not positive", "pixel", pixels_without<Part::gate>},
      {"gate_series", "N·L has a series of its own where the diffuse one cannot tell its sign",
       "pixel", pixels_of_gate_series},
      {"diffuse_clamp", "light below 0 is ambient light", "pixel",
       pixels_without<Part::diffuse_clamp>},
      {"saturation", "a sum above full scale is full scale", "pixel",
       pixels_without<Part::saturation>},
      {"cue_clamp", "the share of the pixel's own colour ends at 0 and 1", "pixel",
       pixels_without<Part::cue_clamp>},
      {"frame_saturation", "lights that add up to more than full scale are full scale", "pixel",
       pixels_of_full_frame},
      {"cone", "no light outside of a spotlight's cone", "pixel", pixels_outside_cone},
      {"top_left_rule", "a pixel on an edge belongs to one triangle", "pixel",
       pixels_of_top_left_rule},
      {"depth_test", "the nearest triangle wins, whatever the order", "pixel",
       pixels_of_depth_test},
      {"modular_registers", "differences may wrap, as long as values fit", "pixel",
       pixels_after_wrap},
      {"clipping", "triangles are cut at the near plane and the guard band", "triangle",
       [](Of g) { return Count{g.prepared.geometry().clipped}; }},
      {"degenerate", "triangles without area on the screen are left out", "triangle",
       [](Of g) { return Count{g.prepared.geometry().degenerate}; }},
      {"back_faces", "triangles that face away are left out", "triangle",
       [](Of g) { return Count{g.prepared.geometry().culled_back_facing}; }},
      {"overflow", "values that do not fit their registers are told, and the run fails", "triangle",
       [](Of g) { return Count{g.model.triangles.overflows}; }},
      {kRefusal, "input that has no picture is refused by name", "message", nullptr},
      {kSettings, "settings without which pixels err by more", "pixel", nullptr},
      {kStalls, "back-pressure costs time and no pixel", "cycle", nullptr},
  };
}

}  // namespace

const std::vector<Guard>& guards() {
  static const std::vector<Guard> all = all_guards();
  return all;
}

const Guard* find_guard(std::string_view name) {
  const auto& all = guards();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Guard& guard) { return guard.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::string guard_names() {
  std::vector<std::string_view> names;
  for (const Guard& guard : guards()) names.push_back(guard.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace phongpipe
