#include "testbench/commands/campaign_options.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>
#include <set>
#include <vector>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "testbench/campaign/pareto.h"
#include "testbench/cases/random_run.h"
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
      tell(line);
    }
  }
  void clear() { live_.clear(); }

 private:
  bool terminal_ = isatty(STDERR_FILENO) != 0;
  std::chrono::steady_clock::time_point shown_ = std::chrono::steady_clock::now();
  Progress live_;
};

// The values of all keys of a request.
std::vector<std::pair<std::string, std::string>> values_of(const RunRequest& request) {
  std::vector<std::pair<std::string, std::string>> values;
  for (const std::string& setting : request.settings) {
    const std::size_t equals = setting.find('=');
    values.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
  }
  for (const RunOption& option : run_options()) {
    values.emplace_back(option.name, option.get(request.options));
  }
  return values;
}

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

// The store, the display and the handler of Ctrl-C while runs are done, in one go or in rounds.
class Session {
 public:
  Session(CampaignCommand& command, std::vector<std::string> keys)
      : command_(command), keys_(std::move(keys)) {
    parse_shard(command.shard, command.options);
    if (command.database != Store::kInMemory) {
      command.options.failures = command.database + "-failures";
    }
  }

  // Sets the RTL of the runs, and does them. `late`: whether the time for new runs is over.
  void add(std::vector<CampaignRun>& runs, const std::function<bool()>& late) {
    for (CampaignRun& run : runs) {
      run.request.options.rtl = command_.rtl;
      run.request.options.rtl_sources = command_.rtl_sources;
    }
    const CampaignProgress before = total_.progress;
    CampaignResult result = run_campaign(
        runs, command_.options, [this]() -> Store& { return store(); },
        [&](const CampaignProgress& progress) { show(before + progress); },
        [&] { return interrupted != 0 || late(); });
    total_.progress = before + result.progress;
    // Runs for which there was no time do not count.
    if (late()) total_.progress.total -= total_.progress.left();
    total_.interrupted = interrupted != 0 || (result.interrupted && !late());
    identities_ = std::move(result.identities);
    for (const auto& [reason, count] : result.refusals) total_.refusals[reason] += count;
    for (StoredRun& run : result.not_passed) total_.not_passed.push_back(std::move(run));
  }

  // Does runs once more that add() has done, in native RTL. They are not counted twice; those that
  // fail now do not count as passed.
  void verify_natively(std::vector<CampaignRun>& runs) {
    command_.rtl = RtlToVerify::native;
    const CampaignProgress before = total_.progress;
    add(runs, [] { return false; });
    const CampaignProgress& after = total_.progress;
    CampaignProgress sum = before;
    for (const Outcome outcome : {Outcome::failed, Outcome::crashed, Outcome::timed_out}) {
      sum.done[outcome] = after.done[outcome];
    }
    sum.done[Outcome::passed] -=
        std::min(sum.done[Outcome::passed], after.failures() - before.failures());
    sum.seconds = after.seconds;
    total_.progress = sum;
  }

  bool stopped() const { return total_.interrupted; }

  // Of `runs`, which add() has just done, those whose results stand on the Pareto front.
  std::vector<CampaignRun> runs_of_front(const std::vector<CampaignRun>& runs) const {
    ResultTable table = store_->table();
    const std::set<std::string> own(identities_.begin(), identities_.end());
    const std::size_t identity = table.column("identity");
    table.rows.erase(std::remove_if(table.rows.begin(), table.rows.end(),
                                    [&](const std::vector<Cell>& row) {
                                      return own.count(exact_text(row[identity])) == 0;
                                    }),
                     table.rows.end());
    std::set<std::string> commands;
    for (const auto& front : fronts_by_scene(table)) {
      for (const std::size_t row : front) commands.insert(table.text(row, "command"));
    }
    std::vector<CampaignRun> result;
    for (const CampaignRun& run : runs) {
      if (commands.count(command_of(run.request)) != 0) result.push_back(run);
    }
    return result;
  }

