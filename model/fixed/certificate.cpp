#include "model/fixed/certificate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/fixed/coverage.h"
#include "model/fixed/exact_path.h"
#include "model/fixed/rounding_bound.h"
#include "model/fixed/span_walker.h"

namespace phongpipe {
namespace {

// Triangles of at most so many pixels take exact_path at once: that costs less than the setup of
// series, and needs no bound.
constexpr std::uint64_t kFewPixels = 24;

// Outward rounding: the bounds themselves take fewer than 1,000 roundings of positive terms.
constexpr double kOutward = 1 + 1e-12;

// What double precision may lose in the series of a triangle, in cosines. Each coefficient is a sum
// of some twenty rounded products of the six values (or of vectors and their gradients, over their
// lengths) with one or two barycentric coordinates, or their gradients; so a value within the
// triangle's extent is off by as many units in the last place of the square of the largest
// coordinate there, which for slivers is far above 1, and of the cube of the ratio of lengths.
double coefficient_noise(const TriangleInput<double>& input, double extent,
                         const std::vector<const Corners<double>*>& vectors) {
  constexpr double kRoundings = 64, kUnit = std::numeric_limits<double>::epsilon() / 2;
  const Interpolator<double> interpolate(input.x, input.y);
  const Linear<double> u = interpolate.coordinate_1(), v = interpolate.coordinate_2();
  const auto size = [&](const Linear<double>& q) {
    return (std::fabs(q.a) + std::fabs(q.b)) * extent + std::fabs(q.c);
  };
  const double largest = 1 + size(u) + size(v);
  double noise = kRoundings * kUnit * largest * largest;
  for (const Corners<double>* corners : vectors) {
    const VectorExtent<double> field(*corners);
    const double ratio = field.vector.value * field.inverse_least;
    noise *= ratio * ratio * ratio;
  }
  return noise;
}

// Largest difference of a table's words from specular · x^n over all x that read them, in LSB. What
// is beyond full scale counts under depth cueing, where it fades.
double table_error(const FrameSetup& frame, const HighlightTable& table) {
  const FrameConfiguration& f = frame.configuration;
  const double n = table.shininess, reach = highlight_reach(f, n);
  const double most = frame.scene->depth_cue ? std::numeric_limits<double>::max() : kOutputMax;
  double largest = 0;
  for (std::size_t c = 0; c < table.roms.size(); ++c) {
    const double full = kOutputMax * table.specular[static_cast<Eigen::Index>(c)];
    const std::vector<std::int32_t>& words = table.roms[c].words();
    const auto addresses = static_cast<double>(words.size());
    const auto value = [&](double address) {
      const double x = address <= 0 ? 0 : 1 - reach * (1 - address / addresses);
      return std::min(most, full * std::pow(std::clamp(x, 0.0, 1.0), n));
    };
    for (std::size_t a = 0; a < words.size(); ++a) {
      const double word = std::min(most, std::ldexp(words[a], kOutputBits - f.rom_data_bits));
      const auto address = static_cast<double>(a);
      largest = std::max(
          {largest, std::fabs(word - value(address)), std::fabs(word - value(address + 1))});
    }
  }
  return largest;
}

// An error in place of one that has no bound.
constexpr double kNothing = 1e9;

// One light's error, apart from the rounding of its sum to 8 bits.
struct LightError {
  double total = 0, series = 0;
};

class LightCertificate {
 public:
  LightCertificate(const FrameSetup& frame, const ScreenTriangle& triangle, std::uint32_t pass,
                   const Pixel& origin, int longest_row, const std::vector<double>& table_errors)
      : frame_(frame),
        material_(frame.material(pass, triangle.material)),
        input_(triangle_input(frame, triangle, pass, origin.x, origin.y)) {
    const FrameConfiguration& f = frame.configuration;
    if (is_present(material_.plan.specular) &&
        frame.tables[material_.table].specular.maxCoeff() > 0) {
      table_ = &frame.tables[material_.table];
    }
    // The same whether or not hardware has more than the material needs.
    ReflectionForm form = material_.plan.form;
    form.local_viewer = table_ != nullptr && frame.scene->shading.viewer == Viewer::local;
    bound_ = bound_reflection(form, material_.light.terms, input_.normal, input_.eye, input_.light);
    double extent = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      extent = std::max({extent, std::fabs(input_.x[i]), std::fabs(input_.y[i])});
    }
    std::vector<const Corners<double>*> vectors = {&input_.normal};
    if (form.point_light) vectors.push_back(&input_.light);
    if (form.local_viewer) vectors.push_back(&input_.eye);
    const LightInput<double>& light = material_.light;
    scales_.noise = coefficient_noise(input_, extent, vectors);
    // What a material has not is 0 to the bit, whether it is built or left out.
    const auto& diffuse = light.diffuse_scale;
    scales_.diffuse = *std::max_element(diffuse.begin(), diffuse.begin() + f.channels);
    scales_.light_rounding = rounding_bound(f, f.diffuse_fraction_bits, extent, longest_row);
    least_scale_ = least_scale();
    if (table_ != nullptr) {
      scales_.specular = kOutputMax * table_->specular.maxCoeff();
      scales_.shininess = table_->shininess;
      scales_.highlight_rounding =
          rounding_bound(f, f.specular_fraction_bits, extent, longest_row) / light.specular_scale;
      table_error_ = table_errors[material_.table];
    }
    const Interpolator<double> interpolate(input_.x, input_.y);
    const double first = interpolate.coordinate_1().c, second = interpolate.coordinate_2().c;
    const double nearest = std::min({first, second, 1 - first - second});
    // The expansion point is a pixel's centre, in the triangle but for rounding.
    taylor_error_ = taylor_error(1 - std::max(0.0, nearest));
    taylor_allowed_ = !form.point_light && !form.local_viewer;
  }

