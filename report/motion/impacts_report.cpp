// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/motion/impacts_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "impinge/scene.hpp"
#include "report/assembly.hpp"
#include "report/json_writer.hpp"
#include "report/text.hpp"
#include "report/units.hpp"
#include "report/writers.hpp"

namespace impinge::report {
namespace {

Result<Assembly> read_state(const ImpactOptions& options, std::size_t frame, const std::optional<double>& unit) {
  SceneOptions scene;
  scene.files = {options.files[frame]};
  scene.unit_in_metres = unit;
  scene.max_file_bytes = options.max_file_bytes;
  scene.threads = options.threads;
  scene.stop = options.stop;
  return read_assembly(scene);
}

/// Whether two files hold states of the same parts.
Result<void> compare(const Assembly& from, const Assembly& to, const std::string& from_file,
                     const std::string& to_file) {
  const auto differ = [&](const std::string& how) {
    return Error{Code::bad_file, fmt::format("{} and {} are not two states of the same parts: {}; every state needs "
                                             "the same parts with the same triangles, in the same order",
                                             from_file, to_file, how)};
  };
  if (from.unit_in_metres != to.unit_in_metres)
    return Error{Code::bad_file,
                 fmt::format("{} does not say its unit, and {} does; say with --unit what it is", from_file, to_file)};
  if (from.objects.size() != to.objects.size())
    return differ(fmt::format("they have {} and {} parts", from.objects.size(), to.objects.size()));
  const std::unordered_set<std::string_view> labels(to.labels.begin(), to.labels.end());
  for (std::size_t i = 0; i < from.objects.size(); ++i) {
    const Mesh &a = from.objects[i].mesh, &b = to.objects[i].mesh;
    const std::string& part = from.labels[i];
    // A part may be called otherwise in each state, but not as another one is.
    if (to.labels[i] != part && labels.contains(part))
      return differ(fmt::format("part '{}' stands where '{}' is in the other", part, to.labels[i]));
    if (a.triangle_count() != b.triangle_count())
      return differ(fmt::format("part '{}' has {} and {} triangles", part, a.triangle_count(), b.triangle_count()));
    if (a.vertex_count() != b.vertex_count())
      return differ(fmt::format("part '{}' has {} and {} vertices", part, a.vertex_count(), b.vertex_count()));
    const auto [one, other] = std::ranges::mismatch(a.triangles(), b.triangles());
    if (one != a.triangles().end())
      return differ(fmt::format("triangle {} of part '{}' has other vertices", one - a.triangles().begin(), part));
  }
  return {};
}

/// The parts in a scene, which goes from state to state.
class Steps {
 public:
  explicit Steps(const ImpactOptions& options) : options_(options) {}

  Result<ImpactSequence> run() {
    Result<Assembly> first = read_state(options_, 0, options_.unit_in_metres);
    if (!first) return first.error();
    if (first->objects.size() == 1 && !options_.self)
      return Error{Code::bad_option, fmt::format("{} has one part alone, and no part is tested against itself without "
                                                 "--self",
                                                 options_.files.front())};
    found_.assembly = *std::move(first);
    Length separation = options_.separation;
    if (auto brought = bring_to_unit(separation, found_.assembly.unit_in_metres, "--separation"); !brought)
      return brought.error();
    found_.separation = separation.value;
    for (const io::Object& object : found_.assembly.objects) {
      auto id = scene_.add(object.mesh, object.pose);
      if (!id) return in_file(0, id.error());
      if (auto set = scene_.self(*id, options_.self); !set) return set.error();
      ids_.push_back(*id);
    }
    if (options_.progress != nullptr) options_.progress->total = options_.files.size() - 1;
    for (std::uint32_t frame = 0; frame + 1 < options_.files.size(); ++frame) {
      const Result<Assembly> to = read_state(options_, frame + 1, found_.assembly.unit_in_metres);
      if (!to) return to.error();
      if (auto same = compare(found_.assembly, *to, options_.files[frame], options_.files[frame + 1]); !same)
        return same.error();
      if (auto moved = move(*to); !moved) return in_file(frame + 1, moved.error());
      if (auto looked = look(frame); !looked) return in_step(frame, looked.error());
      if (found_.truncated || (options_.earliest && found_.earliest)) break;
      scene_.step();
      if (options_.progress != nullptr) options_.progress->done.fetch_add(1);
    }
    return std::move(found_);
  }

 private:
  [[nodiscard]] Error in_file(std::size_t frame, const Error& error) const {
    return {error.code, error.code == Code::cancelled ? error.message : options_.files[frame] + ": " + error.message};
  }
  [[nodiscard]] Error in_step(std::size_t frame, const Error& error) const {
    const std::string step = options_.files[frame] + " to " + options_.files[frame + 1] + ": ";
    return {error.code,
            error.code == Code::cancelled ? error.message : step + with_label(error, found_.assembly).message};
  }

  Result<void> move(const Assembly& to) {
    std::vector<double> xyz;
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      const io::Object& object = to.objects[i];
      xyz.clear();
      for (const Point& p : object.mesh.vertices()) xyz.insert(xyz.end(), {p.x, p.y, p.z});
      if (auto set = scene_.set_vertices(ids_[i], xyz); !set) return set.error();
      if (auto set = scene_.set_pose(ids_[i], object.pose); !set) return set.error();
    }
    return {};
  }

