// Files that crashed, hung or filled the memory, and files that gave a wrong picture: each ends
// with one line and status 2, or with the right picture, in little time and memory.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "testbench/tests/commands/program.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

// Of the children that have ended.
double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

template <typename Number>
std::string bytes(std::initializer_list<Number> numbers) {
  std::string result;
  for (const Number number : numbers) {
    std::array<char, sizeof number> raw{};
    std::memcpy(raw.data(), &number, sizeof number);
    result.append(raw.data(), raw.size());
  }
  return result;
}

std::string repeated(const std::string& text, int count) {
  std::string result;
  for (int i = 0; i < count; ++i) result += text;
  return result;
}

class HostileInput : public Program {
 protected:
  std::string put(const std::string& name, const std::string& contents) const {
    std::ofstream(folder_ / name, std::ios::binary) << contents;
    return file(name);
  }

  // A scene that shows a mesh.
  std::string scene_of(const std::string& mesh) const {
    return put("scene.toml",
               "[image]\nwidth = 48\nheight = 48\nbackground = [0.2, 0, 0]\n[camera]\neye = [0.5, "
               "0.5, 5]\ntarget = [0.5, 0.5, 0]\nvertical_fov_degrees = 40\n[[light]]\n"
               "type = \"directional\"\ndirection = [0, 0, -1]\n[[object]]\nmesh = \"" +
                   mesh + "\"\n");
  }

  // The sanitizers need more of both.
  static void expect_modest(double seconds) {
#ifndef __SANITIZE_ADDRESS__
    EXPECT_LT(seconds, 2);
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    EXPECT_LT(usage.ru_maxrss, 512 * 1024) << "KiB";
#else
    EXPECT_LT(seconds, 60);
#endif
  }

  ProcessOutput render(const std::string& scene, const std::string& picture) const {
    const double before = processor_seconds();
    const ProcessOutput output = run({"render", scene, "-o", file(picture)});
    expect_modest(processor_seconds() - before);
    return output;
  }

  // Of a file, or of a mesh that is shown.
  void expect_scene_refused(const std::string& scene, const std::string& message) const {
    SCOPED_TRACE(message);
    const ProcessOutput output = render(scene, "none.png");
    EXPECT_EQ(output.status, 2) << output.text;
    EXPECT_NE(output.text.find(message), std::string::npos) << output.text;
    EXPECT_EQ(lines_of(output.text), 1) << output.text;
    EXPECT_FALSE(fs::exists(folder_ / "none.png"));
  }
  void expect_mesh_refused(const std::string& name, const std::string& contents,
                           const std::string& message) const {
    put(name, contents);
    expect_scene_refused(scene_of(name), message);
  }

  std::string picture_of(const std::string& name, const std::string& contents,
                         const std::string& note = {}) const {
    put(name, contents);
    const ProcessOutput output = render(scene_of(name), "a.png");
    EXPECT_EQ(output.status, 0) << output.text;
    EXPECT_NE(output.text.find(note), std::string::npos) << output.text;
    return read_whole_file(file("a.png"));
  }
  // Both show the same.
  void expect_same(const std::string& name, const std::string& contents,
                   const std::string& plain_obj, const std::string& note = {}) const {
    SCOPED_TRACE(name + ": " + contents.substr(0, 100));
    EXPECT_EQ(picture_of(name, contents, note), picture_of("plain.obj", plain_obj));
  }
};

const std::string kPoints = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n";
const std::string kTriangle = kPoints + "f 1 2 3\n";

std::string ply(const std::string& body, const std::string& format = "ascii",
                const std::string& faces = "element face 1") {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n" + body;
}
const std::string kPlyPoints = "0 0 0\n1 0 0\n0 1 0\n";

