// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/named_tests/by_design.hpp"

#include <algorithm>

namespace impinge::report {
namespace {

const std::vector<DesignRule>& all_rules() {
  static const std::vector<DesignRule> rules{
      {"fasteners",
       {"IfcFastener", "IfcDiscreteAccessory"},
       {"IfcBuiltElement", "IfcElementAssembly", "IfcElementComponent", "IfcDistributionElement"}},
      {"reinforcement",
       {"IfcReinforcingElement"},
       {"IfcReinforcingElement", "IfcBeam", "IfcColumn", "IfcDeepFoundation", "IfcFooting", "IfcRamp", "IfcRampFlight",
        "IfcRoof", "IfcSlab", "IfcStair", "IfcStairFlight", "IfcWall"}},
      {"opening fillings",
       {"IfcDoor", "IfcWindow"},
       {"IfcCurtainWall", "IfcMember", "IfcPlate", "IfcRoof", "IfcSlab", "IfcWall"}},
      {"insulation coverings", {"IfcCovering"}, {"IfcDistributionFlowElement"}},
  };
  return rules;
}

}  // namespace

const DesignRule* find_design_rule(std::string_view name) {
  const auto rule = std::ranges::find(all_rules(), name, &DesignRule::name);
  return rule == all_rules().end() ? nullptr : &*rule;
}

}  // namespace impinge::report
