// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/json_writer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "report/text.hpp"

namespace impinge::report {
namespace {

void write_objects(Sink& sink, const Assembly& assembly) {
  sink.write("\"objects\":[");
  for (std::size_t i = 0; i < assembly.objects.size(); ++i) {
    sink.write(fmt::format("{}\n{{{}}}", i > 0 ? "," : "", json_identity(assembly, i)));
  }
  sink.write("\n],\n" + json_missing(assembly));
}

/// Errors: `cancelled`.
Result<void> write_triangles(Sink& sink, const Contacts& contacts, std::size_t row, const std::stop_token& stop) {
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
  sink.write("]");
  if (stop.stop_requested()) return interrupted();
  return {};
}

Result<void> write_pairs(Sink& sink, const Contacts& contacts, bool triangles, const std::stop_token& stop) {
  sink.write("\"pairs\":[");
  for (std::size_t row = 0; row < contacts.objects.size() && !sink.failed(); ++row) {
    const RowCounts counts = count_row(contacts, row);
    sink.write(fmt::format("{}\n{{\"a\":{},\"b\":{},\"crossing\":{},\"touching\":{},\"coplanar\":{}",
                           row > 0 ? "," : "", contacts.objects[row][0], contacts.objects[row][1], counts.crossing,
                           counts.touching, counts.coplanar));
    if (triangles) {
      if (auto written = write_triangles(sink, contacts, row, stop); !written) return written.error();
    }
    sink.write("}");
    if (stop.stop_requested()) return interrupted();
  }
  sink.write("\n],\n");
  return {};
}

void write_statistics(Sink& sink, const Statistics& s) {
  sink.write(fmt::format(
      "\"stats\":{{\"object_pairs\":{},\"box_tests\":{},\"element_tests\":{},\"nodes_built\":{},"
      "\"leaf_pairs\":{},\"triangle_pairs\":{},\"exact_calls\":{},",
      s.object_pairs, s.box_tests, s.element_tests, s.nodes_built, s.leaf_pairs, s.triangle_pairs, s.exact_calls));
  sink.write(
      fmt::format("\"box_test_seconds\":{},\"element_test_seconds\":{},\"node_seconds\":{},\"leaf_pair_seconds\":{},"
                  "\"exact_call_seconds\":{},\"predicted_seconds\":{},\"measured_seconds\":{},",
                  json_number(s.box_test_seconds), json_number(s.element_test_seconds), json_number(s.node_seconds),
                  json_number(s.leaf_pair_seconds), json_number(s.exact_call_seconds), json_number(s.predicted_seconds),
                  json_number(s.measured_seconds)));
  sink.write(fmt::format("\"device_predicted_seconds\":{},\"device_seconds\":{},\"cpu_seconds\":{},",
                         json_number(s.device_predicted_seconds), json_number(s.device_seconds),
                         json_number(s.cpu_seconds)));
  sink.write(
      fmt::format("\"broad_seconds\":{},\"hierarchy_seconds\":{},\"partition_seconds\":{},\"narrow_seconds\":{},"
                  "\"exact_seconds\":{},\"results_seconds\":{},\"total_seconds\":{}}}",
                  json_number(s.broad_seconds), json_number(s.hierarchy_seconds), json_number(s.partition_seconds),
                  json_number(s.narrow_seconds), json_number(s.exact_seconds), json_number(s.results_seconds),
                  json_number(s.total_seconds)));
}

void write_facts(Sink& sink, std::size_t id, const ObjectFacts& facts) {
  const auto known = [&](auto PartFacts::*member) {
    return facts.part ? fmt::format("{}", facts.part->facts.*member) : std::string("null");
  };
  sink.write(fmt::format("{{\"id\":{},\"name\":{},\"path\":{},\"product\":{},\"triangles\":{},\"vertices\":{},", id,
                         json_string(facts.name), json_string(facts.path), json_string(facts.product), facts.triangles,
                         facts.vertices));
  sink.write(fmt::format("\"degenerate\":{},\"closed\":{},\"open_edges\":{},{},\"center\":{},\"radius\":{}}}",
                         known(&PartFacts::degenerate), known(&PartFacts::closed), known(&PartFacts::open_edges),
                         json_facts(facts.part), json_point(facts.center), json_number(facts.radius)));
}

}  // namespace

std::string json_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : valid_utf8(text)) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (byte < 0x20 || byte == 0x7F) {
      fmt::format_to(std::back_inserter(result), "\\u{:04x}", byte);
    } else {
      result += c;
    }
  }
  return result += '"';
}

