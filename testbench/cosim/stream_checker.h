// Compares the pixels of an implementation with the model's: by hashes, and pixel by pixel if the
// hashes differ. The stream is never stored; it may be far larger than the image.
#pragma once

#include "model/fixed/model_frame.h"
#include "testbench/cosim/implementation_result.h"
#include "testbench/system/fnv_hash.h"

namespace phongpipe {

// Hashes a stream of pixels as it arrives.
class StreamHash {
 public:
  void add(const ShadedPixel& pixel) {
    stream_.add(std::uint64_t{pixel.color} << 32 | std::uint64_t{pixel.y} << 16 | pixel.x);
    ++pixels_;
  }
  // Of a span.
  void add(const RowSpan& row, const std::uint32_t* colors) {
    for (int i = 0; i < row.length; ++i) {
      add({static_cast<std::uint16_t>(row.x + i), static_cast<std::uint16_t>(row.y), colors[i]});
    }
  }
  void add(const ShadedPixel* pixels, const std::int64_t* cycles, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      add(pixels[i]);
      cycles_.add(static_cast<std::uint64_t>(cycles[i]));
    }
  }
  Fingerprint fingerprint() const { return {pixels_, stream_.value(), 0, cycles_.value()}; }
  // Includes the hash of the final frame, as an image of three channels.
  Fingerprint fingerprint(const Framebuffer& framebuffer, int channels) const;

 private:
  FnvHash stream_, cycles_;
  std::uint64_t pixels_ = 0;
};

// Whether two streams have the same pixels.
inline bool same_stream(const Fingerprint& a, const Fingerprint& b) {
  return a.pixels == b.pixels && a.stream_hash == b.stream_hash;
}

// Number of pixels that differ in the final frames. A grey frame is compared with all channels of a
// colour frame.
std::uint64_t count_frame_mismatches(const Framebuffer& model, int model_channels,
                                     const Framebuffer& found, int channels);

// Runs the model beside a stream and finds where they differ, until kMismatchesCounted pixels have.
class StreamChecker {
 public:
  explicit StreamChecker(const FrameSetup& frame) : model_(frame) {}

  void observe(const ShadedPixel& pixel, std::int64_t cycle);
  // Call after the last pixel: remaining pixels of the model count as missing. `cycle`: the cycle
  // of the end.
  void finish(std::int64_t cycle);

  std::uint64_t mismatches() const { return mismatches_; }
  bool enough() const { return mismatches_ == kMismatchesCounted; }
  const std::optional<Divergence>& first() const { return first_; }

 private:
  // The model's next pixel; false where it has no more.
  bool next(ShadedPixel& pixel);
  // Counts a difference at the current pixel of the stream, whose place in it is filled in.
  void record(Divergence difference);

  SpanStream model_;
  int next_in_span_ = 0, span_length_ = 0;
  std::uint32_t triangle_ = 0;  // of the current span
  std::uint64_t spans_ = 0;     // begun, in the model
  std::uint64_t stream_index_ = 0;
  std::uint64_t mismatches_ = 0;
  std::optional<Divergence> first_;
};

}  // namespace phongpipe
