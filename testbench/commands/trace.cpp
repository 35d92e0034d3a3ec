// phongpipe trace: waveforms of RTL and SystemC of a window of the frame, with views.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "model/files/text_file.h"
#include "model/fixed/model_frame.h"
#include "model/scene/input_error.h"
#include "testbench/cases/named_scene.h"
#include "testbench/commands/options.h"
#include "testbench/cosim/run.h"
#include "testbench/system/output_file.h"
#include "testbench/system/terminal.h"
#include "testbench/trace/pixel_story.h"
#include "testbench/trace/views.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

struct TraceCommandOptions {
  std::string scene;
  HardwareOptions hardware;
  std::vector<std::string> pixels;
  std::string cycles;
  std::int64_t triangle = -1, span = -1;
  bool worst = false, frame = false, yes = false;
  int margin = 32;
  fs::path file, rtl_sources;
  TraceOptions trace;
};

CycleWindow parse_cycles(const std::string& text) {
  const std::vector<std::string_view> parts = split(text, ':');
  if (parts.size() == 2) {
    const auto first = parse_integer(parts[0]), last = parse_integer(parts[1]);
    if (first && last && *first >= 0 && *first <= *last) return {*first, *last};
  }
  throw InputError(fmt::format("--cycles {}: write A:B, the first and the last cycle", text));
}

TraceTarget target_of(const TraceCommandOptions& options, const PreparedFrame& frame) {
  TraceTarget target;
  target.margin_cycles = options.margin;
  std::optional<ModelFrame> model;
  if (options.worst || !options.pixels.empty()) model = run_model(frame.setup);
  for (const std::string& text : options.pixels) {
    const auto [x, y] = parse_pixel(text);
    require_covered(frame, model->framebuffer, x, y);
    target.pixels.push_back({x, y});
  }
  if (options.worst) {
    const auto [x, y] = worst_pixel(frame.setup, *model);
    require_covered(frame, model->framebuffer, x, y);
    target.pixels.push_back({x, y});
  }
  if (options.triangle >= 0) target.triangle = static_cast<std::uint32_t>(options.triangle);
  if (options.span >= 0) target.span = static_cast<std::uint64_t>(options.span);
  if (!options.cycles.empty()) target.cycles = parse_cycles(options.cycles);
  target.frame = options.frame;
  const int kinds = !target.pixels.empty() + target.triangle.has_value() + target.span.has_value() +
                    target.cycles.has_value() + target.frame;
  if (kinds != 1) {
    throw InputError(
        "what to trace? Give one of --pixel X,Y, --worst, --triangle N, --span N, --cycles A:B and "
        "--frame");
  }
  return target;
}

std::string size_text(double bytes) {
  return bytes < 1e6   ? fmt::format("{:.0f} kB", bytes / 1e3)
         : bytes < 1e9 ? fmt::format("{:.1f} MB", bytes / 1e6)
                       : fmt::format("{:.1f} GB", bytes / 1e9);
}

std::int64_t cycles_in(const std::vector<CycleWindow>& windows) {
  std::int64_t cycles = 0;
  for (const CycleWindow& window : windows) cycles += window.last - window.first + 1;
  return cycles;
}

// Long traces are announced by what a piece from their middle takes.
void announce_size(const TraceCommandOptions& options, const PreparedFrame& frame,
                   const Hardware& hardware, const RtlLibrary& library, const TraceTarget& target,
                   const std::vector<CycleWindow>& windows) {
  constexpr std::int64_t kPiece = 2000, kLong = 50'000;
  constexpr double kAskFrom = 1e9;
  const std::int64_t cycles = cycles_in(windows);
  if (cycles < kLong && !target.frame) return;
  const CycleWindow& longest = *std::max_element(windows.begin(), windows.end(),
                                                 [](const CycleWindow& a, const CycleWindow& b) {
                                                   return a.last - a.first < b.last - b.first;
                                                 });
  const std::int64_t begin = std::max(longest.first, (longest.first + longest.last - kPiece) / 2);
  const CycleWindow piece_window = {begin, std::min(begin + kPiece - 1, longest.last)};
  const fs::path piece = options.file.string() + ".piece" + options.file.extension().string();
  record_trace(frame, hardware, library, {piece_window}, target, options.trace, piece);
  std::error_code none;
  const auto bytes = static_cast<double>(fs::file_size(piece, none)) * static_cast<double>(cycles) /
                     static_cast<double>(cycles_in({piece_window}));
  fs::remove(piece, none);
  tell(fmt::format("{} cycles: about {}", cycles, size_text(bytes)));
  if (bytes > kAskFrom && !options.yes) {
    throw InputError(
        fmt::format("{}: the trace takes about {}; --yes writes it, or choose a window "
                    "with --cycles A:B",
                    printable(options.file.string()), size_text(bytes)));
  }
}

