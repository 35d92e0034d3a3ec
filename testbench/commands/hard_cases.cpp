#include "testbench/commands/hard_cases.h"

#include <fmt/format.h>

#include <algorithm>

#include "model/scene/input_error.h"
#include "testbench/commands/options.h"
#include "testbench/methods/hard_case_run.h"
#include "testbench/reports/hard_case_report.h"
#include "testbench/reports/verification_page.h"
#include "testbench/reports/verification_report.h"
#include "testbench/system/output_file.h"

namespace phongpipe {
namespace {

std::vector<HardCase> chosen(const std::vector<std::string>& names) {
  std::vector<HardCase> all = hard_cases();
  if (names.empty()) return all;
  std::vector<HardCase> cases;
  for (const std::string& name : names) {
    const auto before = cases.size();
    for (const HardCase& hard_case : all) {
      const bool inside = hard_case.name.compare(0, name.size() + 1, name + "/") == 0;
      if (hard_case.name == name || inside) cases.push_back(hard_case);
    }
    if (cases.size() > before) continue;
    throw InputError(
        fmt::format("{}: no hard case, and no folder of them; `phongpipe verify "
                    "--hard-cases` names all",
                    name));
  }
  return cases;
}

std::filesystem::path page_file(const HardCaseOptions& options) {
  return options.out / "hard-cases.html";
}
std::filesystem::path sheet_file(const HardCaseOptions& options) {
  return options.out / "hard-cases.png";
}

// All cases with their pictures, and the contact sheet.
void write_pages(const HardCaseOptions& options, const std::vector<HardCaseResult>& results) {
  make_folder(options.out);
  VerificationPage page("Hard cases", "case");
  for (const HardCaseResult& result : results) {
    const HardCase& c = result.hard_case;
    page.add(c.name, c.hardware, command_of(c), as_run(result));
    if (!result.verification) continue;
    std::string name = result.hard_case.name;
    std::replace(name.begin(), name.end(), '/', '-');
    const auto files = picture_files(options.out, name);
    WrittenPictures(*result.verification, files).wait();
    page.add_pictures(files);
  }
  write_text(page_file(options), page.text());
  write_png(sheet_file(options), contact_sheet(results));
}

}  // namespace

int verify_hard_cases(const HardCaseOptions& options) {
  const std::vector<HardCase> cases = chosen(options.names);
  check_output(options.json);
  if (!options.out.empty()) {
    check_outputs(options.out, {page_file(options), sheet_file(options)});
  }
  std::size_t name_width = 0;
  for (const HardCase& hard_case : cases) name_width = std::max(name_width, hard_case.name.size());
  Progress progress;
  std::vector<HardCaseResult> results;
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  std::size_t passed = 0;
  for (const HardCase& hard_case : cases) {
    progress(fmt::format("{} of {}: {}", results.size() + 1, cases.size(), hard_case.name));
    results.push_back(run_hard_case(hard_case, options.rtl_sources, !options.out.empty()));
    progress.clear();
    const HardCaseResult& result = results.back();
    passed += result.passed() ? 1 : 0;
    json.push_back(hard_case_json(result));
    if (options.json == "-") continue;
    print_or_throw(hard_case_line(result, name_width, color_wanted(), options.verbose));
  }
  if (options.json != "-") {
    print_or_throw(fmt::format("{} of {} passed\n", passed, count_text(cases.size(), "hard case")));
  }
  write_output(options.json, json.dump(2) + "\n");
  if (!options.out.empty()) {
    write_pages(options, results);
    if (options.json != "-") {
      print_or_throw(fmt::format("{}, {}\n", printable(sheet_file(options).string()),
                                 printable(page_file(options).string())));
    }
  }
  return passed == cases.size() ? 0 : kCheckFailed;
}

}  // namespace phongpipe
