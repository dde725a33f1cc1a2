// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// The machine and the build that the other tables were made on.
#include "bench/support.hpp"

int main(int argc, char** argv) {
  const auto arguments = impinge::bench::parse_arguments(argc, argv);
  impinge::bench::describe_machine().write(arguments.folder, "machine");
}
