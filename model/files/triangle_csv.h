// Triangles in screen space, from and to CSV.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/scene/geometry.h"

namespace phongpipe {

// The header must be x0,y0,z0,nx0,ny0,nz0,x1,…,nz2; each row below it is a triangle, and blank
// lines are skipped. x and y are snapped to the grid of 1/256 pixel and may lie up to kGuardBand
// pixels beyond the image. Normals are made unit. The eye is at infinity and looks along +z, so the
// vector to it is (0, 0, -1); a position is the pixel and z.
std::vector<ScreenTriangle> read_triangle_csv(const std::filesystem::path& file,
                                              const Image& image);

// The same of a text; `file` is what messages call it, and `line_before` the line of the file above
// the first of the text.
std::vector<ScreenTriangle> parse_triangle_csv(const std::string& text,
                                               const std::filesystem::path& file,
                                               const Image& image, unsigned line_before = 0);

// The columns above, then ex0,…,ez2 (surface to eye), l0x0,… for each light (surface to light), and
// material, its name. Numbers are printed so that reading them back gives the same doubles.
std::string triangles_csv(const Scene& scene, const Geometry& geometry);

}  // namespace phongpipe
