#include "testbench/tests/shading/quadratics/coarse_mesh_test.cpp"
#include "testbench/tests/shading/quadratics/random_cases.h"
namespace phongpipe { namespace {
TEST(Probe, X){ for(double power:{0.,20.}) {const CoarseMesh& mesh=kMeshes[1]; struct R{double ang,e[4],b;int px;double area,cmin;}; std::vector<R> rs; 
 for (const Vec3& light : {Vec3(-0.6, -0.6, -0.8), Vec3(0.55, -0.75, -0.7), Vec3(0.1, -0.2, -1)}) {
 const Scene scene=scene_of(mesh,light); Geometry g=make_geometry(scene); g.materials={material_of(power)}; 
 for(auto&t:g.triangles){ Geometry one=g; one.triangles={t}; R r;  r.area=std::abs((double)signed_area(t))/2/65536; for(int f=0;f<4;f++) r.e[f]=largest_error(scene,Geometry(one),power,kFits[f]);  if(r.e[3]<15&&r.e[0]<70)continue; FrameSetup frame(scene,g,DatapathConfiguration(),24); CosineCase c; for(int i=0;i<3;i++)c.normal[i]=t.vertices[i].normal; c.m=power==0?frame.materials[0].light.to_light:frame.materials[0].light.halfway; c.power=power==0?1:power; r.ang=1; for(int i=0;i<3;i++)r.ang=std::min(r.ang,c.normal[i].dot(c.normal[(i+1)%3])); r.ang=std::acos(r.ang)/kDegrees;  r.b=phongpipe::largest_error(c,best(c,12),12); FrontEnd fe(frame,one); TriangleWork w; fe.set_up(0,w); r.px=0; for(auto&x:w.rows)r.px+=x.length; 
 rs.push_back(r);}}
 std::sort(rs.begin(),rs.end(),[](const R&a,const R&b){return a.e[3]>b.e[3];}); for(size_t i=0;i<rs.size()&&i<12;i++)printf("   angle %.0f area %.2f pixels %d taylor %.1f six %.1f w %.1f foc %.1f best %.1f\n",rs[i].ang,rs[i].area,rs[i].px,rs[i].e[0],rs[i].e[1],rs[i].e[2],rs[i].e[3],rs[i].b);
std::sort(rs.begin(),rs.end(),[](const R&a,const R&b){return a.e[0]>b.e[0];}); for(size_t i=0;i<rs.size()&&i<4;i++)printf("T   angle %.0f area %.2f pixels %d taylor %.1f six %.1f w %.1f foc %.1f best %.1f\n",rs[i].ang,rs[i].area,rs[i].px,rs[i].e[0],rs[i].e[1],rs[i].e[2],rs[i].e[3],rs[i].b);
 }}
}}