  // Whether the light adds to the triangle's pixels at all.
  bool adds() const { return scales_.diffuse > 0 || table_ != nullptr; }
  bool taylor_allowed() const { return taylor_allowed_; }
  double noise() const { return scales_.noise; }

  LightError error(const CertifiedFits& fits) const {
    const QuadraticErrors<double> errors =
        quadratic_errors(bound_, scales_, kappa(fits.light), kappa(fits.highlight));
    LightError result;
    // Where no light falls, neither does anything else.
    const double doubt = bound_.light.third * kappa(fits.light) + scales_.noise +
                         scales_.light_rounding / least_scale_;
    const bool gated = frame_.configuration.gate != GateSource::off;
    const bool dark = bound_.light.high + doubt <= 0;
    if (!dark && scales_.diffuse > 0) {
      result.total = errors.light;
      result.series = bound_.light.third * kappa(fits.light) * scales_.diffuse;
    }
    if (table_ == nullptr || (dark && gated)) return result;
    if (bound_.highlight.third >= kNoBound || bound_.light.third >= kNoBound) {
      result.total = kNothing;  // attenuation may exceed what the table is made for
      return result;
    }
    const double n = scales_.shininess;
    const double most = std::clamp(bound_.highlight.high + errors.base, 0.0, 1.0);
    const double visible = scales_.specular * std::pow(most, n);
    const double address = most * material_.light.specular_scale + material_.offset_in_addresses();
    const bool invisible =
        material_.first_visible_address > 0 && address + 1 < material_.first_visible_address;
    const bool lit = bound_.light.low - doubt > 0;
    if (invisible) {
      result.total += visible;
    } else if (!lit) {
      result.total += visible + table_error_;
    } else {
      // The slope of x^n has no bound at 0 if n is below 1.
      const double power = n == 0 ? 0 : n < 1 ? visible : std::min(visible, errors.highlight);
      result.total += power + table_error_;
      result.series += n >= 1 && errors.highlight < visible ? errors.highlight : 0;
    }
    return result;
  }

 private:
  double kappa(SeriesFit fit) const {
    return fit == SeriesFit::taylor ? taylor_error_ : kSixPointError;
  }
  // LSB of N·L = 1, of the series that is the least certain of its sign: any channel of the diffuse
  // series opens the gate.
  double least_scale() const {
    double least = kOutputMax;
    for (int c = 0; c < frame_.configuration.channels; ++c) {
      const double scale = material_.light.diffuse_scale[static_cast<std::size_t>(c)];
      if (scale > 0) least = std::min(least, scale);
    }
    return least;
  }

