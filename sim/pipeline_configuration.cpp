#include "sim/pipeline_configuration.h"

#include <fmt/format.h>

#include "model/scene/input_error.h"

namespace phongpipe {
namespace {

void require_range(const char* key, int value, int low, int high) {
  if (value < low || value > high) {
    throw InputError(fmt::format("{} = {} is out of range: {} to {}", key, value, low, high));
  }
}

void check_units(const char* name, const Units& units) {
  require_range(fmt::format("setup_engine.{}", name).c_str(), units.count, 1, 64);
  require_range(fmt::format("setup_engine.{}_latency", name).c_str(), units.latency, 1, 100);
  require_range(fmt::format("setup_engine.{}_interval", name).c_str(), units.interval, 1, 100);
}

}  // namespace

void PipelineConfiguration::check() const {
  check_units("adders", adders);
  check_units("multipliers", multipliers);
  check_units("rsqrt", rsqrt);
  check_units("power_units", power);
  require_range("span_walker.triangle_cycles", walker_triangle_cycles, 1, 1000);
  require_range("span_walker.row_cycles", walker_row_cycles, 1, 1000);
  require_range("framebuffer.write_cycles", framebuffer_write_cycles, 1, 1000);
  require_range("framebuffer.test_cycles", framebuffer_test_cycles, 1, 1000);
  require_range("framebuffer.add_cycles", framebuffer_add_cycles, 1, 1000);
  require_range("framebuffer.depth_bits", depth_bits, 8, 30);
  require_range("queues.triangles", triangle_fifo, 1, 4096);
  require_range("queues.spans", span_fifo, 1, 4096);
  require_range("queues.pixels", pixel_fifo, 1, 4096);
}

}  // namespace phongpipe
