// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>

#include "animated_gltf.hpp"
#include "support.hpp"

namespace impinge::io {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// glTF with its buffer inside: one triangle mesh of two primitives, shown by nodes.
std::string gltf(std::string_view nodes) {
  std::string buffer;
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.1f}) append_bytes(buffer, x);
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + std::string(nodes) +
         R"(],"meshes":[{"name":"bracket","primitives":[{"attributes":{"POSITION":0}},{"attributes":{"POSITION":0}}]},)"
         R"({"primitives":[{"attributes":{"POSITION":0}}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0.1]}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)" +
         test::AnimatedGltf::base64(buffer) + R"("}]})";
}

TEST(Import, GltfNamesPathsPosesAndSharedMeshes) {
  const Model model = read_text(
      gltf(R"({"name":"engine","children":[1,2,3,4]},)"
           R"({"mesh":0,"translation":[1,2,3]},)"
           R"({"mesh":0,"name":"left","rotation":[0,0,0.70710678118654752,0.70710678118654752],"children":[5]},)"
           R"({"mesh":0,"scale":[2,2,2]},)"
           R"({"children":[6],"translation":[0.5,0,0]},)"
           R"({"mesh":1},)"
           R"({"mesh":1,"translation":[0.25,0,0]})"));
  EXPECT_EQ(names_of(model), (std::vector<std::string>{"bracket", "left", "left (2)", "bracket (2)", "engine"}));
  std::vector<std::string> paths;
  for (const Object& object : model.objects) paths.push_back(object.path);
  EXPECT_EQ(paths,
            (std::vector<std::string>{"engine/bracket", "engine/left", "engine/left", "engine/bracket", "engine"}));
  const double z = double{0.1f};
  EXPECT_EQ(points_of(model.objects[0]), (Points{{0, 0, 0}, {1, 0, 0}, {0, 1, z}, {0, 0, 0}, {1, 0, 0}, {0, 1, z}}));
  EXPECT_EQ(triangles_of(model.objects[0]), (Triangles{{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(model.objects[0].pose.t, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(&model.objects[0].mesh.state(), &model.objects[1].mesh.state()) << "one mesh, shown twice";
  EXPECT_NEAR(model.objects[1].pose.R[1], -1, 1e-6);
  EXPECT_EQ(points_of(model.objects[3])[1], (Point{2, 0, 0})) << "scaled: baked";
  EXPECT_EQ(model.objects[3].pose.R, Pose{}.R);
  EXPECT_EQ(model.objects[4].pose.t, (std::array<double, 3>{0.75, 0, 0}));
  EXPECT_TRUE(model.warnings.empty()) << model.warnings[0];
}

/// "storey/wall" of each object: the groups above it, by their names, "-" without one.
std::vector<std::string> groups_of(const Model& model) {
  std::vector<std::string> all;
  for (const Object& object : model.objects) {
    std::string way;
    for (auto at = object.group; at; at = model.groups.at(*at).parent) {
      const std::string& name = model.groups[*at].name;
      way = (name.empty() ? "-" : name) + (way.empty() ? "" : "/" + way);
    }
    all.push_back(way);
  }
  return all;
}

TEST(Import, ObjectsHangUnderTheNodesOfTheFile) {
  const Model model = read_text(gltf(R"({"name":"engine","children":[1,2,3,5]},)"
                                     R"({"name":"asm","children":[7,8]},)"
                                     R"({"name":"asm","children":[9]},)"
                                     R"({"children":[4]},)"
                                     R"({"children":[6],"mesh":1},)"
                                     R"({"mesh":0,"name":"lid 1/2"},)"
                                     R"({"mesh":0},)"
                                     R"({"mesh":0,"name":"p"},{"mesh":0,"name":"q"},{"mesh":0,"name":"p"})"));
  EXPECT_EQ(groups_of(model),
            (std::vector<std::string>{"engine/asm", "engine/asm", "engine/asm", "engine/-", "engine/-/-", "engine"}));
  EXPECT_EQ(model.objects[0].group, model.objects[1].group);
  EXPECT_NE(model.objects[0].group, model.objects[2].group) << "two nodes of one name";
  EXPECT_EQ(model.groups.size(), 5u) << "each once, and none without objects";
  for (const Object& object : read_text(gltf(R"({"mesh":1})")).objects) EXPECT_FALSE(object.group) << "it is the root";

  const Model house = model_of(read(kModels / "IFC/AC14-FZK-Haus.ifc"));
  const std::vector<std::string> ways = groups_of(house);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    // Of this file no name has a '/', and every part is under a product that has one.
    const std::string& path = house.objects[i].path;
    EXPECT_EQ(ways[i], path.find('/') == std::string::npos ? "" : path.substr(0, path.rfind('/')));
  }
  // What assimp makes of a transform is no node of the file.
  for (const char* const file : {"FBX/box.fbx", "FBX/cubes_with_names.fbx", "FBX/spider.fbx"})
    for (const Group& group : model_of(read(kModels / file)).groups)
      EXPECT_EQ(group.name.find("Assimp"), std::string::npos) << file;
  const Model box = model_of(read(kModels / "FBX/box.fbx"));
  EXPECT_EQ(groups_of(box), std::vector<std::string>{"-"}) << "under pivots, and these under the root";
}

void replace(std::string& text, std::string_view what, std::string_view by) {
  const std::size_t at = text.find(what);
  ASSERT_NE(at, std::string::npos) << what;
  text.replace(at, what.size(), by);
}

/// One node that shows one primitive of the mode, four vertices and these indices.
std::string indexed_gltf(const std::vector<std::uint16_t>& indices, int mode = 4) {
  std::string buffer;
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f}) append_bytes(buffer, x);
  for (const std::uint16_t index : indices) append_bytes(buffer, index);
  const std::string count = std::to_string(indices.size()), bytes = std::to_string(2 * indices.size());
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,0]}],"nodes":[{"mesh":0}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":)" +
         std::to_string(mode) +
         R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5123,"type":"SCALAR","count":)" +
         count + R"(}],"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":)" + bytes +
         R"(}],"buffers":[{"byteLength":)" + std::to_string(buffer.size()) +
         R"(,"uri":"data:application/octet-stream;base64,)" + test::AnimatedGltf::base64(buffer) + R"("}]})";
}