std::string gltf(const std::string& nodes = R"({"mesh":0})", const std::string& primitive = {},
                 const std::string& more = {},
                 const std::string& base64 =
                     "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
                     "AAABAAIA") {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + nodes +
         R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1)" + primitive +
         R"(}]}],"buffers":[{"byteLength":42,"uri":"data:;base64,)" + base64 +
         R"("}],"bufferViews":[{"buffer":0,"byteLength":36},)"
         R"({"buffer":0,"byteOffset":36,"byteLength":6}],"accessors":[{"bufferView":0,)"
         R"("componentType":5126,"count":3,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}])" +
         more + "}";
}

std::string stl(int facets) {
  return "solid s\n" +
         repeated(
             "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
             "endloop\nendfacet\n",
             facets) +
         "endsolid s\n";
}

TEST_F(HostileInput, CrashesNoMore) {
  put("a.mtl", "map_Kd x.png\nnewmtl a\n");
  expect_mesh_refused("a.obj", "mtllib a.mtl\n" + kTriangle, "a.mtl:1: 'map_Kd' stands before");
  expect_mesh_refused("a.ply", ply(kPlyPoints + "0\n"), "the mesh has no faces");
  expect_same("a.ply", ply("\n" + kPlyPoints + "3 0 1 2\n"), kTriangle);
  expect_mesh_refused(
      "a.ply",
      ply(kPlyPoints + "3 0 1 2\n", "ascii", "element vertex 5\nproperty float x\nelement face 1"),
      "a.ply:7: element 'vertex' is declared twice");
  expect_mesh_refused("a.ply", ply(kPlyPoints + "0\n", "ascii", "element tristrips 1"),
                      "the mesh has no faces");
  // The first byte of a body may be a line feed.
  const std::string tiny = bytes<std::uint32_t>({0x0000000A});
  expect_same(
      "a.ply",
      ply(tiny + bytes<float>({0, 0, 1, 0, 0, 0, 1, 0}) + "\3" + bytes<std::int32_t>({0, 1, 2}),
          "binary_little_endian"),
      kTriangle);
  expect_mesh_refused("a.gltf", gltf(R"({"mesh":0})", R"(,"mode":2)"), "the mesh has no faces");
  std::string nested;
  for (int i = 1; i <= 20000; ++i) nested += fmt::format("{{\"children\":[{}]}},", i);
  expect_same("a.gltf", gltf(nested + R"({"mesh":0})"), kTriangle);
  expect_mesh_refused(
      "a.gltf", gltf({}, {}, ",\"extras\":" + std::string(100000, '[') + std::string(100000, ']')),
      "nested more than 64 deep");
  expect_same("a.gltf", gltf(R"({"mesh":0,"weights":[1]})"), kTriangle);
  for (const char* other : {"a.off", "a.ndo", "a.smd", "a.fbx", "a"}) {
    expect_mesh_refused(other, "OFF\n1000000000 1 0\n", "files that end with .obj, .ply, .stl");
  }
  const std::string deep = "a" + repeated(".a", 100000);
  expect_scene_refused(put("s.toml", deep + " = 1\n"), "s.toml:1: a key may have at most 64 parts");
  expect_scene_refused(put("s.toml", "\n[" + deep + "]\n"), "s.toml:2: a key may have at most 64");
  expect_scene_refused(put("s.toml", "a = " + std::string(100000, '[')), "depth of 256");
  expect_scene_refused(put("s.toml", "a = " + repeated("{a = ", 100000)), "depth of 256");
}

