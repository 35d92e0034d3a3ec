#include "model/files/scene_file.h"
#include "testbench/fuzz/fuzz.h"

using namespace phongpipe;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // Files that it names are looked for where there are none.
  return survive([&] { parse_scene(std::string(text_of(data, size)), "/nonexistent/fuzz.toml"); });
}
