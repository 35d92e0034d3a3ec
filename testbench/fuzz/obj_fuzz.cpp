#include "testbench/fuzz/fuzz.h"

using namespace phongpipe;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return survive_mesh(read_obj, text_of(data, size));
}
