// Output of the program: files that are whole or absent, and standard output whose loss is
// reported.
#pragma once

#include <filesystem>
#include <string_view>

namespace phongpipe {

// Writes a file under another name and renames it, so that it is never left half written. The file
// keeps its permissions, and a symbolic link to it stays one. Devices, pipes and sockets, and the
// files that are our standard output or error, are written directly. Throws InputError if nothing
// can be written to that place, ToolError if the disk is full or the write fails.
void write_text(const std::filesystem::path& file, std::string_view text);

// Throws InputError if write_text() could not write to that place; changes nothing. Call it before
// long work.
void check_writable(const std::filesystem::path& file);

// Makes a folder and those around it, where they are not there. Throws InputError if it cannot.
void make_folder(const std::filesystem::path& folder);

// Prints to standard output at once. Throws ToolError if this text, or text printed before, is
// lost.
void print_or_throw(std::string_view text);

}  // namespace phongpipe
