// What is written is whole, in its place, and a failure says why and leaves nothing behind.
#include "testbench/system/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "model/scene/input_error.h"
#include "model/scene/tool_error.h"
#include "testbench/system/process.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

class OutputFile : public ::testing::Test {
 protected:
  OutputFile() : folder_(fs::path(::testing::TempDir()) / fmt::format("output-{}", getpid())) {
    fs::create_directories(folder_);
  }
  ~OutputFile() override {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }

  static std::string content(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  template <typename Error>
  static void expect_error(const std::function<void()>& call, const std::string& message) {
    try {
      call();
      ADD_FAILURE() << "no exception, in place of " << message;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  }
  // Neither writing nor the check beforehand finds a place, and nothing changes.
  void expect_no_place(const fs::path& file, const std::string& message) const {
    const auto before = names();
    expect_error<InputError>([&] { check_writable(file); }, message);
    expect_error<InputError>([&] { write_text(file, "text"); }, message);
    EXPECT_EQ(names(), before);
  }
  void expect_written(const fs::path& file, const std::string& text) const {
    check_writable(file);
    write_text(file, text);
    EXPECT_EQ(content(file), text);
  }

  fs::path folder_;
};

TEST_F(OutputFile, IsMadeOrReplaced) {
  expect_written(folder_ / "a.txt", std::string("one\0two", 7));
  expect_written(folder_ / "a.txt", "three");
  expect_written(folder_ / "b", "");
  EXPECT_EQ(names(), (std::vector<std::string>{"a.txt", "b"}));
}

TEST_F(OutputFile, ANameWithoutAFolderIsInTheCurrentOne) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  expect_written("here.txt", "text");
  fs::current_path(before);
  EXPECT_EQ(names(), std::vector<std::string>{"here.txt"});
}

TEST_F(OutputFile, ANewOneHasThePermissionsThatTheUserWants) {
  const mode_t before = umask(027);
  write_text(folder_ / "a", "text");
  umask(before);
  EXPECT_EQ(fs::status(folder_ / "a").permissions(), fs::perms(0640));
}

TEST_F(OutputFile, AnExistingOneKeepsItsPermissions) {
  const fs::path file = folder_ / "a";
  for (const auto permissions : {fs::perms(0600), fs::perms(0666), fs::perms(0755)}) {
    write_text(file, "old");
    fs::permissions(file, permissions);
    expect_written(file, "new");
    EXPECT_EQ(fs::status(file).permissions(), permissions);
  }
}

TEST_F(OutputFile, ASymbolicLinkStaysOne) {
  fs::create_directory(folder_ / "inner");
  fs::create_symlink("inner/there", folder_ / "second");
  fs::create_symlink(folder_ / "second", folder_ / "first");
  expect_written(folder_ / "first", "to a new file");
  expect_written(folder_ / "first", "to an old one");
  EXPECT_TRUE(fs::is_symlink(folder_ / "first"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "second"));
  EXPECT_EQ(content(folder_ / "inner" / "there"), "to an old one");
}

TEST_F(OutputFile, DevicesAreWrittenThrough) {
  check_writable("/dev/null");
  write_text("/dev/null", "text");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  check_writable("/dev/full");
  expect_error<ToolError>([] { write_text("/dev/full", "text"); },
                          "/dev/full: cannot be written: No space left on device");
}

TEST_F(OutputFile, ANamedPipeIsWrittenThrough) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  check_writable(pipe);
  Child reader([&] { return content(pipe); });
  write_text(pipe, "through the pipe");
  EXPECT_EQ(reader.get(), "through the pipe");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(OutputFile, ASocketIsNotReplaced) {
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  const std::string path = (folder_ / "socket").string();
  ASSERT_LT(path.size(), sizeof address.sun_path);
  path.copy(address.sun_path, path.size());
  ASSERT_EQ(bind(socket, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  expect_error<InputError>([&] { write_text(path, "text"); }, "No such device or address");
  EXPECT_TRUE(fs::is_socket(path));
  close(socket);
}

// As with `--json /dev/stdout > file` and `--json file > file`: nothing is lost, in order.
TEST_F(OutputFile, AFileThatIsStandardOutputIsWrittenThrough) {
  const fs::path file = folder_ / "out";
  for (const fs::path& name : {fs::path("/dev/stdout"), file}) {
    Child child([&] {
      if (std::freopen(file.c_str(), "w", stdout) == nullptr) return "";
      std::fputs("before ", stdout);
      check_writable(name);
      write_text(name, "between ");
      print_or_throw("after");
      return "";
    });
    child.get();
    EXPECT_EQ(content(file), "before between after");
  }
}

TEST_F(OutputFile, ABadPlaceIsBadInput) {
  std::ofstream(folder_ / "file") << "old";
  fs::create_symlink("loop", folder_ / "loop");
  fs::create_symlink("nosuch/file", folder_ / "astray");
  expect_no_place(folder_, ": cannot be written: Is a directory");
  expect_no_place(folder_ / "", ": cannot be written: Is a directory");
  expect_no_place("", ": cannot be written: No such file or directory");
  expect_no_place(folder_ / "nosuch" / "a.txt",
                  fmt::format("there is no folder {}/nosuch", folder_.string()));
  expect_no_place(folder_ / "nosuch" / "", "there is no folder");
  expect_no_place(folder_ / "astray", "there is no folder");
  expect_no_place(folder_ / "file" / "a.txt", "Not a directory");
  expect_no_place(folder_ / "loop", "Too many levels of symbolic links");
  expect_no_place(folder_ / std::string(300, 'x'), "File name too long");
  EXPECT_EQ(content(folder_ / "file"), "old");
}

// In a child that is not root, who may change anything.
TEST_F(OutputFile, WhatMayNotBeChangedIsNot) {
  constexpr uid_t kNobody = 65534;
  if (geteuid() == 0) {
    ASSERT_EQ(chown(folder_.c_str(), kNobody, kNobody), 0);
  }
  Child child([&]() -> std::string {
    if (geteuid() == 0 && setuid(kNobody) != 0) return "root";
    const fs::path file = folder_ / "file";
    std::ofstream(file) << "old";
    fs::permissions(file, fs::perms(0444));
    expect_no_place(file, "file: cannot be written: Permission denied");
    fs::permissions(file, fs::perms(0644));
    fs::permissions(folder_, fs::perms(0555));
    expect_no_place(file, "Permission denied");
    expect_no_place(folder_ / "new", "Permission denied");
    return HasFailure() ? "" : content(file);
  });
  EXPECT_EQ(child.get(), "old");
}

TEST_F(OutputFile, TheNameIsShownHarmless) {
  expect_no_place("/nosuch/\n\x1b[2J", "/nosuch/\\n\\x1b[2J: cannot be written");
}

// The limit holds in a child only.
TEST_F(OutputFile, NothingIsLeftWhereTheDiskOrALimitEnds) {
  write_text(folder_ / "old", "old");
  for (const char* name : {"old", "new"}) {
    Child child([&]() -> std::string {
      const rlimit few = {1000, 1000};
      setrlimit(RLIMIT_FSIZE, &few);
      write_text(folder_ / name, std::string(10000, 'x'));
      return "written";
    });
    expect_error<ToolError>([&] { child.get(); }, "cannot be written: File too large");
  }
  EXPECT_EQ(names(), std::vector<std::string>{"old"});
  EXPECT_EQ(content(folder_ / "old"), "old");
}

TEST_F(OutputFile, ALostReportIsAnError) {
  for (const char* early : {"", "printed before"}) {
    Child child([&]() -> std::string {
      if (std::freopen("/dev/full", "w", stdout) == nullptr) return "";
      std::fputs(early, stdout);
      if (*early != '\0') std::fflush(stdout);
      print_or_throw(*early == '\0' ? "report" : "");
      return "";
    });
    expect_error<ToolError>([&] { child.get(); }, "standard output: cannot be written: ");
  }
  Child closed([]() -> std::string {
    close(STDOUT_FILENO);
    print_or_throw("report");
    return "";
  });
  expect_error<ToolError>([&] { closed.get(); }, "Bad file descriptor");
}

TEST_F(OutputFile, AReportArrives) {
  Child child([&] {
    if (std::freopen((folder_ / "out").c_str(), "w", stdout) == nullptr) return "";
    print_or_throw("one\n");
    print_or_throw("two\n");
    return "";
  });
  child.get();
  EXPECT_EQ(content(folder_ / "out"), "one\ntwo\n");
}

}  // namespace
}  // namespace phongpipe
