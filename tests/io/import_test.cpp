// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>

#include "animated_gltf.hpp"
#include "support.hpp"

namespace impinge::io {
namespace {

using nlohmann::json;
using test::AnimatedGltf;
using testing::Contains;
using testing::HasSubstr;

/// glTF with its buffer inside: a mesh of one triangle twice and one of one, shown by nodes.
std::string gltf(const std::string& nodes) {
  AnimatedGltf file;
  file.mesh({0, 0, 0, 1, 0, 0, 0, 1, 0.1}, {0, 1, 2});
  json& meshes = file.root["meshes"];
  meshes[0] = meshes[1];
  meshes[0]["name"] = "bracket";
  meshes[0]["primitives"].push_back(meshes[1]["primitives"][0]);
  file.root["nodes"] = json::parse("[" + nodes + "]");
  file.roots({0});
  return file.text();
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
      EXPECT_THAT(group.name, testing::Not(HasSubstr("Assimp"))) << file;
  const Model box = model_of(read(kModels / "FBX/box.fbx"));
  EXPECT_EQ(groups_of(box), std::vector<std::string>{"-"}) << "under pivots, and these under the root";
}

/// A node that is shown twice, of one primitive of the mode with four vertices and these indices.
AnimatedGltf indexed_gltf(const std::vector<int>& indices, int mode = 4) {
  AnimatedGltf file;
  file.mesh({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, indices);
  file.root["meshes"][1]["primitives"][0]["mode"] = mode;
  file.node({{"mesh", 1}});
  file.roots({0, 0});
  return file;
}

using Changes = std::vector<std::pair<const char*, json>>;

/// The same as one triangle, with other values at these places.
Result<Model> read_changed(const Changes& changes) {
  AnimatedGltf file = indexed_gltf({0, 1, 2});
  for (const auto& [pointer, value] : changes) file.root[json::json_pointer(pointer)] = value;
  const TemporaryFolder folder;
  return read(folder.write("case.gltf", file.text()));
}

TEST(Import, GltfNamesThatOtherFormatsWouldMakeUpAreKept) {
  for (const std::string name : {"$shaft", "<lid>", "RootNode", "a_$AssimpFbx$_b"})
    EXPECT_EQ(names_of(read_text(gltf(R"({"mesh":1,"name":")" + name + R"("})"))), std::vector<std::string>{name});
}

TEST(Import, GltfTrianglesWithIndicesOutOfRangeAreAnError) {
  const auto shown = [&](const std::vector<int>& indices, int mode) {
    const TemporaryFolder folder;
    return read(folder.write("case.gltf", indexed_gltf(indices, mode).text()));
  };
  EXPECT_EQ(model_of(shown({0, 1, 2, 1, 1, 3}, 4)).objects.size(), 2u);
  EXPECT_THAT(error_of(shown({0, 1, 2, 0, 1, 9}, 4)),
              HasSubstr("assimp dropped 2 of 4 triangles whose indices are out of range"));
  for (const int mode : {5, 6}) {  // strips and fans, with a degenerate triangle
    EXPECT_EQ(triangles_of(model_of(shown({0, 1, 2, 2, 3}, mode)).objects.at(0)).size(), 3u);
    EXPECT_THAT(error_of(shown({0, 1, 2, 9}, mode)), HasSubstr("assimp dropped 2 of 4"));
  }
  EXPECT_THAT(error_of(shown({0, 1, 2, 0, 1}, 4)), HasSubstr("has 5 corners, which is not a multiple of 3"));
}

TEST(Import, GltfThatAssimpWouldMisreadIsRefused) {
  EXPECT_THAT(error_of(read_changed({{"/accessors/2/componentType", 5122}})), HasSubstr("component type 5122"));
  EXPECT_THAT(error_of(read_changed({{"/accessors/2/type", "VEC4"}})), HasSubstr("'VEC4'"));
  const auto requiring = [](const char* extension) { return read_changed({{"/extensionsRequired/0", extension}}); };
  EXPECT_THAT(error_of(requiring("KHR_mesh_quantization")), HasSubstr("extension 'KHR_mesh_quantization'"));
  EXPECT_THAT(error_of(requiring("EXT_meshopt_compression")), HasSubstr("extension 'EXT_meshopt_compression'"));
  EXPECT_THAT(error_of(requiring("KHR_draco_mesh_compression")), HasSubstr("holds nothing compressed"));
  for (const char* harmless : {"KHR_materials_unlit", "KHR_texture_transform", "KHR_lights_punctual"})
    EXPECT_EQ(model_of(requiring(harmless)).objects.size(), 2u) << harmless;
  EXPECT_THAT(error_of(read_changed({{"/nodes/0/children/0", 0}})), HasSubstr("its nodes form a loop"));
  const TemporaryFolder folder;
  EXPECT_THAT(error_of(read(folder.write("bad.gltf", "{\"asset\":"))), HasSubstr("its JSON cannot be read"));
}

/// assimp takes a node without what it cannot read, which puts the part elsewhere.
TEST(Import, GltfNodesThatAssimpWouldPutElsewhereAreRefused) {
  const auto with = [&](const char* what) {
    json node = json::parse(what);
    node.update({{"name", "arm"}, {"mesh", 1}});
    return read_changed({{"/nodes/0", node}});
  };
  for (const auto& [what, problem] : std::vector<std::pair<const char*, const char*>>{
           {R"({"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,0,1]})", "has a matrix that is not "},
           {R"({"matrix":[1e39,0,0,0,0,1,0,0,0,0,1,0,5,0,0,1]})", "has a matrix that is not "},
           {R"({"translation":[5,0]})", "has a translation that is not "},
           {R"({"translation":["5",0,0]})", "has a translation that is not "},
           {R"({"translation":5})", "has a translation that is not "},
           {R"({"rotation":[0,0,1]})", "has a rotation that is not "},
           {R"({"rotation":[0,0,0,-0.0]})", "has a rotation of four zeros"},
           {R"({"scale":[1,null,1]})", "has a scale that is not "},
           {R"({"skin":7})", "has the skin 7, which is not in the file"},
           {R"({"extensions":{"EXT_mesh_gpu_instancing":{}}})", "is shown many times by EXT_mesh_gpu_instancing"}})
    EXPECT_THAT(error_of(with(what)), HasSubstr(std::string("node 0 'arm' ") + problem)) << what;
  EXPECT_TRUE(with(R"({"translation":[5,0,0],"rotation":[0,0,1,0],"scale":[1,-1,1]})").has_value());
  EXPECT_TRUE(with(R"({"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,0,0,1],"extensions":{"KHR_node":{}}})").has_value());
}

