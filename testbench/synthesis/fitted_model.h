// Linear models of what was placed and routed.
#pragma once

#include <string_view>
#include <vector>

#include "testbench/hardware/technology.h"

namespace phongpipe {

// Least squares with these of the synthesis_features(), weighted so that relative errors count; its
// relative_error is the largest of a design when the model is fitted to all others. As many values
// as configurations, two or more.
FittedModel fit_model(const std::vector<DatapathConfiguration>& configurations,
                      const std::vector<double>& values,
                      const std::vector<std::string_view>& features);

// Those for areas, which are all for pixel_datapath, of which most designs are known. A clock is
// that of one path, and depends on less.
std::vector<std::string_view> area_features(std::string_view module);
std::vector<std::string_view> clock_features(std::string_view module);

}  // namespace phongpipe
