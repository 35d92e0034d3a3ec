// Prepares a scene for the hardware in one step: geometry, subdivision, blocks, setup of the frame.
#pragma once

#include "model/fixed/frame_setup.h"
#include "model/scene/subdivision.h"

namespace phongpipe {

// All data of a frame before its first triangle is set up. `setup` refers to the other members, so
// the object cannot be moved.
struct PreparedFrame {
  Scene scene;
  Subdivision subdivision;  // of the scene's triangles, by the policy
  FrameSetup setup;

  // Throws InputError if the scene uses what the pipeline does not simulate.
  PreparedFrame(Scene scene_, const FixedPointFormats& formats, const SetupPolicy& policy,
                Effects effects = Effects::derived)
      : scene(std::move(scene_)),
        subdivision(subdivide(scene, make_geometry(scene), policy.subdivide_degrees)),
        setup(scene, subdivision.geometry,
              {{formats, derive_blocks(formats, scene, subdivision.geometry, effects)}, policy},
              effects) {}
  PreparedFrame(const PreparedFrame&) = delete;
  PreparedFrame& operator=(const PreparedFrame&) = delete;

  const Geometry& geometry() const { return subdivision.geometry; }
};

}  // namespace phongpipe