TEST_F(HostileInput, NothingWaitsForAPipeOrReadsADevice) {
  mkfifo(file("p.toml").c_str(), 0600);
  mkfifo(file("p.obj").c_str(), 0600);
  mkfifo(file("p.mtl").c_str(), 0600);
  mkfifo(file("p.csv").c_str(), 0600);
  fs::create_symlink("/dev/zero", folder_ / "zero.toml");
  fs::create_symlink("/dev/zero", folder_ / "zero.obj");
  fs::create_symlink("/dev/zero", folder_ / "zero.bin");
  fs::create_symlink("loop.obj", folder_ / "loop.obj");
  fs::create_symlink("loop.mtl", folder_ / "loop.mtl");
  fs::create_symlink("loop.toml", folder_ / "loop.toml");
  fs::create_symlink("/etc/passwd", folder_ / "passwd.mtl");
  fs::create_directory(folder_ / "folder.obj");
  fs::create_directory(folder_ / "folder.mtl");
  expect_scene_refused(file("p.toml"), "p.toml: is a pipe, not a file");
  expect_scene_refused(file("zero.toml"), "zero.toml: is a device, not a file");
  expect_scene_refused(file("loop.toml"), "loop.toml: no such file");
  expect_scene_refused(scene_of("p.obj"), "p.obj: is a pipe, not a file");
  expect_scene_refused(scene_of("zero.obj"), "zero.obj: is a device, not a file");
  expect_scene_refused(scene_of("loop.obj"), "does not exist");
  expect_scene_refused(scene_of("folder.obj"), "is a directory");
  const auto library = [&](const std::string& name, const std::string& message) {
    expect_mesh_refused("m.obj", "mtllib " + name + "\n" + kTriangle, message);
  };
  library("p.mtl", "p.mtl: is a pipe, not a file");
  library("loop.mtl", "loop.mtl: cannot be read: Too many levels");
  library("folder.mtl", "folder.mtl: is a directory, not a file");
  library("/dev/zero", "may only name files that end with .mtl");
  library("/etc/passwd", "may only name files that end with .mtl");
  library("passwd.mtl", "may only name files that end with .mtl");
  const std::string uri = R"("uri":"data:;base64,)";
  std::string external = gltf();
  external.replace(external.find(uri), external.find("\"}],\"bufferViews") - external.find(uri),
                   R"("uri":"zero.bin)");
  expect_mesh_refused("m.gltf", external, "may only name files that end with .bin");
  std::string triangles = scene_of("x");
  expect_scene_refused(put("t.toml",
                           "[image]\nwidth = 8\nheight = 8\n[[light]]\ntype = "
                           "\"directional\"\ndirection = [0, 0, 1]\n[[object]]\n"
                           "triangles = \"p.csv\"\n"),
                       "p.csv: is a pipe, not a file");
  for (const char* option : {"--hardware"}) {
    const ProcessOutput output = run({"verify", "sphere", option, file("p.toml")});
    EXPECT_EQ(output.status, 2) << output.text;
    EXPECT_NE(output.text.find("is a pipe, not a file"), std::string::npos) << output.text;
  }
  expect_refused({"replay", file("p.toml")}, "is a pipe, not a file");
  expect_refused({"report", file("p.toml"), "-o", file("r.html")}, "not a file");
}

TEST_F(HostileInput, SizesAreLimited) {
  const auto sparse = [&](const std::string& name, off_t size) {
    put(name, "x");
    EXPECT_EQ(truncate(file(name).c_str(), size), 0);
    return file(name);
  };
  expect_scene_refused(sparse("big.toml", off_t{1} << 40), "may have at most 33554432");
  sparse("big.obj", off_t{1} << 40);
  expect_scene_refused(scene_of("big.obj"), "may have at most 134217728");
  expect_scene_refused(put("s.toml", "a = [" + repeated("1,", 5'000'000) + "]"),
                       "more than 320 MiB of keys and values");
  std::string corners = "f";
  std::string points;
  for (int i = 1; i <= 100000; ++i) {
    points += fmt::format("v {} {} 0\n", i, i % 7);
    corners += fmt::format(" {}", i);
  }
  expect_mesh_refused("a.obj", points + corners,
                      "the face has 100000 corners, may have at most 1024");
  std::string dag;
  for (int i = 1; i <= 26; ++i) dag += fmt::format("{{\"children\":[{},{}]}},", i, i);
  expect_mesh_refused("a.gltf", gltf(dag + R"({"mesh":0})"), "has more than one parent");
  std::string many = gltf();
  many.replace(many.find("\"count\":3"), 9, "\"count\":1000000000");
  expect_mesh_refused("a.gltf", many, "'count' is 1000000000, must be a whole number up to");
  const std::string glb =
      "glTF" + bytes<std::uint32_t>({2, 0xFFFFFFFF, 8, 0x4E4F534A}) + "{      }";
  expect_mesh_refused("a.glb", glb, "its header says 4294967295 bytes, but the file has 28");
  expect_mesh_refused("a.stl", std::string(80, '\0') + "\xFF\xFF\xFF\xFF" + std::string(50, '\0'),
                      "its header counts 4294967295 facets");
  expect_mesh_refused("a.ply", ply("", "binary_little_endian", "element face 4000000000000"),
                      "the file ends before vertex 0 is complete");
  // A shiny name does not make a shiny message.
  expect_scene_refused(
      put("s.toml", "[image]\nwidth = 8\nheight = 8\n" + std::string(1'000'000, 'k') + " = 1\n"),
      "kkkk");
}

