// From a scene to the triangles the setup engine receives: transformed, clipped, culled, snapped.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "model/scene/scene.h"

namespace phongpipe {

constexpr int kGridBits = 8;  // vertices sit on a grid of 1/256 pixel
// Extra bits of coordinates, one per level of subdivision, so that midpoints of edges are exact.
constexpr int kSubdivisionLevels = 3;
constexpr int kSubpixels = 1 << (kGridBits + kSubdivisionLevels);  // per pixel
inline double in_pixels(std::int32_t subpixels) {
  return subpixels / static_cast<double>(kSubpixels);
}
constexpr int kGuardBand = 8192;  // largest distance of a vertex from the image, in pixels

struct ScreenVertex {
  std::int32_t x = 0;  // subpixels from the left edge of the image; pixel centres at .5 pixel
  std::int32_t y = 0;  // subpixels from the top edge, downwards
  double z = 0;        // depth, linear in screen space, grows away from the eye: 1 - near/w in
                       // perspective, the distance along the view in an orthographic camera
  Vec3 normal = Vec3::Zero();    // world axes (screen axes for a scene of screen-space triangles);
                                 // unit, except where clipping or subdivision made the vertex
  Vec3 eye = Vec3::Zero();       // surface → eye: true length for a local viewer, else unit
  Vec3 position = Vec3::Zero();  // the surface point, same axes
};

// Triangles of a mesh turn counter-clockwise on the screen, so their signed area is negative.
// Triangles of a CSV file turn either way; their vertices stay in the order of the file.
struct ScreenTriangle {
  std::array<ScreenVertex, 3> vertices;
  std::uint32_t material = 0;  // index into Geometry::materials
  bool piece = false;          // of a triangle that was subdivided
};

struct Geometry {
  std::vector<ScreenTriangle> triangles;  // in the order of the scene; none has zero area
  std::vector<Material> materials;        // those in use, in order of first use
  std::size_t triangles_read = 0;  // before clipping and culling; each is kept (whole or in pieces)
                                   // or counted in one of culled_back_facing, culled_outside and
                                   // degenerate
  std::size_t culled_back_facing = 0;
  std::size_t culled_outside = 0;  // wholly outside the view
  std::size_t clipped = 0;         // kept, but cut by the near plane or the guard band
  std::size_t degenerate = 0;      // zero area after snapping
  std::vector<std::string> notes;  // messages for the user, such as missing normals generated
};

// Rounds to the nearest 1/256 pixel, ties up, so that a shift by whole pixels does not change the
// rounding. Returns subpixels.
std::int32_t snap(double pixels);

// Twice the area in square subpixels, negative where the vertices turn counter-clockwise on the
// screen.
std::int64_t signed_area(const ScreenTriangle& triangle);

// Builds the meshes of primitives, and projects all meshes.
Geometry make_geometry(const Scene& scene);

// Unit vector from the surface to an eye at infinity: against the camera's view, or against z in a
// scene of screen-space triangles.
Vec3 infinite_eye(const Scene& scene);

// The vector from the surface to light i at a vertex: true length for point and spot lights, unit
// for directional ones.
Vec3 light_vector(const Light& light, const ScreenVertex& vertex);

// Distance of the surface from the eye along the view, for depth cueing: in world units, or z in a
// scene of screen-space triangles.
double view_distance(const Scene& scene, const ScreenVertex& vertex);

}  // namespace phongpipe
