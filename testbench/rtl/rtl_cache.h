// Where built RTL is kept. It is code that we load, so that the folder belongs to the user alone,
// and each file ends with its own digest, which is checked before it is loaded.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace phongpipe {

// The user's folder, below XDG_CACHE_HOME or the home folder. It is made if there is none, and
// closed to others; libraries in one that others could write to are removed. Throws InputError if
// it belongs to another user, or if there is no home.
std::filesystem::path user_cache();

// Appends the digest of a library that was built. Throws ToolError if it is not there.
void seal(const std::filesystem::path& library);
// Whether there is a library of this user, or of root, that ends with the digest of what is before
// it. One that is damaged, or was cut, counts as none.
bool is_sealed(const std::filesystem::path& library);

// While it lives, no other process or thread has one for any of the same files: who comes later
// waits, and then finds them built. `waiting` is called if it has to wait.
class BuildLock {
 public:
  // All files are in the folder.
  BuildLock(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files,
            const std::function<void()>& waiting);
  ~BuildLock();
  BuildLock(const BuildLock&) = delete;
  BuildLock& operator=(const BuildLock&) = delete;

 private:
  int lock_file_ = -1;
};

}  // namespace phongpipe
