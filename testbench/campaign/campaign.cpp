#include "testbench/campaign/campaign.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <map>
#include <set>
#include <thread>
#include <tuple>

#include "model/scene/input_error.h"
#include "model/scene/tool_error.h"
#include "testbench/campaign/batch.h"
#include "testbench/campaign/loader.h"
#include "testbench/rtl/rtl_builder.h"
#include "testbench/rtl/rtl_library.h"
#include "testbench/system/output_file.h"

namespace phongpipe {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// A flag in memory that we share with our workers.
class SharedFlag {
 public:
  SharedFlag()
      : flag_(static_cast<volatile bool*>(mmap(nullptr, sizeof(bool), PROT_READ | PROT_WRITE,
                                               MAP_SHARED | MAP_ANONYMOUS, -1, 0))) {
    if (flag_ == MAP_FAILED) throw ToolError("no memory to share with workers");
  }
  ~SharedFlag() { munmap(const_cast<bool*>(flag_), sizeof(bool)); }
  SharedFlag(const SharedFlag&) = delete;
  SharedFlag& operator=(const SharedFlag&) = delete;

  void set() { *flag_ = true; }
  const volatile bool* get() const { return flag_; }

 private:
  volatile bool* flag_;
};

// A run that is not stored yet. Small, for workers are forked from a process that holds them all:
// what can be computed again from the request is not kept.
struct PendingRun {
  std::size_t index = 0;  // in the campaign
  std::string identity;
  const LoadedScene* scene = nullptr;
  bool alone = false;          // in a batch of its own, for another run ended the process before
  bool second_chance = false;  // its first process ended during the run
  std::size_t rtl = 0;         // the same for runs whose user chose the same parameters of the RTL
};

class Campaign {
 public:
  Campaign(const std::vector<CampaignRun>& runs, const CampaignOptions& options,
           const std::function<Store&()>& open_store, const ShowCampaign& show,
           const std::function<bool()>& should_stop)
      : runs_(runs),
        options_(options),
        open_store_(open_store),
        show_(show),
        should_stop_(should_stop) {
    jobs_ = options.jobs > 0 ? static_cast<std::size_t>(options.jobs)
                             : std::max(1U, std::thread::hardware_concurrency());
  }

  CampaignResult run() {
    std::vector<PendingRun> legal = resolve();
    store_ = &open_store_();
    enqueue(std::move(legal));
    start_ = Clock::now();
    while (!workers_.empty() || (!queue_.empty() && !stopping_)) {
      while (workers_.size() < jobs_ && !queue_.empty() && !stopping_) start_worker();
      wait_for_messages();
      end_late_workers();
      tell();
      if (!stopping_ && should_stop_()) stop();
    }
    flush();
    tell();
    result_.interrupted = stopping_;
    return std::move(result_);
  }

 private:
  // A worker with the runs that it has not finished.
  struct ActiveWorker {
    std::unique_ptr<Worker> worker;
    std::deque<PendingRun> runs;
    bool built = false;       // the RTL of its runs
    Clock::time_point since;  // when the last message came
  };

  // Loads scenes and hardware. What is not legal is refused.
  std::vector<PendingRun> resolve() {
    if (!runs_.empty()) rtl_hash_ = rtl_hash(runs_.front().request.options.rtl_sources);
    std::vector<PendingRun> legal;
    std::set<std::string> seen;
    std::map<std::string, std::size_t> rtl;
    bool some_legal = false;  // also in other shards
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const RunRequest& request = runs_[i].request;
      PendingRun run;
      run.index = i;
      std::string reason;
      loader_.check_names(request);
      try {
        run.scene = &loader_.scene(request);
        const Hardware hardware = loader_.hardware(request);
        run.rtl =
            rtl.emplace(rtl_parameters_text({hardware.formats, {}}), rtl.size()).first->second;
      } catch (const InputError& error) {
        reason = error.what();
      }
      some_legal = some_legal || reason.empty();
      run.identity = identity_of(text_of(i));
      if (!in_shard(run.identity) || !seen.insert(run.identity).second) continue;
      ++result_.progress.total;
      if (reason.empty()) {
        legal.push_back(std::move(run));
      } else {
        refused_.emplace_back(std::move(run), reason);
      }
    }
    if (!some_legal && !refused_.empty()) throw InputError(refused_.front().second);
    return legal;
  }

  // The canonical text of a run; of one that is not legal, its command.
  std::string text_of(std::size_t index) {
    const RunRequest& request = runs_[index].request;
    try {
      return canonical_text(loader_.scene(request).hash, loader_.hardware(request), request.options,
                            options_.limits, rtl_hash_);
    } catch (const InputError&) {
      return command_of(request) + "\n";
    }
  }

