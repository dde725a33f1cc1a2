// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/named_tests/ifc_classes.hpp"

#include <algorithm>
#include <limits>

#include "report/text.hpp"

namespace impinge::report {
namespace {

constexpr std::string_view kTop = "IfcProduct";

struct IfcClass {
  std::string_view name, parent;
};

// From the schemas IFC2x3, IFC4 and IFC4.3 of buildingSMART, without the load cases of structural analysis. Where they
// differ, a class stands where IFC2x3 has it, if it has it, perhaps with a later one in between.
constexpr IfcClass kClasses[] = {
    // clang-format off
    {"IfcActuator", "IfcDistributionControlElement"},
    {"IfcAirTerminal", "IfcFlowTerminal"},
    {"IfcAirTerminalBox", "IfcFlowController"},
    {"IfcAirToAirHeatRecovery", "IfcEnergyConversionDevice"},
    {"IfcAlarm", "IfcDistributionControlElement"},
    {"IfcAlignment", "IfcLinearPositioningElement"},
    {"IfcAlignmentCant", "IfcLinearElement"},
    {"IfcAlignmentHorizontal", "IfcLinearElement"},
    {"IfcAlignmentSegment", "IfcLinearElement"},
    {"IfcAlignmentVertical", "IfcLinearElement"},
    {"IfcAnnotation", "IfcProduct"},
    {"IfcAudioVisualAppliance", "IfcFlowTerminal"},
    {"IfcBeam", "IfcBuildingElement"},
    {"IfcBeamStandardCase", "IfcBeam"},
    {"IfcBearing", "IfcBuiltElement"},
    {"IfcBoiler", "IfcEnergyConversionDevice"},
    {"IfcBorehole", "IfcGeotechnicalAssembly"},
    {"IfcBridge", "IfcFacility"},
    {"IfcBridgePart", "IfcFacilityPart"},
    {"IfcBuilding", "IfcFacility"},
    {"IfcBuildingElement", "IfcBuiltElement"},
    {"IfcBuildingElementComponent", "IfcBuildingElement"},
    {"IfcBuildingElementPart", "IfcBuildingElementComponent"},
    {"IfcBuildingElementProxy", "IfcBuildingElement"},
    {"IfcBuildingStorey", "IfcSpatialStructureElement"},
    {"IfcBuiltElement", "IfcElement"},
    {"IfcBurner", "IfcEnergyConversionDevice"},
    {"IfcCableCarrierFitting", "IfcFlowFitting"},
    {"IfcCableCarrierSegment", "IfcFlowSegment"},
    {"IfcCableFitting", "IfcFlowFitting"},
    {"IfcCableSegment", "IfcFlowSegment"},
    {"IfcCaissonFoundation", "IfcDeepFoundation"},
    {"IfcChamferEdgeFeature", "IfcEdgeFeature"},
    {"IfcChiller", "IfcEnergyConversionDevice"},
    {"IfcChimney", "IfcBuildingElement"},
    {"IfcCivilElement", "IfcElement"},
    {"IfcCoil", "IfcEnergyConversionDevice"},
    {"IfcColumn", "IfcBuildingElement"},
    {"IfcColumnStandardCase", "IfcColumn"},
    {"IfcCommunicationsAppliance", "IfcFlowTerminal"},
    {"IfcCompressor", "IfcFlowMovingDevice"},
    {"IfcCondenser", "IfcEnergyConversionDevice"},
    {"IfcController", "IfcDistributionControlElement"},
    {"IfcConveyorSegment", "IfcFlowSegment"},
    {"IfcCooledBeam", "IfcEnergyConversionDevice"},
    {"IfcCoolingTower", "IfcEnergyConversionDevice"},
    {"IfcCourse", "IfcBuiltElement"},
    {"IfcCovering", "IfcBuildingElement"},
    {"IfcCurtainWall", "IfcBuildingElement"},
    {"IfcDamper", "IfcFlowController"},
    {"IfcDeepFoundation", "IfcBuildingElement"},
    {"IfcDiscreteAccessory", "IfcElementComponent"},
    {"IfcDistributionBoard", "IfcFlowController"},
    {"IfcDistributionChamberElement", "IfcDistributionFlowElement"},
    {"IfcDistributionControlElement", "IfcDistributionElement"},
    {"IfcDistributionElement", "IfcElement"},
    {"IfcDistributionFlowElement", "IfcDistributionElement"},
    {"IfcDistributionPort", "IfcPort"},
    {"IfcDoor", "IfcBuildingElement"},
    {"IfcDoorStandardCase", "IfcDoor"},
    {"IfcDuctFitting", "IfcFlowFitting"},
    {"IfcDuctSegment", "IfcFlowSegment"},
    {"IfcDuctSilencer", "IfcFlowTreatmentDevice"},
    {"IfcEarthworksCut", "IfcFeatureElementSubtraction"},
    {"IfcEarthworksElement", "IfcBuiltElement"},
    {"IfcEarthworksFill", "IfcEarthworksElement"},
    {"IfcEdgeFeature", "IfcFeatureElementSubtraction"},
    {"IfcElectricAppliance", "IfcFlowTerminal"},
    {"IfcElectricDistributionBoard", "IfcFlowController"},
    {"IfcElectricDistributionPoint", "IfcFlowController"},
    {"IfcElectricFlowStorageDevice", "IfcFlowStorageDevice"},
    {"IfcElectricFlowTreatmentDevice", "IfcFlowTreatmentDevice"},
    {"IfcElectricGenerator", "IfcEnergyConversionDevice"},
    {"IfcElectricMotor", "IfcEnergyConversionDevice"},
    {"IfcElectricTimeControl", "IfcFlowController"},
    {"IfcElectricalElement", "IfcElement"},
    {"IfcElement", "IfcProduct"},
    {"IfcElementAssembly", "IfcElement"},
    {"IfcElementComponent", "IfcElement"},
    {"IfcEnergyConversionDevice", "IfcDistributionFlowElement"},
    {"IfcEngine", "IfcEnergyConversionDevice"},
    {"IfcEquipmentElement", "IfcElement"},
    {"IfcEvaporativeCooler", "IfcEnergyConversionDevice"},
    {"IfcEvaporator", "IfcEnergyConversionDevice"},
    {"IfcExternalSpatialElement", "IfcExternalSpatialStructureElement"},
    {"IfcExternalSpatialStructureElement", "IfcSpatialElement"},
    {"IfcFacility", "IfcSpatialStructureElement"},
    {"IfcFacilityPart", "IfcSpatialStructureElement"},
    {"IfcFacilityPartCommon", "IfcFacilityPart"},
    {"IfcFan", "IfcFlowMovingDevice"},
    {"IfcFastener", "IfcElementComponent"},
    {"IfcFeatureElement", "IfcElement"},
    {"IfcFeatureElementAddition", "IfcFeatureElement"},
    {"IfcFeatureElementSubtraction", "IfcFeatureElement"},
    {"IfcFilter", "IfcFlowTreatmentDevice"},
    {"IfcFireSuppressionTerminal", "IfcFlowTerminal"},
    {"IfcFlowController", "IfcDistributionFlowElement"},
    {"IfcFlowFitting", "IfcDistributionFlowElement"},
    {"IfcFlowInstrument", "IfcDistributionControlElement"},
    {"IfcFlowMeter", "IfcFlowController"},
    {"IfcFlowMovingDevice", "IfcDistributionFlowElement"},
    {"IfcFlowSegment", "IfcDistributionFlowElement"},
    {"IfcFlowStorageDevice", "IfcDistributionFlowElement"},
    {"IfcFlowTerminal", "IfcDistributionFlowElement"},
    {"IfcFlowTreatmentDevice", "IfcDistributionFlowElement"},
    {"IfcFooting", "IfcBuildingElement"},
    {"IfcFurnishingElement", "IfcElement"},
    {"IfcFurniture", "IfcFurnishingElement"},
    {"IfcGeographicElement", "IfcElement"},
    {"IfcGeomodel", "IfcGeotechnicalAssembly"},
    {"IfcGeoslice", "IfcGeotechnicalAssembly"},
    {"IfcGeotechnicalAssembly", "IfcGeotechnicalElement"},
    {"IfcGeotechnicalElement", "IfcElement"},
    {"IfcGeotechnicalStratum", "IfcGeotechnicalElement"},
    {"IfcGrid", "IfcProduct"},
    {"IfcHeatExchanger", "IfcEnergyConversionDevice"},
    {"IfcHumidifier", "IfcEnergyConversionDevice"},
    {"IfcImpactProtectionDevice", "IfcElementComponent"},
    {"IfcInterceptor", "IfcFlowTreatmentDevice"},
    {"IfcJunctionBox", "IfcFlowFitting"},
    {"IfcKerb", "IfcBuiltElement"},
    {"IfcLamp", "IfcFlowTerminal"},
    {"IfcLightFixture", "IfcFlowTerminal"},
    {"IfcLinearElement", "IfcProduct"},
    {"IfcLinearPositioningElement", "IfcPositioningElement"},
    {"IfcLiquidTerminal", "IfcFlowTerminal"},
    {"IfcMarineFacility", "IfcFacility"},
    {"IfcMarinePart", "IfcFacilityPart"},
    {"IfcMechanicalFastener", "IfcFastener"},
    {"IfcMedicalDevice", "IfcFlowTerminal"},
    {"IfcMember", "IfcBuildingElement"},
    {"IfcMemberStandardCase", "IfcMember"},
    {"IfcMobileTelecommunicationsAppliance", "IfcFlowTerminal"},
    {"IfcMooringDevice", "IfcBuiltElement"},
    {"IfcMotorConnection", "IfcEnergyConversionDevice"},
    {"IfcNavigationElement", "IfcBuiltElement"},
    {"IfcOpeningElement", "IfcFeatureElementSubtraction"},
    {"IfcOpeningStandardCase", "IfcOpeningElement"},
    {"IfcOutlet", "IfcFlowTerminal"},
    {"IfcPavement", "IfcBuiltElement"},
    {"IfcPile", "IfcDeepFoundation"},
    {"IfcPipeFitting", "IfcFlowFitting"},
    {"IfcPipeSegment", "IfcFlowSegment"},
    {"IfcPlate", "IfcBuildingElement"},
    {"IfcPlateStandardCase", "IfcPlate"},
    {"IfcPort", "IfcProduct"},
    {"IfcPositioningElement", "IfcProduct"},
    {"IfcProjectionElement", "IfcFeatureElementAddition"},
    {"IfcProtectiveDevice", "IfcFlowController"},
    {"IfcProtectiveDeviceTrippingUnit", "IfcDistributionControlElement"},
    {"IfcProxy", "IfcProduct"},
    {"IfcPump", "IfcFlowMovingDevice"},
    {"IfcRail", "IfcBuiltElement"},
    {"IfcRailing", "IfcBuildingElement"},
    {"IfcRailway", "IfcFacility"},
    {"IfcRailwayPart", "IfcFacilityPart"},
    {"IfcRamp", "IfcBuildingElement"},
    {"IfcRampFlight", "IfcBuildingElement"},
    {"IfcReferent", "IfcPositioningElement"},
    {"IfcReinforcedSoil", "IfcEarthworksElement"},
    {"IfcReinforcingBar", "IfcReinforcingElement"},
    {"IfcReinforcingElement", "IfcBuildingElementComponent"},
    {"IfcReinforcingMesh", "IfcReinforcingElement"},
    {"IfcRoad", "IfcFacility"},
    {"IfcRoadPart", "IfcFacilityPart"},
    {"IfcRoof", "IfcBuildingElement"},
    {"IfcRoundedEdgeFeature", "IfcEdgeFeature"},
    {"IfcSanitaryTerminal", "IfcFlowTerminal"},
    {"IfcSensor", "IfcDistributionControlElement"},
    {"IfcShadingDevice", "IfcBuildingElement"},
    {"IfcSign", "IfcElementComponent"},
    {"IfcSignal", "IfcFlowTerminal"},
    {"IfcSite", "IfcSpatialStructureElement"},
    {"IfcSlab", "IfcBuildingElement"},
    {"IfcSlabElementedCase", "IfcSlab"},
    {"IfcSlabStandardCase", "IfcSlab"},
    {"IfcSolarDevice", "IfcEnergyConversionDevice"},
    {"IfcSpace", "IfcSpatialStructureElement"},
    {"IfcSpaceHeater", "IfcFlowTerminal"},
    {"IfcSpatialElement", "IfcProduct"},
    {"IfcSpatialStructureElement", "IfcSpatialElement"},
    {"IfcSpatialZone", "IfcSpatialElement"},
    {"IfcStackTerminal", "IfcFlowTerminal"},
    {"IfcStair", "IfcBuildingElement"},
    {"IfcStairFlight", "IfcBuildingElement"},
    {"IfcStructuralAction", "IfcStructuralActivity"},
    {"IfcStructuralActivity", "IfcProduct"},
    {"IfcStructuralConnection", "IfcStructuralItem"},
    {"IfcStructuralCurveConnection", "IfcStructuralConnection"},
    {"IfcStructuralCurveMember", "IfcStructuralMember"},
    {"IfcStructuralCurveMemberVarying", "IfcStructuralCurveMember"},
    {"IfcStructuralItem", "IfcProduct"},
    {"IfcStructuralMember", "IfcStructuralItem"},
    {"IfcStructuralPointConnection", "IfcStructuralConnection"},
    {"IfcStructuralReaction", "IfcStructuralActivity"},
    {"IfcStructuralSurfaceConnection", "IfcStructuralConnection"},
    {"IfcStructuralSurfaceMember", "IfcStructuralMember"},
    {"IfcStructuralSurfaceMemberVarying", "IfcStructuralSurfaceMember"},
    {"IfcSurfaceFeature", "IfcFeatureElement"},
    {"IfcSwitchingDevice", "IfcFlowController"},
    {"IfcSystemFurnitureElement", "IfcFurnishingElement"},
    {"IfcTank", "IfcFlowStorageDevice"},
    {"IfcTendon", "IfcReinforcingElement"},
    {"IfcTendonAnchor", "IfcReinforcingElement"},
    {"IfcTendonConduit", "IfcReinforcingElement"},
    {"IfcTrackElement", "IfcBuiltElement"},
    {"IfcTransformer", "IfcEnergyConversionDevice"},
    {"IfcTransportElement", "IfcTransportationDevice"},
    {"IfcTransportationDevice", "IfcElement"},
    {"IfcTubeBundle", "IfcEnergyConversionDevice"},
    {"IfcUnitaryControlElement", "IfcDistributionControlElement"},
    {"IfcUnitaryEquipment", "IfcEnergyConversionDevice"},
    {"IfcValve", "IfcFlowController"},
    {"IfcVehicle", "IfcTransportationDevice"},
    {"IfcVibrationDamper", "IfcElementComponent"},
    {"IfcVibrationIsolator", "IfcElementComponent"},
    {"IfcVirtualElement", "IfcElement"},
    {"IfcVoidingFeature", "IfcFeatureElementSubtraction"},
    {"IfcWall", "IfcBuildingElement"},
    {"IfcWallElementedCase", "IfcWall"},
    {"IfcWallStandardCase", "IfcWall"},
    {"IfcWasteTerminal", "IfcFlowTerminal"},
    {"IfcWindow", "IfcBuildingElement"},
    {"IfcWindowStandardCase", "IfcWindow"},
    // clang-format on
};

constexpr const IfcClass* find(std::string_view name) {
  const IfcClass* const place = std::ranges::lower_bound(kClasses, name, {}, &IfcClass::name);
  return place != std::end(kClasses) && place->name == name ? place : nullptr;
}

constexpr bool leads_to_the_top(const IfcClass& one) {
  int steps = 0;
  const IfcClass* at = &one;
  while (at && at->parent != kTop && ++steps < 20) at = find(at->parent);
  return at && at->parent == kTop;
}

static_assert(std::ranges::is_sorted(kClasses, {}, &IfcClass::name), "they are looked up by halving");
static_assert(std::ranges::all_of(kClasses, leads_to_the_top));

}  // namespace

bool is_ifc_class(std::string_view name) { return name == kTop || find(name) != nullptr; }

bool is_of_ifc_class(std::string_view name, std::string_view wanted) {
  while (name != wanted) {
    const IfcClass* const known = find(name);
    if (known == nullptr) return false;
    name = known->parent;
  }
  return true;
}

std::string_view nearest_ifc_class(std::string_view word) {
  std::string_view nearest;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const IfcClass& one : kClasses)
    if (const std::size_t distance = edit_distance(word, one.name); distance < least)
      least = distance, nearest = one.name;
  return nearest;
}

}  // namespace impinge::report
