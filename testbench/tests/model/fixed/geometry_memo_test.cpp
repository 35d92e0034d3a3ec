// geometry_memo: frames that share what is known of their geometry are those that compute it anew.
#include "model/fixed/geometry_memo.h"

#include <gtest/gtest.h>

#include "model/fixed/prepared_frame.h"
#include "testbench/accuracy/accuracy.h"
#include "testbench/cases/named_scene.h"
#include "testbench/cases/random_run.h"
#include "testbench/cosim/run.h"
#include "testbench/hardware/hardware.h"

namespace phongpipe {
namespace {

TEST(GeometryMemo, ComputesOnceWhatThereIsRoomFor) {
  GeometryMemo memo(3, 1, 3 * sizeof(Color) + sizeof(RowSpan));
  int computed = 0;
  const auto colors = [&](Color* first) {
    ++computed;
    first[0] = first[1] = Color(computed, 0, 0);
  };
  EXPECT_EQ(memo.exact_colors(0, 0, colors), nullptr);  // covers nothing
  for (int i = 0; i < 2; ++i) {
    const Color* const kept = memo.exact_colors(0, 2, colors);
    ASSERT_NE(kept, nullptr);
    EXPECT_EQ(kept[1][0], 1);
    EXPECT_EQ(memo.exact_colors(1, 2, colors), nullptr);  // room for one more
  }
  EXPECT_EQ(computed, 1);
  std::vector<RowSpan> rows;
  const auto cover = [&](std::vector<RowSpan>& fresh) { fresh.assign(2, {++computed, 0, 1}); };
  for (int i = 0; i < 2; ++i) memo.cover(0, rows, cover);
  EXPECT_EQ(rows.front().x, 2);
  for (int i = 0; i < 2; ++i) memo.cover(1, rows, cover);
  EXPECT_EQ(rows.front().x, 4) << "kept without room";
}

TEST(GeometryMemo, FramesOfOneSceneAreAsIfEachWereAlone) {
  constexpr std::uint64_t kSeed = 17, kScenes = 12, kFrames = 8;
  SCOPED_TRACE(kSeed);
  std::size_t compared = 0;
  for (std::uint64_t s = 0; s < kScenes; ++s) {
    const Scene scene = load_named_scene(random_run(kSeed, s).scene, {});
    const auto shared = std::make_shared<const PreparedScene>(scene, true);
    for (std::uint64_t f = 0; f < kFrames; ++f) {
      SCOPED_TRACE(testing::Message() << "scene " << s << ", hardware " << f);
      const RunRequest request = random_run(kSeed, s * kFrames + f);
      std::vector<std::string> settings;  // of the hardware
      for (const std::string& setting : request.settings) {
        if (setting.rfind("scene.", 0) != 0) settings.push_back(setting);
      }
      const Hardware hardware = load_hardware(request.hardware, settings);
      const Effects effects = f % 4 == 0 ? Effects::all : Effects::derived;
      std::optional<PreparedFrame> with_others, alone;
      try {
        with_others.emplace(shared, hardware.formats, hardware.setup, effects);
        alone.emplace(scene, hardware.formats, hardware.setup, effects);
      } catch (const InputError&) {
        continue;  // this hardware does not shade this scene
      }
      const ModelFrame a = run_model(with_others->setup), b = run_model(alone->setup);
      ASSERT_EQ(a.colors(), b.colors());
      ASSERT_EQ(a.triangles.left_out, b.triangles.left_out);
      const Accuracy error = measure_accuracy(with_others->setup, a, {false}),
                     same = measure_accuracy(alone->setup, b, {false});
      ASSERT_EQ(error.total.sum_of_squares, same.total.sum_of_squares);
      ASSERT_EQ(error.series.sum_of_squares, same.series.sum_of_squares);
      ++compared;
    }
  }
  EXPECT_GT(compared, kScenes * kFrames / 2);
}

}  // namespace
}  // namespace phongpipe
