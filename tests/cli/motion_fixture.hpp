// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program.hpp"
#include "scenes/mechanism.hpp"

namespace impinge::test {

/// impinge motion on a file that a test writes.
class Motion : public testing::Test {
 protected:
  void write(const std::vector<scenes::FlatPart>& parts) { folder.write("case.glb", scenes::animated_glb(parts)); }
  [[nodiscard]] Ended run(std::vector<std::string> more = {}) const {
    return impinge(folder, joined({"motion", "case.glb"}, more));
  }
  [[nodiscard]] nlohmann::json report(std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--json", "-"});
    const Ended ended = run(more);
    EXPECT_EQ(ended.err, "");
    nlohmann::json report = nlohmann::json::parse(ended.out, nullptr, false);
    EXPECT_FALSE(report.is_discarded()) << ended.out;
    if (report.is_object()) {
      EXPECT_EQ(ended.code, report.at("spans").empty() ? 0 : 1);
    }
    return report;
  }
  Folder folder;
};

}  // namespace impinge::test