  // The exit status.
  int finish() {
    display_.clear();
    print_or_throw(campaign_text(total_, *store_, command_.database, color_wanted()));
    if (command_.finish) command_.finish(*store_);
    if (interrupted != 0) return kInterrupted;
    const CampaignProgress& p = total_.progress;
    const bool crashed = p.done[Outcome::crashed] + p.known[Outcome::crashed] > 0;
    return crashed ? kToolFailed : p.failures() > 0 ? kCheckFailed : 0;
  }

 private:
  void show(CampaignProgress progress) {
    if (command_.kind != "sweep") progress.best.reset();  // runs of a regression do not compete
    display_(progress);
  }

  Store& store() {
    if (!store_) {
      store_ = std::make_unique<Store>(command_.database, Store::Access::write, command_.kind);
      store_->add_keys(keys_);
      if (!command_.shard.empty()) {
        store_->add_shard(fmt::format("{}/{}", command_.options.shard, command_.options.shards));
      }
    }
    return *store_;
  }

  CampaignCommand& command_;
  std::vector<std::string> keys_;
  std::unique_ptr<Store> store_;  // opened once some run is known to be legal
  CampaignDisplay display_;
  InterruptHandler handler_;
  CampaignResult total_;
  std::vector<std::string> identities_;  // of the runs that were added last
};

}  // namespace

void CampaignCommand::add_to(CLI::App& command) {
  command
      .add_option("--db", database,
                  "SQLite file that keeps the results; what it has is not "
                  "computed again")
      ->type_name("FILE");
  command.add_option("-j,--jobs", options.jobs, "Runs at once; 0: one for each core")
      ->capture_default_str()
      ->type_name("N")
      ->check(CLI::Range(0, 1024).description(""));
  command.add_option("--shard", shard, "Do part I of N only, for several machines; see merge")
      ->type_name("I/N");
  add_choice<RtlToVerify>(
      command, "--rtl", rtl,
      {{"native", RtlToVerify::native},
       {"superset", RtlToVerify::superset},
       {"off", RtlToVerify::off}},
      "native",
      "Compare with RTL built for each configuration; with one RTL in which all "
      "of them run, and the Pareto front with its own; or with SystemC only");
  command
      .add_option("--rtl-sources", rtl_sources, "Folder of the RTL to verify, if not the installed")
      ->type_name("DIR")
      ->check(CLI::ExistingDirectory.description(""));
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

int CampaignCommand::run(const Plan& plan) {
  std::vector<CampaignRun> runs;
  for (PlanPoint& point : points_of(plan)) {
    runs.push_back({std::move(point.request), std::move(point.values)});
  }
  std::vector<std::string> keys;
  for (const Axis& axis : plan.axes) keys.push_back(axis.key);
  for (const Tie& tie : plan.ties) keys.push_back(tie.key);
  Session session(*this, keys);
  const auto never_late = [] { return false; };
  session.add(runs, never_late);
  if (rtl == RtlToVerify::superset && !session.stopped()) {
    std::vector<CampaignRun> front = session.runs_of_front(runs);
    session.verify_natively(front);
  }
  return session.finish();
}

int CampaignCommand::run_random(std::uint64_t seed, std::uint64_t count, double seconds) {
  std::vector<std::string> keys = {"scene", "hardware", "technology"};
  for (const Setting<Hardware>& setting : hardware_settings()) keys.push_back(setting.name());
  for (const RunOption& option : run_options()) keys.emplace_back(option.name);
  options.overflow_is_refusal = true;
  Session session(*this, keys);
  const auto start = std::chrono::steady_clock::now();
  const auto late = [&] {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    return seconds > 0 && passed.count() >= seconds;
  };
  constexpr std::uint64_t kRound = 512;
  for (std::uint64_t done = 0; (count == 0 || done < count) && !late() && !session.stopped();) {
    const std::uint64_t size = count == 0 ? kRound : std::min(kRound, count - done);
    std::vector<CampaignRun> runs;
    for (std::uint64_t i = done; i < done + size; ++i) {
      const RunRequest request = random_run(seed, i);
      runs.push_back({request, values_of(request)});
    }
    session.add(runs, late);
    done += size;
  }
  return session.finish();
}

}  // namespace phongpipe
