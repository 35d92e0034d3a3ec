// Files and scenes the scene tests are made of.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "model/scene/input_error.h"
#include "model/scene/scene.h"

namespace phongpipe {

// A folder of this process, removed at its end.
class TempFolder {
 public:
  TempFolder()
      : path_(std::filesystem::path(::testing::TempDir()) /
              ("phongpipe-scene-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~TempFolder() { std::filesystem::remove_all(path_); }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// What the InputError says without the folder, or "no error".
template <class Action>
std::string error_of(const TempFolder& folder, Action action) {
  try {
    action();
  } catch (const InputError& error) {
    std::string message = error.what();
    const std::string prefix = folder.path().string() + "/";
    for (std::size_t at = message.find(prefix); at != std::string::npos;
         at = message.find(prefix)) {
      message.erase(at, prefix.size());
    }
    return message;
  }
  return "no error";
}

// A scene of one sphere under one light, to be changed by the test.
inline Scene sphere_scene() {
  Scene scene;
  scene.image.width = 64;
  scene.image.height = 64;
  scene.lights.emplace_back();
  scene.objects.emplace_back();
  scene.objects.back().primitive = "sphere";
  return scene;
}

}  // namespace phongpipe
