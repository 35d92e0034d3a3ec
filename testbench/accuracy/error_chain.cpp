#include "testbench/accuracy/error_chain.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/fixed/color_sum.h"
#include "model/shading/exact_power.h"
#include "model/shading/phong.h"

namespace phongpipe {
namespace {

// What one light adds to the pixels of a triangle, link by link; not clamped.
struct PassLight {
  Color polynomial = Color::Zero(), rounded = Color::Zero(), address = Color::Zero(),
        table = Color::Zero();
};

// `statistics`: without ErrorChain::address, which costs a power a pixel.
enum class Links { statistics, all };

// One triangle's pixels under one light by every link of the chain between exact Phong and output.
class PassChain {
 public:
  PassChain(const FrameSetup& frame, const FrontEnd& front_end, const TriangleWork& work,
            Links links)
      : links_(links),
        configuration_(frame.configuration),
        front_end_(front_end),
        work_(work),
        full_plan_(work.setup.material->plan),
        diffuse_unit_(std::ldexp(1.0, -configuration_.diffuse_fraction_bits)),
        specular_unit_(std::ldexp(1.0, -configuration_.specular_fraction_bits)),
        word_unit_(std::ldexp(1.0, kOutputBits - configuration_.rom_data_bits)) {
    const TriangleSetup& setup = work.setup;
    const Geometry& geometry = *frame.geometry;
    const Material& material = geometry.materials[geometry.triangles[setup.triangle].material];
    real_ = SetupEngine(frame).coefficients(setup.triangle, setup.pass, setup.x, setup.y);
    scale_ = setup.material->light.specular_scale;
    offset_ = setup.material->offset_in_addresses();
    if (setup.pass == 0) {
      ambient_ = kOutputMax * frame.scene->shading.ambient_light * material.ambient;
    }
    for (Eigen::Index c = 0; c < configuration_.channels; ++c) {
      const auto level = static_cast<double>(setup.material->level[static_cast<std::size_t>(c)]);
      rounded_ambient_[c] = std::ldexp(level, -configuration_.diffuse_fraction_bits) - 0.5;
    }
    if (is_present(full_plan_.specular)) table_ = &frame.tables[setup.material->table];
  }

  void start_row(int y) {
    spans_.clear();
    for (const RowSpan& row : work_.rows) {
      if (row.y == y) spans_.push_back(front_end_.span_walker().start(work_.setup, row));
    }
  }

  // Share of the pixel's own colour under depth cueing.
  double cue_factor(int x, int y) const {
    const Linear<double>& factor = real_.cue_factor;
    return std::clamp(factor.a * (x - work_.setup.x) + factor.b * (y - work_.setup.y) + factor.c,
                      0.0, 1.0);
  }

  // Adds what the light gives to the pixel at `x` of the row.
  void add(int x, PassLight& light) const {
    for (const Span& span : spans_) {
      const int i = x - span.row.x;
      if (i >= 0 && i < span.row.length) add(span, i, light);
    }
  }

 private:
  void add(const Span& span, int i, PassLight& light) const {
    const double x = span.row.x + i - work_.setup.x, y = span.row.y - work_.setup.y;
    const auto channels = static_cast<std::size_t>(configuration_.channels);
    std::array<double, 3> real = {}, rounded = {};
    for (std::size_t c = 0; c < channels; ++c) {
      if (is_present(full_plan_.diffuse) && span.row.lit) real[c] = real_.diffuse[c](x, y);
      const std::int64_t v = value(span.diffuse[c], i, configuration_.diffuse_width());
      rounded[c] = static_cast<double>(v - span.level[c]) * diffuse_unit_;
    }
    for (std::size_t c = 0; c < channels; ++c) {
      const auto k = static_cast<Eigen::Index>(c);
      light.polynomial[k] += ambient_[k] + std::max(0.0, real[c]);
      const double diffuse = rounded_ambient_[k] + std::max(0.0, rounded[c]);
      light.rounded[k] += diffuse;
      light.address[k] += diffuse;
      light.table[k] += diffuse;
    }
    if (!is_present(full_plan_.specular) || !span.row.lit) return;
    const bool real_open = open(real, is_present(full_plan_.gate) ? real_.gate(x, y) : 0);
    const double real_specular = real_.specular(x, y) + offset_;
    // Where a normal vanishes, the coefficients are no numbers; such a series gives no light.
    const Color real_highlight = real_open && std::isfinite(real_specular)
                                     ? full_highlight(real_specular)
                                     : Color(Color::Zero());
    light.polynomial += real_highlight;
    if (!span.highlight) {  // left out, as the table's words are 0
      light.rounded += real_highlight;
      light.address += real_highlight;
      return;
    }
    const std::int64_t gate = value(span.gate, i, configuration_.diffuse_width());
    if (!open(rounded, static_cast<double>(gate))) return;
    const std::int64_t specular = value(span.specular, i, configuration_.specular_width());
    light.rounded += full_highlight(static_cast<double>(specular) * specular_unit_);
    const int address = ExponentRom::address(configuration_, specular);
    if (links_ == Links::all) {
      const double power =
          ExponentRom::powers(configuration_, table_->shininess)[static_cast<std::size_t>(address)];
      light.address += kOutputMax * table_->specular * power;
    }
    for (std::size_t c = 0; c < channels; ++c) {
      light.table[static_cast<Eigen::Index>(c)] +=
          table_->roms[c].words()[static_cast<std::size_t>(address)] * word_unit_;
    }
  }

