#include "model/files/triangle_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <ostream>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "model/scene/mesh.h"

namespace phongpipe {
namespace {

constexpr std::array<const char*, 6> kVertexColumns = {"x", "y", "z", "nx", "ny", "nz"};
constexpr std::size_t kMaxCsvBytes = std::size_t{64} << 20;
constexpr std::size_t kColumns = 3 * kVertexColumns.size();

std::string column_name(std::size_t column) {
  return fmt::format("{}{}", kVertexColumns[column % kVertexColumns.size()],
                     column / kVertexColumns.size());
}

class CsvReader {
 public:
  CsvReader(const std::filesystem::path& file, const Image& image, unsigned line_before)
      : file_(file), image_(image), line_before_(line_before) {}

  std::vector<ScreenTriangle> run(const std::string& text) {
    LineReader reader(text);
    std::vector<ScreenTriangle> triangles;
    const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    if (lines > kMaxMeshTriangles) {
      throw InputError(
          file_, 0,
          fmt::format("{} lines, may have at most {} triangles", lines, kMaxMeshTriangles));
    }
    bool header_seen = false;
    for (std::string_view line; reader.next(line);) {
      line_ = line_before_ + reader.number();
      if (trimmed(line).empty()) {
        continue;
      }
      const auto columns = static_cast<std::size_t>(1 + std::count(line.begin(), line.end(), ','));
      if (columns != kColumns) {
        fail(fmt::format("{} columns, must be {}: x0,y0,z0,nx0,ny0,nz0,x1,...,nz2", columns,
                         kColumns));
      }
      const std::vector<std::string_view> cells = split(line, ',');
      if (header_seen) {
        triangles.push_back(read_row(cells));
      } else {
        check_header(cells);
        header_seen = true;
      }
    }
    if (triangles.empty()) {
      throw InputError(file_, 0, "no triangles below the header");
    }
    return triangles;
  }

 private:
  void check_header(const std::vector<std::string_view>& cells) const {
    for (std::size_t column = 0; column < kColumns; ++column) {
      if (trimmed(cells[column]) != column_name(column)) {
        fail(fmt::format("column {} of the header is '{}', must be '{}'", column + 1,
                         excerpt(trimmed(cells[column])), column_name(column)));
      }
    }
  }

  ScreenTriangle read_row(const std::vector<std::string_view>& cells) const {
    std::array<double, kColumns> values;
    for (std::size_t column = 0; column < kColumns; ++column) {
      const std::optional<double> value = parse_number(trimmed(cells[column]));
      if (!value) {
        fail(fmt::format("{} is '{}', not a finite number", column_name(column),
                         excerpt(trimmed(cells[column]))));
      }
      values[column] = *value;
    }
    ScreenTriangle triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      triangle.vertices[i] = vertex(values, i * kVertexColumns.size());
    }
    return triangle;
  }

  ScreenVertex vertex(const std::array<double, kColumns>& values, std::size_t column) const {
    ScreenVertex result;
    result.x = coordinate(values[column], image_.width, column);
    result.y = coordinate(values[column + 1], image_.height, column + 1);
    result.z = values[column + 2];
    if (std::abs(result.z) > kMaxCoordinate) {
      fail(fmt::format("{} is {}, must be at most {}", column_name(column + 2), result.z,
                       kMaxCoordinate));
    }
    result.normal = Vec3(values[column + 3], values[column + 4], values[column + 5]);
    const double length = result.normal.stableNorm();
    if (length < 1e-9 || length > kMaxCoordinate) {
      fail(fmt::format("the normal of vertex {} has the length {}, must be a direction",
                       column / kVertexColumns.size(), length));
    }
    if (std::abs(length - 1) > 1e-12) {  // a dump read back keeps its last bits
      result.normal /= length;
    }
    result.eye = Vec3(0, 0, -1);
    result.position = Vec3(in_pixels(result.x), in_pixels(result.y), result.z);
    return result;
  }

  std::int32_t coordinate(double pixels, int size, std::size_t column) const {
    if (pixels < -kGuardBand || pixels > size + kGuardBand) {
      fail(fmt::format("{} is {}, must be from {} to {}", column_name(column), pixels, -kGuardBand,
                       size + kGuardBand));
    }
    return snap(pixels);
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(file_, line_, message);
  }

  const std::filesystem::path& file_;
  const Image& image_;
  unsigned line_before_, line_ = 0;
};

void append_vector(std::string& row, const Vec3& v) {
  fmt::format_to(std::back_inserter(row), ",{},{},{}", v.x(), v.y(), v.z());
}

// Quoted as RFC 4180 asks where a name has commas, quotes or line ends.
std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c == '"' ? "\"\"" : std::string(1, c);
  }
  return quoted + '"';
}

std::string dump_header(std::size_t lights) {
  std::string header;
  for (std::size_t column = 0; column < kColumns; ++column) {
    header += column_name(column) + ',';
  }
  for (int vertex = 0; vertex < 3; ++vertex) {
    header += fmt::format("ex{0},ey{0},ez{0},", vertex);
  }
  for (std::size_t light = 0; light < lights; ++light) {
    for (int vertex = 0; vertex < 3; ++vertex) {
      header += fmt::format("l{0}x{1},l{0}y{1},l{0}z{1},", light, vertex);
    }
  }
  return header + "material\n";
}

}  // namespace

std::vector<ScreenTriangle> read_triangle_csv(const std::filesystem::path& file,
                                              const Image& image) {
  return parse_triangle_csv(read_whole_file(file, kMaxCsvBytes), file, image);
}

std::vector<ScreenTriangle> parse_triangle_csv(const std::string& text,
                                               const std::filesystem::path& file,
                                               const Image& image, unsigned line_before) {
  return CsvReader(file, image, line_before).run(text);
}

std::string triangles_csv(const Scene& scene, const Geometry& geometry) {
  std::string csv = dump_header(scene.lights.size());
  std::string row;
  for (const ScreenTriangle& triangle : geometry.triangles) {
    row.clear();
    for (const ScreenVertex& vertex : triangle.vertices) {
      fmt::format_to(std::back_inserter(row), "{}{},{},{}", row.empty() ? "" : ",",
                     in_pixels(vertex.x), in_pixels(vertex.y), vertex.z);
      append_vector(row, vertex.normal);
    }
    for (const ScreenVertex& vertex : triangle.vertices) {
      append_vector(row, vertex.eye);
    }
    for (const Light& light : scene.lights) {
      for (const ScreenVertex& vertex : triangle.vertices) {
        append_vector(row, light_vector(light, vertex));
      }
    }
    row += ',' + csv_text(geometry.materials[triangle.material].name) + '\n';
    csv += row;
  }
  return csv;
}

}  // namespace phongpipe
