#include "testbench/trace/pixel_story.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "model/files/text_file.h"
#include "model/fixed/depth_cue.h"
#include "model/scene/input_error.h"
#include "model/scene/tool_error.h"
#include "model/shading/screen_interpolator.h"
#include "testbench/accuracy/accuracy.h"
#include "testbench/rtl/rtl_library.h"
#include "testbench/system/process.h"
#include "testbench/system/record_json.h"

namespace phongpipe {
namespace {

// Runs a span alone and without stalls.
SpanStory run_span(const FrameSetup& frame, const Span& span, int x) {
  const DatapathConfiguration& configuration = frame.configuration;
  SpanStory story;
  story.row = span.row;
  story.step = x - span.row.x;
  story.level = span.level;
  DatapathRegisters registers(configuration, frame.cue_color);
  DatapathInputs inputs;
  if (span.highlight) {
    inputs.table = &frame.tables[span.table];
    for (; inputs.rom_address < configuration.rom_words(); ++inputs.rom_address) {
      registers.clock(inputs);
    }
    inputs.table = nullptr;
  }
  const std::vector<DatapathSignal> signals = datapath_signals(configuration);
  inputs.pixel_ready = true;
  inputs.span = &span;
  // Of a wide datapath, the lane and its pixel.
  const int lanes = configuration.lanes(), lane = story.step % lanes, step = story.step / lanes;
  const auto in_lane = [&](const DatapathSignal& signal) {
    return lanes == 1 || !starts_with(signal.scope, "lane[") ||
           starts_with(signal.scope, fmt::format("lane[{}]", lane));
  };
  const int start = configuration.lane_stages();
  const int entrance = start + step * configuration.interval_cycles();
  const auto has_start = [&](int stage) {
    return configuration.kind == DatapathKind::serial ? stage <= kWholeStage
                                                      : stage == 1 || stage < 0;
  };
  for (int clock = 0; clock < entrance + configuration.latency_cycles(); ++clock) {
    registers.clock(inputs);
    inputs.span = nullptr;
    if (clock == entrance) {
      const auto own = static_cast<std::size_t>(lane);
      story.pixel = (lanes == 1 ? registers : registers.lane(own)).in_stage(0);
    }
    for (const DatapathSignal& signal : signals) {
      const int entered = clock - registers.clocks_to(signal.stage);
      const bool of_pixel = signal.meaning == Meaning::every_pixel ||
                            (signal.meaning == Meaning::first_pixel && entered == start);
      if (!of_pixel || signal.of_digit || !in_lane(signal)) continue;
      if (entered == start && has_start(signal.stage)) {
        story.start.push_back({signal, signal.value(registers)});
      }
      if (entered == entrance && signal.stage >= 0) {
        story.registers.push_back({signal, signal.value(registers)});
      }
    }
  }
  for (std::size_t c = 0; c < static_cast<std::size_t>(configuration.channels); ++c) {
    const std::int32_t cue = span.first_pass ? frame.cue_color[c] : 0, sum = story.pixel.sum[c];
    story.saturated[c] =
        (configuration.depth_cue ? faded(sum, cue, story.pixel.cue_factor) : sum) > kOutputMax;
  }
  return story;
}

std::string channel_of(const char* series, std::size_t channel, int channels) {
  constexpr const char* kColors[] = {"red", "green", "blue"};
  return channels == 1 ? series : fmt::format("{} {}", series, kColors[channel]);
}

std::vector<SeriesCoefficients> coefficients_of(const FrameSetup& frame,
                                                const TriangleSetup& setup) {
  const FrameConfiguration& f = frame.configuration;
  const TriangleCoefficients<double> real =
      SetupEngine(frame).coefficients(setup.triangle, setup.pass, setup.x, setup.y);
  std::vector<SeriesCoefficients> all;
  const auto add = [&](std::string name, const char* unit, int fraction_bits,
                       const Quadratic<double>& t, const FixedQuadratic& r) {
    all.push_back({std::move(name),
                   unit,
                   fraction_bits,
                   {t.t0, t.t1, t.t2, t.t3, t.t4, t.t5},
                   {r.t0, r.t1, r.t2, r.t3, r.t4, r.t5}});
  };
  const auto add_linear = [&](const char* name, const char* unit, int fraction_bits,
                              const Linear<double>& q, const FixedLinear& r) {
    all.push_back({name, unit, fraction_bits, {q.c, q.b, q.a}, {r.c, r.b, r.a}});
  };
  const int diffuse_bits = setup_fraction_bits(f, f.diffuse_fraction_bits);
  if (is_present(setup.plan.diffuse)) {
    for (std::size_t c = 0; c < static_cast<std::size_t>(f.channels); ++c) {
      Quadratic<double> with_level = real.diffuse[c];
      with_level.t0 +=
          std::ldexp(static_cast<double>(setup.material->level[c]), -f.diffuse_fraction_bits);
      add(channel_of("diffuse", c, f.channels), "LSB", diffuse_bits, with_level, setup.diffuse[c]);
    }
  }
  if (is_present(setup.plan.specular)) {
    Quadratic<double> with_offset = real.specular;
    with_offset.t0 += setup.material->offset_in_addresses();
    add("specular", "address", setup_fraction_bits(f, f.specular_fraction_bits), with_offset,
        setup.specular);
  }
  if (is_present(setup.plan.gate)) add("gate", "LSB", diffuse_bits, real.gate, setup.gate);
  if (setup.plan.depth_cue) {
    add_linear("cue_factor", "", setup_fraction_bits(f, kCueFraction), real.cue_factor,
               setup.cue_factor);
  }
  if (setup.plan.depth) add_linear("depth", "step", kDepthFraction, real.depth, setup.depth);
  return all;
}

// Series that the material has under the light, and the triangle has not.
void compare_plans(const SeriesPlan& material, const SeriesPlan& triangle,
                   std::vector<LeftOut>& left_out) {
  const auto compare = [&](const char* name, SeriesForm whole, SeriesForm own, const char* why) {
    if (is_present(whole) && !is_present(own)) left_out.push_back({name, why});
    if (whole == SeriesForm::fitted && own == SeriesForm::constant) {
      left_out.push_back({fmt::format("T1 to T5 of {}", name), "all normals are equal"});
    }
  };
  if (triangle.exact_path) {
    left_out.push_back({"the series", "exact_path shades the triangle, all lights at once"});
    return;
  }
  constexpr const char* kFacesAway = "the triangle faces away from the light, by the bound of N·L";
  const char* const no_highlight =
      triangle.highlight_invisible ? "the highlight is invisible, by its bound" : kFacesAway;
  compare("diffuse", material.diffuse, triangle.diffuse, kFacesAway);
  compare("specular", material.specular, triangle.specular, no_highlight);
  compare("gate", material.gate, triangle.gate, no_highlight);
}

class StoryTeller {
 public:
  StoryTeller(const PreparedFrame& frame, const ModelFrame& model, int x, int y)
      : frame_(frame), setup_(frame.setup), front_end_(frame.setup), model_(model), x_(x), y_(y) {}

