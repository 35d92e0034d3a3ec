// Children and other programs: results, failures and signals come back, and none outlives us.
#include "testbench/system/process.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>
#include <typeinfo>
#include <vector>

#include "model/scene/input_error.h"
#include "model/scene/tool_error.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

TEST(Process, OutputAndStatusOfAProgram) {
  const ProcessOutput output = run_process({"sh", "-c", "echo out; echo err >&2; exit 3"});
  EXPECT_EQ(output.text, "out\nerr\n");
  EXPECT_EQ(output.status, 3);
  EXPECT_EQ(output.start_error, 0);
}

TEST(Process, AProgramThatASignalEndsHasFailed) {
  EXPECT_EQ(run_process({"sh", "-c", "kill -9 $$"}).status, 128);
}

TEST(Process, AProgramThatCannotBeStartedIsToldFromOneThatFails) {
  const ProcessOutput missing = run_process({"/nosuch/program"});
  EXPECT_EQ(missing.start_error, ENOENT);
  EXPECT_EQ(missing.status, 127);
  EXPECT_EQ(run_process({"/dev/null"}).start_error, EACCES);
  EXPECT_EQ(run_process({"sh", "-c", "exit 127"}).start_error, 0);
}

TEST(Process, RunsInItsFolderWithoutAnInput) {
  EXPECT_EQ(run_process({"pwd"}, "/usr").text, "/usr\n");
  Child with_input([]() -> std::string {
    if (std::freopen("/proc/self/status", "r", stdin) == nullptr) return "no input";
    return run_process({"cat"}).text;
  });
  EXPECT_EQ(with_input.get(), "");
  EXPECT_THROW(run_process({"pwd"}, "/nosuch"), ToolError);
}

TEST(Process, ExitStatusComesBackWhereTheEndOfChildrenIsIgnored) {
  std::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(run_process({"sh", "-c", "exit 3"}).status, 3);
}

// A process between us and `work`, in a group of its own, that ends by a signal in the midst of it.
class Orphans : public ::testing::TestWithParam<int> {
 protected:
  Orphans() : folder_(fs::path(::testing::TempDir()) / fmt::format("orphans-{}", getpid())) {
    fs::create_directories(folder_);
  }
  ~Orphans() override { fs::remove_all(folder_); }

