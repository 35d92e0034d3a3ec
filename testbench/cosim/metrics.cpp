#include "testbench/cosim/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace phongpipe {
namespace {

using Result = VerificationResult;
using Better = Metric::Better;

template <typename Integer>
MetricValue count(Integer value) {
  return static_cast<std::int64_t>(value);
}

std::int64_t sum(const OperationCounts& counts) {
  std::size_t operations = 0;
  for_each_field(counts, [&](std::string_view, std::size_t count) { operations += count; });
  return static_cast<std::int64_t>(operations);
}

std::int64_t sum(const SimulationCounts& counts) {
  std::uint64_t operations = counts.depth_additions;
  for_each_field(counts.pixel_operations,
                 [&](std::string_view, std::uint64_t count) { operations += count; });
  return static_cast<std::int64_t>(operations);
}

// What there is only with RTL.
template <typename Value>
MetricValue of_rtl(const Result& r, Value value) {
  return r.rtl ? MetricValue(static_cast<std::int64_t>(value(*r.rtl))) : MetricValue();
}

double per_triangle(const Result& r, std::int64_t cycles) {
  return r.set_up.set_up == 0 ? 0
                              : static_cast<double>(cycles) / static_cast<double>(r.set_up.set_up);
}

// The pixels of a path of shading.
template <ShadingPath path>
MetricValue pixels_by(const Result& r) {
  return count(r.ledger[path]);
}

std::vector<Metric> all_metrics() {
  constexpr auto kLess = Better::less, kMore = Better::more, kNeither = Better::neither;
  return {
      {"triangles_read", "/triangles_read", "", kNeither, "triangles of the meshes",
       [](const Result& r) { return count(r.triangles_read); }},
      {"triangles", "/triangles", "", kNeither, "of them left after clipping and culling",
       [](const Result& r) { return count(r.triangles); }},
      {"triangles_split", "/subdivision/triangles", "", kNeither,
       "of them that turn too sharply for one series, and are split",
       [](const Result& r) { return count(r.triangles_split); }},
      {"pieces", "/subdivision/pieces", "", kNeither, "triangles that these became",
       [](const Result& r) { return count(r.pieces); }},
      {"triangles_set_up", "/triangles_set_up", "", kNeither,
       "that cover a pixel, pieces for those split, once for each light",
       [](const Result& r) { return count(r.set_up.set_up); }},
      {"triangles_left_out", "/triangles_left_out", "", kNeither,
       "of them, found to add nothing to their pixels",
       [](const Result& r) { return count(r.set_up.left_out); }},
      {"pixels", "/pixels", "", kNeither, "pixels shaded, hidden ones and all lights included",
       [](const Result& r) { return count(r.pixels); }},
      {"taylor_pixels", "/ledger/taylor", "", kNeither, "of them, by Taylor series",
       pixels_by<ShadingPath::taylor>},
      {"six_point_pixels", "/ledger/six_point", "", kNeither, "of them, by fits at six points",
       pixels_by<ShadingPath::six_point>},
      {"weighted_pixels", "/ledger/weighted", "", kNeither, "of them, by weighted fits",
       pixels_by<ShadingPath::weighted>},
      {"focused_pixels", "/ledger/focused", "", kNeither, "of them, by focused fits",
       pixels_by<ShadingPath::focused>},
      {"subdivided_pixels", "/ledger/subdivided", "", kNeither,
       "of them, by any fit on pieces of triangles that were split",
       pixels_by<ShadingPath::subdivided>},
      {"exact_path_pixels", "/ledger/exact_path", "", kNeither, "of them, one by one by exact_path",
       pixels_by<ShadingPath::exact_path>},
      {"refused_pixels", "/ledger/refused", "", kLess,
       "of them, by exact_path where even that proves no error", pixels_by<ShadingPath::refused>},
      {"visible_pixels", "/visible_pixels", "", kNeither, "pixels of the image that are covered",
       [](const Result& r) { return count(r.accuracy.visible_pixels); }},

      {"rtl_mismatches", "/mismatches/model_rtl", "", kLess,
       "pixels shaded by the RTL that are not the model's, counted up to 100",
       [](const Result& r) {
         return of_rtl(r, [](const ImplementationResult& rtl) { return rtl.stream_mismatches; });
       }},
      {"systemc_mismatches", "/mismatches/model_systemc", "", kLess,
       "pixels shaded in SystemC that are not the model's, counted up to 100",
       [](const Result& r) { return count(r.systemc.stream_mismatches); }},
      {"rtl_frame_mismatches", "/mismatches/frame_rtl", "", kLess,
       "pixels of the final frame with the RTL that are not the model's",
       [](const Result& r) {
         return of_rtl(r, [](const ImplementationResult& rtl) { return rtl.frame_mismatches; });
       }},
      {"systemc_frame_mismatches", "/mismatches/frame_systemc", "", kLess,
       "pixels of the final frame in SystemC that are not the model's",
       [](const Result& r) { return count(r.systemc.frame_mismatches); }},
      {"coefficient_overflows", "/coefficient_overflows", "", kLess,
       "triangles with values that do not fit their registers",
       [](const Result& r) { return count(r.set_up.overflows); }},

      {"frame_cycles", "/cycles/frame", "cycles", kLess, "of the whole frame",
       [](const Result& r) { return count(r.systemc.counts.frame_cycles); }, true},
      {"cycle_difference", "/cycles/difference", "cycles", kLess,
       "that the frame takes more with the RTL than in SystemC",
       [](const Result& r) { return r.rtl ? count(r.cycle_difference()) : MetricValue(); }},
      {"datapath_cycles_rtl", "/cycles/datapath_rtl", "cycles", kLess,
       "until the RTL has delivered the last pixel",
       [](const Result& r) {
         return of_rtl(r,
                       [](const ImplementationResult& rtl) { return rtl.counts.datapath_cycles; });
       }},
      {"datapath_cycles_systemc", "/cycles/datapath_systemc", "cycles", kLess,
       "until SystemC's pixel_datapath has delivered the last pixel",
       [](const Result& r) { return count(r.systemc.counts.datapath_cycles); }},
      {"setup_cycles", "/cycles/setup", "cycles", kLess, "in which the setup engine was at work",
       [](const Result& r) { return count(r.systemc.counts.setup_cycles); }},
      {"setup_cycles_per_triangle", "/cycles/setup_per_triangle", "cycles", kLess,
       "of the setup engine for a triangle, on average",
       [](const Result& r) -> MetricValue {
         return per_triangle(r, r.systemc.counts.setup_cycles);
       }},
      {"rom_load_cycles", "/cycles/rom_load", "cycles", kLess,
       "in which tables of highlights were loaded",
       [](const Result& r) { return count(r.systemc.counts.rom_load_cycles); }},
      {"clock_ns", "/clock_ns", "ns", kLess, "clock period of the technology",
       [](const Result& r) -> MetricValue { return r.clock.ns; }, true},
      {"luts", "/area/luts", "", kLess, "of pixel_datapath in the technology",
       [](const Result& r) { return r.area ? count(r.area->luts) : MetricValue(); }, true},
      {"registers", "/area/registers", "", kLess, "of pixel_datapath in the technology, in bits",
       [](const Result& r) { return r.area ? count(r.area->registers) : MetricValue(); }, true},
      {"block_rams", "/area/block_rams", "", kLess, "of pixel_datapath, where they were measured",
       [](const Result& r) {
         return r.area && r.area->block_rams ? count(*r.area->block_rams) : MetricValue();
       }},
      {"datapath_ns_per_pixel", "/ns_per_pixel/datapath", "ns", kLess,
       "time in which the RTL's datapath was occupied, over the pixels shaded",
       [](const Result& r) {
         return r.rtl ? MetricValue(r.datapath_ns_per_pixel()) : MetricValue();
       }},
      {"frame_ns_per_pixel", "/ns_per_pixel/frame", "ns", kLess,
       "time of the whole frame, over the pixels shaded",
       [](const Result& r) -> MetricValue { return r.frame_ns_per_pixel(); }},

      {"max_lsb", "/accuracy/max_lsb", "LSB", kLess, "largest error against exact Phong shading",
       [](const Result& r) -> MetricValue { return r.accuracy.total.largest_lsb; }},
      {"certified_error_lsb", "/certified_error_lsb", "LSB", kLess,
       "proved for every pixel by setup_engine.max_error; none without it",
       [](const Result& r) -> MetricValue {
         return r.certified_error_lsb ? MetricValue(*r.certified_error_lsb) : MetricValue();
       }},
      {"rms_lsb", "/accuracy/rms_lsb", "LSB", kLess, "root of the mean squared error",
       [](const Result& r) -> MetricValue { return r.accuracy.total.rms_lsb(); }},
      {"psnr_db", "/accuracy/psnr_db", "dB", kMore,
       "peak signal to noise ratio; none without error",
       [](const Result& r) -> MetricValue { return r.accuracy.total.psnr_db(); }},
      {"over_half", "/accuracy/over_half", "", kLess, "share of pixels off by more than ½ LSB",
       [](const Result& r) -> MetricValue {
         return r.accuracy.total.share(r.accuracy.total.over_half);
       }},
      {"over_one", "/accuracy/over_one", "", kLess, "share of pixels off by more than 1 LSB",
       [](const Result& r) -> MetricValue {
         return r.accuracy.total.share(r.accuracy.total.over_one);
       }},
      {"over_two", "/accuracy/over_two", "", kLess, "share of pixels off by more than 2 LSB",
       [](const Result& r) -> MetricValue {
         return r.accuracy.total.share(r.accuracy.total.over_two);
       }},
      {"visibility_max_lsb", "/accuracy_split/visibility/max_lsb", "LSB", kLess,
       "largest error by showing another triangle than the nearest",
       [](const Result& r) -> MetricValue { return r.accuracy.visibility.largest_lsb; }},
      {"visibility_rms_lsb", "/accuracy_split/visibility/rms_lsb", "LSB", kLess,
       "root of its mean square",
       [](const Result& r) -> MetricValue { return r.accuracy.visibility.rms_lsb(); }},
      {"series_max_lsb", "/accuracy_split/series/max_lsb", "LSB", kLess,
       "largest error by the second-degree series for the exact reflection",
       [](const Result& r) -> MetricValue { return r.accuracy.series.largest_lsb; }},
      {"series_rms_lsb", "/accuracy_split/series/rms_lsb", "LSB", kLess, "root of its mean square",
       [](const Result& r) -> MetricValue { return r.accuracy.series.rms_lsb(); }},
      {"rounding_max_lsb", "/accuracy_split/rounding/max_lsb", "LSB", kLess,
       "largest error by rounded coefficients and starts of spans",
       [](const Result& r) -> MetricValue { return r.accuracy.rounding.largest_lsb; }},
      {"rounding_rms_lsb", "/accuracy_split/rounding/rms_lsb", "LSB", kLess,
       "root of its mean square",
       [](const Result& r) -> MetricValue { return r.accuracy.rounding.rms_lsb(); }},
      {"rom_max_lsb", "/accuracy_split/rom/max_lsb", "LSB", kLess,
       "largest error by index and word of the exponent ROM",
       [](const Result& r) -> MetricValue { return r.accuracy.rom.largest_lsb; }},
      {"rom_rms_lsb", "/accuracy_split/rom/rms_lsb", "LSB", kLess, "root of its mean square",
       [](const Result& r) -> MetricValue { return r.accuracy.rom.rms_lsb(); }},
      {"rom_error", "/rom_error", "", kLess,
       "largest error of the power's tables, as a share of a full highlight",
       [](const Result& r) -> MetricValue { return r.rom_error; }},
      {"output_max_lsb", "/accuracy_split/output/max_lsb", "LSB", kLess,
       "largest error by rounding to 8 bits",
       [](const Result& r) -> MetricValue { return r.accuracy.output.largest_lsb; }},
      {"output_rms_lsb", "/accuracy_split/output/rms_lsb", "LSB", kLess, "root of its mean square",
       [](const Result& r) -> MetricValue { return r.accuracy.output.rms_lsb(); }},

      {"adders", "", "", kLess, "of the datapath",
       [](const Result& r) { return count(r.configuration.adders()); }, true},
      {"multipliers", "", "", kLess, "of the datapath",
       [](const Result& r) { return count(r.configuration.multipliers()); }, true},
      {"register_bits", "", "bits", kLess, "of the datapath's series",
       [](const Result& r) { return count(r.configuration.register_bits()); }, true},
      {"rom_bits", "", "bits", kLess, "of the exponent ROM, all channels and lanes",
       [](const Result& r) { return count(r.configuration.rom_bits()); }, true},
      {"setup_operations", "", "", kLess,
       "additions, multiplications, 1/√ and powers of the setup engine",
       [](const Result& r) { return count(sum(r.systemc.counts.setup_operations)); }, true},
      {"pixel_operations", "", "", kLess, "additions, multiplications and ROM reads of all pixels",
       [](const Result& r) { return count(sum(r.systemc.counts)); }, true},
      {"simulation_seconds", "", "s", kLess, "processor time that SystemC took here",
       [](const Result& r) -> MetricValue { return r.systemc.processor_seconds; }, true},
  };
}

}  // namespace

