// The timeline of a frame, for Perfetto and as a picture.
#pragma once

#include <string>

#include "testbench/trace/timeline.h"

namespace phongpipe {

// Chrome trace events, which Perfetto opens. One cycle is shown as 1 µs.
std::string timeline_json(const Timeline& timeline, const std::string& scene);

// SVG, on white: what each module does over the frame, and for which share of it.
std::string timeline_picture(const Timeline& timeline, const std::string& scene);

}  // namespace phongpipe