  PixelStory tell(const Hardware& hardware) {
    const std::uint32_t winner = model_.framebuffer.owner(index());
    story_.scene = frame_.scene().source;
    story_.hardware = resolved(hardware, setup_.configuration);
    story_.configuration = setup_.configuration;
    story_.x = x_;
    story_.y = y_;
    story_.triangle = whole(winner);
    story_.color = model_.framebuffer.color(index());
    story_.error = split_error(frame_, model_, misplaced_pixels(setup_, model_, false), x_, y_);
    story_.depth_test = setup_.depth_test;
    story_.effects = effects_of(setup_);
    describe_triangle(winner);
    tell_lights(winner);
    tell_neighbours();
    return std::move(story_);
  }

 private:
  std::size_t index() const { return model_.framebuffer.index_of(x_, y_); }
  std::uint32_t whole(std::uint32_t piece) const { return frame_.subdivision().whole[piece]; }

  void describe_triangle(std::uint32_t winner) {
    story_.whole = frame_.prepared->geometry.triangles[story_.triangle];
    const auto& pieces = frame_.subdivision().whole;
    if (std::count(pieces.begin(), pieces.end(), story_.triangle) > 1) {
      story_.piece = frame_.geometry().triangles[winner];
    }
    story_.material = frame_.geometry().materials[story_.whole.material];
    if (setup_.certificates) story_.certificate = setup_.certificates->triangles[winner];
    const auto& v = story_.whole.vertices;
    const Linear<Vec3> normal =
        screen_interpolator(story_.whole)(v[0].normal, v[1].normal, v[2].normal);
    story_.normal = (normal.a * (x_ + 0.5) + normal.b * (y_ + 0.5) + normal.c).normalized();
  }