std::string json_number(double value) {
  if (!std::isfinite(value)) return "null";
  return fmt::format("{}", value == 0 ? 0.0 : value);
}

std::string json_map(const Affine& map) {
  std::string text = "[";
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) text += json_number(map.m[3 * row + column]) + ",";
    text += json_number(map.t[row]) + (row < 2 ? "," : "]");
  }
  return text;
}

std::string json_depth(const std::optional<OverlapDepth>& depth) {
  if (!depth) return "null";
  const auto interval = [](const Interval& i) { return fmt::format("[{},{}]", json_number(i.lo), json_number(i.hi)); };
  return fmt::format("{{\"a_in_b\":{},\"b_in_a\":{}}}", interval(depth->a_in_b), interval(depth->b_in_a));
}

std::string json_identity(const Assembly& assembly, std::size_t object) {
  const io::Object& about = assembly.objects[object];
  return fmt::format("\"id\":{},\"name\":{},\"path\":{},\"product\":{},\"file\":{},\"triangles\":{}", object,
                     json_string(about.name), json_string(about.path), json_string(about.product),
                     json_string(assembly.files[assembly.file_of[object]]), about.mesh.triangle_count());
}

std::string json_missing(const Assembly& assembly) {
  if (assembly.missing.empty()) return {};
  return fmt::format("\"missing\":{},\n", json_list(assembly.missing, json_string));
}

RowCounts count_row(const Contacts& contacts, std::size_t row) {
  RowCounts counts;
  for (std::uint64_t i = contacts.offsets[row]; i < contacts.offsets[row + 1]; ++i) {
    const Kind kind = contacts.kinds[i];
    counts.crossing += kind == Kind::crossing ? 1 : 0;
    counts.touching += kind == Kind::touching ? 1 : 0;
    counts.coplanar += kind == Kind::coplanar ? 1 : 0;
  }
  return counts;
}

std::string_view kind_name(Kind kind) {
  switch (kind) {
    case Kind::crossing:
      return "crossing";
    case Kind::touching:
      return "touching";
    case Kind::coplanar:
      return "coplanar";
  }
  return "unknown";
}

Result<void> write_check_json(Sink& sink, const Assembly& assembly, const Contacts& contacts,
                              const CheckArguments& arguments, const std::stop_token& stop) {
  sink.write("{\"version\":1,\n");
  write_objects(sink, assembly);
  if (auto written = write_pairs(sink, contacts, arguments.triangles, stop); !written) return written.error();
  sink.write(fmt::format("\"truncated\":{},\n\"hash\":{},\n", contacts.truncated,
                         arguments.first ? "null" : fmt::format("\"{:016x}\"", contacts.hash)));
  write_statistics(sink, contacts.statistics);
  sink.write("}\n");
  return {};
}

Result<void> write_info_json(Sink& sink, const std::vector<FileFacts>& files) {
  std::size_t id = 0;
  sink.write("{\"version\":1,\n\"files\":[");
  for (std::size_t f = 0; f < files.size(); ++f) {
    const FileFacts& file = files[f];
    sink.write(fmt::format("{}\n{{\"file\":{},\"error\":{},\"objects\":[", f > 0 ? "," : "", json_string(file.file),
                           file.error.empty() ? "null" : json_string(file.error)));
    for (std::size_t i = 0; i < file.objects.size(); ++i) {
      sink.write(i > 0 ? ",\n" : "\n");
      write_facts(sink, id++, file.objects[i]);
    }
    sink.write("],\n\"warnings\":[");
    for (std::size_t i = 0; i < file.warnings.size(); ++i)
      sink.write(fmt::format("{}{}", i > 0 ? "," : "", json_string(file.warnings[i])));
    sink.write("]}");
  }
  sink.write("\n]}\n");
  return {};
}

}  // namespace impinge::report
