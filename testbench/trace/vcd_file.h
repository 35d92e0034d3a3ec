// VCD files of waveforms.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "testbench/trace/wave_file.h"

namespace phongpipe {

std::unique_ptr<WaveWriter> open_vcd(const std::filesystem::path& file,
                                     const std::vector<WaveVariable>& variables);
// False if the text is no VCD file. A file that was cut is read as far as it goes.
bool read_vcd(const std::string& text, WaveReader& reader, const WaveReader::Declare& declare,
              const WaveReader::Visit& visit);

}  // namespace phongpipe
