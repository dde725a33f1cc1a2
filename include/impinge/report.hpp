// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "impinge/clash.hpp"
#include "impinge/io.hpp"
#include "impinge/options.hpp"
#include "impinge/result.hpp"

/// Reviews of assemblies: which parts clash, what is new since an earlier review, and the files that say so (JSON, CSV,
/// BCF, glTF and a page to look at). Link `impinge::report`.
namespace impinge::report {

/// So many of the run's units of length, or of those of a unit of its own.
struct Length {
  double value = 0;
  std::optional<double> unit_in_metres{};  ///< nothing: the run's unit
  Length() = default;
  Length(double of_run) : value(of_run) {}  // NOLINT(google-explicit-constructor): most lengths are plain numbers
  Length(double count, double metres) : value(count), unit_in_metres(metres) {}
  bool operator==(const Length&) const = default;
};

/// How files become one scene.
struct SceneOptions {
  std::vector<std::string> files;
  std::vector<std::pair<std::string, std::string>> ignored;  ///< names or patterns: such pairs are not tested
  std::vector<std::pair<std::string, double>> scales;        ///< of files; each at most once
  /// Of so many metres, to which the files whose own is known are brought; nothing: that of the first of them. Files
  /// whose unit is not known are taken to be in it.
  std::optional<double> unit_in_metres{};
  bool property_sets = false;                    ///< as `io::ReadOptions::property_sets`
  bool skip_unreadable = false;                  ///< go on without files that cannot be read
  std::uint64_t max_file_bytes = 2'000'000'000;  ///< larger files are refused unread
  int threads = 0;                               ///< at most so many; 0: all there are
  Progress* progress = nullptr;                  ///< counts steps of judging, or the frames of a motion
  std::stop_token stop{};
};

/// How an assembly is drawn on a page.
struct PageOptions {
  std::uint64_t page_triangles = 1'000'000;  ///< about so many are drawn at most
  std::optional<bool> y_up;                  ///< or Z, for other outputs too; nothing: by the files' formats
  /// The page's program; empty: at `IMPINGE_PAGE`, beside the running program, as installed, or as built.
  std::string page_program{};
};

/// Which pairs fail.
struct FailOn {
  bool contact = false;      ///< whatever is not apart
  bool penetration = false;  ///< duplicate, penetrating and crossing
  bool inside = false;
  bool clearance = false;  ///< apart, and nearer than the clearance
  bool fresh = false;      ///< and of all these only what is new since the previous report
};

/// Of the BCF that is written.
enum class BcfVersion : std::uint8_t { v2_1, v3_0 };

/// How pairs are put together in tables and documents.
enum class GroupBy : std::uint8_t { none, part, type, test };

/// What a review looks for, and how its documents are written.
struct ReportOptions : SceneOptions, PageOptions {
  std::optional<Length> tolerance;  ///< as `ClashOptions::tolerance`
  Length clearance;                 ///< as `ClashOptions::clearance`
  double depth_precision = 0.05;    ///< as `ClashOptions::depth_precision`
  bool regions = false;             ///< find regions of contact
  bool volumes = false;             ///< as `ClashOptions::volumes`
  std::string backend = "simd";     ///< as `ClashOptions::backend`
  FailOn fail_on{.penetration = true, .inside = true};
  bool within_products = false;  ///< test the parts of one IFC product against each other
  /// Two of the files: only pairs of a part of the one and a part of the other are judged.
  std::optional<std::pair<std::string, std::string>> between;
  std::optional<std::string> config;     ///< the file of a configuration with named tests (docs/triage.md)
  std::optional<std::string> previous;   ///< the JSON of an earlier report, to compare with
  std::optional<std::string> decisions;  ///< a file of what people decided about pairs (docs/triage.md)
  GroupBy group_by = GroupBy::none;
  std::string date = "1970-01-01T00:00:00Z";  ///< of the BCF's topics, in UTC
  std::string author = "impinge";             ///< of the BCF's topics and comments
  std::string due;                            ///< of the BCF's topics, as `date`; "" for none
  std::string stage;                          ///< of the project, in the BCF's topics; "" for none
  BcfVersion bcf_version = BcfVersion::v2_1;
  std::uint64_t topics = 1'000;  ///< of the BCF, at most
};

/// When the parts of an animated file are looked at, and what counts as a clash.
struct TimelineOptions : SceneOptions, PageOptions {
  std::uint32_t frames = 120;                           ///< steps of equal length, at least 1
  std::optional<std::string> animation;                 ///< its name or number; nothing: the first
  std::optional<Length> tolerance;                      ///< as `ClashOptions::tolerance`
  double depth_precision = 0.05;                        ///< as `ClashOptions::depth_precision`
  FailOn fail_on{.penetration = true, .inside = true};  ///< which verdicts are a clash; `clearance` is none of them
};

/// The objects of all files, numbered over the files in their order.
struct Assembly {
  std::vector<std::string> files;
  std::vector<io::Object> objects;
  std::vector<io::Group> groups;       ///< those of all files, numbered over the files as well
  std::vector<io::Grid> grids;         ///< those of all files
  std::vector<std::uint32_t> file_of;  ///< for each object
  std::vector<std::string> labels;     ///< for each object, what a person is shown; printable
  std::vector<std::string> warnings;
  /// Sentences on how the files were brought to one unit and one upward axis, and what speaks against it.
  std::vector<std::string> alignment;
  std::vector<std::string> missing;  ///< of the files, with their names: no answer is about it
  std::vector<std::string> skipped;  ///< files that could not be read, by `SceneOptions::skip_unreadable`
  std::uint64_t triangles = 0;
  std::optional<double> unit_in_metres{};  ///< metres in one of the coordinates' units; nothing: nobody said it
};

/// The objects of several files, as they were read.
Assembly assemble(const std::vector<std::string>& files, std::vector<io::Model> models);

/// Called with the number of each file before it is read, and after: one call at a time, but from several threads and
/// in no order. It must not throw.
using FileProgress = std::function<void(std::size_t file, bool is_read)>;

/// Reads `options.files`, several at once, whose units are brought to that of the options. Errors: those of `io::read`,
/// of several the first file's; with `skip_unreadable` only if no file can be read.
Result<Assembly> read_assembly(
    const SceneOptions& options, const FileProgress& progress = [](std::size_t, bool) {});

struct Review;  // internal

/// Which parts of an assembly clash, which of these pairs fail, and what is new since an earlier report.
class Report {
 public:
  explicit Report(std::unique_ptr<const Review> review) noexcept;  // internal
  ~Report();
  Report(Report&&) noexcept;
  Report& operator=(Report&&) noexcept;

