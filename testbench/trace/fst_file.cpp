#include "testbench/trace/fst_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtkwave/fstapi.h>
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <unordered_map>

#include "model/files/fork.h"
#include "model/files/text_file.h"
#include "testbench/system/process.h"
#include "testbench/trace/wave_format.h"

namespace phongpipe {
namespace fs = std::filesystem;
namespace {

// A block of a file: a byte for its type, then its size without that byte in eight bytes, the
// highest first.
struct Block {
  int type = 0;
  std::uint64_t begin = 0, size = 0;

  std::uint64_t end() const { return begin + 1 + size; }
  bool has_names() const {
    return type == FST_BL_GEOM || type == FST_BL_HIER || type == FST_BL_HIER_LZ4 ||
           type == FST_BL_HIER_LZ4DUO;
  }
};

// The blocks of a file up to the first that is cut.
std::vector<Block> whole_blocks(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::uint64_t file_size = fs::file_size(path);
  std::vector<Block> blocks;
  for (std::uint64_t begin = 0; begin < file_size;) {
    std::array<unsigned char, 9> head{};
    file.seekg(static_cast<std::streamoff>(begin));
    if (!file.read(reinterpret_cast<char*>(head.data()), head.size())) break;
    Block block{head[0], begin};
    for (std::size_t i = 1; i < head.size(); ++i) block.size = block.size << 8 | head[i];
    if (block.size < head.size() - 1 || block.size > file_size - begin - 1) break;
    blocks.push_back(block);
    begin = block.end();
  }
  return blocks;
}

// Puts the blocks with names behind the header.
void move_names_forward(const PartialFile& file) {
  std::vector<Block> blocks = whole_blocks(file.name());
  std::stable_partition(blocks.begin(), blocks.end(), [](const Block& block) {
    return block.type == FST_BL_HDR || block.has_names();
  });
  const PartialFile ordered(file.name());
  std::ifstream in(file.name(), std::ios::binary);
  std::ofstream out(ordered.name(), std::ios::binary);
  std::string bytes;
  for (const Block& block : blocks) {
    bytes.resize(block.end() - block.begin);
    in.seekg(static_cast<std::streamoff>(block.begin));
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  out.close();
  if (!in || !out) file.fail("not all of it could be written; is the disk full?");
  ordered.complete();
}

class FstWriter : public WaveWriter {
 public:
  FstWriter(const fs::path& path, const std::vector<WaveVariable>& variables)
      : file_(path), fst_(fstWriterCreate(file_.name().c_str(), 1)) {
    if (fst_ == nullptr) file_.fail("cannot be written");
    fstWriterSetPackType(fst_, FST_WR_PT_LZ4);
    fstWriterSetTimescale(fst_, -12);
    fstWriterSetVersion(fst_, "phongpipe");
    const auto begin = [this](const std::string& name) {
      fstWriterSetScope(fst_, FST_ST_VCD_MODULE, name.c_str(), nullptr);
    };
    const auto end = [this] { fstWriterSetUpscope(fst_); };
    std::string scope;
    for (const WaveVariable& variable : variables) {
      change_scope(scope, variable.scope, begin, end);
      scope = variable.scope;
      const std::string range = variable.range();
      is_real_.push_back(variable.real);
      const std::string name = range.empty() ? variable.name : variable.name + " " + range;
      handles_.push_back(fstWriterCreateVar(
          fst_, variable.real ? FST_VT_VCD_REAL : FST_VT_VCD_WIRE, FST_VD_IMPLICIT,
          variable.real ? 8 : static_cast<std::uint32_t>(variable.width), name.c_str(), 0));
    }
    change_scope(scope, "", begin, end);
  }
  ~FstWriter() override {
    if (fst_ != nullptr) fstWriterClose(fst_);
  }
  FstWriter(const FstWriter&) = delete;
  FstWriter& operator=(const FstWriter&) = delete;

  void time(std::uint64_t ps) override {
    // Each flush ends a block, which can be read without those behind it. Blocks double in length,
    // so that also short traces have some, and long ones few.
    constexpr int kMostTimesInBlock = 4096;
    if (++times_ == times_in_block_) {
      fstWriterFlushContext(fst_);
      times_ = 0;
      times_in_block_ = std::min(2 * times_in_block_, kMostTimesInBlock);
    }
    fstWriterEmitTimeChange(fst_, ps);
  }
  void change(std::size_t index, const std::string& text) override {
    if (is_real_[index]) {
      const double value = parse_number(text).value_or(0);
      fstWriterEmitValueChange(fst_, handles_[index], &value);
    } else {
      fstWriterEmitValueChange(fst_, handles_[index], text.c_str());
    }
  }
  void close() override {
    fstWriterClose(fst_);
    fst_ = nullptr;
    move_names_forward(file_);
    file_.complete();
  }

 private:
  PartialFile file_;
  void* fst_;
  int times_ = 0, times_in_block_ = 32;  // since the last flush, and until the next
  std::vector<fstHandle> handles_;
  std::vector<bool> is_real_;
};

// What the child sends of an FST file: variables, then changes, then that it has read it to the
// end.
constexpr char kVariable = 'v', kChange = 'c', kEnd = 'e';

// What a child sends that a damaged file has led astray.
struct DamagedMessage : std::exception {};

template <typename Number>
void append_number(std::string& bytes, Number number) {
  const char* const at = reinterpret_cast<const char*>(&number);
  bytes.append(at, sizeof number);
}
template <typename Number>
Number take_number(std::string_view& bytes) {
  Number number{};
  if (bytes.size() < sizeof number) throw DamagedMessage();
  std::memcpy(&number, bytes.data(), sizeof number);
  bytes.remove_prefix(sizeof number);
  return number;
}
void append_text(std::string& bytes, std::string_view text) {
  append_number(bytes, std::uint64_t{text.size()});
  bytes += text;
}
std::string take_text(std::string_view& bytes) {
  const auto size = take_number<std::uint64_t>(bytes);
  if (size > bytes.size()) throw DamagedMessage();
  std::string text(bytes.substr(0, size));
  bytes.remove_prefix(size);
  return text;
}

// Collects changes, for a message each would take long.
class ChangeSender {
 public:
  explicit ChangeSender(const Worker::Send& send) : send_(send) {}

  void add(std::uint64_t ps, std::size_t index, std::string_view value) {
    append_number(batch_, ps);
    append_number(batch_, std::uint64_t{index});
    append_text(batch_, value);
    if (batch_.size() > kBatchBytes) flush();
  }
  void flush() {
    send_(kChange + batch_);
    batch_.clear();
  }

 private:
  static constexpr std::size_t kBatchBytes = 65536;
  const Worker::Send& send_;
  std::string batch_;
};

// The path of a copy in memory of the first `size` bytes, which lives as long as the process.
std::string beginning_of(const fs::path& path, std::uint64_t size) {
  const int copy = memfd_create("fst", 0);
  std::ifstream in(path, std::ios::binary);
  std::string bytes(size, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  std::string name = fmt::format("/proc/self/fd/{}", copy);
  std::ofstream(name, std::ios::binary) << bytes;
  return name;
}

// In a child.
void send_fst(const fs::path& file, const Worker::Send& send) {
  // The library tells of a fault there, and ends the process.
  if (std::freopen("/dev/null", "w", stderr) == nullptr) return;
  const std::unique_ptr<void, void (*)(void*)> reading(fstReaderOpen(file.c_str()), fstReaderClose);
  void* const fst = reading.get();
  if (fst == nullptr) return;
  std::vector<std::string> scopes;
  std::unordered_map<fstHandle, std::vector<std::size_t>> places;
  std::size_t count = 0;
  while (const fstHier* const item = fstReaderIterateHier(fst)) {
    if (item->htyp == FST_HT_SCOPE) {
      if (scopes.size() == kMaxScopes) return;
      scopes.emplace_back(item->u.scope.name, item->u.scope.name_length);
    } else if (item->htyp == FST_HT_UPSCOPE) {
      if (scopes.empty()) return;
      scopes.pop_back();
    } else if (item->htyp == FST_HT_VAR) {
      places[item->u.var.handle].push_back(count++);
      std::string message(1, kVariable);
      append_number(message, std::uint64_t{item->u.var.length});
      message += item->u.var.typ == FST_VT_VCD_REAL ? '\1' : '\0';
      append_text(message, fmt::format("{}", fmt::join(scopes, ".")));
      append_text(message, std::string_view(item->u.var.name, item->u.var.name_length));
      send(message);
    }
  }
  struct Context {
    const std::unordered_map<fstHandle, std::vector<std::size_t>>& places;
    ChangeSender changes;
    double ps;
  };
  // A power of ten of seconds.
  const auto exponent = static_cast<double>(fstReaderGetTimescale(fst));
  Context context{places, ChangeSender(send), std::pow(10, exponent + 12)};
  context.changes.flush();  // also of a file without any
  fstReaderSetFacProcessMaskAll(fst);
  fstReaderIterBlocks(
      fst,
      [](void* user, std::uint64_t time, fstHandle handle, const unsigned char* value) {
        Context& c = *static_cast<Context*>(user);
        const auto found = c.places.find(handle);
        if (found == c.places.end()) return;
        for (const std::size_t index : found->second) {
          c.changes.add(static_cast<std::uint64_t>(static_cast<double>(time) * c.ps), index,
                        reinterpret_cast<const char*>(value));
        }
      },
      &context, nullptr);
  context.changes.flush();
  send(std::string(1, kEnd));
}

}  // namespace

std::unique_ptr<WaveWriter> open_fst(const fs::path& file,
                                     const std::vector<WaveVariable>& variables) {
  return std::make_unique<FstWriter>(file, variables);
}

// The library trusts what it reads, so that it reads in a child, with
// limits.
bool read_fst(const fs::path& file, WaveReader& reader, const WaveReader::Declare& declare,
              const WaveReader::Visit& visit) {
  constexpr std::size_t kMemoryBytes = std::size_t{384} << 20;
  const std::vector<Block> blocks = whole_blocks(file);
  if (blocks.empty()) return false;
  const std::uint64_t whole = blocks.back().end();
  reader.complete = whole == fs::file_size(file);
  const auto seconds = static_cast<unsigned>(1 + (fs::file_size(file) >> 18U));
  Worker child([&](const Worker::Send& send) {
    limit_memory(kMemoryBytes);
    limit_processor_time(seconds);
    send_fst(reader.complete ? file.string() : beginning_of(file, whole), send);
  });
  bool declared = false, complete = false;
  const auto take = [&](std::string_view message) {
    const char kind = take_number<char>(message);
    if (kind == kVariable) {
      const auto width = take_number<std::uint64_t>(message);
      const bool real = take_number<char>(message) != 0;
      const std::string scope = take_text(message);
      reader.variables.push_back(
          variable_of(scope, take_text(message), static_cast<int>(width), real));
      return;
    }
    if (!declared) declare(reader.variables);
    declared = true;
    complete = complete || kind == kEnd;
    while (!message.empty()) {
      const auto ps = take_number<std::uint64_t>(message);
      const auto index = take_number<std::uint64_t>(message);
      const std::string value = take_text(message);
      if (index >= reader.variables.size()) throw DamagedMessage();
      visit(ps, index, value);
    }
  };
  try {
    while (!child.ended()) {
      for (const std::string& message : child.receive()) take(message);
    }
  } catch (const DamagedMessage&) {
    return false;
  }
  return complete && child.failure().empty();
}

}  // namespace phongpipe
