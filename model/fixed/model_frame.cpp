#include "model/fixed/model_frame.h"

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
    if (outcome == SetupOutcome::dropped) {
      ++triangles_.left_out;
      continue;
    }
    bool overflow = work_.setup.overflow;
    for (const RowSpan& row : work_.rows) {
      overflow = overflow || !front_end_.span_walker().fits(work_.setup, row);
    }
    triangles_.overflows += overflow ? 1 : 0;
    next_row_ = 0;
    order_.advance();
    return true;
  }
  return false;
}

bool SpanStream::next() {
  if (next_row_ == work_.rows.size() && !next_triangle()) {
    work_.rows.clear();
    next_row_ = 0;
    return false;
  }
  span_ = front_end_.span_walker().start(work_.setup, work_.rows[next_row_++]);
  if (span_.highlight && span_.table != loaded_table_) {
    loaded_table_ = span_.table;
    datapath_.load_table(frame_.tables[loaded_table_]);
  }
  const std::size_t padded = PixelDatapath::padded(span_.row.length);
  if (colors_.size() < padded) colors_.resize(padded);
  datapath_.shade(span_, colors_.data());
  return true;
}

std::vector<std::uint32_t> ModelFrame::colors() const {
  std::vector<std::uint32_t> colors(framebuffer.size());
  for (std::size_t i = 0; i < colors.size(); ++i) colors[i] = framebuffer.color(i);
  return colors;
}

ModelFrame run_model(const FrameSetup& frame, const ObserveSpan& observe, Evaluation evaluation) {
  ModelFrame result{Framebuffer(frame, Framebuffer::Owners::kept), {}, 0};
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
  return result;
}

}  // namespace phongpipe
