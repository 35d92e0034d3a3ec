// Prepares a scene for the hardware in two steps: its geometry, which frames of different hardware
// share; then subdivision, blocks and setup of the frame.
#pragma once

#include <memory>
#include <utility>

#include "model/fixed/frame_setup.h"
#include "model/scene/subdivision.h"

namespace phongpipe {

// A scene with its triangles on the screen, not subdivided.
struct PreparedScene {
  Scene scene;
  Geometry geometry;

  explicit PreparedScene(Scene scene_) : scene(std::move(scene_)), geometry(make_geometry(scene)) {}
};

// All data of a frame before its first triangle is set up. `setup` refers to the other members, so
// the object cannot be moved.
struct PreparedFrame {
  std::shared_ptr<const PreparedScene> prepared;
  Subdivision subdivision;  // of the scene's triangles, by the policy
  FrameSetup setup;

  // Throws InputError if the scene uses what the pipeline does not simulate.
  PreparedFrame(std::shared_ptr<const PreparedScene> prepared_, const FixedPointFormats& formats,
                const SetupPolicy& policy, Effects effects = Effects::derived)
      : prepared(std::move(prepared_)),
        subdivision(subdivide(scene(), prepared->geometry, policy.subdivide_degrees)),
        // The analyser does not look into FrameSetup's constructor, which is in another file.
        // NOLINTNEXTLINE(clang-analyzer-optin.cplusplus.UninitializedObject)
        setup(scene(), subdivision.geometry,
              {{formats, derive_blocks(formats, scene(), subdivision.geometry, effects)}, policy},
              effects) {}
  PreparedFrame(Scene scene_, const FixedPointFormats& formats, const SetupPolicy& policy,
                Effects effects = Effects::derived)
      : PreparedFrame(std::make_shared<const PreparedScene>(std::move(scene_)), formats, policy,
                      effects) {}
  PreparedFrame(const PreparedFrame&) = delete;
  PreparedFrame& operator=(const PreparedFrame&) = delete;

  const Scene& scene() const { return prepared->scene; }
  const Geometry& geometry() const { return subdivision.geometry; }
};

}  // namespace phongpipe
