// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// The published schemas of BCF 2.1 and 3.0 (buildingSMART/BCF-XML: version.xsd, extensions.xsd, markup.xsd,
// visinfo.xsd) are written down here.
#include "bcf_reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <sstream>

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

/// Words such as "Title:words Index:int? Label:string* @Guid:Guid": elements in their order and attributes, each with
/// its type, which is its name unless it is said; '?': at most one, '*': any number, '+': one or more.
Type type_of(const std::string& text) {
  Type type;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    Item item{"", "", 1, 1};
    if (word.ends_with('?') || word.ends_with('*')) item.least = 0;
    if (word.ends_with('*') || word.ends_with('+')) item.most = kAny;
    word.resize(word.find_last_not_of("?*+") + 1);
    const bool is_attribute = word.starts_with('@');
    const std::size_t colon = word.find(':');
    item.name = word.substr(is_attribute ? 1 : 0, colon - (is_attribute ? 1 : 0));
    item.type = colon == std::string::npos ? item.name : word.substr(colon + 1);
    (is_attribute ? type.attributes : type.sequence).push_back(item);
  }
  return type;
}

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

Types types_2() {
  Types types;
  for (const auto& [name, text] : std::map<std::string, std::string>{
           // version.xsd
           {"Version", "DetailedVersion:string? @VersionId:string?"},
           // markup.xsd
           {"Markup", "Header? Topic Comment* Viewpoints:ViewPoint*"},
           {"Header", "File+"},
           {"File",
            "Filename:string? Date:dateTime? Reference:string? @IfcProject:IfcGuid? "
            "@IfcSpatialStructureElement:IfcGuid? @isExternal:boolean?"},
           {"ViewPoint", "Viewpoint:string? Snapshot:string? Index:int? @Guid"},
           {"Topic",
            "ReferenceLink:string* Title:string Priority:string? Index:int? Labels:string* CreationDate:dateTime "
            "CreationAuthor:string ModifiedDate:dateTime? ModifiedAuthor:string? DueDate:dateTime? AssignedTo:string? "
            "Stage:string? Description:string? @Guid @TopicType:string? @TopicStatus:string?"},
           {"Comment",
            "Date:dateTime Author:string Comment:string Viewpoint:CommentViewpoint? ModifiedDate:dateTime? "
            "ModifiedAuthor:string? @Guid"},
           {"CommentViewpoint", "@Guid"},
           // visinfo.xsd
           {"VisualizationInfo", "Components? OrthogonalCamera? PerspectiveCamera? Lines? ClippingPlanes? @Guid"},
           {"PerspectiveCamera", "CameraViewPoint:Point CameraDirection:Point CameraUpVector:Point FieldOfView:double"},
           {"Point", "X:double Y:double Z:double"},
           {"Components", "ViewSetupHints? Selection:ComponentList? Visibility Coloring?"},
           {"ComponentList", "Component+"},
           {"Visibility", "Exceptions:ComponentList? @DefaultVisibility:boolean?"},
           {"Coloring", "Color:ColorElement+"},
           {"ColorElement", "Component+ @Color?"},
           {"Component", "OriginatingSystem:string? AuthoringToolId:string? @IfcGuid?"},
           {"Lines", "Line+"},
           {"Line", "StartPoint:Point EndPoint:Point"}})
    types[name] = type_of(text);
  return types;
}

/// What 3.0 has otherwise.
Types types_3() {
  Types types = types_2();
  for (const auto& [name, text] : std::map<std::string, std::string>{
           {"Version", "@VersionId:string"},
           {"Extensions", "TopicTypes TopicStatuses Priorities TopicLabels Users SnippetTypes Stages"},
           {"TopicTypes", "TopicType:words*"},
           {"TopicStatuses", "TopicStatus:words*"},
           {"Priorities", "Priority:words*"},
           {"TopicLabels", "TopicLabel:words*"},
           {"Users", "User:words*"},
           {"SnippetTypes", "SnippetType:words*"},
           {"Stages", "Stage:words*"},
           {"Markup", "Header? Topic"},
           {"Header", "Files?"},
           {"Files", "File*"},
           {"File",
            "Filename:words? Date:dateTime? Reference:words? @IfcProject:IfcGuid? "
            "@IfcSpatialStructureElement:IfcGuid? @IsExternal:boolean?"},
           {"Topic",
            "ReferenceLinks? Title:words Priority:words? Index:int? Labels? CreationDate:dateTime "
            "CreationAuthor:words ModifiedDate:dateTime? ModifiedAuthor:words? DueDate:dateTime? AssignedTo:words? "
            "Stage:words? Description:words? Comments? Viewpoints? @Guid @ServerAssignedId:words? @TopicType:words "
            "@TopicStatus:words"},
           {"Labels", "Label:words*"},
           {"Comments", "Comment*"},
           {"Viewpoints", "ViewPoint*"},
           {"Comment",
            "Date:dateTime Author:words Comment:words? Viewpoint:CommentViewpoint? ModifiedDate:dateTime? "
            "ModifiedAuthor:string? @Guid"},
           {"VisualizationInfo", "Components? PerspectiveCamera Lines? ClippingPlanes? @Guid"},
           {"PerspectiveCamera",
            "CameraViewPoint:Point CameraDirection:Point CameraUpVector:Point FieldOfView:double AspectRatio:double"},
           {"Components", "Selection:ComponentList? Visibility Coloring?"},
           {"ColorElement", "Components:ColorComponents @Color"},
           {"ColorComponents", "Component+"},
           {"Component", "OriginatingSystem:words? AuthoringToolId:words? @IfcGuid?"}})
    types[name] = type_of(text);
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

std::vector<std::string> texts(const pugi::xml_node& node, const char* name) {
  std::vector<std::string> found;
  for (const pugi::xml_node& child : node.children(name)) found.emplace_back(child.text().get());
  return found;
}

std::vector<Topic> read_bcf(const std::string& archive) {
  const std::vector<Member> members = unzip(archive);
  std::map<std::string, std::string> files;
  for (const Member& member : members) {
    EXPECT_TRUE(files.emplace(member.name, member.bytes).second) << member.name << " is there twice";
    EXPECT_EQ(member.date, "1980-01-01 00:00");
  }
  static const Types kTypes2 = types_2(), kTypes3 = types_3();
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
    if (topic.text("Index") == "0") {  // about files that were skipped
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
