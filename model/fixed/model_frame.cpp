#include "model/fixed/model_frame.h"

#include "model/fixed/certificate.h"

namespace phongpipe {

SpanStream::SpanStream(const FrameSetup& frame, Evaluation evaluation)
    : frame_(frame),
      front_end_(frame),
      order_(front_end_),
      datapath_(frame.configuration, evaluation, frame.cue_color) {}

bool SpanStream::next_triangle() {
  for (; !order_.done(); order_.advance()) {
    const SetupOutcome outcome = front_end_.set_up(order_.triangle(), order_.pass(), work_);
    if (outcome == SetupOutcome::nothing) continue;
    ++triangles_.set_up;
    if (outcome == SetupOutcome::left_out) {
      ++triangles_.left_out;
      continue;
    }
    bool overflow = work_.setup.overflow;
    std::uint64_t pixels = 0;
    for (const RowSpan& row : work_.rows) {
      pixels += static_cast<std::uint64_t>(row.length);
      overflow = overflow || !front_end_.span_walker().fits(work_.setup, row);
    }
    triangles_.overflows += overflow ? 1 : 0;
    count_pixels(frame_, work_.setup, pixels, ledger_);
    next_row_ = 0;
    order_.advance();
    return true;
  }
  return false;
}

bool SpanStream::next() {
  if (current_ + 1 < spans_.size()) {
    first_color_ += static_cast<std::size_t>(span().row.length);
    ++current_;
    return true;
  }
  return next_batch();
}

// Spans of one triangle are shaded together, which short ones gain by; not too many of them, so
// that their colours stay in the cache.
bool SpanStream::next_batch() {
  constexpr std::size_t kLargestBatch = 64;
  spans_.clear();
  current_ = first_color_ = 0;
  if (next_row_ == work_.rows.size() && !next_triangle()) {
    work_.rows.clear();
    next_row_ = 0;
    return false;
  }
  std::size_t pixels = 0;
  for (; next_row_ < work_.rows.size() && spans_.size() < kLargestBatch; ++next_row_) {
    spans_.emplace_back();
    front_end_.span_walker().start(work_.setup, work_.rows[next_row_], spans_.back());
    pixels += static_cast<std::size_t>(spans_.back().row.length);
  }
  if (is_present(work_.setup.plan.specular) && work_.setup.material->table != loaded_table_) {
    loaded_table_ = work_.setup.material->table;
    datapath_.load_table(frame_.tables[loaded_table_]);
  }
  if (colors_.size() < pixels + PixelDatapath::kLanes) {
    colors_.resize(pixels + PixelDatapath::kLanes);
  }
  datapath_.shade(spans_.data(), spans_.size(), colors_.data());
  return true;
}

std::vector<std::uint32_t> ModelFrame::colors() const {
  std::vector<std::uint32_t> colors(framebuffer.size());
  for (std::size_t i = 0; i < colors.size(); ++i) colors[i] = framebuffer.color(i);
  return colors;
}

ModelFrame run_model(const FrameSetup& frame, const ObserveSpan& observe, Evaluation evaluation) {
  ModelFrame result{Framebuffer(frame, Framebuffer::Owners::kept), {}, 0, {}};
  SpanStream stream(frame, evaluation);
  std::vector<std::uint8_t> taken;
  while (stream.next()) {
    const auto length = static_cast<std::size_t>(stream.span().row.length);
    if (taken.size() < length) taken.resize(length);
    result.framebuffer.take_span(frame, stream.span(), stream.colors(), taken.data());
    result.pixels += length;
    if (observe) observe(stream.span(), stream.colors());
  }
  result.triangles = stream.triangles();
  result.ledger = stream.ledger();
  return result;
}

}  // namespace phongpipe
