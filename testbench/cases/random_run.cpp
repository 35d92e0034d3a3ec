#include "testbench/cases/random_run.h"

#include <fmt/format.h>

#include <algorithm>

#include "testbench/cases/random_scene.h"
#include "testbench/system/random.h"

namespace phongpipe {
namespace {

constexpr int kMostLatency = 20;  // larger values only make the simulation longer

std::string random_value(Random& random, const Setting<Hardware>& setting) {
  const int high = setting.unit == "cycles" || setting.unit == "items"
                       ? std::min(setting.high, kMostLatency)
                       : setting.high;
  const int choice = random.integer(0, 5);
  const int value = choice == 0   ? setting.low
                    : choice == 1 ? high
                                  : random.integer(setting.low, high);
  return setting.text(value);
}

}  // namespace

RunRequest random_run(std::uint64_t seed, std::uint64_t index) {
  Random random(seed ^ (index * 0x9e3779b97f4a7c15));
  RunRequest run;
  run.scene = fmt::format("{}{}", kRandomScene, random.below(std::uint64_t{1} << 32));
  static constexpr const char* kPresets[] = {"default", "paper-1k", "paper-8k"};
  run.hardware = kPresets[random.below(std::size(kPresets))];
  run.settings.emplace_back("technology=generic");
  // Most runs leave most settings as they are, so that one cause stands out; some change all.
  const int one_in = random.integer(0, 3) == 0 ? 1 : 8;
  for (const Setting<Hardware>& setting : hardware_settings()) {
    if (setting.key == "max_error") continue;
    const std::string value = random_value(random, setting);
    if (random.integer(1, one_in) == 1) run.settings.push_back(setting.name() + "=" + value);
  }
  // Certified errors want full precision, and a limit that can be had.
  static constexpr const char* kLimits[] = {"0.6", "1", "3", "12"};
  const std::string limit = kLimits[random.below(std::size(kLimits))];
  const bool rounded = std::any_of(
      run.settings.begin(), run.settings.end(),
      [](const std::string& setting) { return setting.find("mantissa_bits") != setting.npos; });
  if (!rounded && random.integer(0, 2) == 0) run.settings.push_back("max_error=" + limit);
  run.options.budget_ns = 1e9;
  run.options.detail = random.integer(0, 1) == 0 ? Detail::span : Detail::cycle;
  if (random.integer(0, 2) == 0) run.options.stall_percent = random.integer(1, 60);
  run.options.seed = static_cast<std::uint32_t>(random.integer(0, 1'000'000));
  run.options.effects = random.integer(0, 5) == 0 ? EffectsToVerify::both : EffectsToVerify::scene;
  return run;
}

}  // namespace phongpipe