TEST_F(HostileInput, PicturesAreRight) {
  expect_same("a.obj", "v .0 .0 0.\nv 1 0 0\n\tv +0 1e0 0\n  f 1 2 3\n", kTriangle);
  expect_same("a.obj", "\xEF\xBB\xBFv 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 001 +2 -1\r\n", kTriangle);
  expect_same("a.obj", kPoints + "f 1 \\\n2 \\\n3\\", kTriangle);
  expect_same("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv .5 .25 0\nv 0 1 0\nf 1 2 3 4 5\n",
              "v 0 0 0\nv 1 0 0\nv 1 1 0\nv .5 .25 0\nv 0 1 0\nf 1 2 4\nf 2 3 4\nf 1 4 5\n");
  const auto colored = [&](const std::string& mtl) {
    put("a.mtl", mtl);
    return picture_of("c.obj", "mtllib a.mtl\nusemtl a\n" + kTriangle);
  };
  EXPECT_EQ(colored("newmtl a # comment\nKd 0.8\n"), colored("newmtl a\nKd 0.8 0.8 0.8\n"));
  EXPECT_NE(colored("newmtl a\nKd 0.8\n"), colored("newmtl a\nKd 0.8 0 0\n"));
  expect_mesh_refused("a.gltf", gltf(R"({"mesh":0})", {}, {}, "!!!!"), "its data is not base64");
  expect_mesh_refused("a.gltf", gltf(R"({"mesh":0})", {}, {}, "AAAAAAA"),
                      "it has 5 bytes, but byteLength says 42");
  const std::string whole = stl(2);
  expect_same("a.stl", whole, kTriangle + "f 1 2 3\n");
  for (std::size_t size = 10; size < whole.size() - 12; size += 7) {
    expect_mesh_refused("a.stl", whole.substr(0, size), "a.stl");
  }
  // Words that are not understood are no reason to draw less.
  for (const char* line : {"F 1 2 3", "ff 1 2 3", "v 1 2", "v 1 2 x", "v 1 2 3 4 5", "f 1 2 3x",
                           "f 1 2 3/4/5/6", "f 1 2 1e0", "vn 0 0", "mtllib", "call a.obj"}) {
    expect_mesh_refused("a.obj", kTriangle + line + "\n", "a.obj:6: ");
  }
  for (const char* line :
       {"Kd 1 0", "Kd 1 0 0 0", "Kd 2 0 0", "Kd x", "kd 1 0 0", "Ks spectral a.rfl", "Ns", "Ns nan",
        "newmtl", "newmtl a", "Ka xyz 1 1 1"}) {
    put("a.mtl", std::string("newmtl a\n") + line + "\n");
    expect_mesh_refused("c.obj", "mtllib a.mtl\nusemtl a\n" + kTriangle, "a.mtl:2: ");
  }
  for (const char* end : {"3 0 1 2\n3 0 1 2\n", "3 0 1 2 7\n", "3 0 1\n", "3 0 1 1.5\n", "-1\n"}) {
    expect_mesh_refused("a.ply", ply(kPlyPoints + end), "a.ply");
  }
}

