#include "testbench/rtl/rtl_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <set>
#include <string_view>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "model/scene/tool_error.h"
#include "testbench/system/output_file.h"
#include "testbench/system/sha256.h"
#include "testbench/system/terminal.h"

namespace phongpipe {
namespace fs = std::filesystem;
namespace {

// Before the digest at a library's end.
constexpr std::string_view kSealMark = "phongpipe-sha256";

std::string digest_of(std::string_view bytes) {
  const Sha256 digest = sha256(bytes);
  return {digest.begin(), digest.end()};
}

fs::path cache_home() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0') {
    return cache;
  }
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home == '\0') {
    const passwd* const user = getpwuid(geteuid());
    home = user == nullptr ? nullptr : user->pw_dir;
  }
  if (home == nullptr || *home == '\0') {
    throw InputError("there is no home folder to keep built RTL in; set HOME or XDG_CACHE_HOME");
  }
  return fs::path(home) / ".cache";
}

// A place in the file of locks for each name; two names may share one, and then wait for each other
// in vain.
off_t place_of(const fs::path& file) {
  off_t place = 0;
  std::memcpy(&place, digest_of(file.filename().string()).data(), sizeof place);
  return place & 0x3FFFFFFFFFFFFFFF;
}

// Whether the byte could be locked, with F_OFD_SETLK, or could after some time, with F_OFD_SETLKW.
bool lock_byte(int file, off_t place, int command) {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = place;
  lock.l_len = 1;
  int result = 0;
  do {
    result = fcntl(file, command, &lock);
  } while (result != 0 && errno == EINTR);
  return result == 0;
}

}  // namespace

fs::path user_cache() {
  const fs::path home = cache_home();
  fs::path folder = home / "phongpipe";
  std::error_code ignored;  // where there is no room for it, who builds there tells
  fs::create_directories(home, ignored);
  mkdir(folder.c_str(), S_IRWXU);
  struct stat status {};
  if (stat(folder.c_str(), &status) != 0) return folder;
  if (status.st_uid != geteuid()) {
    throw InputError(
        fmt::format("{}: belongs to another user, so that built RTL is not loaded from it; "
                    "XDG_CACHE_HOME can name another folder",
                    printable(folder.string())));
  }
  const bool others_could_write = (status.st_mode & (S_IWGRP | S_IWOTH)) != 0;
  if ((status.st_mode & (S_IRWXG | S_IRWXO)) != 0) chmod(folder.c_str(), S_IRWXU);
  if (others_could_write) {
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      if (entry.path().extension() == ".so") fs::remove(entry.path(), ignored);
    }
  }
  return folder;
}

void seal(const fs::path& library) {
  std::string bytes;
  try {
    bytes = read_whole_file(library);
  } catch (const InputError& error) {  // of ours, not the user's
    throw ToolError(fmt::format("building the RTL failed: {}", printable(error.what())));
  }
  write_text(library, bytes + std::string(kSealMark) + digest_of(bytes));
}

bool is_sealed(const fs::path& library) {
  struct stat status {};
  if (lstat(library.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return false;
  if (status.st_uid != geteuid() && status.st_uid != 0) return false;  // root may install it
  std::string text;
  try {
    text = read_whole_file(library);
  } catch (const InputError&) {
    return false;
  }
  const std::string_view all = text;
  const std::size_t seal_size = kSealMark.size() + sizeof(Sha256);
  if (all.size() < seal_size) return false;
  const std::string_view bytes = all.substr(0, all.size() - seal_size);
  return all.substr(bytes.size()) == std::string(kSealMark) + digest_of(bytes);
}

BuildLock::BuildLock(const fs::path& folder, const std::vector<fs::path>& files,
                     const std::function<void()>& waiting) {
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  lock_file_ = open((folder / ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (lock_file_ < 0) return;  // nor can anything be built there, which is told then
  std::set<off_t> places;      // in order, so that no two processes wait for each other
  for (const fs::path& file : files) places.insert(place_of(file));
  bool told = false;
  for (const off_t place : places) {
    if (lock_byte(lock_file_, place, F_OFD_SETLK)) continue;
    if (errno != EAGAIN && errno != EACCES) return;  // the file system has no locks
    if (!told) waiting();
    told = true;
    lock_byte(lock_file_, place, F_OFD_SETLKW);
  }
}

BuildLock::~BuildLock() {
  if (lock_file_ < 0) return;
  struct flock all {};  // a child may still have the file open
  all.l_type = F_UNLCK;
  all.l_whence = SEEK_SET;
  fcntl(lock_file_, F_OFD_SETLK, &all);
  close(lock_file_);
}

}  // namespace phongpipe
