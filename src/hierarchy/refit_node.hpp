// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "core/for_each.hpp"
#include "hierarchy/refit_plan.hpp"

namespace impinge::hierarchy {

/// A planned node where the source has its vertices now: all but the children themselves. Its axes have turned with the
/// vertices, and its boxes hold them.
void refit_node(const RefitPlan& plan, const RefitPlan::Node& planned, const SoupSource& source, WideNode& node,
                const ForEach& for_each);

}  // namespace impinge::hierarchy
