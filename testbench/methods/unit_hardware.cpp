#include "testbench/methods/unit_hardware.h"

#include <algorithm>
#include <stdexcept>

#include "testbench/methods/operation_time.h"

namespace phongpipe {

std::optional<UnitHardware> unit_hardware(const OperationCounts& pixel,
                                          const Technology& technology) {
  if (technology.units.empty()) return {};
  UnitHardware hardware;
  const auto add = [&](std::string_view operation, std::size_t count) {
    if (count == 0) return;
    const auto unit = std::find_if(technology.units.begin(), technology.units.end(),
                                   [&](const MeasuredUnit& u) { return u.operation == operation; });
    if (unit == technology.units.end()) {
      throw std::logic_error("a card with units has all of them");
    }
    const auto units = static_cast<int>(count);
    hardware.luts += units * unit->design.luts;
    hardware.registers += units * unit->design.registers;
    hardware.block_rams += units * unit->design.block_rams;
    hardware.clock_ns = std::max(hardware.clock_ns, unit->design.clock_ns);
  };
  const Roots roots = roots_of(pixel);
  add("add", pixel.add);
  add("multiply", pixel.multiply + roots.pairs + roots.roots);
  add("divide", roots.divisions);
  add("rsqrt", pixel.rsqrt + roots.pairs + roots.roots);
  add("power", pixel.power + pixel.read);
  return hardware;
}

}  // namespace phongpipe
