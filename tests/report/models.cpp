// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "models.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <vector>

namespace impinge::test {

std::string ifc_of_walls(std::span<const std::size_t> numbers, const scenes::StepUnit& unit, double metre) {
  struct Wall {
    std::string guid, before_place, after_shape;  // of the product
    Point at;
    std::vector<std::string> materials;
  };
  const std::array<Wall, 2> walls{{{"1srAI$R4T8ihLXSNHmUSET", "'left',$,$", "'-7'", {5, 3, 0}, {"brick", "mortar"}},
                                   {"2O2Fr$t4X7Zf8NOew3FNr2", "'right',$,'type'", "$", {6, 4, 1}, {"steel"}}}};
  scenes::Step step("IFC2X3", unit);
  step.begin_storey("Level 1, north", 0);
  for (const std::size_t i : numbers) {
    const auto& [guid, before_place, after_shape, at, materials] = walls.at(i);
    const std::string place = step.placement("$", step.axes({metre * at.x, metre * at.y, metre * at.z}));
    const std::string shape = step.shape(step.shown(step.extruded(step.rectangle(2 * metre, 2 * metre), 2 * metre)));
    const std::string wall = step.line(
        fmt::format("IFCBUILDINGELEMENTPROXY('{}',$,{},{},{},{},$)", guid, before_place, place, shape, after_shape));
    step.line(fmt::format("IFCRELCONTAINEDINSPATIALSTRUCTURE('{}',$,$,$,({}),{})", step.guid(), wall, step.storey));
    std::vector<std::string> names;
    for (const std::string& material : materials) names.push_back(step.line("IFCMATERIAL('" + material + "')"));
    const std::string made_of = step.line(fmt::format("IFCMATERIALLIST(({}))", fmt::join(names, ",")));
    step.line(fmt::format("IFCRELASSOCIATESMATERIAL('{}',$,$,$,({}),{})", step.guid(), wall, made_of));
  }
  return step.text();
}

std::string ifc_of_two_walls() { return ifc_of_walls(std::array<std::size_t, 2>{0, 1}, scenes::kMillimetre, 1000); }

std::string collada_of_two_walls() {
  const std::string node = R"(<instance_geometry url="#cube"/></node>)";
  return R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2024-01-01T00:00:00Z</created><modified>2024-01-01T00:00:00Z</modified>
<unit name="millimeter" meter="0.001"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="cube" name="cube"><mesh>
<source id="p"><float_array id="pa" count="24">0 0 0 2000 0 0 0 2000 0 2000 2000 0
0 0 2000 2000 0 2000 0 2000 2000 2000 2000 2000</float_array>
<technique_common><accessor source="#pa" count="8" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 2 3 0 3 1 4 5 7 4 7 6 0 1 5 0 5 4 2 6 7 2 7 3 0 4 6 0 6 2 1 3 7 1 7 5</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s" name="s">
<node id="left" name="left"><translate>4000 2000 0</translate>)" +
         node + R"(
<node id="right" name="right"><translate>5000 3000 1000</translate>)" +
         node + R"(
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
)";
}

}  // namespace impinge::test
