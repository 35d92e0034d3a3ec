#include "testbench/trace/wave_file.h"

#include <fmt/format.h>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "testbench/system/terminal.h"
#include "testbench/trace/fst_file.h"
#include "testbench/trace/vcd_file.h"

namespace phongpipe {
namespace fs = std::filesystem;

std::string WaveVariable::range() const {
  if (real || width == 1) return {};
  return fmt::format("[{}:{}]", width - 1 - fraction_bits, -fraction_bits);
}

std::unique_ptr<WaveWriter> WaveWriter::open(const fs::path& file,
                                             const std::vector<WaveVariable>& variables) {
  if (file.extension() == ".fst") return open_fst(file, variables);
  if (file.extension() == ".vcd") return open_vcd(file, variables);
  throw InputError(
      fmt::format("{}: waveforms are written as .fst or .vcd", printable(file.string())));
}

WaveReader WaveReader::read(const fs::path& file, const Declare& declare, const Visit& visit) {
  WaveReader reader;
  const std::string text = read_whole_file(file);
  if (!text.empty() && text.front() == '\0') {
    if (read_fst(file, reader, declare, visit)) return reader;
    throw InputError(
        fmt::format("{}: an FST file that is damaged, or was cut before its names, which some "
                    "programs write last",
                    printable(file.string())));
  }
  if (!read_vcd(text, reader, declare, visit)) {
    throw InputError(fmt::format("{}: no VCD or FST file", printable(file.string())));
  }
  return reader;
}

}  // namespace phongpipe
