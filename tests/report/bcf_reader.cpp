// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// The published schemas of BCF 2.1 and 3.0 (buildingSMART/BCF-XML: version.xsd, extensions.xsd, markup.xsd,
// visinfo.xsd) are written down here.
#include "bcf_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>

namespace impinge::test {
namespace {

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
    {"words", "[^]*[^ \\t\\r\\n][^]*"},  // NonEmptyOrBlankString
    {"int", "[+-]?[0-9]{1,9}"},
    {"double", "[+-]?([0-9]+(\\.[0-9]*)?|\\.[0-9]+)([eE][+-]?[0-9]+)?"},
    {"boolean", "true|false|0|1"},
    {"dateTime", "[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}(\\.[0-9]+)?(Z|[+-][0-9]{2}:[0-9]{2})?"},
    {"Guid", "[a-fA-F0-9]{8}-[a-fA-F0-9]{4}-[a-fA-F0-9]{4}-[a-fA-F0-9]{4}-[a-fA-F0-9]{12}"},
    {"IfcGuid", "[0-9A-Za-z_$]{22}"},
    {"Color", "[0-9a-fA-F]{6}([0-9a-fA-F]{2})?"},
    {"BitmapFormat", "PNG|JPG"}};

using Types = std::map<std::string, Type>;

const Types kTypes2{
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
       {"Viewpoint", "CommentViewpoint", 0, 1},
       {"ModifiedDate", "dateTime", 0, 1},
       {"ModifiedAuthor", "string", 0, 1}},
      {{"Guid", "Guid", 1, 1}}}},
    {"CommentViewpoint", {{}, {{"Guid", "Guid", 1, 1}}}},
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

/// What 3.0 has otherwise.
Types types_3() {
  Types types = kTypes2;
  const auto list = [&](const std::string& name, const std::string& item, const std::string& type, int least = 0) {
    types[name] = {{{item, type, least, kAny}}, {}};
  };
  types["Version"] = {{}, {{"VersionId", "string", 1, 1}}};
  const std::vector<std::pair<std::string, std::string>> extensions{
      {"TopicTypes", "TopicType"}, {"TopicStatuses", "TopicStatus"},
      {"Priorities", "Priority"},  {"TopicLabels", "TopicLabel"},
      {"Users", "User"},           {"SnippetTypes", "SnippetType"},
      {"Stages", "Stage"}};
  for (const auto& [name, item] : extensions) {
    types["Extensions"].sequence.push_back({name, name, 1, 1});
    list(name, item, "words");
  }
  types["Markup"] = {{{"Header", "Header", 0, 1}, {"Topic", "Topic", 1, 1}}, {}};
  types["Header"] = {{{"Files", "Files", 0, 1}}, {}};
  list("Files", "File", "File");
  types["File"] = {{{"Filename", "words", 0, 1}, {"Date", "dateTime", 0, 1}, {"Reference", "words", 0, 1}},
                   {{"IfcProject", "IfcGuid", 0, 1},
                    {"IfcSpatialStructureElement", "IfcGuid", 0, 1},
                    {"IsExternal", "boolean", 0, 1}}};
  types["Topic"] = {{{"ReferenceLinks", "ReferenceLinks", 0, 1},
                     {"Title", "words", 1, 1},
                     {"Priority", "words", 0, 1},
                     {"Index", "int", 0, 1},
                     {"Labels", "Labels", 0, 1},
                     {"CreationDate", "dateTime", 1, 1},
                     {"CreationAuthor", "words", 1, 1},
                     {"ModifiedDate", "dateTime", 0, 1},
                     {"ModifiedAuthor", "words", 0, 1},
                     {"DueDate", "dateTime", 0, 1},
                     {"AssignedTo", "words", 0, 1},
                     {"Stage", "words", 0, 1},
                     {"Description", "words", 0, 1},
                     {"Comments", "Comments", 0, 1},
                     {"Viewpoints", "Viewpoints", 0, 1}},
                    {{"Guid", "Guid", 1, 1},
                     {"ServerAssignedId", "words", 0, 1},
                     {"TopicType", "words", 1, 1},
                     {"TopicStatus", "words", 1, 1}}};
  list("Labels", "Label", "words");
  list("Comments", "Comment", "Comment");
  list("Viewpoints", "ViewPoint", "ViewPoint");
  types["Comment"].sequence[1].type = "words";
  types["Comment"].sequence[2] = {"Comment", "words", 0, 1};
  types["VisualizationInfo"].sequence = {{"Components", "Components", 0, 1},
                                         {"PerspectiveCamera", "PerspectiveCamera", 1, 1},
                                         {"Lines", "Lines", 0, 1},
                                         {"ClippingPlanes", "ClippingPlanes", 0, 1}};
  types["PerspectiveCamera"].sequence.push_back({"AspectRatio", "double", 1, 1});
  types["Components"].sequence.erase(types["Components"].sequence.begin());
  types["ColorElement"] = {{{"Components", "ColorComponents", 1, 1}}, {{"Color", "Color", 1, 1}}};
  list("ColorComponents", "Component", "Component", 1);
  types["Component"].sequence[0].type = types["Component"].sequence[1].type = "words";
  return types;
}

