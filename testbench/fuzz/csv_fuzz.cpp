#include "model/files/triangle_csv.h"
#include "testbench/fuzz/fuzz.h"

using namespace phongpipe;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Image image;
  return survive([&] { parse_triangle_csv(std::string(text_of(data, size)), "fuzz.csv", image); });
}
