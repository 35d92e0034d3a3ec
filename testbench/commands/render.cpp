// phongpipe render: one picture, in real or fixed arithmetic.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "model/files/spelling.h"
#include "model/files/triangle_csv.h"
#include "model/fixed/coverage.h"
#include "model/fixed/model_frame.h"
#include "model/fixed/prepared_frame.h"
#include "model/scene/input_error.h"
#include "model/scene/subdivision.h"
#include "testbench/cases/named_scene.h"
#include "testbench/commands/options.h"
#include "testbench/cosim/metrics.h"
#include "testbench/drawing/pictures.h"
#include "testbench/hardware/hardware.h"
#include "testbench/methods/real_frame.h"
#include "testbench/system/output_file.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

enum class Arithmetic { real, fixed };

struct RenderCommandOptions {
  std::string scene;
  fs::path output, triangles;
  HardwareOptions hardware;
  std::optional<std::string> method;  // none: the series of the hardware
  std::optional<PowerKind> power;
  std::optional<Arithmetic> arithmetic;
};

const ShadingMethod& find_method(const std::string& name) {
  if (const ShadingMethod* method = find_shading_method(name)) return *method;
  std::vector<std::string> known;
  for (const ShadingMethod& method : shading_methods()) known.emplace_back(method.name);
  const std::string close = closest_word(name, known);
  throw InputError(fmt::format("--method {}: no such method; {}", name,
                               close.empty() ? "`phongpipe render --help` lists them"
                                             : fmt::format("did you mean {}?", close)));
}

// The hardware, with the series of the method that was asked for.
Hardware hardware_of(const RenderCommandOptions& options) {
  Hardware hardware = load_hardware(options.hardware.hardware, options.hardware.overrides);
  if (!options.method) return hardware;
  std::string_view name = *options.method;
  const std::size_t local = name.rfind(kLocalSuffix);
  if (local != std::string_view::npos) name = name.substr(0, local);
  const auto names = series_fit_names();
  const auto fit = std::find(names.begin(), names.end(), name);
  if (fit == names.end()) {
    throw InputError(fmt::format(
        "{} has no fixed-point form; use --arithmetic real, or a series of the pipeline: {}",
        *options.method, fmt::join(names, ", ")));
  }
  hardware.setup.series_fit = static_cast<SeriesFit>(fit - names.begin());
  if (hardware.setup.series_fit == SeriesFit::taylor) hardware.setup.subdivide_degrees = 0;
  return hardware;
}

void check(const RenderCommandOptions& options, Arithmetic arithmetic) {
  if (arithmetic == Arithmetic::fixed && options.power) {
    throw InputError(
        "the hardware has a table of its own, see rom_address_bits; use --power with --arithmetic "
        "real");
  }
  if (options.output.empty() && options.triangles.empty()) {
    throw InputError(
        "nothing to write: give -o FILE.png, -o FILE.pfm or --dump-triangles FILE.csv");
  }
  const std::string extension = options.output.extension().string();
  if (!options.output.empty() && extension != ".png" && extension != ".pfm") {
    throw InputError(
        fmt::format("{}: pictures are written as .png or .pfm", options.output.string()));
  }
  check_output(options.output.string());
  check_output(options.triangles.string());
}

// The bits of the hardware, as colours in LSB.
std::vector<Color> render_fixed(const RenderCommandOptions& options, const Scene& scene) {
  const Hardware hardware = hardware_of(options);
  const PreparedFrame frame(scene, hardware.formats, hardware.setup);
  const ModelFrame model = run_model(frame.setup);
  if (model.triangles.overflows > 0) {
    tell("warning: " + overflow_text(model.triangles.overflows));
  }
  return in_lsb(model.colors(), frame.setup.configuration.channels);
}

std::vector<Color> render_real(const RenderCommandOptions& options, const Scene& scene,
                               const Geometry& whole) {
  const Hardware hardware = load_hardware(options.hardware.hardware, options.hardware.overrides);
  const ShadingMethod& method =
      find_method(options.method ? *options.method : method_of(hardware, scene));
  const Geometry geometry =
      subdivide(scene, whole, method.takes_pieces ? hardware.setup.subdivide_degrees : 0).geometry;
  const Visibility visibility = find_visible(scene, geometry);
  if (method.name == "phong") return render_phong(scene, geometry, visibility);
  if (const auto reason = refusal(method, scene, geometry.materials)) {
    throw InputError(
        scene.source, 0,
        fmt::format("{} cannot render it in real arithmetic: {}", method.name, *reason));
  }
  return render_method(scene, geometry, visibility, method,
                       options.power.value_or(PowerKind::exact))
      .colors;
}

int render(const RenderCommandOptions& options) {
  const Arithmetic arithmetic =
      options.arithmetic.value_or(options.method ? Arithmetic::real : Arithmetic::fixed);
  check(options, arithmetic);
  Progress progress;
  progress("reading the scene");
  const Scene scene = load_named_scene(options.scene, options.hardware.overrides);
  const Geometry geometry = make_geometry(scene);
  progress("shading");
  std::vector<Color> colors;
  if (!options.output.empty()) {
    colors = arithmetic == Arithmetic::fixed ? render_fixed(options, scene)
                                             : render_real(options, scene, geometry);
  }
  if (!options.triangles.empty()) {
    write_text(options.triangles, triangles_csv(scene, geometry));
  }
  if (options.output.extension() == ".pfm") {
    write_pfm(options.output, colors, scene.image.width, scene.image.height);
  } else if (!options.output.empty()) {
    write_png(options.output, picture_of(colors, scene.image.width, scene.image.height,
                                         is_grey(scene, geometry) ? 1 : 3));
  }
  progress.clear();
  if (!covers_a_pixel(scene, geometry)) {
    tell("note: " + printable(nothing_covered(scene).what()));
  }
  for (const std::string& note : geometry.notes) tell("note: " + printable(note));
  return 0;
}

std::string list_methods() {
  std::string text = "\nMethods:\n";
  for (const ShadingMethod& method : shading_methods()) {
    text += fmt::format("  {:<20} {}\n", method.name, method.description);
  }
  return text;
}

}  // namespace

void add_render(CLI::App& application, Run& run) {
  auto options = std::make_shared<RenderCommandOptions>();
  CLI::App* command = application.add_subcommand("render", "Render one picture by one method");
  command->add_option("scene", options->scene, "Scene file, or name of a shipped scene")
      ->required()
      ->type_name("SCENE");
  command->add_option("-o,--output", options->output, "Picture: .png, or .pfm for floats in LSB")
      ->type_name("FILE");
  command
      ->add_option("--method", options->method,
                   "Shading method, see below; none: what the hardware computes")
      ->type_name("METHOD");
  add_choice<Arithmetic>(*command, "--arithmetic", options->arithmetic,
                         {{"real", Arithmetic::real}, {"fixed", Arithmetic::fixed}},
                         "real where a method is given, else fixed",
                         "real (double precision) or fixed (the hardware's bits)");
  add_power_option(*command, options->power);
  command
      ->add_option("--dump-triangles", options->triangles,
                   "Write the triangles as the setup engine receives them")
      ->type_name("FILE.csv");
  command->footer("Example: phongpipe render scene.toml --method phong -o exact.pfm\n" +
                  list_methods());
  options->hardware.add_to(*command);
  command->callback([options, &run] { run = [options] { return render(*options); }; });
}

}  // namespace phongpipe
