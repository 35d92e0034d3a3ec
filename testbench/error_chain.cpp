#include "testbench/error_chain.h"

#include <cmath>

#include "model/fixed/color_sum.h"
#include "model/shading/phong.h"

namespace phongpipe {
namespace {

// One triangle's pixels by every link of the chain between exact Phong and the output.
class TriangleChain {
 public:
  TriangleChain(const Scene& scene, const Geometry& geometry, const FrameSetup& frame,
                const FrontEnd& front_end, std::uint32_t triangle)
      : configuration_(frame.configuration),
        material_(geometry.materials[geometry.triangles[triangle].material]),
        setup_(frame.materials[geometry.triangles[triangle].material]),
        front_end_(front_end) {
    front_end.set_up(triangle, work_);
    real_ = SetupEngine(frame, geometry).coefficients(triangle, work_.setup.x, work_.setup.y);
    for (Eigen::Index c = 0; c < configuration_.channels; ++c) {
      ambient_[c] = kOutputMax * scene.shading.ambient_light[c] * material_.ambient[c];
      const auto level = static_cast<double>(setup_.level[static_cast<std::size_t>(c)]);
      rounded_ambient_[c] = std::ldexp(level, -configuration_.diffuse_fraction_bits) - 0.5;
      highlight_[c] = kOutputMax * scene.lights.front().color[c] * material_.specular[c];
    }
  }

  void start(const RowSpan& row) { span_ = front_end_.span_walker().start(work_.setup, row); }

  // The links of pixel i of the span; exact and output are left alone.
  void at(int i, ErrorChain& chain) const {
    const double x = span_.row.x + i - work_.setup.x, y = span_.row.y - work_.setup.y;
    const auto channels = static_cast<std::size_t>(configuration_.channels);
    const int diffuse_fraction = configuration_.diffuse_fraction_bits;

    std::array<double, 3> real = {}, rounded = {};
    for (std::size_t c = 0; c < channels; ++c) {
      real[c] = real_.diffuse[c](x, y);
      const std::int64_t v = value(span_.diffuse[c], i, configuration_.diffuse_width());
      rounded[c] = std::ldexp(static_cast<double>(v - setup_.level[c]), -diffuse_fraction);
    }
    const std::int64_t gate = value(span_.gate, i, configuration_.diffuse_width());
    const std::int64_t specular = value(span_.specular, i, configuration_.specular_width());
    const double full_scale = configuration_.rom_words();
    const double real_power = power(real_.specular(x, y) / full_scale);
    const double rounded_power =
        power(std::ldexp(static_cast<double>(specular), -configuration_.specular_fraction_bits) /
              full_scale);
    const auto address = static_cast<std::size_t>(ExponentRom::address(configuration_, specular));

    const bool real_open = open(real, real_.gate(x, y));
    const bool rounded_open = open(rounded, static_cast<double>(gate));
    for (std::size_t c = 0; c < channels; ++c) {
      const auto k = static_cast<Eigen::Index>(c);
      const double word =
          std::ldexp(setup_.roms[c].words()[address], kOutputBits - configuration_.rom_data_bits);
      chain.polynomial[k] = sum(k, ambient_, real[c], real_open ? highlight_[k] * real_power : 0);
      chain.rounded[k] =
          sum(k, rounded_ambient_, rounded[c], rounded_open ? highlight_[k] * rounded_power : 0);
      chain.table[k] = sum(k, rounded_ambient_, rounded[c], rounded_open ? word : 0);
    }
  }

 private:
  static std::int64_t value(const SeriesStart& start, int i, int width) {
    const std::int64_t pairs = std::int64_t{i} * (i - 1) / 2;
    return wrap_to(wrap_add(wrap_add(start.v, wrap_mul(start.d1, i)), wrap_mul(start.d2, pairs)),
                   width);
  }
  double power(double x) const {
    return std::pow(std::min(1.0, std::max(0.0, x)), material_.shininess);
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
  static double sum(Eigen::Index channel, const Color& ambient, double diffuse, double highlight) {
    return std::min<double>(kOutputMax, ambient[channel] + std::max(0.0, diffuse) + highlight);
  }

  const DatapathConfiguration& configuration_;
  const Material& material_;
  const MaterialSetup& setup_;
  const FrontEnd& front_end_;
  TriangleWork work_;
  TriangleCoefficients<double> real_;
  Color ambient_, rounded_ambient_, highlight_;
  Span span_;
};

}  // namespace

void for_each_visible_pixel(const Scene& scene, const Geometry& geometry, const FrameSetup& frame,
                            const ModelFrame& model,
                            const std::function<void(const ErrorChain&)>& visit) {
  const FrontEnd front_end(frame, geometry);
  std::vector<Color> exact;
  ErrorChain links;
  std::uint32_t place = 0;
  for (std::size_t s = 0; s < model.spans.size();) {
    const std::uint32_t triangle = model.spans[s].triangle;
    const ScreenTriangle& source = geometry.triangles[triangle];
    const PhongTriangle phong(scene, geometry.materials[source.material], source);
    TriangleChain chain(scene, geometry, frame, front_end, triangle);
    for (; s < model.spans.size() && model.spans[s].triangle == triangle; ++s) {
      const RowSpan row = model.spans[s].row;
      exact.resize(std::max(exact.size(), static_cast<std::size_t>(row.length)));
      phong.shade(row.x, row.y, row.length, exact.data());
      chain.start(row);
      links.index = static_cast<std::size_t>(row.y) * static_cast<std::size_t>(frame.width) +
                    static_cast<std::size_t>(row.x);
      for (int i = 0; i < row.length; ++i, ++place, ++links.index) {
        if (model.framebuffer.value(links.index) != place) continue;  // hidden
        chain.at(i, links);
        links.exact = exact[static_cast<std::size_t>(i)];
        for (int c = 0; c < frame.configuration.channels; ++c) {
          links.output[c] =
              (model.stream[place].color >> (c * kOutputBits)) & std::uint32_t{kOutputMax};
        }
        visit(links);
      }
    }
  }
}

}  // namespace phongpipe
