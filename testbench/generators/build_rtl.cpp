// build_rtl DIR PRESET…: Verilates and compiles pixel_datapath for each preset, in grey and colour,
// and with its signals open, so that nobody has to wait for it later.
#include <fmt/format.h>

#include "testbench/hardware/hardware.h"
#include "testbench/rtl/rtl_library.h"

int main(int argc, char** argv) {
  try {
    phongpipe::RtlBuildOptions options;
    options.destination = argv[1];
    std::vector<phongpipe::DatapathConfiguration> configurations;
    for (int i = 2; i < argc; ++i) {
      const phongpipe::Hardware hardware = phongpipe::load_hardware(argv[i], {});
      for (const int channels : {1, 3}) {
        phongpipe::DatapathConfiguration datapath{hardware.formats, {}};
        datapath.channels = channels;
        datapath.specular_guard_bits = phongpipe::least_specular_guard_bits(datapath.rom_layout);
        configurations.push_back(datapath);
      }
    }
    phongpipe::build_missing_rtl(configurations, options);
    options.build = phongpipe::RtlBuild::signals;  // for traces
    phongpipe::build_missing_rtl(configurations, options);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "build_rtl: {}\n", error.what());
    return 1;
  }
}
