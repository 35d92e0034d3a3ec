#include "model/files/obj_check.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "model/scene/mesh.h"

namespace phongpipe {
namespace {

using Words = std::vector<std::string_view>;

class ObjChecker {
 public:
  explicit ObjChecker(const std::filesystem::path& file) : file_(file) {}

  ObjFacts run() {
    const std::string text = read_whole_file(file_);
    // A face may refer to what follows it, so that counting comes first.
    for_each_line(text, [this](const Words& line) { count(line); });
    declared_so_far_ = {0, 0, 0};
    for_each_line(text, [this](const Words& line) { check(line); });
    return facts_;
  }

 private:
  static constexpr std::array<const char*, 3> kLists = {"v", "vt", "vn"};  // as in f v/vt/vn

  template <class Visit>
  void for_each_line(std::string_view text, Visit visit) {
    LineReader reader(text);
    std::string joined;  // a backslash at the end continues a line
    for (std::string_view line; reader.next(line);) {
      joined += line;
      if (!joined.empty() && joined.back() == '\\') {
        joined.back() = ' ';
        continue;
      }
      line_ = reader.number();
      const Words parts = words(std::string_view(joined).substr(0, joined.find('#')));
      if (!parts.empty()) {
        visit(parts);
      }
      joined.clear();
    }
  }

  void count(const Words& line) {
    for (std::size_t list = 0; list < kLists.size(); ++list) {
      declared_[list] += line[0] == kLists[list] ? 1 : 0;
    }
  }

  void check(const Words& line) {
    for (std::size_t list = 0; list < kLists.size(); ++list) {
      declared_so_far_[list] += line[0] == kLists[list] ? 1 : 0;
    }
    if (line[0] == "v") {
      check_vector(line, "vertex", kMaxCoordinate);
    } else if (line[0] == "vn") {
      if (check_vector(line, "normal", kMaxCoordinate) == 0) {
        fail("normal is zero");
      }
    } else if (line[0] == "f") {
      check_face(line);
    } else if (line[0] == "mtllib") {
      for (std::size_t i = 1; i < line.size(); ++i) {
        std::error_code ignored;
        if (!std::filesystem::exists(file_.parent_path() / line[i], ignored)) {
          facts_.missing_libraries.push_back(
              fmt::format("{}:{}: material library '{}' not found, default material used",
                          file_.string(), line_, line[i]));
        }
      }
    }
  }

  // The squared length.
  double check_vector(const Words& line, const char* what, double limit) const {
    if (line.size() < 4) {
      fail(fmt::format("{} needs three coordinates", what));
    }
    double squared = 0;
    for (std::size_t i = 1; i < 4; ++i) {
      const std::optional<double> value = parse_number(line[i]);
      if (!value) {
        fail(fmt::format("{} coordinate '{}' is not a finite number", what, line[i]));
      }
      if (std::abs(*value) > limit) {
        fail(fmt::format("{} coordinate {} is beyond {}", what, line[i], limit));
      }
      squared += *value * *value;
    }
    return squared;
  }

  void check_face(const Words& line) {
    if (line.size() < 4) {
      fail(fmt::format("face has {} vertices, needs at least 3", line.size() - 1));
    }
    for (std::size_t corner = 1; corner < line.size(); ++corner) {
      const Words indices = split(line[corner], '/');
      if (indices.size() > 3) {
        fail(fmt::format("face corner '{}' is not v, v/vt, v//vn or v/vt/vn", line[corner]));
      }
      for (std::size_t list = 0; list < indices.size(); ++list) {
        if (!indices[list].empty() || list == 0) {
          check_index(indices[list], list);
        }
      }
      if (indices.size() < 3 || indices[2].empty()) {
        facts_.some_normals_missing = true;
      }
    }
  }

  void check_index(std::string_view word, std::size_t list) const {
    const std::optional<long> index = parse_integer(word);
    if (!index || *index == 0) {
      fail(fmt::format("face index '{}' is not a whole number other than 0", word));
    }
    if (*index > declared_[list] || -*index > declared_so_far_[list]) {
      fail(fmt::format("face refers to {} {}, but the file has {}", kLists[list], *index,
                       *index > 0 ? declared_[list] : declared_so_far_[list]));
    }
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(file_, line_, message);
  }

  const std::filesystem::path& file_;
  unsigned line_ = 0;
  std::array<long, 3> declared_ = {0, 0, 0};         // in the whole file
  std::array<long, 3> declared_so_far_ = {0, 0, 0};  // what negative indices count back from
  ObjFacts facts_;
};

}  // namespace

ObjFacts check_obj(const std::filesystem::path& file) {
  return ObjChecker(file).run();
}

}  // namespace phongpipe