  const FrameSetup& frame_;
  const MaterialSetup& material_;
  TriangleInput<double> input_;
  Reflected<ReflectionBound<double>> bound_;
  ErrorScales<double> scales_;
  const HighlightTable* table_ = nullptr;  // or null without a highlight
  double table_error_ = 0;                 // LSB
  double least_scale_ = 1;
  double taylor_error_ = 0;
  bool taylor_allowed_ = false;
};

// Of depth cueing, on top of the errors of lights: the share is truncated to kCueFactorBits, its
// coefficients are rounded, and the result is rounded to 8 bits once more for each light.
double cue_error(const FrameSetup& frame, const ScreenTriangle& triangle, double noise,
                 double extent, int longest_row) {
  if (!frame.scene->depth_cue) return 0;
  const double share =
      cue_share_noise(*frame.scene, triangle) + std::ldexp(1, -kCueFactorBits) +
      std::ldexp(rounding_bound(frame.configuration, 0, extent, longest_row), -kCueFraction) +
      std::ldexp(noise, kCueIntegerBits);
  constexpr double kMostOverexposed = 2 * kOutputMax + 2;  // what the diffuse register holds
  return 0.5 + (kMostOverexposed + kOutputMax) * share;
}

std::uint64_t pixels_of(const std::vector<RowSpan>& rows) {
  std::uint64_t pixels = 0;
  for (const RowSpan& row : rows) pixels += static_cast<std::uint64_t>(row.length);
  return pixels;
}

}  // namespace

Certifier::Certifier(const FrameSetup& frame) : frame_(frame) {
  for (const HighlightTable& table : frame.tables) {
    table_errors_.push_back(table_error(frame, table));
  }
}

QuadraticError Certifier::bound(const ScreenTriangle& triangle, const std::vector<RowSpan>& rows,
                                std::vector<CertifiedFits>* fits) const {
  const FrameConfiguration& f = frame_.configuration;
  const Pixel origin = expansion_pixel(triangle, rows);
  std::vector<LightCertificate> lights;
  std::vector<CertifiedFits> chosen;
  std::vector<LightError> errors;
  double fixed = std::ldexp(0.5, -f.diffuse_fraction_bits);  // the level's rounding
  for (std::uint32_t pass = 0; pass < frame_.passes; ++pass) {
    lights.emplace_back(frame_, triangle, pass, origin, longest_row(rows), table_errors_);
    const SeriesFit cheapest =
        lights.back().taylor_allowed() ? SeriesFit::taylor : SeriesFit::six_point;
    chosen.push_back({cheapest, cheapest});
    errors.push_back(lights.back().error(chosen.back()));
    if (pass == 0 || (lights.back().adds() && errors.back().total > 0)) {
      fixed +=
          0.5 + cue_error(frame_, triangle, lights.back().noise(),
                          std::max(frame_.width, frame_.height) + kGuardBand, longest_row(rows));
    }
  }
  const auto sum = [&] {
    QuadraticError result{fixed, 0};
    for (const LightError& error : errors) {
      result.error_lsb += error.total;
      result.series_lsb += error.series;
    }
    result.error_lsb *= kOutward;
    return result;
  };
  // Six points where they help most, until the error is small enough.
  while (sum().error_lsb > f.max_error_lsb()) {
    double gain = 0;
    std::size_t place = 0;
    CertifiedFits better;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      for (const bool light : {true, false}) {
        CertifiedFits next = chosen[i];
        (light ? next.light : next.highlight) = SeriesFit::six_point;
        const double gained = errors[i].total - lights[i].error(next).total;
        if (gained <= gain) continue;
        gain = gained;
        place = i;
        better = next;
      }
    }
    if (gain == 0) break;
    chosen[place] = better;
    errors[place] = lights[place].error(better);
  }
  if (fits != nullptr) fits->insert(fits->end(), chosen.begin(), chosen.end());
  return sum();
}

