// phongpipe report: the results of a campaign as a page for a browser, with pictures of the front.
#include <fmt/format.h>

#include <map>
#include <memory>
#include <set>

#include "model/scene/input_error.h"
#include "testbench/campaign/pareto.h"
#include "testbench/cases/named_scene.h"
#include "testbench/commands/options.h"
#include "testbench/reports/campaign_page.h"
#include "testbench/system/output_file.h"

namespace phongpipe {
namespace {

struct ReportOptions {
  std::string database, output;
};

constexpr std::size_t kMostRuns = 24;                     // with pictures
constexpr std::size_t kMostBytes = std::size_t{3} << 20;  // of all pictures

// The runs on the fronts, with those last that are as good as one before.
std::vector<std::size_t> different_first(const ResultTable& table) {
  std::vector<std::size_t> first, others;
  for (const auto& front : fronts_by_scene(table)) {
    std::set<std::pair<std::string, std::string>> seen;
    for (const std::size_t row : front) {
      const bool is_new =
          seen.emplace(table.text(row, "frame_ns_per_pixel"), table.text(row, "max_lsb")).second;
      (is_new ? first : others).push_back(row);
    }
  }
  first.insert(first.end(), others.begin(), others.end());
  return first;
}

// The pictures of a run, rendered again by the model. Throws InputError if its files are gone, or
// have changed so that it has another result now.
std::vector<PagePicture> pictures_of(const ResultTable& table, std::size_t row) {
  RunRequest request = parse_command(table.text(row, "command"));
  request.options.rtl = RtlToVerify::off;
  request.options.pictures = true;
  const VerificationResult result =
      verify(load_named_scene(request.scene, request.settings),
             load_hardware(request.hardware, request.settings), request.options);
  for (const char* name : {"pixels", "max_lsb", "rms_lsb"}) {
    const MetricValue value = metrics()[metric_index(name)].value(result);
    if (exact_text(value) == table.text(row, name)) continue;
    throw InputError(fmt::format("{}: has changed since: {} was {}, and is {}", request.scene, name,
                                 table.text(row, name), exact_text(value)));
  }
  return {{"result", png(result.result_picture)},
          {"error map", png(result.accuracy.error_picture)}};
}

void add_pictures(PageContent& page, const ResultTable& table) {
  Progress progress;
  const std::vector<std::size_t> front = different_first(table);
  const std::size_t most = std::min(front.size(), kMostRuns);
  std::map<std::string, std::string> missing;  // from a scene to why
  std::size_t bytes = 0, small_enough = 0;
  for (; small_enough < most; ++small_enough) {
    const std::size_t row = front[small_enough];
    progress(fmt::format("pictures: run {} of {}", small_enough + 1, most));
    try {
      std::vector<PagePicture> pictures = pictures_of(table, row);
      for (const PagePicture& picture : pictures) bytes += picture.png.size();
      if (bytes > kMostBytes) break;
      page.pictures[row] = std::move(pictures);
    } catch (const InputError& error) {
      missing.emplace(table.text(row, "scene"), error.what());
    }
  }
  if (small_enough < front.size()) {
    page.notes.push_back(
        fmt::format("{} of the {} runs on the front are without pictures, to keep the page small.",
                    front.size() - small_enough, front.size()));
  }
  for (const auto& [scene, why] : missing) {
    page.notes.push_back(fmt::format("Runs of {} are without pictures: {}.", scene, why));
  }
}

int report(const ReportOptions& options) {
  const std::filesystem::path chart_file =
      std::filesystem::path(options.output).replace_extension(".svg");
  if (chart_file == options.output) {
    throw InputError(
        fmt::format("{}: the page needs another name, for its chart is called so", options.output));
  }
  std::error_code none;
  if (std::filesystem::equivalent(options.database, options.output, none)) {
    throw InputError(fmt::format("{}: the page would replace the results", options.output));
  }
  check_writable(options.output);
  check_writable(chart_file);
  const Store store(options.database, Store::Access::read);
  const ResultTable table = store.table();
  if (table.rows.empty()) {
    throw InputError(fmt::format("{}: has no runs yet", options.database));
  }
  const std::string title =
      fmt::format("{}: {}", std::filesystem::path(options.database).stem().string(), store.kind());
  const bool alternatives = store.kind() == "sweep";
  PageContent page = campaign_page(table, title, alternatives);
  if (alternatives) add_pictures(page, table);
  write_text(options.output, result_page(page));
  write_text(chart_file, svg(front_chart(table, title, alternatives)));
  std::string text;
  for (const std::string& line : page.summary) text += printable(line) + "\n";
  for (const std::string& note : page.notes) text += printable(note) + "\n";
  print_or_throw(text + fmt::format("more: {}, {}\n", printable(options.output),
                                    printable(chart_file.string())));
  return 0;
}

}  // namespace

void add_report(CLI::App& application, Run& run) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App* command = application.add_subcommand(
      "report", "Show the results of a sweep or regression on a page for a browser");
  command->add_option("database", options->database, "File of the results")
      ->required()
      ->type_name("FILE.db");
  command
      ->add_option("-o,--output", options->output,
                   "Page; its Pareto front is drawn in the .svg beside it")
      ->required()
      ->type_name("FILE.html");
  command->footer(
      "The page is one file that needs no network: choose what is set against what, brush axes to "
      "filter,\nopen a run for its pictures and its command, take rows away as CSV, hardware as "
      "TOML.\n"
      "Example: phongpipe report teapot-sweep.db -o report.html\n");
  command->callback([options, &run] { run = [options] { return report(*options); }; });
}

}  // namespace phongpipe
