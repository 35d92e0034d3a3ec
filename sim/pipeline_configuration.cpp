#include "sim/pipeline_configuration.h"

namespace phongpipe {
namespace {

using P = PipelineConfiguration;

// The three settings of one kind of unit of the setup engine.
void add_units(Settings<P>& all, Units P::*units, std::string_view count_key,
               std::string_view latency_key, std::string_view interval_key,
               std::string_view meaning) {
  const std::string_view section = "setup_engine";
  all.push_back(number_setting(section, count_key, &Units::count, "", 1, 64, meaning).of(units));
  all.push_back(number_setting(section, latency_key, &Units::latency, "cycles", 1, 100,
                               "from their operands to the result")
                    .of(units));
  all.push_back(number_setting(section, interval_key, &Units::interval, "cycles", 1, 100,
                               "from one start of a unit to the next")
                    .of(units));
}

Settings<P> all_settings() {
  Settings<P> all;
  add_units(all, &P::adders, "adders", "adders_latency", "adders_interval",
            "adders of the setup engine");
  add_units(all, &P::multipliers, "multipliers", "multipliers_latency", "multipliers_interval",
            "multipliers of the setup engine");
  add_units(all, &P::rsqrt, "rsqrt", "rsqrt_latency", "rsqrt_interval",
            "units for 1/√x of the setup engine");
  add_units(all, &P::power, "power_units", "power_units_latency", "power_units_interval",
            "units for powers of the setup engine");
  all.push_back(number_setting("exact_path", "exact_adders", &P::exact_adders, "", 1, 64,
                               "adders of the unit that shades pixel by pixel, for max_error"));
  all.push_back(number_setting("exact_path", "exact_multipliers", &P::exact_multipliers, "", 1, 64,
                               "its multipliers"));
  all.push_back(number_setting("span_walker", "triangle_cycles", &P::walker_triangle_cycles,
                               "cycles", 1, 1000, "from taking a triangle to its first span"));
  all.push_back(number_setting("span_walker", "row_cycles", &P::walker_row_cycles, "cycles", 1,
                               1000, "from one span to the next"));
  all.push_back(number_setting("framebuffer", "write_cycles", &P::framebuffer_write_cycles,
                               "cycles", 1, 1000, "for a pixel that passes the depth test"));
  all.push_back(number_setting("framebuffer", "test_cycles", &P::framebuffer_test_cycles, "cycles",
                               1, 1000, "for a pixel that fails the depth test"));
  all.push_back(number_setting("framebuffer", "add_cycles", &P::framebuffer_add_cycles, "cycles", 1,
                               1000, "for a pixel of a further light: read, added, written"));
  all.push_back(number_setting("queues", "triangles", &P::triangle_fifo, "items", 1, 4096,
                               "depth of the queue before span_walker"));
  all.push_back(number_setting("queues", "spans", &P::span_fifo, "items", 1, 4096,
                               "depth of the queue before pixel_datapath"));
  all.push_back(number_setting(
      "queues", "pixels", &P::pixel_fifo, "items", 1, 4096,
      "depth of the queue before framebuffer; of wide datapaths in groups of pixels"));
  return all;
}

}  // namespace

const Settings<PipelineConfiguration>& PipelineConfiguration::settings() {
  static const Settings<P> all = all_settings();
  return all;
}

void PipelineConfiguration::check() const {
  check_settings(settings(), *this);
}

}  // namespace phongpipe