TEST(Import, GltfNamesThatOtherFormatsWouldMakeUpAreKept) {
  for (const std::string name : {"$shaft", "<lid>", "RootNode", "a_$AssimpFbx$_b"})
    EXPECT_EQ(names_of(read_text(gltf(R"({"mesh":1,"name":")" + name + R"("})"))), std::vector<std::string>{name});
}

TEST(Import, GltfTrianglesWithIndicesOutOfRangeAreAnError) {
  const TemporaryFolder folder;
  // The node is shown twice.
  EXPECT_EQ(read_text(indexed_gltf({0, 1, 2, 1, 1, 3})).objects.size(), 2u);
  EXPECT_THAT(error_of(read(folder.write("bad.gltf", indexed_gltf({0, 1, 2, 0, 1, 9})))),
              HasSubstr("assimp dropped 2 of 4 triangles whose indices are out of range"));
  for (const int mode : {5, 6}) {  // strips and fans, with a degenerate triangle
    EXPECT_EQ(triangles_of(read_text(indexed_gltf({0, 1, 2, 2, 3}, mode)).objects.at(0)).size(), 3u);
    EXPECT_THAT(error_of(read(folder.write("bad.gltf", indexed_gltf({0, 1, 2, 9}, mode)))),
                HasSubstr("assimp dropped 2 of 4"));
  }
}

TEST(Import, GltfThatAssimpWouldMisreadIsRefused) {
  const TemporaryFolder folder;
  const auto problem_of = [&](const std::string& text) { return error_of(read(folder.write("bad.gltf", text))); };
  EXPECT_THAT(problem_of(indexed_gltf({0, 1, 2, 0, 1})), HasSubstr("has 5 corners, which is not a multiple of 3"));
  std::string text = indexed_gltf({0, 1, 2});
  replace(text, "5126", "5122");
  EXPECT_THAT(problem_of(text), HasSubstr("component type 5122"));
  text = indexed_gltf({0, 1, 2});
  replace(text, "VEC3", "VEC4");
  EXPECT_THAT(problem_of(text), HasSubstr("'VEC4'"));
  const auto requiring = [](std::string_view extension) {
    return R"({"extensionsRequired":[")" + std::string(extension) + R"("],)" + indexed_gltf({0, 1, 2}).substr(1);
  };
  EXPECT_THAT(problem_of(requiring("KHR_mesh_quantization")), HasSubstr("extension 'KHR_mesh_quantization'"));
  EXPECT_THAT(problem_of(requiring("EXT_meshopt_compression")), HasSubstr("extension 'EXT_meshopt_compression'"));
  EXPECT_THAT(problem_of(requiring("KHR_draco_mesh_compression")), HasSubstr("holds nothing compressed"));
  for (const char* harmless : {"KHR_materials_unlit", "KHR_texture_transform", "KHR_lights_punctual"})
    EXPECT_EQ(read_text(requiring(harmless)).objects.size(), 2u) << harmless;
  text = indexed_gltf({0, 1, 2});
  replace(text, R"({"mesh":0})", R"({"mesh":0,"children":[0]})");
  EXPECT_THAT(problem_of(text), HasSubstr("its nodes form a loop"));
  EXPECT_THAT(problem_of("{\"asset\":"), HasSubstr("its JSON cannot be read"));
}

