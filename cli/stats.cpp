// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include "report/text.hpp"
#include "table.hpp"
#include "tables.hpp"

namespace impinge::cli {
namespace {

void print_rows(Sink& sink, const std::vector<Column>& columns, const std::vector<std::vector<std::string>>& rows) {
  Table table{rows.size(), columns};
  for (std::size_t column = 0; column < columns.size(); ++column)
    table.columns[column].text_of = [&rows, column](std::size_t row) { return rows[row][column]; };
  print(table, sink, std::nullopt);
}

}  // namespace

void print_statistics(const Statistics& s, Sink& sink) {
  using enum Column::Kind;
  sink.write("\nStages (threads' own times added up)\n");
  print_rows(
      sink,
      {{"stage", text, {}},
       {"the paper's", text, {}},
       {"time", number, {}},
       {"count", number, {}},
       {"what was counted", text, {}}},
      {{"broad", "3.1, 3.2", duration(s.broad_seconds), grouped(s.object_pairs), "pairs of objects left"},
       {"hierarchy", "3.3", duration(s.hierarchy_seconds), grouped(s.leaf_pairs), "pairs of leaves left"},
       {"partition", "3.5", duration(s.partition_seconds), grouped(s.triangle_pairs), "pairs of triangles left"},
       {"narrow", "3.4", duration(s.narrow_seconds), grouped(s.exact_calls), "pairs of triangles left undecided"},
       {"exact", "", duration(s.exact_seconds), grouped(s.exact_calls), "pairs of triangles decided"},
       {"results", "", duration(s.results_seconds), "", ""},
       {"wall clock", "", duration(s.total_seconds), "", "of the whole query"}});

  const auto cost = [](const char* name, std::uint64_t count, double each) {
    return std::vector<std::string>{name, grouped(count), duration(each), duration(static_cast<double>(count) * each)};
  };
  sink.write("\nCost T, the paper's equation 1: the sum of N C (C measured on this machine)\n");
  print_rows(sink, {{"", text, {}}, {"N", number, {}}, {"C", number, {}}, {"N C", number, {}}},
             {cost("b: objects whose sorted borders were written", s.bounds_updated, s.bounds_update_seconds),
              cost("m: borders moved past others", s.border_moves, s.border_move_seconds),
              cost("s: tests of two objects' bounds", s.sphere_tests, s.sphere_test_seconds),
              cost("o: pairs of objects that may touch", s.object_pairs, s.object_pair_seconds),
              cost("v: tests of two bounding boxes", s.box_tests, s.box_test_seconds),
              cost("p: tests of two triangles, or of an edge and one", s.element_tests, s.element_test_seconds),
              cost("u: tree nodes built", s.nodes_built, s.node_seconds),
              cost("t: triangles sorted into them", s.triangles_sorted, s.sorted_triangle_seconds),
              cost("l: pairs of leaves parted into triangles", s.leaf_pairs, s.leaf_pair_seconds),
              cost("e: pairs of triangles left to exact arithmetic", s.exact_calls, s.exact_call_seconds),
              {"T predicted", "", "", duration(s.predicted_seconds)},
              {"T measured", "", "", duration(s.measured_seconds)}});
  if (s.images_drawn > 0) {
    sink.write("\nImage space (3.4)\n");
    print_rows(sink, {{"", text, {}}, {"", number, {}}},
               {{"images drawn", grouped(s.images_drawn)},
                {"of them begun before the one before was waited for", grouped(s.images_overlapped)},
                {"of them with a test that the occlusion query saw", grouped(s.images_read)},
                {"time that the device had an image", duration(s.device_seconds)},
                {"of it, while the CPU made other batches", duration(s.device_seconds - s.device_wait_seconds)},
                {"and while it waited", duration(s.device_wait_seconds)}});
    return;
  }
  if (s.device_seconds == 0) return;
  sink.write("\nSides (by the clock; the counts above are both sides' together, T is the CPU's)\n");
  print_rows(sink, {{"side", text, {}}, {"predicted", number, {}}, {"time", number, {}}},
             {{"device", duration(s.device_predicted_seconds), duration(s.device_seconds)},
              {"CPU beside it", "", duration(s.cpu_seconds)}});
}

}  // namespace impinge::cli
