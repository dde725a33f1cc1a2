// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// `impinge clash --bcf`, read back by libzip and pugixml and held against the published schemas of BCF 2.1
// (buildingSMART/BCF-XML: version.xsd, markup.xsd, visinfo.xsd), which are written down here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <pugixml.hpp>
#include <regex>
#include <set>

#include "read_back.hpp"
#include "tests/cli/meshes.hpp"
#include "tests/cli/program.hpp"

namespace impinge::test {
namespace {

using nlohmann::json;
constexpr int kAny = 1'000'000;

/// An element of a sequence, in its place, or an attribute.
struct Item {
  std::string name, type;
  int least, most;
};
struct Type {
  std::vector<Item> sequence, attributes;
};

const std::map<std::string, std::string> kSimple{
    {"string", "[^]*"},
    {"int", "[+-]?[0-9]{1,9}"},
    {"double", "[+-]?([0-9]+(\\.[0-9]*)?|\\.[0-9]+)([eE][+-]?[0-9]+)?"},
    {"boolean", "true|false|0|1"},
    {"dateTime", "[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}(\\.[0-9]+)?(Z|[+-][0-9]{2}:[0-9]{2})?"},
    {"Guid", "[a-fA-F0-9]{8}-[a-fA-F0-9]{4}-[a-fA-F0-9]{4}-[a-fA-F0-9]{4}-[a-fA-F0-9]{12}"},
    {"IfcGuid", "[0-9A-Za-z_$]{22}"},
    {"Color", "[0-9a-fA-F]{6}([0-9a-fA-F]{2})?"},
    {"BitmapFormat", "PNG|JPG"}};

const std::map<std::string, Type> kTypes{
    // version.xsd
    {"Version", {{{"DetailedVersion", "string", 0, 1}}, {{"VersionId", "string", 0, 1}}}},
    // markup.xsd
    {"Markup",
     {{{"Header", "Header", 0, 1},
       {"Topic", "Topic", 1, 1},
       {"Comment", "Comment", 0, kAny},
       {"Viewpoints", "ViewPoint", 0, kAny}},
      {}}},
    {"Header", {{{"File", "File", 1, kAny}}, {}}},
    {"File",
     {{{"Filename", "string", 0, 1}, {"Date", "dateTime", 0, 1}, {"Reference", "string", 0, 1}},
      {{"IfcProject", "IfcGuid", 0, 1},
       {"IfcSpatialStructureElement", "IfcGuid", 0, 1},
       {"isExternal", "boolean", 0, 1}}}},
    {"ViewPoint",
     {{{"Viewpoint", "string", 0, 1}, {"Snapshot", "string", 0, 1}, {"Index", "int", 0, 1}}, {{"Guid", "Guid", 1, 1}}}},
    {"Topic",
     {{{"ReferenceLink", "string", 0, kAny},
       {"Title", "string", 1, 1},
       {"Priority", "string", 0, 1},
       {"Index", "int", 0, 1},
       {"Labels", "string", 0, kAny},
       {"CreationDate", "dateTime", 1, 1},
       {"CreationAuthor", "string", 1, 1},
       {"ModifiedDate", "dateTime", 0, 1},
       {"ModifiedAuthor", "string", 0, 1},
       {"DueDate", "dateTime", 0, 1},
       {"AssignedTo", "string", 0, 1},
       {"Stage", "string", 0, 1},
       {"Description", "string", 0, 1}},
      {{"Guid", "Guid", 1, 1}, {"TopicType", "string", 0, 1}, {"TopicStatus", "string", 0, 1}}}},
    {"Comment",
     {{{"Date", "dateTime", 1, 1},
       {"Author", "string", 1, 1},
       {"Comment", "string", 1, 1},
       {"ModifiedDate", "dateTime", 0, 1},
       {"ModifiedAuthor", "string", 0, 1}},
      {{"Guid", "Guid", 1, 1}}}},
    // visinfo.xsd
    {"VisualizationInfo",
     {{{"Components", "Components", 0, 1},
       {"OrthogonalCamera", "OrthogonalCamera", 0, 1},
       {"PerspectiveCamera", "PerspectiveCamera", 0, 1},
       {"Lines", "Lines", 0, 1},
       {"ClippingPlanes", "ClippingPlanes", 0, 1}},
      {{"Guid", "Guid", 1, 1}}}},
    {"PerspectiveCamera",
     {{{"CameraViewPoint", "Point", 1, 1},
       {"CameraDirection", "Point", 1, 1},
       {"CameraUpVector", "Point", 1, 1},
       {"FieldOfView", "double", 1, 1}},
      {}}},
    {"Point", {{{"X", "double", 1, 1}, {"Y", "double", 1, 1}, {"Z", "double", 1, 1}}, {}}},
    {"Components",
     {{{"ViewSetupHints", "ViewSetupHints", 0, 1},
       {"Selection", "ComponentList", 0, 1},
       {"Visibility", "Visibility", 1, 1},
       {"Coloring", "Coloring", 0, 1}},
      {}}},
    {"ComponentList", {{{"Component", "Component", 1, kAny}}, {}}},
    {"Visibility", {{{"Exceptions", "ComponentList", 0, 1}}, {{"DefaultVisibility", "boolean", 0, 1}}}},
    {"Coloring", {{{"Color", "ColorElement", 1, kAny}}, {}}},
    {"ColorElement", {{{"Component", "Component", 1, kAny}}, {{"Color", "Color", 0, 1}}}},
    {"Component",
     {{{"OriginatingSystem", "string", 0, 1}, {"AuthoringToolId", "string", 0, 1}}, {{"IfcGuid", "IfcGuid", 0, 1}}}},
    {"Lines", {{{"Line", "Line", 1, kAny}}, {}}},
    {"Line", {{{"StartPoint", "Point", 1, 1}, {"EndPoint", "Point", 1, 1}}, {}}}};

void check(const pugi::xml_node& node, const std::string& type_name);

void check_text(const std::string& text, const std::string& type, const std::string& where) {
  EXPECT_TRUE(std::regex_match(text, std::regex(kSimple.at(type)))) << where << " is no " << type << ": " << text;
}

void check_attributes(const pugi::xml_node& node, const std::vector<Item>& allowed) {
  for (const pugi::xml_attribute& attribute : node.attributes()) {
    const auto item = std::find_if(allowed.begin(), allowed.end(),
                                   [&](const Item& i) { return i.name == std::string(attribute.name()); });
    if (item == allowed.end()) {
      ADD_FAILURE() << node.name() << " has an attribute " << attribute.name();
    } else {
      check_text(attribute.value(), item->type, node.path() + "/@" + attribute.name());
    }
  }
  for (const Item& item : allowed)
    EXPECT_TRUE(item.least == 0 || node.attribute(item.name.c_str())) << node.path() << " lacks " << item.name;
}

/// Holds an element against its type: which elements it has, in which order and how many of each.
void check(const pugi::xml_node& node, const std::string& type_name) {
  const auto type = kTypes.find(type_name);
  if (type == kTypes.end()) {
    EXPECT_FALSE(node.first_attribute()) << node.path();
    for (const pugi::xml_node& child : node) EXPECT_EQ(child.type(), pugi::node_pcdata) << node.path();
    return check_text(node.text().get(), type_name, node.path());
  }
  check_attributes(node, type->second.attributes);
  pugi::xml_node child = node.first_child();
  for (const Item& item : type->second.sequence) {
    int count = 0;
    for (; child && child.name() == item.name; child = child.next_sibling(), ++count) check(child, item.type);
    EXPECT_TRUE(count >= item.least && count <= item.most) << node.path() << " has " << count << " of " << item.name;
  }
  EXPECT_FALSE(child) << node.path() << ": " << child.name() << " is out of its place";
}

pugi::xml_document parse(const std::string& bytes, const std::string& root) {
  pugi::xml_document document;
  const auto result = document.load_buffer(bytes.data(), bytes.size(), pugi::parse_full, pugi::encoding_utf8);
  EXPECT_TRUE(result) << result.description();
  const pugi::xml_node declaration = document.first_child();
  EXPECT_EQ(declaration.type(), pugi::node_declaration);
  EXPECT_EQ(std::string(declaration.attribute("encoding").value()), "UTF-8");
  const pugi::xml_node element = document.document_element();
  EXPECT_EQ(element.name(), root);
  EXPECT_FALSE(element.next_sibling());
  check(element, root);
  return document;
}

struct Vec {
  double x, y, z;
};
double dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec vec(const pugi::xml_node& node) {
  return {node.child("X").text().as_double(), node.child("Y").text().as_double(), node.child("Z").text().as_double()};
}

struct Topic {
  std::string guid;
  pugi::xml_document markup, viewpoint;
  Pixels snapshot;
  [[nodiscard]] pugi::xml_node topic() const { return markup.document_element().child("Topic"); }
  [[nodiscard]] pugi::xml_node view() const { return viewpoint.document_element(); }
};

/// The topics by their index, held against the schemas and each other.
std::vector<Topic> read_bcf(const std::string& archive) {
  const std::vector<Member> members = unzip(archive);
  std::map<std::string, std::string> files;
  for (const Member& member : members) {
    EXPECT_TRUE(files.emplace(member.name, member.bytes).second) << member.name << " is there twice";
    EXPECT_EQ(member.date, "1980-01-01 00:00");
  }
  EXPECT_EQ(std::string(parse(files.at("bcf.version"), "Version").document_element().attribute("VersionId").value()),
            "2.1");
  std::vector<Topic> topics;
  for (const auto& [name, bytes] : files) {
    if (!name.ends_with("/markup.bcf")) continue;
    Topic topic;
    topic.guid = name.substr(0, name.find('/'));
    topic.markup = parse(bytes, "Markup");
    EXPECT_EQ(std::string(topic.topic().attribute("Guid").value()), topic.guid);
    const pugi::xml_node about = topic.markup.document_element().child("Viewpoints");
    topic.viewpoint = parse(files.at(topic.guid + "/" + about.child("Viewpoint").text().get()), "VisualizationInfo");
    EXPECT_EQ(std::string(about.attribute("Guid").value()), topic.view().attribute("Guid").value());
    topic.snapshot = read_png(files.at(topic.guid + "/" + about.child("Snapshot").text().get()));
    topics.push_back(std::move(topic));
  }
  EXPECT_EQ(files.size(), 1 + 3 * topics.size());
  std::sort(topics.begin(), topics.end(), [](const Topic& a, const Topic& b) {
    return a.topic().child("Index").text().as_int() < b.topic().child("Index").text().as_int();
  });
  for (std::size_t i = 0; i < topics.size(); ++i) EXPECT_EQ(topics[i].topic().child("Index").text().as_uint(), i + 1);
  return topics;
}

/// Whether a point in the BCF's coordinates is in the picture.
void expect_seen(const Topic& topic, const Vec& p) {
  const pugi::xml_node camera = topic.view().child("PerspectiveCamera");
  const Vec eye = vec(camera.child("CameraViewPoint")), forward = vec(camera.child("CameraDirection"));
  const Vec up = vec(camera.child("CameraUpVector"));
  EXPECT_NEAR(dot(forward, forward), 1, 1e-9);
  EXPECT_NEAR(dot(up, up), 1, 1e-9);
  EXPECT_NEAR(dot(forward, up), 0, 1e-9);
  EXPECT_GT(up.z, 0) << "Z is up in BCF";
  const double angle = camera.child("FieldOfView").text().as_double();
  EXPECT_GE(angle, 45);
  EXPECT_LE(angle, 60);
  const Vec way{p.x - eye.x, p.y - eye.y, p.z - eye.z};
  const double cosine = dot(way, forward) / std::sqrt(dot(way, way));
  EXPECT_GT(cosine, std::cos(angle / 2 * std::numbers::pi / 180)) << topic.topic().child("Title").text().get();
}

/// How many pixels are nearest to blue, orange and red.
std::array<std::size_t, 3> colours(const Pixels& pixels) {
  std::array<std::size_t, 3> count{};
  for (std::size_t i = 0; i < pixels.rgb.size(); i += 3) {
    const int r = pixels.rgb[i], g = pixels.rgb[i + 1], b = pixels.rgb[i + 2];
    count[0] += b > r + 30 ? 1 : 0;
    count[1] += r > b + 30 && g > b + 15 ? 1 : 0;
    count[2] += r > g + 60 && b > g ? 1 : 0;
  }
  return count;
}

/// How many pixels are not of the background, which is that of a corner.
std::size_t drawn(const Pixels& pixels) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < pixels.rgb.size(); i += 3)
    count += std::equal(pixels.rgb.begin(), pixels.rgb.begin() + 3, pixels.rgb.begin() + static_cast<std::ptrdiff_t>(i))
                 ? 0
                 : 1;
  return count;
}

