// Prepares a scene for the hardware in two steps: its geometry, which frames of different hardware
// share; then subdivision, blocks and setup of the frame.
#pragma once

#include <memory>
#include <utility>

#include "model/fixed/certificate.h"
#include "model/fixed/frame_setup.h"
#include "model/scene/subdivision.h"

namespace phongpipe {

// A geometry whose triangles were subdivided, and what is known of it.
struct SubdividedGeometry {
  Subdivision subdivision;
  std::unique_ptr<GeometryMemo> memo;  // or null
};

// A scene with its triangles on the screen.
class PreparedScene {
 public:
  const Scene scene;
  const Geometry geometry;  // not subdivided

  // `many_frames`: what frames have in common is kept for the next ones, which costs a single one
  // more than it saves.
  explicit PreparedScene(Scene scene_, bool many_frames = false)
      : scene(std::move(scene_)), geometry(make_geometry(scene)), many_frames_(many_frames) {}

  // Keeps the last one for frames that ask for the same. One thread at a time may call it, and use
  // what it returns.
  std::shared_ptr<const SubdividedGeometry> subdivided(int subdivide_degrees) const {
    if (!last_ || subdivide_degrees != last_degrees_) {
      auto fresh = std::make_shared<SubdividedGeometry>();
      fresh->subdivision = subdivide(scene, geometry, subdivide_degrees);
      if (many_frames_) {
        fresh->memo = std::make_unique<GeometryMemo>(fresh->subdivision.geometry.triangles.size(),
                                                     scene.lights.size());
      }
      last_ = std::move(fresh);
      last_degrees_ = subdivide_degrees;
    }
    return last_;
  }

 private:
  mutable std::shared_ptr<const SubdividedGeometry> last_;
  mutable int last_degrees_ = 0;
  bool many_frames_;
};

// All data of a frame before its first triangle is set up. `setup` refers to the other members, so
// the object cannot be moved.
struct PreparedFrame {
  std::shared_ptr<const PreparedScene> prepared;
  std::shared_ptr<const SubdividedGeometry> subdivided;  // by the policy
  FrameSetup setup;

  // Throws InputError if the scene uses what the pipeline does not simulate.
  PreparedFrame(std::shared_ptr<const PreparedScene> prepared_, const FixedPointFormats& formats,
                const SetupPolicy& policy, Effects effects = Effects::derived)
      : prepared(std::move(prepared_)),
        subdivided(policy.certifies() ? split_for_certificate(*prepared, formats, policy, effects)
                                      : prepared->subdivided(policy.subdivide_degrees)),
        // The analyser does not look into FrameSetup's constructor, which is in another file.
        // NOLINTNEXTLINE(clang-analyzer-optin.cplusplus.UninitializedObject)
        setup(scene(), geometry(),
              {{formats, required_blocks(formats, policy, scene(), geometry(), effects)}, policy},
              effects, subdivided->memo.get()) {
    if (policy.certifies()) setup.certificates = certify(setup);
  }
  PreparedFrame(Scene scene_, const FixedPointFormats& formats, const SetupPolicy& policy,
                Effects effects = Effects::derived)
      : PreparedFrame(std::make_shared<const PreparedScene>(std::move(scene_)), formats, policy,
                      effects) {}
  PreparedFrame(const PreparedFrame&) = delete;
  PreparedFrame& operator=(const PreparedFrame&) = delete;

  // The blocks that the scene's effects and the policy require: exact_path shows its pixels through
  // the diffuse series.
  static EffectBlocks required_blocks(const FixedPointFormats& formats, const SetupPolicy& policy,
                                      const Scene& scene, const Geometry& geometry,
                                      Effects effects) {
    EffectBlocks blocks = derive_blocks(formats, scene, geometry, effects);
    blocks.diffuse = blocks.diffuse || policy.certifies();
    return blocks;
  }

  const Scene& scene() const { return prepared->scene; }
  const Subdivision& subdivision() const { return subdivided->subdivision; }
  const Geometry& geometry() const { return subdivision().geometry; }

 private:
  // By the certificates of the frame of whole triangles.
  static std::shared_ptr<const SubdividedGeometry> split_for_certificate(
      const PreparedScene& prepared, const FixedPointFormats& formats, const SetupPolicy& policy,
      Effects effects) {
    const FrameSetup whole(
        prepared.scene, prepared.geometry,
        {{formats, required_blocks(formats, policy, prepared.scene, prepared.geometry, effects)},
         policy},
        effects);
    const Certifier certifier(whole);
    auto result = std::make_shared<SubdividedGeometry>();
    result->subdivision =
        subdivide(prepared.geometry, [&](const ScreenTriangle& triangle, int levels) {
          return certifier.wants_split(triangle, levels);
        });
    return result;
  }
};

}  // namespace phongpipe
