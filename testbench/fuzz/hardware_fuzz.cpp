#include "testbench/fuzz/fuzz.h"
#include "testbench/hardware/hardware.h"

using namespace phongpipe;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return survive([&] { parse_hardware(std::string(text_of(data, size)), "fuzz.toml"); });
}