  [[nodiscard]] const Assembly& assembly() const noexcept;
  /// By (object, object), and each pair in the order of the named tests.
  [[nodiscard]] const std::vector<Clash>& pairs() const noexcept;
  /// The numbers of the pairs, the worst first.
  [[nodiscard]] std::vector<std::size_t> worst_first() const;
  /// A UUID that a pair keeps from one revision of the files to the next, as long as its parts keep their names.
  [[nodiscard]] const std::string& id(std::size_t pair) const;
  [[nodiscard]] bool fails(std::size_t pair) const;
  /// Whether the earlier report did not list the pair, or it did not fail then and does now.
  [[nodiscard]] bool is_new(std::size_t pair) const;
  [[nodiscard]] std::uint64_t failing() const;
  /// Sentences on what the files, the configuration and the earlier report leave in doubt.
  [[nodiscard]] std::vector<std::string> warnings() const;

  [[nodiscard]] const Review& internal() const noexcept { return *review_; }

 private:
  std::unique_ptr<const Review> review_;
};

/// Reads the files that the options and their configuration name, and finds what clashes. Errors: those of reading
/// them; `bad_file` and `bad_option` (a configuration or an earlier report that cannot be used, or a length in a unit
/// where the files' is not known); those of
/// `find_clashes`.
Result<Report> review(const ReportOptions& options);
/// The same of an assembly at hand; files that the configuration names are not read. Its unit, if it has none, is that
/// of the options.
Result<Report> review(Assembly assembly, const ReportOptions& options);
/// The same of clashes that are known: what `find_clashes` found in a scene of the assembly's objects, in their order.
/// The options say how, and what fails; nothing is judged again. Errors: `bad_option` (a configuration, or `between`,
/// which would judge; clashes of other objects), and those of reading an earlier report and decisions.
Result<Report> review(Assembly assembly, Clashes clashes, const ReportOptions& options);

/// Write a report to a file, which appears whole or not at all; "-" is standard output. Regions and distances
/// are written where the review's options asked for them. Errors: `bad_file`; `cancelled`, by the review's
/// `stop`. The formats are described in docs/reports.md; the page needs its program (`./dev page`).
Result<void> write_json(const Report& report, const std::string& file);
Result<void> write_csv(const Report& report, const std::string& file);
Result<void> write_matrix(const Report& report, const std::string& file);
Result<void> write_bcf(const Report& report, const std::string& file);
Result<void> write_gltf(const Report& report, const std::string& file);
Result<void> write_page(const Report& report, const std::string& file);

/// A time between two at which the parts were looked at: before it they were on one side, after it on the other.
struct Moment {
  double lo = 0, hi = 0;  ///< seconds
};

/// How long two parts clash without a break that was seen.
struct ClashSpan {
  std::array<std::uint32_t, 2> objects{};
  std::optional<Moment> from, to;             ///< nothing: from the first frame, to the last
  std::optional<Point> point;                 ///< of contact at `from->hi`: the centroid of the largest region
  Verdict worst = Verdict::apart;             ///< of the frames
  int inner = -1;                             ///< then, as `Clash::inner`
  double worst_at = 0;                        ///< seconds: of the first such frame, by the rank of a table
  double fails_below = 0;                     ///< then, as `Clash::fails_below`
  std::optional<OverlapDepth> overlap_depth;  ///< then
  Note note = Note::none;                     ///< then
};

struct Timeline {
  std::vector<double> times;     ///< of the frames
  std::vector<ClashSpan> spans;  ///< by (object, object, from)
};

/// When parts that move clash: looks at every frame for pairs that do, and halves the time between two frames of which
/// one clashes and one does not, down to a millionth of a frame's step. Between two frames it follows parts that keep
/// their shape from pose to pose on a screw (`time_of_impact`), and judges them where they meet: a clash that begins
/// and ends there is seen, the first of each pair, unless they touch at both frames or move otherwise. The animation is
/// one of the model's. Errors: `bad_file` (coordinates that are not finite, or a part that is flat at rest, with its
/// name); `bad_option` (a pair to ignore that is none, or a tolerance in a unit where the model's is not known); those
/// of `find_clashes`.
Result<Timeline> find_timeline(const io::Model& model, const io::Animation& animation,
                               const TimelineOptions& options = {});

}  // namespace impinge::report
