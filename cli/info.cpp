// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include <optional>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "documents.hpp"
#include "impinge/clash.hpp"
#include "impinge/io.hpp"
#include "progress.hpp"
#include "report/assembly.hpp"
#include "report/json_writer.hpp"
#include "report/part.hpp"
#include "report/sink.hpp"
#include "report/text.hpp"
#include "report/units.hpp"
#include "table.hpp"
#include "tables.hpp"
#include "terminal.hpp"

namespace impinge::cli {
namespace {

/// The object's facts as a part of an assembly; nothing where its coordinates are outside the exact range.
Result<std::optional<Part>> part_of(const io::Object& object, const std::stop_token& stop) {
  ClashOptions options;
  options.stop = stop;
  const Result<PartFacts> facts = examine(object.mesh, object.pose, options);
  if (facts) return std::optional(describe(*facts, object.mesh, object.pose));
  if (facts.error().code == Code::out_of_range) return std::optional<Part>();
  return facts.error();
}

Result<ObjectFacts> facts_of(io::Object object, const std::stop_token& stop) {
  ObjectFacts about;
  about.triangles = object.mesh.triangle_count();
  about.vertices = object.mesh.vertex_count();
  const Result<std::optional<Part>> part = part_of(object, stop);
  if (stop.stop_requested()) return interrupted();
  if (!part) return part.error();
  about.part = *part;
  about.center = world_vertex(object.pose, object.mesh.sphere_center());
  about.radius = object.mesh.sphere_radius();
  about.name = std::move(object.name);
  about.path = std::move(object.path);
  about.product = std::move(object.product);
  about.incomplete = std::move(object.incomplete);
  return about;
}

Result<FileFacts> facts_of(const std::string& file, const InfoArguments& arguments, ProgressLine& line,
                           const std::stop_token& stop) {
  FileFacts facts;
  facts.file = file;
  line.phase("reading " + printable(file));
  io::ReadOptions options;
  options.max_file_bytes = arguments.max_file_bytes;
  options.unit_in_metres = arguments.unit_in_metres;
  options.stop = stop;
  Result<io::Model> model = io::read(file, options);
  if (stop.stop_requested()) return interrupted();
  if (!model) {
    facts.error = model.error().message;
    return facts;
  }
  facts.unit_in_metres = model->unit_in_metres ? model->unit_in_metres : arguments.unit_in_metres;
  facts.warnings = std::move(model->missing);
  facts.warnings.insert(facts.warnings.end(), model->warnings.begin(), model->warnings.end());
  const std::size_t total = model->objects.size();
  for (std::size_t i = 0; i < total; ++i) {
    if (stop.stop_requested()) return interrupted();
    line.phase(
        fmt::format("examining {} ({} of {})", printable(model->objects[i].name), i + 1, total),
        [work = Work{static_cast<double>(i), static_cast<double>(total)}] { return work; }, "parts");
    Result<ObjectFacts> about = facts_of(std::move(model->objects[i]), stop);
    if (!about) return about.error();
    if (!about->part)
      facts.warnings.push_back(
          fmt::format("object '{}' has coordinates on which verdicts are not exact (not below 2^300, or "
                      "not a multiple of 2^-358); check will refuse it",
                      about->name));
    facts.objects.push_back(std::move(*about));
  }
  return facts;
}

/// How many edges keep the surface from being closed, or why that cannot be said.
std::string open_edges_text(const ObjectFacts& facts) {
  if (!facts.part) return "unknown";
  if (facts.triangles == 0) return "empty";
  if (facts.part->facts.closed) return "closed";
  return facts.part->facts.open_edges == 0 ? "no area" : grouped(facts.part->facts.open_edges);
}

std::string class_text(const ObjectFacts& facts) {
  return facts.part ? std::string(name(facts.part->facts.part_class)) : "unknown";
}

constexpr std::size_t kRoomForVertices = 100, kRoomForSphere = 80;

/// The objects with the columns that leave room for names on a line of so many columns.
Table table_of(const std::vector<ObjectFacts>& objects, std::size_t width) {
  using enum Column::Kind;
  Table table{objects.size(), {}};
  const auto add = [&](const char* heading, Column::Kind kind, std::string (*cell)(const ObjectFacts&)) {
    table.columns.push_back({heading, kind, [&objects, cell](std::size_t row) { return cell(objects[row]); }});
  };
  add("object", name, [](const ObjectFacts& facts) { return printable(facts.name); });
  add("triangles", number, [](const ObjectFacts& facts) { return grouped(facts.triangles); });
  if (width >= kRoomForVertices)
    add("vertices", number, [](const ObjectFacts& facts) { return grouped(facts.vertices); });
  add("degenerate", number,
      [](const ObjectFacts& facts) { return facts.part ? grouped(facts.part->facts.degenerate) : "unknown"; });
  add("open edges", number, open_edges_text);
  add("class", text, class_text);
  if (width < kRoomForSphere) return table;
  add("centre", number, [](const ObjectFacts& facts) {
    return fmt::format("{} {} {}", coordinate(facts.center.x, facts.radius), coordinate(facts.center.y, facts.radius),
                       coordinate(facts.center.z, facts.radius));
  });
  add("radius", number, [](const ObjectFacts& facts) { return coordinate(facts.radius, facts.radius); });
  return table;
}

void print_file(const FileFacts& facts, Sink& out) {
  std::uint64_t triangles = 0;
  for (const ObjectFacts& object : facts.objects) triangles += object.triangles;
  out.write(fmt::format("{}: {}, {}, in {}\n", printable(facts.file), counted(facts.objects.size(), "object"),
                        counted(triangles, "triangle"), unit_text(facts.unit_in_metres)));
  for (const std::string& warning : facts.warnings) out.write(fmt::format("warning: {}\n", printable(warning)));
  if (facts.objects.empty()) return;
  const auto width = width_of(STDOUT_FILENO);
  print(table_of(facts.objects, width.value_or(kRoomForVertices)), out, width);

  std::vector<NamedPart> parts;
  for (const ObjectFacts& object : facts.objects)
    parts.push_back({object.name, object.incomplete, object.part ? &*object.part : nullptr});
  print_parts(parts, facts.unit_in_metres, out, width);
}

}  // namespace

Result<bool> info(const InfoArguments& arguments, const std::stop_token& stop) {
  Documents documents(arguments.files, arguments.force);
  if (auto ordered = documents.order({{kJson, arguments.json}}); !ordered) return ordered.error();
  const bool table = !documents.on_standard_output();
  Sink out(STDOUT_FILENO, "standard output");
  std::vector<FileFacts> files;
  bool all_read = true;
  std::size_t listed = 0;
  for (const std::string& file : arguments.files) {
    ProgressLine line(STDERR_FILENO, true);
    Result<FileFacts> facts = facts_of(file, arguments, line, stop);
    line.end();
    if (!facts) return facts.error();
    if (!facts->error.empty()) {
      all_read = false;
      complain(facts->error);
    } else if (table) {
      if (listed++ > 0) out.write("\n");
      print_file(*facts, out);
      if (auto flushed = out.flush(); !flushed) return flushed.error();
    }
    if (arguments.json) files.push_back(std::move(*facts));
  }
  if (listed > 0 && width_of(STDOUT_FILENO).value_or(kRoomForVertices) < kRoomForVertices)
    out.write("\n(A wider terminal or --json shows more columns.)\n");
  if (auto flushed = out.flush(); !flushed) return flushed.error();
  documents.write(kJson, [&](Sink& sink) { return write_info_json(sink, files); });
  if (auto put = documents.put(); !put) return put.error();
  return all_read;
}

}  // namespace impinge::cli
