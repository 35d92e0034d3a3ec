// Fitted models, and what happens without the tools that place and route.
#include <gtest/gtest.h>

#include <cstdlib>

#include "model/scene/tool_error.h"
#include "testbench/synthesis/fitted_model.h"
#include "testbench/synthesis/place_and_route.h"
#include "testbench/system/installation.h"

namespace phongpipe {
namespace {

std::vector<DatapathConfiguration> some_configurations() {
  std::vector<DatapathConfiguration> all;
  for (const int channels : {1, 3}) {
    for (const int diffuse : {4, 9, 16, 23, 30}) {
      for (const int address : {6, 10, 12, 13}) {
        DatapathConfiguration c;
        c.channels = channels;
        c.diffuse_fraction_bits = diffuse;
        c.rom_address_bits = address;
        all.push_back(c);
      }
    }
  }
  return all;
}

TEST(FittedModel, FindsALinearRule) {
  const auto configurations = some_configurations();
  std::vector<double> values;
  for (const DatapathConfiguration& c : configurations) {
    values.push_back(50 + 3 * c.channels * c.diffuse_width() + 2 * c.specular_width());
  }
  const FittedModel model = fit_model(configurations, values, area_features("pixel_datapath"));
  EXPECT_LT(model.relative_error, 1e-6);
  DatapathConfiguration other;
  other.diffuse_fraction_bits = 19;
  EXPECT_NEAR(model.value(other), 50 + 3 * other.diffuse_width() + 2 * other.specular_width(),
              1e-6);
}

// The error is that of designs which the model has not seen, not of those which it was fitted to.
TEST(FittedModel, StatesTheErrorOfAnOutlier) {
  const auto configurations = some_configurations();
  std::vector<double> values(configurations.size(), 100);
  values[7] = 150;
  EXPECT_GT(fit_model(configurations, values, area_features("pixel_datapath")).relative_error, 0.3);
}

TEST(PlaceAndRoute, SaysWhatToInstallWithoutTheTools) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nosuch", 1);
  try {
    const Netlist netlist(datapath_target({}), installation().hardware);
    ADD_FAILURE() << "synthesised without yosys";
  } catch (const ToolError& error) {
    EXPECT_EQ(std::string(error.what()), "yosys is not installed; install the package yosys");
  }
  setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace phongpipe