/// One pair of each verdict, far from the others.
class Bcf : public testing::Test {
 protected:
  void SetUp() override {
    write("a", box({0, 0, 0}, {2, 2, 2})), write("b", box({1, 1, 1}, {3, 3, 3}));
    write("c", box({3, 1, 1}, {5, 3, 3}));  // touches b
    write("big", box({20, 0, 0}, {26, 6, 6})), write("small", box({22, 2, 2}, {24, 4, 4}));
    write("d", box({40, 0, 0}, {42, 2, 2})), write("d2", box({40, 0, 0}, {42, 2, 2}));
    write("e", box({60, 0, 0}, {62, 2, 2})), write("sheet", sheet({59, -1}, {63, 3}, 1));
    write("f", box({80, 0, 0}, {82, 2, 2})), write("g", box({85, 4, 0}, {87, 6, 2}));  // 3.6 apart
  }
  void write(const std::string& name, const Solid& solid) {
    folder.write(name + ".off", off(solid));
    files.push_back(name + ".off");
  }
  [[nodiscard]] Ended clash(const std::vector<std::string>& more, const Launch& launch = {}) const {
    std::vector<std::string> words{"clash", "--bcf", "out.bcf", "--quiet"};
    words.insert(words.end(), files.begin(), files.end());
    words.insert(words.end(), more.begin(), more.end());
    return impinge(folder, words, launch);
  }
  [[nodiscard]] std::vector<Topic> topics() const { return read_bcf(folder.read("out.bcf")); }
  Folder folder;
  std::vector<std::string> files;
};

