// phongpipe render: one picture, in real or fixed arithmetic.
#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <sstream>

#include "model/fixed/coverage.h"
#include "model/fixed/model_frame.h"
#include "model/scene/input_error.h"
#include "model/shading/phong.h"
#include "testbench/commands/commands.h"
#include "testbench/hardware.h"
#include "testbench/pictures.h"
#include "testbench/real_frame.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

enum class Method { phong, taylor };
enum class Arithmetic { real, fixed };

struct Options {
  std::string scene;
  fs::path output, triangles;
  HardwareOptions hardware;
  Method method = Method::taylor;
  std::optional<Arithmetic> arithmetic;
};

bool is_pfm(const fs::path& file) {
  return file.extension() == ".pfm";
}

int render(const Options& options) {
  const Arithmetic arithmetic = options.arithmetic.value_or(
      options.method == Method::phong ? Arithmetic::real : Arithmetic::fixed);
  if (options.method == Method::phong && arithmetic == Arithmetic::fixed) {
    throw InputError(
        "exact Phong has no fixed-point form; use --arithmetic real, or --method taylor");
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
  Progress progress;
  progress("reading the scene");
  const Scene scene = load_scene(find_scene(options.scene));
  const Geometry geometry = make_geometry(scene);
  progress("shading");
  if (!options.triangles.empty()) {
    std::ostringstream csv;
    dump_triangles(csv, scene, geometry);
    write_text(options.triangles, csv.str());
  }
  if (options.output.empty()) return 0;

  Hardware hardware = load_hardware(options.hardware.hardware, options.hardware.overrides);
  suit_scene(hardware, scene, geometry);
  const auto [width, height] = std::pair(scene.image.width, scene.image.height);
  if (options.method == Method::taylor && arithmetic == Arithmetic::fixed) {
    const FrameSetup frame(scene, geometry, hardware.datapath, hardware.pipeline.depth_bits);
    const ModelFrame model = run_model(frame, geometry);
    if (model.coefficient_overflows > 0) {
      fmt::print(stderr, "warning: {} triangles have values that do not fit their registers\n",
                 model.coefficient_overflows);
    }
    const std::vector<std::uint32_t> colors = model.colors();
    if (is_pfm(options.output)) {
      write_pfm(options.output, in_lsb(colors, hardware.datapath.channels), width, height);
    } else {
      write_png(options.output, picture_of(colors, width, height, hardware.datapath.channels));
    }
    return 0;
  }
  std::vector<Color> colors;
  if (options.method == Method::phong) {
    colors = render_phong(scene, geometry);
  } else {
    const FrameSetup frame(scene, geometry, hardware.datapath, hardware.pipeline.depth_bits);
    colors = render_taylor(scene, geometry, frame);
  }
  if (is_pfm(options.output)) {
    write_pfm(options.output, colors, width, height);
  } else {
    write_png(options.output, picture_of(colors, width, height, is_grey(scene, geometry) ? 1 : 3));
  }
  return 0;
}

}  // namespace

void add_render(CLI::App& application, Run& run) {
  auto options = std::make_shared<Options>();
  CLI::App* command = application.add_subcommand("render", "Render one picture by one method");
  command->add_option("scene", options->scene, "Scene file, or name of a shipped scene")
      ->required()
      ->type_name("SCENE");
  command->add_option("-o,--output", options->output, "Picture: .png, or .pfm for floats in LSB")
      ->type_name("FILE");
  const std::map<std::string, Method> methods = {{"phong", Method::phong},
                                                 {"taylor", Method::taylor}};
  command->add_option("--method", options->method, "phong (exact) or taylor")
      ->transform(CLI::CheckedTransformer(methods))
      ->default_str("taylor");
  const std::map<std::string, Arithmetic> arithmetics = {{"real", Arithmetic::real},
                                                         {"fixed", Arithmetic::fixed}};
  command
      ->add_option("--arithmetic", options->arithmetic,
                   "real (double precision) or fixed (the hardware's bits)")
      ->transform(CLI::CheckedTransformer(arithmetics))
      ->default_str("fixed for taylor, real for phong");
  command
      ->add_option("--dump-triangles", options->triangles,
                   "Write the triangles as the setup engine receives them")
      ->type_name("FILE.csv");
  command->footer("Example: phongpipe render scene.toml --method phong -o exact.pfm\n");
  options->hardware.add_to(*command);
  command->callback([options, &run] { run = [options] { return render(*options); }; });
}

}  // namespace phongpipe
