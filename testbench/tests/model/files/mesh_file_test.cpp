#include "model/files/mesh_file.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <set>

#include "testbench/tests/model/scene/scene_files.h"

namespace phongpipe {
namespace {

class MeshFile : public ::testing::Test {
 protected:
  Mesh load(const std::string& name, const std::string& text) {
    return load_mesh(folder_.write(name, text));
  }
  std::string error(const std::string& name, const std::string& text) {
    return error_of(folder_, [&] { load(name, text); });
  }
  // The notes without the folder.
  std::vector<std::string> notes(const Mesh& mesh) {
    std::vector<std::string> result;
    for (const std::string& note : mesh.notes) {
      result.push_back(error_of(folder_, [&] { throw InputError(note); }));
    }
    return result;
  }
  TempFolder folder_;
};

const std::string kPoints = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";  // lines 1 to 4

TEST_F(MeshFile, ObjWithNormalsIsTakenAsItIs) {
  const Mesh mesh = load("a.obj", kPoints + "vn 0 0 2\nvn 0 1 0\nf 1//1 2//1 3//2\n");
  ASSERT_EQ(mesh.faces.size(), 1U);
  const auto& corners = mesh.faces[0].vertices;
  EXPECT_EQ(mesh.positions[corners[1]], Vec3(1, 0, 0));
  EXPECT_EQ(mesh.normals[corners[0]], Vec3(0, 0, 1)) << "made unit";
  EXPECT_EQ(mesh.normals[corners[2]], Vec3(0, 1, 0));
  EXPECT_TRUE(mesh.notes.empty());
}

TEST_F(MeshFile, PolygonsBecomeTriangles) {
  const Mesh mesh = load("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf -4 -3 -2\n");
  EXPECT_EQ(mesh.faces.size(), 3U);
}

TEST_F(MeshFile, MissingNormalsAreWeightedByArea) {
  // Two faces meet in the edge from 1 to 2: one of area 1/2 facing +z, one of area 3/2 facing -y.
  const Mesh mesh = load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 -3\nf 1 2 3\nf 2 1 4\n");
  const auto& front = mesh.faces.at(0).vertices;
  const Vec3 mean = Vec3(0, 0, 1) + 3 * Vec3(0, -1, 0);
  EXPECT_LT((mesh.normals[front[0]] - mean.normalized()).norm(), 1e-12);
  EXPECT_EQ(mesh.normals[front[2]], Vec3(0, 0, 1));
  EXPECT_EQ(notes(mesh), std::vector<std::string>{"a.obj: no normals, smooth normals generated"});
}

TEST_F(MeshFile, OnlyMissingNormalsAreGenerated) {
  const Mesh mesh = load("a.obj", kPoints + "vn 0 1 1\nf 1//1 2//1 3//1\nf 1 4 2\n");
  EXPECT_EQ(notes(mesh), std::vector<std::string>{
                             "a.obj: some vertices have no normals, smooth normals generated"});
  for (const std::uint32_t vertex : mesh.faces.at(0).vertices) {
    EXPECT_EQ(mesh.normals[vertex], Vec3(0, 1, 1).normalized());
  }
  EXPECT_EQ(mesh.normals[mesh.faces.at(1).vertices[1]], Vec3(0, -1, 0).cwiseAbs());
}

TEST_F(MeshFile, SheetSeenFromBothSidesKeepsItsNormals) {
  const Mesh mesh = load("a.obj", kPoints + "f 1 2 3\nf 1 3 2\n");
  for (const MeshFace& face : mesh.faces) {
    for (const std::uint32_t vertex : face.vertices) {
      EXPECT_EQ(mesh.normals[vertex], face_area_vector(mesh, face).normalized());
    }
  }
}

TEST_F(MeshFile, BadObjNamesTheLine) {
  EXPECT_EQ(error("a.obj", kPoints + "f 1 2 9\n"),
            "a.obj:5: face refers to v 9, but the file has 4");
  EXPECT_EQ(error("a.obj", kPoints + "f 1 2 -5\n"),
            "a.obj:5: face refers to v -5, but the file has 4");
  EXPECT_EQ(error("a.obj", kPoints + "f 1 2 0\n"),
            "a.obj:5: face index '0' is not a whole number other than 0");
  EXPECT_EQ(error("a.obj", kPoints + "f 1 2 x\n"),
            "a.obj:5: face index 'x' is not a whole number other than 0");
  EXPECT_EQ(error("a.obj", kPoints + "vn 0 0 1\nf 1//1 2//1 3//2\n"),
            "a.obj:6: face refers to vn 2, but the file has 1");
  EXPECT_EQ(error("a.obj", kPoints + "f 1 2\n"), "a.obj:5: face has 2 vertices, needs at least 3");
  EXPECT_EQ(error("a.obj", kPoints + "f 1 \\\n 2 \\\n 7\n"),
            "a.obj:7: face refers to v 7, but the file has 4");
  EXPECT_EQ(error("a.obj", kPoints + "v 0 nan 0\nf 1 2 3\n"),
            "a.obj:5: vertex coordinate 'nan' is not a finite number");
  EXPECT_EQ(error("a.obj", kPoints + "v 0 1e10 0\nf 1 2 3\n"),
            "a.obj:5: vertex coordinate 1e10 is beyond 1000000000");
  EXPECT_EQ(error("a.obj", kPoints + "v 0 1\nf 1 2 3\n"),
            "a.obj:5: vertex needs three coordinates");
  EXPECT_EQ(error("a.obj", kPoints + "vn 0 0 0\nf 1//1 2//1 3//1\n"),
            "a.obj:6: face refers to vn 1, which is zero or not a number");
}

TEST_F(MeshFile, NothingToDrawIsRefused) {
  EXPECT_EQ(error("a.obj", ""), "a.obj: the file is empty");
  EXPECT_EQ(error("a.obj", kPoints), "a.obj: the mesh has no faces");
  EXPECT_EQ(error("a.obj", kPoints + "f 1 2 2\n"), "a.obj: all faces of the mesh have zero area");
  EXPECT_EQ(error_of(folder_, [&] { load_mesh(folder_.path() / "none.obj"); }),
            "none.obj: no such file");
}

TEST_F(MeshFile, LinesAndPointsAreLeftOutAndSaidSo) {
  const Mesh mesh = load("a.obj", kPoints + "vn 0 0 1\nl 1 2\nf 1//1 2//1 3//1\n");
  EXPECT_EQ(mesh.faces.size(), 1U);
  EXPECT_EQ(notes(mesh), std::vector<std::string>{"a.obj: 1 points and lines left out"});
}

TEST_F(MeshFile, FacesAgainstTheirNormalsAreReported) {
  const Mesh mesh = load("a.obj", kPoints + "vn 0 0 1\nf 1//1 3//1 2//1\nf 1//1 2//1 3//1\n");
  EXPECT_EQ(notes(mesh),
            std::vector<std::string>{"a.obj: 1 of 2 faces turn against their normals"});
}

const std::string kTriangle = kPoints + "usemtl paint\nvn 0 0 1\nf 1//1 2//1 3//1\n";

TEST_F(MeshFile, MaterialComesFromMtlUnscaled) {
  folder_.write("a.mtl", "newmtl paint\nKa 0.1 0.2 0.3\nKd 0.4 0.5 0.6\nKs 0.7 0.8 0.9\nNs 37.5\n");
  const Mesh mesh = load("a.obj", "mtllib a.mtl\n" + kTriangle);
  const Material& material = mesh.materials.at(mesh.faces.at(0).material);
  EXPECT_EQ(material.name, "paint");
  EXPECT_TRUE(material.ambient.isApprox(Color(0.1, 0.2, 0.3), 1e-6));
  EXPECT_TRUE(material.diffuse.isApprox(Color(0.4, 0.5, 0.6), 1e-6));
  EXPECT_TRUE(material.specular.isApprox(Color(0.7, 0.8, 0.9), 1e-6));
  EXPECT_EQ(material.shininess, 37.5);
}

TEST_F(MeshFile, MaterialOutOfRangeIsRefused) {
  folder_.write("a.mtl", "newmtl paint\nKd 0.5 1.5 0.5\n");
  EXPECT_EQ(error("a.obj", "mtllib a.mtl\n" + kTriangle),
            "a.mtl:2: Kd is [0.5, 1.5, 0.5], must be from 0 to 1");
  folder_.write("b.mtl", "newmtl paint\nNs -3\n");
  EXPECT_EQ(error("b.obj", "mtllib b.mtl\n" + kTriangle), "b.mtl:2: Ns is -3, must be at least 0");
}

TEST_F(MeshFile, MissingMtlIsSaidAndGivesTheDefaultMaterial) {
  const Mesh mesh = load("a.obj", "mtllib none.mtl\n" + kTriangle);
  EXPECT_TRUE(mesh.materials.empty());
  EXPECT_EQ(notes(mesh), std::vector<std::string>{"a.obj:1: material library 'none.mtl' not found, "
                                                  "default material used"});
}

std::string ply(const std::string& vertices, const std::string& faces, int face_count = 1) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nelement face " +
         std::to_string(face_count) + "\nproperty list uchar int vertex_indices\nend_header\n" +
         vertices + faces;
}
const std::string kPlyPoints = "0 0 0\n1 0 0\n0 1 0\n";  // lines 10 to 12

TEST_F(MeshFile, PlyIsReadAndHasNoMaterial) {
  const Mesh mesh = load("a.ply", ply(kPlyPoints, "3 0 1 2\n"));
  EXPECT_EQ(mesh.faces.size(), 1U);
  EXPECT_EQ(mesh.normals[mesh.faces[0].vertices[0]], Vec3(0, 0, 1));
  EXPECT_TRUE(mesh.materials.empty());
}

TEST_F(MeshFile, BadPlyNamesTheLine) {
  EXPECT_EQ(error("a.ply", ply(kPlyPoints, "3 0 1 3\n")),
            "a.ply:13: face 0 refers to vertex 3, but the file has 3 (counted from 0)");
  EXPECT_EQ(error("a.ply", ply(kPlyPoints, "3 0 1 -1\n")),
            "a.ply:13: face 0 refers to vertex -1, but the file has 3 (counted from 0)");
  EXPECT_EQ(error("a.ply", ply("0 0 0\n1 nan 0\n0 1 0\n", "3 0 1 2\n")),
            "a.ply:11: vertex 1: y is nan, must be a number of at most 1000000000");
  EXPECT_EQ(error("a.ply", ply("0 0 0\n1 0\n0 1 0\n", "3 0 1 2\n")),
            "a.ply:11: vertex 1 has too few numbers");
  EXPECT_EQ(error("a.ply", ply(kPlyPoints, "3 0 1 2\n", 2)),
            "a.ply:13: the file ends before face 1");
  EXPECT_EQ(error("a.ply", "plx\n"), "a.ply:1: not a PLY file, the first line must be 'ply'");
  EXPECT_EQ(error("a.ply", "ply\nelement vertex many\n"),
            "a.ply:2: element count 'many' is not a whole number");
  EXPECT_EQ(error("a.ply", "ply\nproperty float\n"),
            "a.ply:2: header line not understood: 'property float'");
}

std::string bytes(float value) {
  std::string raw(sizeof(value), '\0');
  std::memcpy(raw.data(), &value, sizeof(value));
  return raw;
}

TEST_F(MeshFile, BinaryPlyIsCheckedToo) {
  const auto file = [](float x, char last_index, std::size_t cut) {
    std::string text =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
        "property float y\nproperty float z\nelement face 1\n"
        "property list uchar uchar vertex_index\nend_header\n";
    for (const float value : {0.F, 0.F, 0.F, x, 0.F, 0.F, 0.F, 1.F, 0.F}) {
      text += bytes(value);
    }
    text += std::string("\3\0\1", 3) + last_index;
    return text.substr(0, text.size() - cut);
  };
  EXPECT_EQ(load("a.ply", file(1, 2, 0)).faces.size(), 1U);
  EXPECT_EQ(error("a.ply", file(1, 7, 0)),
            "a.ply: face 0 refers to vertex 7, but the file has 3 (counted from 0)");
  EXPECT_EQ(error("a.ply", file(NAN, 2, 0)),
            "a.ply: vertex 1: x is nan, must be a number of at most 1000000000");
  EXPECT_EQ(error("a.ply", file(1, 2, 2)), "a.ply: the file ends before face 0 is complete");
}

TEST_F(MeshFile, StlIsSmoothedWhateverItsFacetNormals) {
  const Mesh mesh = load("a.stl",
                         "solid s\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                         "vertex 0 1 0\nendloop\nendfacet\nendsolid s\n");
  ASSERT_EQ(mesh.faces.size(), 1U);
  EXPECT_EQ(mesh.normals[mesh.faces[0].vertices[0]], Vec3(0, 0, 1));
  EXPECT_TRUE(mesh.materials.empty());
  EXPECT_EQ(notes(mesh),
            std::vector<std::string>{"a.stl: only facet normals, smooth normals generated"});
}

std::string gltf(const std::string& node, const std::string& last_index) {
  // Three positions (0,0,0), (1,0,0), (0,0,1) and the indices 0, 1 and the given one, in base64.
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,)" +
         node +
         R"(}],"materials":[{"name":"m","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,0.125,1]}}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],)"
         R"("buffers":[{"byteLength":42,"uri":"data:application/octet-stream;base64,)"
         R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAAAAAIA/AAABAA)" +
         last_index +
         R"("}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},)"
         R"({"buffer":0,"byteOffset":36,"byteLength":6}],"accessors":[{"bufferView":0,)"
         R"("componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,0,1]},)"
         R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}]})";
}

