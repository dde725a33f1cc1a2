// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// impinge-gpu-figures: one table of what a GPU is worth here, to standard output.
#include "bench/gpu_figures.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <set>
#include <string_view>
#include <thread>

#include "bench/device.hpp"
#include "bench/support.hpp"
#include "impinge/version.hpp"

namespace impinge::bench {
namespace {

constexpr const char* kHelp = R"(Measures impinge on the CPU, on a GPU and on both at once, and prints one table; the
paper's experiment in image space too.

  impinge-gpu-figures [--quick] [--software] [--device DEVICE] [--only TEXT] [--detail]

  --quick          small cases and few repeats: to see whether it works, in under a minute
  --software       measure a software driver (lavapipe, SwiftShader) too; its times say nothing about a GPU
  --device DEVICE  its number among the devices, or part of its name; without it IMPINGE_DEVICE, or the first
  --only TEXT      the cases whose name contains it
  --detail         a second table: where a query's time on the GPU goes, and who answered the hybrid ones

Nothing but a Vulkan driver need be installed. Progress goes to standard error if that is a terminal.
Exit status: 0, or 2 if something failed, an answer that differs between two backends above all.
)";

struct Wishes {
  bool is_quick = false, allows_software = false, is_detailed = false;
  std::string device, only, command;
};

Wishes parse(int argc, char** argv) {
  Wishes wishes;
  const char* const said = std::getenv("IMPINGE_FIGURES_COMMAND");  // by scripts/gpu-figures.sh
  wishes.command = said != nullptr ? said : "impinge-gpu-figures";
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    const auto value = [&] {
      if (i + 1 == argc) fail(std::string(word) + " needs a value");
      return std::string(argv[++i]);
    };
    if (said == nullptr) wishes.command += " " + std::string(word);
    if (word == "--help" || word == "-h") {
      std::fputs(kHelp, stdout);
      std::exit(0);
    } else if (word == "--quick") {
      wishes.is_quick = true;
    } else if (word == "--software") {
      wishes.allows_software = true;
    } else if (word == "--detail") {
      wishes.is_detailed = true;
    } else if (word == "--device") {
      wishes.device = value();
    } else if (word == "--only") {
      wishes.only = value();
    } else {
      fail(std::string(word) + " is unknown; see --help");
    }
    if (said == nullptr && (word == "--device" || word == "--only"))
      wishes.command += " '" + std::string(argv[i]) + "'";
  }
  return wishes;
}

std::string processor() {
  std::ifstream lines("/proc/cpuinfo");
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("model name") && line.find(": ") != std::string::npos) return line.substr(line.find(": ") + 2);
  return "unknown processor";
}

/// What the kernel would give to a program now.
double free_gigabytes() {
  std::ifstream words("/proc/meminfo");
  for (std::string word; words >> word;)
    if (double kilobytes = 0; word == "MemAvailable:" && words >> kilobytes) return 1e-6 * 1.024 * kilobytes;
  return 0;
}

constexpr std::array<std::string_view, 4> kBackends{"simd", "gpu", "hybrid", "raster"};

/// How many of them are asked: "raster", the paper's image space, in the paper's cases alone.
std::size_t backends_for(const Case& entry) { return entry.is_papers ? kBackends.size() : kBackends.size() - 1; }

double sum(const std::vector<Statistics>& queries, double Statistics::*time) {
  double seconds = 0;
  for (const Statistics& query : queries) seconds += query.*time;
  return seconds;
}

/// The predicted and the actual milliseconds of a hybrid query's two sides; nothing for one that did nothing. The CPU's
/// are its threads' own times added up, which its cost function speaks of.
std::vector<std::string> sides(const std::vector<Statistics>& queries) {
  std::vector<std::string> cells;
  for (const auto time : {&Statistics::predicted_seconds, &Statistics::measured_seconds,
                          &Statistics::device_predicted_seconds, &Statistics::device_seconds}) {
    const double seconds = sum(queries, time) / static_cast<double>(queries.size());
    cells.push_back(seconds > 0 ? milliseconds(seconds) : "-");
  }
  return cells;
}

/// What one backend did on a case.
struct Measured {
  std::vector<double> seconds, device_seconds;  ///< a repeat each
  Answer answer;                                ///< of the last repeat
  std::string ways;                             ///< of each repeat's last query, the warm-up's too
  Workspace workspace;
};

/// Who did a query's work: d for the device, c for the CPU, b for both.
char way_of(const Statistics& query) {
  if (query.device_seconds == 0) return 'c';
  return query.cpu_seconds == 0 ? 'd' : 'b';
}