TEST_F(Bcf, HasATopicForEachPairThatFails) {
  EXPECT_EQ(clash({"--json", "out.json"}).code, 1);
  const json answer = json::parse(folder.read("out.json"));
  std::set<std::string> failing, found;
  for (const json& pair : answer.at("pairs"))
    if (pair.at("fails")) failing.insert(pair.at("id").get<std::string>());
  std::vector<std::string> titles;
  for (const Topic& topic : topics()) {
    found.insert(topic.guid);
    titles.emplace_back(topic.topic().child("Title").text().get());
    EXPECT_EQ(std::string(topic.topic().attribute("TopicType").value()), "Clash");
    EXPECT_EQ(std::string(topic.topic().child("Priority").text().get()), "High");
    EXPECT_EQ(std::string(topic.topic().child("CreationDate").text().get()), "1970-01-01T00:00:00Z");
  }
  EXPECT_EQ(found, failing);
  ASSERT_EQ(titles.size(), 4U);
  EXPECT_TRUE(titles[0].starts_with("d / d2: duplicate")) << titles[0];
  EXPECT_EQ(titles[1], "small inside big");
  EXPECT_TRUE(titles[2].starts_with("a / b: penetrating, 1")) << titles[2];
  EXPECT_EQ(titles[3], "e / sheet: crossing");
}

