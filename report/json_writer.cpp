// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/json_writer.hpp"

#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "report/units.hpp"

namespace impinge::report {
namespace {

/// The pairs of triangles of one row, with the last brace of the row's object.
void write_triangles(Sink& sink, const Contacts& contacts, std::size_t row, const std::stop_token& stop) {
  constexpr std::uint64_t kBetweenLooks = 1 << 16;
  std::string text;
  sink.write(",\"triangles\":[");
  for (std::uint64_t i = contacts.offsets[row]; i < contacts.offsets[row + 1]; ++i) {
    if (i % kBetweenLooks == 0 && (sink.failed() || stop.stop_requested())) break;
    const TrianglePair pair = contacts.triangles[i];
    text.clear();
    fmt::format_to(std::back_inserter(text), "{}[{},{},\"{}\"]", i > contacts.offsets[row] ? "," : "", pair.a, pair.b,
                   kind_name(contacts.kinds[i]));
    sink.write(text);
  }
  sink.write("]}");
}

Json json_statistics(const Statistics& s) {
  return {{"object_pairs", s.object_pairs},
          {"bounds_updated", s.bounds_updated},
          {"border_moves", s.border_moves},
          {"sphere_tests", s.sphere_tests},
          {"box_tests", s.box_tests},
          {"element_tests", s.element_tests},
          {"nodes_built", s.nodes_built},
          {"triangles_sorted", s.triangles_sorted},
          {"leaf_pairs", s.leaf_pairs},
          {"triangle_pairs", s.triangle_pairs},
          {"exact_calls", s.exact_calls},
          {"images_drawn", s.images_drawn},
          {"images_overlapped", s.images_overlapped},
          {"images_read", s.images_read},
          {"bounds_update_seconds", s.bounds_update_seconds},
          {"border_move_seconds", s.border_move_seconds},
          {"sphere_test_seconds", s.sphere_test_seconds},
          {"object_pair_seconds", s.object_pair_seconds},
          {"box_test_seconds", s.box_test_seconds},
          {"element_test_seconds", s.element_test_seconds},
          {"node_seconds", s.node_seconds},
          {"sorted_triangle_seconds", s.sorted_triangle_seconds},
          {"leaf_pair_seconds", s.leaf_pair_seconds},
          {"exact_call_seconds", s.exact_call_seconds},
          {"predicted_seconds", s.predicted_seconds},
          {"measured_seconds", s.measured_seconds},
          {"device_predicted_seconds", s.device_predicted_seconds},
          {"device_seconds", s.device_seconds},
          {"device_wait_seconds", s.device_wait_seconds},
          {"cpu_seconds", s.cpu_seconds},
          {"broad_seconds", s.broad_seconds},
          {"hierarchy_seconds", s.hierarchy_seconds},
          {"partition_seconds", s.partition_seconds},
          {"narrow_seconds", s.narrow_seconds},
          {"exact_seconds", s.exact_seconds},
          {"results_seconds", s.results_seconds},
          {"total_seconds", s.total_seconds}};
}

Json json_object(std::size_t id, const ObjectFacts& facts) {
  const auto known = [&](auto PartFacts::*member) { return facts.part ? Json(facts.part->facts.*member) : Json(); };
  Json object{{"id", id},
              {"name", facts.name},
              {"path", facts.path},
              {"product", facts.product},
              {"incomplete", or_null(facts.incomplete)},
              {"triangles", facts.triangles},
              {"vertices", facts.vertices},
              {"degenerate", known(&PartFacts::degenerate)},
              {"closed", known(&PartFacts::closed)},
              {"open_edges", known(&PartFacts::open_edges)}};
  object.update(json_facts(facts.part));
  object.update(Json{{"center", json_point(facts.center)}, {"radius", facts.radius}});
  return object;
}

}  // namespace

std::string json_text(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string as_read_back(const std::string& text) { return Json::parse(json_text(text)).get<std::string>(); }

void JsonDocument::begin_member(std::string_view key) {
  sink_.write(is_empty_ ? "{" : ",\n");
  is_empty_ = false;
  sink_.write(json_text(Json(key)) + ":");
}

void JsonDocument::member(std::string_view key, const Json& value) {
  begin_member(key);
  sink_.write(json_text(value));
}

Result<void> JsonDocument::end() {
  sink_.write("}\n");
  if (stop_.stop_requested()) return interrupted();
  return {};
}

Json json_point(const Point& point) { return {point.x + 0.0, point.y + 0.0, point.z + 0.0}; }

Json json_points(std::span<const Point> points) {
  Json list = Json::array();
  for (const Point& point : points) list.push_back(json_point(point));
  return list;
}

Json json_map(const Affine& map) {
  Json list = Json::array();
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) list.push_back(map.m[3 * row + column] + 0.0);
    list.push_back(map.t[row] + 0.0);
  }
  return list;
}

Json json_depth(const std::optional<OverlapDepth>& depth) {
  if (!depth) return {};
  const auto& [a_in_b, b_in_a] = *depth;
  return {{"a_in_b", {a_in_b.lo, a_in_b.hi}}, {"b_in_a", {b_in_a.lo, b_in_a.hi}}};
}

