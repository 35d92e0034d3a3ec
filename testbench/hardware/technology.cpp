#include "testbench/hardware/technology.h"

#include <fmt/format.h>

#include <algorithm>

#include "model/files/toml_reader.h"
#include "model/scene/input_error.h"
#include "testbench/system/installation.h"

namespace phongpipe {
namespace {

using Point = Technology::Point;

// The first point of the given table size that is wide enough, or null.
const Point* wide_enough(const std::vector<Point>& points, int address_bits, int width) {
  const auto found = std::find_if(points.begin(), points.end(), [&](const Point& point) {
    return point.address_bits == address_bits && point.width >= width;
  });
  return found == points.end() ? nullptr : &*found;
}

const Point* point_at(const std::vector<Point>& points, int address_bits, int width) {
  const Point* point = wide_enough(points, address_bits, width);
  return point != nullptr && point->width == width ? point : nullptr;
}

// What tables of `address_bits` cost over those of `base_bits`, at a width where both are known.
double table_penalty(const std::vector<Point>& points, int base_bits, int address_bits) {
  for (const Point& point : points) {
    if (point.address_bits != address_bits) continue;
    const Point* base = point_at(points, base_bits, point.width);
    if (base != nullptr) return point.clock_ns - base->clock_ns;
  }
  throw InputError(
      fmt::format("no width with both {} and {} address bits", base_bits, address_bits));
}

}  // namespace

double Technology::clock_ns(const DatapathConfiguration& configuration) const {
  if (points.empty()) return fixed_clock_ns;
  const int width = std::max(configuration.diffuse_width(), configuration.specular_width());
  std::vector<int> sizes;
  for (const Point& point : points) sizes.push_back(point.address_bits);
  std::sort(sizes.begin(), sizes.end());
  int table_bits = 0;  // the table has up to 2^this words
  while (1 << table_bits < configuration.rom_bases()) ++table_bits;
  const auto size = std::lower_bound(sizes.begin(), sizes.end(), table_bits);
  const Point* base = wide_enough(points, sizes.front(), width);
  if (size == sizes.end() || base == nullptr) {
    throw InputError(fmt::format(
        "technology {} has no clock for {} bits and a ROM of 2^{} words; choose a smaller "
        "configuration or the card `generic`",
        name, width, table_bits));
  }
  const bool larger_table = *size != sizes.front();
  const double ns =
      base->clock_ns + (larger_table ? table_penalty(points, sizes.front(), *size) : 0);
  return configuration.depth_cue ? std::max(ns, depth_cue_clock_ns) : ns;
}

Technology load_technology(const std::string& name) {
  const auto file = find_named(name, installation().hardware / "technology", "technology card");
  const TomlTable table = TomlTable::read_file(file);
  Technology technology;
  technology.name = table.text("name");
  technology.source = table.text("source");
  const NumberRange nanoseconds = {0.001, 1e6};
  if (table.has("clock_ns")) {
    table.refuse("clock", "a card has either clock_ns or [[clock]] points");
    technology.fixed_clock_ns = table.number("clock_ns", nanoseconds);
  } else {
    for (const TomlTable& point : table.tables("clock")) {
      technology.points.push_back({point.integer("width", 1, 64),
                                   point.integer("address_bits", 1, 20),
                                   point.number("ns", nanoseconds)});
      point.finish();
    }
    technology.depth_cue_clock_ns = table.number("depth_cue_ns", nanoseconds, 0);
    std::sort(technology.points.begin(), technology.points.end(),
              [](const Point& a, const Point& b) { return a.width < b.width; });
    // Fail at the card, not at the configuration that happens to need the missing pair.
    for (const Point& point : technology.points) {
      table_penalty(technology.points, technology.points.front().address_bits, point.address_bits);
    }
  }
  table.finish();
  return technology;
}

}  // namespace phongpipe
