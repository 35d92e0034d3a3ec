// stb's PNG writer, with zlib in the place of its own slow compressor.
#include <zlib.h>

#include <array>
#include <cstdlib>
#include <cstring>

#include "testbench/system/large_memory.h"
#include "testbench/system/parallel.h"

namespace {

// The level at which writing a picture takes less time than computing it.
constexpr int kFast = 1;

// One of the parts into which data is cut, compressed without a header, up to a whole byte.
struct Part {
  const unsigned char* data = nullptr;
  uInt length = 0;
  bool last = false;
  unsigned char* out = nullptr;  // freed by whoever called
  uLong size = 0, checksum = 0;

  void compress() {
    z_stream stream{};
    constexpr int kRaw = -15, kMemory = 8;
    if (deflateInit2(&stream, kFast, Z_DEFLATED, kRaw, kMemory, Z_DEFAULT_STRATEGY) != Z_OK) return;
    const uLong bound = deflateBound(&stream, length) + 16;  // of the flush
    out = static_cast<unsigned char*>(phongpipe::allocate_large(bound));
    if (out != nullptr) {
      stream.next_in = const_cast<unsigned char*>(data);
      stream.avail_in = length;
      stream.next_out = out;
      stream.avail_out = static_cast<uInt>(bound);
      deflate(&stream, last ? Z_FINISH : Z_SYNC_FLUSH);
      size = stream.total_out;
      checksum = adler32(adler32(0, nullptr, 0), data, length);
    }
    deflateEnd(&stream);
  }
};

// In two parts, on two cores: a stream of zlib is its header, parts that end on whole bytes, and
// the checksum of all.
unsigned char* compress_fast(unsigned char* data, int length, int* compressed_length, int) {
  std::array<Part, 2> parts;
  const auto all = static_cast<uInt>(length), first = all / 2;
  parts[0] = {data, first, false};
  parts[1] = {data + first, all - first, true};
  phongpipe::run_parts(2, false, [&parts](std::uint32_t i) { parts[i].compress(); });
  constexpr std::array<unsigned char, 2> kHeader = {0x78, 0x01};
  constexpr std::size_t kEnds = 6;
  unsigned char* out = nullptr;
  if (parts[0].out != nullptr && parts[1].out != nullptr) {
    out = static_cast<unsigned char*>(
        phongpipe::allocate_large(parts[0].size + parts[1].size + kEnds));  // stb frees it
  }
  if (out != nullptr) {
    unsigned char* end = std::copy(kHeader.begin(), kHeader.end(), out);
    for (const Part& part : parts) end = std::copy(part.out, part.out + part.size, end);
    const uLong checksum = adler32_combine(parts[0].checksum, parts[1].checksum,
                                           static_cast<z_off_t>(parts[1].length));
    for (int shift = 24; shift >= 0; shift -= 8) {
      *end++ = static_cast<unsigned char>(checksum >> shift);
    }
    *compressed_length = static_cast<int>(end - out);
  }
  for (const Part& part : parts) std::free(part.out);
  return out;
}

}  // namespace

#define STBIW_MALLOC(size) phongpipe::allocate_large(size)
#define STBIW_REALLOC(memory, size) std::realloc(memory, size)
#define STBIW_FREE(memory) std::free(memory)
#define STBIW_ZLIB_COMPRESS compress_fast
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>
