// stb's PNG writer, with zlib in the place of its own slow compressor.
#include <zlib.h>

#include <cstdlib>
#include <cstring>

#include "testbench/system/large_memory.h"

namespace {

// The level at which writing a picture takes less time than computing it.
constexpr int kFast = 1;

unsigned char* compress_fast(unsigned char* data, int length, int* compressed_length, int) {
  uLongf size = compressBound(static_cast<uLong>(length));
  auto* out = static_cast<unsigned char*>(phongpipe::allocate_large(size));  // stb frees it
  if (out == nullptr) return nullptr;
  if (compress2(out, &size, data, static_cast<uLong>(length), kFast) != Z_OK) {
    std::free(out);
    return nullptr;
  }
  *compressed_length = static_cast<int>(size);
  return out;
}

}  // namespace

#define STBIW_MALLOC(size) phongpipe::allocate_large(size)
#define STBIW_REALLOC(memory, size) std::realloc(memory, size)
#define STBIW_FREE(memory) std::free(memory)
#define STBIW_ZLIB_COMPRESS compress_fast
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>
