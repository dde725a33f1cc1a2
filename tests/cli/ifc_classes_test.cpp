// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// What classes, properties and selectors of IfcOpenShell take. Which class is derived from which, the schemas of IFC
// say.
#include "report/named_tests/ifc_classes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <sstream>

#include "report/named_tests/plan.hpp"
#include "report/scene.hpp"

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

TEST(IfcClasses, OfGlobalIdsTakeOne) {
  const Assembly house = one_of_each({"IfcStair"});
  EXPECT_EQ(taken("#1srAI$R4T8ihLXSNHmUSET", house), Names{"IfcStair"});
  EXPECT_EQ(taken("1srAI$R4T8ihLXSNHmUSET", house), Names{"IfcStair"});
  EXPECT_EQ(taken("#2O2Fr$t4X7Zf8NOew3FNr2", house),
            Names{"sets.json:1: /0/a/0/selector: the selector: no part's GlobalId is '2O2Fr$t4X7Zf8NOew3FNr2'"});
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
  const std::string place = "sets.json:1: /0/a/0/selector: the selector: ";
  EXPECT_EQ(taken("IfcPump", house),
            Names{place + "no part's IFC class, or one that it is derived from, is 'IfcPump'"});
  EXPECT_EQ(taken("IfcWal", house),
            Names{place + "impinge knows no class 'IfcWal' of IFC, and no part is of it; the nearest is 'IfcWall'"});
}

/// Three walls and a slab with properties. The second wall's name is that of the first, so its object has another.
Assembly house_with_properties() {
  Assembly house = one_of_each({"IfcWall", "IfcWall", "IfcWall", "IfcSlab"});
  const std::vector<std::array<std::string, 3>> parts{
      {"a", "Ext 1",
       "storey=Level 1;type=W1;material=brick;material=wool;P_WallCommon.Fire=2HR;P_WallCommon.Width=0.250;"
       "PredefinedType=SOLIDWALL;classification=Pr_20_93;classification=Wall, outer;P_WallCommon.Bears=TRUE"},
      {"b", "Ext 1", "storey=Level 2;type=W1;material=concrete;P_WallCommon.Fire=1HR;P_WallCommon.Width=0.5"},
      {"c", "Int, \"2\"", "storey=Level 2;assembly=Frame;layer=A-WALL;system=S;Tag=0.5"},
      {"d", "Slab", "building=Level 2;host=Ext 1;material=concrete;P_SlabCommon.Fire=2HR"}};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    io::Object& object = house.objects[i];
    object.product = fmt::format("{}_{}_0{:021d}", object.name, parts[i][1], i);
    object.name = parts[i][0];
    std::istringstream properties(parts[i][2]);
    for (std::string name, value; std::getline(properties, name, '=') && std::getline(properties, value, ';');)
      object.properties.emplace_back(name, value);
  }
  house.objects.pop_back();
  house.file_of.pop_back();
  house.labels = labels_of(house);
  return house;
}

/// The names of the objects of a set, one letter each, or the message.
std::string letters(const Result<PartSet>& set, const Assembly& assembly) {
  if (!set) return set.error().message;
  std::string names;
  for (std::size_t i = 0; i < set->size(); ++i)
    if ((*set)[i]) names += assembly.objects[i].name;
  return names;
}