TEST_F(HostileInput, LegalFilesAreDrawnAndChoicesAreNoted) {
  put("my colors.mtl", "newmtl a\nKd 0.1 0.2 0.3\n");
  EXPECT_EQ(picture_of("c.obj", "mtllib my colors.mtl\nusemtl a\n" + kTriangle),
            picture_of("d.obj", "mtllib my colors.mtl\ng x y\ns off\no z\nusemtl a\n" + kTriangle));
  put("a.mtl", "");
  put("b.mtl", "newmtl b\nd 0.5\nmap_Kd x.png\nillum 2\nTr 0\nKe 0 0 0\n");
  picture_of("c.obj", "mtllib a.mtl b.mtl\nusemtl b\n" + kTriangle, "b.mtl: left out: d, textures");
  picture_of("c.obj", "usemtl b\n" + kTriangle, "material 'b' is defined in no library");
  picture_of("c.obj", kTriangle + "v 0 0 0 1 0 0\n", "colors of vertices left out");
  picture_of("c.obj", kTriangle + "v 0 0 0 2\n", "weights of vertices left out");
  picture_of("c.obj", kTriangle + "p 1\nl 1 2\n", "2 points and lines left out");
  // The lines of a strip turn about, and -1 begins the next one.
  expect_same("s.ply", ply(kPlyPoints + "7 0 1 2 -1 0 1 2\n", "ascii", "element tristrips 1"),
              kTriangle + "f 1 2 3\n");
  expect_same("f.gltf", gltf(R"({"mesh":0})", R"(,"mode":6)"), kTriangle);
  expect_same("f.gltf", gltf(R"({"mesh":0})", R"(,"mode":5)"), kTriangle);
  picture_of("f.gltf", gltf(R"({"mesh":0,"skin":0})"), "left out: skins");
  expect_mesh_refused(
      "f.gltf",
      gltf(R"({"mesh":0})", {}, R"(,"extensionsRequired":["KHR_draco_mesh_compression"])"),
      "requires the extension KHR_draco_mesh_compression");
  expect_mesh_refused("f.gltf", R"({"asset":{"version":"1.0"}})", "version '1.0', must be 2.0");
}

TEST_F(HostileInput, LinesEndAndGoOnAsTheyShould) {
  const std::string two = kPoints + "f 1 2 3\nf 2 4 3\n";
  expect_same("a.obj", kPoints + "# C:\\tex\\\nf 1 2 3\nf 2 4 3\n", two);
  expect_same("a.obj", kPoints + "g C:\\tex\\\nf 1 2 3\nf 2 4 3\n", two);
  expect_same("a.obj", kPoints + "f 1 2 3\n# x\rf 2 4 3\n", two);
  std::string returns = two;
  for (char& c : returns) c = c == '\n' ? '\r' : c;
  expect_same("a.obj", returns, two);
  put("a.mtl", "newmtl a\nmap_Kd C:\\tex\\\nKd 0 1 0\n");
  put("b.mtl", "newmtl a\nKd 0 1 0\n");
  EXPECT_EQ(picture_of("a.obj", "mtllib a.mtl\nusemtl a\n" + two),
            picture_of("b.obj", "mtllib b.mtl\nusemtl a\n" + two));
  expect_same("a.stl", "\xEF\xBB\xBF\n " + stl(1), kTriangle);
}