  // Leaves out what is stored.
  void enqueue(std::vector<PendingRun> legal) {
    const auto known = store_->known();
    const auto is_known = [&](const PendingRun& run) {
      const auto found = known.find(run.identity);
      const bool enough =
          found != known.end() && is_enough(found->second, runs_[run.index].request.options);
      if (enough) ++result_.progress.known[found->second.outcome];
      return enough;
    };
    for (const auto& [run, reason] : refused_) {
      if (!is_known(run)) record(run, refused(reason), 0);
    }
    for (const PendingRun& run : legal) result_.identities.push_back(run.identity);
    refused_.clear();
    // Runs that share a scene stand together, and of these the runs that share the RTL, so that one
    // batch builds it.
    std::stable_sort(legal.begin(), legal.end(), [](const PendingRun& a, const PendingRun& b) {
      return std::tie(a.scene->order, a.rtl) < std::tie(b.scene->order, b.rtl);
    });
    for (PendingRun& run : legal) {
      if (!is_known(run)) queue_.push_back(std::move(run));
    }
    flush();
  }

  // A shard holds every run of some identities, whatever else the plan contains.
  bool in_shard(const std::string& identity) const {
    const auto shards = static_cast<std::uint64_t>(options_.shards);
    return std::stoull(identity, nullptr, 16) % shards ==
           static_cast<std::uint64_t>(options_.shard) - 1;
  }

  bool is_enough(const KnownRun& known, const VerificationOptions& wanted) const {
    if (known.outcome == Outcome::passed) {
      return known.verified_by >= verified_by(wanted.rtl);
    }
    return known.outcome == Outcome::refused || !options_.retry_failed;
  }

  // Starts a worker with the next runs. Batches get smaller towards the end, so that all workers
  // end at about the same time.
  void start_worker() {
    // RTL of a batch is compiled as one file; what runs have in common is computed once a batch.
    constexpr std::size_t kMostNative = 16, kMostOthers = 64, kMostTriangles = 100'000;
    const std::size_t share = queue_.size() / (2 * jobs_);
    const PendingRun& next = queue_.front();
    const bool native = runs_[next.index].request.options.rtl == RtlToVerify::native;
    const std::size_t size =
        next.alone ? 1 : std::clamp<std::size_t>(share, 1, native ? kMostNative : kMostOthers);
    ActiveWorker active;
    std::vector<ResolvedRun> batch;
    std::size_t triangles = 0;
    while (!queue_.empty() && batch.size() < size && triangles < kMostTriangles &&
           (batch.empty() || !queue_.front().alone)) {
      PendingRun run = std::move(queue_.front());
      queue_.pop_front();
      try {
        const auto scene = loader_.prepared(*run.scene);
        if (batch.empty() || batch.back().scene != scene) {
          triangles += scene->geometry.triangles.size();
        }
        const RunRequest& request = runs_[run.index].request;
        batch.push_back({run.index, loader_.hardware(request), request.options, scene});
        batch.back().options.one_core = true;
        active.runs.push_back(std::move(run));
      } catch (const InputError& error) {
        record(run, refused(error.what()), 0);
      }
    }
    if (batch.empty()) return;
    active.worker = start_batch(batch, options_.limits.memory_mib, stop_.get());
    active.since = Clock::now();
    workers_.push_back(std::move(active));
  }

  void wait_for_messages() {
    std::vector<pollfd> files;
    for (const ActiveWorker& active : workers_) files.push_back({active.worker->file(), POLLIN, 0});
    constexpr int kMilliseconds = 100;
    if (poll(files.data(), files.size(), kMilliseconds) <= 0) return;
    for (std::size_t i = files.size(); i-- > 0;) {
      if (files[i].revents == 0) continue;
      ActiveWorker& active = workers_[i];
      for (const std::string& bytes : active.worker->receive()) {
        take(active, to_batch_message(bytes));
      }
      if (active.worker->ended()) end(i);
    }
    flush();
  }

  void take(ActiveWorker& active, const BatchMessage& message) {
    if (message.finished) {
      record(active.runs.front(), message.result, seconds_since(active.since));
      active.runs.pop_front();
    }
    active.built = true;
    active.since = Clock::now();
  }

