// A run: one verification, as text and resolved; how it ended; its metrics.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "testbench/cosim/metrics.h"
#include "testbench/cosim/verification.h"

namespace phongpipe {

// Part of the identity of a run. Raise it whenever a change of the program may change pictures,
// cycles or metrics of some run: results of other versions are then computed anew.
constexpr int kArithmeticVersion = 4;

// What to verify, as on the command line of `phongpipe verify`.
struct RunRequest {
  std::string scene;                  // file, or name of a shipped or random scene
  std::string hardware = "default";   // preset or file
  std::vector<std::string> settings;  // key=value, as for --set
  VerificationOptions options;
};

// An option of `verify` that belongs to a run: --NAME VALUE.
struct RunOption {
  std::string_view name, type, meaning;
  std::string (*get)(const VerificationOptions&);
  // Throws InputError if the text is no value of the option.
  void (*put)(VerificationOptions&, const std::string& text);
};
const std::vector<RunOption>& run_options();

// Sets `key` of a request: scene, hardware, an option, or any key of --set.
void set_key(RunRequest& request, const std::string& key, const std::string& value);

// A text as a word of a command line, in quotes where a shell needs them.
std::string shell_word(const std::string& text);

// The command line that verifies the same: `phongpipe verify …`.
std::string command_of(const RunRequest& request);
// Its inverse. Throws InputError if the text is no such command line.
RunRequest parse_command(const std::string& command);

// What one run may take.
struct RunLimits {
  int seconds = 600;
  int memory_mib = 4096;
};

// The text that says everything a result depends on, a line each, and its hash: 16 hexadecimal
// digits. `rtl_hash`: see rtl_library.h.
std::string canonical_text(std::uint64_t scene_hash, const Hardware& hardware,
                           const VerificationOptions& options, const RunLimits& limits,
                           std::uint64_t rtl_hash);
std::string identity_of(const std::string& canonical_text);

// `failed`: a check of the verification failed. `refused`: the scene or the hardware is not legal.
enum class Outcome { passed, failed, refused, crashed, timed_out };
constexpr int kOutcomes = 5;
std::string_view name(Outcome outcome);      // timed_out, say
std::string_view words_of(Outcome outcome);  // timed out, for people

// How pixels were verified, from the weakest to the strongest.
enum class VerifiedBy { nothing, model, superset, native };
constexpr int kStrengths = 4;
std::string_view name(VerifiedBy verified_by);
VerifiedBy verified_by(RtlToVerify rtl);

// Bucket of runs that agree, but have values that do not fit their registers.
constexpr std::string_view kOverflow = "overflow";

struct RunResult {
  Outcome outcome = Outcome::crashed;
  std::string message;  // why it has not passed, or how it had to end, in one line
  std::string bucket;   // what failed first, without numbers: failures of one kind have the same
  VerifiedBy verified_by = VerifiedBy::nothing;
  std::string configuration_hash;    // of the resolved hardware; empty without a result
  std::vector<MetricValue> metrics;  // in the order of metrics(); empty without a result
  std::string capsule;               // text that shows a divergence again, or empty

  static constexpr auto fields() {
    using R = RunResult;
    return std::make_tuple(field("outcome", &R::outcome), field("message", &R::message),
                           field("bucket", &R::bucket), field("verified_by", &R::verified_by),
                           field("configuration_hash", &R::configuration_hash),
                           field("metrics", &R::metrics), field("capsule", &R::capsule));
  }
};

// The result of a verification, without its pictures.
RunResult summary_of(const VerificationResult& result);
// The result of a run whose scene or hardware is not legal.
RunResult refused(const std::string& reason);

}  // namespace phongpipe
