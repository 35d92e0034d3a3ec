// phongpipe export: the results of a campaign as CSV or JSON. phongpipe merge: shards into one
// file.
#include <fmt/format.h>

#include <memory>

#include "model/scene/input_error.h"
#include "testbench/campaign/store.h"
#include "testbench/commands/options.h"
#include "testbench/reports/campaign_report.h"
#include "testbench/system/output_file.h"

namespace phongpipe {
namespace {

struct ExportOptions {
  std::string database, csv, json;
};

int export_results(const ExportOptions& options) {
  if (options.csv.empty() && options.json.empty()) {
    throw InputError("nothing to write: give --csv FILE or --json FILE; - is standard output");
  }
  check_output(options.csv);
  check_output(options.json);
  const ResultTable table = Store(options.database, Store::Access::read).table();
  if (!options.csv.empty()) write_output(options.csv, table_csv(table));
  if (!options.json.empty()) write_output(options.json, table_json(table));
  return 0;
}

struct MergeOptions {
  std::vector<std::string> databases;
  std::string output;
};

int merge_databases(const MergeOptions& options) {
  std::error_code none;
  for (const std::string& database : options.databases) {
    if (std::filesystem::equivalent(database, options.output, none)) {
      throw InputError(fmt::format("{}: cannot be merged into itself", database));
    }
  }
  if (options.output.empty() || options.output == Store::kInMemory) {
    throw InputError(fmt::format("-o {}: not the name of a file", options.output));
  }
  // Everything is checked before the first byte is written.
  std::vector<std::unique_ptr<Store>> stores;
  for (const std::string& database : options.databases) {
    stores.push_back(std::make_unique<Store>(database, Store::Access::read));
  }
  for (const auto& store : stores) stores.front()->check_fits(*store);
  Store merged(options.output, Store::Access::write, stores.front()->kind());
  for (const auto& store : stores) merged.merge(*store);
  print_or_throw(fmt::format("{}: {} runs of {} files\n", printable(options.output),
                             merged.known().size(), stores.size()));
  return 0;
}

}  // namespace

void add_export(CLI::App& application, Run& run) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command =
      application.add_subcommand("export", "Write the results of a sweep or regression as a table");
  command->add_option("database", options->database, "File of the results")
      ->required()
      ->type_name("FILE.db");
  command->add_option("--csv", options->csv, "Write CSV; - is standard output")->type_name("FILE");
  command->add_option("--json", options->json, "Write JSON; - is standard output")
      ->type_name("FILE");
  command->footer(
      "The column `command` is the line that verifies the same; numbers are exact.\n"
      "Example: phongpipe export teapot-sweep.db --csv -\n");
  command->callback([options, &run] { run = [options] { return export_results(*options); }; });
}

void add_merge(CLI::App& application, Run& run) {
  auto options = std::make_shared<MergeOptions>();
  CLI::App* command =
      application.add_subcommand("merge", "Put the results of several shards into one file");
  command->add_option("databases", options->databases, "Files of the shards")
      ->required()
      ->type_name("FILE.db");
  command->add_option("-o,--output", options->output, "File that takes all results")
      ->required()
      ->type_name("FILE.db");
  command->footer("Example: phongpipe merge part1.db part2.db -o all.db\n");
  command->callback([options, &run] { run = [options] { return merge_databases(*options); }; });
}

}  // namespace phongpipe
