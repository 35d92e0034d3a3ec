// Hard cases: small scenes, each of which breaks something in an engine without a certain guard.
// The head of the file says what, in lines that begin with `#!`; without them it is TOML:
//
//   breaks    what goes wrong without the guard
//   must      what happens in place of it
//   guard     the name of the guard, see guards()
//   hardware  preset, and
//   settings  of the hardware, as for --set: optional
//   without   for guard = "settings": the settings in whose place the case's own are the guard
//   max_error_lsb   that the case must keep; 4 if it is left out
//   refused   for guard = "refusal": a part of the message with which the input is refused
//   stall     random back-pressure, per cent of the pixels
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "model/scene/scene.h"

namespace phongpipe {

struct HardCase {
  std::string name;  // its place in the folder, without .toml
  std::filesystem::path file;
  std::string breaks, must, guard;
  std::string hardware = "default";
  std::vector<std::string> settings, without;
  double max_error_lsb = 4;
  std::string refused;
  int stall_percent = 0;
};

// The shipped cases, by name.
std::vector<HardCase> hard_cases();

// For names of tests.
inline std::ostream& operator<<(std::ostream& out, const HardCase& hard_case) {
  return out << hard_case.name;
}

// Throws InputError if the head is not as above.
HardCase load_hard_case(const std::filesystem::path& file, const std::string& name);

}  // namespace phongpipe
