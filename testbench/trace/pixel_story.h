// The life of a pixel: which triangles cover it and which one won, what the winner's setup, span
// and registers held for it, in which cycles it left pixel_datapath, and where its error comes
// from.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/pipeline.h"
#include "sim/signals/datapath_signals.h"
#include "testbench/accuracy/error_chain.h"
#include "testbench/cosim/effect_set.h"
#include "testbench/hardware/hardware.h"
#include "testbench/rtl/rtl_library.h"

namespace phongpipe {

// The pixel of one triangle under one light, as it leaves pixel_datapath for the depth test.
struct PixelVisit {
  std::uint32_t light = 0;
  std::uint32_t triangle = 0;                            // of the scene, even if it was split
  std::uint32_t depth = 0;                               // as stored; 0 without depth test
  std::uint32_t color = 0;                               // of this light; channel 0 in the low byte
  std::optional<std::uint32_t> held_by;                  // the triangle that had the pixel before
  bool taken = false;                                    // written or added by the framebuffer
  std::optional<std::int64_t> systemc_cycle, rtl_cycle;  // in which it leaves; see add_cycles()
  std::optional<std::uint32_t> rtl_color;                // the model's, if the RTL is right
};

// A series that was not set up, or not wholly.
struct LeftOut {
  std::string what, why;
};

// T0 to T5 of a series about the expansion point, or T0 to T2 of a linear one. The T0 of diffuse
// includes the level: ambient and the rounding half.
struct SeriesCoefficients {
  std::string name;
  std::string_view unit;
  int fraction_bits = 0;     // of `rounded`
  std::vector<double> real;  // unrounded, in units, with nothing left out
  std::vector<std::int64_t> rounded;
};

// A register of pixel_datapath.
struct RegisterValue {
  DatapathSignal signal;
  std::int64_t bits = 0;
};

// The span of the pixel in pixel_datapath.
struct SpanStory {
  RowSpan row;
  int step = 0;  // of the pixel, from 0
  std::array<std::int64_t, 3> level = {};
  // The first pixel of the span in the stages that take the start values.
  std::vector<RegisterValue> start;
  std::vector<RegisterValue> registers;  // all stages, each while it holds the pixel
  DatapathPixel pixel;                   // the same, by name
  std::array<bool, 3> saturated = {};    // whether more than the output's range was left
};

// What one light does to the triangle that won, at the pixel.
struct LightStory {
  Light light;
  std::vector<LeftOut> left_out;
  // Only if the triangle is set up and its pixel shaded.
  std::optional<Pixel> expansion;
  std::vector<SeriesCoefficients> coefficients;
  std::optional<SpanStory> span;
};

struct Neighbour {
  int x = 0, y = 0;
  std::optional<std::uint32_t> triangle;  // none: the background
  std::uint32_t color = 0;
};

struct PixelStory {
  std::string scene;
  Hardware hardware;  // resolved
  DatapathConfiguration configuration;
  int x = 0, y = 0;
  std::uint32_t triangle = 0;  // the winner, of the scene
  std::uint32_t color = 0;     // in the picture; channel 0 in the low byte
  ErrorSplit error;
  bool depth_test = true;
  std::vector<PixelVisit> visits;  // in the order of the pipeline
  std::string rtl_visits;          // how often the RTL delivers the pixel, if it is not as often
  ScreenTriangle whole;
  std::optional<ScreenTriangle> piece;  // that covers the pixel, if the triangle was split
  Material material;
  Vec3 normal = Vec3::Zero();  // unit, interpolated at the pixel
  // Proved for the triangle, and whether exact_path shades it; if errors are certified.
  std::optional<Certificates::Triangle> certificate;
  EffectSet effects;
  std::vector<LightStory> lights;
  std::vector<Neighbour> neighbours;

  // Whether the RTL shaded the pixel as the model did, as far as add_cycles() looked.
  bool rtl_agrees() const;
};

// Throws InputError, which says what pixel would do, if this one is outside the image or not
// covered.
void require_covered(const PreparedFrame& frame, const Framebuffer& framebuffer, int x, int y);

// The pixel with the largest error; 0,0 if none is covered.
Pixel worst_pixel(const FrameSetup& frame, const ModelFrame& model);

// Throws InputError if the pixel is outside the image or not covered, std::logic_error if the
// colours of its visits do not give the colour in the model's picture.
PixelStory tell_story(const PreparedFrame& frame, const Hardware& hardware, const ModelFrame& model,
                      int x, int y);

// Simulates the frame in SystemC and with the RTL, each in a process of its own, and adds the
// cycles of the visits. Throws ToolError if SystemC has other visits.
void add_cycles(const PreparedFrame& frame, const RtlLibrary& library,
                const SimulationOptions& simulation, PixelStory& story);

}  // namespace phongpipe