int trace(const TraceCommandOptions& options) {
  const Hardware hardware = load_hardware(options.hardware.hardware, options.hardware.overrides);
  const PreparedFrame frame(load_named_scene(options.scene, options.hardware.overrides),
                            hardware.formats, hardware.setup);
  fs::path gtkwave = options.file, surfer = options.file;
  gtkwave.replace_extension(".gtkw");
  surfer.replace_extension(".sucl");
  if (options.file.extension() != ".fst" && options.file.extension() != ".vcd") {
    throw InputError(
        fmt::format("{}: waveforms are written as .fst or .vcd", printable(options.file.string())));
  }
  for (const fs::path& file : {options.file, gtkwave, surfer}) check_writable(file);

  Progress progress;
  const TraceTarget target = target_of(options, frame);
  const std::vector<CycleWindow> windows = find_windows(frame, hardware, target, options.trace);
  RtlBuildOptions build;
  build.build = RtlBuild::signals;
  build.sources = options.rtl_sources;
  build.progress = [&](const std::string& what) {
    progress(fmt::format("building the RTL with its signals for {}", what));
  };
  const RtlLibrary library(frame.setup.configuration, build);
  announce_size(options, frame, hardware, library, target, windows);
  progress("simulating to the window");
  const RecordedTrace recorded =
      record_trace(frame, hardware, library, windows, target, options.trace, options.file);
  progress.clear();
  write_text(gtkwave, gtkwave_view(recorded, windows.front(), options.file));
  write_text(surfer, surfer_view(recorded));

  std::vector<std::string> shown;
  shown.reserve(windows.size());
  for (const CycleWindow& window : windows) {
    shown.push_back(fmt::format("{}:{}", window.first, window.last));
  }
  constexpr std::size_t kMostWindows = 6;
  if (shown.size() > kMostWindows) {
    shown.resize(kMostWindows);
    shown.emplace_back("…");
  }
  const bool stopped = !recorded.failure.empty();
  std::string text = fmt::format(
      "{}  {}, {} signals, {}\n", printable(options.file.string()),
      stopped ? std::string("not all cycles")
              : fmt::format("{} cycles of {}", cycles_in(windows), recorded.frame_cycles),
      recorded.variables.size(), size_text(static_cast<double>(fs::file_size(options.file))));
  text += fmt::format("  windows  cycles {} at {:.2f} ns a cycle\n", fmt::join(shown, ", "),
                      static_cast<double>(recorded.period_ps) / 1000);
  constexpr std::size_t kMostMarkers = 8;
  for (std::size_t i = 0; i < std::min(recorded.markers.size(), kMostMarkers); ++i) {
    const TraceMarker& marker = recorded.markers[i];
    text += fmt::format("  marker   {} in cycle {}\n", marker.name, marker.cycle);
  }
  if (recorded.markers.size() > kMostMarkers) {
    text += fmt::format("           and {} more\n", recorded.markers.size() - kMostMarkers);
  }
  const std::string name = shell_word(printable(options.file.string()));
  text += fmt::format("  view     gtkwave {} {}   or   surfer {} -c {}\n", name,
                      shell_word(printable(gtkwave.string())), name,
                      shell_word(printable(surfer.string())));
  if (stopped) text += fmt::format("  stopped  {}\n", recorded.failure);
  print_or_throw(text);
  return stopped ? kCheckFailed : 0;
}

}  // namespace

void add_trace(CLI::App& application, Run& run) {
  auto options = std::make_shared<TraceCommandOptions>();
  CLI::App* command = application.add_subcommand(
      "trace", "Record a window of the waveforms of RTL and SystemC, with views of it");
  command->add_option("scene", options->scene, "Scene file, or name of a shipped scene")
      ->required()
      ->type_name("SCENE");
  command->add_option("-o,--output", options->file, "The trace; .gtkw and .sucl lie beside it")
      ->required()
      ->type_name("FILE.fst|FILE.vcd");
  command
      ->add_option("--pixel", options->pixels, "Whenever this pixel is shaded; may be given again")
      ->type_name("X,Y")
      ->allow_extra_args(false);
  command->add_flag("--worst", options->worst, "The pixel with the largest error");
  command->add_option("--triangle", options->triangle, "A triangle of the scene, from 0")
      ->type_name("N")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{0xffffffff}).description(""));
  command->add_option("--span", options->span, "A span, from 0, in the order of pixel_datapath")
      ->type_name("N")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 62).description(""));
  command->add_option("--cycles", options->cycles, "From cycle A to cycle B")->type_name("A:B");
  command->add_flag("--frame", options->frame, "The whole frame");
  command->add_flag("--yes", options->yes, "Write more than 1 GB without asking");
  command->add_option("--margin", options->margin, "Cycles before and after the target")
      ->capture_default_str()
      ->type_name("CYCLES")
      ->check(CLI::Range(0, 1'000'000).description(""));
  add_stall_options(*command, options->trace.simulation);
  add_rtl_option(*command, options->rtl_sources);
  command->add_flag("--rtl-drives", options->trace.rtl_drives,
                    "Let the RTL answer to the other modules, as verify does, and not SystemC");
  options->hardware.add_to(*command);
  command->footer(
      "Example: phongpipe trace pawn --worst -o worst.fst && gtkwave worst.fst worst.gtkw\n");
  command->callback([options, &run] { run = [options] { return trace(*options); }; });
}

}  // namespace phongpipe
