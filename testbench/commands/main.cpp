// The program: parses the command line and runs one command.
#include <fmt/format.h>

#include "model/scene/input_error.h"
#include "testbench/commands/options.h"

int main(int argc, char** argv) {
  CLI::App application(
      "phongpipe simulates the fixed-point pipeline of Bishop & Weimer's Fast Phong Shading "
      "(1986),\n"
      "pixel by pixel in a C++ model, in SystemC and in Verilated RTL.");
  application.name("phongpipe");
  application.require_subcommand(1);
  application.set_version_flag("--version", "phongpipe " PHONGPIPE_VERSION);
  application.footer(
      "`phongpipe COMMAND --help` tells more.\n"
      "Example: phongpipe verify testbench/scenes/teapot.toml --out out\n");
  phongpipe::Run run;
  phongpipe::add_render(application, run);
  phongpipe::add_compare(application, run);
  phongpipe::add_verify(application, run);
  constexpr int kBadInput = 2;
  try {
    application.parse(argc, argv);
    return run();
  } catch (const CLI::Success& help) {
    return application.exit(help);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "phongpipe: {}; see phongpipe --help\n", error.what());
  } catch (const phongpipe::InputError& error) {
    fmt::print(stderr, "phongpipe: {}\n", error.what());
  } catch (const std::exception& error) {
    fmt::print(stderr, "phongpipe: {}\n", error.what());
  }
  return kBadInput;
}
