// Checks a PLY file, ASCII or binary. The mesh library accepts truncated files, NaN and indices out
// of range.
#pragma once

#include <filesystem>

namespace phongpipe {

// Throws InputError at the first error, with its line for an ASCII file.
void check_ply(const std::filesystem::path& file);

}  // namespace phongpipe