TEST_F(Bcf, CameraSeesTheClashAndThePictureShowsIt) {
  EXPECT_EQ(clash({"--fail-on", "contact,clearance", "--clearance", "3.7"}).code, 1);
  const std::vector<Topic> all = topics();
  ASSERT_EQ(all.size(), 7U);  // a and c are 1 apart
  const std::map<std::string, Vec> places{{"d /", {41, 1, 1}},  {"small", {23, 3, 3}}, {"a / b", {1.5, 1.5, 1.5}},
                                          {"e /", {61, 1, 1}},  {"b /", {3, 2, 2}},    {"a / c", {2.5, 1.5, 1.5}},
                                          {"f /", {83.5, 3, 1}}};
  for (const Topic& topic : all) {
    const std::string title = topic.topic().child("Title").text().get();
    const auto place =
        std::find_if(places.begin(), places.end(), [&](const auto& p) { return title.starts_with(p.first); });
    ASSERT_NE(place, places.end()) << title;
    expect_seen(topic, place->second);
    EXPECT_EQ(topic.snapshot.width, 640U);
    EXPECT_EQ(topic.snapshot.height, 480U);
    const auto [blue, orange, red] = colours(topic.snapshot);
    EXPECT_GT(drawn(topic.snapshot), 10'000U) << title;
    if (title.starts_with("d /")) continue;  // both colours in one, and no line of contact that ends
    EXPECT_GT(blue, 1000U) << title;
    EXPECT_GT(orange, 1000U) << title;
    EXPECT_GT(red, 50U) << title;
  }
}

TEST_F(Bcf, SelectsBothPartsByFileAndName) {
  EXPECT_EQ(clash({}).code, 1);
  const Topic topic = std::move(topics().at(2));
  const auto names = [&](const pugi::xml_node& list) {
    std::vector<std::string> found;
    for (const pugi::xml_node& component : list.children("Component"))
      found.push_back(std::string(component.child("OriginatingSystem").text().get()) + ":" +
                      component.child("AuthoringToolId").text().get());
    return found;
  };
  const pugi::xml_node components = topic.view().child("Components");
  EXPECT_EQ(names(components.child("Selection")), (std::vector<std::string>{"a.off:a", "b.off:b"}));
  // No viewer is asked to hide all but what it may not find.
  EXPECT_TRUE(components.child("Visibility").attribute("DefaultVisibility").as_bool());
  EXPECT_FALSE(components.child("Visibility").child("Exceptions"));
  std::set<std::string> colours_used;
  for (const pugi::xml_node& colour : components.child("Coloring")) {
    EXPECT_EQ(names(colour).size(), 1U);
    colours_used.insert(colour.attribute("Color").value());
  }
  EXPECT_EQ(colours_used.size(), 2U);
  const std::string figures = topic.topic().child("Description").text().get();
  for (const char* word : {"penetrating", "a (a.off)", "b (b.off)", "Depth", "Region 1"})
    EXPECT_NE(figures.find(word), std::string::npos) << figures;
}

TEST_F(Bcf, UnitsAndAxesAreTheStandards) {
  const auto eye = [&](const std::vector<std::string>& more) {
    EXPECT_EQ(clash(more).code, 1);
    const std::vector<Topic> all = topics();
    return std::pair{vec(all[2].view().child("PerspectiveCamera").child("CameraViewPoint")),
                     vec(all[2].view().child("Lines").child("Line").child("StartPoint"))};
  };
  const auto [m, line] = eye({});
  const auto [mm, line_mm] = eye({"--unit", "mm"});
  EXPECT_DOUBLE_EQ(mm.x, 0.001 * m.x);
  EXPECT_DOUBLE_EQ(mm.z, 0.001 * m.z);
  EXPECT_DOUBLE_EQ(line_mm.y, 0.001 * line.y);
  const auto [in, line_in] = eye({"--unit", "in", "--up", "z"});
  EXPECT_DOUBLE_EQ(in.y, 0.0254 * m.y);
  // With Y up in the files, what is (x, y, z) there is (x, -z, y) in BCF.
  eye({"--up", "y"});
  const std::vector<Topic> turned = topics();
  expect_seen(turned[2], {1.5, -1.5, 1.5});
  expect_seen(turned[1], {23, -3, 3});
}

TEST_F(Bcf, DateIsAskedForOrFixed) {
  const auto date = [&](const std::vector<std::string>& more, const Launch& launch = {}) {
    EXPECT_EQ(clash(more, launch).code, 1);
    return std::string(topics().front().topic().child("CreationDate").text().get());
  };
  EXPECT_EQ(date({"--date", "2024-05-31"}), "2024-05-31T00:00:00Z");
  Launch launch;
  launch.environment["SOURCE_DATE_EPOCH"] = "1000000000";
  EXPECT_EQ(date({}, launch), "2001-09-09T01:46:40Z");
  EXPECT_EQ(date({"--date", "2024-05-31T01:02:03Z"}, launch), "2024-05-31T01:02:03Z");
  EXPECT_GT(date({"--date", "now"}), "2024");
  launch.environment["SOURCE_DATE_EPOCH"] = "soon";
  const Ended wrong = clash({}, launch);
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("SOURCE_DATE_EPOCH"), std::string::npos) << wrong.err;
}

