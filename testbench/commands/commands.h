// The commands of the program, one file each. Each adds its options to the application, and sets
// `run` when it is the one that was called.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace phongpipe {

using Run = std::function<int()>;  // the exit status: 0 all holds, 1 a check failed

void add_compare(CLI::App& application, Run& run);
void add_render(CLI::App& application, Run& run);
void add_verify(CLI::App& application, Run& run);

// A scene by its file, or by the name of a shipped one. Throws InputError.
std::filesystem::path find_scene(const std::string& name);

// What several commands take.
struct HardwareOptions {
  std::string hardware = "default";
  std::vector<std::string> overrides;

  void add_to(CLI::App& command);
};

// Shows what is being done while it is, on a terminal; silent in a pipe.
class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void operator()(const std::string& what);
  void clear();

 private:
  bool terminal_;
  bool shown_ = false;
};

bool color_wanted();  // standard output is a terminal, and NO_COLOR is not set

}  // namespace phongpipe
