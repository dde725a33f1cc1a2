// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "impinge/contacts.hpp"
#include "impinge/mesh.hpp"
#include "impinge/result.hpp"
#include "scenes/scene.hpp"

/// What every benchmark needs: arguments, a pinned core, clocks, medians and tables.
namespace impinge::bench {

/// `bench_NAME [--quick] FOLDER`; the tables go into the folder.
struct Arguments {
  bool quick = false;
  std::filesystem::path folder;
};

/// Ends the program with a sentence if they make no sense.
Arguments parse_arguments(int argc, char** argv);

/// What a program measures: each defines its own, and main.cpp calls it.
void bench_main(const Arguments& arguments);

/// Keeps this process, and the threads that it will make, on the last core that it may use. The same core serves
/// whatever is compared.
void pin_to_one_core();

/// Ends the program with a sentence; a benchmark that goes wrong has no figures.
[[noreturn]] void fail(const std::string& sentence);

template <class T>
T must(Result<T> result) {
  if (!result.has_value()) fail(result.error().message);
  if constexpr (!std::is_void_v<T>) return std::move(result).value();
}

/// The calling thread's own processor time: what other processes take away does not show. For work on one thread.
double thread_seconds();

template <class Work>
double seconds_of(const Work& work) {
  const double start = thread_seconds();
  work();
  return thread_seconds() - start;
}

/// Wall clock, for work that waits for a child process or a device.
template <class Work>
double wall_seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// What the C library's heap has given out.
std::size_t heap_bytes();

struct Spread {
  double low, median, high;
};
Spread spread(std::vector<double> values);
inline double median(std::vector<double> values) { return spread(std::move(values)).median; }

/// Time by time the median over repeats of one query; the counts are those of the first.
Statistics median(const std::vector<Statistics>& repeats);
/// Everything added up, over different queries.
void add(Statistics& sum, const Statistics& statistics);

/// A CSV file that reads as a table: names in the first row, no quoting, so cells hold no commas.
class Table {
 public:
  explicit Table(std::vector<std::string> columns) : rows_{std::move(columns)} {}
  void add(std::vector<std::string> cells);
  /// Writes FOLDER/NAME.csv, and the same to standard output.
  void write(const std::filesystem::path& folder, const std::string& name) const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// Three significant digits, never in powers of ten.
std::string digits(double value);
std::string count(std::uint64_t value);
std::string percent(double part, double whole);
inline std::string milliseconds(double seconds) { return digits(1e3 * seconds); }
inline std::string nanoseconds(double seconds) { return digits(1e9 * seconds); }

Mesh make_mesh(const scenes::MeshData& data, const TreeConfig& tree = {});
/// The same numbers with a tree not yet built.
Mesh without_tree(const Mesh& mesh, const TreeConfig& tree = {});
scenes::MeshData numbers_of(const Mesh& mesh);
/// A file of Debian's libcgal-demo, as scripts/fetch_data.sh unpacks it.
scenes::MeshData demo_mesh(const std::string& file);

}  // namespace impinge::bench
