// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/bcf_xml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "json_writer.hpp"
#include "report/identity.hpp"
#include "report/snapshot.hpp"
#include "text.hpp"

namespace impinge::cli {
namespace {

constexpr std::string_view kDeclaration = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
constexpr std::string_view kAuthor = "impinge";

std::string element(std::string_view name, std::string_view text) {
  return fmt::format("<{0}>{1}</{0}>\n", name, xml_text(text));
}

/// Names can be long; the JSON has them whole.
std::string short_name(const Assembly& assembly, std::uint32_t object) { return fit(assembly.labels[object], 100); }

std::string title_of(const Assembly& assembly, const Clash& clash) {
  const auto label = [&](int side) { return short_name(assembly, clash.objects[static_cast<std::size_t>(side)]); };
  if (clash.verdict == Verdict::inside && clash.inner >= 0)
    return fmt::format("{} inside {}", label(clash.inner), label(1 - clash.inner));
  const std::string pair = fmt::format("{} / {}", label(0), label(1));
  if (clash.verdict == Verdict::apart && clash.nearest)
    return fmt::format("{}: {:.4g} apart", pair, clash.nearest->distance);
  if (clash.overlap_depth && depth_of(clash) > 0)
    return fmt::format("{}: {}, {:.4g} deep", pair, name(clash.verdict), depth_of(clash));
  return fmt::format("{}: {}", pair, name(clash.verdict));
}

std::string_view priority(Verdict verdict) {
  switch (verdict) {
    case Verdict::duplicate:
    case Verdict::inside:
    case Verdict::penetrating:
    case Verdict::crossing:
      return "High";
    case Verdict::touching:
      return "Medium";
    case Verdict::apart:
      return "Low";
  }
  return "Medium";
}

const std::string& file_of(const Assembly& assembly, std::uint32_t object) {
  return assembly.files[assembly.file_of[object]];
}
std::string file_name(const Assembly& assembly, std::uint32_t object) {
  return printable(std::filesystem::path(file_of(assembly, object)).filename().string());
}

/// What is known of the pair, a line for each thing.
std::string description(const Assembly& assembly, const Clash& clash) {
  std::string text = fmt::format("Verdict: {}\n", name(clash.verdict));
  for (const std::size_t side : {0, 1}) {
    const std::uint32_t object = clash.objects[side];
    text +=
        fmt::format("{}: {} ({})\n", side == 0 ? "A" : "B", short_name(assembly, object), file_name(assembly, object));
  }
  const auto interval = [](const Interval& depth) { return fmt::format("{:.6g} to {:.6g}", depth.lo, depth.hi); };
  if (clash.overlap_depth)
    text += fmt::format("Depth: A in B {}; B in A {}\n", interval(clash.overlap_depth->a_in_b),
                        interval(clash.overlap_depth->b_in_a));
  if (clash.nearest) text += fmt::format("Distance: {:.6g}\n", clash.nearest->distance);
  constexpr std::size_t kMostRegions = 5;
  for (std::size_t i = 0; i < std::min(clash.regions.size(), kMostRegions); ++i) {
    const Region& region = clash.regions[i];
    text += fmt::format("Region {}: at ({:.6g} {:.6g} {:.6g}), area {:.6g}, length {:.6g}\n", i + 1, region.centroid.x,
                        region.centroid.y, region.centroid.z, region.area, region.length);
  }
  if (clash.regions.size() > kMostRegions)
    text += fmt::format("{} more\n", counted(clash.regions.size() - kMostRegions, "region"));
  if (clash.note != Note::none) text += fmt::format("Note: {}\n", sentence(clash.note));
  return text +
         "Lengths and places are in the unit and axes of the files as they were read; impinge info says where that "
         "changed them.";
}

std::string header(const Assembly& assembly, const Clash& clash) {
  std::string files;
  for (const std::uint32_t object : clash.objects) {
    if (object != clash.objects[0] && assembly.file_of[object] == assembly.file_of[clash.objects[0]]) continue;
    files += "<File isExternal=\"true\">\n" + element("Filename", file_name(assembly, object)) + "</File>\n";
  }
  return "<Header>\n" + files + "</Header>\n";
}

std::string guid_of_viewpoint(const std::string& id) { return guid_of(id + " viewpoint"); }

std::string vector(std::string_view name, const Point& p) {
  return fmt::format("<{0}>\n{1}{2}{3}</{0}>\n", name, element("X", json_number(p.x)), element("Y", json_number(p.y)),
                     element("Z", json_number(p.z)));
}

/// A product by its GlobalId; anything else by its file and its name, which no other object of the file has.
std::string component(const Assembly& assembly, std::uint32_t object) {
  const io::Object& about = assembly.objects[object];
  if (const std::string_view guid = ifc_guid(about); !guid.empty())
    return fmt::format("<Component IfcGuid=\"{}\"/>\n", guid);
  return "<Component>\n" + element("OriginatingSystem", file_name(assembly, object)) +
         element("AuthoringToolId", printable(about.name)) + "</Component>\n";
}

std::string components(const Assembly& assembly, const Clash& clash) {
  std::vector<std::string> parts{component(assembly, clash.objects[0])};
  // Two parts of one product are one component.
  if (std::string second = component(assembly, clash.objects[1]); second != parts[0])
    parts.push_back(std::move(second));
  std::string all, colours;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    all += parts[i];
    colours += fmt::format("<Color Color=\"{:06X}\">\n{}</Color>\n", kPartColours[i], parts[i]);
  }
  const bool known = std::all_of(clash.objects.begin(), clash.objects.end(),
                                 [&](std::uint32_t object) { return !ifc_guid(assembly.objects[object]).empty(); });
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
  return std::string(kDeclaration) + "<Version VersionId=\"2.1\">\n" + element("DetailedVersion", "2.1") +
         "</Version>\n";
}

std::string markup_of(const Review& review, const ClashArguments& arguments, std::size_t pair, std::size_t rank) {
  const Clash& clash = review.clashes.pairs[pair];
  const std::string& id = review.ids[pair];
  std::string text = std::string(kDeclaration) + "<Markup>\n" + header(review.assembly, clash);
  text += fmt::format("<Topic Guid=\"{}\" TopicType=\"Clash\" TopicStatus=\"Open\">\n", id);
  text += element("Title", title_of(review.assembly, clash));
  text += element("Priority", priority(clash.verdict));
  text += element("Index", fmt::format("{}", rank));
  text += element("Labels", name(clash.verdict));
  text += element("CreationDate", arguments.date);
  text += element("CreationAuthor", kAuthor);
  text += element("Description", description(review.assembly, clash));
  text += "</Topic>\n";
  text +=
      fmt::format("<Viewpoints Guid=\"{}\">\n{}{}{}</Viewpoints>\n", guid_of_viewpoint(id),
                  element("Viewpoint", "viewpoint.bcfv"), element("Snapshot", "snapshot.png"), element("Index", "0"));
  return text + "</Markup>\n";
}

std::string viewpoint_of(const Review& review, std::size_t pair, const View& view,
                         const std::vector<std::vector<Point>>& lines, const Conventions& conventions) {
  std::string text = std::string(kDeclaration) +
                     fmt::format("<VisualizationInfo Guid=\"{}\">\n", guid_of_viewpoint(review.ids[pair])) +
                     components(review.assembly, review.clashes.pairs[pair]) + "<PerspectiveCamera>\n" +
                     vector("CameraViewPoint", place_in_bcf(conventions, view.eye)) +
                     vector("CameraDirection", direction_in_bcf(conventions, view.forward)) +
                     vector("CameraUpVector", direction_in_bcf(conventions, view.up)) +
                     element("FieldOfView", json_number(kFieldOfView)) + "</PerspectiveCamera>\n";
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

}  // namespace impinge::cli
