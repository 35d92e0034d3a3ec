// FST files of waveforms, by GTKWave's library.
//
// They are sequences of blocks. The library writes the names of the variables last, so that of a
// file that was cut nothing could be read; here they are moved to the beginning.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "testbench/trace/wave_file.h"

namespace phongpipe {

std::unique_ptr<WaveWriter> open_fst(const std::filesystem::path& file,
                                     const std::vector<WaveVariable>& variables);
// False if it is no FST file, or one without names. A file that was cut is read up to its last
// whole block.
bool read_fst(const std::filesystem::path& file, WaveReader& reader,
              const WaveReader::Declare& declare, const WaveReader::Visit& visit);

}  // namespace phongpipe