  // A worker has ended: the runs that it has not finished are done one by one, so that one that
  // crashes costs only itself. The run in which it ended gets a second chance, alone.
  void end(std::size_t i) {
    ActiveWorker active = std::move(workers_[i]);
    workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));
    const std::string failure = active.worker->failure();
    if (!failure.empty() && !active.runs.empty() && active.runs.front().second_chance) {
      RunResult crash;
      crash.message = fmt::format("the process that did the run ended with {}", failure);
      crash.bucket = failure;
      record(active.runs.front(), crash, seconds_since(active.since));
      active.runs.pop_front();
    } else if (!failure.empty() && !active.runs.empty()) {
      active.runs.front().second_chance = true;
    }
    do_alone(active);
  }

  // Puts the runs that a worker has not finished back into the queue, to be done one by one.
  void do_alone(ActiveWorker& active) {
    while (!active.runs.empty()) {
      active.runs.back().alone = true;
      queue_.push_front(std::move(active.runs.back()));
      active.runs.pop_back();
    }
  }

  void end_late_workers() {
    for (std::size_t i = workers_.size(); i-- > 0;) {
      ActiveWorker& active = workers_[i];
      // Until its RTL is built, a batch has as much time as its runs together.
      const double runs = active.built ? 1 : static_cast<double>(active.runs.size());
      const double seconds = seconds_since(active.since);
      if (seconds <= runs * options_.limits.seconds || active.runs.empty()) continue;
      RunResult late;
      late.outcome = Outcome::timed_out;
      late.message = fmt::format("not done after {:.0f} s", seconds);
      late.bucket = "time";
      record(active.runs.front(), late, seconds);
      active.runs.pop_front();
      do_alone(active);
      workers_.erase(workers_.begin() + static_cast<std::ptrdiff_t>(i));  // kills it
    }
    flush();
  }

  void record(const PendingRun& run, const RunResult& result, double seconds) {
    const CampaignRun& asked = runs_[run.index];
    StoredRun stored;
    stored.identity = run.identity;
    stored.text = text_of(run.index);
    stored.command = command_of(asked.request);
    stored.scene = asked.request.scene;
    if (run.scene != nullptr) stored.scene_hash = fmt::format("{:016x}", run.scene->hash);
    stored.hardware = asked.request.hardware;
    stored.values = asked.values;
    stored.result = result;
    stored.seconds = seconds;
    if (!result.capsule.empty()) keep_capsule(stored.result, run.identity);
    Outcome& outcome = stored.result.outcome;
    if (options_.overflow_is_refusal && outcome == Outcome::failed && result.bucket == kOverflow) {
      outcome = Outcome::refused;
    }
    ++result_.progress.done[outcome];
    if (outcome == Outcome::passed) compare_with_best(result);
    if (outcome == Outcome::refused) {
      ++result_.refusals[result.bucket == kOverflow ? "values do not fit their registers"
                                                    : result.message];
    }
    if (outcome != Outcome::passed && outcome != Outcome::refused) {
      result_.not_passed.push_back(stored);
      if (options_.fail_fast) stop();
    }
    finished_.push_back(std::move(stored));
  }

  // The message then says how to see the divergence again.
  void keep_capsule(RunResult& result, const std::string& identity) const {
    const std::filesystem::path file = options_.failures / (identity + ".toml");
    try {
      make_folder(options_.failures);
      write_text(file, result.capsule);
    } catch (const std::exception& error) {
      result.message += fmt::format("; its capsule is not kept: {}", error.what());
      return;
    }
    result.message += "; again by phongpipe replay " + shell_word(file.string());
    const std::filesystem::path& rtl = runs_.front().request.options.rtl_sources;
    if (!rtl.empty()) result.message += " --rtl " + shell_word(rtl.string());
  }

  void compare_with_best(const RunResult& result) {
    static const std::size_t error = metric_index("max_lsb"),
                             time = metric_index("frame_ns_per_pixel");
    const BestRun run{*number_of(result.metrics[error]), *number_of(result.metrics[time])};
    std::optional<BestRun>& best = result_.progress.best;
    if (!best || std::tie(run.max_lsb, run.frame_ns_per_pixel) <
                     std::tie(best->max_lsb, best->frame_ns_per_pixel)) {
      best = run;
    }
  }

  void flush() {
    store_->put(finished_);
    finished_.clear();
  }

  void stop() {
    stopping_ = true;
    stop_.set();
  }

  void tell() {
    result_.progress.seconds = seconds_since(start_);
    show_(result_.progress);
  }

  const std::vector<CampaignRun>& runs_;
  const CampaignOptions& options_;
  const std::function<Store&()>& open_store_;
  Store* store_ = nullptr;
  const ShowCampaign& show_;
  const std::function<bool()>& should_stop_;
  std::size_t jobs_ = 1;
  Loader loader_;
  std::vector<std::pair<PendingRun, std::string>> refused_;  // at once, and why
  std::uint64_t rtl_hash_ = 0;  // of the RTL, which is the same for all runs
  std::deque<PendingRun> queue_;
  std::vector<ActiveWorker> workers_;
  std::vector<StoredRun> finished_;  // not stored yet
  SharedFlag stop_;
  bool stopping_ = false;
  Clock::time_point start_;
  CampaignResult result_;
};

}  // namespace

CampaignProgress CampaignProgress::operator+(const CampaignProgress& later) const {
  CampaignProgress sum = later;
  sum.total += total;
  sum.known += known;
  sum.done += done;
  sum.seconds += seconds;
  if (best && (!later.best || best->max_lsb < later.best->max_lsb)) sum.best = best;
  return sum;
}

CampaignResult run_campaign(const std::vector<CampaignRun>& runs, const CampaignOptions& options,
                            const std::function<Store&()>& open_store, const ShowCampaign& show,
                            const std::function<bool()>& should_stop) {
  return Campaign(runs, options, open_store, show, should_stop).run();
}

}  // namespace phongpipe
