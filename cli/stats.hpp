// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "impinge/contacts.hpp"
#include "report/sink.hpp"

namespace impinge::cli {
using namespace report;

/// The tables of `--stats`: what each stage did and how long it took, and the cost function beside the measured time.
void print_statistics(const Statistics& statistics, Sink& sink);

}  // namespace impinge::cli