TEST_F(Bcf, LimitKeepsTheWorstAndSaysSo) {
  std::vector<std::string> words{"clash", "--bcf", "out.bcf", "--bcf-topics", "2"};
  words.insert(words.end(), files.begin(), files.end());
  const Ended run = impinge(folder, words);
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.err, "impinge: the BCF has the 2 worst of 4 pairs that fail, by --bcf-topics\n");
  const std::vector<Topic> all = topics();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_TRUE(std::string(all[0].topic().child("Title").text().get()).starts_with("d / d2"));
  EXPECT_EQ(clash({"--bcf-topics", "0"}).code, 1);
  EXPECT_TRUE(topics().empty());
}

TEST_F(Bcf, NothingFailingIsAnArchiveWithoutTopics) {
  EXPECT_EQ(impinge(folder, {"clash", "a.off", "g.off", "--bcf", "out.bcf", "--quiet"}).code, 0);
  EXPECT_TRUE(topics().empty());
}

TEST_F(Bcf, AnyNameIsHarmless) {
  const std::string nasty = "<Title><x a=\"&amp;\x1b[2J\n\xff\xEF\xBF\xBE\xE2\x80\xAE" + std::string(150, 'n');
  folder.write(nasty + ".off", off(box({1, 1, 1}, {3, 3, 3})));
  EXPECT_EQ(impinge(folder, {"clash", "a.off", nasty + ".off", "--bcf", "out.bcf", "--quiet"}).code, 1);
  const std::vector<Topic> all = topics();
  ASSERT_EQ(all.size(), 1U);
  const std::string title = all[0].topic().child("Title").text().get();
  EXPECT_TRUE(title.starts_with("a / <Title><x a=\"&amp;\\x1b[2J\\n")) << title;
  EXPECT_LT(title.size(), 300U);
}