TEST_F(MeshFile, GltfNodeTransformsApply) {
  const Mesh mesh = load("a.gltf", gltf(R"("scale":[-2,1,1],"translation":[5,0,0])", "IA"));
  ASSERT_EQ(mesh.faces.size(), 1U);
  const auto& corners = mesh.faces[0].vertices;
  EXPECT_EQ(mesh.positions[corners[0]], Vec3(5, 0, 0));
  EXPECT_EQ(mesh.normals[corners[0]], Vec3(0, -1, 0)) << "a mirrored face keeps its outside";
  const Material& material = mesh.materials.at(mesh.faces[0].material);
  EXPECT_EQ(material.name, "m");
  EXPECT_TRUE(material.diffuse.isApprox(Color(0.5, 0.25, 0.125), 1e-6));
  EXPECT_EQ(material.shininess, Material{}.shininess) << "glTF has none";
}

TEST_F(MeshFile, GltfWithBadIndexIsRefused) {
  EXPECT_NE(error("a.gltf", gltf(R"("scale":[1,1,1])", "kA")), "no error");
}

TEST_F(MeshFile, ShippedBallHasTwoMaterialsAndUnitNormals) {
  const Mesh mesh = load_mesh(std::filesystem::path(PHONGPIPE_SCENES) / "ball.obj");
  EXPECT_EQ(mesh.faces.size(), 320U);
  std::set<std::string> names;
  for (const MeshFace& face : mesh.faces) {
    names.insert(mesh.materials.at(face.material).name);
    for (const std::uint32_t vertex : face.vertices) {
      EXPECT_GT(mesh.normals[vertex].dot(mesh.positions[vertex]), 0.99);
    }
  }
  EXPECT_EQ(names, (std::set<std::string>{"blue", "white"}));
}

}  // namespace
}  // namespace phongpipe
