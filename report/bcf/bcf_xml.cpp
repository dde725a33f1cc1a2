// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/bcf/bcf_xml.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/bcf/snapshot.hpp"
#include "report/identity.hpp"
#include "report/json_writer.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

std::string vector(std::string_view name, const Point& p) {
  return fmt::format("<{0}>\n{1}{2}{3}</{0}>\n", name, xml_element("X", json_number(p.x)),
                     xml_element("Y", json_number(p.y)), xml_element("Z", json_number(p.z)));
}

/// A product by its GlobalId; anything else by its file and its name, which no other object of the file has.
std::string component(const Review& review, std::uint32_t object) {
  const io::Object& about = review.assembly.objects[object];
  if (const std::string_view guid = ifc_guid(about); !guid.empty())
    return fmt::format("<Component IfcGuid=\"{}\"/>\n", guid);
  return "<Component>\n" + xml_element("OriginatingSystem", file_name_of(review, object)) +
         xml_element("AuthoringToolId", printable(about.name)) + "</Component>\n";
}

std::string components(const Review& review, const Clash& clash) {
  std::vector<std::string> parts{component(review, clash.objects[0])};
  // Two parts of one product are one component.
  if (std::string second = component(review, clash.objects[1]); second != parts[0]) parts.push_back(std::move(second));
  std::string all, colours;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    all += parts[i];
    colours += fmt::format("<Color Color=\"{:06X}\">\n{}</Color>\n", kPartColours[i], parts[i]);
  }
  const bool known = std::all_of(clash.objects.begin(), clash.objects.end(), [&](std::uint32_t object) {
    return !ifc_guid(review.assembly.objects[object]).empty();
  });
  // A viewer that finds neither part would show nothing if the others were hidden.
  const std::string visibility =
      known
          ? fmt::format("<Visibility DefaultVisibility=\"false\">\n<Exceptions>\n{}</Exceptions>\n</Visibility>\n", all)
          : "<Visibility DefaultVisibility=\"true\"/>\n";
  return fmt::format("<Components>\n<Selection>\n{}</Selection>\n{}<Coloring>\n{}</Coloring>\n</Components>\n", all,
                     visibility, colours);
}

/// Whole lines as long as they are few enough: viewers make an object of each piece.
std::string lines_element(const std::vector<std::vector<Point>>& lines, const Conventions& conventions) {
  constexpr std::size_t kMostPieces = 500;
  std::string text;
  std::size_t pieces = 0;
  for (const auto& line : lines) {
    if (line.size() < 2 || pieces + line.size() - 1 > kMostPieces) continue;
    pieces += line.size() - 1;
    for (std::size_t i = 1; i < line.size(); ++i)
      text += "<Line>\n" + vector("StartPoint", place_in_bcf(conventions, line[i - 1])) +
              vector("EndPoint", place_in_bcf(conventions, line[i])) + "</Line>\n";
  }
  return text.empty() ? text : "<Lines>\n" + text + "</Lines>\n";
}

}  // namespace

std::string version_document() {
  return std::string(kXmlDeclaration) + "<Version VersionId=\"2.1\">\n" + xml_element("DetailedVersion", "2.1") +
         "</Version>\n";
}

std::string guid_of_viewpoint(const std::string& pair) { return guid_of(pair + " viewpoint"); }

std::string file_name_of(const Review& review, std::uint32_t object) {
  return printable(review.file_names[review.assembly.file_of[object]]);
}

std::string xml_element(std::string_view name, std::string_view text) {
  return fmt::format("<{0}>{1}</{0}>\n", name, xml_text(text));
}

std::string viewpoint_of(const Review& review, std::size_t pair, const View& view,
                         const std::vector<std::vector<Point>>& lines, const Conventions& conventions) {
  std::string text = std::string(kXmlDeclaration) +
                     fmt::format("<VisualizationInfo Guid=\"{}\">\n", guid_of_viewpoint(review.ids[pair])) +
                     components(review, review.clashes.pairs[pair]) + "<PerspectiveCamera>\n" +
                     vector("CameraViewPoint", place_in_bcf(conventions, view.eye)) +
                     vector("CameraDirection", direction_in_bcf(conventions, view.forward)) +
                     vector("CameraUpVector", direction_in_bcf(conventions, view.up)) +
                     xml_element("FieldOfView", json_number(kFieldOfView)) + "</PerspectiveCamera>\n";
  return text + lines_element(lines, conventions) + "</VisualizationInfo>\n";
}

std::string xml_text(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const Character character = decode(text, at);
    const char32_t code = character.code;
    const bool allowed =
        character.valid && (code >= 0x20 || code == '\t' || code == '\n') && code != 0xFFFE && code != 0xFFFF;
    if (code == '&') {
      result += "&amp;";
    } else if (code == '<') {
      result += "&lt;";
    } else if (code == '>') {
      result += "&gt;";
    } else if (code == '"') {
      result += "&quot;";
    } else if (allowed) {
      result += text.substr(at, character.length);
    } else {
      result += "\xEF\xBF\xBD";
    }
    at += character.length;
  }
  return result;
}

}  // namespace impinge::report