  static std::int64_t value(const SeriesStart& start, int i, int width) {
    const std::int64_t pairs = std::int64_t{i} * (i - 1) / 2;
    return wrap_to(wrap_add(wrap_add(start.v, wrap_mul(start.d1, i)), wrap_mul(start.d2, pairs)),
                   width);
  }
  // Of a value of the specular series, in addresses.
  Color full_highlight(double address) const {
    const double x = (address - offset_) / scale_;
    return kOutputMax * table_->specular * exact_power(std::clamp(x, 0.0, 1.0), table_->shininess);
  }
  bool open(const std::array<double, 3>& diffuse, double gate) const {
    switch (configuration_.gate) {
      case GateSource::off:
        return true;
      case GateSource::series:
        return gate > 0;
      case GateSource::diffuse:
        break;
    }
    return diffuse[0] > 0 || diffuse[1] > 0 || diffuse[2] > 0;
  }

  Links links_;
  const DatapathConfiguration& configuration_;
  const FrontEnd& front_end_;
  TriangleWork work_;
  SeriesPlan full_plan_;                 // nothing left out
  double diffuse_unit_, specular_unit_;  // LSB and addresses in one unit of the registers
  double word_unit_;                     // LSB in one unit of a ROM word
  double scale_, offset_;                // of the specular series, in addresses
  const HighlightTable* table_ = nullptr;
  TriangleCoefficients<double> real_;
  Color ambient_ = Color::Zero(), rounded_ambient_ = Color::Zero();
  std::vector<Span> spans_;  // of the row
};

// A triangle under all lights, with depth cueing.
class TriangleChain {
 public:
  TriangleChain(const FrameSetup& frame, const FrontEnd& front_end, std::uint32_t triangle,
                Links links)
      : frame_(frame), triangle_(triangle) {
    const std::optional<DepthCue>& cue = frame.scene->depth_cue;
    if (cue) cue_color_ = kOutputMax * cue->color;
    frame.cover_triangle(triangle, rows_);
    exact_ = known_exact_colors();
    if (exact_ == nullptr && !rows_.empty()) phong_.emplace(phong());
    TriangleWork work;
    for (std::uint32_t pass = 0; pass < frame.passes; ++pass) {
      if (front_end.set_up(triangle, pass, work) == SetupOutcome::nothing) continue;
      if (frame.takes_exact_path(triangle)) {
        take_exact_values(work);
        break;
      }
      passes_.emplace_back(frame, front_end, work, links);
    }
  }

  const std::vector<RowSpan>& rows() const { return rows_; }

  void start(const RowSpan& row) {
    row_ = row;
    const auto before = [](const RowSpan& a, const RowSpan& b) {
      return a.y != b.y ? a.y < b.y : a.x < b.x;
    };
    first_exact_ =
        std::lower_bound(exact_rows_.begin(), exact_rows_.end(), row, before) - exact_rows_.begin();
    for (PassChain& pass : passes_) pass.start_row(row.y);
    if (exact_ == nullptr) {
      own_exact_.resize(std::max(own_exact_.size(), static_cast<std::size_t>(row.length)));
      phong_->shade(row.x, row.y, row.length, own_exact_.data());
      exact_of_row_ = own_exact_.data();
      return;
    }
    exact_of_row_ = exact_;
    for (const RowSpan& above : rows_) {
      if (above.y == row.y) break;
      exact_of_row_ += above.length;
    }
  }

