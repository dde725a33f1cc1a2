// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What the classes in clash sets take. Which class is derived from which, the schemas of IFC say.
#include "report/named_tests/ifc_classes.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "report/named_tests/part_sets.hpp"

namespace impinge::report {
namespace {

using Names = std::vector<std::string>;

/// A part of each class, named by it, and one of no product.
Assembly one_of_each(const Names& classes) {
  const Mesh mesh = *Mesh::create(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0}, std::vector<std::uint32_t>{0, 1, 2});
  Assembly assembly;
  assembly.files = {"house.ifc"};
  for (const std::string& name : classes)
    assembly.objects.push_back({name, name, name + "_Some name_1srAI$R4T8ihLXSNHmUSET", mesh, {}});
  assembly.objects.push_back({"IfcWall of no product", "x", "", mesh, {}});
  assembly.file_of.assign(assembly.objects.size(), 0);
  return assembly;
}

/// What a selector takes, or the message.
Names taken(const std::string& selector, const Assembly& assembly) {
  const auto configuration = parse_configuration(
      "sets.json", R"([{"name":"n","a":[{"file":"house.ifc","mode":"i","selector":")" + selector + R"("}]}])");
  if (!configuration) return {configuration.error().message};
  const auto set = PartSets(*configuration, assembly).of(configuration->tests.at(0).a);
  if (!set) return {set.error().message};
  Names names;
  for (std::size_t i = 0; i < set->size(); ++i)
    if ((*set)[i]) names.push_back(assembly.objects[i].name);
  return names;
}

TEST(IfcClasses, GlobalIdsAreShownAsTheyAreWritten) {
  const Assembly house = one_of_each({"IfcStair"});
  EXPECT_EQ(taken("#1srAI$R4T8ihLXSNHmUSET", house), Names{"IfcStair"});
  const Names none = taken("#2O2Fr$t4X7Zf8NOew3FNr2", house);
  EXPECT_TRUE(
      none.at(0).starts_with("sets.json:1: /0/a/0/selector: no part's IFC product is '#2O2Fr$t4X7Zf8NOew3FNr2'; "))
      << none.at(0);
}

TEST(IfcClasses, TakeWhatIsDerivedFromThemAndNotWhatBeginsSo) {
  const Assembly house =
      one_of_each({"IfcStair", "IfcStairFlight", "IfcWall", "IfcWallStandardCase", "IfcSlab", "IfcBuildingElementProxy",
                   "IfcFlowSegment", "IfcPipeSegment", "IfcSpace", "IfcReinforcingBar", "IfcOpeningElement", "IfcNew"});
  EXPECT_EQ(taken("IfcStair", house), Names{"IfcStair"});
  EXPECT_EQ(taken("IfcWall", house), (Names{"IfcWall", "IfcWallStandardCase"}));
  EXPECT_EQ(taken("IfcWallStandardCase", house), Names{"IfcWallStandardCase"});
  const Names building{"IfcStair", "IfcStairFlight",          "IfcWall",          "IfcWallStandardCase",
                       "IfcSlab",  "IfcBuildingElementProxy", "IfcReinforcingBar"};
  EXPECT_EQ(taken("IfcBuildingElement", house), building);
  EXPECT_EQ(taken("IfcBuiltElement", house), building) << "its name in IFC4.3";
  EXPECT_EQ(taken("IfcDistributionFlowElement", house), (Names{"IfcFlowSegment", "IfcPipeSegment"}));
  EXPECT_EQ(taken("IfcSpatialElement, .IfcSlab", house), (Names{"IfcSlab", "IfcSpace"}));
  EXPECT_EQ(taken("IfcProduct", house).size(), house.objects.size()) << "everything";
}

TEST(IfcClasses, ThatNothingIsOfOrThatNobodyKnowsAreErrors) {
  const Assembly house = one_of_each({"IfcWall"});
  EXPECT_EQ(taken("IfcPump", house),
            Names{"sets.json:1: /0/a/0/selector: no part's IFC class, or one that it is derived from, is 'IfcPump'"});
  EXPECT_EQ(
      taken("IfcWal", house),
      Names{"sets.json:1: /0/a/0/selector: impinge knows no class 'IfcWal' of IFC; the nearest is 'IfcWall'. Write "
            "classes that it is above, or in a configuration of impinge's own \"product\": \"IfcWal_*\""});
}

TEST(IfcClasses, AreKnownFromTheTop) {
  // Of each class that others are derived from, one that is derived from it: the way up leads through it.
  std::istringstream names(
      "IfcProduct IfcElement IfcProxy IfcKerb IfcAlignmentCant IfcDistributionPort IfcReferent "
      "IfcAlignment IfcExternalSpatialElement IfcSpace IfcBridge IfcRoadPart IfcStructuralAction "
      "IfcStructuralCurveConnection IfcStructuralCurveMemberVarying IfcStructuralSurfaceMemberVarying "
      "IfcReinforcedSoil IfcSensor IfcBoiler IfcValve IfcPipeFitting IfcPump IfcDuctSegment IfcTank "
      "IfcLamp IfcFilter IfcMechanicalFastener IfcProjectionElement IfcRoundedEdgeFeature "
      "IfcOpeningStandardCase IfcFurniture IfcBorehole IfcVehicle IfcBeamStandardCase IfcTendon "
      "IfcColumnStandardCase IfcPile IfcDoorStandardCase IfcMemberStandardCase IfcPlateStandardCase "
      "IfcSlabElementedCase IfcWallElementedCase IfcWindowStandardCase");
  for (std::string name; names >> name;) {
    EXPECT_TRUE(is_ifc_class(name)) << name;
    EXPECT_TRUE(is_of_ifc_class(name, "IfcProduct")) << name;
  }
  EXPECT_FALSE(is_of_ifc_class("IfcElement", "IfcDoor"));
  EXPECT_FALSE(is_ifc_class("IfcRoot"));
  EXPECT_FALSE(is_ifc_class(""));
}

}  // namespace
}  // namespace impinge::report