Json json_identity(const Assembly& assembly, std::size_t object) {
  const io::Object& about = assembly.objects[object];
  Json properties = Json::object();
  for (const auto& [name, value] : about.properties) {
    Json& known = properties[name];
    if (known.is_null()) {
      known = value;
      continue;
    }
    if (!known.is_array()) known = Json{std::move(known)};
    known.push_back(value);
  }
  return {{"id", object},
          {"name", about.name},
          {"path", about.path},
          {"product", about.product},
          {"file", assembly.files[assembly.file_of[object]]},
          {"triangles", about.mesh.triangle_count()},
          {"incomplete", or_null(about.incomplete)},
          {"properties", std::move(properties)}};
}

Json json_facts(const std::optional<Part>& part) {
  const PartFacts facts = part ? part->facts : PartFacts{};
  const auto of_part = [&](const Json& value) { return part ? value : Json(); };
  const auto of_class = [&](PartClass worst, double value) {
    return part && facts.part_class <= worst ? Json(value) : Json();
  };
  Json crossing;
  if (part && facts.self_crossing && part->crossing_near)
    crossing = {{"triangles", {facts.self_crossing->a, facts.self_crossing->b}},
                {"near", json_point(*part->crossing_near)}};
  return {{"class", part ? Json(name(facts.part_class)) : Json()},
          {"pieces", of_part({{"solid", facts.pieces[0]}, {"cracked", facts.pieces[1]}, {"surface", facts.pieces[2]}})},
          {"turned", of_part(facts.turned)},
          {"unclear_edges", of_part(facts.unclear_edges)},
          {"first_unclear_edge", facts.unclear_edge ? json_points(*facts.unclear_edge) : Json()},
          {"first_open_edge", facts.open_edge ? json_points(*facts.open_edge) : Json()},
          {"self_crossings", of_part(facts.self_crossings)},
          {"first_self_crossing", crossing},
          {"volume", of_class(PartClass::solid, facts.volume)},
          {"area", of_part(facts.area)},
          {"inner_radius", of_class(PartClass::cracked, facts.radius)}};
}

Json json_unit(const std::optional<double>& metres) {
  return metres ? Json{{"name", or_null(short_name(*metres))}, {"metres", *metres}} : Json();
}

void write_missing(JsonDocument& document, const Assembly& assembly) {
  if (!assembly.missing.empty()) document.member("missing", assembly.missing);
  if (!assembly.alignment.empty()) document.member("warnings", assembly.alignment);
}

std::array<std::uint64_t, 3> count_row(const Contacts& contacts, std::size_t row) {
  std::array<std::uint64_t, 3> counts{};
  for (std::uint64_t i = contacts.offsets[row]; i < contacts.offsets[row + 1]; ++i)
    ++counts[static_cast<std::size_t>(contacts.kinds[i])];
  return counts;
}

std::string_view kind_name(Kind kind) {
  constexpr std::array<std::string_view, 3> kNames{"crossing", "touching", "coplanar"};
  return kNames[static_cast<std::size_t>(kind)];
}

Result<void> write_check_json(Sink& sink, const Assembly& assembly, const Contacts& contacts, bool with_triangles,
                              bool with_hash, const std::stop_token& stop) {
  JsonDocument document(sink, stop);
  document.member("version", 1);
  document.member("unit", json_unit(assembly.unit_in_metres));
  document.list("objects", assembly.objects.size(), [&](std::size_t i) { return json_identity(assembly, i); });
  write_missing(document, assembly);
  document.list("pairs", contacts.objects.size(), [&](std::size_t row) {
    const auto [crossing, touching, coplanar] = count_row(contacts, row);
    std::string pair = json_text({{"a", contacts.objects[row][0]},
                                  {"b", contacts.objects[row][1]},
                                  {"crossing", crossing},
                                  {"touching", touching},
                                  {"coplanar", coplanar}});
    if (with_triangles) pair.pop_back();  // the brace, which follows the triangles
    sink.write(pair);
    if (with_triangles) write_triangles(sink, contacts, row, stop);
  });
  document.member("truncated", contacts.truncated);
  document.member("hash", with_hash ? Json(fmt::format("{:016x}", contacts.hash)) : Json());
  document.member("stats", json_statistics(contacts.statistics));
  return document.end();
}

Result<void> write_info_json(Sink& sink, const std::vector<FileFacts>& files) {
  std::size_t id = 0;
  JsonDocument document(sink);
  document.member("version", 1);
  document.list("files", files.size(), [&](std::size_t f) {
    const FileFacts& file = files[f];
    Json objects = Json::array();
    for (const ObjectFacts& facts : file.objects) objects.push_back(json_object(id++, facts));
    return Json{{"file", file.file},
                {"error", or_null(file.error)},
                {"unit", json_unit(file.unit_in_metres)},
                {"objects", std::move(objects)},
                {"warnings", file.warnings}};
  });
  return document.end();
}

}  // namespace impinge::report
