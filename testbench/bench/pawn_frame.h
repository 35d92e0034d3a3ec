// The pawn at 2048×2048, as the benchmarks shade it.
#pragma once

#include <string>

#include "model/files/scene_file.h"
#include "model/fixed/front_end.h"
#include "model/fixed/model_frame.h"
#include "model/fixed/prepared_frame.h"
#include "testbench/hardware/hardware.h"
#include "testbench/system/installation.h"

namespace phongpipe {

struct PawnFrame {
  Hardware hardware;
  PreparedFrame prepared;
  const FrameSetup& frame;
  std::int64_t pixels = 0;

  explicit PawnFrame(int size = 2048) : PawnFrame(load(size), "paper-1k", Effects::derived) {}

  PawnFrame(const Scene& scene, const char* preset, Effects effects)
      : hardware(load_hardware(preset, {})),
        prepared(scene, hardware.formats, hardware.setup, effects),
        frame(prepared.setup) {
    for_each_span([this](const Span& span) { pixels += span.row.length; });
  }

  template <typename Visit>
  void for_each_span(Visit visit) const {
    const FrontEnd front_end(frame);
    TriangleWork work;
    for (TriangleOrder next(front_end); !next.done(); next.advance()) {
      if (front_end.set_up(next.triangle(), next.pass(), work) != SetupOutcome::ready) continue;
      for (const RowSpan& row : work.rows) {
        visit(front_end.span_walker().start(work.setup, row));
      }
    }
  }

  std::vector<Span> spans() const {
    std::vector<Span> result;
    for_each_span([&result](const Span& span) { result.push_back(span); });
    return result;
  }
  const HighlightTable& table() const { return frame.tables.front(); }

  static Scene load(int size) {
    Scene scene = load_scene(installation().scenes / "pawn.toml");
    scene.image.width = scene.image.height = size;
    return scene;
  }
};

inline const PawnFrame& pawn() {
  static const PawnFrame frame;
  return frame;
}

}  // namespace phongpipe