/// assimp takes a node without what it cannot read, which puts the part elsewhere.
TEST(Import, GltfNodesThatAssimpWouldPutElsewhereAreRefused) {
  const TemporaryFolder folder;
  const auto with = [&](const std::string& what) {
    std::string text = indexed_gltf({0, 1, 2});
    replace(text, R"({"mesh":0})", R"({"name":"arm","mesh":0,)" + what + "}");
    return read(folder.write("case.gltf", text));
  };
  const std::pair<const char*, const char*> kBad[] = {
      {"matrix", "[1,0,0,0,0,1,0,0,0,0,1,0,5,0,1]"},
      {"matrix", "[1e39,0,0,0,0,1,0,0,0,0,1,0,5,0,0,1]"},
      {"translation", "[5,0]"},
      {"translation", R"(["5",0,0])"},
      {"translation", "5"},
      {"rotation", "[0,0,1]"},
      {"scale", "[1,null,1]"},
  };
  EXPECT_THAT(error_of(with(R"("rotation":[0,0,0,-0.0])")), HasSubstr("node 0 'arm' has a rotation of four zeros"));
  EXPECT_THAT(error_of(with(R"("skin":7)")), HasSubstr("node 0 'arm' has the skin 7, which is not in the file"));
  for (const auto& [name, value] : kBad)
    EXPECT_THAT(error_of(with('"' + std::string(name) + "\":" + value)),
                HasSubstr(std::string("node 0 'arm' has a ") + name + " that is not "))
        << value;
  EXPECT_TRUE(with(R"("translation":[5,0,0],"rotation":[0,0,1,0],"scale":[1,-1,1])").has_value());
  EXPECT_TRUE(with(R"("matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,0,0,1],"extensions":{"KHR_node":{}})").has_value());
  EXPECT_THAT(error_of(with(R"("extensions":{"EXT_mesh_gpu_instancing":{}})")),
              HasSubstr("node 0 'arm' is shown many times by EXT_mesh_gpu_instancing"));
}

TEST(Import, GltfElementsThatAreNotWhereTheyMayBeAreRefused) {
  const TemporaryFolder folder;
  const auto with = [&](std::string_view what, std::string_view more) {
    std::string text = indexed_gltf({0, 1, 2});
    replace(text, what, std::string(what) + std::string(more));
    return read(folder.write("case.gltf", text));
  };
  const char *const positions = R"("bufferViews":[{"buffer":0)", *const indices = R"("byteOffset":48)",
                    *const first = R"("accessors":[{"bufferView":0)", *const second = R"({"bufferView":1)";
  for (const char* const stride : {"1", "4", "8", "11", "14", "256", "-12", "12.5", "\"12\""})
    EXPECT_THAT(error_of(with(positions, std::string(",\"byteStride\":") + stride)),
                HasSubstr(std::string("mesh 0: its positions are ") + stride +
                          " bytes apart, which must be a multiple of 4 from 12 to 252; export it again"));
  for (const char* const stride : {"1", "4"})
    EXPECT_THAT(
        error_of(with(indices, std::string(",\"byteStride\":") + stride)),
        HasSubstr(std::string("its indices are ") + stride + " bytes apart, which must be 2, the size of one;"));
  EXPECT_THAT(
      error_of(with(first, R"(,"byteOffset":2)")),
      HasSubstr("its positions begin at byte 2 of a view that begins at byte 0, and both must be multiples of 4"));
  EXPECT_THAT(error_of(with(positions, R"(,"byteOffset":2)")), HasSubstr("of a view that begins at byte 2, "));
  EXPECT_THAT(error_of(with(second, R"(,"byteOffset":1)")), HasSubstr("its indices begin at byte 1 of a view that "));
  for (const char* const good : {R"(,"byteStride":12)", R"(,"byteStride":0)"}) {
    const Model model = model_of(with(positions, good));
    EXPECT_EQ(points_of(model.objects.at(0)), (Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})) << good;
  }
  EXPECT_TRUE(with(indices, R"(,"byteStride":2)").has_value());
  // Every second corner.
  std::string text = indexed_gltf({0, 1, 0});
  replace(text, positions, std::string(positions) + R"(,"byteStride":24)");
  replace(text, R"("count":4)", R"("count":2)");
  EXPECT_EQ(points_of(read_text(text).objects.at(0)), (Points{{0, 0, 0}, {0, 1, 0}}));
}