void check(const pugi::xml_node& node, const std::string& type_name, const Types& types);

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
void check(const pugi::xml_node& node, const std::string& type_name, const Types& types) {
  const auto type = types.find(type_name);
  if (type == types.end()) {
    EXPECT_FALSE(node.first_attribute()) << node.path();
    for (const pugi::xml_node& child : node) EXPECT_EQ(child.type(), pugi::node_pcdata) << node.path();
    return check_text(node.text().get(), type_name, node.path());
  }
  check_attributes(node, type->second.attributes);
  pugi::xml_node child = node.first_child();
  for (const Item& item : type->second.sequence) {
    int count = 0;
    for (; child && child.name() == item.name; child = child.next_sibling(), ++count) check(child, item.type, types);
    EXPECT_TRUE(count >= item.least && count <= item.most) << node.path() << " has " << count << " of " << item.name;
  }
  EXPECT_FALSE(child) << node.path() << ": " << child.name() << " is out of its place";
}

pugi::xml_document parse(const std::string& bytes, const std::string& root, const Types& types) {
  pugi::xml_document document;
  const auto result = document.load_buffer(bytes.data(), bytes.size(), pugi::parse_full, pugi::encoding_utf8);
  EXPECT_TRUE(result) << result.description();
  const pugi::xml_node declaration = document.first_child();
  EXPECT_EQ(declaration.type(), pugi::node_declaration);
  EXPECT_EQ(std::string(declaration.attribute("encoding").value()), "UTF-8");
  const pugi::xml_node element = document.document_element();
  EXPECT_EQ(element.name(), root);
  EXPECT_FALSE(element.next_sibling());
  check(element, root, types);
  return document;
}

}  // namespace

Vec vec(const pugi::xml_node& node) {
  return {node.child("X").text().as_double(), node.child("Y").text().as_double(), node.child("Z").text().as_double()};
}

std::vector<Topic> read_bcf(const std::string& archive) {
  const std::vector<Member> members = unzip(archive);
  std::map<std::string, std::string> files;
  for (const Member& member : members) {
    EXPECT_TRUE(files.emplace(member.name, member.bytes).second) << member.name << " is there twice";
    EXPECT_EQ(member.date, "1980-01-01 00:00");
  }
  static const Types kTypes3 = types_3();
  const bool is_3 = files.at("bcf.version").find("VersionId=\"3.0\"") != std::string::npos;
  const Types& types = is_3 ? kTypes3 : kTypes2;
  const pugi::xml_document version = parse(files.at("bcf.version"), "Version", types);
  EXPECT_EQ(std::string(version.document_element().attribute("VersionId").value()), is_3 ? "3.0" : "2.1");
  if (is_3) parse(files.at("extensions.xml"), "Extensions", types);
  std::vector<Topic> topics;
  std::size_t about_files = 0;
  for (const auto& [name, bytes] : files) {
    if (!name.ends_with("/markup.bcf")) continue;
    Topic topic;
    topic.guid = name.substr(0, name.find('/'));
    topic.markup = parse(bytes, "Markup", types);
    EXPECT_EQ(std::string(topic.topic().attribute("Guid").value()), topic.guid);
    const pugi::xml_node about = is_3 ? topic.topic().child("Viewpoints").child("ViewPoint")
                                      : topic.markup.document_element().child("Viewpoints");
    if (std::string(topic.topic().child("Index").text().get()) == "0") {  // about files that were skipped
      ++about_files;
      continue;
    }
    topic.viewpoint =
        parse(files.at(topic.guid + "/" + about.child("Viewpoint").text().get()), "VisualizationInfo", types);
    EXPECT_EQ(std::string(about.attribute("Guid").value()), topic.view().attribute("Guid").value());
    topic.snapshot = read_png(files.at(topic.guid + "/" + about.child("Snapshot").text().get()));
    topics.push_back(std::move(topic));
  }
  EXPECT_EQ(files.size(), (is_3 ? 2 : 1) + about_files + 3 * topics.size());
  std::sort(topics.begin(), topics.end(), [](const Topic& a, const Topic& b) {
    return a.topic().child("Index").text().as_int() < b.topic().child("Index").text().as_int();
  });
  for (std::size_t i = 0; i < topics.size(); ++i) EXPECT_EQ(topics[i].topic().child("Index").text().as_uint(), i + 1);
  return topics;
}

}  // namespace impinge::test
