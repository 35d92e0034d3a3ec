// Checks a Wavefront OBJ file line by line. The mesh library accepts NaN and mixes faces with and
// without normals silently, and names no line for what it does refuse.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace phongpipe {

struct ObjFacts {
  bool some_normals_missing = false;           // at least one face has no normals
  std::vector<std::string> missing_libraries;  // notes: file:line and the MTL file not found
};

// Throws InputError at the first line that is wrong.
ObjFacts check_obj(const std::filesystem::path& file);

}  // namespace phongpipe