TEST(Import, GltfNodesThatAreHiddenAreThereAndSaidToBe) {
  const auto warnings = [](bool both) {
    const auto hidden = [](bool visible) {
      return std::string(R"("extensions":{"KHR_node_visibility":{"visible":)") + (visible ? "true}}" : "false}}");
    };
    const Model model = read_text(gltf(R"({"children":[1,2]},{"mesh":1,"name":"lid",)" + hidden(false) +
                                       R"(},{"mesh":1,"name":"arm","translation":[9,0,0],)" + hidden(!both) + "}"));
    EXPECT_EQ(model.objects.size(), 2u);
    return model.warnings;
  };
  const std::string end =
      " hidden by KHR_node_visibility, which is not followed: what that hides is checked as if it were visible.";
  EXPECT_THAT(warnings(false), testing::ElementsAre(HasSubstr("1 node, 'lid', is" + end)));
  EXPECT_THAT(warnings(true), testing::ElementsAre(HasSubstr("2 nodes (the first is 'lid') are" + end)));
}

TEST(Import, GlbWhoseChunkIsLongerThanTheFileIsRefused) {
  const TemporaryFolder folder;
  std::string glb = "glTF";
  for (const std::uint32_t number : {2u, 24u, 4u, 0x4E4F534Au}) append_bytes(glb, number);
  EXPECT_THAT(error_of(read(folder.write("bad.glb", glb))), HasSubstr("longer than the rest of the file, 0 bytes"));
  EXPECT_THAT(error_of(read(folder.write("bad.glb", glb.substr(0, 19)))), HasSubstr("ends in the GLB header"));
}

