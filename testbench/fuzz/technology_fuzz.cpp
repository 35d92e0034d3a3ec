#include "testbench/fuzz/fuzz.h"
#include "testbench/hardware/technology.h"

using namespace phongpipe;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return survive([&] { load_technology(input_file("card.toml", text_of(data, size)).string()); });
}
