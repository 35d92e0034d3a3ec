// Checks a PLY file, ASCII or binary: the mesh library accepts truncated ones, NaN and indices out
// of range.
#pragma once

#include <filesystem>

namespace phongpipe {

// Throws InputError at the first thing that is wrong, with its line for an ASCII file.
void check_ply(const std::filesystem::path& file);

}  // namespace phongpipe