class Report {
 public:
  Report(const Wishes& wishes, std::size_t cases)
      : wishes_(wishes), target_(choose_device(wishes.device, wishes.allows_software)), cases_(cases) {}

  void head() const {
    std::printf("Machine: %s, %u cores; device: %s; impinge %s\n\n", processor().c_str(),
                std::thread::hardware_concurrency(), target_.line.c_str(), IMPINGE_VERSION);
    std::printf("Command: `%s`\n\n", wishes_.command.c_str());
    line({"case", "triangles", "contacts", "simd ms", "gpu ms", "hybrid ms", "raster ms", "hybrid / better",
          "CPU predicted ms", "CPU ms", "device predicted ms", "device ms"});
    line({"---", "---:", "---:", "---:", "---:", "---:", "---:", "---:", "---:", "---:", "---:", "---:"});
  }

  void add(const Case& entry) {
    ++case_;
    if (entry.gigabytes > free_gigabytes()) {
      notes_.insert(entry.name + ": left out, for it takes " + digits(entry.gigabytes) + " GB of memory");
      return line({entry.name, "-", "-", kNone, kNone, kNone, "-", "-", "-", "-", "-", "-"});
    }
    progress(entry.name + ": make it");
    const Question question = entry.make();
    std::vector<Measured> measured = measure(entry, question);
    std::vector<std::string> cells{entry.name, question.triangles,
                                   grouped(measured[0].answer.contacts / static_cast<std::uint64_t>(question.queries))};
    for (std::size_t i = 0; i < kBackends.size(); ++i)
      cells.push_back(cell(entry, measured, i, milliseconds(time(measured, i) / question.queries)));
    const bool is_whole = has(measured, 1) && has(measured, 2);
    cells.push_back(is_whole ? digits(time(measured, 2) / std::min(time(measured, 0), time(measured, 1))) : "-");
    for (const std::string& side :
         is_whole ? predicted(question, measured[2].workspace) : std::vector<std::string>(4, "-"))
      cells.push_back(side);
    line(cells);
    if (is_whole) add_detail(entry, question, measured);
    if (entry.is_rated) rates(entry, measured, question.triangles);
  }

  void foot() const {
    clear_progress();
    std::printf(
        "\nMedians of wall clock, repeats of the backends in turns; meshes are on the device and shaders compiled "
        "before, but for raw vertices. ");
    if (target_.option.empty()) {
      std::printf("Not measured: there is no GPU to measure on.\n");
    } else {
      std::printf("The answers of all backends are the same in every case.\n");
    }
    for (const std::string& note : notes_) std::printf("Note: %s.\n", note.c_str());
    if (!wishes_.is_detailed) return;
    std::printf(
        "\nWhere the time of a gpu query goes, and who answered each hybrid one in turn: c(pu), d(evice), b(oth).\n\n");
    line({"case", "triangles", "gpu ms", "device's part", "of it waiting", "taking in", "hybrid ways"});
    line({"---", "---:", "---:", "---:", "---:", "---:", "---"});
    for (const auto& cells : details_) line(cells);
  }

 private:
  static constexpr const char* kNone = "not measured";

  /// A device took part, and the CPU did nothing in its stead.
  static bool has(const std::vector<Measured>& measured, std::size_t backend) {
    return backend < measured.size() && measured[backend].answer.warnings.empty();
  }
  static double time(const std::vector<Measured>& measured, std::size_t backend) {
    return backend < measured.size() ? median(measured[backend].seconds) : 0;
  }
  static std::string cell(const Case& entry, const std::vector<Measured>& measured, std::size_t backend,
                          std::string figure) {
    if (backend >= backends_for(entry)) return "-";
    if (backend >= measured.size()) return kNone;
    return has(measured, backend) ? std::move(figure) : "left to the CPU";
  }

  std::vector<Measured> measure(const Case& entry, const Question& question) {
    // Enough for a median, but no case takes the whole evening.
    const int most = wishes_.is_quick ? 3 : 9, least = 3;
    constexpr double kEnough = 10;  // seconds
    std::vector<Measured> measured(target_.option.empty() ? 1 : backends_for(entry));
    double spent = 0;
    for (int repeat = -1; repeat < most && (repeat < least || spent < kEnough); ++repeat) {
      for (std::size_t i = 0; i < measured.size(); ++i) {
        const bool counts = repeat >= 0;  // the first one uploads meshes and compiles shaders
        const std::string turn = counts ? std::to_string(repeat + 1) : "warm-up";
        progress(entry.name + ": " + std::string(kBackends[i]) + ", " + turn);
        Measured& backend = measured[i];
        backend.answer = question.ask(options(kBackends[i]), backend.workspace);
        compare(entry.name, measured[0].answer, backend.answer, kBackends[i]);
        backend.ways += way_of(backend.answer.statistics.back());
        if (!counts) continue;
        backend.seconds.push_back(backend.answer.seconds);
        backend.device_seconds.push_back(sum(backend.answer.statistics, &Statistics::device_seconds));
        spent += backend.answer.seconds;
      }
    }
    for (const Measured& backend : measured)
      notes_.insert(backend.answer.warnings.begin(), backend.answer.warnings.end());
    return measured;
  }

