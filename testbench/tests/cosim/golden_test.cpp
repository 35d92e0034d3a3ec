// Every shipped scene on every preset gives the picture and the cycles it has always given. A
// change that is meant to alter results replaces golden.csv, by PHONGPIPE_GOLDEN=FILE cosim_tests
// --gtest_filter=Golden.*, and says why.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "model/files/scene_file.h"
#include "model/files/text_file.h"
#include "model/fixed/prepared_frame.h"
#include "sim/pipeline.h"
#include "testbench/hardware/hardware.h"
#include "testbench/system/fnv_hash.h"
#include "testbench/system/process.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHeader =
    "scene,preset,configuration_hash,frame_hash,frame_cycles,cycles_hash\n";

// One row: hashes of the settings, of the final frame's colours, and of the cycle of every pixel.
std::string measure(const std::string& scene_name, const std::string& preset) {
  const Hardware hardware = load_hardware(preset, {});
  const PreparedFrame frame(load_scene(fs::path(PHONGPIPE_SCENES) / (scene_name + ".toml")),
                            hardware.formats, hardware.setup);
  SimulationOptions options;
  FnvHash cycles_hash, frame_hash;
  options.observe = [&](const ShadedPixel*, const std::int64_t* cycles, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) cycles_hash.add(static_cast<std::uint64_t>(cycles[i]));
  };
  const SimulationResult result = simulate(frame.setup, hardware.pipeline, options);
  for (std::size_t i = 0; i < result.framebuffer.size(); ++i) {
    frame_hash.add(result.framebuffer.color(i));
  }
  return fmt::format("{},{},{},{:016x},{},{:016x}\n", scene_name, preset,
                     configuration_hash(resolved(hardware, frame.setup.configuration)),
                     frame_hash.value(), result.frame_cycles, cycles_hash.value());
}

std::vector<std::string> shipped_scenes() {
  std::vector<std::string> names;
  const fs::path root = PHONGPIPE_SCENES;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".toml") continue;
    names.push_back(fs::relative(entry.path(), root).replace_extension("").string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

TEST(Golden, EveryShippedSceneOnEveryPresetIsWhatItWas) {
  std::string measured = kHeader;
  for (const std::string& scene : shipped_scenes()) {
    for (const char* preset : {"default", "paper-1k", "paper-8k"}) {
      Child child([&] { return measure(scene, preset); });
      measured += child.get();
    }
  }
  if (const char* file = std::getenv("PHONGPIPE_GOLDEN")) std::ofstream(file) << measured;
  const std::string golden =
      read_whole_file(fs::path(PHONGPIPE_SOURCES) / "testbench/tests/cosim/golden.csv");
  LineReader expected(golden), found(measured);
  for (std::string_view a, b; expected.next(a) && found.next(b);) EXPECT_EQ(a, b);
  EXPECT_EQ(golden, measured);
}

}  // namespace
}  // namespace phongpipe
