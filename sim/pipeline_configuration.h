// Timing of the pipeline: arithmetic units, depths of queues, and the cycles of each block.
#pragma once

#include "model/fixed/setting.h"

namespace phongpipe {

// `count` identical pipelined units. A result is available `latency` cycles after its operands; a
// unit takes new operands every `interval` cycles.
struct Units {
  int count = 1;
  int latency = 1;
  int interval = 1;
};

struct PipelineConfiguration {
  // Units of setup_engine, which processes one triangle at a time.
  Units adders = {2, 2, 1};
  Units multipliers = {2, 3, 1};
  Units rsqrt = {1, 10, 2};
  Units power = {1, 8, 1};

  // Of exact_path, whose other units are as those of setup_engine.
  int exact_adders = 4, exact_multipliers = 6;

  int walker_triangle_cycles = 2;  // from taking a triangle to its first span
  int walker_row_cycles = 1;       // from one span to the next

  int framebuffer_write_cycles = 1;  // a pixel that passes the depth test
  int framebuffer_test_cycles = 1;   // a pixel that fails it, or is hidden in a later pass
  int framebuffer_add_cycles = 1;    // a pixel of a further light: read, added, written

  // Depths of the queues before span_walker, pixel_datapath and framebuffer.
  int triangle_fifo = 4;
  int span_fifo = 8;
  int pixel_fifo = 16;

  static const Settings<PipelineConfiguration>& settings();

  // Throws InputError naming key, value and legal range.
  void check() const;
};

}  // namespace phongpipe
