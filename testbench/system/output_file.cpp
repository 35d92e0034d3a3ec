#include "testbench/system/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>

#include "model/scene/input_error.h"
#include "model/scene/tool_error.h"
#include "testbench/system/terminal.h"

namespace phongpipe {
namespace fs = std::filesystem;
namespace {

constexpr const char* kStandardOutput = "standard output";

std::string message(const std::string& name, const std::string& reason) {
  return fmt::format("{}: cannot be written: {}", printable(name), reason);
}

// The place will not do, or the machine has no room to make a file there.
[[noreturn]] void fail_at_place(const fs::path& file, int error) {
  const std::string text = message(file.string(), std::strerror(error));
  for (const int shortage : {ENOSPC, EDQUOT, EMFILE, ENFILE, ENOMEM, EIO}) {
    if (error == shortage) throw ToolError(text);
  }
  throw InputError(text);
}

// 0, or errno.
int write_all(int file, std::string_view text) {
  std::signal(SIGXFSZ, SIG_IGN);  // beyond the limit of file sizes, write() then fails
  while (!text.empty()) {
    const ssize_t count = write(file, text.data(), text.size());
    if (count >= 0) {
      text.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

struct Place {
  fs::path file;            // behind all links
  bool through = false;     // to be opened as it is
  int descriptor = -1;      // of a standard stream that it is
  struct stat status = {};  // of the file that is replaced; st_mode 0 where there is none
};

// Of links that stat() has followed, so that they come to an end.
fs::path behind_links(fs::path file) {
  std::error_code none;
  while (fs::is_symlink(fs::symlink_status(file, none))) {
    file = file.parent_path() / fs::read_symlink(file);
  }
  return file;
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

// The standard stream that a file is, or -1.
int stream_of(const struct stat& status) {
  for (const int descriptor : {STDOUT_FILENO, STDERR_FILENO}) {
    struct stat stream {};
    if (fstat(descriptor, &stream) == 0 && stream.st_dev == status.st_dev &&
        stream.st_ino == status.st_ino) {
      return descriptor;
    }
  }
  return -1;
}

// Where `file` is written to. Throws where that cannot be.
Place find_place(const fs::path& file) {
  Place place;
  place.file = file;
  if (stat(file.c_str(), &place.status) == 0) {
    if (S_ISDIR(place.status.st_mode)) fail_at_place(file, EISDIR);
    place.descriptor = stream_of(place.status);
    if (place.descriptor >= 0) return place;
    if (access(file.c_str(), W_OK) != 0) fail_at_place(file, errno);
    place.through = !S_ISREG(place.status.st_mode);
    if (place.through) return place;
  } else if (errno != ENOENT) {
    fail_at_place(file, errno);
  }
  place.file = behind_links(file);
  const fs::path folder = folder_of(place.file);
  std::error_code none;
  if (!fs::is_directory(folder, none)) {
    throw InputError(
        message(file.string(), fmt::format("there is no folder {}", printable(folder.string()))));
  }
  if (!place.file.has_filename()) fail_at_place(file, ENOENT);
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    throw InputError(message(file.string(), fmt::format("folder {}: {}", printable(folder.string()),
                                                        std::strerror(errno))));
  }
  return place;
}

// A new file that goes away unless it is put in another's place.
class TemporaryFile {
 public:
  explicit TemporaryFile(const Place& place, const fs::path& named) : named_(named) {
    for (int attempt = 0; descriptor_ < 0; ++attempt) {
      path_ = folder_of(place.file) / fmt::format(".phongpipe-{}-{}", getpid(), attempt);
      descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor_ < 0 && errno != EEXIST) fail_at_place(named, errno);
    }
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!path_.empty()) unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void take_over(const struct stat& status) {
    // Only root may give a file away; where we may not, it is ours.
    [[maybe_unused]] const int ignored = fchown(descriptor_, status.st_uid, status.st_gid);
    if (fchmod(descriptor_, status.st_mode & 07777) != 0) fail_at_place(named_, errno);
  }
  void write(std::string_view text) {
    int error = write_all(descriptor_, text);
    if (close(descriptor_) != 0 && error == 0) error = errno;
    descriptor_ = -1;
    if (error != 0) throw ToolError(message(named_.string(), std::strerror(error)));
  }
  void replace(const fs::path& file) {
    if (rename(path_.c_str(), file.c_str()) != 0) fail_at_place(named_, errno);
    path_.clear();
  }

 private:
  fs::path named_;  // as the user knows it
  fs::path path_;
  int descriptor_ = -1;
};

void write_through(const Place& place, const fs::path& file, std::string_view text) {
  std::fflush(stdout);  // what was printed before comes first
  const int descriptor =
      place.through ? open(file.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY) : place.descriptor;
  if (descriptor < 0) fail_at_place(file, errno);
  const int error = write_all(descriptor, text);
  if (place.through) close(descriptor);
  if (error != 0) throw ToolError(message(file.string(), std::strerror(error)));
}

}  // namespace

void write_text(const fs::path& file, std::string_view text) {
  const Place place = find_place(file);
  if (place.through || place.descriptor >= 0) return write_through(place, file, text);
  TemporaryFile temporary(place, file);
  if (place.status.st_mode != 0) temporary.take_over(place.status);
  temporary.write(text);
  temporary.replace(place.file);
}

void check_writable(const fs::path& file) {
  find_place(file);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw InputError(fmt::format("{}: no folder can be made there: {}", printable(folder.string()),
                                 error.message()));
  }
}

void print_or_throw(std::string_view text) {
  std::signal(SIGXFSZ, SIG_IGN);
  const bool lost_before = std::ferror(stdout) != 0;
  errno = 0;
  const std::size_t count = std::fwrite(text.data(), 1, text.size(), stdout);
  if (count != text.size() || std::fflush(stdout) != 0 || lost_before) {
    throw ToolError(
        message(kStandardOutput, errno != 0 ? std::strerror(errno) : "an earlier write failed"));
  }
}

}  // namespace phongpipe
