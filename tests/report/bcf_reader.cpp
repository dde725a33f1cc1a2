// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// The published schemas of BCF 2.1 (buildingSMART/BCF-XML: version.xsd, markup.xsd, visinfo.xsd) are written down here.
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

}  // namespace impinge::test
