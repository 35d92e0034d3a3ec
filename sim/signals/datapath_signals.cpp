#include "sim/signals/datapath_signals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "sim/signals/block_signals.h"

namespace phongpipe {

std::string DatapathSignal::block() const {
  return scope.empty() ? "pixel_datapath" : "pixel_datapath." + scope;
}

std::string lane_scope(int k) {
  return fmt::format("lane[{}].datapath", k);
}

bool DatapathSignal::counts(const DatapathRegisters& registers) const {
  if (meaning == Meaning::always) return true;
  if (stage < 0) return registers.before_lanes(stage).has_value();
  const DatapathPixel& pixel = registers.in_stage(stage);
  return pixel.valid && (meaning == Meaning::every_pixel ||
                         (meaning == Meaning::first_pixel) == (pixel.step == 0));
}

double DatapathSignal::real(std::int64_t bits) const {
  return std::ldexp(static_cast<double>(bits), -fraction_bits);
}

namespace {

// Of a datapath, or of a lane of a wide one.
std::vector<DatapathSignal> signals_of_lane(const DatapathConfiguration& configuration) {
  std::vector<DatapathSignal> all = control_signals(configuration);
  const auto append = [&all](std::vector<DatapathSignal> more) {
    std::move(more.begin(), more.end(), std::back_inserter(all));
  };
  append(series_signals(configuration));
  append(color_signals(configuration));
  if (configuration.kind == DatapathKind::serial) append(digit_signals(configuration));
  return all;
}

// The registers before the lanes, and those of each lane.
std::vector<DatapathSignal> wide_signals(const DatapathConfiguration& configuration) {
  std::vector<DatapathSignal> all = lane_start_signals(configuration);
  for (int k = 0; k < configuration.lanes(); ++k) {
    for (DatapathSignal& signal : signals_of_lane(configuration)) {
      signal.scope = lane_scope(k) + (signal.scope.empty() ? "" : "." + signal.scope);
      if (k > 0 && signal.name == "s1_x") {
        signal.is_signed = true;
        signal.unit = kMinusPixelsToCome;
        signal.value = [x = std::move(signal.value)](const DatapathRegisters& r) {
          return wrap_to(x(r), kCoordinateBits);
        };
      }
      signal.value = [value = std::move(signal.value), k](const DatapathRegisters& r) {
        return value(r.lane(static_cast<std::size_t>(k)));
      };
      all.push_back(std::move(signal));
    }
  }
  return all;
}

}  // namespace

std::vector<DatapathSignal> datapath_signals(const DatapathConfiguration& configuration) {
  std::vector<DatapathSignal> all =
      configuration.lanes() == 1 ? signals_of_lane(configuration) : wide_signals(configuration);
  std::stable_sort(all.begin(), all.end(), [](const DatapathSignal& a, const DatapathSignal& b) {
    return a.stage < b.stage;
  });
  return all;
}

}  // namespace phongpipe