TEST(Import, DracoIsDecoded) {
  const Model model = model_of(read(kModels / "glTF2/draco/2CylinderEngine.gltf"));
  std::size_t triangles = 0;
  for (const Object& object : model.objects) triangles += object.mesh.triangle_count();
  EXPECT_EQ(triangles, 110'336u) << "the sum of its accessors' counts over three";
}

TEST(Import, TheEngineHasItsPartsAndTriangles) {
  const Model model = model_of(read(kModels / "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb"));
  expect_sound(model);
  EXPECT_EQ(model.objects.size(), 67u);
  std::size_t triangles = 0;
  std::set<const MeshState*> meshes;
  for (const Object& object : model.objects) {
    triangles += object.mesh.triangle_count();
    meshes.insert(&object.mesh.state());
    EXPECT_EQ(object.name.find("nodes["), std::string::npos) << object.name;
    EXPECT_TRUE(object.product.empty());
  }
  EXPECT_EQ(triangles, 121'496u);
  EXPECT_EQ(meshes.size(), 29u) << "the file's meshes";
  EXPECT_THAT(names_of(model), Contains("Piston_123-844_0_Parts_1"));
  EXPECT_THAT(names_of(model), Contains("body_24 (2)"));
}

TEST(Import, TheHouseIsNamedByItsProducts) {
  const Model model = model_of(read(kModels / "IFC/AC14-FZK-Haus.ifc"));
  expect_sound(model);
  EXPECT_EQ(model.objects.size(), 110u);
  std::set<std::string> products;
  for (const Object& object : model.objects) {
    EXPECT_EQ(object.name.find("IfcMappedItem"), std::string::npos);
    EXPECT_TRUE(object.product.starts_with("Ifc")) << object.name;
    EXPECT_TRUE(object.path.starts_with("Gel\u00e4nde")) << object.path;
    products.insert(object.product);
  }
  EXPECT_EQ(products.size(), 110u) << "each product of this file has one node with a mesh";
  const auto named = [&](std::string_view name) {
    return *std::find_if(model.objects.begin(), model.objects.end(), [&](const Object& o) { return o.name == name; });
  };
  EXPECT_EQ(named("EG-Fenster-6").product, "IfcWindow_EG-Fenster-6_1srAI$R4T8ihLXSNHmUSET");
  EXPECT_EQ(named("EG-Fenster-6").path, "Gel\u00e4nde/AC14-FZK-Haus/0. Erdgeschoss/EG-Fenster-6");
  EXPECT_EQ(&named("Sparren-1").mesh.state(), &named("Sparren-2").mesh.state());
  EXPECT_NE(named("Kuechenschra...").product, named("Kuechenschra... (2)").product);
  EXPECT_EQ(model.unit_in_metres, 1);
}

TEST(Import, ColladaSaysThatAxesAndUnitsChanged) {
  const Model teapots = model_of(read(kModels / "Collada/teapots.DAE"));
  EXPECT_EQ(names_of(teapots), (std::vector<std::string>{"Teapot01", "Teapot02", "Teapot03"}));
  EXPECT_THAT(teapots.warnings, Contains(HasSubstr("(x, y, z) became (x, z, -y)")));
  EXPECT_THAT(teapots.warnings, Contains(HasSubstr("multiplied by 0.01")));
  const Model duck = model_of(read(kModels / "Collada/duck.dae"));
  ASSERT_EQ(duck.warnings.size(), 1u) << "Y is up, in centimetres";
  EXPECT_THAT(duck.warnings[0], HasSubstr("multiplied by 0.01"));
}

TEST(Import, FbxSaysItsUnit) {
  EXPECT_EQ(model_of(read(kModels / "FBX/cubes_with_names.fbx")).unit_in_metres, 0.01);
  EXPECT_EQ(model_of(read(kModels / "FBX/box_orphant_embedded_texture.fbx")).unit_in_metres, 1);
  const std::string text = bytes_of_file(kModels / "FBX/cubes_with_names.fbx"),
                    unit = R"("UnitScaleFactor", "double", "Number", "",)";
  for (const auto& [centimetres, metres] :
       {std::pair("0.1", std::optional(0.001)), {"2.54", 0.0254}, {"30.48", 0.3048}, {"-1", {}}}) {
    std::string other = text;
    const std::size_t at = other.find(unit) + unit.size();
    other.replace(at, other.find('\n', at) - at, centimetres);
    EXPECT_EQ(read_text(other, "case.fbx").unit_in_metres, metres) << centimetres;
  }
}

TEST(Import, OtherFormatsKeepNames) {
  EXPECT_EQ(names_of(model_of(read(kModels / "FBX/cubes_with_names.fbx"))),
            (std::vector<std::string>{"Cube2", "\u041a\u0443\u0431\u0031", "Cube3", "\u041a\u0443\u0431\u0031 (2)"}));
  EXPECT_EQ(names_of(model_of(read(kModels / "3MF/box.3mf"))), std::vector<std::string>{"box"});
  EXPECT_EQ(names_of(model_of(read(kModels / "FBX/cubes_nonames.fbx"))),
            (std::vector<std::string>{"cubes_nonames", "cubes_nonames (2)", "cubes_nonames (3)", "cubes_nonames (4)"}));
  // One box of FBX lies under pivots that assimp made up.
  EXPECT_EQ(names_of(model_of(read(kModels / "FBX/box.fbx"))), std::vector<std::string>{"root"});
}

TEST(Import, UnknownFormatsAreErrors) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of(read(folder.write("letter.doc", "Dear Sir or Madam"))),
              HasSubstr("letter.doc: assimp cannot read the file"));
  for (const auto& [name, words] : {std::pair("a.STEP", "this is STEP or IGES"),
                                    {"a.stp", "as 3MF, glTF or STL"},
                                    {"a.rvt", "a model of Revit"},
                                    {"a.nwd", "a model of Navisworks"},
                                    {"a.nwc", "from there as FBX"},
                                    {"a.dwg", "a drawing of a CAD program"},
                                    {"a.ifcXML", "IFC as XML"}})
    EXPECT_THAT(error_of(read(folder.write(name, "ISO-10303-21;"))), HasSubstr(words)) << name;
  EXPECT_THAT(error_of(read(folder.write("no-ending", "Dear Sir or Madam"))), HasSubstr("assimp cannot read the file"));
}

TEST(Import, TheMemoryLimitHolds) {
  ReadOptions options;
  options.memory_limit_bytes =
      100 << 20;  // enough to start, too little for half a million triangles with their polygons
  EXPECT_THAT(error_of(read(kModels / "BLEND/SuzanneSubdiv_252.blend", options)), HasSubstr("memory limit"));
}

}  // namespace
}  // namespace impinge::io
