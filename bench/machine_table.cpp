// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// The machine and the build that the other tables were made on.
#include "bench/support.hpp"

void impinge::bench::bench_main(const Arguments& arguments) { describe_machine().write(arguments.folder, "machine"); }
