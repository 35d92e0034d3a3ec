// What each form of the reflection equation costs the setup engine.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "model/shading/quadratics/reflection_series.h"
#include "sim/schedule.h"

namespace phongpipe {
namespace {

Dataflow record(const ReflectionForm& form) {
  Recording recording;
  const Interpolator<Recorded> interpolate({}, {});
  const Corners<Recorded> normal, eye, light;
  reflection_series(form, interpolate, normal, eye, light, ReflectionTerms<Recorded>{});
  return recording.dataflow();
}

std::vector<ReflectionForm> all_forms() {
  std::vector<ReflectionForm> forms;
  for (int bits = 0; bits < 32; ++bits) {
    ReflectionForm form;
    form.point_light = (bits & 1) != 0;
    form.attenuated = (bits & 2) != 0;
    form.spot_factor = (bits & 4) != 0;
    form.local_viewer = (bits & 8) != 0;
    form.highlight = (bits & 16) != 0 ? Highlight::reflection : Highlight::halfway;
    if ((form.attenuated || form.spot_factor) && !form.point_light) continue;
    for (int fit = 0; fit < 4; ++fit) {
      form.fit = static_cast<SeriesFit>(fit);
      forms.push_back(form);
    }
  }
  return forms;
}

std::string name(const ReflectionForm& form) {
  return fmt::format("{} {}{}, {} viewer, {}, {}", form.point_light ? "point" : "directional",
                     form.attenuated ? "attenuated " : "", form.spot_factor ? "spot" : "light",
                     form.local_viewer ? "local" : "infinite",
                     form.highlight == Highlight::halfway ? "N.H" : "R.V",
                     series_fit_names()[static_cast<std::size_t>(form.fit)]);
}

TEST(ReflectionCost, OfEveryForm) {
  for (const ReflectionForm& form : all_forms()) {
    const Dataflow dataflow = record(form);
    const OperationCounts n = dataflow.counts();
    const int cycles = schedule_cycles(dataflow, PipelineConfiguration());
    fmt::print("{}: {} add, {} multiply, {} rsqrt, {} power, {} cycles\n", name(form), n.add,
               n.multiply, n.rsqrt, n.power, cycles);
    EXPECT_GT(cycles, 0);
    EXPECT_EQ(n.divide + n.sqrt + n.read, 0U) << "no such unit";
    EXPECT_EQ(n.power > 0, form.attenuated || form.spot_factor) << name(form);
  }
}

TEST(ReflectionCost, WithoutAHighlightIsThatOfTheLight) {
  for (ReflectionForm form : all_forms()) {
    form.wanted = {true, false};
    const OperationCounts light = record(form).counts();
    // Nothing that only a highlight asks for is looked at.
    ReflectionForm plain = form;
    plain.local_viewer = false;
    plain.highlight = Highlight::halfway;
    EXPECT_EQ(light, record(plain).counts()) << name(form);
    const bool six = form.fit == SeriesFit::six_point;
    const std::size_t points = six ? 6 : 9;
    if (form.fit != SeriesFit::taylor) {
      EXPECT_EQ(light.power, form.spot_factor ? points : 0) << name(form);
      // 1/|det|, and at each point 1/|N|, 1/|L| and one for 1/(c + l d + q d²).
      const std::size_t roots = 1U + (form.point_light ? 1U : 0U) + (form.attenuated ? 1U : 0U);
      EXPECT_EQ(light.rsqrt, 1 + points * roots) << name(form);
    }
  }
}

TEST(ReflectionCost, OfBothIsLessThanOfOneAfterTheOther) {
  for (ReflectionForm form : all_forms()) {
    const OperationCounts both = record(form).counts();
    form.wanted = {true, false};
    const OperationCounts light = record(form).counts();
    form.wanted = {false, true};
    const OperationCounts highlight = record(form).counts();
    EXPECT_LE(light.multiply, both.multiply) << name(form);
    EXPECT_LE(highlight.multiply, both.multiply) << name(form);
    EXPECT_LT(both.multiply, light.multiply + highlight.multiply) << name(form);
    EXPECT_LT(both.rsqrt, light.rsqrt + highlight.rsqrt) << name(form);
    EXPECT_LE(highlight.add, both.add) << name(form);
  }
}

}  // namespace
}  // namespace phongpipe
