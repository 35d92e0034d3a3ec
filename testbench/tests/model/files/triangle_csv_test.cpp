#include "model/files/triangle_csv.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <sstream>

#include "model/files/text_file.h"
#include "testbench/tests/model/scene/scene_files.h"

namespace phongpipe {
namespace {

const std::string kHeader = "x0,y0,z0,nx0,ny0,nz0,x1,y1,z1,nx1,ny1,nz1,x2,y2,z2,nx2,ny2,nz2\n";
const std::string kRow = "1.5,2,3,0,0,-2,10.25,2,3,0,1,0,1,20.001,4,0,0,-1\n";

class TriangleCsv : public ::testing::Test {
 protected:
  std::vector<ScreenTriangle> read(const std::string& text) {
    return read_triangle_csv(folder_.write("t.csv", text), Image{64, 48, Color::Zero()});
  }
  std::string error(const std::string& text) {
    return error_of(folder_, [&] { read(text); });
  }
  std::string row_error(const std::string& row) { return error(kHeader + kRow + row); }
  TempFolder folder_;
};

TEST_F(TriangleCsv, ReadsSnapsAndMakesNormalsUnit) {
  const auto triangles = read(kHeader + "\r\n" + kRow + "\n" + kRow);
  ASSERT_EQ(triangles.size(), 2U);
  const ScreenVertex& first = triangles[0].vertices[0];
  EXPECT_EQ(in_pixels(first.x), 1.5);
  EXPECT_EQ(in_pixels(first.y), 2);
  EXPECT_EQ(first.z, 3);
  EXPECT_EQ(first.normal, Vec3(0, 0, -1));
  EXPECT_EQ(first.eye, Vec3(0, 0, -1));
  EXPECT_EQ(first.position, Vec3(1.5, 2, 3));
  const ScreenVertex& last = triangles[0].vertices[2];
  EXPECT_EQ(in_pixels(last.y), 20) << "20.001 is nearest to 20";
  EXPECT_EQ(last.position, Vec3(1, 20, 4)) << "where the snapped vertex is";
}

TEST_F(TriangleCsv, HeaderIsChecked) {
  EXPECT_EQ(error(kRow), "t.csv:1: column 1 of the header is '1.5', must be 'x0'");
  EXPECT_EQ(error("x0,y0\n"), "t.csv:1: 2 columns, must be 18: x0,y0,z0,nx0,ny0,nz0,x1,...,nz2");
  EXPECT_EQ(error(kHeader), "t.csv: no triangles below the header");
  EXPECT_EQ(error(" \n"), "t.csv: the file is empty");
}

TEST_F(TriangleCsv, BadRowsNameTheirLine) {
  EXPECT_EQ(row_error("1,2,3\n"),
            "t.csv:3: 3 columns, must be 18: x0,y0,z0,nx0,ny0,nz0,x1,...,nz2");
  EXPECT_EQ(row_error("1,2,3,0,0,1,1,2,3,0,0,1,1,two,3,0,0,1\n"),
            "t.csv:3: y2 is 'two', not a finite number");
  EXPECT_EQ(row_error("1,2,nan,0,0,1,1,2,3,0,0,1,1,2,3,0,0,1\n"),
            "t.csv:3: z0 is 'nan', not a finite number");
  EXPECT_EQ(row_error("1,2,,0,0,1,1,2,3,0,0,1,1,2,3,0,0,1\n"),
            "t.csv:3: z0 is '', not a finite number");
  EXPECT_EQ(row_error("1,2,3,0,0,1,1,2,3,0,0,0,1,2,3,0,0,1\n"),
            "t.csv:3: the normal of vertex 1 has the length 0, must be a direction");
  EXPECT_EQ(row_error("-8193,2,3,0,0,1,1,2,3,0,0,1,1,2,3,0,0,1\n"),
            "t.csv:3: x0 is -8193, must be from -8192 to 8256");
  EXPECT_EQ(row_error("1,8241,3,0,0,1,1,2,3,0,0,1,1,2,3,0,0,1\n"),
            "t.csv:3: y0 is 8241, must be from -8192 to 8240");
}

class CsvScene : public TriangleCsv {
 protected:
  Scene scene_of(const std::string& rows) {
    Scene scene = sphere_scene();
    scene.objects[0].screen_triangles = std::make_shared<const std::vector<ScreenTriangle>>(
        read_triangle_csv(folder_.write("scene.csv", kHeader + rows), scene.image));
    return scene;
  }
};

TEST_F(CsvScene, KeepsBothOrientationsInTheirOrder) {
  const Geometry geometry = make_geometry(
      scene_of("1,1,3,0,0,-1,9,1,3,0,0,-1,1,9,3,0,0,-1\n1,1,3,0,0,-1,1,9,3,0,0,-1,9,1,3,0,0,-1\n"));
  ASSERT_EQ(geometry.triangles.size(), 2U);
  EXPECT_EQ(signed_area(geometry.triangles[0]), 64 * kSubpixels * kSubpixels);
  EXPECT_EQ(signed_area(geometry.triangles[1]), -64 * kSubpixels * kSubpixels);
  EXPECT_EQ(geometry.triangles[1].vertices[1].y, 9 * kSubpixels);
  EXPECT_EQ(geometry.materials.at(0).name, "default");
}

TEST_F(CsvScene, RemovesAndCountsWhatCannotBeSeen) {
  const Geometry geometry = make_geometry(
      scene_of("1,1,3,0,0,-1,9,9,3,0,0,-1,5,5,3,0,0,-1\n"          // no area
               "1,1,3,0,0,-1,1.001,1,3,0,0,-1,1,1.001,3,0,0,-1\n"  // none after snapping
               "-9,1,3,0,0,-1,0,1,3,0,0,-1,-1,9,3,0,0,-1\n"        // left of the image
               "1,64,3,0,0,-1,9,64,3,0,0,-1,1,99,3,0,0,-1\n"       // below it
               "1,1,3,0,0,-1,9,1,3,0,0,-1,1,9,3,0,0,-1\n"));
  EXPECT_EQ(geometry.triangles_read, 5U);
  EXPECT_EQ(geometry.degenerate, 2U);
  EXPECT_EQ(geometry.culled_outside, 2U);
  EXPECT_EQ(geometry.triangles.size(), 1U);
}

TEST_F(CsvScene, DumpHasAllColumnsExactly) {
  Scene scene = scene_of("1.5,1,3,0,0,-1,9,1,3,0.6,0,-0.8,1,9,4,0,1,0\n");
  scene.lights[0].direction = Vec3(0, 0.6, 0.8);
  Light point;
  point.type = LightType::point;
  point.position = Vec3(1, 2, -3);
  scene.lights.push_back(point);
  scene.materials.push_back({});
  scene.materials[0].name = "red, \"shiny\"";
  scene.objects[0].material = scene.materials[0].name;
  EXPECT_EQ(triangles_csv(scene, make_geometry(scene)),
            "x0,y0,z0,nx0,ny0,nz0,x1,y1,z1,nx1,ny1,nz1,x2,y2,z2,nx2,ny2,nz2,"
            "ex0,ey0,ez0,ex1,ey1,ez1,ex2,ey2,ez2,"
            "l0x0,l0y0,l0z0,l0x1,l0y1,l0z1,l0x2,l0y2,l0z2,"
            "l1x0,l1y0,l1z0,l1x1,l1y1,l1z1,l1x2,l1y2,l1z2,material\n"
            "1.5,1,3,0,0,-1,9,1,3,0.6,0,-0.8,1,9,4,0,1,0,0,0,-1,0,0,-1,0,0,-1,"
            "-0,-0.6,-0.8,-0,-0.6,-0.8,-0,-0.6,-0.8,-0.5,1,-6,-8,1,-6,0,-7,-7,"
            "\"red, \"\"shiny\"\"\"\n");
}

RC_GTEST_FIXTURE_PROP(CsvScene, DumpReadsBackToTheSameTriangle, ()) {
  std::string row;
  for (int vertex = 0; vertex < 3; ++vertex) {
    const auto pixel = [] { return *rc::gen::inRange(-1000, 20000) / 317.0; };
    const auto component = [] { return *rc::gen::inRange(-1000, 1000) / 999.0; };
    row += std::to_string(pixel()) + ',' + std::to_string(pixel()) + ',' +
           std::to_string(component()) + ',' + std::to_string(component()) + ',' +
           std::to_string(component()) + ",1.5" + (vertex < 2 ? "," : "\n");
  }
  const Scene scene = scene_of(row);
  const Geometry geometry = make_geometry(scene);
  RC_PRE(geometry.triangles.size() == 1);
  const std::string dump = triangles_csv(scene, geometry);
  const std::string dumped_row = dump.substr(dump.find('\n') + 1);
  const auto cells = split(dumped_row, ',');
  std::string again;
  for (std::size_t column = 0; column < 18; ++column) {
    again += std::string(cells[column]) + (column < 17 ? "," : "\n");
  }
  const ScreenTriangle second = read(kHeader + again).at(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const ScreenVertex& before = geometry.triangles[0].vertices[i];
    const ScreenVertex& after = second.vertices[i];
    RC_ASSERT(before.x == after.x);
    RC_ASSERT(before.y == after.y);
    RC_ASSERT(before.z == after.z);
    RC_ASSERT(before.normal == after.normal);
  }
}

}  // namespace
}  // namespace phongpipe
