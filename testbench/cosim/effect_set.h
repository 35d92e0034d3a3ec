// The effects that a scene uses, and those left out, by their names in reports.
#pragma once

#include <string>
#include <vector>

#include "model/fixed/frame_setup.h"

namespace phongpipe {

struct EffectSet {
  std::vector<std::string> used, left_out;
};

EffectSet effects_of(const FrameSetup& frame);

}  // namespace phongpipe
