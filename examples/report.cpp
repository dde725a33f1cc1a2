// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// Reading files and writing a report: the parts of an assembly come from files, and what clashes goes into documents
// for people and other programs.
//
// The peg, a cube of side 1, reaches 0.25 into the block, another one; the shelf stands flush against the block. What
// penetrates fails, and what only touches does not, unless `ReportOptions::fail_on` says so.
//
// prints: block, peg: penetrating, fails
// prints: block, shelf: touching
// prints: 1 of 2 pairs fails
#include "impinge/report.hpp"

#include <fstream>

#include "shapes.hpp"

namespace {

/// Writes a cube of side 1, its lowest corner at (x, 0, 0), as an OFF file in the current folder; returns the name.
std::string write_cube(const std::string& name, double x) {
  std::ofstream out(name);
  out << "OFF\n8 6 0\n";
  for (const double z : {0, 1})
    for (const double y : {0, 1}) out << x << ' ' << y << ' ' << z << '\n' << x + 1 << ' ' << y << ' ' << z << '\n';
  out << "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
  return name;
}

}  // namespace

int main() {
  const impinge::report::ReportOptions options{
      {.files = {write_cube("block.off", 0), write_cube("peg.off", 0.75), write_cube("shelf.off", -1)}}};
  const impinge::report::Report report = value_of(impinge::report::review(options));

  for (const std::size_t i : report.worst_first()) {
    const auto [a, b] = report.pairs()[i].objects;
    std::cout << report.assembly().labels[a] << ", " << report.assembly().labels[b] << ": "
              << impinge::name(report.pairs()[i].verdict) << (report.fails(i) ? ", fails\n" : "\n");
  }
  if (const auto written = impinge::report::write_json(report, "report.json"); !written) {
    std::cerr << written.error().message << '\n';
    return 1;
  }
  std::cout << report.failing() << " of " << report.pairs().size() << " pairs fails\n";
}
