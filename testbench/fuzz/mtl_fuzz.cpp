#include "model/files/meshes/mtl_reader.h"
#include "testbench/fuzz/fuzz.h"

using namespace phongpipe;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> notes;
  return survive([&] { read_mtl("fuzz.mtl", text_of(data, size), notes); });
}
