#include "testbench/commands/campaign_options.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <optional>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "testbench/commands/options.h"
#include "testbench/reports/campaign_report.h"
#include "testbench/system/output_file.h"

namespace phongpipe {
namespace {

volatile std::sig_atomic_t interrupted = 0;

// The first Ctrl-C asks to stop; the second ends the program at once.
class InterruptHandler {
 public:
  InterruptHandler() {
    interrupted = 0;
    std::signal(SIGINT, [](int) {
      interrupted = 1;
      std::signal(SIGINT, SIG_DFL);
    });
  }
  ~InterruptHandler() { std::signal(SIGINT, SIG_DFL); }
  InterruptHandler(const InterruptHandler&) = delete;
  InterruptHandler& operator=(const InterruptHandler&) = delete;
};

// A live line on a terminal; a line a minute elsewhere.
class CampaignDisplay {
 public:
  void operator()(const CampaignProgress& progress) {
    const auto now = std::chrono::steady_clock::now();
    const auto interval = terminal_ ? std::chrono::milliseconds(200) : std::chrono::minutes(1);
    if (now - shown_ < interval) return;
    shown_ = now;
    std::string line = progress_line(progress);
    if (interrupted != 0) line += "; finishing what is in flight, Ctrl-C again to drop it";
    if (terminal_) {
      live_(line);
    } else {
      fmt::print(stderr, "{}\n", line);
    }
  }
  void clear() { live_.clear(); }

 private:
  bool terminal_ = isatty(STDERR_FILENO) != 0;
  std::chrono::steady_clock::time_point shown_ = std::chrono::steady_clock::now();
  Progress live_;
};

void parse_shard(const std::string& text, CampaignOptions& options) {
  if (text.empty()) return;
  const std::vector<std::string_view> parts = split(text, '/');
  if (parts.size() == 2) {
    const auto shard = parse_integer(parts[0]), shards = parse_integer(parts[1]);
    if (shard && shards && *shards >= 1 && *shards <= 1'000'000 && *shard >= 1 &&
        *shard <= *shards) {
      options.shard = static_cast<int>(*shard);
      options.shards = static_cast<int>(*shards);
      return;
    }
  }
  throw InputError(fmt::format("--shard {}: write I/N, part I of N, as in 1/4", text));
}

}  // namespace

void CampaignCommand::add_to(CLI::App& command) {
  command.add_option("--db", database, "SQLite file that keeps the results; what it has is not "
                                       "computed again")
      ->type_name("FILE");
  command.add_option("-j,--jobs", options.jobs, "Runs at once; 0: one for each core")
      ->capture_default_str()
      ->type_name("N")
      ->check(CLI::Range(0, 1024).description(""));
  command.add_option("--shard", shard, "Do part I of N only, for several machines; see merge")
      ->type_name("I/N");
  add_choice<RtlToVerify>(command, "--rtl", rtl,
                          {{"native", RtlToVerify::native}, {"off", RtlToVerify::off}}, "native",
                          "Compare with RTL built for each configuration, or with SystemC only");
  command
      .add_option("--timeout", options.limits.seconds, "Seconds after which a run has timed out")
      ->capture_default_str()
      ->type_name("SECONDS")
      ->check(CLI::Range(1, 1'000'000).description(""));
  command.add_option("--memory", options.limits.memory_mib, "MiB that a run may take")
      ->capture_default_str()
      ->type_name("MIB")
      ->check(CLI::Range(64, 1 << 20).description(""));
  command.add_flag("--retry-failed", options.retry_failed,
                   "Do runs again that failed, crashed or timed out");
  command.add_flag("--fail-fast", options.fail_fast, "Begin no run after the first that failed");
}

int CampaignCommand::run(std::vector<CampaignRun> runs, const std::vector<std::string>& keys,
                         CampaignResult* result) {
  parse_shard(shard, options);
  for (CampaignRun& run : runs) run.request.options.rtl = rtl;
  Store store(database, Store::Access::write, kind);
  store.add_keys(keys);
  if (!shard.empty()) store.add_shard(shard);
  CampaignDisplay display;
  CampaignResult done;
  {
    const InterruptHandler handler;
    done = run_campaign(
        runs, options, store, [&](const CampaignProgress& progress) { display(progress); },
        [] { return interrupted != 0; });
  }
  display.clear();
  print_or_throw(campaign_text(done, store, database, again, color_wanted()));
  const CampaignProgress& p = done.progress;
  const int status = interrupted != 0            ? kInterrupted
                     : p.crashed > 0             ? kToolFailed
                     : p.failed + p.timed_out > 0 ? kCheckFailed
                                                 : 0;
  if (result != nullptr) *result = std::move(done);
  return status;
}

}  // namespace phongpipe
