// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/named_tests/ifc_classes.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "report/text.hpp"

namespace impinge::report {
namespace {

constexpr std::string_view kTop = "IfcProduct";

/// The class that each class is derived from: from the schemas IFC2x3, IFC4 and IFC4.3 of buildingSMART, without the
/// load cases of structural analysis. Where they differ, a class stands where IFC2x3 has it, if it has it, perhaps with
/// a later one in between.
std::map<std::string_view, std::string_view> make_parents() {
  const std::vector<std::pair<std::string_view, std::vector<std::string_view>>> derived{
      // clang-format off
      {"IfcProduct", {"IfcAnnotation", "IfcElement", "IfcGrid", "IfcLinearElement", "IfcPort", "IfcPositioningElement",
        "IfcProxy", "IfcSpatialElement", "IfcStructuralActivity", "IfcStructuralItem"}},
      {"IfcElement", {"IfcBuiltElement", "IfcCivilElement", "IfcDistributionElement", "IfcElectricalElement",
        "IfcElementAssembly", "IfcElementComponent", "IfcEquipmentElement", "IfcFeatureElement", "IfcFurnishingElement",
        "IfcGeographicElement", "IfcGeotechnicalElement", "IfcTransportationDevice", "IfcVirtualElement"}},
      {"IfcLinearElement", {"IfcAlignmentCant", "IfcAlignmentHorizontal", "IfcAlignmentSegment",
        "IfcAlignmentVertical"}},
      {"IfcPort", {"IfcDistributionPort"}},
      {"IfcPositioningElement", {"IfcLinearPositioningElement", "IfcReferent"}},
      {"IfcSpatialElement", {"IfcExternalSpatialStructureElement", "IfcSpatialStructureElement", "IfcSpatialZone"}},
      {"IfcStructuralActivity", {"IfcStructuralAction", "IfcStructuralReaction"}},
      {"IfcStructuralItem", {"IfcStructuralConnection", "IfcStructuralMember"}},
      {"IfcBuiltElement", {"IfcBearing", "IfcBuildingElement", "IfcCourse", "IfcEarthworksElement", "IfcKerb",
        "IfcMooringDevice", "IfcNavigationElement", "IfcPavement", "IfcRail", "IfcTrackElement"}},
      {"IfcDistributionElement", {"IfcDistributionControlElement", "IfcDistributionFlowElement"}},
      {"IfcElementComponent", {"IfcDiscreteAccessory", "IfcFastener", "IfcImpactProtectionDevice", "IfcSign",
        "IfcVibrationDamper", "IfcVibrationIsolator"}},
      {"IfcFeatureElement", {"IfcFeatureElementAddition", "IfcFeatureElementSubtraction", "IfcSurfaceFeature"}},
      {"IfcFurnishingElement", {"IfcFurniture", "IfcSystemFurnitureElement"}},
      {"IfcGeotechnicalElement", {"IfcGeotechnicalAssembly", "IfcGeotechnicalStratum"}},
      {"IfcTransportationDevice", {"IfcTransportElement", "IfcVehicle"}},
      {"IfcLinearPositioningElement", {"IfcAlignment"}},
      {"IfcExternalSpatialStructureElement", {"IfcExternalSpatialElement"}},
      {"IfcSpatialStructureElement", {"IfcBuildingStorey", "IfcFacility", "IfcFacilityPart", "IfcSite", "IfcSpace"}},
      {"IfcStructuralConnection", {"IfcStructuralCurveConnection", "IfcStructuralPointConnection",
        "IfcStructuralSurfaceConnection"}},
      {"IfcStructuralMember", {"IfcStructuralCurveMember", "IfcStructuralSurfaceMember"}},
      {"IfcBuildingElement", {"IfcBeam", "IfcBuildingElementComponent", "IfcBuildingElementProxy", "IfcChimney",
        "IfcColumn", "IfcCovering", "IfcCurtainWall", "IfcDeepFoundation", "IfcDoor", "IfcFooting", "IfcMember",
        "IfcPlate", "IfcRailing", "IfcRamp", "IfcRampFlight", "IfcRoof", "IfcShadingDevice", "IfcSlab", "IfcStair",
        "IfcStairFlight", "IfcWall", "IfcWindow"}},
      {"IfcEarthworksElement", {"IfcEarthworksFill", "IfcReinforcedSoil"}},
      {"IfcDistributionControlElement", {"IfcActuator", "IfcAlarm", "IfcController", "IfcFlowInstrument",
        "IfcProtectiveDeviceTrippingUnit", "IfcSensor", "IfcUnitaryControlElement"}},
      {"IfcDistributionFlowElement", {"IfcDistributionChamberElement", "IfcEnergyConversionDevice", "IfcFlowController",
        "IfcFlowFitting", "IfcFlowMovingDevice", "IfcFlowSegment", "IfcFlowStorageDevice", "IfcFlowTerminal",
        "IfcFlowTreatmentDevice"}},
      {"IfcFastener", {"IfcMechanicalFastener"}},
      {"IfcFeatureElementAddition", {"IfcProjectionElement"}},
      {"IfcFeatureElementSubtraction", {"IfcEarthworksCut", "IfcEdgeFeature", "IfcOpeningElement",
        "IfcVoidingFeature"}},
      {"IfcGeotechnicalAssembly", {"IfcBorehole", "IfcGeomodel", "IfcGeoslice"}},
      {"IfcFacility", {"IfcBridge", "IfcBuilding", "IfcMarineFacility", "IfcRailway", "IfcRoad"}},
      {"IfcFacilityPart", {"IfcBridgePart", "IfcFacilityPartCommon", "IfcMarinePart", "IfcRailwayPart", "IfcRoadPart"}},
      {"IfcStructuralCurveMember", {"IfcStructuralCurveMemberVarying"}},
      {"IfcStructuralSurfaceMember", {"IfcStructuralSurfaceMemberVarying"}},
      {"IfcBeam", {"IfcBeamStandardCase"}},
      {"IfcBuildingElementComponent", {"IfcBuildingElementPart", "IfcReinforcingElement"}},
      {"IfcColumn", {"IfcColumnStandardCase"}},
      {"IfcDeepFoundation", {"IfcCaissonFoundation", "IfcPile"}},
      {"IfcDoor", {"IfcDoorStandardCase"}},
      {"IfcMember", {"IfcMemberStandardCase"}},
      {"IfcPlate", {"IfcPlateStandardCase"}},
      {"IfcSlab", {"IfcSlabElementedCase", "IfcSlabStandardCase"}},
      {"IfcWall", {"IfcWallElementedCase", "IfcWallStandardCase"}},
      {"IfcWindow", {"IfcWindowStandardCase"}},
      {"IfcEnergyConversionDevice", {"IfcAirToAirHeatRecovery", "IfcBoiler", "IfcBurner", "IfcChiller", "IfcCoil",
        "IfcCondenser", "IfcCooledBeam", "IfcCoolingTower", "IfcElectricGenerator", "IfcElectricMotor", "IfcEngine",
        "IfcEvaporativeCooler", "IfcEvaporator", "IfcHeatExchanger", "IfcHumidifier", "IfcMotorConnection",
        "IfcSolarDevice", "IfcTransformer", "IfcTubeBundle", "IfcUnitaryEquipment"}},
      {"IfcFlowController", {"IfcAirTerminalBox", "IfcDamper", "IfcDistributionBoard", "IfcElectricDistributionBoard",
        "IfcElectricDistributionPoint", "IfcElectricTimeControl", "IfcFlowMeter", "IfcProtectiveDevice",
        "IfcSwitchingDevice", "IfcValve"}},
      {"IfcFlowFitting", {"IfcCableCarrierFitting", "IfcCableFitting", "IfcDuctFitting", "IfcJunctionBox",
        "IfcPipeFitting"}},
      {"IfcFlowMovingDevice", {"IfcCompressor", "IfcFan", "IfcPump"}},
      {"IfcFlowSegment", {"IfcCableCarrierSegment", "IfcCableSegment", "IfcConveyorSegment", "IfcDuctSegment",
        "IfcPipeSegment"}},
      {"IfcFlowStorageDevice", {"IfcElectricFlowStorageDevice", "IfcTank"}},
      {"IfcFlowTerminal", {"IfcAirTerminal", "IfcAudioVisualAppliance", "IfcCommunicationsAppliance",
        "IfcElectricAppliance", "IfcFireSuppressionTerminal", "IfcLamp", "IfcLightFixture", "IfcLiquidTerminal",
        "IfcMedicalDevice", "IfcMobileTelecommunicationsAppliance", "IfcOutlet", "IfcSanitaryTerminal", "IfcSignal",
        "IfcSpaceHeater", "IfcStackTerminal", "IfcWasteTerminal"}},
      {"IfcFlowTreatmentDevice", {"IfcDuctSilencer", "IfcElectricFlowTreatmentDevice", "IfcFilter", "IfcInterceptor"}},
      {"IfcEdgeFeature", {"IfcChamferEdgeFeature", "IfcRoundedEdgeFeature"}},
      {"IfcOpeningElement", {"IfcOpeningStandardCase"}},
      {"IfcReinforcingElement", {"IfcReinforcingBar", "IfcReinforcingMesh", "IfcTendon", "IfcTendonAnchor",
        "IfcTendonConduit"}},
      // clang-format on
  };
  std::map<std::string_view, std::string_view> parents;
  for (const auto& [parent, classes] : derived)
    for (const std::string_view name : classes) parents.emplace(name, parent);
  return parents;
}

const std::map<std::string_view, std::string_view>& parents() {
  static const auto all = make_parents();
  return all;
}

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

bool is_ifc_class(std::string_view name) { return name == kTop || parents().contains(name); }

bool is_of_ifc_class(std::string_view name, std::string_view wanted) {
  while (name != wanted) {
    const auto known = parents().find(name);
    if (known == parents().end()) return false;
    name = known->second;
  }
  return true;
}

std::string nearest_ifc_class(std::string_view word) {
  return nearest_text(word, parents(), [](const auto& known) { return known.first; });
}

const DesignRule* find_design_rule(std::string_view name) {
  const auto rule = std::ranges::find(all_rules(), name, &DesignRule::name);
  return rule == all_rules().end() ? nullptr : &*rule;
}

}  // namespace impinge::report
