// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "impinge/clash.hpp"
#include "report/comparison/standing.hpp"

namespace impinge::report {

/// What comparing with an earlier run needs of its JSON (docs/cli.md, "The JSON of clash").
struct Previous {
  struct OldRegion {
    std::string id;
    Point centroid{};
    double half_diagonal = 0;  ///< of its box
  };
  struct Pair {
    std::string id;
    OldPart a, b;
    std::string test;  ///< empty: none
    Verdict verdict = Verdict::apart;
    std::optional<Point> middle;  ///< of its largest region, or of its nearest points
    bool has_regions = false;     ///< the earlier run looked for them
    std::vector<OldRegion> regions;
  };
  struct OldFile {
    std::string file;      ///< as the objects name it
    std::string name;      ///< as `names_of_files` of that run
    std::string known_as;  ///< the name that it had before it was renamed, or the same
  };
  std::optional<double> unit_in_metres;
  std::vector<OldFile> files;
  std::vector<OldPart> parts;
  std::vector<Pair> pairs;
};

/// Errors: `bad_file`, with the line and the place.
Result<Previous> read_previous(const std::string& name, std::uint64_t most_bytes);
Result<Previous> parse_previous(const std::string& name, const std::string& text);

/// What a review knows of its pairs, as matching needs it.
struct Found {
  const std::vector<Clash>& pairs;
  const std::vector<std::string>& ids;               ///< of the pairs
  std::function<double(const Clash&)> slack;         ///< how far a region may move beyond its own size
  std::function<bool(const Clash&, Verdict)> names;  ///< whether this verdict on the pair would be a failure
};

/// Compares the pairs and their regions with those of the previous run, which may be null: then only the regions get
/// their ids. A pair is known by its id. Its regions are matched by their centroids, the nearest two first. Pairs and
/// regions that are gone are appended to `resolved`.
std::vector<Standing> compare(const Found& found, const Previous* previous, std::vector<Resolved>& resolved);

}  // namespace impinge::report
