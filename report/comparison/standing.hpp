// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "impinge/clash.hpp"

/// What a review says of a clash beside what it is: whether it fails, whether it is new, and what people wrote about
/// it.
namespace impinge::report {

/// Since the previous run.
enum class Change : std::uint8_t {
  unknown,  ///< there is no previous run
  fresh,    ///< it was not there; or it did not fail then, and does now
  persisting,
};

/// What people wrote; taken over from run to run as it is.
struct Remark {
  std::string status, comment;
  [[nodiscard]] bool is_empty() const { return status.empty() && comment.empty(); }
};

struct RegionStanding {
  std::string id;
  Change change = Change::unknown;
  Remark remark;
};

/// Of a pair.
struct Standing {
  bool fails = false;
  Change change = Change::unknown;
  std::optional<Verdict> was;  ///< in the previous run
  Remark remark;
  std::vector<RegionStanding> regions;  ///< in the order of the pair's own
};

/// A part of an earlier run, which need not be there any more.
struct OldPart {
  std::string name, path, file;
  std::string placed;  ///< as `Identity::placed`; empty where the report does not say
};

/// A clash that is there no more: a pair, or one region of a pair that stayed. Or one whose remarks cannot be given to
/// any pair.
struct Resolved {
  std::string id;      ///< the pair's
  std::string region;  ///< the region's id; empty: the whole pair
  OldPart a, b;
  std::string test;  ///< empty: none
  Verdict verdict = Verdict::apart;
  std::optional<Point> centroid;
  Remark remark;
  std::vector<Resolved> regions;  ///< of a whole pair, those that people wrote about
  double reach = 0;               ///< of a region: half of its box's diagonal
  /// Its pair may well be there: nothing says which of several equal ones it was, or that it is the same.
  bool is_ambiguous = false;
  bool is_elsewhere = false;  ///< ambiguous, as a pair of its parts' names came with another shape or place
};

}  // namespace impinge::report