  // The links of pixel i of the row, but the output.
  void at(int i, ErrorChain& chain) const {
    chain.shown = exact_of_row_[i];
    chain.exact = chain.shown;
    if (!exact_values_.empty()) {
      chain.polynomial = chain.shown;
      const Color& value = exact_values_[static_cast<std::size_t>(first_exact_ + i)];
      chain.rounded = chain.address = chain.table = value;
      return;
    }
    PassLight light;
    for (const PassChain& pass : passes_) pass.add(row_.x + i, light);
    chain.polynomial = shown(light.polynomial, i);
    chain.rounded = shown(light.rounded, i);
    chain.address = shown(light.address, i);
    chain.table = shown(light.table, i);
  }

 private:
  // The exact colours of all pixels; null where the frame's memo does not keep them.
  const Color* known_exact_colors() const {
    if (frame_.memo == nullptr) return nullptr;
    const auto shade = [this](Color* colors) {
      const PhongTriangle exact = phong();
      for (const RowSpan& row : rows_) {
        exact.shade(row.x, row.y, row.length, colors);
        colors += row.length;
      }
    };
    const auto pixels = std::accumulate(rows_.begin(), rows_.end(), std::size_t{0},
                                        [](std::size_t sum, const RowSpan& row) {
                                          return sum + static_cast<std::size_t>(row.length);
                                        });
    return frame_.memo->exact_colors(triangle_, pixels, shade);
  }
  PhongTriangle phong() const {
    const ScreenTriangle& shape = frame_.geometry->triangles[triangle_];
    return {*frame_.scene, frame_.geometry->materials[shape.material], shape};
  }

  // The colours of exact_path, which are of all lights, without the half that rounds them.
  void take_exact_values(const TriangleWork& work) {
    exact_rows_ = work.rows;
    const DatapathConfiguration& f = frame_.configuration;
    for (const auto& registers : work.setup.exact_values) {
      Color value = Color::Zero();
      for (int c = 0; c < f.channels; ++c) {
        value[c] = std::ldexp(static_cast<double>(registers[static_cast<std::size_t>(c)]),
                              -f.diffuse_fraction_bits) -
                   0.5;
      }
      exact_values_.push_back(value);
    }
  }

  Color shown(const Color& light, int i) const {
    if (!frame_.configuration.depth_cue) return light.min(kOutputMax);
    const double factor = passes_.front().cue_factor(row_.x + i, row_.y);
    return (cue_color_ + (light - cue_color_) * factor).min(kOutputMax);
  }

