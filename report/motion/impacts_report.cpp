// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/motion/impacts_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include "report/json_writer.hpp"
#include "report/text.hpp"
#include "report/writers.hpp"

namespace impinge::report {
namespace {

struct Extent {
  std::array<double, 3> lo, hi;  ///< nothing is in it where lo > hi
};

Extent extent_of(const Mesh& mesh) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Extent extent{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (const Point& p : mesh.vertices()) {
    const std::array<double, 3> xyz{p.x, p.y, p.z};
    for (std::size_t k = 0; k < 3; ++k) {
      extent.lo[k] = std::min(extent.lo[k], xyz[k]);
      extent.hi[k] = std::max(extent.hi[k], xyz[k]);
    }
  }
  return extent;
}

/// The parts of one file, where they stand.
struct State {
  Assembly assembly;
  std::vector<Mesh> meshes;  ///< with the vertices of the world
  std::vector<Extent> extents;
};

Result<State> read_state(const ImpactOptions& options, std::size_t frame, const std::optional<double>& unit) {
  SceneOptions scene;
  scene.files = {options.files[frame]};
  scene.unit_in_metres = unit;
  scene.max_file_bytes = options.max_file_bytes;
  scene.threads = options.threads;
  scene.stop = options.stop;
  Result<Assembly> assembly = read_assembly(scene);
  if (!assembly) return assembly.error();
  State state{*std::move(assembly), {}, {}};
  for (const io::Object& object : state.assembly.objects) {
    const bool stands_there = object.pose.R == Pose{}.R && object.pose.t == Pose{}.t;
    Result<Mesh> placed = stands_there ? object.mesh : object.mesh.transformed({object.pose.R, object.pose.t});
    if (!placed)
      return Error{placed.error().code,
                   fmt::format("{}: object '{}': {}", options.files[frame], object.name, placed.error().message)};
    state.extents.push_back(extent_of(*placed));
    state.meshes.push_back(*std::move(placed));
  }
  return state;
}

/// Whether two files hold states of the same parts.
Result<void> compare(const State& from, const State& to, const std::string& from_file, const std::string& to_file) {
  const auto differ = [&](const std::string& how) {
    return Error{Code::bad_file, fmt::format("{} and {} are not two states of the same parts: {}; every state needs "
                                             "the same parts with the same triangles, in the same order",
                                             from_file, to_file, how)};
  };
  if (from.assembly.unit_in_metres != to.assembly.unit_in_metres)
    return Error{Code::bad_file,
                 fmt::format("{} does not say its unit, and {} does; say with --unit what it is", from_file, to_file)};
  if (from.meshes.size() != to.meshes.size())
    return differ(fmt::format("they have {} and {} parts", from.meshes.size(), to.meshes.size()));
  for (std::size_t i = 0; i < from.meshes.size(); ++i) {
    const Mesh &a = from.meshes[i], &b = to.meshes[i];
    const std::string& part = from.assembly.labels[i];
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

/// Whether two parts may meet between two states: not if an axis separates them at both, in the same order, for along
/// it the gap between points that move linearly is a concave function of time.
bool may_meet(const State& from, const State& to, std::size_t i, std::size_t j) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto below = [&](std::size_t a, std::size_t b) {
      return from.extents[a].hi[k] < from.extents[b].lo[k] && to.extents[a].hi[k] < to.extents[b].lo[k];
    };
    if (below(i, j) || below(j, i)) return false;
  }
  return true;
}

class Steps {
 public:
  explicit Steps(const ImpactOptions& options) : options_(options) {}

  Result<ImpactSequence> run() {
    Result<State> from = read_state(options_, 0, options_.unit_in_metres);
    if (!from) return from.error();
    if (from->meshes.size() == 1 && !options_.self)
      return Error{Code::bad_option, fmt::format("{} has one part alone, and no part is tested against itself without "
                                                 "--self",
                                                 options_.files.front())};
    found_.assembly = from->assembly;
    if (options_.progress != nullptr) options_.progress->total = options_.files.size() - 1;
    for (std::uint32_t frame = 0; frame + 1 < options_.files.size(); ++frame) {
      Result<State> to = read_state(options_, frame + 1, from->assembly.unit_in_metres);
      if (!to) return to.error();
      if (auto same = compare(*from, *to, options_.files[frame], options_.files[frame + 1]); !same) return same.error();
      if (auto looked = look(frame, *from, *to); !looked) return looked.error();
      if (found_.truncated || (options_.earliest && found_.earliest)) break;
      *from = *std::move(to);
      if (options_.progress != nullptr) options_.progress->done.fetch_add(1);
    }
    return std::move(found_);
  }

 private:
  Result<void> look(std::uint32_t frame, const State& from, const State& to) {
    for (const auto& [i, j] : near(from, to)) {
      impinge::MotionOptions options;
      options.earliest = options_.earliest;
      if (options_.earliest && found_.earliest) options.end = found_.earliest->toi.hi;
      options.limit = options_.limit - std::min<std::uint64_t>(options_.limit, found_.impacts.size());
      options.threads = options_.threads;
      options.stop = options_.stop;
      const Moving a{from.meshes[i], to.meshes[i]}, b{from.meshes[j], to.meshes[j]};
      const Result<Impacts> impacts = i == j ? find_impacts(a, options) : find_impacts(a, b, options);
      if (!impacts) return impacts.error();
      take(frame, {i, j}, *impacts);
    }
    return {};
  }

  /// The pairs of parts that may meet, in order, and each part with itself where that is asked for: by a sweep along x.
  [[nodiscard]] std::vector<std::array<std::uint32_t, 2>> near(const State& from, const State& to) const {
    const auto lowest = [&](std::uint32_t i) { return std::min(from.extents[i].lo[0], to.extents[i].lo[0]); };
    const auto highest = [&](std::uint32_t i) { return std::max(from.extents[i].hi[0], to.extents[i].hi[0]); };
    std::vector<std::uint32_t> order(from.meshes.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::sort(order, {}, lowest);
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (std::size_t k = 0; k < order.size(); ++k) {
      const std::uint32_t i = order[k];
      if (options_.self) pairs.push_back({i, i});
      for (std::size_t l = k + 1; l < order.size() && lowest(order[l]) <= highest(i); ++l)
        if (may_meet(from, to, i, order[l])) pairs.push_back({std::min(i, order[l]), std::max(i, order[l])});
    }
    std::ranges::sort(pairs);
    return pairs;
  }

  void take(std::uint32_t frame, const std::array<std::uint32_t, 2>& objects, const Impacts& impacts) {
    const auto sooner = [](const SequenceTime& x, const SequenceTime& y) {
      return std::tie(x.frame, x.toi.lo, x.toi.hi) < std::tie(y.frame, y.toi.lo, y.toi.hi);
    };
    found_.truncated |= impacts.truncated;
    if (!impacts.earliest) return;
    const SequenceTime first{frame, *impacts.earliest};
    const bool is_first = !found_.earliest || sooner(first, *found_.earliest);
    if (is_first) found_.earliest = first;
    if (options_.earliest && !is_first) return;
    if (options_.earliest) found_.impacts.clear();
    for (const Impact& impact : impacts.impacts) found_.impacts.push_back({frame, objects, impact});
  }

  const ImpactOptions& options_;
  ImpactSequence found_;
};

constexpr std::string_view name_of(Feature feature) {
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
  document.member("settings", Json{{"self", options.self}, {"earliest", options.earliest}});
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
