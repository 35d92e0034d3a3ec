// Children and other programs: results, failures and signals come back.
#include "testbench/system/process.h"

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>

namespace phongpipe {
namespace {

TEST(Process, OutputAndStatusOfAProgram) {
  const ProcessOutput output = run_process({"sh", "-c", "echo out; echo err >&2; exit 3"});
  EXPECT_EQ(output.text, "out\nerr\n");
  EXPECT_EQ(output.status, 3);
  EXPECT_EQ(run_process({"nosuchprogram"}).status, 127);
}

TEST(Child, HandsBackItsText) {
  const std::string large(1 << 20, 'x');  // more than a pipe holds
  Child child([&] { return large; });
  EXPECT_EQ(child.get(), large);
}

TEST(Child, AnExceptionArrivesWithItsMessage) {
  Child child([]() -> std::string { throw std::runtime_error("no such thing"); });
  try {
    child.get();
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "no such thing");
  }
}

TEST(Child, ASignalIsAnErrorThatNamesIt) {
  Child child([]() -> std::string {
    std::raise(SIGKILL);
    return "";
  });
  try {
    child.get();
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("signal 9"), std::string::npos) << error.what();
  }
}

TEST(Child, TwoRunAtTheSameTime) {
  Child first([] { return "1"; });
  Child second([] { return "2"; });
  EXPECT_EQ(second.get(), "2");
  EXPECT_EQ(first.get(), "1");
}

}  // namespace
}  // namespace phongpipe
