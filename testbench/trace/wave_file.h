// Waveform files: FST, by GTKWave's library, and VCD. Times are in ps.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace phongpipe {

// A variable of a waveform.
struct WaveVariable {
  std::string scope;  // "phongpipe.rtl.pixel_datapath"
  std::string name = {};
  int width = 1;          // bits
  int fraction_bits = 0;  // of them; the word is declared [high:−fraction_bits]
  bool real = false;      // a real number, in place of a word
  bool is_signed = false;

  std::string full_name() const { return scope + "." + name; }
  // "[9:-16]" of a word of more than one bit, else empty.
  std::string range() const;
};

// Writes a waveform to a file of its own. The file is complete once close() has returned, and gone
// if the writer is destroyed before.
class WaveWriter {
 public:
  // `variables` sorted by scope. The extension of `file` says which format: .fst or .vcd. Throws
  // InputError for another one, and if the file cannot be written.
  static std::unique_ptr<WaveWriter> open(const std::filesystem::path& file,
                                          const std::vector<WaveVariable>& variables);
  virtual ~WaveWriter() = default;

  // Times must not decrease.
  virtual void time(std::uint64_t ps) = 0;
  // Variable `index` takes a value: a word's 0s, 1s and xs from the highest bit, or a number.
  virtual void change(std::size_t index, const std::string& text) = 0;
  // Throws ToolError if something was not written.
  virtual void close() = 0;
};

// What a waveform contains, read from a file.
struct WaveReader {
  std::vector<WaveVariable> variables;  // range as declared, without fraction
  bool complete = true;                 // false: the file ends before its end

  // Called once, before all changes.
  using Declare = std::function<void(const std::vector<WaveVariable>& variables)>;
  // Called for every change, in the order of time. `index`: of the variable.
  using Visit = std::function<void(std::uint64_t ps, std::size_t index, const std::string& value)>;
  // Reads a file, whatever its name. One that was cut is read as far as it goes. Throws InputError
  // if it is no waveform.
  static WaveReader read(const std::filesystem::path& file, const Declare& declare,
                         const Visit& visit);
};

}  // namespace phongpipe
