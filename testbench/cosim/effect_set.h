// Which effects a scene calls for, by the names reports give them.
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
