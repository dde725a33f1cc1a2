// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/clash_json.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>

#include "report/json_writer.hpp"
#include "report/triage_json.hpp"

namespace impinge::report {
namespace {

void write_settings(Sink& sink, const ClashArguments& arguments) {
  sink.write(fmt::format("\"settings\":{{\"tolerance\":{},\"clearance\":{},\"depth\":{},\"regions\":{},\"fail_on\":{},",
                         arguments.tolerance ? json_number(*arguments.tolerance) : "\"auto\"",
                         json_number(arguments.clearance), arguments.depth, arguments.regions,
                         json_list(words_of(arguments.fail_on), json_string)));
  sink.write(fmt::format("\"ignore\":{},\"within_products\":{},\"scale\":{},\"config\":{},\"previous\":{}}},\n",
                         json_list(arguments.ignored,
                                   [](const auto& pair) {
                                     return fmt::format("[{},{}]", json_string(pair.first), json_string(pair.second));
                                   }),
                         arguments.within_products,
                         json_list(arguments.scales,
                                   [](const auto& scale) {
                                     return fmt::format("[{},{}]", json_string(scale.first), json_number(scale.second));
                                   }),
                         arguments.config ? json_string(*arguments.config) : "null",
                         arguments.previous ? json_string(*arguments.previous) : "null"));
}

void write_files(Sink& sink, const Review& review) {
  sink.write("\"files\":[");
  for (std::size_t i = 0; i < review.file_names.size(); ++i)
    sink.write(fmt::format("{}\n{{\"file\":{},\"name\":{},\"known_as\":{}}}", i > 0 ? "," : "",
                           json_string(review.assembly.files[i]), json_string(review.file_names[i]),
                           json_string(review.known_names.known_as[i])));
  sink.write("],\n");
}

void write_parts(Sink& sink, const Review& review) {
  sink.write("\"objects\":[");
  for (std::size_t i = 0; i < review.parts.size(); ++i)
    sink.write(fmt::format("{}\n{{{},\"placed\":\"{}\",\"closed\":{},\"open_edges\":{},{},\"type\":{}}}",
                           i > 0 ? "," : "", json_identity(review.assembly, i), review.identities[i].placed,
                           review.parts[i].facts.closed, review.parts[i].facts.open_edges, json_facts(review.parts[i]),
                           review.types.of_object[i]));
  sink.write("\n],\n" + json_missing(review.assembly));
}

/// Members of a pair. Null of what touches: where it does, the regions tell.
std::string json_distance(const Clash& pair) {
  if (!pair.nearest) return "\"distance\":null,\"distance_error\":null,\"nearest\":null";
  const Nearest& nearest = *pair.nearest;
  return fmt::format("\"distance\":{},\"distance_error\":{},\"nearest\":[{},{}]", json_number(nearest.distance),
                     json_number(nearest.error), json_point(nearest.a), json_point(nearest.b));
}

void write_region(Sink& sink, const Region& region, const RegionStanding& standing) {
  const auto number = [](std::uint32_t triangle) { return fmt::format("{}", triangle); };
  sink.write(fmt::format(
      "{{\"id\":\"{}\",{},\"pairs\":{},\"box\":{},\"area\":{},\"length\":{},\"centroid\":{},\"normal\":{},\"lines\":[",
      standing.id, json_standing(standing.change, standing.remark), region.pairs, json_list(region.box, json_point),
      json_number(region.area), json_number(region.length), json_point(region.centroid), json_point(region.normal)));
  for (std::size_t i = 0; i < region.lines.size(); ++i)
    sink.write((i > 0 ? "," : "") + json_list(region.lines[i], json_point));
  sink.write(fmt::format("],\"triangles_a\":{},\"triangles_b\":{}}}", json_list(region.triangles_a, number),
                         json_list(region.triangles_b, number)));
}

void write_pair(Sink& sink, const Review& review, std::size_t number, const ClashArguments& arguments) {
  const Clash& pair = review.clashes.pairs[number];
  const Standing& standing = review.standings[number];
  const std::string inner = pair.verdict == Verdict::inside && pair.inner >= 0
                                ? fmt::format("{}", pair.objects[static_cast<std::size_t>(pair.inner)])
                                : "null";
  sink.write(fmt::format("{{\"id\":\"{}\",\"a\":{},\"b\":{},\"crossing\":{},\"touching\":{},\"coplanar\":{},",
                         review.ids[number], pair.objects[0], pair.objects[1], pair.contacts[0], pair.contacts[1],
                         pair.contacts[2]));
  sink.write(fmt::format("\"verdict\":\"{}\",\"inner\":{},\"note\":{},\"tolerance\":{},\"fails\":{}",
                         name(pair.verdict), inner, pair.note == Note::none ? "null" : json_string(sentence(pair.note)),
                         json_number(pair.tolerance), standing.fails));
  sink.write("," + json_triage(review, number));
  if (arguments.depth) sink.write(",\"overlap_depth\":" + json_depth(pair.overlap_depth));
  if (arguments.clearance > 0) sink.write("," + json_distance(pair));
  if (arguments.regions) {
    sink.write(",\"regions\":[");
    for (std::size_t i = 0; i < pair.regions.size(); ++i) {
      if (i > 0) sink.write(",");
      write_region(sink, pair.regions[i], standing.regions[i]);
    }
    sink.write("]");
  }
  sink.write("}");
}

void write_counts(Sink& sink, const Review& review) {
  std::array<std::uint64_t, 6> counts{};
  for (const Clash& pair : review.clashes.pairs) ++counts[static_cast<std::size_t>(pair.verdict)];
  sink.write("\"counts\":{");
  for (std::size_t i = 0; i < counts.size(); ++i)
    sink.write(fmt::format("\"{}\":{},", name(static_cast<Verdict>(i)), counts[i]));
  sink.write(fmt::format("\"fail\":{},\"candidates\":{}}}", count_failing(review), review.clashes.candidates));
}

}  // namespace

Result<void> write_clash_json(Sink& sink, const Review& review, const ClashArguments& arguments,
                              const std::stop_token& stop) {
  sink.write("{\"version\":1,\n");
  write_settings(sink, arguments);
  write_tests(sink, review);
  write_types(sink, review);
  write_files(sink, review);
  write_parts(sink, review);
  sink.write("\"pairs\":[");
  for (std::size_t i = 0; i < review.clashes.pairs.size(); ++i) {
    if (sink.failed()) break;
    if (stop.stop_requested()) return interrupted();
    sink.write(i == 0 ? "\n" : ",\n");
    write_pair(sink, review, i, arguments);
  }
  sink.write("\n],\n");
  write_resolved(sink, review);
  write_groups(sink, review, arguments.group_by);
  write_counts(sink, review);
  sink.write("}\n");
  return {};
}

Result<void> write_view_json(Sink& sink, const Assembly& assembly) {
  sink.write("{\"version\":1,\n\"settings\":null,\n\"objects\":[");
  for (std::size_t i = 0; i < assembly.objects.size(); ++i)
    sink.write(fmt::format("{}\n{{{},\"closed\":null,\"open_edges\":null,{}}}", i > 0 ? "," : "",
                           json_identity(assembly, i), json_facts(std::nullopt)));
  sink.write("\n],\n" + json_missing(assembly) + "\"pairs\":[],\n\"counts\":null}\n");
  return {};
}

}  // namespace impinge::report
