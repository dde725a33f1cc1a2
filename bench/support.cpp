// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/support.hpp"

#include <malloc.h>
#include <sched.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string_view>

namespace impinge::bench {
namespace {

constexpr std::array kTimes{&Statistics::measured_seconds,  &Statistics::predicted_seconds, &Statistics::broad_seconds,
                            &Statistics::hierarchy_seconds, &Statistics::partition_seconds, &Statistics::narrow_seconds,
                            &Statistics::exact_seconds,     &Statistics::results_seconds,   &Statistics::total_seconds};
constexpr std::array kCounts{&Statistics::object_pairs,   &Statistics::bounds_updated,   &Statistics::border_moves,
                             &Statistics::sphere_tests,   &Statistics::triangles_sorted, &Statistics::box_tests,
                             &Statistics::element_tests,  &Statistics::nodes_built,      &Statistics::leaf_pairs,
                             &Statistics::triangle_pairs, &Statistics::exact_calls};

}  // namespace

Arguments parse_arguments(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--quick")
      arguments.quick = true;
    else if (arguments.folder.empty() && argv[i][0] != '-')
      arguments.folder = argv[i];
    else
      fail(std::string(argv[i]) + " is unknown; usage: " + argv[0] + " [--quick] FOLDER");
  }
  if (arguments.folder.empty()) fail(std::string("usage: ") + argv[0] + " [--quick] FOLDER");
  std::filesystem::create_directories(arguments.folder);
  return arguments;
}

void fail(const std::string& sentence) {
  std::fprintf(stderr, "bench: %s\n", sentence.c_str());
  std::exit(2);
}

void pin_to_one_core() {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) fail("cannot ask which cores may be used");
  int last = -1;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(core, &allowed)) last = core;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(last, &one);
  if (sched_setaffinity(0, sizeof one, &one) != 0) fail("cannot stay on core " + std::to_string(last));
}

Spread spread(std::vector<double> values) {
  if (values.empty()) fail("there is nothing to take the median of");
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  const double middle = values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
  return {values.front(), middle, values.back()};
}

double thread_seconds() {
  timespec now{};
  if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) != 0) fail("cannot read the thread's clock");
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::size_t heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

Statistics median(const std::vector<Statistics>& repeats) {
  Statistics result = repeats.at(0);
  for (const auto time : kTimes) {
    std::vector<double> values;
    for (const Statistics& s : repeats) values.push_back(s.*time);
    result.*time = median(std::move(values));
  }
  return result;
}

void add(Statistics& sum, const Statistics& statistics) {
  for (const auto time : kTimes) sum.*time += statistics.*time;
  for (const auto number : kCounts) sum.*number += statistics.*number;
}

void Table::add(std::vector<std::string> cells) {
  if (cells.size() != rows_.front().size()) fail("a row of the table has too few or too many cells");
  for (const std::string& cell : cells)
    if (cell.find(',') != std::string::npos) fail("a cell holds a comma: " + cell);
  rows_.push_back(std::move(cells));
}

void Table::write(const std::filesystem::path& folder, const std::string& name) const {
  std::ofstream file(folder / (name + ".csv"));
  std::printf("\n%s\n", name.c_str());
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      file << (i == 0 ? "" : ",") << row[i];
      std::printf("%s%s", i == 0 ? "  " : " | ", row[i].c_str());
    }
    file << '\n';
    std::printf("\n");
  }
  std::fflush(stdout);
  if (!file.flush()) fail("cannot write " + (folder / (name + ".csv")).string());
}

std::string digits(double value) {
  const int whole = value == 0 ? 1 : static_cast<int>(std::floor(std::log10(std::fabs(value)))) + 1;
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", std::max(0, 3 - whole), value);
  return text;
}

std::string count(std::uint64_t value) { return std::to_string(value); }

std::string percent(double part, double whole) {
  char text[64];
  std::snprintf(text, sizeof text, "%.1f %%", whole == 0 ? 0 : 100 * part / whole);
  return text;
}

Mesh make_mesh(const scenes::MeshData& data, const TreeConfig& tree) {
  return must(Mesh::create(std::span<const double>(data.xyz), data.triangles, tree));
}

Mesh without_tree(const Mesh& mesh, const TreeConfig& tree) { return make_mesh(numbers_of(mesh), tree); }

scenes::MeshData numbers_of(const Mesh& mesh) {
  scenes::MeshData data;
  for (const Point& p : mesh.vertices()) data.add_vertex(p.x, p.y, p.z);
  for (const auto& t : mesh.triangles()) data.add_triangle(t[0], t[1], t[2]);
  return data;
}

}  // namespace impinge::bench