TEST(Import, GltfElementsThatAreNotWhereTheyMayBeAreRefused) {
  for (const json stride :
       {json(1), json(4), json(8), json(11), json(14), json(256), json(-12), json(12.5), json("12")})
    EXPECT_THAT(error_of(read_changed({{"/bufferViews/2/byteStride", stride}})),
                HasSubstr("mesh 1: its positions are " + stride.dump() +
                          " bytes apart, which must be a multiple of 4 from 12 to 252; export it again"));
  for (const char* const stride : {"1", "4"})
    EXPECT_THAT(
        error_of(read_changed({{"/bufferViews/3/byteStride", json::parse(stride)}})),
        HasSubstr(std::string("its indices are ") + stride + " bytes apart, which must be 2, the size of one;"));
  EXPECT_THAT(
      error_of(read_changed({{"/accessors/2/byteOffset", 2}})),
      HasSubstr("its positions begin at byte 2 of a view that begins at byte 168, and both must be multiples of 4"));
  EXPECT_THAT(error_of(read_changed({{"/bufferViews/2/byteOffset", 2}})),
              HasSubstr("of a view that begins at byte 2, "));
  EXPECT_THAT(error_of(read_changed({{"/accessors/3/byteOffset", 1}})),
              HasSubstr("its indices begin at byte 1 of a view that "));
  for (const int good : {12, 0}) {
    const Model model = model_of(read_changed({{"/bufferViews/2/byteStride", good}}));
    EXPECT_EQ(points_of(model.objects.at(0)), (Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})) << good;
  }
  EXPECT_TRUE(read_changed({{"/bufferViews/3/byteStride", 2}}).has_value());
  // Every second corner.
  AnimatedGltf file = indexed_gltf({0, 1, 0});
  file.root["bufferViews"][2]["byteStride"] = 24;
  file.root["accessors"][2]["count"] = 2;
  EXPECT_EQ(points_of(read_text(file.text()).objects.at(0)), (Points{{0, 0, 0}, {0, 1, 0}}));
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
    EXPECT_THAT(object.name, testing::Not(HasSubstr("nodes[")));
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
    EXPECT_THAT(object.name, testing::Not(HasSubstr("IfcMappedItem")));
    EXPECT_THAT(object.product, testing::StartsWith("Ifc")) << object.name;
    EXPECT_THAT(object.path, testing::StartsWith("Gel\u00e4nde"));
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