TEST(Selectors, AreThoseOfIfcOpenShell) {
  const Assembly house = house_with_properties();
  // As its documentation has it: classes and ids add or take away, filters filter what is there so far.
  for (const auto& [selector, expected] :
       std::vector<std::pair<std::string, std::string>>{{"IfcWall", "abc"},
                                                        {"IfcElement, ! IfcWall", "d"},
                                                        {"IfcWall, !0000000000000000000001", "ac"},
                                                        {"0000000000000000000001, 0000000000000000000003", "bd"},
                                                        {"IfcWall, Name=\"Ext 1\"", "ab"},
                                                        {"IfcWall, Name!=/Ext/", "c"},
                                                        {"Name=/xt/", "no part is left by 'Name=/xt/'"},
                                                        {"Name=/.*t/", "abc"},
                                                        {"Name=\"Int, \\\"2\\\"\"", "c"},
                                                        {"Name*=1", "ab"},
                                                        {"Name!*=1", "cd"},
                                                        {"IfcWall, material=concrete, IfcSlab", "bd"},
                                                        {"IfcWall, material=concrete + IfcSlab", "bd"},
                                                        {"IfcSlab+material=wool+", "ad"},
                                                        {"material!=wool", "bcd"},
                                                        {"IfcWall, IfcSlab, type=NULL", "cd"},
                                                        {"type != NULL", "ab"},
                                                        {"location=\"Level 2\"", "bcd"},
                                                        {"storey=\"Level 2\"", "bc"},
                                                        {"group=S", "c"},
                                                        {"layer=A-WALL", "c"},
                                                        {"Tag=0.5", "c"},
                                                        {"Tag=0.50", "no part is left by 'Tag=0.50'"},
                                                        {"P_WallCommon.Fire=2HR", "a"},
                                                        {"/P_.*Common/.Fire=2HR", "ad"},
                                                        {"P_WallCommon./Fi/ != NULL", "ab"},
                                                        {"P_WallCommon.Bears=TRUE", "a"},
                                                        {"P_WallCommon.Width=0.25", "a"},
                                                        {"P_WallCommon.Width>0.25", "b"},
                                                        {"P_WallCommon.Width >= 0.25", "ab"},
                                                        {"P_WallCommon.Width<\"0.5\"", "a"},
                                                        {"P_WallCommon.Width<=0.5", "ab"},
                                                        {"classification=Pr_20_93", "a"},
                                                        {"classification=/Wall/", "a"},
                                                        {"classification!=Pr_20_93", "bcd"},
                                                        {"PredefinedType=SOLIDWALL", "a"},
                                                        {"PredefinedType=NULL", "bcd"},
                                                        {"parent=Frame", "c"},
                                                        {"parent=\"Level 2\", IfcSlab", "bcd"},
                                                        {"parent=\"Ext 1\"", "d"},
                                                        {"host != NULL", "d"},
                                                        {"query:storey.Name=\"Level 2\"", "bc"},
                                                        {"query:materials.Name=wool", "a"},
                                                        {"query:classification.Identification=Pr_20_93", "a"},
                                                        {"IfcElement, query:predefined_type != NULL", "a"},
                                                        {"query:type.Name=W1", "ab"},
                                                        {"query:Tag=0.5", "c"},
                                                        {"query:P_WallCommon.Width>0.25", "b"},
                                                        {"query:/P_.*/.Fire=2HR", "ad"},
                                                        {"b", "b"},
                                                        {"?", "abcd"}}) {
    const Result<Selector> parsed = parse_selector(selector);
    ASSERT_TRUE(parsed) << selector << ": " << parsed.error().message;
    EXPECT_EQ(letters(select(*parsed, house), house), expected) << selector;
  }
}