  std::vector<std::uint32_t> covering_triangles() const {
    std::vector<std::uint32_t> covering;
    std::vector<RowSpan> rows;
    for (std::uint32_t t = 0; t < front_end_.triangles(); ++t) {
      cover(frame_.geometry().triangles[t], setup_.width, setup_.height, rows);
      if (find_row(rows) != nullptr) covering.push_back(t);
    }
    return covering;
  }
  // The row that covers the pixel, or null.
  const RowSpan* find_row(const std::vector<RowSpan>& rows) const {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const RowSpan& row) {
      return row.y == y_ && row.x <= x_ && x_ < row.x + row.length;
    });
    return found == rows.end() ? nullptr : &*found;
  }

  // All visits go through a framebuffer as those of the whole frame do.
  void tell_lights(std::uint32_t winner) {
    Framebuffer framebuffer(setup_, Framebuffer::Owners::kept);
    const std::vector<std::uint32_t> covering = covering_triangles();
    for (std::uint32_t pass = 0; pass < setup_.passes; ++pass) {
      for (const std::uint32_t triangle : covering) {
        LightStory light = tell_light(triangle, pass, framebuffer);
        if (triangle == winner) story_.lights.push_back(std::move(light));
      }
    }
    if (framebuffer.color(index()) != story_.color || framebuffer.owner(index()) != winner) {
      throw std::logic_error(
          fmt::format("pixel {},{}: its triangles do not give the pixel of the picture", x_, y_));
    }
  }

  LightStory tell_light(std::uint32_t triangle, std::uint32_t pass, Framebuffer& framebuffer) {
    LightStory light;
    light.light = frame_.scene().lights[pass];
    const SeriesPlan& plan =
        setup_.material(pass, frame_.geometry().triangles[triangle].material).plan;
    if (!is_present(plan.diffuse)) {
      light.left_out.push_back({"diffuse", "the material has none under this light"});
    }
    if (!is_present(plan.specular)) {
      light.left_out.push_back({"specular", "the material has none under this light"});
    }
    TriangleWork work;
    const SetupOutcome outcome = front_end_.set_up(triangle, pass, work);
    if (outcome != SetupOutcome::nothing) {
      compare_plans(plan, work.setup.plan, light.left_out);
    }
    const RowSpan* const row = find_row(work.rows);
    const bool reaches = is_present(plan.diffuse) || is_present(plan.specular);
    if (reaches && (row == nullptr || !row->lit)) {
      light.left_out.push_back({"the light", "the pixel is outside its cone"});
    }
    if (outcome != SetupOutcome::ready || row == nullptr) return light;

    const Span span = front_end_.span_walker().start(work.setup, *row);
    light.expansion = Pixel{work.setup.x, work.setup.y};
    light.coefficients = coefficients_of(setup_, work.setup);
    light.span = run_span(setup_, span, x_);
    PixelVisit visit;
    visit.light = pass;
    visit.triangle = whole(triangle);
    visit.depth = Framebuffer::depth(setup_, span, light.span->step);
    visit.color = light.span->pixel.color;
    if (framebuffer.covered(index())) visit.held_by = whole(framebuffer.owner(index()));
    visit.taken = framebuffer.take(span.first_pass, x_, y_, visit.depth, triangle, visit.color);
    story_.visits.push_back(visit);
    return light;
  }

  void tell_neighbours() {
    const Framebuffer& framebuffer = model_.framebuffer;
    for (int y = std::max(0, y_ - 1); y <= std::min(setup_.height - 1, y_ + 1); ++y) {
      for (int x = std::max(0, x_ - 1); x <= std::min(setup_.width - 1, x_ + 1); ++x) {
        if (x == x_ && y == y_) continue;
        const std::size_t place = framebuffer.index_of(x, y);
        Neighbour neighbour{x, y, {}, framebuffer.color(place)};
        if (framebuffer.covered(place)) neighbour.triangle = whole(framebuffer.owner(place));
        story_.neighbours.push_back(neighbour);
      }
    }
  }

  const PreparedFrame& frame_;
  const FrameSetup& setup_;
  FrontEnd front_end_;
  const ModelFrame& model_;
  int x_, y_;
  PixelStory story_;
};

// The cycle in which a pixel leaves an implementation, and its colour.
using Exit = std::pair<std::int64_t, std::uint32_t>;

// All of one pixel, and why the simulation ended before the frame's end, if it did.
using Exits = std::pair<std::vector<Exit>, std::string>;

