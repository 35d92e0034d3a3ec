// Guards: what keeps hard cases from wrong pixels. Each counts where it decides: pixels, triangles
// or messages that are other without it. So a run shows that its case needs the guard.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/fixed/model_frame.h"
#include "model/fixed/prepared_frame.h"

namespace phongpipe {

struct GuardedFrame {
  const PreparedFrame& prepared;
  const ModelFrame& model;
};

struct Guard {
  std::string_view name, meaning;
  std::string_view counts;  // "pixel", "triangle", …
  // Null for a guard that is not inside a frame: kRefusal, kSettings, kStalls.
  std::uint64_t (*count)(const GuardedFrame&);
};

// Of these the run itself tells whether they decide.
constexpr std::string_view kRefusal = "refusal";    // bad input is refused by name
constexpr std::string_view kSettings = "settings";  // with other settings pixels err by more
constexpr std::string_view kStalls = "stalls";      // back-pressure costs time and no pixel

const std::vector<Guard>& guards();
const Guard* find_guard(std::string_view name);  // null if there is none
std::string guard_names();

}  // namespace phongpipe