  const FrameSetup& frame_;
  std::uint32_t triangle_;
  std::vector<PassChain> passes_;
  std::vector<RowSpan> rows_;
  Color cue_color_ = Color::Zero();
  RowSpan row_;
  const Color* exact_ = nullptr;  // of all pixels of the triangle, row by row; or null, and then
  std::optional<PhongTriangle> phong_;
  const Color* exact_of_row_ = nullptr;
  std::vector<Color> own_exact_;  // of the row, if `exact_` is null
  // Of a triangle of exact_path: its pixels, their values, and the first of the row.
  std::vector<RowSpan> exact_rows_;
  std::vector<Color> exact_values_;
  std::ptrdiff_t first_exact_ = 0;
};

void take_output(const FrameSetup& frame, const ModelFrame& model, ErrorChain& links) {
  const std::uint32_t output = model.framebuffer.color(links.index);
  for (int c = 0; c < frame.configuration.channels; ++c) {
    links.output[c] = (output >> (c * kOutputBits)) & std::uint32_t{kOutputMax};
  }
}

// The nearest triangle of a pixel, if the frame shows another.
const std::uint32_t* nearest_at(const std::vector<MisplacedPixel>& misplaced, std::size_t index) {
  if (misplaced.empty()) return nullptr;
  const auto found = std::lower_bound(
      misplaced.begin(), misplaced.end(), index,
      [](const MisplacedPixel& pixel, std::size_t wanted) { return pixel.index < wanted; });
  return found != misplaced.end() && found->index == index ? &found->triangle : nullptr;
}

// Exact Phong shading of one pixel of a triangle.
Color exact_color(const Scene& scene, const Geometry& geometry, std::uint32_t triangle, int x,
                  int y) {
  const ScreenTriangle& shape = geometry.triangles[triangle];
  Color color;
  PhongTriangle(scene, geometry.materials[shape.material], shape).shade(x, y, 1, &color);
  return color;
}

Color rounded_link(const Color& link, int channels) {
  constexpr int kFraction = 40;
  Color result = Color::Zero();
  for (int c = 0; c < channels; ++c) {
    result[c] = std::ldexp(std::round(std::ldexp(link[c], kFraction)), -kFraction);
  }
  return result;
}

}  // namespace

void for_each_visible_pixel(const FrameSetup& frame, const ModelFrame& model,
                            const std::function<void(const ErrorChain&)>& visit) {
  for_each_visible_pixel(frame, model, misplaced_pixels(frame, model, false), 0,
                         static_cast<std::uint32_t>(frame.geometry->triangles.size()), visit);
}

void for_each_visible_pixel(const FrameSetup& frame, const ModelFrame& model,
                            const std::vector<MisplacedPixel>& misplaced, std::uint32_t first,
                            std::uint32_t end,
                            const std::function<void(const ErrorChain&)>& visit) {
  const FrontEnd front_end(frame);
  ErrorChain links;
  for (std::uint32_t triangle = first; triangle < end; ++triangle) {
    TriangleChain chain(frame, front_end, triangle, Links::statistics);
    for (const RowSpan& row : chain.rows()) {
      chain.start(row);
      links.index = static_cast<std::size_t>(row.y) * static_cast<std::size_t>(frame.width) +
                    static_cast<std::size_t>(row.x);
      for (int i = 0; i < row.length; ++i, ++links.index) {
        if (!model.framebuffer.owned(row.x + i, row.y, triangle)) continue;  // hidden
        chain.at(i, links);
        if (const std::uint32_t* nearest = nearest_at(misplaced, links.index)) {
          links.exact = exact_color(*frame.scene, *frame.geometry, *nearest, row.x + i, row.y);
        }
        take_output(frame, model, links);
        visit(links);
      }
    }
  }
}

std::size_t ErrorSplit::largest_part() const {
  const auto smaller = [](const Color& a, const Color& b) {
    return a.abs().maxCoeff() < b.abs().maxCoeff();
  };
  return static_cast<std::size_t>(std::max_element(parts.begin(), parts.end(), smaller) -
                                  parts.begin());
}

ErrorSplit split_error(const PreparedFrame& frame, const ModelFrame& model,
                       const std::vector<MisplacedPixel>& misplaced, int x, int y) {
  ErrorChain links;
  links.index = model.framebuffer.index_of(x, y);
  take_output(frame.setup, model, links);
  const std::uint32_t piece = model.framebuffer.owner(links.index);
  const FrontEnd front_end(frame.setup);
  TriangleChain chain(frame.setup, front_end, piece, Links::all);
  for (const RowSpan& row : chain.rows()) {
    if (row.y != y) continue;
    chain.start(row);
    chain.at(x - row.x, links);
  }
  const std::uint32_t* const nearest = nearest_at(misplaced, links.index);
  const Geometry& geometry = frame.prepared->geometry;
  const auto of_whole = [&](std::uint32_t part) {
    return exact_color(frame.scene(), geometry, frame.subdivision().whole[part], x, y);
  };
  std::array<Color, kErrorParts.size() + 1> colors = {
      of_whole(nearest != nullptr ? *nearest : piece),
      of_whole(piece),
      links.shown,
      links.polynomial,
      links.rounded,
      links.address,
      links.table,
      links.output};
  for (Color& color : colors) color = rounded_link(color, frame.setup.configuration.channels);
  ErrorSplit split;
  split.exact = colors.front();
  split.output = colors.back();
  for (std::size_t i = 0; i < split.parts.size(); ++i) split.parts[i] = colors[i + 1] - colors[i];
  return split;
}

}  // namespace phongpipe
