// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "report/bcf/bcf_xml.hpp"
#include "report/identity.hpp"
#include "report/text.hpp"
#include "report/units.hpp"

namespace impinge::report {
namespace {

/// Texts on one line can be long; the JSON has them whole.
std::string in_short(std::string_view text) { return fit(printable(text), 100); }

/// A topic that is being written.
struct Topic {
  const Review& review;
  const Clash& clash;
  const Standing& standing;
  const std::string& id;
  const std::string& axes;
  const std::string& date;
  std::string author;
  Conventions conventions;

  [[nodiscard]] bool is_3_0() const { return review.options.bcf_version == BcfVersion::v3_0; }
  [[nodiscard]] double metres(double length) const { return conventions.metres * length; }
  [[nodiscard]] double square_metres(double area) const { return conventions.metres * metres(area); }
  [[nodiscard]] double cubic_metres(double volume) const { return conventions.metres * square_metres(volume); }
  /// What stands behind a figure in metres: nothing where nobody said the files' unit.
  [[nodiscard]] const char* m() const { return conventions.is_known ? " m" : ""; }
  [[nodiscard]] std::string label(int side) const {
    return fit(review.assembly.labels[clash.objects[static_cast<std::size_t>(side)]], 100);
  }
};

/// "46 mm". Of files of which nobody knows the unit, in theirs.
std::string short_length(const Topic& topic, double length) {
  if (!topic.conventions.is_known) return fmt::format("{:.3g} (unit unknown)", length);
  constexpr double kMillimetres = 1000, kWhole = 10;
  const double millimetres = kMillimetres * topic.metres(length);
  return millimetres < kWhole ? fmt::format("{:.2g} mm", millimetres) : fmt::format("{:.0f} mm", millimetres);
}

/// What both parts have as a property, each value once.
std::vector<std::string> values_of(const Review& review, const Clash& clash, std::string_view property) {
  std::vector<std::string> values;
  for (const std::uint32_t object : clash.objects)
    for (const auto& [name, value] : review.assembly.objects[object].properties)
      if (name == property) values.push_back(in_short(value));
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// "Duct DN200 x Beam B12, B/3, Level 3, 46 mm".
std::string title(const Topic& topic) {
  const Clash& clash = topic.clash;
  const bool is_inside = clash.verdict == Verdict::inside && clash.inner >= 0;
  const int first = is_inside ? clash.inner : 0;
  std::string text = fmt::format("{} {} {}", topic.label(first), is_inside ? "inside" : "x", topic.label(1 - first));
  if (!topic.axes.empty()) text += ", " + in_short(topic.axes);
  if (const auto storeys = values_of(topic.review, clash, "storey"); !storeys.empty())
    text += fmt::format(", {}", fmt::join(storeys, " / "));
  const bool overlaps = clash.verdict == Verdict::penetrating || clash.verdict == Verdict::crossing;
  if (is_inside) return text;
  if (clash.verdict == Verdict::apart && clash.nearest)
    return fmt::format("{}, {} apart", text, short_length(topic, clash.nearest->distance));
  if (overlaps && depth_of(clash.overlap_depth).hi > 0) {
    const auto length = [&](double depth) { return short_length(topic, depth); };
    return fmt::format("{}, {}", text, depth_text(*clash.overlap_depth, length, " to "));
  }
  return fmt::format("{}, {}", text, name(clash.verdict));
}

const char* priority(Verdict verdict) {
  return kPriorities[verdict == Verdict::apart ? 2 : verdict == Verdict::touching ? 1 : 0];
}

std::string test_of(const Review& review, const Clash& clash) {
  const std::vector<PlannedTest>& tests = review.plan.tests();
  return tests.empty() ? "" : in_short(tests[clash.test].name);
}

std::string triage(const Topic& topic) {
  std::string text;
  if (const std::string test = test_of(topic.review, topic.clash); !test.empty())
    text += fmt::format("Test: {}\n", test);
  if (topic.standing.change == Change::unknown) return text;
  text += "Since the earlier run: " + change_text(topic.clash, topic.standing);
  if (topic.standing.was && *topic.standing.was != topic.clash.verdict)
    text += fmt::format(", was {}", name(*topic.standing.was));
  return text + "\n";
}

/// What rounding leaves of a coordinate that is zero is no figure.
double to_micrometre(double metres) { return std::round(metres * 1e6) / 1e6 + 0.0; }

std::string regions(const Topic& topic) {
  constexpr std::size_t kMostRegions = 5;
  const std::vector<Region>& all = topic.clash.regions;
  std::string text;
  for (std::size_t i = 0; i < std::min(all.size(), kMostRegions); ++i) {
    // Ten digits: a place on a national grid to the millimetre.
    const Point at = place_in_bcf(topic.conventions, all[i].centroid);
    text += fmt::format("Region {}: at ({:.10g} {:.10g} {:.10g}){}, area {:.6g}{}, length {:.6g}{}\n", i + 1,
                        to_micrometre(at.x), to_micrometre(at.y), to_micrometre(at.z), topic.m(),
                        topic.square_metres(all[i].area), topic.conventions.is_known ? " m²" : "",
                        topic.metres(all[i].length), topic.m());
  }
  if (all.size() > kMostRegions) text += fmt::format("{} more\n", counted(all.size() - kMostRegions, "region"));
  return text;
}

/// What of the files is in no answer, and what speaks against their units: lines, so many at most.
std::string about_files(const Assembly& assembly) {
  constexpr std::size_t kMostSentences = 5;
  std::vector<std::string> all = assembly.missing;
  all.insert(all.end(), assembly.alignment.begin(), assembly.alignment.end());
  std::string text;
  for (std::size_t i = 0; i < std::min(all.size(), kMostSentences); ++i)
    text += fmt::format("{}: {}\n", i < assembly.missing.size() ? "Not read" : "Warning", printable(all[i]));
  if (all.size() > kMostSentences)
    text += fmt::format("{} in the JSON\n", counted(all.size() - kMostSentences, "more warning"));
  return text;
}

/// What is known of the pair, a line for each thing.
std::string description(const Topic& topic) {
  const Clash& clash = topic.clash;
  std::string text = fmt::format("Verdict: {}\n", name(clash.verdict)) + triage(topic);
  if (!topic.axes.empty()) text += fmt::format("Axes: {}\n", printable(topic.axes));
  for (const int side : {0, 1})
    text += fmt::format("{}: {} ({})\n", side == 0 ? "A" : "B", topic.label(side),
                        file_name_of(topic.review, clash.objects[static_cast<std::size_t>(side)]));
  const auto interval = [&](const Interval& depth) {
    return fmt::format("{:.6g} to {:.6g}{}", topic.metres(depth.lo), topic.metres(depth.hi), topic.m());
  };
  if (clash.overlap_depth)
    text += fmt::format("Depth: A in B {}; B in A {}\n", interval(clash.overlap_depth->a_in_b),
                        interval(clash.overlap_depth->b_in_a));
  if (clash.overlap_volume)
    text += fmt::format("Volume in common: {}\n",
                        volume_text(topic.cubic_metres(clash.overlap_volume->volume),
                                    topic.conventions.is_known ? std::optional(1.0) : std::nullopt, 6));
  if (std::isinf(clash.fails_below))
    text += "Fails at every tolerance\n";
  else if (clash.verdict < Verdict::touching)
    text += fmt::format("Fails below a tolerance of {:.6g}{}\n", topic.metres(clash.fails_below), topic.m());
  if (clash.nearest) text += fmt::format("Distance: {:.6g}{}\n", topic.metres(clash.nearest->distance), topic.m());
  text += regions(topic);
  for (const int side : {0, 1})
    if (const std::string& left_out =
            topic.review.assembly.objects[clash.objects[static_cast<std::size_t>(side)]].incomplete;
        !left_out.empty())
      text += fmt::format("{} is incomplete: {}\n", side == 0 ? "A" : "B", printable(left_out));
  for (const int side : {0, 1})
    if (topic.review.parts[clash.objects[static_cast<std::size_t>(side)]].facts.part_class == PartClass::surface)
      text += fmt::format("{} is a surface, which has no inside: what lies wholly within it is not found\n",
                          side == 0 ? "A" : "B");
  if (clash.note != Note::none) text += fmt::format("Note: {}\n", sentence(clash.note));
  text += about_files(topic.review.assembly);
  text += "Places are in metres with Z up, as in the viewpoint.";
  if (!topic.conventions.is_known) text += " Nobody said the unit of the files: it is taken for the metre (--unit).";
  return text;
}

void add_header(pugi::xml_node parent, const Topic& topic) {
  pugi::xml_node header = parent.append_child("Header");
  if (topic.is_3_0()) header = header.append_child("Files");
  const auto& [a, b] = topic.clash.objects;
  const std::vector<std::uint32_t>& file_of = topic.review.assembly.file_of;
  for (const std::uint32_t object : {a, b}) {
    if (object != a && file_of[object] == file_of[a]) continue;
    pugi::xml_node file = header.append_child("File");
    file.append_attribute(topic.is_3_0() ? "IsExternal" : "isExternal") = true;
    add_element(file, "Filename", file_name_of(topic.review, object));
  }
}

/// Each of its lines printable. Some editors end lines with CR LF, or with CR alone.
std::string printable_lines(std::string_view text) {
  std::string lines;
  for (std::size_t at = 0;;) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    lines += printable(text.substr(at, end - at));
    if (end == text.size()) return lines;
    lines += '\n';
    at = end + (text.substr(end).starts_with("\r\n") ? 2 : 1);
  }
}

/// What people decided about the pair. When, and who, `--decisions` does not say: both are those of the topic.
void add_comment(pugi::xml_node parent, const Topic& topic) {
  if (topic.standing.decision.comment.empty()) return;
  if (topic.is_3_0()) parent = parent.append_child("Comments");
  pugi::xml_node element = parent.append_child("Comment");
  element.append_attribute("Guid") = guid_of(fmt::format("{} comment ", topic.id)).c_str();
  add_element(element, "Date", topic.date);
  add_element(element, "Author", topic.author);
  add_element(element, "Comment", printable_lines(topic.standing.decision.comment));
  element.append_child("Viewpoint").append_attribute("Guid") = guid_of_viewpoint(topic.id).c_str();
}

}  // namespace

std::vector<std::string> labels_of(const Review& review, std::size_t pair) {
  const Clash& clash = review.clashes.pairs[pair];
  const Standing& standing = review.standings[pair];
  std::vector<std::string> labels{std::string(name(clash.verdict))};
  if (std::string test = test_of(review, clash); !test.empty()) labels.push_back(std::move(test));
  if (standing.change != Change::unknown) labels.push_back(change_text(clash, standing));
  if (const std::string& axes = review.axes[pair]; !axes.empty()) labels.push_back(in_short(axes));
  for (const char* property : {"storey", "class"})
    for (std::string& value : values_of(review, clash, property)) labels.push_back(std::move(value));
  return labels;
}

std::string status_of(const Review& review, std::size_t pair) {
  const std::string& status = review.standings[pair].decision.status;
  return status.empty() ? kUndecided : printable(status);
}

std::string guid_of_skipped(const Review& review) {
  std::string files = "skipped";
  for (const std::string& file : review.assembly.skipped) files += " " + file;
  return guid_of(files);
}

std::string markup_of_skipped(const Review& review) {
  const std::vector<std::string>& skipped = review.assembly.skipped;
  pugi::xml_document document;
  pugi::xml_node about = begin_document(document, "Markup").append_child("Topic");
  about.append_attribute("Guid") = guid_of_skipped(review).c_str();
  about.append_attribute("TopicType") = kTopicType;
  about.append_attribute("TopicStatus") = kUndecided;
  std::string title = "Not checked: " + in_short(skipped.front());
  if (skipped.size() > 1) title += fmt::format(" and {}", counted(skipped.size() - 1, "other file"));
  add_element(about, "Title", title);
  add_element(about, "Priority", kPriorities.front());
  add_element(about, "Index", "0");
  add_element(about, "CreationDate", review.options.date);
  add_element(about, "CreationAuthor", printable(review.options.author));
  add_element(about, "Description",
              "Files that could not be read were skipped. Nothing is known of what clashes with them.\n" +
                  about_files(review.assembly));
  return text_of(document);
}

std::string markup_of(const Review& review, std::size_t pair, std::size_t rank) {
  const Topic topic{review,
                    review.clashes.pairs[pair],
                    review.standings[pair],
                    review.ids[pair],
                    review.axes[pair],
                    review.options.date,
                    printable(review.options.author),
                    conventions_of(review.options, review.assembly)};
  pugi::xml_document document;
  pugi::xml_node markup = begin_document(document, "Markup");
  add_header(markup, topic);
  pugi::xml_node about = markup.append_child("Topic");
  about.append_attribute("Guid") = topic.id.c_str();
  about.append_attribute("TopicType") = kTopicType;
  about.append_attribute("TopicStatus") = status_of(review, pair).c_str();
  add_element(about, "Title", title(topic));
  add_element(about, "Priority", priority(topic.clash.verdict));
  add_element(about, "Index", fmt::format("{}", rank));
  pugi::xml_node labels = topic.is_3_0() ? about.append_child("Labels") : about;
  for (const std::string& label : labels_of(review, pair))
    add_element(labels, topic.is_3_0() ? "Label" : "Labels", label);
  add_element(about, "CreationDate", topic.date);
  add_element(about, "CreationAuthor", topic.author);
  const std::string& due = topic.standing.decision.due;
  if (!due.empty() || !review.options.due.empty())
    add_element(about, "DueDate", due.empty() ? review.options.due : due + "T00:00:00Z");
  if (const std::string& assignee = topic.standing.decision.assignee; !assignee.empty())
    add_element(about, "AssignedTo", printable(assignee));
  if (const std::string& stage = review.options.stage; !stage.empty()) add_element(about, "Stage", printable(stage));
  add_element(about, "Description", description(topic));
  // In 3.0 both are in the topic.
  pugi::xml_node parent = topic.is_3_0() ? about : markup;
  add_comment(parent, topic);
  pugi::xml_node views = parent.append_child("Viewpoints");
  if (topic.is_3_0()) views = views.append_child("ViewPoint");
  views.append_attribute("Guid") = guid_of_viewpoint(topic.id).c_str();
  add_element(views, "Viewpoint", "viewpoint.bcfv");
  add_element(views, "Snapshot", "snapshot.png");
  add_element(views, "Index", "0");
  return text_of(document);
}

}  // namespace impinge::report
