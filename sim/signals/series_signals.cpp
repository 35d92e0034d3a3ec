#include "sim/signals/block_signals.h"
#include "sim/signals/signal_list.h"

namespace phongpipe {
namespace {

class SeriesTable : public SignalList {
 public:
  explicit SeriesTable(const DatapathConfiguration& configuration) : SignalList(configuration) {
    for (int c = 0; c < f_.channels && f_.diffuse; ++c) {
      add_series(
          fmt::format("channel[{}].diffuse.diffuse_series", c), "LSB", f_.diffuse_width(),
          f_.diffuse_fraction_bits,
          [c](const Pixel& p) -> const Series& { return p.diffuse[static_cast<std::size_t>(c)]; },
          [](const Pixel& p) { return p.step_diffuse; });
    }
    if (f_.specular) {
      add_series(
          "specular.specular_series", "address", f_.specular_width(), f_.specular_fraction_bits,
          [](const Pixel& p) -> const Series& { return p.specular; },
          [](const Pixel& p) { return p.step_specular; });
    }
    if (f_.has_gate_series()) {
      add_series(
          "gate.gate_series", "LSB", f_.diffuse_width(), f_.diffuse_fraction_bits,
          [](const Pixel& p) -> const Series& { return p.gate; },
          [](const Pixel& p) { return p.step_diffuse; });
    }
    if (f_.depth_cue) {
      add_series(
          "cueing.cue_series", "", kCueWidth, kCueFraction,
          [](const Pixel& p) -> const Series& { return p.cue; }, [](const Pixel&) { return true; });
    }
  }

 private:
  // `of`: the series of a pixel. `stepping`: whether it steps along the span.
  template <typename Of, typename Stepping>
  void add_series(const std::string& scope, const char* unit, int width, int fraction_bits, Of of,
                  Stepping stepping) {
    const auto whole = [&](int stage, const char* name, std::int64_t Series::*part) {
      in_units(add(stage, scope, at(stage, name), width,
                   [of, part](const Pixel& p) { return of(p).*part; }),
               unit, fraction_bits, true);
    };
    const int low = low_bits(width);
    const auto lower = [&](int stage, const char* name, std::int64_t Series::*part) {
      add(stage, scope, at(stage, name), low,
          [of, part, low](const Pixel& p) { return of(p).*part & ((std::int64_t{1} << low) - 1); });
    };
    const auto upper = [&](int stage, const char* name, std::int64_t Series::*part) {
      add(stage, scope, at(stage, name), width - low, [of, part, low](const Pixel& p) {
        return of(p).*part >> low;
      }).is_signed = true;
    };
    if (f_.kind == DatapathKind::serial) {
      whole(kWholeStage, "v", &Series::v);
      whole(kSeriesStage, "v", &Series::v);
      return;
    }
    // Terms of the first pixel, at the input.
    const auto add_start = [&](const std::string& block, const char* name, auto value) {
      in_units(add(0, block, name, width,
                   [of, value, width](const Pixel& p) { return wrap_to(value(of(p)), width); }),
               unit, fraction_bits, true);
      signals_.back().meaning = Meaning::first_pixel;
    };
    add_start(scope, "s0_start_v", [](const Series& s) { return s.start.v; });
    add_start(scope, "s0_start_d1", [](const Series& s) { return s.start.d1; });
    add_start(scope + ".last_term", "s0_start", [](const Series& s) { return s.last_term; });
    add(0, scope, "s0_stepping", 1, stepping).meaning = Meaning::first_pixel;
    whole(1, "term", &Series::term);
    whole(1, "next_term", &Series::next_term);
    whole(1, "last_term", &Series::last_term);
    // The carry of a sum of low bits is 1 if the sum is less than what was added. A sum that starts
    // over, after `steps` pixels of a span, has none.
    const auto carry = [&](int stage, std::int64_t Series::*sum, std::int64_t Series::*added,
                           int steps) {
      const std::int64_t mask = (std::int64_t{1} << low) - 1;
      add(stage, scope, at(stage, "carry"), 1, [=](const Pixel& p) {
        return p.step >= steps && (of(p).*sum & mask) < (of(p).*added & mask);
      });
    };
    lower(2, "difference_low", &Series::difference);
    upper(2, "term_high", &Series::term);
    carry(2, &Series::difference, &Series::term, 2);
    upper(3, "difference_high", &Series::difference);
    lower(3, "v_low", &Series::v);
    carry(3, &Series::v, &Series::difference, 1);
    whole(kSeriesStage, "v", &Series::v);
  }
};

}  // namespace

std::vector<DatapathSignal> series_signals(const DatapathConfiguration& configuration) {
  return SeriesTable(configuration).take();
}

}  // namespace phongpipe