TEST(Selectors, ThatAreNotUnderstoodAreErrors) {
  for (const auto& [selector, words] : std::vector<std::pair<std::string, std::string>>{
           {"", "it ends where a class, a global id or a filter"},
           {"IfcWall,", "it ends where"},
           {"IfcWall, + IfcSlab", "'+ IfcSlab' is not understood"},
           {"IfcWall IfcSlab", "'IfcSlab' is not understood"},
           {"!IfcWall", "'!IfcWall' takes away from nothing; write IfcElement, !IfcWall"},
           {"IfcWall, walls", "'walls' is no class, no global id and no filter"},
           {"OverallHeight>2", "impinge does not filter by 'OverallHeight'; it does by Description, GlobalId,"},
           {"query:x.y.z=1", "does not filter by 'query:x.y.z"},
           {"query:storey.Elevation>1", "does not filter by 'query:storey.Elevation'"},
           {"query:z>1", "does not filter by 'query:z'"},
           {"query:container.Name=x", "does not filter by 'query:container.Name'"},
           {"query:parent=x", "does not filter by 'query:parent'"},
           {"parent!=2O2Fr$t4X7Zf8NOew3FNr2", "compares parent with names, not with a GlobalId"},
           {"query:", "it ends where"},
           {"!Name=x", "'!' before 'Name' stands before '='"},
           {"P.Q, IfcWall", "'P.Q' is compared with nothing"},
           {"/Name/=x", "does not filter by 'Name'"},
           {"Name=", "it ends where"},
           {"Name=\"x", "a quotation mark is not closed"},
           {"Name=\"x\\\"", "a quotation mark is not closed"},
           {"Name=/x", "a regular expression is not closed"},
           {"Name=/(x/", "the regular expression '(x' cannot be used: missing )"},
           {"Name=/(?!x)/", "cannot be used"},
           {"Name*=/x/", "is compared by = and != alone"},
           {"Name!>x", "is not understood"}}) {
    const Result<Selector> parsed = parse_selector(selector);
    ASSERT_FALSE(parsed) << selector;
    EXPECT_NE(parsed.error().message.find(words), std::string::npos) << selector << ": " << parsed.error().message;
  }
  // Whatever it is, it is answered, and soon.
  std::string nested(1'000'000, '('), text = "IfcWall, Name=/(a*)*b/";
  EXPECT_FALSE(parse_selector("Name=/" + nested + "/"));
  Assembly house = house_with_properties();
  house.objects[0].product = "IfcWall_" + std::string(1'000'000, 'a') + "_0000000000000000000000";
  EXPECT_EQ(letters(select(*parse_selector(text), house), house), "no part is left by 'Name=/(a*)*b/'");
  for (std::size_t i = 0; i < text.size(); ++i)
    for (const char c : std::string_view("\"/\\!*=<>.,+#\0 ", 14)) {
      text.insert(i, 1, c);
      if (const auto parsed = parse_selector(text)) static_cast<void>(select(*parsed, house));
      text.erase(i, 1);
    }
}

/// What a group takes, or the message.
std::string grouped_by(const std::string& group, const Assembly& assembly) {
  const auto configuration = parse_configuration("c.json", R"({"tests":[{"name":"n","a":)" + group + "}]}");
  if (!configuration) return configuration.error().message;
  return letters(PartSets(*configuration, assembly).of(configuration->tests.at(0).a), assembly);
}

TEST(Groups, AreMadeByClassPropertyAndSelector) {
  const Assembly house = house_with_properties();
  EXPECT_EQ(
      grouped_by(R"({"class":["IfcSlab","IfcWallStandardCase","IfcBuildingElement"]})", house),
      "c.json:1: /tests/0/a/class/1: no part's IFC class, or one that it is derived from, is 'IfcWallStandardCase'");
  EXPECT_EQ(grouped_by(R"({"class":"IfcBuildingElement","except":{"class":"IfcSlab"}})", house), "abc");
  EXPECT_EQ(grouped_by(R"({"property":{"storey":"Level*","material":["wool","conc*"]}})", house), "ab");
  EXPECT_EQ(grouped_by(R"({"property":{"P_WallCommon.Fire":"?HR"}})", house), "ab");
  EXPECT_EQ(grouped_by(R"({"select":["IfcSlab","type=W1"],"property":{"material":"concrete"}})", house), "bd");
  EXPECT_EQ(grouped_by(R"({"property":{"storye":"Level 1"}})", house),
            "c.json:1: /tests/0/a/property: no part's property is 'storye'; the nearest is 'storey'");
  EXPECT_EQ(grouped_by(R"({"property":{"storey":"Level 3"}})", house),
            "c.json:1: /tests/0/a/property/storey: no part's storey is 'Level 3'; the nearest is 'Level 1'");
}

TEST(Groups, SayWhetherTheyNeedPropertySets) {
  const auto needs = [](const std::string& group) {
    const auto configuration = parse_configuration(
        "c.json", R"({"tests":[{"name":"n","a":"x","ignore":{"within":[{"except":)" + group + "}]}}]}");
    const Result<bool> answer = needs_property_sets(*configuration);
    return answer.has_value() ? *answer ? "yes" : "no" : answer.error().message;
  };
  EXPECT_EQ(needs(R"({"property":{"storey":"1"},"select":"IfcWall, Name=a.b"})"), "no");
  EXPECT_EQ(needs(R"({"property":{"Pset_WallCommon.FireRating":"1"}})"), "yes");
  EXPECT_EQ(needs(R"({"select":"IfcWall + /P/.Q=1"})"), "yes");
  EXPECT_EQ(needs(R"({"select":"query:P.Q=1"})"), "yes");
  EXPECT_EQ(needs(R"({"select":"query:storey.Name=1"})"), "no");
  EXPECT_EQ(needs(R"({"select":"IfcWall, zone=x"})").substr(0, 82),
            "c.json:1: /tests/0/ignore/within/0/except/select: the selector: impinge does not f");
}

