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

// The features that the areas of a module are fitted to, and those for its clock: that of one path,
// which depends on less.
std::vector<std::string_view> area_features(std::string_view module);
std::vector<std::string_view> clock_features(std::string_view module);

}  // namespace phongpipe
