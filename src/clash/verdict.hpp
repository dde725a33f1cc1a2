// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "impinge/clash.hpp"
#include "solid/cells.hpp"

namespace impinge::clash {

struct Finding {
  Verdict verdict = Verdict::apart;
  int inner = -1;  ///< as `Clash::inner`
};

/// What two parts are.
struct Kinds {
  bool a_is_solid, b_is_solid;
};

/// The verdict that follows from where the cells of either boundary are (docs/verdicts.md). kNear counts for nothing:
/// whoever has it says first what it amounts to. `touch`: they share a point, or come as near as the tolerance;
/// `pass`: two surfaces go through each other.
Finding verdict_of(const solid::Cells& cells, const Kinds& kinds, bool touch, bool pass);

/// Whether no further cell could change the verdict.
bool is_settled(const solid::Cells& cells, const Kinds& kinds);

}  // namespace impinge::clash