const std::vector<Metric>& metrics() {
  static const std::vector<Metric> all = all_metrics();
  return all;
}

std::size_t metric_index(std::string_view name) {
  const auto& all = metrics();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const Metric& metric) { return metric.name == name; });
  if (found == all.end()) throw std::out_of_range(fmt::format("no metric {}", name));
  return static_cast<std::size_t>(found - all.begin());
}

std::optional<double> number_of(const MetricValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* number = std::get_if<double>(&value)) return *number;
  return std::nullopt;
}

std::string metric_text(const MetricValue& value) {
  if (std::holds_alternative<std::monostate>(value)) return "-";
  if (const double* number = std::get_if<double>(&value)) return fmt::format("{:.4g}", *number);
  std::string digits = fmt::format("{}", std::get<std::int64_t>(value));
  const std::size_t first = digits.front() == '-' ? 1 : 0;
  for (std::size_t at = digits.size(); at > first + 3; at -= 3) digits.insert(at - 3, ",");
  return digits;
}

void for_each_block_metric(const VerificationResult& r,
                           const std::function<void(const Metric&, const MetricValue& own,
                                                    const MetricValue& full)>& visit) {
  VerificationResult full;
  if (r.full_hardware) {
    full.pixels = r.pixels;
    full.configuration = {r.full_hardware->datapath, r.configuration};
    full.clock = r.hardware.technology.clock(r.full_hardware->datapath);
    full.area = r.hardware.technology.area(r.full_hardware->datapath);
    full.systemc = r.full_hardware->systemc;
  }
  for (const Metric& metric : metrics()) {
    if (metric.of_blocks) visit(metric, metric.value(r), metric.value(full));
  }
}

std::string count_text(std::uint64_t count) {
  return metric_text(static_cast<std::int64_t>(count));
}

std::string count_text(std::uint64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count_text(count), noun, count == 1 ? "" : "s");
}

std::string overflow_text(std::uint64_t triangles) {
  return fmt::format("values of {} do not fit their registers", count_text(triangles, "triangle"));
}

std::string mismatches_text(const ImplementationResult& found, std::uint64_t pixels) {
  const std::string of_stream =
      fmt::format("{} of {}", count_text(found.stream_mismatches), count_text(pixels, "pixel"));
  if (found.stopped()) return of_stream + ", and no more were counted";
  return fmt::format("{}, {} of the final frame", of_stream, count_text(found.frame_mismatches));
}

}  // namespace phongpipe