  void leave(pid_t first, pid_t second) const {
    std::ofstream(folder_ / "new") << first << ' ' << second;
    fs::rename(folder_ / "new", folder_ / "pids");
  }
  // A shell that starts `sleep` and waits for it; the process numbers of both are left in a file.
  std::vector<std::string> sleeper() const {
    return {"sh", "-c",
            fmt::format("sleep 300 & echo $$ $! > {0}/new; mv {0}/new {0}/pids; wait",
                        folder_.string())};
  }
  template <typename Work>
  void end_during(const Work& work) {
    const pid_t process = fork();
    if (process == 0) {
      setpgid(0, 0);
      work();
      _exit(0);
    }
    setpgid(process, process);
    ASSERT_TRUE(soon([this] { return fs::exists(folder_ / "pids"); }));
    kill(GetParam() == SIGINT ? -process : process, GetParam());  // Ctrl-C goes to the whole group
    int status = 0;
    waitpid(process, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    std::ifstream file(folder_ / "pids");
    int numbers = 0;
    for (pid_t pid = 0; file >> pid; ++numbers) {
      EXPECT_TRUE(soon([pid] { return has_ended(pid); })) << "process " << pid << " lives on";
      kill(pid, SIGKILL);
    }
    EXPECT_EQ(numbers, 2);
  }

 private:
  template <typename Condition>
  static bool soon(const Condition& condition) {
    for (int i = 0; i < 1000; ++i) {
      if (condition()) return true;
      usleep(10000);
    }
    return false;
  }
  // Gone, or a zombie that nobody waits for.
  static bool has_ended(pid_t pid) {
    std::ifstream file(fmt::format("/proc/{}/stat", pid));
    std::string number, name, state;
    return !(file >> number >> name >> state) || state == "Z" || state == "X";
  }

  fs::path folder_;
};

TEST_P(Orphans, AProgramAndWhatItStartedEndWithUs) {
  end_during([this] { run_process(sleeper()); });
}

TEST_P(Orphans, AChildAndWhatItRunsEndWithUs) {
  end_during([this] { Child([this] { return run_process(sleeper()).text; }).get(); });
}

TEST_P(Orphans, AChildThatOnlyComputesEndsWithUs) {
  end_during([this] {
    Child child([this]() -> std::string {
      leave(getpid(), getpid());
      for (;;) pause();
    });
    child.get();
  });
}

INSTANTIATE_TEST_SUITE_P(Signals, Orphans, ::testing::Values(SIGINT, SIGTERM, SIGKILL));

TEST(Child, HandsBackItsText) {
  const std::string large(1 << 20, 'x');  // more than a pipe holds
  Child child([&] { return large; });
  EXPECT_EQ(child.get(), large);
  Child empty([] { return ""; });
  EXPECT_EQ(empty.get(), "");
}

template <typename Error>
void expect_thrown(const std::function<std::string()>& work, const std::string& message) {
  Child child(work);
  try {
    child.get();
    FAIL() << "no exception";
  } catch (const std::exception& error) {
    EXPECT_EQ(typeid(error), typeid(Error));
    EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
  }
}

TEST(Child, AnExceptionArrivesWithTypeAndMessage) {
  expect_thrown<InputError>([]() -> std::string { throw InputError("a.toml", 3, "no such key"); },
                            "a.toml:3: no such key");
  expect_thrown<ToolError>([]() -> std::string { throw ToolError("disk full"); }, "disk full");
  expect_thrown<std::bad_alloc>([]() -> std::string { throw std::bad_alloc(); }, "bad_alloc");
  expect_thrown<std::runtime_error>(
      []() -> std::string { throw std::logic_error("no such thing"); }, "no such thing");
}

TEST(Child, ASignalIsAnErrorThatNamesIt) {
  expect_thrown<ToolError>(
      []() -> std::string {
        std::raise(SIGKILL);
        return "";
      },
      "signal 9");
}

TEST(Child, AProcessThatCannotBeStartedIsAnErrorThatSaysWhy) {
  expect_thrown<ToolError>(
      []() -> std::string {
        const rlimit none = {0, 0};
        setrlimit(RLIMIT_NPROC, &none);  // holds in this child, and not for root
        constexpr uid_t kNobody = 65534;
        if (geteuid() == 0 && setuid(kNobody) != 0) return "";
        return Child([] { return ""; }).get();
      },
      "memory or processes are short");
}

TEST(Child, TwoRunAtTheSameTime) {
  Child first([] { return "1"; });
  Child second([] { return "2"; });
  EXPECT_EQ(second.get(), "2");
  EXPECT_EQ(first.get(), "1");
}

TEST(Worker, SendsMessagesAndTellsHowItEnded) {
  const auto all_of = [](Worker& worker) {
    std::vector<std::string> messages;
    while (!worker.ended()) {
      for (std::string& message : worker.receive()) messages.push_back(std::move(message));
    }
    return messages;
  };
  const std::string large(1'000'000, 'x');
  Worker good([&](const Worker::Send& send) {
    send("");
    send("first");
    send(large);
  });
  EXPECT_EQ(all_of(good), (std::vector<std::string>{"", "first", large}));
  EXPECT_EQ(good.failure(), "");
  Worker killed([](const Worker::Send& send) {
    send("before");
    std::raise(SIGKILL);
  });
  EXPECT_EQ(all_of(killed), std::vector<std::string>{"before"});
  EXPECT_EQ(killed.failure(), "signal 9");
  Worker interrupted([](const Worker::Send& send) {
    std::raise(SIGINT);
    send("still here");
  });
  EXPECT_EQ(all_of(interrupted), std::vector<std::string>{"still here"});
  EXPECT_EQ(interrupted.failure(), "");
}

}  // namespace
}  // namespace phongpipe