/// Two extruded boxes of an IFC file in millimetres: 2 m wide, the second 1 m over in each direction.
std::string ifc_of_two_walls() {
  return R"(ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('two.ifc','2024-01-01T00:00:00',(''),(''),'','','');
FILE_SCHEMA(('IFC2X3'));
ENDSEC;
DATA;
#1=IFCPROJECT('0YvctVUKr0kugbFTf53O9L',#2,'p',$,$,$,$,(#10),#20);
#2=IFCOWNERHISTORY(#3,#6,$,.ADDED.,$,$,$,0);
#3=IFCPERSONANDORGANIZATION(#4,#5,$);
#4=IFCPERSON($,'n',$,$,$,$,$,$);
#5=IFCORGANIZATION($,'o',$,$,$);
#6=IFCAPPLICATION(#5,'1','a','a');
#10=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,#11,$);
#11=IFCAXIS2PLACEMENT3D(#12,$,$);
#12=IFCCARTESIANPOINT((0.,0.,0.));
#20=IFCUNITASSIGNMENT((#21));
#21=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);
#30=IFCSITE('1Qvf0xqDT4HXo8jI81mHB$',#2,'site',$,$,#31,$,$,.ELEMENT.,$,$,$,$,$);
#31=IFCLOCALPLACEMENT($,#11);
#40=IFCRELAGGREGATES('2Qvf0xqDT4HXo8jI81mHB$',#2,$,$,#1,(#30));
#41=IFCRELCONTAINEDINSPATIALSTRUCTURE('3Qvf0xqDT4HXo8jI81mHB$',#2,$,$,(#50,#60),#30);
#50=IFCBUILDINGELEMENTPROXY('1srAI$R4T8ihLXSNHmUSET',#2,'left',$,$,#51,#52,$,$);
#51=IFCLOCALPLACEMENT(#31,#56);
#52=IFCPRODUCTDEFINITIONSHAPE($,$,(#53));
#53=IFCSHAPEREPRESENTATION(#10,'Body','SweptSolid',(#54));
#54=IFCEXTRUDEDAREASOLID(#55,#11,#58,2000.);
#55=IFCRECTANGLEPROFILEDEF(.AREA.,$,#59,2000.,2000.);
#56=IFCAXIS2PLACEMENT3D(#57,$,$);
#57=IFCCARTESIANPOINT((5000.,3000.,0.));
#58=IFCDIRECTION((0.,0.,1.));
#59=IFCAXIS2PLACEMENT2D(#70,$);
#70=IFCCARTESIANPOINT((0.,0.));
#60=IFCBUILDINGELEMENTPROXY('2O2Fr$t4X7Zf8NOew3FNr2',#2,'right',$,$,#61,#62,$,$);
#61=IFCLOCALPLACEMENT(#31,#66);
#62=IFCPRODUCTDEFINITIONSHAPE($,$,(#63));
#63=IFCSHAPEREPRESENTATION(#10,'Body','SweptSolid',(#64));
#64=IFCEXTRUDEDAREASOLID(#55,#11,#58,2000.);
#66=IFCAXIS2PLACEMENT3D(#67,$,$);
#67=IFCCARTESIANPOINT((6000.,4000.,1000.));
ENDSEC;
END-ISO-10303-21;
)";
}