TEST(Groups, OfTheCommandLineAreWordsWithAKindBeforeThem) {
  Assembly house = house_with_properties();
  for (io::Object& object : house.objects) object.properties.emplace_back("class", std::string(class_of(object)));
  house.objects[3].name = "class:x";
  house.labels = labels_of(house);
  const auto named = [&](std::string_view word) {
    const auto found = objects_named(house, word);
    return found ? *found : std::vector<std::uint32_t>{99};
  };
  using Numbers = std::vector<std::uint32_t>;
  EXPECT_EQ(named("class:IfcWall"), (Numbers{0, 1, 2}));
  EXPECT_EQ(named("class:IfcBuildingElement"), (Numbers{0, 1, 2, 3}));
  EXPECT_EQ(named("class:x"), Numbers{3}) << "a word that is a name is that name";
  EXPECT_EQ(named("storey:Level 2"), (Numbers{1, 2}));
  EXPECT_EQ(named("storey:*1"), Numbers{0});
  EXPECT_EQ(named("file:house*"), (Numbers{0, 1, 2, 3}));
  EXPECT_EQ(objects_named(house, "storey:Level 3").error().message,
            "no part is of 'storey:Level 3'; the nearest is 'storey:Level 1'");
  EXPECT_EQ(objects_named(house, "file:home.ifc").error().message,
            "no part is of 'file:home.ifc'; the nearest is 'file:house.ifc'");
}

TEST(ReadyRules, LeaveOutPairsOfTheirClassesAndCountThem) {
  const Names classes{"IfcMechanicalFastener", "IfcBeam",       "IfcReinforcingBar", "IfcSlab", "IfcDoor", "IfcWall",
                      "IfcCovering",           "IfcPipeSegment"};
  Assembly house = one_of_each(classes);
  house.labels = labels_of(house);
  const auto configuration =
      parse_configuration("c.json", R"({"ignore":{"by_design":["reinforcement","insulation coverings"]},
                    "tests":[{"name":"all","a":"*","ignore":{"by_design":["opening fillings","fasteners"]}},
                             {"name":"walls","a":"*","b":{"class":"IfcWall"}}]})");
  ASSERT_TRUE(configuration) << configuration.error().message;
  const Result<Plan> plan = Plan::make(*configuration, house);
  ASSERT_TRUE(plan) << plan.error().message;
  std::set<std::string> left_out;  // of the first test
  for (std::uint32_t a = 0; a < classes.size(); ++a)
    for (std::uint32_t b = a + 1; b < classes.size(); ++b) {
      std::vector<ClashTerms> terms;
      plan->terms(a, b, terms);
      if (terms.empty() || terms.front().test != 0) left_out.insert(classes[a] + " " + classes[b]);
    }
  EXPECT_EQ(left_out, (std::set<std::string>{"IfcMechanicalFastener IfcBeam", "IfcMechanicalFastener IfcReinforcingBar",
                                             "IfcMechanicalFastener IfcSlab", "IfcMechanicalFastener IfcDoor",
                                             "IfcMechanicalFastener IfcWall", "IfcMechanicalFastener IfcCovering",
                                             "IfcMechanicalFastener IfcPipeSegment", "IfcBeam IfcReinforcingBar",
                                             "IfcReinforcingBar IfcSlab", "IfcReinforcingBar IfcWall",
                                             "IfcSlab IfcDoor", "IfcDoor IfcWall", "IfcCovering IfcPipeSegment"}));
  using Counts = std::vector<std::pair<std::string_view, std::uint64_t>>;
  EXPECT_EQ(plan->left_out(0),
            (Counts{{"fasteners", 7}, {"reinforcement", 3}, {"opening fillings", 2}, {"insulation coverings", 1}}));
  EXPECT_EQ(plan->left_out(1), (Counts{{"reinforcement", 1}, {"insulation coverings", 0}}));
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
