// --help, --help-settings and --help-metrics.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "testbench/cosim/metrics.h"
#include "testbench/hardware/hardware.h"
#include "testbench/tests/commands/program.h"

namespace phongpipe {
namespace {

TEST_F(Program, HelpHasAnExampleAtEachLevel) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"verify", "--help"},
                                                    {"render", "--help"},
                                                    {"compare", "--help"},
                                                    {"sweep", "--help"},
                                                    {"regress", "--help"},
                                                    {"explain", "--help"},
                                                    {"export", "--help"},
                                                    {"merge", "--help"},
                                                    {"report", "--help"}}) {
    const ProcessOutput output = run(arguments);
    EXPECT_EQ(output.status, 0);
    EXPECT_NE(output.text.find("Example: phongpipe"), std::string::npos) << output.text;
    for (const char* jargon : {"FLOAT:", "DIR:", "POSITIVE", " INT", "UINT"}) {
      EXPECT_EQ(output.text.find(jargon), std::string::npos) << output.text;
    }
  }
}

TEST_F(Program, HelpSettingsExplainsEachWithThePresetsValue) {
  const Hardware preset = load_hardware("default", {});
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--help-settings"}, {"verify", "--help-settings"}}) {
    const ProcessOutput output = run(arguments);
    EXPECT_EQ(output.status, 0);
    for (const Setting<Hardware>& setting : hardware_settings()) {
      const std::string shown = fmt::format("  {} = {} ", setting.key, setting.value(preset));
      EXPECT_NE(output.text.find(shown), std::string::npos) << shown;
      EXPECT_NE(output.text.find(setting.meaning), std::string::npos) << setting.name();
    }
  }
}

TEST_F(Program, HelpMetricsExplainsEach) {
  const ProcessOutput output = run({"--help-metrics"});
  EXPECT_EQ(output.status, 0);
  for (const Metric& metric : metrics()) {
    EXPECT_NE(output.text.find(fmt::format("  {} ", metric.name)), std::string::npos)
        << metric.name;
    EXPECT_NE(output.text.find(metric.meaning), std::string::npos) << metric.name;
  }
}

}  // namespace
}  // namespace phongpipe