TEST_F(HostileInput, MaterialsAreWhatTheirFilesSay) {
  const auto shown = [&](const std::string& mtl, const std::string& note = {}) {
    put("a.mtl", "newmtl Material #25\nKs 1 1 1\nNs 3\n" + mtl + "newmtl Material #26\n");
    return picture_of("c.obj", "mtllib a.mtl\nusemtl Material #25\n" + kTriangle, note);
  };
  EXPECT_EQ(shown("illum 1\n"), shown("Ks 0 0 0\n"));
  EXPECT_NE(shown("illum 2\n"), shown("Ks 0 0 0\n"));
  shown("illum 0\n", "left out: illum 0");
  shown("illum 7\nTf 0 0 0\n", "left out: Tf, illum 7");
  picture_of("c.obj", "mtllib my none.mtl\n" + kTriangle, "'my none.mtl' not found");
  picture_of("c.obj", repeated("mtllib a.mtl\n", 65) + "usemtl\n" + kTriangle,
             "usemtl without a name");
  picture_of("s.stl",
             "COLOR=x" + std::string(73, ' ') + bytes<std::uint32_t>({1}) +
                 bytes<float>({0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}) + std::string("\0\0", 2),
             "left out: colors of facets");
  picture_of("p.ply",
             ply(kPlyPoints + "1 2\n3 0 1 2\n", "ascii",
                 "element edge 1\nproperty int vertex1\nproperty int vertex2\nelement face 1"),
             "left out: edge");
}

TEST_F(HostileInput, GltfIsWhatItSays) {
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = gltf();
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  const std::pair<std::string, const char*> refused[] = {
      {changed("5123", "5126"), "componentType is 5126, must be one of 5121, 5123, 5125"},
      {changed("\"type\":\"SCALAR\"", "\"type\":\"SCALAR\",\"normalized\":true"),
       "indices cannot be normalized"},
      {changed("{\"asset\"", "{\"scene\":0,\"asset\""), "two keys 'scene'"},
      {gltf(R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,2]})"),
       "last row must be 0 0 0 1"},
      {gltf(R"({"mesh":0})", {}, R"(,"materials":[{"alphaMode":"NONE"}])"), "alphaMode is 'NONE'"},
      {gltf(R"({"mesh":0})", {},
            R"(,"extensionsRequired":["KHR_materials_pbrSpecularGlossiness"])"),
       "requires the extension KHR_materials_pbrSpecularGlossiness"},
      {"{\n\"asset\" 1}", "a.gltf:2: no JSON"}};
  for (const auto& [text, message] : refused) expect_mesh_refused("a.gltf", text, message);
  picture_of("a.gltf", gltf(R"({"mesh":0,"sale":[2,2,2]})"), "left out: nodes.sale");
  picture_of(
      "a.gltf",
      gltf(R"({"mesh":0})", {}, R"(,"materials":[{"alphaMode":"BLEND","emissiveFactor":[0,1,0]}])"),
      "left out: emission, transparency");
  expect_same("a.gltf", gltf(R"({"children":[1,2]},{"mesh":0,"scale":[0,0,0]},{"mesh":0})"),
              kTriangle);
#ifdef __SANITIZE_ADDRESS__
  constexpr int kNodes = 2000;
#else
  constexpr int kNodes = 20000;
#endif
  std::string nodes, children;
  for (int i = 1; i <= kNodes; ++i) {
    nodes += R"(,{"mesh":0})";
    children += (i > 1 ? "," : "") + std::to_string(i);
  }
  expect_same("a.gltf", gltf("{\"children\":[" + children + "]}" + nodes), kTriangle);
}

