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

/// Which of two parts are solid.
struct Kinds {
  bool a_is_solid, b_is_solid;
};

/// The verdict that follows from where the cells of either boundary are (docs/verdicts.md). kNear is ignored: the
/// caller replaces it where it means that the boundaries are shared. `touch`: the parts share a point, or are no
/// farther apart than the tolerance; `pass`: two surfaces cross.
Finding verdict_of(const solid::Cells& cells, const Kinds& kinds, bool touch, bool pass);

/// Whether no further cell could change the verdict.
bool is_settled(const solid::Cells& cells, const Kinds& kinds);

}  // namespace impinge::clash
