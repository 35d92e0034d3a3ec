// What a child that was taken over can do: nothing.
#include "model/files/confined_child.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "model/files/meshes/mesh_transfer.h"
#include "model/scene/input_error.h"

namespace phongpipe {
namespace {

constexpr ChildLimits kLimits = {std::size_t{64} << 20, 1};

// What `work` returns in a child.
std::string answer_of(const std::function<std::string()>& work) {
  ConfinedChild child([&](const Channel& channel) { channel.send(7, work()); }, kLimits);
  const Channel::Header header = child.channel().receive_header();
  EXPECT_EQ(header.kind, 7U);
  std::string text(header.size, '\0');
  child.channel().receive(text.data(), text.size());
  return text;
}

std::string ending_of(const std::function<void()>& work) {
  ConfinedChild child([&](const Channel&) { work(); }, kLimits);
  EXPECT_THROW(child.channel().receive_header(), Channel::Closed);
  return child.ending();
}

TEST(ConfinedChild, AnswersWhateverTheSize) {
  EXPECT_EQ(answer_of([] { return std::string(3'000'000, 'x'); }), std::string(3'000'000, 'x'));
  EXPECT_EQ(answer_of([] { return std::string(); }), "");
}

TEST(ConfinedChild, CanOpenWriteConnectAndStartNothing) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer needs files of its own";
#endif
  const pid_t parent = getpid();
  const auto denied = [](const char* what, bool is_denied) {
    return is_denied ? std::string() : what + std::string(" ");
  };
  EXPECT_EQ(answer_of([&] {
              return denied("open", open("/etc/passwd", O_RDONLY) < 0) +
                     denied("create", open("/tmp/phongpipe-x", O_WRONLY | O_CREAT, 0600) < 0) +
                     denied("write", write(STDOUT_FILENO, "x", 1) < 0) +
                     denied("tell", write(STDERR_FILENO, "x", 1) < 0) +
                     denied("inherited", write(3, "x", 1) < 0) +
                     denied("socket", socket(AF_INET, SOCK_STREAM, 0) < 0) +
                     denied("local socket", socket(AF_UNIX, SOCK_STREAM, 0) < 0) +
                     denied("unlink", unlink("/tmp/phongpipe-x") < 0 && errno != ENOENT) +
                     denied("duplicate", dup(0) < 0) + denied("fork", fork() < 0) +
                     denied("kill", kill(parent, 0) < 0) +
                     denied("memory file", memfd_create("x", 0) < 0) +
                     denied("exec", execl("/bin/true", "true", nullptr) < 0);
            }),
            "");
}

TEST(ConfinedChild, TellsHowItEnded) {
  EXPECT_EQ(ending_of([] { std::raise(SIGSEGV); }), "died of signal 11 (Segmentation fault)");
  EXPECT_EQ(ending_of([] { std::abort(); }), "died of signal 6 (Aborted)");
  EXPECT_EQ(ending_of([] { throw 1; }), "ended early with status 1");
  EXPECT_EQ(ending_of([] {
              for (volatile unsigned i = 0;;) i = i + 1;
            }),
            "took more than 1 s of processor time");
}

TEST(ConfinedChild, HasNoMoreMemoryThanItsLimit) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer ends the process where there is no memory";
#else
  EXPECT_EQ(ending_of([] {
              std::vector<char> memory(std::size_t{256} << 20, 'x');
              memory[memory.size() / 2] = 'y';
            }),
            "needs more than 64 MiB of memory");
#endif
}

// Runs `work` in place of a reader.
std::string refusal_of(const std::function<void(const Channel&)>& work) {
  ConfinedChild child(work, kLimits);
  try {
    receive_mesh(child, mesh_format_of("a.obj"), "a.obj", 0);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MeshTransfer, TrustsNothingThatTheChildSends) {
  const std::vector<std::uint64_t> facts = {0, 0};
  const auto send_facts = [&](const Channel& channel) {
    channel.send(kFacts, facts.data(), sizeof(std::uint64_t) * facts.size());
  };
  const std::string led_astray = "a.obj: its reader was led astray and sent ";
  EXPECT_EQ(refusal_of([](const Channel& channel) { channel.send(99, "x"); }),
            led_astray + "an array that is out of order or too large");
  EXPECT_EQ(refusal_of([](const Channel& channel) { channel.send(kPositions, "x"); }),
            led_astray + "an array that is out of order or too large");
  EXPECT_EQ(refusal_of([](const Channel& channel) {
              const std::vector<std::uint64_t> wrong = {77, 0};
              channel.send(kFacts, wrong.data(), sizeof(std::uint64_t) * wrong.size());
            }),
            led_astray + "no facts");
  EXPECT_EQ(
      refusal_of([](const Channel& channel) { channel.send(kError, std::string(1'000'000, 'x')); }),
      led_astray + "a text that is too long");
  EXPECT_EQ(refusal_of([&](const Channel& channel) {
              send_facts(channel);
              channel.send(kPositions, std::string(24, '\0'));
              channel.send(kNormals, std::string(48, '\0'));
              for (const Kind kind : {kFaces, kMaterialNames, kMaterialNumbers, kNotes}) {
                channel.send(kind, "");
              }
            }),
            led_astray + "arrays of unequal size");
  // A size without bytes: nothing is allocated for it.
  EXPECT_EQ(refusal_of([&](const Channel& channel) {
              send_facts(channel);
              const Channel::Header header = {kPositions, std::uint64_t{1} << 62U};
              ASSERT_EQ(write(0, &header, sizeof header), sizeof header);
            }),
            led_astray + "an array that is out of order or too large");
  EXPECT_EQ(refusal_of([&](const Channel& channel) { send_facts(channel); }),
            "a.obj: its reader ended early with status 0");
  EXPECT_EQ(refusal_of([](const Channel& channel) { channel.send(kRequest, "/etc/shadow"); }),
            "a.obj: names the file '/etc/shadow', may only name files that end with .mtl");
  EXPECT_EQ(refusal_of([](const Channel& channel) {
              for (int i = 0; i < 100; ++i) {
                channel.send(kRequest, "none.mtl");
                channel.receive_header();
              }
            }),
            "a.obj: names more than 64 files");
}

}  // namespace
}  // namespace phongpipe
