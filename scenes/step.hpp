// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <string>
#include <utility>

#include "impinge/mesh.hpp"

namespace impinge::scenes {

/// A unit of length: of SI, or so many of it.
struct StepUnit {
  std::string si, measure{};
};
inline const StepUnit kMetre{"IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.)"};
inline const StepUnit kMillimetre{"IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.)"};
inline const StepUnit kFoot{kMetre.si, "IFCLENGTHMEASURE(0.3048)"};

inline std::string step_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  const std::string digits = text;
  return digits.find_first_of(".e") == digits.npos ? digits + "." : digits;
}

/// An IFC file as STEP text: its lines, each with a number. Lengths are in the file's unit.
class Step {
 public:
  /// GlobalIds count on from `guids`; angles are in degrees if asked, or else in radians.
  explicit Step(std::string schema = "IFC4", const StepUnit& unit = kMetre, int guids = 0, bool degrees = false)
      : schema_(std::move(schema)), guids_(guids) {
    origin = axes({0, 0, 0});
    context = line("IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5," + origin + ",$)");
    std::string length = line(unit.si);
    if (!unit.measure.empty()) {
      const std::string measure = line("IFCMEASUREWITHUNIT(" + unit.measure + "," + length + ")");
      length = line("IFCCONVERSIONBASEDUNIT($,.LENGTHUNIT.,'UNIT'," + measure + ")");
    }
    std::string angle = line("IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.)");
    if (degrees) {
      const std::string measure = line("IFCMEASUREWITHUNIT(IFCPLANEANGLEMEASURE(0.017453292519943295)," + angle + ")");
      angle = line("IFCCONVERSIONBASEDUNIT($,.PLANEANGLEUNIT.,'DEGREE'," + measure + ")");
    }
    const std::string units = line("IFCUNITASSIGNMENT((" + length + "," + angle + "))");
    project = line("IFCPROJECT('" + guid() + "',$,'p',$,$,$,$,(" + context + ")," + units + ")");
    const std::string site = spatial("IFCSITE", "Site", "$,$,$,$,$");
    building_ = spatial("IFCBUILDING", "House", "$,$,$");
    for (const auto& [whole, part] : {std::pair(project, site), {site, building_}})
      line("IFCRELAGGREGATES('" + guid() + "',$,$,$," + whole + ",(" + part + "))");
    begin_storey("Level 1", 0);
  }

  /// That products made from now on are in.
  void begin_storey(const std::string& name, double elevation) {
    storey = spatial("IFCBUILDINGSTOREY", name, step_number(elevation));
    line("IFCRELAGGREGATES('" + guid() + "',$,$,$," + building_ + ",(" + storey + "))");
  }

  /// Returns the line's name, such as "#12".
  std::string line(const std::string& text) {
    const std::string name = "#" + std::to_string(++last_);
    lines_ += name + "=" + text + ";\n";
    return name;
  }
  std::string guid() {
    char text[23];
    std::snprintf(text, sizeof text, "0%021d", ++guids_);
    return text;
  }
  std::string point(const Point& p) {
    return line("IFCCARTESIANPOINT((" + step_number(p.x) + "," + step_number(p.y) + "," + step_number(p.z) + "))");
  }
  std::string point(double x, double y) {
    return line("IFCCARTESIANPOINT((" + step_number(x) + "," + step_number(y) + "))");
  }
  std::string direction(const Point& p) {
    return line("IFCDIRECTION((" + step_number(p.x) + "," + step_number(p.y) + "," + step_number(p.z) + "))");
  }
  std::string axes(const Point& at) { return line("IFCAXIS2PLACEMENT3D(" + point(at) + ",$,$)"); }
  std::string axes(const Point& at, const Point& z, const Point& x) {
    return line("IFCAXIS2PLACEMENT3D(" + point(at) + "," + direction(z) + "," + direction(x) + ")");
  }
  std::string flat_axes() { return line("IFCAXIS2PLACEMENT2D(" + point(0, 0) + ",$)"); }
  std::string placement(const std::string& parent, const std::string& axes) {
    return line("IFCLOCALPLACEMENT(" + parent + "," + axes + ")");
  }
  std::string rectangle(double x, double y) {
    return line("IFCRECTANGLEPROFILEDEF(.AREA.,$," + flat_axes() + "," + step_number(x) + "," + step_number(y) + ")");
  }
  std::string extruded(const std::string& profile, double depth) {
    return line("IFCEXTRUDEDAREASOLID(" + profile + "," + origin + "," + direction({0, 0, 1}) + "," +
                step_number(depth) + ")");
  }
  std::string shown(const std::string& item, const std::string& kind = "Body") {
    return line("IFCSHAPEREPRESENTATION(" + context + ",'" + kind + "','SweptSolid',(" + item + "))");
  }
  std::string shape(const std::string& representations) {
    return line("IFCPRODUCTDEFINITIONSHAPE($,$,(" + representations + "))");
  }
  /// A product of the storey; `shape` and `place` may be "$".
  std::string product(const std::string& name, const std::string& place, const std::string& shape,
                      const std::string& kind = "IFCBUILDINGELEMENTPROXY", const std::string& more = ",'T1',$") {
    const std::string made = line(kind + "('" + guid() + "',$," + (name == "$" ? name : "'" + name + "'") + ",$,$," +
                                  place + "," + shape + more + ")");
    line("IFCRELCONTAINEDINSPATIALSTRUCTURE('" + guid() + "',$,$,$,(" + made + ")," + storey + ")");
    return made;
  }
  /// A product whose body is this item, at the origin.
  std::string solid(const std::string& name, const std::string& item) {
    return product(name, placement("$", origin), shape(shown(item)));
  }
  [[nodiscard]] std::string text() const {
    return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\nFILE_SCHEMA(("
           "'" +
           schema_ + "'));\nENDSEC;\nDATA;\n" + lines_ + "ENDSEC;\nEND-ISO-10303-21;\n";
  }

  std::string origin, context, project, storey;

 private:
  std::string spatial(const std::string& kind, const std::string& name, const std::string& more) {
    return line(kind + "('" + guid() + "',$,'" + name + "',$,$,$,$,$,.ELEMENT.," + more + ")");
  }

  std::string schema_, lines_, building_;
  int last_ = 0, guids_;
};

}  // namespace impinge::scenes
