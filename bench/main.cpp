// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/support.hpp"

int main(int argc, char** argv) { impinge::bench::bench_main(impinge::bench::parse_arguments(argc, argv)); }
