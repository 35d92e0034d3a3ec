#include "testbench/fuzz/fuzz.h"
#include "testbench/trace/capsule.h"

using namespace phongpipe;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // Of any program, and whatever its digest.
  return survive([&] { read_capsule(input_file("capsule.toml", text_of(data, size)), true); });
}
