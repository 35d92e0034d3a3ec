// phongpipe diff-traces: the first signal in which two waveforms differ, pixel by pixel.
#include <fmt/format.h>

#include <memory>

#include "testbench/commands/options.h"
#include "testbench/system/output_file.h"
#include "testbench/system/terminal.h"
#include "testbench/trace/trace_diff.h"

namespace phongpipe {
namespace {

struct DiffTracesCommandOptions {
  std::filesystem::path a, b;
};

std::string latency_text(const std::optional<int>& cycles) {
  return cycles ? fmt::format("{} cycles", *cycles) : std::string("unknown");
}

std::string scope_text(const std::string& scope) {
  return scope.empty() ? "pixel_datapath" : scope + ".pixel_datapath";
}

std::string comparison_text(const TraceComparison& c) {
  std::string text =
      fmt::format("{}  {} and {}: {} {} with {} signals each{}\n", c.same() ? "SAME" : "DIFFERENT",
                  printable(scope_text(c.a_scope)), printable(scope_text(c.b_scope)), c.compared,
                  c.lanes == 1 ? "pixels" : "groups of pixels", c.signals,
                  c.compared == 0 && !c.first ? ", for they have no pixel in common" : "");
  if (c.first) {
    const TraceDifference& d = *c.first;
    text += fmt::format("  first    {} of the pixel at x {}, y {}, number {} of both\n",
                        printable(d.signal), d.x, d.y, d.pixel);
    text += fmt::format("           A {} at {} ps\n           B {} at {} ps\n", printable(d.a),
                        d.a_ps, printable(d.b), d.b_ps);
  }
  if (c.a_pixels != c.b_pixels) {
    text += fmt::format("  pixels   A has {}, B has {}\n", c.a_pixels, c.b_pixels);
  }
  if (c.a_latency_cycles != c.b_latency_cycles) {
    text += fmt::format("  latency  A {}, B {}\n", latency_text(c.a_latency_cycles),
                        latency_text(c.b_latency_cycles));
  }
  return text;
}

int compare_traces(const DiffTracesCommandOptions& options) {
  const TraceDiff diff = diff_traces(options.a, options.b);
  std::string text;
  for (const TraceComparison& comparison : diff.comparisons) text += comparison_text(comparison);
  const std::pair<const std::filesystem::path&, bool> files[] = {{options.a, diff.a_complete},
                                                                 {options.b, diff.b_complete}};
  for (const auto& [file, complete] : files) {
    if (!complete) {
      text += fmt::format("  cut      {} ends before its end\n", printable(file.string()));
    }
  }
  print_or_throw(text);
  return diff.same() ? 0 : kCheckFailed;
}

}  // namespace

void add_diff_traces(CLI::App& application, Run& run) {
  auto options = std::make_shared<DiffTracesCommandOptions>();
  CLI::App* command = application.add_subcommand(
      "diff-traces",
      "Compare two waveforms pixel by pixel, and name the first signal that differs");
  command->add_option("A", options->a, "FST or VCD file with a scope pixel_datapath")
      ->required()
      ->type_name("A");
  command
      ->add_option("B", options->b, "Another, or the same: its implementations are compared then")
      ->required()
      ->type_name("B");
  command->footer(
      "Exit status: 0 the same, 1 different, 2 a file cannot be read.\n"
      "Example: phongpipe diff-traces before.fst after.fst\n");
  command->callback([options, &run] { run = [options] { return compare_traces(*options); }; });
}

}  // namespace phongpipe