TEST_F(HostileInput, PolygonsThatTouchThemselvesOrAreNotFlatAreCut) {
  const auto same = [&](const std::string& points, const std::string& polygon,
                        const std::string& triangles) {
    expect_same("a.obj", points + polygon, points + triangles);
  };
  same("v 0 .4 0\nv .4 0 0\nv .8 .2 0\nv .6 .6 0\nv .4 .8 0\n", "f 1 2 3 4 5 3\n",
       "f 1 2 3\nf 3 4 5\n");
  // A square with a square hole, and a cut there and back.
  same("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .3 .3 0\nv .3 .6 0\nv .6 .6 0\nv .6 .3 0\n",
       "f 1 2 3 4 1 5 6 7 8 5\n",
       "f 1 2 8\nf 1 8 5\nf 2 3 7\nf 2 7 8\nf 3 4 6\nf 3 6 7\nf 4 1 5\nf 4 5 6\n");
  picture_of("a.obj", "v 0 0 0\nv 1 0 -2\nv 1 1 1\nv 0 1 -1\nf 1 2 3 4\n");
  // Found by fuzzing: where to cut a polygon that touches itself often was tried in every order.
  expect_mesh_refused("a.obj",
                      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 5 0 0\nv 2 1 0\nv .4 0 0\nv 0 0 0\n"
                      "f 1 4 6 2 2 3 1 4 7 1 4 2 2 3 4 1 1 4 7 6 2 2 3 1 4\n",
                      "crosses itself");
  expect_mesh_refused("a.obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 .9 0\nf 1 2 3 4\n",
                      "a.obj:5: the outline of the face with 4 corners crosses itself");
  expect_mesh_refused(  // a star
      "a.obj", "v 0 1 0\nv .6 -.8 0\nv -.95 .3 0\nv .95 .3 0\nv -.6 -.8 0\nf 5 4 3 2 1\n",
      "crosses itself");
}

// The limit of processor time holds whatever the user's own is.
TEST_F(HostileInput, LimitsAreWithinThoseOfTheUser) {
  put("a.obj", kTriangle);
  const ProcessOutput output =
      run_process({"sh", "-c",
                   fmt::format("ulimit -t 20; {} render {} -o {}", PHONGPIPE_PROGRAM,
                               scene_of("a.obj"), file("a.png"))});
  EXPECT_EQ(output.status, 0) << output.text;
}

TEST_F(HostileInput, SettingsAndSweepsAreLimitedToo) {
  const std::string deep = "a" + repeated(".a", 60000);
  const std::vector<std::string> values = {"{" + deep + "=1}", "64\n[image]\nheight=5",
                                           "64\n[" + deep};
  for (const std::string& value : values) {
    const ProcessOutput output =
        run({"render", "sphere", "--set", "scene.image.width=" + value, "-o", file("a.png")});
    EXPECT_EQ(output.status, 2);
    EXPECT_EQ(lines_of(output.text), 1);
  }
  const auto sweep = [&](const std::string& text, const std::string& message) {
    const double before = processor_seconds();
    expect_refused({"sweep", put("s.toml", text), "--db", file("s.db")}, message);
    expect_modest(processor_seconds() - before);
  };
  const std::string scenes = "scenes = [\"sphere\"]\n";
  sweep(scenes + "[vary]\nseed = [1, 2]\n[set]\n\"scene.image.width\" = \"{" + deep + "=1}\"\n",
        "at most 64 parts");
  std::string ranges, conditions;
  for (int i = 0; i < 100; ++i) {
    ranges += fmt::format("\"{}:{}\",", i * 100000, i * 100000 + 99999);
    conditions += "\"seed>0\",";
  }
  sweep(scenes + "[vary]\nseed = [" + ranges + "]\n", "more than 100000 values");
  sweep(scenes + "where = [" + conditions + "]\n[vary]\nseed = [1, 2]\n",
        "100 conditions, may be at most 32");
  sweep(scenes + "sample = 100000\nwhere = \"0\"\n[vary]\nseed = \"1:99999\"\nstall = \"0:9\"\n",
        "no point is left");
  sweep(scenes + "[vary]\nseed = \"" + repeated("1,", 50000) + "1\"\n", "at most 65536 bytes");
  // The end of a long message is its reason.
  expect_refused({"verify", "sphere", "--set", "technology=" + std::string(3000, 'a')},
                 "generic, ice40-hx8k");
}

}  // namespace
}  // namespace phongpipe
