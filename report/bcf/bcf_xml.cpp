// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/bcf/bcf_xml.hpp"

#include <fmt/format.h>

#include <array>
#include <set>
#include <sstream>

#include "report/bcf/snapshot.hpp"
#include "report/identity.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

void add_number(pugi::xml_node parent, const char* name, double value) {
  add_element(parent, name, fmt::format("{}", value + 0.0));  // -0 becomes 0
}

void add_vector(pugi::xml_node parent, const char* name, const Point& p) {
  pugi::xml_node vector = parent.append_child(name);
  add_number(vector, "X", p.x);
  add_number(vector, "Y", p.y);
  add_number(vector, "Z", p.z);
}

std::string guid_of_product(const Review& review, std::uint32_t object) {
  return std::string(ifc_guid(review.assembly.objects[object]));
}

/// A product by its GlobalId; anything else by its file and its name, which no other object of the file has.
void add_component(pugi::xml_node parent, const Review& review, std::uint32_t object) {
  pugi::xml_node component = parent.append_child("Component");
  if (const std::string guid = guid_of_product(review, object); !guid.empty()) {
    component.append_attribute("IfcGuid") = guid.c_str();
    return;
  }
  add_element(component, "OriginatingSystem", file_name_of(review, object));
  add_element(component, "AuthoringToolId", printable(review.assembly.objects[object].name));
}

void add_components(pugi::xml_node parent, const Review& review, const Clash& clash) {
  const std::array guids{guid_of_product(review, clash.objects[0]), guid_of_product(review, clash.objects[1])};
  const bool is_3_0 = review.options.bcf_version == BcfVersion::v3_0;
  std::vector<std::uint32_t> parts{clash.objects[0]};
  // Two parts of one product are one component.
  if (guids[1].empty() || guids[1] != guids[0]) parts.push_back(clash.objects[1]);

  pugi::xml_node components = parent.append_child("Components");
  pugi::xml_node selection = components.append_child("Selection");
  pugi::xml_node visibility = components.append_child("Visibility");
  pugi::xml_node colouring = components.append_child("Coloring");
  for (std::size_t i = 0; i < parts.size(); ++i) {
    add_component(selection, review, parts[i]);
    pugi::xml_node colour = colouring.append_child("Color");
    colour.append_attribute("Color") = fmt::format("{:06X}", kPartColours[i]).c_str();
    add_component(is_3_0 ? colour.append_child("Components") : colour, review, parts[i]);
  }
  // A viewer that finds neither part would show nothing if the others were hidden.
  const bool all_visible = guids[0].empty() || guids[1].empty();
  visibility.append_attribute("DefaultVisibility") = all_visible;
  if (all_visible) return;
  pugi::xml_node exceptions = visibility.append_child("Exceptions");
  for (const std::uint32_t object : parts) add_component(exceptions, review, object);
}

/// Whole lines as long as they are few enough: viewers make an object of each piece.
void add_lines(pugi::xml_node parent, const std::vector<std::vector<Point>>& lines, const Conventions& conventions) {
  constexpr std::size_t kMostPieces = 500;
  pugi::xml_node list;
  std::size_t pieces = 0;
  for (const auto& line : lines) {
    if (line.size() < 2 || pieces + line.size() - 1 > kMostPieces) continue;
    pieces += line.size() - 1;
    if (!list) list = parent.append_child("Lines");
    for (std::size_t i = 1; i < line.size(); ++i) {
      pugi::xml_node piece = list.append_child("Line");
      add_vector(piece, "StartPoint", place_in_bcf(conventions, line[i - 1]));
      add_vector(piece, "EndPoint", place_in_bcf(conventions, line[i]));
    }
  }
}

}  // namespace

pugi::xml_node begin_document(pugi::xml_document& document, const char* root) {
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  return document.append_child(root);
}

std::string text_of(const pugi::xml_document& document) {
  std::ostringstream text;
  document.save(text, "");
  return std::move(text).str();
}

void add_element(pugi::xml_node parent, const char* name, const std::string& text) {
  parent.append_child(name).text().set(text.c_str());
}

std::string version_document(BcfVersion version) {
  pugi::xml_document document;
  pugi::xml_node root = begin_document(document, "Version");
  root.append_attribute("VersionId") = version == BcfVersion::v3_0 ? "3.0" : "2.1";
  if (version == BcfVersion::v2_1) add_element(root, "DetailedVersion", "2.1");
  return text_of(document);
}

std::string extensions_document(const Review& review, const std::vector<std::size_t>& topics) {
  std::set<std::string> statuses, labels, users{printable(review.options.author)};
  if (!review.assembly.skipped.empty()) statuses.insert(kUndecided);
  for (const std::size_t pair : topics) {
    statuses.insert(status_of(review, pair));
    for (std::string& label : labels_of(review, pair)) labels.insert(std::move(label));
    if (const std::string& assignee = review.standings[pair].decision.assignee; !assignee.empty())
      users.insert(printable(assignee));
  }
  pugi::xml_document document;
  pugi::xml_node root = begin_document(document, "Extensions");
  const auto add = [&](const char* list, const char* name, const auto& words) {
    pugi::xml_node element = root.append_child(list);
    for (const auto& word : words) add_element(element, name, word);
  };
  add("TopicTypes", "TopicType", std::array{kTopicType});
  add("TopicStatuses", "TopicStatus", statuses);
  add("Priorities", "Priority", kPriorities);
  add("TopicLabels", "TopicLabel", labels);
  add("Users", "User", users);
  root.append_child("SnippetTypes");
  std::vector<std::string> stages;
  if (const std::string& stage = review.options.stage; !stage.empty()) stages.push_back(printable(stage));
  add("Stages", "Stage", stages);
  return text_of(document);
}

std::string guid_of_viewpoint(const std::string& pair) { return guid_of(pair + " viewpoint"); }

std::string file_name_of(const Review& review, std::uint32_t object) {
  return printable(review.file_names[review.assembly.file_of[object]]);
}

std::string viewpoint_of(const Review& review, std::size_t pair, const View& view,
                         const std::vector<std::vector<Point>>& lines, const Conventions& conventions) {
  pugi::xml_document document;
  pugi::xml_node info = begin_document(document, "VisualizationInfo");
  info.append_attribute("Guid") = guid_of_viewpoint(review.ids[pair]).c_str();
  add_components(info, review, review.clashes.pairs[pair]);
  pugi::xml_node camera = info.append_child("PerspectiveCamera");
  add_vector(camera, "CameraViewPoint", place_in_bcf(conventions, view.eye));
  add_vector(camera, "CameraDirection", direction_in_bcf(conventions, view.forward));
  add_vector(camera, "CameraUpVector", direction_in_bcf(conventions, view.up));
  add_number(camera, "FieldOfView", kFieldOfView);
  if (review.options.bcf_version == BcfVersion::v3_0)
    add_number(camera, "AspectRatio", static_cast<double>(kSnapshotWidth) / kSnapshotHeight);
  add_lines(info, lines, conventions);
  return text_of(document);
}

}  // namespace impinge::report