  static void compare(const std::string& name, const Answer& a, const Answer& b, std::string_view backend) {
    if (a.fingerprint == b.fingerprint && a.contacts == b.contacts) return;
    fail(name + ": " + std::string(backend) + " answers other than simd: " + grouped(b.contacts) + " contacts, not " +
         grouped(a.contacts) + ", hash " + std::to_string(b.fingerprint) + ", not " + std::to_string(a.fingerprint));
  }

  /// One more hybrid query, which says what it expected; the timed ones, in the same workspace, do without.
  std::vector<std::string> predicted(const Question& question, Workspace& workspace) const {
    Options with = options("hybrid");
    with.predict_cost = true;
    return sides(question.ask(with, workspace).statistics);
  }

  void add_detail(const Case& entry, const Question& question, const std::vector<Measured>& measured) {
    std::vector<std::string> cells{entry.name, question.triangles, milliseconds(time(measured, 1) / question.queries)};
    for (const auto part : {&Statistics::device_seconds, &Statistics::device_wait_seconds, &Statistics::exact_seconds})
      cells.push_back(milliseconds(sum(measured[1].answer.statistics, part) / question.queries));
    cells.push_back(measured[2].ways);
    details_.push_back(std::move(cells));
  }

  void rates(const Case& entry, const std::vector<Measured>& measured, const std::string& triangles) const {
    const auto row = [&](const char* name, auto seconds_of) {
      std::vector<std::string> cells{name, triangles, "-"};
      for (std::size_t i = 0; i < kBackends.size(); ++i) {
        std::optional<double> seconds;
        if (i < measured.size()) seconds = seconds_of(i);
        double pairs = 0;
        if (seconds)
          for (const Statistics& s : measured[i].answer.statistics) pairs += static_cast<double>(s.triangle_pairs);
        cells.push_back(cell(entry, measured, i, seconds ? digits(1e-6 * pairs / *seconds) : "-"));
      }
      cells.insert(cells.end(), 5, "-");
      line(cells);
    };
    row("its pairs of triangles tested, million a second of the query",
        [&](std::size_t i) { return std::optional(time(measured, i)); });
    row("its pairs of triangles tested, million a second of the device's part", [&](std::size_t i) {
      const double seconds = i == 1 ? median(measured[i].device_seconds) : 0;
      return seconds > 0 ? std::optional(seconds) : std::nullopt;
    });
  }

  [[nodiscard]] Options options(std::string_view backend) const {
    return {.backend = backend, .device = backend == "simd" ? std::string_view() : std::string_view(target_.option)};
  }

  void progress(const std::string& what) const {
    if (is_watched_) std::fprintf(stderr, "\r[%zu/%zu] %s\033[K", case_, cases_, what.c_str());
  }
  void clear_progress() const {
    if (is_watched_) std::fputs("\r\033[K", stderr);
  }
  void line(const std::vector<std::string>& cells) const {
    clear_progress();
    for (const std::string& text : cells) std::printf("| %s ", text.c_str());
    std::printf("|\n");
    std::fflush(stdout);
  }

  const Wishes& wishes_;
  TargetDevice target_;
  std::size_t cases_, case_ = 0;
  std::set<std::string> notes_;
  std::vector<std::vector<std::string>> details_;
  bool is_watched_ = isatty(STDERR_FILENO) == 1;
};

}  // namespace
}  // namespace impinge::bench

int main(int argc, char** argv) {
  using namespace impinge::bench;
  const Wishes wishes = parse(argc, argv);
  std::vector<Case> cases = figure_cases(wishes.is_quick);
  std::erase_if(cases, [&](const Case& entry) { return entry.name.find(wishes.only) == std::string::npos; });
  if (cases.empty()) fail("no case is called '" + wishes.only + "'");
  Report report(wishes, cases.size());
  report.head();
  for (const Case& entry : cases) report.add(entry);
  report.foot();
}
