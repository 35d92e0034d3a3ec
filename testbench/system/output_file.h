// What the program writes: files that are whole or not there, and a standard output that is not
// lost without a word.
#pragma once

#include <filesystem>
#include <string_view>

namespace phongpipe {

// A file is written under another name and then renamed, so that none is left half written; it
// keeps its permissions, and a symbolic link to it stays one. Devices, pipes and sockets, and the
// files that are our standard output or error, are written through. Throws InputError where nothing
// can be written to that place, ToolError where the disk is full or the write fails.
void write_text(const std::filesystem::path& file, std::string_view text);

// Throws InputError where write_text() would not find a place to write to; changes nothing. To be
// called before long work.
void check_writable(const std::filesystem::path& file);

// To standard output, at once. Throws ToolError where that, or what was printed before, is lost.
void print_or_throw(std::string_view text);

}  // namespace phongpipe