  Result<void> look(std::uint32_t frame) {
    impinge::MotionOptions options;
    options.earliest = options_.earliest;
    options.separation = found_.separation;
    options.limit = options_.limit - found_.impacts.size();
    options.threads = options_.threads;
    options.stop = options_.stop;
    const Result<SceneImpacts> impacts = scene_.find_impacts(options);
    if (!impacts) return impacts.error();
    found_.truncated = impacts->truncated;
    if (impacts->earliest && !found_.earliest) found_.earliest = SequenceTime{frame, *impacts->earliest};
    for (std::size_t row = 0; row < impacts->objects.size(); ++row)
      for (std::uint64_t i = impacts->offsets[row]; i < impacts->offsets[row + 1]; ++i)
        found_.impacts.push_back({frame, impacts->objects[row], impacts->impacts[i]});
    return {};
  }

  const ImpactOptions& options_;
  Scene scene_;
  std::vector<ObjectId> ids_;
  ImpactSequence found_;
};

std::string_view name_of(Feature feature) {
  switch (feature) {
    case Feature::vertex_face:
      return "vertex_face";
    case Feature::face_vertex:
      return "face_vertex";
    case Feature::edge_edge:
      return "edge_edge";
  }
  return {};
}

/// The vertices of one of the two features of an impact.
std::vector<std::uint32_t> vertices_of(const ImpactSequence& sequence, const SequenceImpact& found, std::size_t which) {
  const Mesh& mesh = sequence.assembly.objects[found.objects[which]].mesh;
  const std::uint32_t i = which == 0 ? found.impact.a : found.impact.b;
  const bool is_face = found.impact.feature == (which == 0 ? Feature::face_vertex : Feature::vertex_face);
  const auto all = [](const auto& vertices) { return std::vector<std::uint32_t>(vertices.begin(), vertices.end()); };
  if (found.impact.feature == Feature::edge_edge) return all(mesh.edges()[i]);
  return is_face ? all(mesh.triangles()[i]) : std::vector{i};
}

}  // namespace

Result<ImpactSequence> find_impact_sequence(const ImpactOptions& options) { return Steps(options).run(); }

Result<void> write_impacts_json(Sink& sink, const ImpactSequence& sequence, const ImpactOptions& options) {
  JsonDocument document(sink, options.stop);
  const auto toi = [](const Interval& time) { return Json{time.lo, time.hi}; };
  document.member("version", 1);
  document.member("unit", json_unit(sequence.assembly.unit_in_metres));
  document.member("files", options.files);
  document.member("settings",
                  Json{{"self", options.self}, {"earliest", options.earliest}, {"separation", sequence.separation}});
  document.list("objects", sequence.assembly.objects.size(),
                [&](std::size_t i) { return json_identity(sequence.assembly, i); });
  write_missing(document, sequence.assembly);
  document.list("impacts", sequence.impacts.size(), [&](std::size_t i) {
    const SequenceImpact& found = sequence.impacts[i];
    return Json{{"frame", found.frame},
                {"toi", toi(found.impact.time)},
                {"feature", name_of(found.impact.feature)},
                {"object_a", found.objects[0]},
                {"object_b", found.objects[1]},
                {"a", found.impact.a},
                {"b", found.impact.b},
                {"a_vertices", vertices_of(sequence, found, 0)},
                {"b_vertices", vertices_of(sequence, found, 1)},
                {"point", json_point(found.impact.point)},
                {"normal", json_point(found.impact.normal)}};
  });
  document.member("earliest", sequence.earliest
                                  ? Json{{"frame", sequence.earliest->frame}, {"toi", toi(sequence.earliest->toi)}}
                                  : Json());
  document.member("truncated", sequence.truncated);
  return document.end();
}

Result<void> write_impacts_csv(Sink& sink, const ImpactSequence& sequence, const ImpactOptions& options) {
  sink.write(
      "frame,toi_lo,toi_hi,feature,object_a,object_b,a,b,a_vertices,b_vertices,x,y,z,normal_x,normal_y,normal_z,"
      "from_file,to_file\r\n");
  for (const SequenceImpact& found : sequence.impacts) {
    if (options.stop.stop_requested()) return interrupted();
    if (sink.failed()) break;
    const auto& [feature, a, b, time, point, normal] = found.impact;
    const auto label = [&](std::size_t which) { return csv_cell(sequence.assembly.labels[found.objects[which]]); };
    const auto vertices = [&](std::size_t which) {
      return fmt::format("{}", fmt::join(vertices_of(sequence, found, which), " "));
    };
    sink.write(fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", found.frame, time.lo, time.hi,
                           name_of(feature), label(0), label(1), a, b, vertices(0), vertices(1), point.x + 0.0,
                           point.y + 0.0, point.z + 0.0, normal.x + 0.0, normal.y + 0.0, normal.z + 0.0,
                           csv_cell(options.files[found.frame]), csv_cell(options.files[found.frame + 1])));
  }
  return {};
}

}  // namespace impinge::report