TEST_F(Bcf, OfAnIfcFileNamesGlobalIdsAndTheFilesOwnAxes) {
  folder.write("two.ifc", ifc_of_two_walls());
  const Ended run = impinge(folder, {"clash", "two.ifc", "--bcf", "out.bcf", "--quiet"});
  ASSERT_EQ(run.code, 1) << run.err;
  const std::vector<Topic> all = topics();
  ASSERT_EQ(all.size(), 1U);
  const pugi::xml_node components = all[0].view().child("Components");
  const auto guids = [](const pugi::xml_node& list) {
    std::vector<std::string> found;
    for (const pugi::xml_node& component : list.children("Component"))
      found.emplace_back(component.attribute("IfcGuid").value());
    return found;
  };
  const std::vector<std::string> both{"1srAI$R4T8ihLXSNHmUSET", "2O2Fr$t4X7Zf8NOew3FNr2"};
  EXPECT_EQ(guids(components.child("Selection")), both);
  EXPECT_FALSE(components.child("Visibility").attribute("DefaultVisibility").as_bool(true));
  EXPECT_EQ(guids(components.child("Visibility").child("Exceptions")), both);
  // The boxes share (5, 3, 1) to (6, 4, 2): in metres with Z up, as in the file.
  expect_seen(all[0], {5.5, 3.5, 1.5});
  for (const pugi::xml_node& line : all[0].view().child("Lines")) {
    const Vec p = vec(line.child("StartPoint"));
    EXPECT_TRUE(p.x >= 4.999 && p.x <= 6.001 && p.y >= 2.999 && p.y <= 4.001 && p.z >= 0.999 && p.z <= 2.001);
  }
}

}  // namespace
}  // namespace impinge::test
