#include "testbench/campaign/plan.h"
#include "testbench/fuzz/fuzz.h"

using namespace phongpipe;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return survive([&] {
    Plan plan;
    read_sweep_file(input_file("plan.toml", text_of(data, size)), plan);
    grid_size(plan);
  });
}