bool Certifier::wants_split(const ScreenTriangle& triangle, int levels) const {
  std::vector<RowSpan> rows;
  cover(triangle, frame_.width, frame_.height, rows);
  if (rows.empty()) return false;
  const double limit = frame_.configuration.max_error_lsb();
  QuadraticError error = bound(triangle, rows, nullptr);
  if (error.error_lsb <= limit) return false;
  // Pixels for which exact_path takes as long as the setup of a piece.
  constexpr double kPixelsOfPiece = 32;
  double pieces = 1;
  for (int level = 1; level <= levels; ++level) {
    pieces *= 4;
    error.error_lsb -= error.series_lsb * 7 / 8;
    error.series_lsb /= 8;
    if (static_cast<double>(pixels_of(rows)) < pieces * kPixelsOfPiece) return false;
    if (error.error_lsb <= limit) return true;
  }
  return false;
}

Certificates certify(const FrameSetup& frame) {
  const std::vector<ScreenTriangle>& triangles = frame.geometry->triangles;
  const Certifier certifier(frame);
  const SetupEngine setup_engine(frame);
  const SpanWalker span_walker(frame);
  Certificates result;
  result.triangles.resize(triangles.size());
  result.fits.resize(triangles.size() * frame.passes);
  std::vector<RowSpan> rows;
  std::vector<CertifiedFits> fits;
  // Whether all values under all lights fit their registers.
  const auto fits_registers = [&](std::uint32_t triangle) {
    const Pixel origin = expansion_pixel(triangles[triangle], rows);
    for (std::uint32_t pass = 0; pass < frame.passes; ++pass) {
      const TriangleSetup setup =
          setup_engine.set_up(triangle, pass, origin.x, origin.y, longest_row(rows), &fits[pass]);
      if (setup.overflow) return false;
      for (const RowSpan& row : rows) {
        if (!span_walker.fits(setup, row)) return false;
      }
    }
    return true;
  };
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    frame.cover_triangle(i, rows);
    if (rows.empty()) continue;
    fits.clear();
    Certificates::Triangle& triangle = result.triangles[i];
    triangle.bounded = pixels_of(rows) > kFewPixels;
    double error = kOutputMax;
    if (triangle.bounded) error = certifier.bound(triangles[i], rows, &fits).error_lsb;
    if (error <= frame.configuration.max_error_lsb() && fits_registers(i)) {
      triangle.error_lsb = error;
      for (std::uint32_t pass = 0; pass < frame.passes; ++pass) {
        result.fits[pass * triangles.size() + i] = fits[pass];
      }
      continue;
    }
    triangle.exact = true;
    triangle.refused_pixels = shade_exactly(frame, triangles[i], rows).refused;
    triangle.error_lsb =
        triangle.refused_pixels > 0 ? kOutputMax : least_certified_error_lsb(frame.configuration);
  }
  return result;
}

ShadingPath path_of(const FrameSetup& frame, const TriangleSetup& setup) {
  if (frame.takes_exact_path(setup.triangle)) return ShadingPath::exact_path;
  if (frame.geometry->triangles[setup.triangle].piece) return ShadingPath::subdivided;
  const SeriesFit fits[] = {setup.plan.form.fit, is_present(setup.plan.specular)
                                                     ? setup.plan.highlight_fit()
                                                     : setup.plan.form.fit};
  return static_cast<ShadingPath>(std::max(fits[0], fits[1]));
}

void count_pixels(const FrameSetup& frame, const TriangleSetup& setup, std::uint64_t pixels,
                  Ledger& ledger) {
  std::uint64_t refused = 0;
  if (frame.certificates) refused = frame.certificates->triangles[setup.triangle].refused_pixels;
  ledger[ShadingPath::refused] += refused;
  ledger[path_of(frame, setup)] += pixels - refused;
}

std::optional<double> certified_error(const FrameSetup& frame) {
  if (!frame.certificates) return {};
  double largest = 0;
  for (const Certificates::Triangle& triangle : frame.certificates->triangles) {
    largest = std::max(largest, triangle.error_lsb);
  }
  return largest;
}

}  // namespace phongpipe