// Of the story's pixel; SystemC's own datapath is used without a library.
Exits exits_of(const FrameSetup& frame, const PixelStory& story, SimulationOptions options,
               const RtlLibrary* library) {
  Exits result;
  auto& [exits, failure] = result;
  options.observe = [&exits = exits, &story](const ShadedPixel* pixels, const std::int64_t* cycles,
                                             std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (pixels[i].x == story.x && pixels[i].y == story.y) {
        exits.emplace_back(cycles[i], pixels[i].color);
      }
    }
  };
  std::optional<RtlDatapath> datapath;
  if (library != nullptr) options.datapath = &datapath.emplace(*library, frame.cue_color);
  failure = simulate(frame, story.hardware.pipeline, options).failure;
  return result;
}

}  // namespace

bool PixelStory::rtl_agrees() const {
  return rtl_visits.empty() &&
         std::all_of(visits.begin(), visits.end(), [](const PixelVisit& visit) {
           return visit.rtl_color.value_or(visit.color) == visit.color;
         });
}

void require_covered(const PreparedFrame& frame, const Framebuffer& framebuffer, int x, int y) {
  const int width = frame.setup.width, height = frame.setup.height;
  const auto refuse = [&](const std::string& reason) {
    throw InputError(frame.scene().source, 0, fmt::format("pixel {},{} {}", x, y, reason));
  };
  if (x < 0 || x >= width || y < 0 || y >= height) {
    refuse(fmt::format("is outside the image; x goes from 0 to {}, y from 0 to {}", width - 1,
                       height - 1));
  }
  if (framebuffer.covered(framebuffer.index_of(x, y))) return;
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  std::size_t nearest = 0;
  framebuffer.for_each_covered([&](std::size_t index, std::uint32_t) {
    const std::int64_t dx = static_cast<std::int64_t>(index) % width - x;
    const std::int64_t dy = static_cast<std::int64_t>(index) / width - y;
    if (dx * dx + dy * dy >= least) return;
    least = dx * dx + dy * dy;
    nearest = index;
  });
  if (least == std::numeric_limits<std::int64_t>::max()) {
    refuse("is not covered, nor is any other; look at the camera and the objects");
  }
  refuse(fmt::format("is not covered; the nearest that is: {},{}, of triangle {}",
                     nearest % static_cast<std::size_t>(width),
                     nearest / static_cast<std::size_t>(width),
                     frame.subdivision().whole[framebuffer.owner(nearest)]));
}

Pixel worst_pixel(const FrameSetup& frame, const ModelFrame& model) {
  const Accuracy accuracy = measure_accuracy(frame, model, {false});
  if (accuracy.worst_pixels.empty()) return {};  // told as not covered
  const std::size_t index = accuracy.worst_pixels.front().index;
  const auto width = static_cast<std::size_t>(frame.width);
  return {static_cast<int>(index % width), static_cast<int>(index / width)};
}

PixelStory tell_story(const PreparedFrame& frame, const Hardware& hardware, const ModelFrame& model,
                      int x, int y) {
  require_covered(frame, model.framebuffer, x, y);
  return StoryTeller(frame, model, x, y).tell(hardware);
}

void add_cycles(const PreparedFrame& frame, const RtlLibrary& library,
                const SimulationOptions& simulation, PixelStory& story) {
  const auto simulate_with = [&](const RtlLibrary* datapath) {
    return [&frame, &story, &simulation, datapath] {
      return to_bytes(exits_of(frame.setup, story, simulation, datapath));
    };
  };
  Child rtl(simulate_with(&library)), systemc(simulate_with(nullptr));
  const auto wait_for = [](Child& child) { return from_bytes<Exits>(child.get()); };
  const auto times = [&story](const char* name, const Exits& found) {
    return fmt::format("{} delivers the pixel {} times, the model {}{}", name, found.first.size(),
                       story.visits.size(),
                       found.second.empty() ? "" : fmt::format(" ({})", found.second));
  };
  const Exits from_systemc = wait_for(systemc), from_rtl = wait_for(rtl);
  if (from_systemc.first.size() != story.visits.size()) {
    throw ToolError(times("SystemC", from_systemc));
  }
  if (from_rtl.first.size() != story.visits.size()) story.rtl_visits = times("the RTL", from_rtl);
  for (std::size_t i = 0; i < story.visits.size(); ++i) {
    PixelVisit& visit = story.visits[i];
    visit.systemc_cycle = from_systemc.first[i].first;
    if (i >= from_rtl.first.size()) continue;
    std::tie(visit.rtl_cycle, visit.rtl_color) = from_rtl.first[i];
  }
}

}  // namespace phongpipe
