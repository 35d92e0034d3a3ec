// Reports of the life of a pixel: on the screen, and as JSON for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "testbench/trace/pixel_story.h"

namespace phongpipe {

// The answer in five lines, then everything else.
std::string pixel_text(const PixelStory& story);

nlohmann::ordered_json pixel_json(const PixelStory& story);

}  // namespace phongpipe
