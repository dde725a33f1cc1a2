// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "impinge/contacts.hpp"
#include "impinge/result.hpp"
#include "impinge/workspace.hpp"
#include "pipeline/query.hpp"

namespace impinge {

/// Runs the stages in order. Sets no floating-point environment on the calling thread: the public calls do.
Result<Contacts> run_pipeline(const Query& query, Workspace::State& memory);

}  // namespace impinge
