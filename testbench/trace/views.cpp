#include "testbench/trace/views.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

namespace phongpipe {
namespace {

bool is_shown(const WaveVariable& variable) {
  // Every value is shown once, and in the scope `lsb` all of them are there again.
  return variable.scope.find(".lsb.") == std::string::npos && !variable.real;
}

// "rtl.pixel_datapath" of "phongpipe.rtl.pixel_datapath", for headings.
std::string block_of(const WaveVariable& variable) {
  const std::size_t dot = variable.scope.find('.');
  return dot == std::string::npos ? variable.scope : variable.scope.substr(dot + 1);
}

std::uint64_t time_of(const RecordedTrace& trace, std::int64_t cycle) {
  return static_cast<std::uint64_t>(cycle) * trace.period_ps;
}

// Calls `visit` for each variable that is shown; `heading` is called before the first of a block.
void for_each_shown(const RecordedTrace& trace,
                    const std::function<void(const std::string&)>& heading,
                    const std::function<void(const WaveVariable&)>& visit) {
  std::string block;
  for (const WaveVariable& variable : trace.variables) {
    if (!is_shown(variable)) continue;
    if (block_of(variable) != block) heading(block = block_of(variable));
    visit(variable);
  }
}

}  // namespace

std::string gtkwave_view(const RecordedTrace& trace, const CycleWindow& shown,
                         const std::filesystem::path& trace_file) {
  // Flags of GTKWave: decimal, right-justified, signed, shifted by fpshift_count.
  constexpr int kDecimal = 0x4, kRight = 0x20, kSigned = 0x400, kFixedPoint = 0x40000000;
  constexpr int kBits = 0x8, kHex = 0x2, kHeading = 0x200;
  constexpr double kPixels = 1000;  // of the window that GTKWave opens
  const std::uint64_t begin = time_of(trace, shown.first), end = time_of(trace, shown.last + 1);
  const double zoom = -std::log2(200 * static_cast<double>(end - begin) / kPixels);
  std::string text = fmt::format("[dumpfile] \"{}\"\n[timestart] {}\n[size] 1400 900\n",
                                 trace_file.filename().string(), begin);
  text += fmt::format("*{:.6f}", zoom);
  // The primary marker, then those called A to Z; −1 where there is none.
  constexpr std::size_t kMarkers = 27;
  for (std::size_t i = 0; i < kMarkers; ++i) {
    text += i < trace.markers.size() ? fmt::format(" {}", time_of(trace, trace.markers[i].cycle))
                                     : std::string(" -1");
  }
  text += "\n";
  for (std::size_t i = 1; i < std::min(kMarkers, trace.markers.size()); ++i) {
    text +=
        fmt::format("[markername] {}{}\n", static_cast<char>('A' + i - 1), trace.markers[i].name);
  }
  for_each_shown(
      trace,
      [&](const std::string& block) { text += fmt::format("@{:x}\n-{}\n", kHeading, block); },
      [&](const WaveVariable& variable) {
        if (variable.fraction_bits > 0) {
          const int sign = variable.is_signed ? kSigned : 0;
          text += fmt::format("@{:x}\n[fpshift_count] {}\n", kFixedPoint | kDecimal | kRight | sign,
                              variable.fraction_bits);
        } else if (variable.width == 1) {
          text += fmt::format("@{:x}\n", kBits | kRight);
        } else {
          text += fmt::format("@{:x}\n", (variable.width > 32 ? kHex : kDecimal) | kRight);
        }
        text += variable.full_name() + variable.range() + "\n";
      });
  return text;
}

std::string surfer_view(const RecordedTrace& trace) {
  // Items are counted in hexadecimal digits written a to p.
  const auto item = [](std::size_t index) {
    std::string digits;
    do {
      digits.insert(digits.begin(), static_cast<char>('a' + index % 16));
    } while ((index /= 16) > 0);
    return digits;
  };
  std::string text, formats;
  std::size_t items = 0;
  for_each_shown(
      trace,
      [&](const std::string& block) {
        text += fmt::format("divider_add {}\n", block);
        ++items;
      },
      [&](const WaveVariable& variable) {
        text += fmt::format("variable_add {}\n", variable.full_name());
        if (variable.fraction_bits > 0) {
          formats += fmt::format("item_focus {}_\nitem_set_format {} fixed point\nitem_unfocus\n",
                                 item(items), variable.is_signed ? "Signed" : "Unsigned");
        }
        ++items;
      });
  text += formats;
  for (const TraceMarker& marker : trace.markers) {
    std::string name = marker.name;
    for (char& c : name) {
      if (c == ' ' || c == ',') c = '_';
    }
    text += fmt::format("marker_set {} {}\n", name, time_of(trace, marker.cycle));
  }
  if (!trace.markers.empty()) {
    text += fmt::format("cursor_set {}\n", time_of(trace, trace.markers.front().cycle));
  }
  return text + "zoom_fit\n";
}

}  // namespace phongpipe
