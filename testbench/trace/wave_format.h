// What the FST and VCD files of waveforms have in common.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "model/files/text_file.h"
#include "testbench/rtl/tool_folder.h"
#include "testbench/system/terminal.h"
#include "testbench/trace/wave_file.h"

namespace phongpipe {

constexpr std::size_t kMaxScopes = 256;  // within each other

// Calls begin and end for the scopes between two variables, so that scopes nest.
template <typename Begin, typename End>
void change_scope(const std::string& from, const std::string& to, const Begin& begin,
                  const End& end) {
  const std::vector<std::string_view> old_parts = split(from, '.'), new_parts = split(to, '.');
  std::size_t same = 0;
  while (same < old_parts.size() && same < new_parts.size() && old_parts[same] == new_parts[same] &&
         !from.empty()) {
    ++same;
  }
  if (!from.empty()) {
    for (std::size_t i = old_parts.size(); i > same; --i) end();
  }
  if (!to.empty()) {
    for (std::size_t i = same; i < new_parts.size(); ++i) begin(std::string(new_parts[i]));
  }
}

// The file in a folder of its own, beside its place, until it is complete.
class PartialFile {
 public:
  // Throws InputError if the file cannot be written.
  explicit PartialFile(const std::filesystem::path& file);

  std::string name() const { return folder_->path() / file_.filename(); }
  void complete() const;
  [[noreturn]] void fail(const std::string& reason) const;

 private:
  std::filesystem::path file_;
  std::unique_ptr<ToolFolder> folder_;
};

// Splits "v [9:-16]" and "v[9:-16]" into name and width; without a range the width is given.
WaveVariable variable_of(const std::string& scope, const std::string& declared, int width,
                         bool real);

}  // namespace phongpipe
