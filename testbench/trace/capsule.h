// A capsule: one file with everything that is needed to see a divergence again, elsewhere.
#pragma once

#include <filesystem>
#include <string>

#include "testbench/cosim/verification.h"

namespace phongpipe {

struct Capsule {
  std::string name;            // of the scene, where the capsule was written
  std::string version;         // of the program
  bool same_program = false;   // whether the file of this program wrote it
  std::uint64_t rtl_hash = 0;  // of the RTL that diverged
  Scene scene;
  Hardware hardware;
  VerificationOptions options;
  // What was found: the register or the pixel.
  std::string found;
};

// One line that says where implementations part: the register, or else the pixel. Empty if they do
// not.
std::string divergence_text(const VerificationResult& result);

// The TOML text of a capsule. `scene`: of the result, in which something must diverge.
std::string capsule_text(const Scene& scene, const VerificationResult& result);

// Throws InputError if the file is no capsule, or was changed by hand and not `anyway`.
Capsule read_capsule(const std::filesystem::path& file, bool anyway);

}  // namespace phongpipe
