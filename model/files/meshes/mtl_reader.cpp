#include "model/files/meshes/mtl_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>

#include "model/files/meshes/statements.h"
#include "model/scene/input_error.h"

namespace phongpipe {
namespace {

// Properties without effect on Phong shading, or that only ray tracing or physically based shading
// has.
constexpr std::array<std::string_view, 10> kPropertiesWithoutEffect = {
    "Ni", "sharpness", "Pr", "Pm", "Ps", "Pc", "Pcr", "aniso", "anisor", "interpolateMode"};

// Properties that would change the picture unless they have this value.
struct LeftOut {
  std::string_view keyword;
  double neutral;
};
constexpr std::array<LeftOut, 4> kLeftOut = {{{"Ke", 0}, {"d", 1}, {"Tr", 0}, {"Tf", 1}}};
constexpr std::array<std::string_view, 5> kTextures = {"bump", "disp", "decal", "refl", "norm"};

class MtlReader {
 public:
  MtlReader(const std::filesystem::path& file, std::vector<std::string>& notes)
      : file_(file), notes_(notes) {}

  std::vector<Material> run(std::string_view text) {
    for_each_statement(text, [this](const Statement& statement) {
      line_ = statement.line;
      read(statement);
    });
    finish_material();
    if (!left_out_.empty()) {
      notes_.push_back(fmt::format("{}: left out: {}", file_.string(), fmt::join(left_out_, ", ")));
    }
    return std::move(materials_);
  }

 private:
  void read(const Statement& statement) {
    if (statement.keyword == "newmtl") return begin(statement.rest);
    if (materials_.empty()) {
      fail(fmt::format("'{}' stands before the first newmtl", excerpt(statement.keyword)));
    }
    Material& material = materials_.back();
    if (statement.keyword == "Ka") {
      material.ambient = color(statement);
    } else if (statement.keyword == "Kd") {
      material.diffuse = color(statement);
    } else if (statement.keyword == "Ks") {
      material.specular = color(statement);
    } else if (statement.keyword == "Ns") {
      material.shininess = shininess(statement);
    } else if (statement.keyword == "illum") {
      choose_illumination(statement);
    } else {
      leave_out(statement);
    }
  }

  void begin(std::string_view name) {
    finish_material();
    if (name.empty()) fail("newmtl needs a name");
    if (!names_.emplace(name).second) {
      fail(fmt::format("material '{}' is defined twice", excerpt(name)));
    }
    materials_.emplace_back();
    materials_.back().name = name;
  }

  double number(std::string_view keyword, std::string_view word) const {
    const std::optional<double> value = parse_number(word);
    if (!value) fail(fmt::format("{}: '{}' is not a finite number", keyword, excerpt(word)));
    return *value;
  }

  // r g b, or one number for all three.
  Color color(const Statement& statement) const {
    const auto& words = statement.values;
    if (!words.empty() && (words[0] == "spectral" || words[0] == "xyz")) {
      fail(fmt::format("{} {} is not supported, give red, green and blue", statement.keyword,
                       words[0]));
    }
    if (words.size() != 3 && words.size() != 1) {
      fail(fmt::format("{} needs one number or three, has {}", statement.keyword, words.size()));
    }
    Color result;
    for (Eigen::Index i = 0; i < 3; ++i) {
      result[i] =
          number(statement.keyword, words[words.size() == 1 ? 0 : static_cast<std::size_t>(i)]);
    }
    if (!((result >= 0).all() && (result <= 1).all())) {
      fail(fmt::format("{} is [{}, {}, {}], must be from 0 to 1", statement.keyword, result[0],
                       result[1], result[2]));
    }
    return result;
  }

  double shininess(const Statement& statement) const {
    if (statement.values.size() != 1) {
      fail(fmt::format("Ns needs one number, has {}", statement.values.size()));
    }
    const double value = number("Ns", statement.values[0]);
    if (value < 0) fail(fmt::format("Ns is {}, must be at least 0", value));
    return value;
  }

  // 1 is diffuse light without highlights, 2 with them; 0 is a colour without light, and from 3 on
  // mirrors and glass are wanted, too.
  void choose_illumination(const Statement& statement) {
    constexpr long kLast = 10;
    const auto model =
        statement.values.size() == 1 ? parse_integer(statement.values[0]) : std::optional<long>();
    if (!model || *model < 0 || *model > kLast) {
      fail(fmt::format("illum needs a whole number from 0 to {}", kLast));
    }
    matt_ = *model == 1;
    if (*model == 0 || *model > 2) left_out_.emplace(fmt::format("illum {}", *model));
  }

  void finish_material() {
    if (matt_) materials_.back().specular = Color::Zero();
    matt_ = false;
  }

  void leave_out(const Statement& statement) {
    const std::string_view keyword = statement.keyword;
    const auto is = [&](std::string_view known) { return known == keyword; };
    if (std::any_of(kPropertiesWithoutEffect.begin(), kPropertiesWithoutEffect.end(), is)) return;
    for (const LeftOut& property : kLeftOut) {
      if (!is(property.keyword)) continue;
      const bool neutral = std::all_of(
          statement.values.begin(), statement.values.end(),
          [&](std::string_view word) { return parse_number(word) == property.neutral; });
      if (!neutral) left_out_.emplace(keyword);
      return;
    }
    if (keyword.substr(0, 4) == "map_" || std::any_of(kTextures.begin(), kTextures.end(), is)) {
      left_out_.emplace("textures");
      return;
    }
    fail(fmt::format("'{}' is not a property of a material", excerpt(keyword)));
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(file_, line_, message);
  }

  const std::filesystem::path& file_;
  std::vector<std::string>& notes_;
  unsigned line_ = 0;
  std::vector<Material> materials_;
  std::set<std::string, std::less<>> names_;
  std::set<std::string> left_out_;
  bool matt_ = false;  // the material is without highlights
};

}  // namespace

std::vector<Material> read_mtl(const std::filesystem::path& file, std::string_view text,
                               std::vector<std::string>& notes) {
  return MtlReader(file, notes).run(text);
}

}  // namespace phongpipe
